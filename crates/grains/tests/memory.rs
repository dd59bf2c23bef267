//! Memory: how much a bed takes, and that steps ask for none.
#![allow(unsafe_code, reason = "an allocator that counts has to be one")]

mod common;

use brazilnut_base::{Side, vec3};
use brazilnut_grains::contact::TangentialLaw;
use brazilnut_grains::{Dem, DemSpec, Grains, PairSpec};
use common::*;
use std::alloc::{GlobalAlloc, Layout, System};
use std::f64::consts::PI;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

struct Counting;

static LIVE: AtomicUsize = AtomicUsize::new(0);
static CALLS: AtomicUsize = AtomicUsize::new(0);

// Sound: every call goes to the system's allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        CALLS.fetch_add(1, Relaxed);
        LIVE.fetch_add(layout.size(), Relaxed);
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        LIVE.fetch_sub(layout.size(), Relaxed);
        unsafe { System.dealloc(at, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

const R: f64 = 1e-3;

/// Grains with friction springs that fill a closed cell to two thirds: they stay in contact.
fn bed() -> (DemSpec, Grains) {
    let (k, e) = (2000.0, 0.3);
    let dt = PI * (mass(0.8 * R) / 2.0 / k).sqrt() / 25.0;
    let (gap, count) = (0.85, vec3(20.0, 20.0, 50.0));
    // A hair more, for the lattice to fit its own cell.
    let size = count * (2.0 * R * gap * (1.0 + 1e-9));
    let mut s = spec(0.0, Side::Periodic, dt, PairSpec { friction: 0.5, ..pair(k, e) });
    s.cell.size = size;
    s.contact.tangential = TangentialLaw::LinearSpring;
    s.rotation = true;
    s.limits.overlap = 0.5;
    (s, cloud(20_000, R, size, gap, 0.05, 11))
}

/// One test: others in this process would be counted as well.
#[test]
fn a_bed_takes_little_memory_and_its_steps_none() {
    let (spec, grains) = bed();
    let n = grains.len();
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    one.install(|| {
        let before = LIVE.load(Relaxed);
        let mut dem = Dem::new(spec).unwrap();
        let mut state = dem.start(&grains).unwrap();
        run(&mut dem, &mut state, 0, 600, &Nothing);
        let taken = LIVE.load(Relaxed) - before;
        let contacts = state.contact_count() as usize;
        let counts = state.counts();
        println!("{} bytes per grain at {:.2} contacts", taken / n, contacts as f64 / n as f64);
        assert!(counts.builds > 2 && contacts > 2 * n, "{counts:?}, {contacts} contacts");
        // Rows, motion, forces and tags are 288 bytes a grain, lists and memory about 90 a contact, with a tenth of slack.
        assert!(taken < 400 * n + 64 * contacts, "{} bytes per grain", taken / n);

        let (calls, counts) = (CALLS.load(Relaxed), state.counts());
        run(&mut dem, &mut state, 600, 200, &Nothing);
        let more = state.counts();
        assert!(more.prunes > counts.prunes + 2, "{more:?}");
        assert_eq!(CALLS.load(Relaxed) - calls, 0, "allocations in {} steps", more.steps - counts.steps);
    });
}

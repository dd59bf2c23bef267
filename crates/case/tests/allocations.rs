//! A step takes no memory from the heap once the run is warm, the guards included.
#![allow(unsafe_code, reason = "an allocator that counts can only be written as one")]

use brazilnut_case::{Case, build};
use brazilnut_sim::{Simulation, Stage};
use std::alloc::{GlobalAlloc, Layout, System};
use std::path::PathBuf;
use std::sync::atomic::{AtomicU64, Ordering};

/// The allocator of the system, counting.
struct Counting;

static TAKEN: AtomicU64 = AtomicU64::new(0);

// SAFETY: every call is handed on to the system's allocator with its arguments unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        TAKEN.fetch_add(1, Ordering::Relaxed);
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        unsafe { System.dealloc(at, layout) }
    }

    unsafe fn realloc(&self, at: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        TAKEN.fetch_add(1, Ordering::Relaxed);
        unsafe { System.realloc(at, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// A shallow bed, thrown.
const BED: &str = r#"
model = "dry"
[cell]
size = ["6 mm", "6 mm", "9 mm"]
[shaking]
frequency = "50 Hz"
gamma = 4.0
[materials.bronze]
density = "8900 kg/m^3"
[[grains]]
name = "bronze"
material = "bronze"
count = 60
diameter = { mean = "1 mm", spread = 0.1 }
[contact]
stiffness = "1500 N/m"
restitution = 0.5
friction = 0.3
[fluid]
density = 1000
viscosity = "1 cP"
[time]
end = "10 s"
settle = "0.02 s"
"#;

/// Allocations in `steps` steps after `warm` steps of shaking.
fn taken(overrides: &[&str], warm: u64, steps: u64) -> u64 {
    let overrides: Vec<String> = overrides.iter().map(|o| (*o).to_string()).collect();
    let case =
        Case::parse(BED, "bed", PathBuf::new(), &overrides).unwrap_or_else(|e| panic!("{}", e.render(false)));
    let plan = build::build(&case).unwrap_or_else(|e| panic!("{}", e.render(false))).plan;
    let mut run = Simulation::new(plan).unwrap();
    while run.state().stage != Stage::Running || run.state().step < warm {
        run.step().unwrap();
    }
    let before = TAKEN.load(Ordering::Relaxed);
    for _ in 0..steps {
        run.step().unwrap();
    }
    TAKEN.load(Ordering::Relaxed) - before
}

// One test: the count is that of the whole process.
#[test]
fn a_warm_step_takes_no_memory() {
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    one.install(|| {
        let springs = &["model=fluid-springs", "fluid-springs.points_per_radius=3", "fluid-springs.c_s=0.5"];
        let rungs: [(&str, &[&str], u64, u64); 6] = [
            ("dry", &[], 12_000, 1500),
            ("dry, springs", &["contact.tangential=linear-spring", "contact.rolling=spring"], 12_000, 1500),
            ("simple-drag", &["model=simple-drag"], 12_000, 1500),
            ("local porosity", &["model=simple-drag", "simple-drag.porosity=local"], 12_000, 1500),
            ("navier-stokes", &["model=navier-stokes"], 40, 40),
            ("fluid-springs", springs, 200, 40),
        ];
        let counts: Vec<_> =
            rungs.map(|(name, overrides, warm, steps)| (name, taken(overrides, warm, steps))).to_vec();
        assert!(counts.iter().all(|c| c.1 == 0), "allocations in warm steps: {counts:?}");
    });
}

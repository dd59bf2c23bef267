//! What a solver keeps, and that a step allocates nothing.

#![allow(unsafe_code, reason = "an allocator that counts can only be written with it")]

use brazilnut_base::{Side, Tick, Vec3, vec3};
use brazilnut_fluid::{Boundary, Diffusion, FluidSpec, Grid, Medium, Scheme, Solver};
use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

/// The system's allocator, counting.
struct Counting;

static CALLS: AtomicU64 = AtomicU64::new(0);
static BYTES: AtomicU64 = AtomicU64::new(0);

// SAFETY: every call goes to the system's allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let _ = CALLS.fetch_add(1, Relaxed);
        let _ = BYTES.fetch_add(layout.size() as u64, Relaxed);
        // SAFETY: the caller keeps the contract of `alloc`.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        let _ = BYTES.fetch_sub(layout.size() as u64, Relaxed);
        // SAFETY: the caller keeps the contract of `dealloc`.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// One test in this program: counts of two at a time would mix.
#[test]
fn steps_allocate_nothing_and_a_solver_keeps_sixteen_words_a_cell() {
    // One thread: handing work to others allocates in the pool.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    pool.install(|| {
        for (cells, scheme, diffusion) in [
            ([64; 3], Scheme::FirstOrder, Diffusion::Explicit),
            ([64; 3], Scheme::SecondOrder, Diffusion::Explicit),
            ([64; 3], Scheme::SecondOrder, Diffusion::Implicit),
            ([180, 45, 18], Scheme::SecondOrder, Diffusion::Explicit),
            ([256, 1, 128], Scheme::SecondOrder, Diffusion::Explicit),
        ] {
            let flat = |n: usize| if n == 1 { Side::Flat } else { Side::Walls };
            let grid = Grid::new(cells, [0.01; 3], cells.map(flat));
            let count = grid.count() as f64;
            let mut spec = FluidSpec { scheme, diffusion, ..FluidSpec::new(grid, 1000.0, 1.0) };
            spec.sides[2][1] = Boundary::lid(vec3(0.1, 0.0, 0.0));
            let before = BYTES.load(Relaxed);
            let mut solver = Solver::new(spec).unwrap();
            let mut flow = solver.start();
            let mut step = |index: u64| {
                let tick = Tick::at(index, 1e-3);
                solver.advance(&mut flow, tick, Vec3::ZERO, &Medium::default(), |_| {});
                solver.health(&flow, tick).unwrap();
            };
            (0..2).for_each(&mut step);
            let words = (BYTES.load(Relaxed) - before) as f64 / 8.0 / count;
            let calls = CALLS.load(Relaxed);
            (2..6).for_each(&mut step);
            assert_eq!(CALLS.load(Relaxed), calls, "{cells:?} {scheme:?} {diffusion:?} allocates in a step");
            // Velocity, pressure, rates, prediction, pressure equation: 11 of the cell itself, the rest ghosts and padding.
            let most = if cells == [64; 3] { 16.0 } else { 20.0 };
            assert!(words < most, "{cells:?} {scheme:?} {diffusion:?}: {words:.1} words a cell");
        }
    });
}

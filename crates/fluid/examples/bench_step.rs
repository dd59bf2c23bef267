//! Times the pressure solve and the whole step, as ratios to the bandwidth of
//! memory and to the same solve through the library's transforms, all taken in
//! turn in one run.
//!
//! `cargo run --release -p brazilnut-fluid --example bench_step -- [seconds per grid] [grids...]`,
//! grids as `100x100x100`; `RAYON_NUM_THREADS` sets the threads.

use brazilnut_base::{Side, Tick, Vec3, vec3};
use brazilnut_fluid::pressure::{Poisson, Transforms};
use brazilnut_fluid::{Boundary, Flow, FluidSpec, Grid, Instructions, Medium, Scheme, Solver};
use rayon::prelude::*;
use std::time::Instant;

/// Words per cell that an explicit Adams-Bashforth step with one pressure solve must move.
const STEP_WORDS: f64 = 26.0;

/// Numbers in each array of the bandwidth measurement: far beyond every cache.
const STREAM: usize = 1 << 24;

/// Nanoseconds per word read or written by `a = b + s c`.
struct Stream([Vec<f64>; 3]);

impl Stream {
    fn new() -> Self {
        Self([vec![1.0; STREAM], vec![2.0; STREAM], vec![3.0; STREAM]])
    }

    fn run(&mut self) -> f64 {
        let [a, b, c] = &mut self.0;
        let start = Instant::now();
        let block = STREAM / 64;
        a.par_chunks_mut(block).zip(b.par_chunks(block)).zip(c.par_chunks(block)).for_each(|((a, b), c)| {
            for i in 0..a.len() {
                a[i] = b[i] + 0.5 * c[i];
            }
        });
        start.elapsed().as_secs_f64() * 1e9 / (3 * STREAM) as f64
    }
}

struct Case {
    name: &'static str,
    best: f64,
    run: Box<dyn FnMut()>,
}

fn poisson(name: &'static str, grid: &Grid, instructions: Instructions, transforms: Transforms) -> Case {
    let solver = Poisson::new(grid, [false; 2], instructions, transforms);
    let right: Vec<f64> = (0..solver.len()).map(|i| ((i * 7919) % 1013) as f64 - 506.0).collect();
    let mut data = right.clone();
    let mut count = 0;
    let run = move || {
        // Solved in place again and again the numbers would overflow.
        count += 1;
        if count % 8 == 0 {
            data.copy_from_slice(&right);
        }
        solver.solve(&mut data);
    };
    Case { name, best: f64::MAX, run: Box::new(run) }
}

fn step(name: &'static str, grid: &Grid, scheme: Scheme, instructions: Instructions) -> Case {
    let h = grid.spacing[0];
    let mut spec = FluidSpec::new(grid.clone(), 1000.0, 1.0);
    (spec.scheme, spec.instructions) = (scheme, instructions);
    spec.sides[2][1] = Boundary::lid(vec3(1.0, 0.0, 0.0));
    let mut solver = Solver::new(spec).expect("a plain box");
    let mut flow: Flow = solver.start();
    let dt = 0.05 * h;
    let mut index = 0;
    let run = move || {
        solver.advance(&mut flow, Tick::at(index, dt), Vec3::ZERO, &Medium::default(), |_| {});
        index += 1;
    };
    Case { name, best: f64::MAX, run: Box::new(run) }
}

fn main() {
    let mut arguments = std::env::args().skip(1);
    let seconds: f64 = arguments.next().and_then(|s| s.parse().ok()).unwrap_or(10.0);
    let mut grids: Vec<[usize; 3]> = arguments
        .filter_map(|g| g.split('x').map(|n| n.parse().ok()).collect::<Option<Vec<_>>>()?.try_into().ok())
        .collect();
    if grids.is_empty() {
        grids = vec![[100; 3], [128; 3], [180, 45, 180], [64; 3], [256; 3]];
    }
    let mut stream = Stream::new();
    println!("threads {}", rayon::current_num_threads());
    for cells in grids {
        let grid = Grid::new(cells, [1.0 / cells[0] as f64; 3], [Side::Walls; 3]);
        let (best, plain) = (Instructions::Best, Instructions::Portable);
        let mut cases = [
            poisson("poisson", &grid, best, Transforms::Best),
            poisson("poisson portable", &grid, plain, Transforms::Best),
            poisson("poisson library", &grid, best, Transforms::Library),
            step("step first-order", &grid, Scheme::FirstOrder, best),
            step("step second-order", &grid, Scheme::SecondOrder, best),
            step("step second-order portable", &grid, Scheme::SecondOrder, plain),
        ];
        let mut word = f64::MAX;
        let start = Instant::now();
        while start.elapsed().as_secs_f64() < seconds {
            word = word.min(stream.run());
            for case in &mut cases {
                for _ in 0..3 {
                    let start = Instant::now();
                    (case.run)();
                    case.best = case.best.min(start.elapsed().as_secs_f64() * 1e9 / grid.count() as f64);
                }
            }
        }
        println!("\n{cells:?}: a word of memory costs {word:.3} ns ({:.1} GB/s)", 8.0 / word);
        println!("{:28} {:>8} {:>14} {:>12}", "", "ns/cell", "26-word moves", "/ library");
        let library = cases[2].best;
        for case in &cases {
            let floor = case.best / (STEP_WORDS * word);
            println!("{:28} {:8.2} {:14.2} {:12.2}", case.name, case.best, floor, case.best / library);
        }
    }
}

//! The pressure solve and the whole step of the fluid, as ratios: to the same solve through the lines of rustfft
//! (the library), and to the time that memory takes to move the words of a step; all taken in turn. The claims:
//! the solve at least 3 times as fast as the library's, a first-order step at most 3.5 times the time to move
//! 26 words a cell, a second-order step at most twice a first-order one. See `benches/README.md`.

use brazilnut_base::{Side, Tick, Vec3, vec3};
use brazilnut_benches::Clock;
use brazilnut_fluid::pressure::{Poisson, Transforms};
use brazilnut_fluid::{Boundary, FluidSpec, Grid, Instructions, Medium, Scheme, Solver};
use clap::Parser;
use rayon::prelude::*;
use std::error::Error;

/// Words per cell that an explicit Adams-Bashforth step with one pressure solve must move.
const STEP_WORDS: f64 = 26.0;

/// Numbers in each array of the bandwidth measurement: far beyond every cache.
const STREAM: usize = 1 << 24;

/// Contestants that the others are rated by.
const LIBRARY: &str = "poisson library";
const FIRST: &str = "step first-order";

/// Speed of the pressure solve and of the step of the fluid, as ratios.
#[derive(Parser)]
struct Args {
    /// Time for each grid and number of threads, s; the best of each contestant counts.
    #[arg(long, default_value_t = 10.0)]
    seconds: f64,
    /// Grids.
    #[arg(
        long,
        value_delimiter = ',',
        value_parser = cells,
        default_value = "100x100x100,128x128x128,180x45x180,64x64x64,256x256x256"
    )]
    grids: Vec<[usize; 3]>,
    /// Only contestants whose names start so, e.g. `poisson`.
    #[arg(long, default_value = "")]
    only: String,
    /// Numbers of threads.
    #[arg(long, value_delimiter = ',', default_value = "1,2")]
    threads: Vec<usize>,
    /// Given by cargo.
    #[arg(long, hide = true)]
    bench: bool,
}

fn cells(text: &str) -> Result<[usize; 3], String> {
    let all: Result<Vec<usize>, _> = text.split('x').map(str::parse).collect();
    all.ok()
        .and_then(|n| n.try_into().ok())
        .ok_or_else(|| format!("`{text}` should be three numbers, e.g. 100x100x100"))
}

/// Time per word read or written by `a = b + s c`.
struct Stream([Vec<f64>; 3]);

impl Stream {
    fn new() -> Self {
        Self([vec![1.0; STREAM], vec![2.0; STREAM], vec![3.0; STREAM]])
    }

    /// Nanoseconds per word.
    fn run(&mut self, threads: usize) -> f64 {
        let [a, b, c] = &mut self.0;
        let clock = Clock::start();
        let block = STREAM / 64;
        a.par_chunks_mut(block).zip(b.par_chunks(block)).zip(c.par_chunks(block)).for_each(|((a, b), c)| {
            for i in 0..a.len() {
                a[i] = b[i] + 0.5 * c[i];
            }
        });
        clock.lap().seconds(threads) * 1e9 / (3 * STREAM) as f64
    }
}

struct Contestant {
    name: &'static str,
    /// What is claimed of it.
    must: &'static str,
    /// Least time so far, ns per cell.
    best: f64,
    run: Box<dyn FnMut()>,
}

/// All contestants on `grid`, or those that `only` leaves.
fn contestants(grid: &Grid, only: &str) -> Vec<Contestant> {
    type Make = fn(&Grid) -> Box<dyn FnMut()>;
    use Instructions::{Best, Portable};
    let all: [(&str, &str, Make); 6] = [
        ("poisson", "library / at least 3", |g| poisson(g, Best, Transforms::Best)),
        ("poisson portable", "", |g| poisson(g, Portable, Transforms::Best)),
        (LIBRARY, "", |g| poisson(g, Best, Transforms::Library)),
        (FIRST, "at most 3.5 moves", |g| step(g, Scheme::FirstOrder, Best)),
        ("step second-order", "/ first-order at most 2", |g| step(g, Scheme::SecondOrder, Best)),
        ("step second-order portable", "", |g| step(g, Scheme::SecondOrder, Portable)),
    ];
    all.into_iter()
        .filter(|c| c.0.starts_with(only))
        .map(|(name, must, make)| Contestant { name, must, best: f64::INFINITY, run: make(grid) })
        .collect()
}

fn poisson(grid: &Grid, instructions: Instructions, transforms: Transforms) -> Box<dyn FnMut()> {
    let solver = Poisson::new(grid, [false; 2], instructions, transforms);
    let right: Vec<f64> = (0..solver.len()).map(|i| ((i * 7919) % 1013) as f64 - 506.0).collect();
    let mut data = right.clone();
    let mut count = 0;
    Box::new(move || {
        // Solved in place again and again the numbers would overflow.
        count += 1;
        if count % 8 == 0 {
            data.copy_from_slice(&right);
        }
        solver.solve(&mut data);
    })
}

fn step(grid: &Grid, scheme: Scheme, instructions: Instructions) -> Box<dyn FnMut()> {
    let h = grid.spacing[0];
    let mut spec = FluidSpec::new(grid.clone(), 1000.0, 1.0);
    (spec.scheme, spec.instructions) = (scheme, instructions);
    spec.sides[2][1] = Boundary::lid(vec3(1.0, 0.0, 0.0));
    let mut solver = Solver::new(spec).expect("a plain box");
    let mut flow = solver.start();
    let dt = 0.05 * h;
    let mut index = 0;
    Box::new(move || {
        solver.advance(&mut flow, Tick::at(index, dt), Vec3::ZERO, &Medium::default(), |_| {});
        index += 1;
    })
}

fn main() -> Result<(), Box<dyn Error>> {
    let args = Args::parse();
    let mut stream = Stream::new();
    println!("best of {} s; ratios are those of the best", args.seconds);
    for &cells in &args.grids {
        for &threads in &args.threads {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
            pool.install(|| bench(&args, cells, threads, &mut stream));
        }
    }
    Ok(())
}

/// All contestants in turn, so that a busy machine slows all of them.
fn bench(args: &Args, cells: [usize; 3], threads: usize, stream: &mut Stream) {
    let grid = Grid::new(cells, [1.0 / cells[0] as f64; 3], [Side::Walls; 3]);
    let mut all = contestants(&grid, &args.only);
    let mut word = f64::INFINITY;
    let whole = Clock::start();
    loop {
        word = word.min(stream.run(threads));
        for one in &mut all {
            for _ in 0..3 {
                let clock = Clock::start();
                (one.run)();
                one.best = one.best.min(clock.lap().seconds(threads) * 1e9 / grid.count() as f64);
            }
        }
        if whole.lap().wall >= args.seconds {
            break;
        }
    }
    println!(
        "\n{cells:?}, {threads} thread(s): a word of memory costs {word:.3} ns ({:.1} GB/s)  [{:.2} processors]",
        8.0 / word,
        whole.lap().processors()
    );
    println!(
        "{:28} {:>8} {:>14} {:>10} {:>10} {:>14}  must",
        "", "ns/cell", "26-word moves", "/ library", "library /", "/ first-order"
    );
    let best = |name: &str| all.iter().find(|c| c.name == name).map(|c| c.best);
    let shown = |ratio: Option<f64>| ratio.map_or("-".into(), |r| format!("{r:.2}"));
    let (library, first) = (best(LIBRARY), best(FIRST));
    for one in &all {
        println!(
            "{:28} {:8.2} {:14.2} {:>10} {:>10} {:>14}  {}",
            one.name,
            one.best,
            one.best / (STEP_WORDS * word),
            shown(library.map(|l| one.best / l)),
            shown(library.map(|l| l / one.best)),
            shown(first.filter(|_| one.name.starts_with("step")).map(|f| one.best / f)),
            one.must
        );
    }
}

//! Speed of whole steps on the peers' beds, as a ratio to this engine's own plain sweep in the same run.
//!
//! `bench_beds START_FOLDER [CASES] [THREADS] [REPEATS] [SWEEPS]`, e.g. `bench_beds start ABD 1,2 3 plain,fast`.
//! `START_FOLDER` holds `A.txt.gz` and `bed20k.txt.gz`: a line `N Lx Ly`, then
//! `x y z vx vy vz wx wy wz radius` per grain, SI. Case C is the bed of B laid 5 x 2.

use brazilnut_base::motion::{Harmonic, Motion};
use brazilnut_base::{Cell, Side, Tick, Vec3, vec3};
use brazilnut_grains::contact::{NormalLaw, RollingLaw, TangentialLaw};
use brazilnut_grains::material::Elastic;
use brazilnut_grains::{
    ContactSpec, Dem, DemSpec, DemState, Grains, Gravity, Integrator, Limits, Material, PairSpec, PairTable,
    Search, Sweep, WallShape, WallSpec,
};
use std::f64::consts::{FRAC_PI_2, PI};
use std::io::Read;
use std::path::Path;
use std::time::Instant;

const FIELD: Gravity = Gravity(vec3(0.0, 0.0, -9.81));

struct Case {
    name: char,
    spec: DemSpec,
    grains: Grains,
    warm: u64,
    steps: u64,
    must: f64,
}

fn main() {
    let args: Vec<String> = std::env::args().collect();
    let Some(folder) = args.get(1) else {
        eprintln!("usage: bench_beds START_FOLDER [CASES] [THREADS] [REPEATS] [SWEEPS]");
        std::process::exit(2);
    };
    let cases = args.get(2).map_or("ABD", String::as_str);
    let threads: Vec<usize> = args
        .get(3)
        .map_or("1,2", String::as_str)
        .split(',')
        .map(|t| t.parse().expect("a number of threads"))
        .collect();
    let repeats: usize = args.get(4).map_or(3, |r| r.parse().expect("a number of repeats"));
    let sweeps = args.get(5).map_or("plain,portable,fast", String::as_str);
    println!(
        "case threads  plain  portable  fast   [M particle-steps/s, best of {repeats}]   fast/plain (must)  builds prunes contacts/grain"
    );
    for name in cases.chars() {
        let case = case(name, Path::new(folder));
        for &t in &threads {
            if name == 'A' && t > 1 {
                continue;
            }
            let pool = rayon::ThreadPoolBuilder::new().num_threads(t).build().expect("threads");
            pool.install(|| bench(&case, t, repeats, sweeps));
        }
    }
}

/// Alternates the sweeps, so that a busy machine slows all of them.
fn bench(case: &Case, threads: usize, repeats: usize, wanted: &str) {
    let sweeps = [Sweep::Plain, Sweep::Portable, Sweep::Fast];
    let mut best = [0.0_f64; 3];
    let mut last = String::new();
    for _ in 0..repeats {
        for (k, sweep) in sweeps.into_iter().enumerate() {
            if !wanted.contains(["plain", "portable", "fast"][k]) {
                continue;
            }
            let mut spec = case.spec.clone();
            spec.search.sweep = sweep;
            let mut dem = Dem::new(spec).expect("a valid case");
            let mut state = dem.start(&case.grains).expect("valid grains");
            run(&mut dem, &mut state, 0, case.warm);
            let before = state.counts();
            let clock = Clock::start();
            run(&mut dem, &mut state, case.warm, case.steps);
            let rate = case.grains.len() as f64 * case.steps as f64 / clock.seconds(threads) / 1e6;
            best[k] = best[k].max(rate);
            let after = state.counts();
            last = format!(
                "{:6} {:6} {:6.2}",
                after.builds - before.builds,
                after.prunes - before.prunes,
                state.contact_count() as f64 / case.grains.len() as f64
            );
        }
    }
    println!(
        "{:>4} {threads:>7} {:>6.1} {:>9.1} {:>5.1} {:>38.2} ({:.1}) {last}",
        case.name,
        best[0],
        best[1],
        best[2],
        best[2] / best[0],
        case.must
    );
}

/// Time of this process on its processor for one thread, which other jobs on the machine disturb least; wall
/// time for several threads.
struct Clock {
    wall: Instant,
    cpu: Option<f64>,
}

impl Clock {
    fn start() -> Self {
        Self { wall: Instant::now(), cpu: cpu_seconds() }
    }

    fn seconds(&self, threads: usize) -> f64 {
        let wall = self.wall.elapsed().as_secs_f64();
        match (self.cpu, cpu_seconds()) {
            (Some(from), Some(to)) if threads == 1 => to - from,
            _ => wall,
        }
    }
}

/// User time of this process where the system tells, in hundredths of a second.
fn cpu_seconds() -> Option<f64> {
    let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
    let ticks: f64 = stat.rsplit(')').next()?.split_whitespace().nth(11)?.parse().ok()?;
    Some(ticks / 100.0)
}

fn run(dem: &mut Dem, state: &mut DemState, first: u64, steps: u64) {
    let dt = dem.spec().dt;
    for k in first..first + steps {
        dem.advance(state, Tick::at(k, dt), &FIELD);
    }
}

fn case(name: char, folder: &Path) -> Case {
    let file = if name == 'A' { "A.txt.gz" } else { "bed20k.txt.gz" };
    let (density, height) = if name == 'A' { (1200.0, 60.0) } else { (2500.0, 0.5) };
    let (tiles, warm, steps, must) = match name {
        'A' => ([1, 1], 20_000, 100_000, 1.1),
        'B' => ([1, 1], 500, 2000, 2.0),
        'D' => ([1, 1], 500, 2000, 1.8),
        'C' => ([5, 2], 100, 200, 1.4),
        other => panic!("no case {other}"),
    };
    let (grains, size) = read(&folder.join(file), density, tiles);
    let (amplitude, frequency, dt) =
        if name == 'A' { (0.05, 7.0, 6.3e-5) } else { (0.003_313_202_7, 15.0, 2e-6) };
    let elastic = Some(Elastic { youngs_modulus: 7e9, poisson_ratio: 0.24 });
    let (normal, tangential, rotation, pair) = match name {
        'A' => (
            NormalLaw::Linear,
            TangentialLaw::None,
            false,
            PairSpec { stiffness: Some(2.8e6), restitution: 0.9, ..PairSpec::default() },
        ),
        'D' => (
            NormalLaw::Linear,
            TangentialLaw::Coulomb,
            false,
            PairSpec { stiffness: Some(3000.0), restitution: 0.2, friction: 0.2, ..PairSpec::default() },
        ),
        _ => (
            NormalLaw::Hertz,
            TangentialLaw::Mindlin,
            true,
            PairSpec { restitution: 0.8, friction: 0.5, ..PairSpec::default() },
        ),
    };
    let spec = DemSpec {
        cell: Cell {
            size: vec3(size[0], size[1], height),
            sides: [Side::Periodic, Side::Periodic, Side::Walls],
        },
        materials: vec![Material { name: "glass".into(), density, elastic }],
        contact: ContactSpec {
            normal,
            tangential,
            rolling: RollingLaw::None,
            pairs: PairTable::uniform(1, pair),
        },
        walls: vec![WallSpec {
            name: "floor".into(),
            // The peers start from the lowest point: z = A (1 - cos wt).
            shape: WallShape::Plane { point: vec3(0.0, 0.0, amplitude), normal: Vec3::Z },
            material: 0,
            motion: Motion {
                harmonics: vec![Harmonic {
                    amplitude: vec3(0.0, 0.0, amplitude),
                    frequency,
                    phase: vec3(0.0, 0.0, -FRAC_PI_2),
                }],
                ramp: 0.0,
            },
        }],
        integrator: Integrator::VelocityVerlet,
        rotation,
        dt,
        limits: Limits::default(),
        search: Search::default(),
    };
    Case { name, spec, grains, warm, steps, must }
}

/// Reads a start state and lays it `tiles` times side by side.
fn read(path: &Path, density: f64, tiles: [usize; 2]) -> (Grains, [f64; 2]) {
    let file = std::fs::File::open(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let mut text = String::new();
    flate2::read::GzDecoder::new(file).read_to_string(&mut text).expect("gzip text");
    let mut lines = text.lines();
    let head: Vec<f64> = numbers(lines.next().expect("a first line"));
    let size = [head[1], head[2]];
    let rows: Vec<Vec<f64>> = lines.map(numbers).collect();
    let mut grains = Grains::default();
    for x in 0..tiles[0] {
        for y in 0..tiles[1] {
            let shift = vec3(x as f64 * size[0], y as f64 * size[1], 0.0);
            for row in &rows {
                let r = row[9];
                let m = density * 4.0 / 3.0 * PI * r * r * r;
                grains.push(0, 0, r, m, 0.4 * m * r * r, vec3(row[0], row[1], row[2]) + shift);
                let k = grains.len() - 1;
                grains.velocity[k] = vec3(row[3], row[4], row[5]);
                grains.angular_velocity[k] = vec3(row[6], row[7], row[8]);
            }
        }
    }
    (grains, [size[0] * tiles[0] as f64, size[1] * tiles[1] as f64])
}

fn numbers(line: &str) -> Vec<f64> {
    line.split_whitespace().map(|w| w.parse().expect("a number")).collect()
}

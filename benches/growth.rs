//! How the cost of a step grows with the number of grains: prints the exponent of cost against N, which must be
//! at most 1.1. One settled bed, periodic sideways, is laid side by side into beds of 10³ to 10⁵ grains, so that
//! all have the same contacts per grain. One thread. See `benches/README.md`.

use brazilnut_base::{Cell, Side, Tick, Vec3, vec3};
use brazilnut_benches::Clock;
use brazilnut_grains::contact::{NormalLaw, RollingLaw, TangentialLaw};
use brazilnut_grains::packing::{Filling, Placement, Sizes, Species};
use brazilnut_grains::{
    ContactSpec, Dem, DemSpec, Grains, Gravity, Integrator, Limits, Material, PairSpec, PairTable, Search,
    WallShape, WallSpec,
};
use clap::Parser;
use std::error::Error;

const FIELD: Gravity = Gravity(vec3(0.0, 0.0, -9.81));
/// Grains of the bed that is repeated.
const TILE: usize = 1000;
/// Base edge and height of its cell, m.
const EDGE: [f64; 2] = [10e-3, 25e-3];
/// Beds along x and y.
const TILES: [[usize; 2]; 5] = [[1, 1], [3, 1], [5, 2], [6, 5], [10, 10]];

/// Largest exponent.
const MUST: f64 = 1.1;

/// How the cost of a step of the grain engine grows with the number of grains.
#[derive(Parser)]
struct Args {
    /// Repeats; the best of each size counts.
    #[arg(long, default_value_t = 3)]
    repeats: usize,
    /// Given by cargo.
    #[arg(long, hide = true)]
    bench: bool,
}

fn main() -> Result<(), Box<dyn Error>> {
    let args = Args::parse();
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    one.install(|| bench(args.repeats));
    Ok(())
}

fn bench(repeats: usize) {
    let tile = settled();
    println!("{:>8} {:>16} {:>14} {:>8}", "grains", "contacts/grain", "ns/grain/step", "steps");
    let mut points = vec![];
    // The sizes take turns, so that a busy machine slows all of them.
    let mut best = [f64::INFINITY; TILES.len()];
    let mut contacts = [0.0; TILES.len()];
    for _ in 0..repeats {
        for (k, [nx, ny]) in TILES.into_iter().enumerate() {
            let grains = laid(&tile, nx, ny);
            let mut dem = Dem::new(spec(nx, ny)).expect("a valid bed");
            let mut state = dem.start(&grains).expect("valid grains");
            let steps = steps(grains.len());
            let dt = dem.spec().dt;
            for i in 0..steps {
                dem.advance(&mut state, Tick::at(i, dt), &FIELD);
            }
            let clock = Clock::start();
            for i in steps..2 * steps {
                dem.advance(&mut state, Tick::at(i, dt), &FIELD);
            }
            best[k] = best[k].min(clock.lap().seconds(1) / steps as f64);
            contacts[k] = state.contact_count() as f64 / grains.len() as f64;
        }
    }
    for (k, [nx, ny]) in TILES.into_iter().enumerate() {
        let n = TILE * nx * ny;
        println!("{n:>8} {:>16.3} {:>14.1} {:>8}", contacts[k], 1e9 * best[k] / n as f64, steps(n));
        points.push([(n as f64).ln(), best[k].ln()]);
    }
    println!("exponent of cost per step against N: {:.3} (must be at most {MUST})", slope(&points));
}

/// Equal work at every size.
fn steps(n: usize) -> u64 {
    (4_000_000 / n).max(40) as u64
}

/// Slope of the line of least squares.
fn slope(points: &[[f64; 2]]) -> f64 {
    let n = points.len() as f64;
    let mean = |c: usize| points.iter().map(|p| p[c]).sum::<f64>() / n;
    let (x, y) = (mean(0), mean(1));
    let top: f64 = points.iter().map(|p| (p[0] - x) * (p[1] - y)).sum();
    top / points.iter().map(|p| (p[0] - x).powi(2)).sum::<f64>()
}

fn cell(nx: usize, ny: usize) -> Cell {
    Cell {
        size: vec3(EDGE[0] * nx as f64, EDGE[0] * ny as f64, EDGE[1]),
        sides: [Side::Periodic, Side::Periodic, Side::Walls],
    }
}

fn spec(nx: usize, ny: usize) -> DemSpec {
    let pair = PairSpec { stiffness: Some(1500.0), restitution: 0.5, friction: 0.3, ..PairSpec::default() };
    let floor = WallSpec {
        name: "floor".into(),
        shape: WallShape::Plane { point: Vec3::ZERO, normal: Vec3::Z },
        material: 0,
        motion: Default::default(),
    };
    DemSpec {
        cell: cell(nx, ny),
        materials: vec![Material { name: "glass".into(), density: 2500.0, elastic: None }],
        contact: ContactSpec {
            normal: NormalLaw::Linear,
            tangential: TangentialLaw::Coulomb,
            rolling: RollingLaw::None,
            pairs: PairTable::uniform(1, pair),
        },
        walls: vec![floor],
        integrator: Integrator::default(),
        rotation: true,
        dt: 3e-6,
        limits: Limits::default(),
        search: Search::default(),
    }
}

/// A thousand grains at rest on the floor.
fn settled() -> Grains {
    let species = Species {
        name: "glass".into(),
        material: 0,
        density: 2500.0,
        sizes: Sizes::single(1e-3),
        count: TILE,
        at: vec![],
        velocity: Vec3::ZERO,
        region: None,
    };
    let placement = Placement::Lattice { gap: 0.2, jitter: 0.5, mixed: true };
    let start = placement.place(&Filling::new(cell(1, 1), vec![species], 1)).expect("room for all");
    let mut dem = Dem::new(spec(1, 1)).expect("a valid bed");
    let mut state = dem.start(&start).expect("valid grains");
    let dt = dem.spec().dt;
    for i in 0..50_000 {
        dem.advance(&mut state, Tick::at(i, dt), &FIELD);
    }
    let mut grains = Grains::default();
    dem.export(&state, &mut grains);
    grains
}

/// The bed repeated along x and y.
fn laid(tile: &Grains, nx: usize, ny: usize) -> Grains {
    let mut all = Grains::default();
    for (i, j) in (0..nx).flat_map(|i| (0..ny).map(move |j| (i, j))) {
        let shift = vec3(EDGE[0] * i as f64, EDGE[0] * j as f64, 0.0);
        for k in 0..tile.len() {
            let (r, m) = (tile.radius[k], tile.mass[k]);
            all.push(0, 0, r, m, 0.4 * m * r * r, tile.position[k] + shift);
            let last = all.len() - 1;
            all.velocity[last] = tile.velocity[k];
        }
    }
    all
}

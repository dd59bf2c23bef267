//! Beds and engines that several tests share.
#![allow(dead_code, reason = "each test file uses its part")]

use brazilnut_base::motion::Motion;
use brazilnut_base::random::stream;
use brazilnut_base::{Cell, Side, Tick, Vec3, vec3};
use brazilnut_grains::contact::{NormalLaw, RollingLaw, TangentialLaw};
use brazilnut_grains::{
    ContactSpec, Dem, DemSpec, DemState, Field, Grains, Integrator, Limits, Material, PairSpec, PairTable,
    Search, WallShape, WallSpec,
};
use rand::RngExt;
use std::f64::consts::PI;

pub const DENSITY: f64 = 2500.0;

/// Linear springs, frictionless, no walls, in a periodic cell of edge `l`.
pub fn spec(l: f64, side: Side, dt: f64, pair: PairSpec) -> DemSpec {
    DemSpec {
        cell: Cell { size: Vec3::splat(l), sides: [side; 3] },
        materials: vec![Material { name: "glass".into(), density: DENSITY, elastic: None }],
        contact: ContactSpec {
            normal: NormalLaw::Linear,
            tangential: TangentialLaw::None,
            rolling: RollingLaw::None,
            pairs: PairTable::uniform(1, pair),
        },
        walls: vec![],
        integrator: Integrator::VelocityVerlet,
        rotation: false,
        dt,
        limits: Limits::default(),
        search: Search::default(),
    }
}

pub fn pair(stiffness: f64, restitution: f64) -> PairSpec {
    PairSpec { stiffness: Some(stiffness), restitution, ..PairSpec::default() }
}

pub fn plane(name: &str, point: Vec3, normal: Vec3) -> WallSpec {
    WallSpec {
        name: name.into(),
        shape: WallShape::Plane { point, normal },
        material: 0,
        motion: Motion::default(),
    }
}

/// The six walls of a box.
pub fn box_walls(size: Vec3) -> Vec<WallSpec> {
    let mut walls = vec![];
    for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
        let mut n = Vec3::ZERO;
        n[axis] = 1.0;
        walls.push(plane(&format!("{name} low"), Vec3::ZERO, n));
        walls.push(plane(&format!("{name} high"), n * size[axis], -n));
    }
    walls
}

pub fn mass(r: f64) -> f64 {
    DENSITY * 4.0 / 3.0 * PI * r * r * r
}

/// Adds a sphere.
pub fn add(grains: &mut Grains, r: f64, x: Vec3, v: Vec3) {
    let m = mass(r);
    grains.push(0, 0, r, m, 0.4 * m * r * r, x);
    let k = grains.len() - 1;
    grains.velocity[k] = v;
}

/// `n` spheres of radius `r` (spread by a fifth) on a jittered lattice that fills the cell from its
/// low corner, with random velocities up to `speed` and spins to match.
pub fn cloud(n: usize, r: f64, size: Vec3, gap: f64, speed: f64, seed: u64) -> Grains {
    let mut grains = Grains::default();
    let pitch = 2.0 * r * gap;
    let count = (size / pitch).floor();
    let (nx, ny) = (count.x as usize, count.y as usize);
    assert!(n <= nx * ny * count.z as usize, "the cloud does not fit");
    let mut rng = stream(seed, "cloud", 0);
    let mut any = || 2.0 * rng.random::<f64>() - 1.0;
    for k in 0..n {
        let cell = vec3((k % nx) as f64, (k / nx % ny) as f64, (k / nx / ny) as f64);
        let jitter = vec3(any(), any(), any()) * 0.1 * r;
        let v = vec3(any(), any(), any()) * speed;
        add(&mut grains, r * (0.9 + 0.1 * any()), (cell + 0.5) * pitch + jitter, v);
        grains.angular_velocity[k] = vec3(any(), any(), any()) * speed / r;
    }
    grains
}

/// Takes `n` steps from step `first`.
pub fn run<F: Field>(dem: &mut Dem, state: &mut DemState, first: u64, n: u64, field: &F) {
    let dt = dem.spec().dt;
    for k in first..first + n {
        dem.advance(state, Tick::at(k, dt), field);
        dem.health(state, Tick::at(k, dt)).unwrap();
    }
}

pub fn export(dem: &Dem, state: &DemState) -> Grains {
    let mut g = Grains::default();
    dem.export(state, &mut g);
    g
}

/// All bits of what the grains do.
pub fn bits(g: &Grains) -> Vec<u64> {
    let mut all = vec![];
    for k in 0..g.len() {
        for v in [g.position[k], g.velocity[k], g.angular_velocity[k]] {
            all.extend(v.to_array().map(f64::to_bits));
        }
        all.extend(g.orientation[k].to_array().map(f64::to_bits));
    }
    all
}

/// A field that does nothing.
pub struct Nothing;

impl Field for Nothing {
    fn push(&self, _: &Tick, _: &brazilnut_grains::GrainAt) -> brazilnut_grains::Push {
        brazilnut_grains::Push::default()
    }
}

//! What no contact may change, and where the energy goes.

mod common;

use brazilnut_base::motion::Motion;
use brazilnut_base::{Side, Tick, Vec3, vec3};
use brazilnut_grains::contact::{NormalLaw, TangentialLaw};
use brazilnut_grains::{Dem, DemSpec, Field, GrainAt, Grains, Gravity, Ledger, PairSpec, Push};
use common::*;
use std::f64::consts::{PI, TAU};

fn momenta(g: &Grains) -> (Vec3, f64) {
    let p = (0..g.len()).map(|k| g.mass[k] * g.velocity[k]).sum();
    (p, (0..g.len()).map(|k| g.mass[k] * g.velocity[k].length()).sum())
}

fn angular_momentum(g: &Grains) -> (Vec3, f64) {
    let (mut l, mut sum) = (Vec3::ZERO, 0.0);
    for k in 0..g.len() {
        let part = g.mass[k] * g.position[k].cross(g.velocity[k]);
        l += part + g.inertia[k] * g.angular_velocity[k];
        sum += part.length();
    }
    (l, sum)
}

#[test]
fn an_isolated_cloud_keeps_its_momentum() {
    let (r, k) = (1e-3, 1e4);
    let dt = PI * (mass(r) / 2.0 / k).sqrt() / 30.0;
    for side in [Side::Periodic, Side::Walls] {
        let l = if side == Side::Periodic { 0.021 } else { 1.0 };
        let mut s = spec(l, side, dt, PairSpec { friction: 0.5, ..pair(k, 0.8) });
        s.contact.tangential = TangentialLaw::Coulomb;
        s.rotation = true;
        s.search.all_pairs_below = 100;
        s.search.block = 100;
        let mut dem = Dem::new(s).unwrap();
        let mut g = cloud(700, r, Vec3::splat(0.021), 1.05, 1.0, 3);
        if side == Side::Walls {
            for x in &mut g.position {
                *x += 0.5;
            }
        }
        let mut state = dem.start(&g).unwrap();
        let (before, scale) = momenta(&g);
        let (turning, arm) = angular_momentum(&g);
        let mut touched = 0;
        for i in 0..500 {
            run(&mut dem, &mut state, i, 1, &Nothing);
            touched += state.contact_count();
        }
        assert!(touched > 10_000, "{touched}");
        let out = export(&dem, &state);
        let (after, _) = momenta(&out);
        // Each of the 500 steps rounds each of 700 velocities once: 1e-16 * sqrt(350 000).
        assert!((after - before).length() < 1e-13 * scale, "{side:?}: {}", (after - before).length() / scale);
        if side == Side::Walls {
            let (l, _) = angular_momentum(&out);
            // Exact in the forces; positions and predicted velocities belong to one instant only up to
            // second order in the step (the orbits' own error).
            assert!((l - turning).length() < 2e-5 * arm, "{}", (l - turning).length() / arm);
        }
    }
}

/// The frame of a vertically shaken cell, with gravity and a drag.
struct Shaken {
    amplitude: f64,
    frequency: f64,
    drag: f64,
}

impl Field for Shaken {
    fn push(&self, tick: &Tick, g: &GrainAt) -> Push {
        let w = TAU * self.frequency;
        let a = -self.amplitude * w * w * (w * tick.time).sin();
        Push {
            gravity: vec3(0.0, 0.0, -9.81 * g.mass),
            frame: vec3(0.0, 0.0, -a * g.mass),
            fluid: -self.drag * g.mass * g.velocity,
            torque: Vec3::ZERO,
        }
    }
}

/// A bed of 24 frictional grains in a narrow box, 30 steps per contact.
fn bed(change: impl Fn(&mut DemSpec)) -> (Dem, Grains) {
    let (r, k, e) = (1e-3, 200.0, 0.8);
    let dt = PI * (mass(0.8 * r) / 2.0 / k).sqrt() / 30.0;
    let size = vec3(6.0 * r, 6.0 * r, 100.0 * r);
    let mut s = spec(0.0, Side::Walls, dt, PairSpec { friction: 0.5, ..pair(k, e) });
    s.cell.size = size;
    s.walls = box_walls(size);
    s.contact.tangential = TangentialLaw::Coulomb;
    s.rotation = true;
    change(&mut s);
    (Dem::new(s).unwrap(), cloud(24, r, vec3(6.0 * r, 6.0 * r, 40.0 * r), 1.1, 0.1, 5))
}

/// Energy ledger after 100 cycles of 40 Hz at about 3 g.
fn shake(mut dem: Dem, grains: &Grains, field: &impl Field) -> Ledger {
    let mut state = dem.start(grains).unwrap();
    let steps = (100.0 / 40.0 / dem.spec().dt) as u64;
    run(&mut dem, &mut state, 0, steps, field);
    dem.ledger(&state)
}

fn closes(l: &Ledger, terms: &[(&str, f64)]) {
    let put_in = l.supplied();
    let residual = l.residual() / put_in;
    println!("residual {residual:.2e} of {put_in:.3e} J; {l:?}");
    assert!(residual.abs() < 0.01, "{residual}: {l:?}");
    for (name, value) in terms {
        // Without any one of its terms the balance would not close.
        assert!(((l.residual() - value) / put_in).abs() > 0.01, "{name} does not matter: {value}");
    }
}

#[test]
fn the_ledger_of_a_shaken_cell_closes() {
    let (dem, grains) = bed(|_| {});
    let l = shake(dem, &grains, &Shaken { amplitude: 0.5e-3, frequency: 40.0, drag: 3.0 });
    closes(&l, &[("frame", l.frame), ("fluid", l.fluid), ("damping", l.damping), ("sliding", l.sliding)]);
    assert!(l.tangential_damping > 0.0);
    assert_eq!(l.walls, 0.0);
}

#[test]
fn the_ledger_of_a_moving_floor_closes() {
    let (dem, grains) = bed(|s| {
        s.walls[4].motion = Motion::vertical(0.5e-3, 40.0);
        s.search.sweep = brazilnut_grains::Sweep::Plain;
    });
    let l = shake(dem, &grains, &Gravity(vec3(0.0, 0.0, -9.81)));
    closes(&l, &[("walls", l.walls), ("damping", l.damping), ("sliding", l.sliding)]);
}

#[test]
fn the_ledger_of_the_other_laws_closes() {
    let gravity = Gravity(vec3(0.0, 0.0, -9.81));
    for (normal, tangential) in [
        (NormalLaw::WaltonBraun, TangentialLaw::WaltonBraun),
        (NormalLaw::Linear, TangentialLaw::LinearSpring),
    ] {
        let (dem, grains) = bed(|s| {
            s.walls[4].motion = Motion::vertical(0.5e-3, 40.0);
            s.contact.normal = normal;
            s.contact.tangential = tangential;
        });
        let l = shake(dem, &grains, &gravity);
        let lost = if normal == NormalLaw::Linear { l.damping } else { l.hysteresis };
        closes(&l, &[("walls", l.walls), ("normal loss", lost), ("sliding", l.sliding)]);
    }
}

/// Gravity's work and potential energy kept in motion: closes while falling, too.
#[test]
fn falling_is_booked_as_work_of_gravity() {
    let (mut dem, grains) = bed(|_| {});
    let mut state = dem.start(&grains).unwrap();
    run(&mut dem, &mut state, 0, 200, &Gravity(vec3(0.0, 0.0, -9.81)));
    let out = export(&dem, &state);
    let fallen: f64 =
        (0..out.len()).map(|k| out.mass[k] * 9.81 * (grains.position[k].z - out.position[k].z)).sum();
    let l = dem.ledger(&state);
    // The sum belongs to half a step before the positions: 1/400 of the fall.
    assert!((l.gravity / fallen - 1.0).abs() < 1e-2, "{} {fallen}", l.gravity);
}

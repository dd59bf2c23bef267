//! The integrators' orders, measured on contacts whose motion has a formula.
//!
//! A grain sits on a floor and never leaves it, so that nothing but the scheme limits the order.

mod common;

use brazilnut_base::{Side, Vec3, vec3};
use brazilnut_grains::contact::TangentialLaw;
use brazilnut_grains::{Dem, DemSpec, Grains, Gravity, Integrator, PairSpec};
use common::*;
use std::f64::consts::PI;

const R: f64 = 1e-3;
const K: f64 = 1e4;
const G: f64 = 9.81;
/// Along the floor: K_t/K of solid spheres.
const RATIO: f64 = 2.0 / 7.0;
/// Swing of the height over the sag at rest: the grain stays in contact.
const SWING: f64 = 0.5;
/// Gravity along the floor in the rolling case, m/s². Slip starts from nothing: a contact that is found
/// with slip has touched half a step before, on average, and is treated so.
const ALONG: f64 = 3.0;

fn sag() -> f64 {
    mass(R) * G / K
}

/// Height of the centre at `t` (s) of a grain that starts at rest, `SWING` below its place of rest.
fn height(t: f64, e: f64) -> f64 {
    let ln = e.ln();
    let zeta = -ln / (PI * PI + ln * ln).sqrt();
    let w = (K / mass(R)).sqrt();
    let wd = w * (1.0 - zeta * zeta).sqrt();
    let swing = (-zeta * w * t).exp() * ((wd * t).cos() + zeta * w / wd * (wd * t).sin());
    R - sag() * (1.0 + SWING * swing)
}

/// Way along the floor at `t` (s) of a grain at its height of rest that `ALONG` sets rolling on a spring.
fn way(t: f64) -> f64 {
    let (m, k_t) = (mass(R), RATIO * K);
    let inertia = 0.4 * m * R * R;
    let arm = R - sag();
    let w2 = k_t * (1.0 / m + arm * arm / inertia);
    let spring = k_t / m * ALONG / w2;
    0.5 * ALONG * t * t - spring * (0.5 * t * t + ((w2.sqrt() * t).cos() - 1.0) / w2)
}

fn floor(integrator: Integrator, dt: f64, e: f64) -> DemSpec {
    let numbers = PairSpec { friction: 1e6, tangential_ratio: Some(RATIO), ..pair(K, e) };
    let mut s = spec(1.0, Side::Walls, dt, numbers);
    s.walls = vec![plane("floor", Vec3::ZERO, Vec3::Z)];
    s.contact.tangential = TangentialLaw::LinearSpring;
    s.rotation = true;
    s.integrator = integrator;
    s
}

/// Where a grain that starts at rest at height `z` is at `t`, in `steps` steps.
fn end(integrator: Integrator, e: f64, z: f64, along: f64, t: f64, steps: u64) -> Vec3 {
    let mut dem = Dem::new(floor(integrator, t / steps as f64, e)).unwrap();
    let mut g = Grains::default();
    add(&mut g, R, vec3(0.5, 0.5, z), Vec3::ZERO);
    let mut state = dem.start(&g).unwrap();
    run(&mut dem, &mut state, 0, steps, &Gravity(vec3(along, 0.0, -G)));
    export(&dem, &state).position[0]
}

/// Order between `steps` and twice as many from the errors of both.
fn order(error: impl Fn(u64) -> f64, steps: u64) -> f64 {
    (error(steps) / error(2 * steps)).abs().log2()
}

/// 1.7 swings: neither the swing nor its slope is near zero.
fn duration() -> f64 {
    1.7 * 2.0 * PI * (mass(R) / K).sqrt()
}

/// Orders of an elastic and of a damped swing, and of a sticking roll.
fn orders(integrator: Integrator, steps: u64) -> [f64; 3] {
    let t = duration();
    let z = R - sag() * (1.0 + SWING);
    let swing = |e: f64| order(|n| end(integrator, e, z, 0.0, t, n).z - height(t, e), steps);
    let roll = order(|n| end(integrator, 1.0, R - sag(), ALONG, t, n).x - 0.5 - way(t), steps);
    [swing(1.0), swing(0.5), roll]
}

#[test]
fn verlet_is_of_second_order() {
    for integrator in [Integrator::VelocityVerlet, Integrator::PositionVerlet] {
        let found = orders(integrator, 200);
        println!("{integrator:?}: {found:.2?}");
        // The next term of the error is of one order more: a few percent at 120 steps per swing.
        assert!(found.iter().all(|p| (p - 2.0).abs() < 0.1), "{integrator:?}: {found:?}");
    }
}

#[test]
fn gear_is_of_fourth_order_where_forces_depend_on_position_alone() {
    let [elastic, damped, roll] = orders(Integrator::Gear, 200);
    println!("gear: {elastic:.2} elastic, {damped:.2} damped, {roll:.2} rolling");
    assert!((elastic - 4.0).abs() < 0.15, "{elastic}");
    // Its coefficients are those for forces without velocities; the tangential spring is of second order itself.
    assert!(damped > 3.4, "{damped}");
    assert!((roll - 2.0).abs() < 0.2, "{roll}");
}

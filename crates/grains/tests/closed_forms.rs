//! Motions that have a formula.

mod common;

use brazilnut_base::{Side, vec3};
use brazilnut_grains::{Dem, Grains, Gravity};
use common::*;
use std::f64::consts::PI;

#[test]
fn free_flight_is_a_parabola() {
    let dt = 1e-4;
    let mut dem = Dem::new(spec(10.0, Side::Walls, dt, pair(1e4, 0.9))).unwrap();
    let mut g = Grains::default();
    let (x, v, a) = (vec3(1.0, 2.0, 5.0), vec3(0.3, -0.2, 1.0), vec3(0.0, 0.0, -9.81));
    add(&mut g, 1e-3, x, v);
    let mut state = dem.start(&g).unwrap();
    run(&mut dem, &mut state, 0, 5000, &Gravity(a));
    let (out, t) = (export(&dem, &state), 0.5);
    // Verlet is exact under a constant force; 5000 additions of rounding errors remain.
    assert!((out.position[0] - (x + v * t + 0.5 * a * t * t)).length() < 1e-12);
    assert!((out.velocity[0] - (v + a * t)).length() < 1e-12);
}

fn contact_time(m: f64, k: f64, e: f64) -> f64 {
    PI * (m / k * (1.0 + (e.ln() / PI).powi(2))).sqrt()
}

/// Speed after over speed before for a grain thrown at the floor, at several phases of the step.
fn bounces(e: f64, steps_per_contact: f64) -> Vec<f64> {
    let (r, k, v) = (1e-3, 1e4, 0.5);
    let m = mass(r);
    let t_c = contact_time(m, k, e);
    let dt = t_c / steps_per_contact;
    let mut all = vec![];
    for phase in 0..20 {
        let mut s = spec(0.1, Side::Walls, dt, pair(k, e));
        s.walls = vec![plane("floor", vec3(0.0, 0.0, 0.0), vec3(0.0, 0.0, 1.0))];
        let mut dem = Dem::new(s).unwrap();
        let mut g = Grains::default();
        let gap = v * dt * (5.0 + f64::from(phase) / 20.0);
        add(&mut g, r, vec3(0.05, 0.05, r + gap), vec3(0.0, 0.0, -v));
        let mut state = dem.start(&g).unwrap();
        run(&mut dem, &mut state, 0, (steps_per_contact * 1.5) as u64 + 20, &Nothing);
        all.push(export(&dem, &state).velocity[0].z / v);
    }
    all
}

#[test]
fn a_bounce_returns_the_restitution() {
    let worst = |e: f64, n: f64| bounces(e, n).iter().map(|x| (x / e - 1.0).abs()).fold(0.0, f64::max);
    // The error is of second order and grows with the damping: 0.2 % is met where grains bounce.
    for e in [1.0, 0.9, 0.879, 0.8] {
        assert!(worst(e, 30.0) < 2e-3, "e = {e}: {}", worst(e, 30.0));
    }
    // Low restitution asks for shorter steps; halving the step quarters the error (3 leaves room for scatter).
    for e in [0.7, 0.5, 0.2] {
        let (coarse, fine) = (worst(e, 60.0), worst(e, 120.0));
        assert!(coarse > 3.0 * fine, "e = {e}: {coarse} {fine}");
    }
}

#[test]
fn a_head_on_collision_of_unequal_spheres() {
    let (r1, r2, k, e) = (1e-3, 1.7e-3, 1e4, 0.9);
    let (m1, m2) = (mass(r1), mass(r2));
    let m12 = m1 * m2 / (m1 + m2);
    let t_c = contact_time(m12, k, e);
    let dt = t_c / 30.0;
    let mut dem = Dem::new(spec(0.1, Side::Periodic, dt, pair(k, e))).unwrap();
    let mut g = Grains::default();
    // Across the periodic side, oblique to the axes.
    let n = vec3(2.0, 1.0, -2.0) / 3.0;
    let x = vec3(0.0995, 0.05, 0.0005);
    let (v1, v2) = (n * 0.4, n * -0.3);
    add(&mut g, r1, x, v1);
    add(&mut g, r2, x + n * (r1 + r2 + 1e-6), v2);
    let mut state = dem.start(&g).unwrap();
    let mut touched = 0;
    for k in 0..60 {
        run(&mut dem, &mut state, k, 1, &Nothing);
        touched += state.contact_count();
    }
    let out = export(&dem, &state);
    let centre = (m1 * v1 + m2 * v2) / (m1 + m2);
    let u1 = centre - e * m2 / (m1 + m2) * (v1 - v2);
    // 30 steps per contact: second-order errors of the law's decay, as in the bounce.
    assert!((out.velocity[0] - u1).length() < 2e-3 * 0.7, "{} {}", out.velocity[0], u1);
    assert!((touched as f64 * dt / t_c - 1.0).abs() < 0.05, "contact time {}", touched as f64 * dt / t_c);
    let p = m1 * out.velocity[0] + m2 * out.velocity[1];
    assert!((p - (m1 * v1 + m2 * v2)).length() < 1e-14 * m1 * 0.4);
}

#[test]
fn a_sliding_sphere_ends_up_rolling() {
    let (r, k, mu, v) = (1e-3, 1e4, 0.3, 0.5);
    let m = mass(r);
    let dt = PI * (m / k).sqrt() / 60.0;
    let mut s = spec(1.0, Side::Walls, dt, brazilnut_grains::PairSpec { friction: mu, ..pair(k, 0.5) });
    s.contact.tangential = brazilnut_grains::contact::TangentialLaw::Coulomb;
    s.rotation = true;
    s.walls = vec![plane("floor", vec3(0.0, 0.0, 0.0), vec3(0.0, 0.0, 1.0))];
    let mut dem = Dem::new(s).unwrap();
    let mut g = Grains::default();
    let sag = m * 9.81 / k;
    add(&mut g, r, vec3(0.1, 0.5, r - sag), vec3(v, 0.0, 0.0));
    let mut state = dem.start(&g).unwrap();
    // Rolls from t = 2 v/(7 mu g) on, with 5/7 of its speed.
    let t = 2.0 * v / (7.0 * mu * 9.81);
    run(&mut dem, &mut state, 0, (1.2 * t / dt) as u64, &Gravity(vec3(0.0, 0.0, -9.81)));
    let out = export(&dem, &state);
    // The contact lies at r - sag, sag/r = 1e-5.
    assert!((out.velocity[0].x / v - 5.0 / 7.0).abs() < 2e-5, "{}", out.velocity[0].x / v);
    let roll = out.angular_velocity[0].y * (r - sag) / out.velocity[0].x;
    // The slip has decayed by exp(-3.5/28) per step; what is left is the sag's second order.
    assert!((roll - 1.0).abs() < 1e-9, "{roll}");
    // It turned by path over radius since it rolls, by (path - v t + mu g t²/2 ...) before: compare angles.
    let angle = 2.0 * out.orientation[0].y.atan2(out.orientation[0].w);
    let slide = 0.5 * 2.5 * mu * 9.81 / r * t * t;
    let rolled = 5.0 / 7.0 * v * 0.2 * t / r;
    let expected = (slide + rolled) % (2.0 * PI);
    let difference = (angle - expected).rem_euclid(2.0 * PI);
    let difference = difference.min(2.0 * PI - difference);
    // The stop of sliding is resolved to a few steps: a few dt * omega.
    assert!(difference < 2e-2, "{angle} {expected}");
}

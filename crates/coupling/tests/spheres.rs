//! Single spheres against known flows, the same questions to every resolved coupling.

mod common;

use brazilnut_base::{Side, Vec3, vec3};
use brazilnut_coupling::Method;
use brazilnut_coupling::resolved::lubrication::Lubrication;
use brazilnut_fluid::Advection;
use common::{ETA, NU, Plan, RHO, Rig, forcing, rig, springs_for};
use std::f64::consts::PI;

/// A fixed sphere in a periodic cube under a body force that keeps the mean velocity: force over 6 pi eta a U.
fn fixed_drag(plan: Plan, radius: f64) -> f64 {
    fixed_drag_at(plan, radius, vec3(0.13, 0.27, 0.41))
}

fn fixed_drag_at(plan: Plan, radius: f64, offset: Vec3) -> f64 {
    let centre = 0.5 * plan.cells[0] as f64 * plan.spacing;
    let at = Vec3::splat(centre) + plan.spacing * offset;
    let mut rig = rig(plan, &[(at, radius, 2.0)]);
    let speed = 1e-4;
    rig.flow.velocity.component_mut(0).fill(speed);
    rig.solver.refresh(&mut rig.flow, 0.0);
    let mass = RHO * rig.solver.grid().size().element_product();
    let (mut force, mut last) = (0.0, 1.0);
    loop {
        for _ in 0..40 {
            let lag = (speed - rig.mean_velocity().x) / rig.plan.dt();
            rig.fluid_step(Vec3::X * (force / mass + 0.1 * lag));
            rig.index += 1;
            force = -rig.state.exchange.on_fluid.x;
        }
        if (force / last - 1.0f64).abs() < 3e-4 {
            return force / (6.0 * PI * ETA * radius * speed);
        }
        assert!(rig.index < 20_000, "no steady drag");
        last = force;
    }
}

/// The densest array asked for: Zick & Homsy 1982, K = 15.4 at a solid fraction of 0.343
/// (the others are in `examples/dense_arrays.rs`).
#[test]
fn direct_forcing_meets_a_dense_array_within_five_percent() {
    let (solids, cells, k) = (0.343, 23, 15.4);
    let plan = Plan { advection: Advection::None, ..Plan::cube(cells, forcing()) };
    let radius = cells as f64 * plan.spacing * (3.0 * solids / (4.0 * PI)).cbrt();
    // Ten points per radius: the accuracy asked for.
    let points = radius / plan.spacing;
    assert!((points - 10.0).abs() < 0.2);
    let got = fixed_drag(plan, radius);
    assert!((got / k - 1.0).abs() < 0.05, "{solids}: {got} against {k}");
}

/// What a coupling says of a sphere at rest in a stream it says of a moving one in a fluid at rest.
#[test]
fn a_settling_sphere_feels_the_drag_of_a_fixed_one() {
    let cells = 16;
    let radius = 3e-4;
    let base = Plan { viscous: 0.04, advection: Advection::None, ..Plan::cube(cells, forcing()) };
    for plan in [base.clone(), springs_for(&base, 0.79)] {
        // The stream runs along x there, the sphere falls along z here: places are turned.
        let passed = [0.0, 0.25, 0.5, 0.75].map(|s| fixed_drag_at(plan.clone(), radius, vec3(s, 0.1, -0.1)));
        let k = passed.iter().sum::<f64>() / 4.0;
        let mut rig = rig(plan, &[(vec3(8.1e-4, 7.9e-4, 8.3e-4), radius, 2.5)]);
        let g = 0.02;
        let weight = 1.5 * RHO * 4.0 / 3.0 * PI * radius.powi(3) * g;
        let expected = weight / (6.0 * PI * ETA * radius * k);
        // The pressure of a closed vessel bears the fluid's own weight, also along periodic axes.
        rig.hydrostatic = Some(Vec3::ONE);
        let mass = RHO * rig.solver.grid().size().element_product();
        let (mut path, mut time) = (0.0, 0.0);
        for step in 0..1200 {
            // No net flux of volume: what the sphere drags down is pushed up.
            let lag = -rig.mean_velocity().z / rig.plan.dt();
            let body = Vec3::Z * (-rig.state.exchange.on_fluid.z / mass + 0.1 * lag);
            rig.step(Vec3::Z * -g, Vec3::ZERO, body);
            if step >= 800 {
                path -= rig.grains.velocity[0].z * rig.plan.dt();
                time += rig.plan.dt();
            }
        }
        let speed = path / time;
        // The drag varies with the place on the grid (springs: 20 %), and four places stand for all.
        assert!((speed / expected - 1.0).abs() < 0.03, "{:?}: {speed} of {expected}", rig.plan.method);
    }
}

/// Acceleration of a released sphere at times short against d²/nu, drawn to time zero along √t.
fn start(plan: Plan, points: f64, ratio: f64) -> f64 {
    let h = plan.spacing;
    let dt = plan.dt();
    let middle = Vec3::from_array(plan.cells.map(|n| 0.5 * n as f64));
    let aside = if plan.cells[1] == 1 { 0.0 } else { 0.27 };
    let at = h * (middle + vec3(0.13, aside, 0.41));
    let mut rig = rig(plan, &[(at, points * h, ratio)]);
    rig.hydrostatic = Some(Vec3::ONE);
    let g = vec3(0.0, 0.0, -1e-3);
    let mass = RHO * rig.solver.grid().size().element_product();
    let mut speeds = vec![0.0];
    // Times in units of a hundredth of h²/nu.
    let time = |n: f64| (n * 0.01 * h * h / NU / dt).round() as usize;
    for _ in 0..time(48.0) {
        let body = -rig.state.exchange.on_fluid / mass;
        rig.step(g, Vec3::ZERO, body);
        speeds.push(rig.grains.velocity[0].z);
    }
    let rate = |a, b| (speeds[time(b)] - speeds[time(a)]) / ((time(b) - time(a)) as f64 * dt);
    // Two stretches around times 1 : 4, whose roots are 1 : 2.
    let (early, late) = (rate(8.0, 12.0), rate(36.0, 44.0));
    (2.0 * early - late) / -1e-3
}

/// (rho_g − rho) g/(rho_g + rho/2): the fluid around adds half of what it displaces (errata on Clément 2.100).
#[test]
fn a_released_sphere_starts_with_its_added_mass() {
    let base = Plan { viscous: 0.01, advection: Advection::None, ..Plan::cube(40, forcing()) };
    for (plan, ratio) in [
        (base.clone(), 1.5),
        (base.clone(), 2.5),
        (springs_for(&base, 0.4), 1.5),
        (springs_for(&base, 0.79), 8.9),
    ] {
        let method = plan.method;
        let got = start(plan, 5.0, ratio);
        let expected = (ratio - 1.0) / (ratio + 0.5);
        // The kernel smears the surface over a spacing. A fifth of one at five points per radius is 12 % of
        // the displaced volume, which enters 1.5 times against the sum of the masses.
        let smear = 0.12 * 1.5 / (ratio + 0.5);
        assert!((got / expected - 1.0).abs() < smear + 0.01, "{method:?} {ratio}: {got} of {expected}");
    }
}

/// Light bodies: stable, and they start up with their added mass.
#[test]
fn direct_forcing_bears_light_spheres() {
    let base = Plan { viscous: 0.01, advection: Advection::None, ..Plan::cube(32, forcing()) };
    for (points, ratio) in [(3.0, 0.9), (4.0, 0.6), (4.0, 0.9), (4.0, 1.1)] {
        let got = start(base.clone(), points, ratio);
        let expected = (ratio - 1.0) / (ratio + 0.5);
        // As above, a fifth of a spacing: 21 % of the displaced volume at three points per radius, 15 % at four.
        let displaced = (1.0 + 0.2 / points).powi(3) - 1.0;
        let smear = displaced * 1.5 / (ratio + 0.5);
        assert!((got / expected - 1.0).abs() < smear + 0.01, "{points} {ratio}: {got} of {expected}");
    }
}

/// Bodies lighter than their added mass, which carry a virtual mass: a bubble-like start, no swing.
#[test]
fn direct_forcing_bears_spheres_lighter_than_their_added_mass() {
    let base = Plan { viscous: 0.01, advection: Advection::None, ..Plan::cube(32, forcing()) };
    for (points, ratio) in [(3.0, 0.1), (3.0, 0.5), (4.0, 0.1), (4.0, 0.3)] {
        let got = start(base.clone(), points, ratio);
        let rise = |added: f64| (1.0 - ratio) / (ratio + added);
        // A fifth of a spacing is smeared, as above. What is left of the history force after the
        // extrapolation counts for more the less the body weighs: two fifths, together.
        let smeared = (1.0 + 0.4 / points).powi(3) - 1.0;
        let (least, most) = (rise(0.5 + 1.5 * smeared), rise(0.5));
        assert!((least..=most).contains(&-got), "{points} {ratio}: {got} within {least} and {most}");
    }
}

/// The fluid around a cylinder adds all that it displaces: twice as much as around a sphere.
#[test]
fn direct_forcing_bears_cylinders_lighter_than_their_added_mass() {
    let sides = [Side::Periodic, Side::Flat, Side::Periodic];
    // The lightest swing for some fifty steps before they follow: short ones.
    let cube = Plan { viscous: 0.002, advection: Advection::None, ..Plan::cube(96, forcing()) };
    let base = Plan { cells: [96, 1, 96], sides, ..cube };
    for (points, ratio) in [(3.0, 0.1), (3.0, 0.5), (4.0, 0.1), (4.0, 0.7), (8.0, 0.1)] {
        let got = start(base.clone(), points, ratio);
        let rise = |added: f64| (1.0 - ratio) / (ratio + added);
        // As for light spheres, but that the square of the radius counts, that more of the history force is left
        // (half a spacing, together), and that the neighbours of the periodic box add 2 phi at a solids fraction
        // of phi, 0.5 %.
        let smeared = (1.0 + 0.5 / points).powi(2) - 1.0;
        let (least, most) = (rise(1.01 + 2.0 * smeared), rise(1.0));
        assert!((least..=most).contains(&-got), "{points} {ratio}: {got} within {least} and {most}");
    }
}

/// A film that stops a body within a step, to which the fluid answers one step later: neither may pump up the other.
#[test]
fn tight_films_stop_a_sphere_in_every_coupling() {
    let h = Plan::cube(24, forcing()).spacing;
    let lubrication = Some(Lubrication { min_gap: 1e-4 * h, max_gap: h });
    let base = Plan { lubrication, sides: [Side::Walls; 3], substeps: 2, ..Plan::cube(24, forcing()) };
    let template = Plan { method: Method::Template, ..base.clone() };
    for (plan, ratio) in [
        (base.clone(), 0.3),
        (base.clone(), 0.9),
        (base.clone(), 2.5),
        (base.clone(), 8.9),
        (springs_for(&base, 0.79), 1.8),
        (springs_for(&base, 0.79), 8.9),
        (springs_for(&base, 0.09), 2.5),
        (template.clone(), 1.5),
        (template, 2.5),
    ] {
        let method = plan.method;
        let mut rig = rig(plan, &[(vec3(12.0, 12.0, 3.001) * h, 3.0 * h, ratio)]);
        let speed = 1e-5;
        rig.launch(Vec3::Z * -speed, Vec3::ZERO);
        let mut speeds = vec![];
        for _ in 0..60 {
            rig.step(Vec3::ZERO, Vec3::ZERO, Vec3::ZERO);
            speeds.push(rig.grains.velocity[0].z.abs() / speed);
        }
        assert!(speeds.iter().all(|w| *w < 1.0), "{method:?} {ratio}: {speeds:.2?}");
        // The film is a ten-thousandth of a spacing: what is left dies out with the flow around the sphere.
        assert!(speeds[40..].iter().all(|w| *w < 0.02), "{method:?} {ratio}: {speeds:.3?}");
    }
}

/// A sphere set spinning: 8 pi eta a³ w [1 + (1/√(pi t) − e^t erfc √t)/3] with t in a²/nu,
/// 4.6 % above the steady torque at t = 1; a cube of four radii half-width adds 1.6 % (a³/b³).
#[test]
fn a_spun_sphere_feels_its_torque() {
    let torque = |mut rig: Rig| {
        let w = 0.5;
        rig.grains.angular_velocity[0] = vec3(0.0, 0.0, w);
        let a = rig.grains.radius[0];
        let steps = (a * a / (NU * rig.plan.dt())) as usize;
        for _ in 0..steps {
            rig.fluid_step(Vec3::ZERO);
            rig.index += 1;
        }
        -rig.state.loads[0].torque.z / (8.0 * PI * ETA * a.powi(3) * w)
    };
    let base = Plan { advection: Advection::None, sides: [Side::Walls; 3], ..Plan::cube(32, forcing()) };
    for (plan, tolerance) in [
        // The torque goes as the cube of a radius known to a tenth of a spacing, here a fortieth.
        (base.clone(), 0.1),
        (springs_for(&base, 0.79), 0.1),
        // Points are in or out: a quarter of a spacing.
        (Plan { method: Method::Template, ..base.clone() }, 0.25),
    ] {
        let method = plan.method;
        let got = torque(rig(plan, &[(vec3(16.1e-4, 15.9e-4, 16.3e-4), 4e-4, 2.5)]));
        assert!((got / 1.06 - 1.0).abs() < tolerance, "{method:?}: {got}");
    }
}

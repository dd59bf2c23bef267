//! Diagnostics against hand values and balances.

use brazilnut_base::{Side, Tick, Vec3, vec3};
use brazilnut_fluid::diagnose::{
    budget, divergence, flux, momentum, pressure_at, streamfunction, velocity_at, vorticity,
};
use brazilnut_fluid::exact::taylor_green::TaylorGreen;
use brazilnut_fluid::{Boundary, Flow, FluidSpec, Grid, Medium, Solver};
use std::f64::consts::TAU;

/// A Taylor-Green vortex in the x-z plane of a periodic box of side 1.
fn vortex(n: usize) -> (Solver, Flow) {
    let sides = [Side::Periodic, Side::Flat, Side::Periodic];
    let grid = Grid::new([n, 1, n], [1.0 / n as f64, 0.1, 1.0 / n as f64], sides);
    let exact = TaylorGreen { speed: 1.0, wavenumber: TAU, viscosity: 1e-3, density: 1000.0 };
    let solver = Solver::new(FluidSpec::new(grid, 1000.0, 1.0)).unwrap();
    let mut flow = solver.start();
    let grid = solver.grid().clone();
    flow.velocity.x.fill_with(&grid, |i, j, k| {
        let r = grid.face_center(0, i, j, k);
        exact.velocity(r.x, r.z, 0.0)[0]
    });
    flow.velocity.z.fill_with(&grid, |i, j, k| {
        let r = grid.face_center(2, i, j, k);
        exact.velocity(r.x, r.z, 0.0)[1]
    });
    flow.pressure.fill_with(&grid, |i, j, k| {
        let r = grid.cell_center(i, j, k);
        exact.pressure(r.x, r.z, 0.0)
    });
    solver.refresh(&mut flow, 0.0);
    (solver, flow)
}

#[test]
fn a_vortex_is_read_right() {
    let (solver, flow) = vortex(64);
    let grid = solver.grid();
    // Sampled sines leave no divergence on this grid: sin(k (x + h)) - sin(k x) is alike in both directions.
    assert!(divergence(grid, &flow.velocity) < 1e-12);
    // u = sin(kx) cos(kz): psi = sin(kx) sin(kz) / k, omega = dw/dx - du/dz = 2 k sin(kx) sin(kz).
    let psi = streamfunction(grid, &flow.velocity, [0, 2], 0);
    let centres = psi.extrema(1.0);
    // Two such vortices: at 1/4, 1/4 and at 3/4, 3/4.
    assert_eq!(centres.len(), 2);
    let (top, at) = (centres[0].value, centres[0].at);
    // Sums replace integrals: (k h)²/24 = 4e-4.
    assert!((top - 1.0 / TAU).abs() < 1e-3 / TAU, "{top}");
    assert!(at.iter().all(|x| (x % 0.5 - 0.25).abs() < 1e-9), "{at:?}");
    let spin = vorticity(grid, &flow.velocity, [0, 2], 0).extrema(1.0)[0].value;
    assert!((spin - 2.0 * TAU).abs() < 1e-3 * spin, "{spin}");
    let v = velocity_at(grid, &flow.velocity, vec3(0.27, 0.03, 0.03));
    let exact = (TAU * 0.27).sin() * (TAU * 0.03).cos();
    // Linear interpolation: (k h)²/8 in each direction.
    assert!((v.x - exact).abs() < 2.5e-3 && v.y == 0.0, "{v}");
    let p = pressure_at(grid, &flow, vec3(1.02, 0.05, -0.01));
    let exact = 250.0 * ((2.0 * TAU * 0.02).cos() + (2.0 * TAU * 0.01).cos());
    assert!((p - exact).abs() < 3.0, "{p} {exact}");
    assert!(flux(grid, &flow.velocity, 0, 7).abs() < 1e-15);
    assert!(momentum(grid, &flow.velocity, 1000.0).iter().all(|m| m.abs() < 1e-12));
}

#[test]
fn energy_budget_closes() {
    // A driven channel under a moving lid, three-dimensional, with a wavy start.
    let sides = [Side::Periodic, Side::Walls, Side::Walls];
    let mut spec = FluidSpec::new(Grid::new([10, 8, 12], [0.1, 0.12, 0.08], sides), 2.0, 0.3);
    spec.sides[2][1] = Boundary::lid(vec3(0.8, 0.2, 0.0));
    spec.sides[1][0] = Boundary::FreeSlip;
    let mut solver = Solver::new(spec).unwrap();
    let mut flow = solver.start();
    let grid = solver.grid().clone();
    flow.velocity.x.fill_with(&grid, |i, j, k| ((i + 2 * j + 3 * k) as f64).sin());
    flow.velocity.z.fill_with(&grid, |i, j, k| ((2 * i + j + k) as f64).cos());
    solver.refresh(&mut flow, 0.0);
    let body = vec3(0.5, 0.0, -9.81);
    let dt = 1e-5;
    for index in 0..20 {
        solver.advance(&mut flow, Tick::at(index, dt), body, &Medium::default(), |_| {});
    }
    let before = budget(&solver, &flow, body);
    for index in 20..22 {
        solver.advance(&mut flow, Tick::at(index, dt), body, &Medium::default(), |_| {});
    }
    let after = budget(&solver, &flow, body);
    let power = |b: &brazilnut_fluid::diagnose::Budget| b.body + b.walls - b.dissipation;
    let change = (after.kinetic - before.kinetic) / (2.0 * dt);
    let mean = 0.5 * (power(&before) + power(&after));
    // Space closes exactly; time to second order: (rate dt)², rate about 4 nu / h² = 100 / s.
    assert!((change - mean).abs() < 1e-5 * before.dissipation, "{change} {mean} {before:?}");
    assert!(before.walls.abs() > 1e-3 && before.body.abs() > 1e-6);
}

#[test]
fn momentum_changes_by_what_acts_on_it() {
    // A periodic box feels the acceleration alone.
    let (mut solver, mut flow) = vortex(16);
    let (steps, dt) = (50, 1e-3);
    for index in 0..steps {
        solver.advance(&mut flow, Tick::at(index, dt), vec3(0.3, 0.0, -0.2), &Medium::default(), |_| {});
    }
    let p = momentum(solver.grid(), &flow.velocity, 1000.0);
    let mass = 1000.0 * 0.1;
    let expected = Vec3::new(0.3, 0.0, -0.2) * mass * steps as f64 * dt;
    // Rounding of sums over 256 faces and 50 steps.
    assert!((p[0] - expected.x).abs() < 1e-11 && (p[2] - expected.z).abs() < 1e-11, "{p:?} {expected}");
}

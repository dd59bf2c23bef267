//! The solver against flows known in closed form.

use brazilnut_base::{Side, Tick, Vec3};
use brazilnut_fluid::exact::channel::{couette_start, poiseuille_start};
use brazilnut_fluid::exact::manufactured::Manufactured;
use brazilnut_fluid::exact::stokes_layer;
use brazilnut_fluid::exact::taylor_green::TaylorGreen;
use brazilnut_fluid::{Advection, Boundary, Diffusion, Flow, FluidSpec, Grid, Medium, Scheme, Solver};
use std::f64::consts::TAU;

/// Runs `steps` steps of `dt` under `body`.
fn run(solver: &mut Solver, flow: &mut Flow, steps: u64, dt: f64, body: Vec3) {
    for index in 0..steps {
        solver.advance(flow, Tick::at(index, dt), body, &Medium::default(), |_| {});
    }
}

/// Largest error of the vortex in the plane of axes `a`, `b` after half a second, and the
/// part of the flow that is the exact one (1 at best).
fn taylor_green(n: usize, steps: u64, scheme: Scheme, [a, b]: [usize; 2], advection: Advection) -> [f64; 2] {
    let (mut cells, mut sides) = ([1; 3], [Side::Flat; 3]);
    (cells[a], cells[b]) = (n, n);
    (sides[a], sides[b]) = (Side::Periodic, Side::Periodic);
    let grid = Grid::new(cells, [1.0 / n as f64; 3], sides);
    let exact = TaylorGreen { speed: 1.0, wavenumber: TAU, viscosity: 0.01, density: 2.0 };
    let mut spec = FluidSpec::new(grid, 2.0, 0.02);
    spec.scheme = scheme;
    spec.advection = advection;
    let mut solver = Solver::new(spec).unwrap();
    let mut flow = solver.start();
    let grid = solver.grid().clone();
    let component = |axis: usize, r: Vec3, t: f64| {
        let v = exact.velocity(r[a], r[b], t);
        if axis == a {
            v[0]
        } else if axis == b {
            v[1]
        } else {
            0.0
        }
    };
    flow.velocity.x.fill_with(&grid, |i, j, k| component(0, grid.face_center(0, i, j, k), 0.0));
    flow.velocity.y.fill_with(&grid, |i, j, k| component(1, grid.face_center(1, i, j, k), 0.0));
    flow.velocity.z.fill_with(&grid, |i, j, k| component(2, grid.face_center(2, i, j, k), 0.0));
    flow.pressure.fill_with(&grid, |i, j, k| {
        let r = grid.cell_center(i, j, k);
        exact.pressure(r[a], r[b], 0.0)
    });
    solver.refresh(&mut flow, 0.0);
    let time = 0.5;
    run(&mut solver, &mut flow, steps, time / steps as f64, Vec3::ZERO);
    let (mut worst, mut overlap, mut norm) = (0.0_f64, 0.0, 0.0);
    for axis in [a, b] {
        let [x, y, z] = grid.face_range(axis);
        for k in z {
            for j in y.clone() {
                for i in x.clone() {
                    let v = flow.velocity.component(axis)[grid.layout().index(i, j, k)];
                    let exact = component(axis, grid.face_center(axis, i, j, k), time);
                    worst = worst.max((v - exact).abs());
                    overlap += v * exact;
                    norm += exact * exact;
                }
            }
        }
    }
    [worst, overlap / norm]
}

/// Order that two errors show when the step is halved.
fn order(coarse: f64, fine: f64) -> f64 {
    (coarse / fine).log2()
}

#[test]
fn taylor_green_converges_in_space() {
    for axes in [[0, 2], [1, 2], [0, 1]] {
        let e: Vec<f64> =
            [16, 32].map(|n| taylor_green(n, 400, Scheme::SecondOrder, axes, Advection::Central)[0]).into();
        // 0.1: the next order of the truncation error at 16 points a wave.
        assert!((order(e[0], e[1]) - 2.0).abs() < 0.1, "{axes:?} {e:?}");
    }
    let e: Vec<f64> =
        [32, 64].map(|n| taylor_green(n, 400, Scheme::SecondOrder, [0, 2], Advection::Koren)[0]).into();
    // The limiter flattens extrema, which costs order there.
    assert!(order(e[0], e[1]) > 1.5, "{e:?}");
}

#[test]
fn taylor_green_converges_in_time() {
    // The spatial error is common to all and cancels from differences.
    for (scheme, wanted) in [(Scheme::FirstOrder, 1.0), (Scheme::SecondOrder, 2.0)] {
        let e: Vec<f64> =
            [50, 100, 200].map(|s| taylor_green(32, s, scheme, [0, 2], Advection::Central)[1]).into();
        let measured = order(e[0] - e[1], e[1] - e[2]);
        // 0.15: the next order in dt, one tenth of the leading one here.
        assert!((measured - wanted).abs() < 0.15, "{scheme:?}: {measured} from {e:?}");
    }
}

/// Channel with walls along `wall`, flow along `along`.
fn channel(wall: usize, along: usize, n: usize, scheme: Scheme, diffusion: Diffusion) -> FluidSpec {
    let (mut cells, mut sides) = ([4; 3], [Side::Periodic; 3]);
    (cells[wall], sides[wall]) = (n, Side::Walls);
    let flat = 3 - wall - along;
    (cells[flat], sides[flat]) = (1, Side::Flat);
    let grid = Grid::new(cells, [1.0 / n as f64; 3], sides);
    let mut spec = FluidSpec::new(grid, 1.5, 0.15);
    spec.scheme = scheme;
    spec.diffusion = diffusion;
    spec
}

/// Profile of component `along` over the cells of `wall`.
fn profile(solver: &Solver, flow: &Flow, wall: usize, along: usize) -> Vec<(f64, f64)> {
    let grid = solver.grid();
    (0..grid.cells[wall])
        .map(|i| {
            let mut c = [0_isize; 3];
            c[wall] = i as isize;
            let r = grid.face_center(along, c[0], c[1], c[2]);
            (r[wall], flow.velocity.component(along)[grid.layout().index(c[0], c[1], c[2])])
        })
        .collect()
}

/// Ways to step.
const NUMERICS: [(Scheme, Diffusion); 4] = [
    (Scheme::FirstOrder, Diffusion::Explicit),
    (Scheme::SecondOrder, Diffusion::Explicit),
    (Scheme::FirstOrder, Diffusion::Implicit),
    (Scheme::SecondOrder, Diffusion::Implicit),
];

#[test]
fn poiseuille_starts_up() {
    for (wall, along) in [(0, 1), (1, 2), (2, 0), (0, 2), (1, 0), (2, 1)] {
        for (scheme, diffusion) in NUMERICS {
            let mut solver = Solver::new(channel(wall, along, 20, scheme, diffusion)).unwrap();
            let mut flow = solver.start();
            let mut body = Vec3::ZERO;
            body[along] = 0.8;
            let (steps, dt) = (1000, 1e-3);
            run(&mut solver, &mut flow, steps, dt, body);
            for (y, u) in profile(&solver, &flow, wall, along) {
                let exact = poiseuille_start(0.8, 1.0, 0.1, y, steps as f64 * dt);
                // Second differences: (pi h)²/12 of the transient, h²/8 g/nu from the wall cell: 2.5e-3 of 1.
                assert!((u - exact).abs() < 3e-3, "{wall} {along} {scheme:?} {y}: {u} {exact}");
            }
        }
    }
}

#[test]
fn couette_starts_up() {
    for (wall, along, end) in [(0, 1, 0), (1, 2, 1), (2, 0, 1), (0, 2, 1)] {
        for (scheme, diffusion) in NUMERICS {
            let mut spec = channel(wall, along, 20, scheme, diffusion);
            let mut lid = Vec3::ZERO;
            lid[along] = 1.0;
            spec.sides[wall][end] = Boundary::lid(lid);
            let mut solver = Solver::new(spec).unwrap();
            let mut flow = solver.start();
            run(&mut solver, &mut flow, 1000, 1e-3, Vec3::ZERO);
            for (y, u) in profile(&solver, &flow, wall, along) {
                let from_rest = if end == 1 { y } else { 1.0 - y };
                let exact = couette_start(1.0, 1.0, 0.1, from_rest, 1.0);
                // (pi h)²/12 of the transient of amplitude 0.24 at this time.
                assert!((u - exact).abs() < 1e-3, "{wall} {along} {scheme:?} {diffusion:?} {y}: {u} {exact}");
            }
        }
    }
}

#[test]
fn implicit_diffusion_has_no_viscous_limit() {
    // Fifty times the limit of eq. 2.37, to the steady state.
    let mut spec = channel(1, 0, 24, Scheme::SecondOrder, Diffusion::Implicit);
    spec.sides[1][1] = Boundary::lid(Vec3::X);
    let dt = 50.0 * brazilnut_fluid::limits::viscous(0.1, &[1.0 / 24.0; 2], Scheme::FirstOrder);
    let mut solver = Solver::new(spec).unwrap();
    let mut flow = solver.start();
    run(&mut solver, &mut flow, 400, dt, Vec3::X * 0.4);
    for (y, u) in profile(&solver, &flow, 1, 0) {
        let exact = y + 0.4 * y * (1.0 - y) / 0.2;
        // The parabola is off by g h²/(8 nu) throughout; the rest has decayed.
        assert!((u - exact - 0.4 / (8.0 * 0.1 * 576.0)).abs() < 1e-6, "{y}: {u} {exact}");
    }
}

#[test]
fn oscillating_plate_drags_a_stokes_layer() {
    for (diffusion, wall, along) in
        [(Diffusion::Explicit, 2, 0), (Diffusion::Implicit, 2, 0), (Diffusion::Implicit, 0, 1)]
    {
        let (frequency, nu) = (2.0, 0.1);
        let mut spec = channel(wall, along, 64, Scheme::SecondOrder, diffusion);
        let mut motion = brazilnut_base::motion::Motion::vertical(0.0, frequency);
        // Velocity 2 pi f A cos(2 pi f t) = cos(2 pi f t).
        motion.harmonics[0].amplitude = Vec3::ZERO;
        motion.harmonics[0].amplitude[along] = 1.0 / (TAU * frequency);
        spec.sides[wall][0] = Boundary::MovingLid { velocity: Vec3::ZERO, motion };
        let mut solver = Solver::new(spec).unwrap();
        let mut flow = solver.start();
        let (steps, dt) = (6000, 5e-4);
        run(&mut solver, &mut flow, steps, dt, Vec3::ZERO);
        let t = steps as f64 * dt;
        for (y, u) in profile(&solver, &flow, wall, along) {
            let exact = stokes_layer::velocity(1.0, frequency, nu, 1.0, y, t);
            // The layer is 0.13 thick, 8 cells: (h/delta)²/6 = 0.25 %; the start's transient
            // has decayed as exp(-pi² nu t) = 5 % of an amplitude of 3 %.
            assert!((u - exact).abs() < 4e-3, "{diffusion:?} {y}: {u} {exact}");
        }
    }
}

/// Largest velocity error of the manufactured flow in a plane of axes `a`, `b`.
fn manufactured_error(n: usize, steps: u64, [a, b]: [usize; 2], diffusion: Diffusion) -> f64 {
    let (mut cells, mut sides) = ([1; 3], [Side::Flat; 3]);
    (cells[a], cells[b]) = (n, n);
    (sides[a], sides[b]) = (Side::Walls, Side::Walls);
    let grid = Grid::new(cells, [1.0 / n as f64; 3], sides);
    let exact = Manufactured { viscosity: 0.05, rate: 4.0 };
    let mut solver = Solver::new(FluidSpec { diffusion, ..FluidSpec::new(grid, 1.0, 0.05) }).unwrap();
    let mut flow = solver.start();
    let grid = solver.grid().clone();
    let l = grid.layout();
    let visit = |act: &mut dyn FnMut(usize, usize, usize, Vec3)| {
        for (c, axis) in [a, b].into_iter().enumerate() {
            let [x, y, z] = grid.face_range(axis);
            for k in z {
                for j in y.clone() {
                    for i in x.clone() {
                        act(c, axis, l.index(i, j, k), grid.face_center(axis, i, j, k));
                    }
                }
            }
        }
    };
    visit(&mut |c, axis, at, r| flow.velocity.component_mut(axis)[at] = exact.velocity(r[a], r[b], 0.0)[c]);
    flow.pressure.fill_with(&grid, |i, j, k| {
        let r = grid.cell_center(i, j, k);
        exact.pressure(r[a], r[b], 0.0)
    });
    solver.refresh(&mut flow, 0.0);
    let time = 0.5;
    let dt = time / steps as f64;
    for index in 0..steps {
        let tick = Tick::at(index, dt);
        solver.advance(&mut flow, tick, Vec3::ZERO, &Medium::default(), |predicted| {
            visit(&mut |c, axis, at, r| {
                let force = |x: f64, y: f64| exact.force(x, y, tick.time + 0.5 * dt)[c];
                let (x, y, e) = (r[a], r[b], 1e-3);
                let around = force(x + e, y) + force(x - e, y) + force(x, y + e) + force(x, y - e);
                // What is added here is not diffused in this step: implicit diffusion wants it beforehand.
                let diffused = match diffusion {
                    Diffusion::Implicit => 0.5 * 0.05 * dt * (around - 4.0 * force(x, y)) / (e * e),
                    Diffusion::Explicit => 0.0,
                };
                predicted.velocity.component_mut(axis)[at] += dt * (force(x, y) + diffused);
            });
        });
    }
    let mut worst = 0.0_f64;
    visit(&mut |c, axis, at, r| {
        worst = worst.max((flow.velocity.component(axis)[at] - exact.velocity(r[a], r[b], time)[c]).abs());
    });
    worst
}

#[test]
fn manufactured_flow_between_walls_converges_at_second_order() {
    // Step and spacing halved together: both errors must fall fourfold.
    for (diffusion, steps) in [(Diffusion::Explicit, 25), (Diffusion::Implicit, 10)] {
        let e: Vec<f64> =
            [12, 24, 48].map(|n| manufactured_error(n, steps * n as u64, [0, 2], diffusion)).into();
        let measured = order(e[1], e[2]);
        // 0.15: what the next order still contributes at 24 points.
        assert!((measured - 2.0).abs() < 0.15, "{diffusion:?}: {measured} from {e:?}");
    }
}

//! What must hold to rounding, whatever the flow.

use brazilnut_base::{Side, Tick, Vec3, vec3};
use brazilnut_fluid::{
    Advection, Boundary, CellField, Diffusion, Flow, FluidSpec, Grid, Instructions, Medium, Profile, Scheme,
    Solver,
};

/// A reproducible number in -1..1 for each place.
fn noise(seed: usize, at: usize) -> f64 {
    let x = (seed.wrapping_mul(7919) ^ at.wrapping_mul(104_729)).wrapping_mul(2_654_435_761) % 1_000_003;
    2.0 * x as f64 / 1_000_003.0 - 1.0
}

/// Fills the velocity with noise, walls included.
fn stir(solver: &Solver, flow: &mut Flow, speed: f64) {
    for axis in 0..3 {
        if solver.grid().sides[axis] != Side::Flat {
            for (at, v) in flow.velocity.component_mut(axis).iter_mut().enumerate() {
                *v = speed * noise(axis, at);
            }
        }
    }
    solver.refresh(flow, 0.0);
}

/// max |div v| over max |v| / h.
fn relative_divergence(solver: &Solver, flow: &Flow) -> f64 {
    let (grid, v) = (solver.grid(), &flow.velocity);
    let h = grid.spacing;
    let [x, y, z] = grid.cell_range();
    let (mut worst, mut fastest) = (0.0_f64, 0.0_f64);
    for k in z {
        for j in y.clone() {
            for i in x.clone() {
                let d = (v.x.at(i + 1, j, k) - v.x.at(i, j, k)) / h[0]
                    + (v.y.at(i, j + 1, k) - v.y.at(i, j, k)) / h[1]
                    + (v.z.at(i, j, k + 1) - v.z.at(i, j, k)) / h[2];
                worst = worst.max(d.abs());
                for (c, h) in [v.x.at(i, j, k), v.y.at(i, j, k), v.z.at(i, j, k)].into_iter().zip(h) {
                    fastest = fastest.max(c.abs() / h);
                }
            }
        }
    }
    worst / fastest
}

/// Every mix of sides worth a test, with a moving lid where there is room for one.
fn specs() -> Vec<FluidSpec> {
    use Side::{Flat, Periodic, Walls};
    let mut all = vec![];
    for sides in [
        [Walls, Walls, Walls],
        [Periodic, Walls, Walls],
        [Periodic, Periodic, Walls],
        [Periodic, Periodic, Periodic],
        [Walls, Flat, Walls],
        [Periodic, Flat, Walls],
        [Flat, Walls, Periodic],
        [Walls, Periodic, Flat],
    ] {
        let cells = [0, 1, 2].map(|a| if sides[a] == Flat { 1 } else { [12, 10, 14][a] });
        let mut spec = FluidSpec::new(Grid::new(cells, [0.1, 0.12, 0.09], sides), 1000.0, 1.0);
        spec.sides[0][1] = Boundary::FreeSlip;
        spec.sides[2][1] = Boundary::lid(vec3(0.7, 0.4, 0.0));
        all.push(spec);
    }
    let mut open = all[1].clone();
    open.sides[2] =
        [Boundary::Inflow { profile: Profile::Parabolic(0.3) }, Boundary::Outflow { pressure: 17.0 }];
    all.push(open);
    all
}

#[test]
fn divergence_vanishes_for_every_mix_of_sides_and_numerics() {
    for base in specs() {
        for scheme in [Scheme::FirstOrder, Scheme::SecondOrder] {
            for advection in [Advection::Central, Advection::Koren, Advection::None] {
                for (instructions, diffusion) in [
                    (Instructions::Best, Diffusion::Explicit),
                    (Instructions::Portable, Diffusion::Explicit),
                    (Instructions::Best, Diffusion::Implicit),
                ] {
                    let spec = FluidSpec { scheme, advection, instructions, diffusion, ..base.clone() };
                    let mut solver = Solver::new(spec).unwrap();
                    let mut flow = solver.start();
                    stir(&solver, &mut flow, 1.0);
                    for index in 0..3 {
                        let tick = Tick::at(index, 1e-3);
                        let push = |p: &mut brazilnut_fluid::Predicted<'_>| {
                            // A coupling may write anywhere, walls included.
                            for axis in 0..3 {
                                if p.grid.sides[axis] != Side::Flat {
                                    for (at, v) in p.velocity.component_mut(axis).iter_mut().enumerate() {
                                        *v += 0.1 * noise(axis + 5, at);
                                    }
                                }
                            }
                        };
                        solver.advance(&mut flow, tick, Vec3::ZERO, &Medium::default(), push);
                        let d = relative_divergence(&solver, &flow);
                        assert!(d < 1e-12, "{:?}: {d}", solver.spec());
                    }
                }
            }
        }
    }
}

#[test]
fn uniform_acceleration_of_a_closed_box_moves_nothing() {
    for scheme in [Scheme::FirstOrder, Scheme::SecondOrder] {
        let grid = Grid::new([8, 9, 10], [0.01; 3], [Side::Walls; 3]);
        let mut solver = Solver::new(FluidSpec { scheme, ..FluidSpec::new(grid, 1000.0, 1e-3) }).unwrap();
        let mut flow = solver.start();
        for index in 0..10 {
            let body = vec3(3.0, -1.0, -9.81 + index as f64);
            solver.advance(&mut flow, Tick::at(index, 1e-3), body, &Medium::default(), |_| {});
        }
        for axis in 0..3 {
            assert!(flow.velocity.component(axis).iter().all(|v| *v == 0.0), "exactly at rest");
        }
        let floor =
            flow.base_pressure(1000.0, vec3(0.0, 0.0, 0.0)) - flow.base_pressure(1000.0, vec3(0.0, 0.0, 0.1));
        assert!((floor - 1000.0 * (9.81 - 9.0) * 0.1).abs() < 1e-9, "weight of the column: {floor}");
    }
}

/// The flow after some steps from noise, under `threads` threads.
fn stirred(threads: usize, spec: &FluidSpec, pause: bool) -> Flow {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    pool.install(|| {
        let mut solver = Solver::new(spec.clone()).unwrap();
        let mut flow = solver.start();
        stir(&solver, &mut flow, 0.5);
        for index in 0..6 {
            if pause && index == 3 {
                let saved = rmp_serde::to_vec(&flow).unwrap();
                flow = rmp_serde::from_slice(&saved).unwrap();
                solver = Solver::new(spec.clone()).unwrap();
            }
            let body = vec3(0.0, 0.3, -9.81);
            solver.advance(&mut flow, Tick::at(index, 1e-3), body, &Medium::default(), |_| {});
        }
        flow
    })
}

#[test]
fn same_bits_for_any_number_of_threads_and_across_a_pause() {
    use Side::{Flat, Periodic, Walls};
    for (cells, sides) in [
        ([24, 20, 28], [Walls, Periodic, Walls]),
        ([24, 20, 22], [Periodic, Periodic, Periodic]),
        ([24, 20, 28], [Periodic, Walls, Walls]),
        ([128, 1, 90], [Walls, Flat, Walls]),
    ] {
        for scheme in [Scheme::FirstOrder, Scheme::SecondOrder] {
            let spec =
                FluidSpec { scheme, ..FluidSpec::new(Grid::new(cells, [0.01; 3], sides), 1000.0, 1.0) };
            let reference = stirred(1, &spec, false);
            assert!(reference == stirred(2, &spec, false), "2 threads");
            assert!(reference == stirred(7, &spec, false), "7 threads");
            assert!(reference == stirred(2, &spec, true), "stopped and resumed");
        }
    }
}

#[test]
fn plain_code_gives_the_same_flow_to_rounding() {
    for base in specs() {
        for (scheme, diffusion) in [
            (Scheme::FirstOrder, Diffusion::Explicit),
            (Scheme::SecondOrder, Diffusion::Explicit),
            (Scheme::SecondOrder, Diffusion::Implicit),
        ] {
            for advection in [Advection::Central, Advection::Koren] {
                let spec = FluidSpec { scheme, diffusion, advection, ..base.clone() };
                let plain = FluidSpec { instructions: Instructions::Portable, ..spec.clone() };
                let (a, b) = (stirred(1, &spec, false), stirred(1, &plain, false));
                for axis in 0..3 {
                    let both = a.velocity.component(axis).iter().zip(b.velocity.component(axis));
                    let apart = both.map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
                    // Velocities of order 1 m/s after six steps: thousands of roundings of 1e-16.
                    assert!(apart < 1e-11, "{spec:?}: {apart}");
                }
            }
        }
    }
}

#[test]
fn adaptive_steps_follow_the_flow() {
    let grid = Grid::new([16, 1, 16], [1.0 / 16.0; 3], [Side::Walls, Side::Flat, Side::Walls]);
    let mut spec = FluidSpec { adaptive: true, ..FluidSpec::new(grid, 1.0, 0.01) };
    spec.sides[2][1] = Boundary::lid(vec3(1.0, 0.0, 0.0));
    let dt = 0.5;
    let mut solver = Solver::new(spec.clone()).unwrap();
    let mut flow = solver.start();
    // The lid is felt before the fluid moves: 2 U in the ghosts.
    let limit = |speed: f64| {
        brazilnut_fluid::step_limits(&spec, speed).iter().map(|l| l.1).fold(f64::INFINITY, f64::min)
    };
    assert_eq!(solver.substeps(&flow, dt), (dt / (0.8 * limit(2.0))).ceil() as u64);
    let mut fixed = Solver::new(FluidSpec { adaptive: false, ..spec.clone() }).unwrap();
    assert_eq!(fixed.substeps(&flow, dt), 1);
    let mut other = fixed.start();
    for index in 0..8 {
        let tick = Tick::at(index, dt);
        let parts = solver.substeps(&flow, dt);
        for k in 0..parts {
            solver.advance(&mut flow, tick.substep(k, parts), Vec3::ZERO, &Medium::default(), |_| {});
        }
        solver.health(&flow, tick).unwrap();
        for k in 0..400 {
            fixed.advance(&mut other, tick.substep(k, 400), Vec3::ZERO, &Medium::default(), |_| {});
        }
    }
    let both = flow.velocity.x.values.iter().zip(&other.velocity.x.values);
    let apart = both.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    // Second order in parts of a Courant number of 0.4, against parts a tenth as long.
    assert!(apart < 5e-3, "{apart}");
    *flow.velocity.x.at_mut(3, 0, 4) = f64::NAN;
    assert_eq!(solver.substeps(&flow, dt), 1);
}

#[test]
fn blowups_have_an_address() {
    let grid = Grid::new([8, 8, 8], [0.01; 3], [Side::Walls; 3]);
    let mut solver = Solver::new(FluidSpec::new(grid, 1000.0, 1e-3)).unwrap();
    let mut flow = solver.start();
    let tick = Tick::at(4, 1e-3);
    assert!(solver.health(&flow, tick).is_ok());
    *flow.velocity.x.at_mut(3, 4, 5) = 100.0;
    let blowup = solver.health(&flow, tick).unwrap_err();
    assert!(blowup.quantity.contains("Courant number 10.000") && blowup.place == "fluid cell (3, 4, 5)");
    solver.advance(&mut flow, tick, Vec3::ZERO, &Medium::default(), |_| {});
    assert!(solver.health(&flow, tick).is_err(), "the step's own watch sees it too");
    *flow.velocity.z.at_mut(1, 2, 3) = f64::NAN;
    solver.advance(&mut flow, tick, Vec3::ZERO, &Medium::default(), |_| {});
    assert!(solver.health(&flow, tick).unwrap_err().quantity.contains("not finite"));
}

#[test]
fn central_advection_keeps_the_energy_of_an_inviscid_flow() {
    let grid = Grid::new([12, 12, 12], [0.1; 3], [Side::Walls, Side::Periodic, Side::Walls]);
    let mut spec = FluidSpec::new(grid, 1.0, 0.0);
    for axis in [0, 2] {
        spec.sides[axis] = [Boundary::FreeSlip, Boundary::FreeSlip];
    }
    let drift = |dt: f64| {
        let mut solver = Solver::new(spec.clone()).unwrap();
        let mut flow = solver.start();
        stir(&solver, &mut flow, 1.0);
        solver.advance(&mut flow, Tick::at(0, 1e-12), Vec3::ZERO, &Medium::default(), |_| {});
        // That step only removed the divergence; its pressure is an impulse and not part of the flow.
        flow.past = None;
        flow.pressure = CellField::new(solver.grid());
        let energy = |flow: &Flow| -> f64 {
            let grid = solver_grid(&spec);
            (0..3)
                .map(|a| {
                    let [x, y, z] = grid.face_range(a);
                    let l = grid.layout();
                    let mut sum = 0.0;
                    for k in z {
                        for j in y.clone() {
                            for i in x.clone() {
                                sum += flow.velocity.component(a)[l.index(i, j, k)].powi(2);
                            }
                        }
                    }
                    sum
                })
                .sum()
        };
        let before = energy(&flow);
        let steps = (0.05 / dt).round() as u64;
        for index in 0..steps {
            solver.advance(&mut flow, Tick::at(index, dt), Vec3::ZERO, &Medium::default(), |_| {});
        }
        (energy(&flow) / before - 1.0).abs()
    };
    // In space the scheme conserves exactly; what is left is the time scheme, of second order or better.
    let (coarse, fine) = (drift(2e-3), drift(5e-4));
    assert!(fine < coarse / 12.0 && fine < 1e-4, "{coarse} {fine}");
}

fn solver_grid(spec: &FluidSpec) -> Grid {
    Solver::new(spec.clone()).unwrap().grid().clone()
}

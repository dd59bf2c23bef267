//! Solids inside the fluid, and media that the fluid flows through.

use brazilnut_base::{Side, Tick, Vec3, vec3};
use brazilnut_fluid::{
    Boundary, Faces, Flow, FluidSpec, Grid, Medium, Mixture, Profile, Resistance, Scheme, Solid, Solver,
};

const WALLS: [Side; 3] = [Side::Walls; 3];

/// A reproducible number in -1..1 for each place.
fn noise(seed: usize, at: usize) -> f64 {
    let x = (seed.wrapping_mul(7919) ^ at.wrapping_mul(104_729)).wrapping_mul(2_654_435_761) % 1_000_003;
    2.0 * x as f64 / 1_000_003.0 - 1.0
}

fn stir(solver: &Solver, flow: &mut Flow) {
    for axis in 0..3 {
        if solver.grid().sides[axis] != Side::Flat {
            for (at, v) in flow.velocity.component_mut(axis).iter_mut().enumerate() {
                *v = noise(axis, at);
            }
        }
    }
    solver.refresh(flow, 0.0);
}

/// max |div(flux)| over the cells.
fn divergence(grid: &Grid, flux: &Faces) -> f64 {
    let h = grid.spacing;
    let [x, y, z] = grid.cell_range();
    let mut worst = 0.0_f64;
    for k in z {
        for j in y.clone() {
            for i in x.clone() {
                let d = (flux.x.at(i + 1, j, k) - flux.x.at(i, j, k)) / h[0]
                    + (flux.y.at(i, j + 1, k) - flux.y.at(i, j, k)) / h[1]
                    + (flux.z.at(i, j, k + 1) - flux.z.at(i, j, k)) / h[2];
                worst = worst.max(d.abs());
            }
        }
    }
    worst
}

#[test]
fn a_clear_medium_changes_nothing() {
    for scheme in [Scheme::FirstOrder, Scheme::SecondOrder] {
        for sides in
            [WALLS, [Side::Periodic, Side::Walls, Side::Periodic], [Side::Walls, Side::Flat, Side::Walls]]
        {
            let cells = [0, 1, 2].map(|a| if sides[a] == Side::Flat { 1 } else { [12, 10, 8][a] });
            let mut spec =
                FluidSpec { scheme, ..FluidSpec::new(Grid::new(cells, [0.1; 3], sides), 1000.0, 1.0) };
            if sides[0] == Side::Walls {
                spec.sides[0] = [
                    Boundary::Inflow { profile: Profile::Uniform(0.5) },
                    Boundary::Outflow { pressure: 3.0 },
                ];
            }
            let mut solver = Solver::new(spec.clone()).unwrap();
            let mut other = Solver::new(spec).unwrap();
            let mut flow = solver.start();
            stir(&solver, &mut flow);
            let mut twin = flow.clone();
            let medium = Medium {
                mixture: Some(Mixture::clear(solver.grid())),
                resistance: Some(Resistance::none(solver.grid())),
            };
            for index in 0..3 {
                let tick = Tick::at(index, 1e-3);
                solver.advance(&mut flow, tick, Vec3::X, &Medium::default(), |_| {});
                other.advance(&mut twin, tick, Vec3::X, &medium, |_| {});
            }
            for axis in 0..3 {
                let [x, y, z] = solver.grid().face_range(axis);
                for (k, j) in z.flat_map(|k| y.clone().map(move |j| (k, j))) {
                    for i in x.clone() {
                        let at = solver.grid().layout().index(i, j, k);
                        let (a, b) = (flow.velocity.component(axis)[at], twin.velocity.component(axis)[at]);
                        // The iteration stops at 1e-11 of v / h; the direct solver at rounding.
                        assert!((a - b).abs() < 1e-10, "{sides:?} {a} {b}");
                    }
                }
            }
            let [x, y, z] = solver.grid().cell_range();
            for (k, j) in z.flat_map(|k| y.clone().map(move |j| (k, j))) {
                for i in x.clone() {
                    let (a, b) = (flow.pressure.at(i, j, k), twin.pressure.at(i, j, k));
                    assert!((a - b).abs() < 1e-4, "of about 1e4 Pa: {sides:?} {a} {b}");
                }
            }
        }
    }
}

#[test]
fn nothing_flows_through_solids_and_volume_balances() {
    let grid = Grid::new([16, 12, 20], [0.01; 3], [Side::Walls, Side::Periodic, Side::Walls]);
    let mut spec = FluidSpec::new(grid, 1000.0, 1e-2);
    spec.sides[2][1] = Boundary::lid(vec3(0.3, 0.1, 0.0));
    // A partition with holes below and above, a plate, and a block in a corner across the periodic side.
    spec.solids = vec![
        Solid { low: [7, 0, 3], high: [9, 12, 17] },
        Solid { low: [0, 2, 8], high: [4, 9, 8] },
        Solid { low: [12, 9, 0], high: [16, 12, 5] },
    ];
    let mut solver = Solver::new(spec).unwrap();
    let mut flow = solver.start();
    stir(&solver, &mut flow);
    for index in 0..4 {
        solver.advance(&mut flow, Tick::at(index, 1e-4), vec3(0.0, 0.4, -9.81), &Medium::default(), |p| {
            for axis in 0..3 {
                for (at, v) in p.velocity.component_mut(axis).iter_mut().enumerate() {
                    *v += 0.1 * noise(axis + 7, at);
                }
            }
        });
        solver.health(&flow, Tick::at(index, 1e-4)).unwrap();
    }
    let c = solver.convergence().unwrap();
    assert!(c.converged && c.iterations < 60, "{c:?}");
    let grid = solver.grid();
    // The promise: 1e-10 of max |v| / h, with |v| near 1 m/s and h = 1 cm.
    assert!(divergence(grid, &flow.velocity) < 1e-8);
    for k in 3..17 {
        for j in 0..12 {
            for i in 7..=9 {
                assert_eq!(flow.velocity.x.at(i, j, k), 0.0);
            }
        }
    }
    for j in 2..9 {
        for i in 0..4 {
            assert_eq!(flow.velocity.z.at(i, j, 8), 0.0);
        }
    }
    assert_eq!(flow.velocity.y.at(13, 0, 2), 0.0, "the block's far face is face 0 of the periodic side");
    // What passes the hole below the partition comes back above it.
    let through = |k: std::ops::Range<isize>| -> f64 {
        k.map(|k| (0..12).map(|j| flow.velocity.x.at(8, j, k)).sum::<f64>()).sum()
    };
    let (below, above) = (through(0..3), through(17..20));
    assert!((below + above).abs() < 1e-9 * below.abs().max(1.0), "{below} {above}");
    assert!(below.abs() > 1e-3, "something flows: {below}");
}

#[test]
fn a_plate_divides_a_channel_into_two() {
    // Poiseuille flow in the half-channels between walls at 0 and 1 and a plate or slab inside.
    for (solid, low, high) in [
        (Solid { low: [0, 0, 12], high: [4, 1, 12] }, 0.0, 0.5),
        (Solid { low: [0, 0, 10], high: [4, 1, 14] }, 0.0, 10.0 / 24.0),
        (Solid { low: [0, 0, 10], high: [4, 1, 14] }, 14.0 / 24.0, 1.0),
    ] {
        for scheme in [Scheme::FirstOrder, Scheme::SecondOrder] {
            let sides = [Side::Periodic, Side::Flat, Side::Walls];
            let grid = Grid::new([4, 1, 24], [1.0 / 24.0; 3], sides);
            let mut spec = FluidSpec { scheme, ..FluidSpec::new(grid, 1.0, 0.2) };
            spec.solids = vec![solid];
            let mut solver = Solver::new(spec).unwrap();
            let mut flow = solver.start();
            for index in 0..3000 {
                solver.advance(&mut flow, Tick::at(index, 1e-3), Vec3::X, &Medium::default(), |_| {});
            }
            for k in 0..24 {
                let z = solver.grid().cell_center(0, 0, k).z;
                if z > low && z < high {
                    let u = flow.velocity.x.at(1, 0, k);
                    // Second differences reproduce a parabola except for the wall cell's h²/8 g/nu, 1.1e-3.
                    let exact = (z - low) * (high - z) / (2.0 * 0.2);
                    assert!(
                        (u - exact - 1.0 / (8.0 * 0.2 * 576.0)).abs() < 1e-6,
                        "{scheme:?} {z}: {u} {exact}"
                    );
                }
            }
        }
    }
}

#[test]
fn a_porous_bed_obeys_the_balance_of_the_mixture() {
    let grid = Grid::new([6, 5, 18], [0.002; 3], [Side::Periodic, Side::Walls, Side::Walls]);
    for scheme in [Scheme::FirstOrder, Scheme::SecondOrder] {
        let spec = FluidSpec { scheme, ..FluidSpec::new(grid.clone(), 1000.0, 1e-3) };
        let mut solver = Solver::new(spec).unwrap();
        let grid = solver.grid().clone();
        let mut flow = solver.start();
        stir(&solver, &mut flow);
        let mut mixture = Mixture::clear(&grid);
        let mut resistance = Resistance::none(&grid);
        for axis in 0..3 {
            for (at, phi) in mixture.porosity.component_mut(axis).iter_mut().enumerate() {
                *phi = 0.7 + 0.3 * noise(axis + 3, at);
            }
            for (at, flux) in mixture.solids_flux.component_mut(axis).iter_mut().enumerate() {
                *flux = 0.1 * noise(axis + 11, at);
            }
            resistance.rate.component_mut(axis).fill(500.0);
        }
        // Periodic along x: the repeated face and the ghosts carry the same medium.
        for k in -2..20 {
            for j in -2..7 {
                for f in [&mut mixture.porosity.x, &mut mixture.solids_flux.x] {
                    *f.at_mut(6, j, k) = f.at(0, j, k);
                }
            }
        }
        let medium = Medium { mixture: Some(mixture), resistance: Some(resistance) };
        for index in 0..3 {
            let tick = Tick::at(index, 1e-5);
            solver.advance(&mut flow, tick, vec3(0.0, 0.0, -9.81), &medium, |_| {});
            solver.health(&flow, tick).unwrap();
        }
        let mixture = medium.mixture.as_ref().unwrap();
        let mut flux = flow.velocity.clone();
        for axis in 0..3 {
            let (phi, solids) = (mixture.porosity.component(axis), mixture.solids_flux.component(axis));
            for ((v, phi), solids) in flux.component_mut(axis).iter_mut().zip(phi).zip(solids) {
                *v = phi * *v + solids;
            }
        }
        // Grains push nothing through walls.
        for k in 0..18 {
            for i in 0..6 {
                (*flux.y.at_mut(i, 0, k), *flux.y.at_mut(i, 5, k)) = (0.0, 0.0);
            }
        }
        for j in 0..5 {
            for i in 0..6 {
                (*flux.z.at_mut(i, j, 0), *flux.z.at_mut(i, j, 18)) = (0.0, 0.0);
            }
        }
        // 1e-10 of max |v| / h, about 1 / 0.002.
        assert!(divergence(&grid, &flux) < 5e-8, "{}", divergence(&grid, &flux));
        assert!(solver.convergence().unwrap().iterations < 40, "{:?}", solver.convergence());
    }
}

#[test]
fn flow_through_a_fixed_bed_loses_the_pressure_of_darcy() {
    // Upward flow of superficial speed V through a bed of porosity phi: -dP/dz = rho beta V / phi.
    let (phi, beta, speed) = (0.4, 2000.0, 0.01);
    for scheme in [Scheme::FirstOrder, Scheme::SecondOrder] {
        let grid = Grid::new([4, 4, 16], [0.001; 3], [Side::Periodic, Side::Periodic, Side::Walls]);
        let mut spec = FluidSpec { scheme, ..FluidSpec::new(grid, 1000.0, 1e-3) };
        spec.sides[2] =
            [Boundary::Inflow { profile: Profile::Uniform(speed) }, Boundary::Outflow { pressure: 50.0 }];
        let mut solver = Solver::new(spec).unwrap();
        let mut flow = solver.start();
        let mut mixture = Mixture::clear(solver.grid());
        let mut resistance = Resistance::none(solver.grid());
        for k in 4..=12 {
            for j in -2..6 {
                for i in -2..6 {
                    *mixture.porosity.z.at_mut(i, j, k) = phi;
                    *resistance.rate.z.at_mut(i, j, k) = beta;
                }
            }
        }
        let medium = Medium { mixture: Some(mixture), resistance: Some(resistance) };
        for index in 0..400 {
            solver.advance(&mut flow, Tick::at(index, 1e-4), Vec3::ZERO, &medium, |_| {});
        }
        assert!((flow.velocity.z.at(1, 1, 8) - speed / phi).abs() < 1e-9);
        // Inside the bed the profile is uniform, so no advection or viscosity: the law holds to tolerance.
        let slope = (flow.pressure.at(1, 1, 9) - flow.pressure.at(1, 1, 7)) / 0.002;
        let expected = -1000.0 * beta * speed / phi;
        assert!((slope / expected - 1.0).abs() < 1e-6, "{scheme:?}: {slope} {expected}");
        let top = flow.pressure.at(1, 1, 15);
        assert!((top - 50.0).abs() < 1e-6, "the outlet holds its pressure: {top}");
    }
}

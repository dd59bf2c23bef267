//! Nothing is made and nothing is lost between fluid and grains.

mod common;

use brazilnut_base::{Side, Vec3, vec3};
use brazilnut_coupling::Method;
use brazilnut_fluid::Scheme;
use common::{Plan, forcing, rig, springs, springs_for};

fn methods() -> [Method; 3] {
    let dt = Plan::cube(16, forcing()).dt();
    [forcing(), springs(0.5, dt), Method::Template]
}

#[test]
fn a_grain_at_rest_in_fluid_at_rest_stays() {
    for method in methods() {
        let mut rig = rig(Plan::cube(16, method), &[(vec3(7.7e-4, 8.1e-4, 8.4e-4), 3e-4, 2.5)]);
        for _ in 0..20 {
            rig.step(Vec3::ZERO, Vec3::ZERO, Vec3::ZERO);
        }
        assert_eq!(rig.grains.velocity[0], Vec3::ZERO, "{method:?}");
        assert_eq!(rig.fluid_momentum(), Vec3::ZERO);
    }
}

/// A cell that is shaken in any way, with gravity: what has the fluid's density moves with the fluid.
#[test]
fn a_shaken_frame_does_nothing_to_a_neutral_grain() {
    for scheme in [Scheme::FirstOrder, Scheme::SecondOrder] {
        let mut plan = Plan::cube(16, forcing());
        plan.sides = [Side::Walls; 3];
        plan.scheme = scheme;
        let mut rig = rig(plan, &[(vec3(7.7e-4, 8.1e-4, 8.4e-4), 3e-4, 1.0)]);
        let (g, a) = (vec3(0.0, 0.0, -9.81), vec3(3.0, -20.0, 15.0));
        for _ in 0..20 {
            rig.step(g, a, g - a);
        }
        let speed = rig.grains.velocity[0].length();
        // Rounding of the weight, 1e-16, over 20 steps of 0.2 ms at 30 m/s².
        assert!(speed < 1e-15, "{scheme:?}: {speed}");
    }
}

/// A cell that falls with its grains and its fluid: no weight, whatever the density.
#[test]
fn a_freely_falling_frame_does_nothing() {
    for method in methods() {
        let plan = Plan { sides: [Side::Walls; 3], ..Plan::cube(16, method) };
        let mut rig = rig(plan, &[(vec3(7.7e-4, 8.1e-4, 8.4e-4), 3e-4, 2.5)]);
        let g = vec3(0.3, -1.7, -9.81);
        for _ in 0..20 {
            rig.step(g, g, Vec3::ZERO);
        }
        assert_eq!(rig.grains.velocity[0], Vec3::ZERO, "{method:?}");
        assert_eq!(rig.fluid_momentum(), Vec3::ZERO);
    }
}

/// Fluid, grains and the fluid that they enclose: no wall, no force from outside, so the sum stands.
#[test]
fn momentum_is_kept_to_rounding() {
    let plan = Plan::cube(20, forcing());
    for (plan, substeps) in
        [(plan.clone(), 1), (plan.clone(), 4), (springs_for(&plan, 0.5), 1), (springs_for(&plan, 0.5), 3)]
    {
        let plan = Plan { substeps, ..plan };
        let bodies =
            [(vec3(4.7e-4, 8.1e-4, 8.4e-4), 3e-4, 2.5), (vec3(13.2e-4, 10.1e-4, 19.4e-4), 4e-4, 1.6)];
        let mut rig = rig(plan, &bodies);
        rig.launch(vec3(5e-3, -2e-3, 1e-3), vec3(3.0, 1.0, -4.0));
        let sum = |r: &common::Rig| {
            let enclosed: Vec3 = r.state.enclosed.iter().map(|e| e.momentum).sum();
            r.fluid_momentum() + r.grain_momentum() - enclosed
        };
        rig.step(Vec3::ZERO, Vec3::ZERO, Vec3::ZERO);
        let start = sum(&rig);
        let moved = rig.fluid_momentum();
        for _ in 0..50 {
            rig.step(Vec3::ZERO, Vec3::ZERO, Vec3::ZERO);
            let left = rig.state.exchange.residual();
            // Rounding of sums of 24 000 faces whose moduli sum to some ten times the momentum.
            assert!(left.length() < 1e-13 * rig.state.exchange.on_fluid.length());
        }
        let drift = (sum(&rig) - start).length();
        assert!(drift < 1e-13 * start.length(), "{:?}: drift {drift} of {start}", rig.plan.method);
        // The grains did give something away.
        assert!((rig.fluid_momentum() - moved).length() > 1e-3 * start.length());
    }
}

/// What turns the grain turns the fluid back: torque given and taken, about the grain's centre.
#[test]
fn torque_is_given_and_taken() {
    for method in [forcing(), springs(0.5, Plan::cube(16, forcing()).dt())] {
        let mut rig = rig(Plan::cube(16, method), &[(vec3(7.7e-4, 8.1e-4, 8.4e-4), 3e-4, 2.5)]);
        rig.launch(Vec3::ZERO, vec3(0.0, 0.0, 10.0));
        let angular = |r: &common::Rig| {
            let (grid, v) = (r.solver.grid(), &r.flow.velocity);
            let mut sum = Vec3::ZERO;
            for c in 0..3 {
                let [a, b, d] = grid.face_range(c);
                for k in d {
                    for j in b.clone() {
                        for i in a.clone() {
                            let arm = grid.face_center(c, i, j, k) - r.grains.position[0];
                            sum += arm.cross(v.component(c)[v.layout().index(i, j, k)] * Vec3::AXES[c]);
                        }
                    }
                }
            }
            common::RHO * grid.cell_volume() * sum
        };
        rig.step(Vec3::ZERO, Vec3::ZERO, Vec3::ZERO);
        let enclosed = rig.state.enclosed.first().map_or(Vec3::ZERO, |e| e.angular);
        let taken = -rig.plan.dt() * rig.state.loads[0].torque + enclosed;
        let received = angular(&rig);
        // The projection moves a little angular momentum to the periodic images: 1 % of what was given.
        assert!((received - taken).length() < 0.01 * taken.length(), "{method:?}: {received} of {taken}");
        assert!(received.z > 0.0);
    }
}

/// One cell of the grid further is the same answer; so is a quarter turn.
#[test]
fn the_answer_moves_and_turns_with_the_case() {
    for method in methods() {
        let run = |at: Vec3, u: Vec3| {
            let mut rig = rig(Plan::cube(16, method), &[(at, 3e-4, 2.5)]);
            rig.launch(u, Vec3::ZERO);
            for _ in 0..10 {
                rig.step(Vec3::ZERO, Vec3::ZERO, Vec3::ZERO);
            }
            rig.grains.velocity[0]
        };
        let at = vec3(7.7e-4, 8.1e-4, 8.4e-4);
        let u = vec3(0.01, 0.004, -0.002);
        let v = run(at, u);
        let moved = run(at + vec3(1e-4, 0.0, -2e-4), u);
        // A quarter turn about z through the middle of the box: (x, y) -> (-y, x).
        let turned = run(vec3(16e-4 - at.y, at.x, at.z), vec3(-u.y, u.x, u.z));
        // Rounding of places and sums, grown over ten steps.
        assert!((v - moved).length() < 1e-10 * v.length(), "{method:?}: {v} and {moved}");
        assert!(
            (vec3(-v.y, v.x, v.z) - turned).length() < 1e-10 * v.length(),
            "{method:?}: {v} and {turned}"
        );
    }
}

/// The same fall along each axis of a cell that is turned with it: other axes are contiguous in memory.
#[test]
fn a_fall_along_any_axis_is_the_same_fall() {
    for method in methods() {
        let fall = |axis: usize| {
            let turn = move |v: Vec3| {
                let mut t = Vec3::ZERO;
                for c in 0..3 {
                    t[(c + axis) % 3] = v[c];
                }
                t
            };
            let mut plan = Plan::cube(16, method);
            plan.sides = [Side::Periodic; 3];
            plan.sides[axis] = Side::Walls;
            plan.cells[axis] = 24;
            let at = turn(vec3(12.3e-4, 8.1e-4, 8.4e-4));
            let mut rig = rig(plan, &[(at, 3e-4, 2.5)]);
            rig.launch(Vec3::ZERO, turn(vec3(2.0, -1.0, 3.0)));
            let g = turn(vec3(-1.0, 0.0, 0.0));
            for _ in 0..10 {
                rig.step(g, Vec3::ZERO, g);
            }
            (turn, rig.grains.velocity[0], rig.grains.angular_velocity[0])
        };
        let (_, u, w) = fall(0);
        for axis in 1..3 {
            let (turn, v, s) = fall(axis);
            // Rounding of places and of the pressure solve, whose line axis differs, grown over ten steps.
            assert!((turn(u) - v).length() < 1e-9 * u.length(), "{method:?} {axis}: {u} and {v}");
            assert!((turn(w) - s).length() < 1e-9 * w.length(), "{method:?} {axis}: {w} and {s}");
        }
    }
}

/// Enough tracers that the sweeps go over to several threads.
#[test]
fn same_bits_for_any_number_of_threads() {
    let side = 6;
    for method in methods() {
        let mut plan = Plan::cube(40, method);
        plan.cells[2] = 48;
        plan.sides = [Side::Periodic, Side::Walls, Side::Periodic];
        let bodies: Vec<(Vec3, f64, f64)> = (0..side * side * side)
            .map(|k| {
                let place = vec3((k % side) as f64, (k / side % side) as f64, (k / side / side) as f64);
                (1e-4 * (6.6 * place + vec3(3.4, 3.5, 3.3)), 3e-4, 2.5)
            })
            .collect();
        let run = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let mut rig = rig(plan.clone(), &bodies);
                if let Some(work) = rig.coupling.tracers() {
                    assert!(work.templates.count() > brazilnut_coupling::resolved::schedule::WORTH_THREADS);
                }
                for k in 0..bodies.len() {
                    let t = k as f64;
                    rig.grains.velocity[k] = 0.02 * vec3((0.7 * t).sin(), (1.3 * t).cos(), (2.1 * t).sin());
                    rig.grains.angular_velocity[k] = 5.0 * vec3((0.3 * t).cos(), (0.9 * t).sin(), 0.1);
                }
                rig.beads = rig.dem.start(&rig.grains).unwrap();
                for _ in 0..4 {
                    rig.step(vec3(0.0, 0.0, -9.81), Vec3::ZERO, Vec3::ZERO);
                }
                (rig.grains.position, rig.grains.velocity, rig.flow.velocity, rig.state)
            })
        };
        let one = run(1);
        for threads in [2, 3] {
            assert!(run(threads) == one, "{method:?} with {threads} threads");
        }
    }
}

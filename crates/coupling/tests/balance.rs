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

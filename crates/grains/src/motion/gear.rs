//! Gear's predictor-corrector.

use super::Pace;
use super::quad::Quad;
use super::scheme::{Moved, Scheme};
use brazilnut_base::Vec3;

/// Prediction by Taylor series up to the third derivative, correction by the
/// error of the acceleration (Clément eq. 2.13-2.15).
///
/// Rows hold the predicted position and velocity, at which the force is
/// evaluated; `higher` the predicted acceleration and its derivative.
#[derive(Clone, Copy, Debug)]
pub struct Gear;

/// Gear's coefficients for a second-order equation with four values, scaled
/// so that each multiplies (a - a_p) dt²/2 in units of r, v dt, a dt²/2, b dt³/6.
const C: [f64; 4] = [1.0 / 6.0, 5.0 / 6.0, 1.0, 1.0 / 3.0];

impl Scheme for Gear {
    const HIGHER: bool = true;

    #[inline(always)]
    fn translate<Q: Quad>(
        r: Q,
        v: Q,
        half: &mut [f64; 8],
        higher: &mut [f64; 12],
        a: Q,
        pace: &Pace,
    ) -> Moved<Q> {
        let dt = pace.tick.dt;
        let (a_p, b_p) = if pace.kick.first { (a, Q::splat(0.0)) } else { (get(higher, 0), get(higher, 3)) };
        let error = (a - a_p) * (0.5 * dt * dt);
        let r_c = r + error * C[0];
        let v_c = v + error * (C[1] / dt);
        let b_c = b_p + error * (C[3] * 6.0 / (dt * dt * dt));
        v_c.with(half[3]).store(half, 0);
        put(higher, 0, a + b_c * dt);
        put(higher, 3, b_c);
        let position = r_c + v_c * dt + a * (0.5 * dt * dt) + b_c * (dt * dt * dt / 6.0);
        Moved { position, velocity: v_c + a * dt + b_c * (0.5 * dt * dt), middle: v_c, step: position - r }
    }

    #[inline(always)]
    fn rotate<Q: Quad>(
        omega: Q,
        half: &mut [f64; 8],
        higher: &mut [f64; 12],
        alpha: Q,
        pace: &Pace,
    ) -> (Q, Q) {
        let dt = pace.tick.dt;
        let (a_p, b_p) =
            if pace.kick.first { (alpha, Q::splat(0.0)) } else { (get(higher, 6), get(higher, 9)) };
        let error = (alpha - a_p) * (0.5 * dt * dt);
        let omega_c = omega + error * (C[1] / dt);
        let b_c = b_p + error * (C[3] * 6.0 / (dt * dt * dt));
        omega_c.with(half[7]).store(half, 4);
        put(higher, 6, alpha + b_c * dt);
        put(higher, 9, b_c);
        (omega_c, omega_c + alpha * dt + b_c * (0.5 * dt * dt))
    }

    fn half_of(v: Vec3, _: f64) -> Vec3 {
        v
    }
}

/// Three numbers from place `at` on as a vector.
#[inline(always)]
fn get<Q: Quad>(higher: &[f64; 12], at: usize) -> Q {
    Q::of([higher[at], higher[at + 1], higher[at + 2], 0.0])
}

/// Writes a vector there.
#[inline(always)]
fn put<Q: Quad>(higher: &mut [f64; 12], at: usize, v: Q) {
    higher[at..at + 3].copy_from_slice(&v.lanes()[..3]);
}

//! Gear's predictor-corrector.

use super::Pace;
use super::scheme::{Moved, Scheme, get, put};
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
    fn translate(
        r: Vec3,
        v: Vec3,
        half: &mut [f64; 8],
        higher: &mut [f64; 12],
        a: Vec3,
        pace: &Pace,
    ) -> Moved {
        let dt = pace.tick.dt;
        let (a_p, b_p) = if pace.kick.first { (a, Vec3::ZERO) } else { (get(higher, 0), get(higher, 3)) };
        let error = (a - a_p) * (0.5 * dt * dt);
        let r_c = r + C[0] * error;
        let v_c = v + C[1] * error / dt;
        let b_c = b_p + C[3] * error * (6.0 / (dt * dt * dt));
        put(half, 0, v_c);
        put(higher, 0, a + b_c * dt);
        put(higher, 3, b_c);
        let position = r_c + v_c * dt + a * (0.5 * dt * dt) + b_c * (dt * dt * dt / 6.0);
        Moved { position, velocity: v_c + a * dt + b_c * (0.5 * dt * dt), middle: v_c, step: position - r }
    }

    #[inline(always)]
    fn rotate(
        omega: Vec3,
        half: &mut [f64; 8],
        higher: &mut [f64; 12],
        alpha: Vec3,
        pace: &Pace,
    ) -> (Vec3, Vec3) {
        let dt = pace.tick.dt;
        let (a_p, b_p) = if pace.kick.first { (alpha, Vec3::ZERO) } else { (get(higher, 6), get(higher, 9)) };
        let error = (alpha - a_p) * (0.5 * dt * dt);
        let omega_c = omega + C[1] * error / dt;
        let b_c = b_p + C[3] * error * (6.0 / (dt * dt * dt));
        put(half, 4, omega_c);
        put(higher, 6, alpha + b_c * dt);
        put(higher, 9, b_c);
        (omega_c, omega_c + alpha * dt + b_c * (0.5 * dt * dt))
    }

    fn half_of(v: Vec3, _: f64) -> Vec3 {
        v
    }
}

//! Verlet's scheme in its two forms.

use super::Pace;
use super::quad::Quad;
use super::scheme::{Moved, Scheme};
use brazilnut_base::Vec3;

/// v(t + dt/2) = v(t - dt/2) + a dt, r(t + dt) = r(t) + v(t + dt/2) dt.
///
/// Contact forces at t + dt see v(t + dt/2) + a(t) dt/2, which is of second
/// order; the half-step velocity would bias damping and friction by one order.
#[derive(Clone, Copy, Debug)]
pub struct VelocityVerlet;

impl Scheme for VelocityVerlet {
    const HIGHER: bool = false;

    #[inline(always)]
    fn translate<Q: Quad>(r: Q, _: Q, half: &mut [f64; 8], _: &mut [f64; 12], a: Q, pace: &Pace) -> Moved<Q> {
        let dt = pace.tick.dt;
        let before = Q::load(half, 0);
        let after = before + a * pace.kick.length;
        after.store(half, 0);
        let step = after * dt;
        Moved { position: r + step, velocity: after + a * (0.5 * dt), middle: (before + after) * 0.5, step }
    }

    #[inline(always)]
    fn rotate<Q: Quad>(_: Q, half: &mut [f64; 8], _: &mut [f64; 12], alpha: Q, pace: &Pace) -> (Q, Q) {
        kick_spin(half, alpha, pace)
    }

    fn half_of(v: Vec3, _: f64) -> Vec3 {
        v
    }
}

/// r(t + dt) = 2 r(t) - r(t - dt) + a dt² (Clément eq. 2.11).
///
/// Kept as the displacement r(t) - r(t - dt). The velocity is the three-point
/// one, (3 r(t) - 4 r(t - dt) + r(t - 2 dt))/(2 dt); Clément's eq. 2.12 is
/// that of t - dt/2.
#[derive(Clone, Copy, Debug)]
pub struct PositionVerlet;

impl Scheme for PositionVerlet {
    const HIGHER: bool = false;

    #[inline(always)]
    fn translate<Q: Quad>(r: Q, _: Q, half: &mut [f64; 8], _: &mut [f64; 12], a: Q, pace: &Pace) -> Moved<Q> {
        let dt = pace.tick.dt;
        let before = Q::load(half, 0);
        let step = before + a * (dt * pace.kick.length);
        step.store(half, 0);
        Moved {
            position: r + step,
            velocity: (step + a * (0.5 * dt * dt)) * (1.0 / dt),
            middle: (before + step) * (0.5 / dt),
            step,
        }
    }

    #[inline(always)]
    fn rotate<Q: Quad>(_: Q, half: &mut [f64; 8], _: &mut [f64; 12], alpha: Q, pace: &Pace) -> (Q, Q) {
        kick_spin(half, alpha, pace)
    }

    fn half_of(v: Vec3, dt: f64) -> Vec3 {
        v * dt
    }
}

/// The rotation of both forms: angles have no Verlet equation of their own.
#[inline(always)]
fn kick_spin<Q: Quad>(half: &mut [f64; 8], alpha: Q, pace: &Pace) -> (Q, Q) {
    let before = Q::load(half, 4);
    let after = before + alpha * pace.kick.length;
    after.store(half, 4);
    ((before + after) * 0.5, after + alpha * (0.5 * pace.tick.dt))
}

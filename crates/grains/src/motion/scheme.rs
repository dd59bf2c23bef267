//! What an integrator must do for one grain.

use super::Pace;
use super::quad::Quad;
use brazilnut_base::Vec3;

/// How far a step changes half-step velocities.
#[derive(Clone, Copy, Debug)]
pub struct Kick {
    /// Time over which the force acts, s: a whole step, half of one in the first.
    pub length: f64,
    /// This is the first step.
    pub first: bool,
}

/// A grain after its step.
#[derive(Clone, Copy, Debug)]
pub struct Moved<Q> {
    /// Position, m.
    pub position: Q,
    /// Velocity of second order at that time, m/s.
    pub velocity: Q,
    /// Velocity in the middle of the kick, m/s: the force times it is the exact power.
    pub middle: Q,
    /// Displacement, m.
    pub step: Q,
}

/// An integrator; formulae for one grain.
///
/// Forces are evaluated once a step, from the positions and velocities in
/// the rows; `half` keeps what the scheme needs from step to step. The last
/// lane of a vector means nothing, but that of an acceleration is zero and
/// those of `half` are kept.
pub trait Scheme {
    /// Needs `higher`.
    const HIGHER: bool;

    /// Moves a grain at `position` with predicted `velocity` under `acceleration` (m/s²).
    fn translate<Q: Quad>(
        position: Q,
        velocity: Q,
        half: &mut [f64; 8],
        higher: &mut [f64; 12],
        acceleration: Q,
        pace: &Pace,
    ) -> Moved<Q>;

    /// Turns a grain under the angular acceleration `alpha` (1/s²); the angular
    /// velocities in the middle of the kick and at the end of the step.
    fn rotate<Q: Quad>(
        omega: Q,
        half: &mut [f64; 8],
        higher: &mut [f64; 12],
        alpha: Q,
        pace: &Pace,
    ) -> (Q, Q);

    /// What `half` holds at the start for a body with velocity `v`: three numbers.
    fn half_of(v: Vec3, dt: f64) -> Vec3;
}

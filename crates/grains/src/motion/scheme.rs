//! What an integrator must do for one grain.

use super::Pace;
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
pub struct Moved {
    /// Position, m.
    pub position: Vec3,
    /// Velocity of second order at that time, m/s.
    pub velocity: Vec3,
    /// Velocity in the middle of the kick, m/s: the force times it is the exact power.
    pub middle: Vec3,
    /// Displacement, m.
    pub step: Vec3,
}

/// An integrator; formulae for one grain.
///
/// Forces are evaluated once a step, from the positions and velocities in
/// the rows; `half` keeps what the scheme needs from step to step.
pub trait Scheme {
    /// Needs `higher`.
    const HIGHER: bool;

    /// Moves a grain at `position` with predicted `velocity` under `acceleration` (m/s²).
    fn translate(
        position: Vec3,
        velocity: Vec3,
        half: &mut [f64; 8],
        higher: &mut [f64; 12],
        acceleration: Vec3,
        pace: &Pace,
    ) -> Moved;

    /// Turns a grain under the angular acceleration `alpha` (1/s²); the angular
    /// velocities in the middle of the kick and at the end of the step.
    fn rotate(
        omega: Vec3,
        half: &mut [f64; 8],
        higher: &mut [f64; 12],
        alpha: Vec3,
        pace: &Pace,
    ) -> (Vec3, Vec3);

    /// What `half` holds at the start for a body with velocity `v`: three numbers.
    fn half_of(v: Vec3, dt: f64) -> Vec3;
}

/// Three numbers of a row as a vector.
#[inline(always)]
pub fn get(row: &[f64], at: usize) -> Vec3 {
    Vec3::new(row[at], row[at + 1], row[at + 2])
}

/// Writes a vector into a row.
#[inline(always)]
pub fn put(row: &mut [f64], at: usize, v: Vec3) {
    row[at..at + 3].copy_from_slice(&v.to_array());
}

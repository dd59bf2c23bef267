//! How much fluid passes through the grains: the slip that the coupling leaves.

use super::sweep::Tally;
use serde::{Deserialize, Serialize};

/// Slip at the tracers, mean |v_f − v_t| over mean |v_t|, so far and in the last step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Leak {
    /// Sum over steps of the tracers' |v_f − v_t|, m/s.
    slip: f64,
    /// Sum over steps of the tracers' |v_t|, m/s.
    speed: f64,
    /// The last step's ratio.
    last: f64,
}

/// Above this mean leak a body is porous rather than solid and the run warns.
pub const WARNING: f64 = 0.1;

impl Leak {
    /// Books one step.
    pub fn book(&mut self, total: &Tally) {
        self.slip += total.slip;
        self.speed += total.speed;
        self.last = ratio(total.slip, total.speed);
    }

    /// Over all steps: mean slip over mean speed.
    #[must_use]
    pub fn mean(&self) -> f64 {
        ratio(self.slip, self.speed)
    }

    /// In the last step.
    #[must_use]
    pub fn last(&self) -> f64 {
        self.last
    }
}

/// Zero where nothing moves.
fn ratio(slip: f64, speed: f64) -> f64 {
    if speed > 0.0 { slip / speed } else { 0.0 }
}

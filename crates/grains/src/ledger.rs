//! Where the energy came from and where it went.

use serde::{Deserialize, Serialize};

/// Energies in J since the start, each the sum of its own contributions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Ledger {
    /// Kinetic, elastic energy at the start and what was put in by hand since (see `Dem::boost`).
    pub initial: f64,
    /// Work of gravity.
    pub gravity: f64,
    /// Work of the shaken frame.
    pub frame: f64,
    /// Work of moving walls.
    pub walls: f64,
    /// Work of the fluid.
    pub fluid: f64,
    /// Kinetic energy of translation now.
    pub translation: f64,
    /// Kinetic energy of rotation now.
    pub rotation: f64,
    /// Elastic energy now.
    pub elastic: f64,
    /// Lost to normal damping.
    pub damping: f64,
    /// Lost to sliding friction.
    pub sliding: f64,
    /// Lost to tangential damping.
    pub tangential_damping: f64,
    /// Lost to rolling friction.
    pub rolling: f64,
    /// Lost to hysteresis of the springs.
    pub hysteresis: f64,
}

impl Ledger {
    /// Present minus accounted: zero but for the errors of the time step, J.
    #[must_use]
    pub fn residual(&self) -> f64 {
        let now = self.translation + self.rotation + self.elastic;
        now + self.lost() - self.initial - self.gravity - self.frame - self.walls - self.fluid
    }

    /// Energy turned to heat in contacts, J.
    #[must_use]
    pub fn lost(&self) -> f64 {
        self.damping + self.sliding + self.tangential_damping + self.rolling + self.hysteresis
    }

    /// Energy put in: work of the shaker, of walls, and what the others put in on balance, J.
    #[must_use]
    pub fn supplied(&self) -> f64 {
        self.initial + self.frame.max(0.0) + self.walls.max(0.0) + self.gravity.max(0.0) + self.fluid.max(0.0)
    }
}

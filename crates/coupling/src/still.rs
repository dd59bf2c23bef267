//! No fluid: gravity and the inertia of the shaken frame.

use brazilnut_base::{Tick, Vec3};
use brazilnut_grains::{Field, GrainAt, Push};

/// What acts on a dry grain from outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Still {
    /// Acceleration of gravity g, m/s².
    pub gravity: Vec3,
    /// Acceleration a of the cell's frame, m/s²; zero where the frame is at rest.
    pub frame: Vec3,
}

impl Still {
    /// g' = g − a, m/s² (Clément eq. 3.3).
    #[inline]
    #[must_use]
    pub fn modified_gravity(&self) -> Vec3 {
        self.gravity - self.frame
    }

    /// m g and −m a (Clément eq. 3.1).
    #[inline]
    #[must_use]
    pub fn body_forces(&self, mass: f64) -> Push {
        Push { gravity: mass * self.gravity, frame: -mass * self.frame, ..Push::default() }
    }
}

impl Field for Still {
    #[inline(always)]
    fn push(&self, _: &Tick, grain: &GrainAt) -> Push {
        self.body_forces(grain.mass)
    }
}

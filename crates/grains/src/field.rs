//! What acts on a grain from outside.

use brazilnut_base::{Tick, Vec3};

/// A grain as a [`Field`] sees it, at the time of the force.
#[derive(Clone, Copy, Debug)]
pub struct GrainAt {
    /// Identity: index into [`crate::Grains`].
    pub id: usize,
    /// Index of the species.
    pub species: u16,
    /// Radius, m.
    pub radius: f64,
    /// Mass, kg.
    pub mass: f64,
    /// Centre, m.
    pub position: Vec3,
    /// Velocity, m/s.
    pub velocity: Vec3,
    /// Angular velocity, rad/s.
    pub angular_velocity: Vec3,
}

/// Forces on one grain, by origin: the ledger keeps their work apart.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Push {
    /// Gravity (buoyancy of a fluid at rest belongs to `fluid`), N.
    pub gravity: Vec3,
    /// Inertia in the shaken frame, N.
    pub frame: Vec3,
    /// The fluid, N.
    pub fluid: Vec3,
    /// Torque of the fluid, N m.
    pub torque: Vec3,
}

/// What acts on every grain from outside; called once per grain and step.
pub trait Field: Sync {
    /// The forces at the start of step `tick`, which act through the step.
    fn push(&self, tick: &Tick, grain: &GrainAt) -> Push;
}

/// Gravity alone.
#[derive(Clone, Copy, Debug)]
pub struct Gravity(
    /// Acceleration, m/s².
    pub Vec3,
);

impl Field for Gravity {
    #[inline(always)]
    fn push(&self, _: &Tick, grain: &GrainAt) -> Push {
        Push { gravity: self.0 * grain.mass, ..Push::default() }
    }
}

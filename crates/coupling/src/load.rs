//! What the fluid does to the grains through a step.

use crate::body::Body;
use crate::still::Still;
use brazilnut_base::{Side, Tick, Vec3};
use brazilnut_grains::{Field, GrainAt, Push};
use serde::{Deserialize, Serialize};

/// Force and torque of the fluid on one grain, without hydrostatic buoyancy.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Load {
    /// Force, N.
    pub force: Vec3,
    /// Torque about the centre, N m.
    pub torque: Vec3,
}

impl std::ops::AddAssign for Load {
    fn add_assign(&mut self, other: Self) {
        self.force += other.force;
        self.torque += other.torque;
    }
}

impl std::ops::Mul<f64> for Load {
    type Output = Self;
    fn mul(self, s: f64) -> Self {
        Self { force: s * self.force, torque: s * self.torque }
    }
}

/// Loads held through the sub-steps of a fluid step.
#[derive(Clone, Copy, Debug)]
pub struct Held<'a> {
    /// Gravity and frame at the time of the sub-step.
    pub still: Still,
    /// Loads in the order of identity.
    pub loads: &'a [Load],
    /// Density of the fluid, kg/m³.
    pub density: f64,
    /// Body of the grains.
    pub body: Body,
    /// 1 along axes whose hydrostatic pressure the flow does not carry, else 0.
    pub hydrostatic: Vec3,
    /// The engine's mass leaves out the enclosed fluid: M_t = M − rho V.
    pub template_mass: bool,
}

/// Axes along which the pressure takes up gravity: those with walls.
#[must_use]
pub fn hydrostatic_axes(sides: [Side; 3]) -> Vec3 {
    Vec3::from_array(sides.map(|s| if s == Side::Walls { 1.0 } else { 0.0 }))
}

impl Field for Held<'_> {
    #[inline]
    fn push(&self, _: &Tick, grain: &GrainAt) -> Push {
        let displaced = self.density * self.body.volume(grain.radius);
        let load = &self.loads[grain.id];
        let mass = if self.template_mass { grain.mass + displaced } else { grain.mass };
        let lift = -displaced * self.still.modified_gravity() * self.hydrostatic;
        Push { fluid: load.force + lift, torque: load.torque, ..self.still.body_forces(mass) }
    }
}

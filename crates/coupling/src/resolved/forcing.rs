//! `direct-forcing`: the slip at the tracers is removed, several times over (Uhlmann 2005; Breugem 2012).
//!
//! The grain keeps its full mass. The enclosed fluid P = rho integral v dV is taken along by the force:
//!
//! ```text
//! M du/dt = −F + dP/dt + (rho_g − rho) V g' + F_contacts      (Kempe & Fröhlich 2012, eq. 22)
//! ```
//!
//! F being what the forcing gives to the fluid. No division by M − M_f: light bodies stay stable.

use super::sweep::Tally;
use crate::load::Load;
use brazilnut_base::Vec3;
use serde::{Deserialize, Serialize};

/// The coupling of `direct-forcing`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Forcing {
    /// How often the remaining slip is removed in a step.
    pub sweeps: u32,
}

/// Momentum of the fluid that a body encloses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Enclosed {
    /// Momentum, kg m/s.
    pub momentum: Vec3,
    /// Angular momentum about the centre, kg m²/s.
    pub angular: Vec3,
}

impl Enclosed {
    /// From the share-weighted mean velocity and its moment, for an enclosed fluid mass (kg).
    #[must_use]
    pub fn of(mean: &Tally, fluid_mass: f64) -> Self {
        Self { momentum: fluid_mass * mean.impulse, angular: fluid_mass * mean.twist }
    }
}

/// −F + dP/dt, and the same for the torque.
#[must_use]
pub fn load(given: &Tally, before: &Enclosed, after: &Enclosed, dt: f64) -> Load {
    Load {
        force: (after.momentum - before.momentum - given.impulse) / dt,
        torque: (after.angular - before.angular - given.twist) / dt,
    }
}

//! `direct-forcing`: the slip at the tracers is removed, several times over (Uhlmann 2005; Breugem 2012).
//!
//! The grain keeps its full mass. The enclosed fluid P = rho integral v dV is taken along by the force:
//!
//! ```text
//! M du/dt = −F + dP/dt + (rho_g − rho) V g' + F_contacts      (Kempe & Fröhlich 2012, eq. 22)
//! ```
//!
//! F being what the forcing gives to the fluid. No division by M − M_f, which has none left where densities meet.
//!
//! The force answers to the acceleration of the step before, so a body lighter than its added mass M_a would swing up.
//! It is given a virtual mass on both sides (Schwarz, Kempe & Fröhlich 2015), which is the same as to let its load
//! F' follow the new one in part:
//!
//! ```text
//! (M + M_v) F'_n = M F_n + M_v F'_{n-1},   M_v = max(0, M_a − M)
//! ```
//!
//! A held load is the same in the end, and no momentum is lost: M_v F' dt / M is under way.

use super::sweep::Tally;
use crate::body::Body;
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

/// Added mass over displaced fluid of a body of `points` per radius: half for a sphere, one across a cylinder, and what
/// the kernel smears its surface by.
///
/// On the safe side of what was found for explicit loads of spheres: stable at 0.9 of the fluid's density with three points and at 0.6
/// with four and five, unstable at 0.7 with three (`docs/resolved-accuracy.md`).
#[must_use]
pub fn added_mass(body: Body, points: f64) -> f64 {
    let ideal = match body {
        Body::Sphere => 0.5,
        Body::Cylinder { .. } => 1.0,
    };
    ideal * (1.0 + 2.4 / points)
}

/// M / (M + M_v): how far the load of a body with density `ratio` over the fluid's follows in one step.
#[must_use]
pub fn following(body: Body, ratio: f64, points: f64) -> f64 {
    (ratio / added_mass(body, points)).min(1.0)
}

/// −F + dP/dt, and the same for the torque.
#[must_use]
pub fn load(given: &Tally, before: &Enclosed, after: &Enclosed, dt: f64) -> Load {
    Load {
        force: (after.momentum - before.momentum - given.impulse) / dt,
        torque: (after.angular - before.angular - given.twist) / dt,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// G − M_a a from the step before, as the flow answers: the swing dies out for any mass.
    #[test]
    fn a_light_body_settles_on_its_added_mass() {
        let points = 3.0;
        for body in [Body::Sphere, Body::Cylinder { length: 1.0 }] {
            let m_a = added_mass(body, points);
            for ratio in [0.01, 0.1, 0.5, 0.8, 1.0, 1.5, 3.0] {
                let share = following(body, ratio, points);
                let mut held = 0.0;
                for _ in 0..400 {
                    held = share * (1.0 - m_a * held / ratio) + (1.0 - share) * held;
                }
                let exact = ratio / (ratio + m_a);
                assert!((held / exact - 1.0).abs() < 1e-9, "{body:?} {ratio}: {held} of {exact}");
            }
            let heavy = following(body, 1.01 * m_a, points);
            assert!((heavy - 1.0).abs() < 1e-15, "heavier bodies feel the load at once");
        }
    }
}

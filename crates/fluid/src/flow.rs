//! The state of the fluid: all that a resumed run needs.

use crate::field::{CellField, Faces};
use crate::grid::Grid;
use brazilnut_base::Vec3;
use serde::{Deserialize, Serialize};

/// Velocity, pressure, and what the time scheme remembers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Flow {
    /// Fluid velocity on faces, m/s; inside the pores where there is a porosity.
    pub velocity: Faces,
    /// Pressure at cell centres, Pa, without the part that balances `body`.
    pub pressure: CellField,
    /// Rates of the last step, kept by the second-order scheme.
    pub past: Option<Past>,
    /// Uniform acceleration (m/s²) that the pressure absorbed in the last step:
    /// gravity less the acceleration of the frame, along walled directions.
    pub body: Vec3,
}

/// What Adams-Bashforth remembers of the last step.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Past {
    /// Rate of change of velocity that is extrapolated, m/s².
    pub rate: Faces,
    /// Length of that step, s.
    pub dt: f64,
}

impl Flow {
    /// Fluid at rest.
    #[must_use]
    pub fn at_rest(grid: &Grid) -> Self {
        Self { velocity: Faces::new(grid), pressure: CellField::new(grid), past: None, body: Vec3::ZERO }
    }

    /// The pressure that a gauge at `r` (m) adds to `pressure`: `rho body·r`, Pa.
    ///
    /// A column at rest in gravity (body = -g z) has its largest value at the floor.
    #[must_use]
    pub fn base_pressure(&self, density: f64, r: Vec3) -> f64 {
        density * self.body.dot(r)
    }
}

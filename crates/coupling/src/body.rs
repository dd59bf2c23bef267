//! The body that a grain stands for in a fluid.

use brazilnut_base::Cell;
use brazilnut_grains::packing::Shape;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// Shape of the displaced fluid.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Body {
    /// A sphere.
    Sphere,
    /// A cylinder across a flat cell.
    Cylinder {
        /// Extent along the flat direction, m.
        length: f64,
    },
}

impl Body {
    /// The body of grains of `shape` in `cell`.
    #[must_use]
    pub fn of(shape: Shape, cell: &Cell) -> Self {
        match shape {
            Shape::Sphere => Self::Sphere,
            Shape::Cylinder => Self::Cylinder { length: cell.flat_axis().map_or(1.0, |a| cell.size[a]) },
        }
    }

    /// Volume of a grain of radius `r` (m), m³.
    #[inline]
    #[must_use]
    pub fn volume(self, r: f64) -> f64 {
        match self {
            Self::Sphere => 4.0 / 3.0 * PI * r * r * r,
            Self::Cylinder { length } => PI * r * r * length,
        }
    }

    /// Moment of inertia over mass, m², about the centre or the axis, of uniform density.
    #[inline]
    #[must_use]
    pub fn gyration_squared(self, r: f64) -> f64 {
        match self {
            Self::Sphere => 0.4 * r * r,
            Self::Cylinder { .. } => 0.5 * r * r,
        }
    }
}

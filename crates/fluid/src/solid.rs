//! Solid boxes and plates inside the fluid, aligned with the grid.

use crate::grid::Grid;
use brazilnut_base::{Side, Vec3};
use serde::{Deserialize, Serialize};

/// A box of cells that the fluid cannot enter and to which it sticks.
///
/// It spans the planes `low` to `high` of each axis, counted in cells. Where
/// the two are equal along one axis it is a plate without thickness.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Solid {
    /// Lower planes.
    pub low: [usize; 3],
    /// Upper planes.
    pub high: [usize; 3],
}

impl Solid {
    /// The solid from corner `low` to corner `high` (m), moved to the nearest planes of `grid`.
    #[must_use]
    pub fn between(grid: &Grid, low: Vec3, high: Vec3) -> Self {
        let plane = |axis: usize, x: f64| {
            if grid.sides[axis] == Side::Flat {
                usize::from(x > 0.5 * grid.spacing[axis])
            } else {
                (x / grid.spacing[axis]).round().clamp(0.0, grid.cells[axis] as f64) as usize
            }
        };
        let mut s =
            Self { low: [0, 1, 2].map(|a| plane(a, low[a])), high: [0, 1, 2].map(|a| plane(a, high[a])) };
        for axis in 0..3 {
            if grid.sides[axis] == Side::Flat {
                (s.low[axis], s.high[axis]) = (0, 1);
            }
        }
        s
    }
}

//! Porosity mapped from the grains by a partition of unity.

use crate::body::Body;
use brazilnut_base::{Cell, Side, Vec3};
use brazilnut_grains::Grains;
use serde::{Deserialize, Serialize};

/// Fluid fraction on coarse cells.
///
/// Every grain gives its volume to the centres of the eight nearest cells by
/// trilinear weights (Clément eq. 2.67); at a wall the part that would fall
/// outside stays in the outermost cell, so that no volume is lost.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LocalPorosity {
    cells: [usize; 3],
    spacing: Vec3,
    sides: [Side; 3],
    /// Fluid fraction of each cell, x fastest.
    pub values: Vec<f64>,
}

impl LocalPorosity {
    /// Porosity below which the mapped value is not let fall: random packings of
    /// spheres do not go there, and a bed equation diverges at zero.
    pub const FLOOR: f64 = 0.26;
    /// Least solids fraction seen by a bed equation, whose drag is divided by it.
    pub const LEAST_SOLIDS: f64 = 1e-6;

    /// A map of clear fluid on cells nearest to `spacing` (m).
    #[must_use]
    pub fn new(cell: &Cell, spacing: f64) -> Self {
        let mut cells = [1; 3];
        for axis in 0..3 {
            if cell.sides[axis] != Side::Flat {
                cells[axis] = ((cell.size[axis] / spacing).round() as usize).max(1);
            }
        }
        Self::on_cells(cell, cells)
    }

    /// A map of clear fluid on so many `cells` along each axis.
    #[must_use]
    pub fn on_cells(cell: &Cell, cells: [usize; 3]) -> Self {
        let edge = cell.size / Vec3::from_array(cells.map(|n| n as f64));
        let values = vec![1.0; cells.iter().product()];
        Self { cells, spacing: edge, sides: cell.sides, values }
    }

    /// Maps the grains anew.
    pub fn refresh(&mut self, grains: &Grains, body: Body) {
        let per_volume = 1.0 / self.spacing.element_product();
        self.values.fill(1.0);
        for (r, x) in grains.radius.iter().zip(&grains.position) {
            let share = body.volume(*r) * per_volume;
            let (at, weight) = self.corners(*x);
            for corner in 0..8 {
                self.values[at[corner]] -= share * weight[corner];
            }
        }
    }

    /// Fluid fraction at `x` (m), kept between the floor and nearly 1.
    #[inline]
    #[must_use]
    pub fn at(&self, x: Vec3) -> f64 {
        let (at, weight) = self.corners(x);
        let phi: f64 = (0..8).map(|c| weight[c] * self.values[at[c]]).sum();
        phi.clamp(Self::FLOOR, 1.0 - Self::LEAST_SOLIDS)
    }

    /// The eight cells around `x` and their weights.
    fn corners(&self, x: Vec3) -> ([usize; 8], [f64; 8]) {
        let axis = [0, 1, 2].map(|a| self.pair(a, x[a]));
        let [nx, ny, _] = self.cells;
        let mut at = [0; 8];
        let mut weight = [0.0; 8];
        for c in 0..8 {
            let [(i, u), (j, v), (k, w)] = [0, 1, 2].map(|a| axis[a][c >> a & 1]);
            at[c] = i + nx * (j + ny * k);
            weight[c] = u * v * w;
        }
        (at, weight)
    }

    /// The two cells along `axis` around coordinate `x` with their weights.
    fn pair(&self, axis: usize, x: f64) -> [(usize, f64); 2] {
        let n = self.cells[axis] as isize;
        let s = x / self.spacing[axis] - 0.5;
        let i = s.floor();
        let f = s - i;
        let place = |i: isize| match self.sides[axis] {
            Side::Periodic => i.rem_euclid(n),
            Side::Walls | Side::Flat => i.clamp(0, n - 1),
        };
        [(place(i as isize) as usize, 1.0 - f), (place(i as isize + 1) as usize, f)]
    }
}

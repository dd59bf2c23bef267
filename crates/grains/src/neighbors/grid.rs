//! Cells not smaller than the reach of a contact, numbered along the shortest direction first.

use crate::packed::Row;
use brazilnut_base::{Cell, Vec3};

/// A division of space into cells.
#[derive(Clone, Debug, Default)]
pub struct Grid {
    /// Axes from the longest to the shortest.
    axes: [usize; 3],
    /// Number of cells along each of `axes`.
    pub count: [i32; 3],
    low: [f64; 3],
    inverse: [f64; 3],
    /// Whether each of `axes` closes on itself.
    periodic: [bool; 3],
    /// First row of each cell, and one more.
    pub start: Vec<u32>,
}

impl Grid {
    /// Lays cells of at least `reach` (m) over the box from `low` to `high` and
    /// the periodic directions of `cell`; at most a few cells per grain.
    pub fn lay(&mut self, cell: &Cell, [low, high]: [Vec3; 2], reach: f64, grains: usize) {
        let mut length = [0.0; 3];
        for a in 0..3 {
            length[a] = if cell.is_periodic(a) { cell.size[a] } else { high[a] - low[a] };
        }
        self.axes = [0, 1, 2];
        self.axes.sort_by(|&a, &b| length[b].total_cmp(&length[a]));
        let mut width = reach;
        loop {
            for (k, &a) in self.axes.iter().enumerate() {
                self.count[k] = ((length[a] / width) as i32).max(1);
            }
            let cells: i64 = self.count.iter().map(|&n| i64::from(n)).product();
            if cells <= 4 * grains as i64 + 64 {
                break;
            }
            width *= 1.3;
        }
        for (k, &a) in self.axes.iter().enumerate() {
            self.periodic[k] = cell.is_periodic(a);
            self.low[k] = if self.periodic[k] { 0.0 } else { low[a] };
            // A direction without extent is one cell.
            self.inverse[k] = if length[a] > 0.0 { f64::from(self.count[k]) / length[a] } else { 0.0 };
        }
    }

    /// Number of cells.
    #[must_use]
    pub fn cells(&self) -> usize {
        self.count.iter().map(|&n| n as usize).product()
    }

    /// Coordinates of the cell of `row`.
    #[inline]
    #[must_use]
    pub fn place(&self, row: &Row) -> [i32; 3] {
        let mut c = [0; 3];
        for k in 0..3 {
            let t = ((row.0[self.axes[k]] - self.low[k]) * self.inverse[k]) as i32;
            c[k] = t.clamp(0, self.count[k] - 1);
        }
        c
    }

    /// Number of the cell at `c`.
    #[inline]
    #[must_use]
    pub fn number(&self, c: [i32; 3]) -> usize {
        ((c[0] * self.count[1] + c[1]) * self.count[2] + c[2]) as usize
    }

    /// The cell `offset` away from `c`, with the image it belongs to (in axes x, y, z); none beyond a wall.
    #[inline]
    #[must_use]
    pub fn neighbour(&self, c: [i32; 3], offset: [i32; 3]) -> Option<(usize, [i32; 3])> {
        let (mut to, mut image) = ([0; 3], [0; 3]);
        for k in 0..3 {
            to[k] = c[k] + offset[k];
            if to[k] < 0 || to[k] >= self.count[k] {
                if !self.periodic[k] {
                    return None;
                }
                let s = if to[k] < 0 { -1 } else { 1 };
                to[k] -= s * self.count[k];
                image[self.axes[k]] = s;
            }
        }
        Some((self.number(to), image))
    }
}

/// Half of the 26 neighbours: each pair of cells is seen from one side.
pub const FORWARD: [[i32; 3]; 13] = [
    [0, 0, 1],
    [0, 1, -1],
    [0, 1, 0],
    [0, 1, 1],
    [1, -1, -1],
    [1, -1, 0],
    [1, -1, 1],
    [1, 0, -1],
    [1, 0, 0],
    [1, 0, 1],
    [1, 1, -1],
    [1, 1, 0],
    [1, 1, 1],
];

//! The grid: equal cells in a box, and how their values lie in memory.

use brazilnut_base::{Cell, Side, Vec3, vec3};
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// Layers of ghost values beyond each end of a direction that is not flat.
pub const GHOSTS: usize = 2;

/// Equal box-shaped cells that fill the cell of the case from its origin.
///
/// Cell (i, j, k) spans `i h_x..(i + 1) h_x` and so on; its centre holds the
/// pressure. Face `i` along an axis is the lower face of cell `i`, so walled
/// directions have faces `0..=n` with the walls at 0 and `n`; in periodic
/// directions face `n` is face 0.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Grid {
    /// Number of cells along x, y, z; one along a flat direction.
    pub cells: [usize; 3],
    /// Edge lengths of one cell, m; along a flat direction the thickness of the case.
    pub spacing: [f64; 3],
    /// What bounds each direction.
    pub sides: [Side; 3],
    /// The direction whose neighbours are neighbours in memory.
    pub line_axis: usize,
}

/// Where the values of a field lie: every field of one grid shares it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Layout {
    /// Place of (0, 0, 0).
    pub origin: usize,
    /// Distance in memory between neighbours along x, y, z; zero along a flat
    /// direction, so that every neighbour there is the cell itself.
    pub stride: [usize; 3],
    /// Number of values, ghosts and padding included.
    pub len: usize,
}

impl Layout {
    /// Place of (i, j, k); ghosts reach from `-GHOSTS` to `n + GHOSTS - 1`.
    #[inline]
    #[must_use]
    pub fn index(&self, i: isize, j: isize, k: isize) -> usize {
        let [a, b, c] = self.stride;
        (self.origin as isize + i * a as isize + j * b as isize + k * c as isize) as usize
    }
}

impl Grid {
    /// A grid of `cells` of edge lengths `spacing` (m) between `sides`.
    #[must_use]
    pub fn new(cells: [usize; 3], spacing: [f64; 3], sides: [Side; 3]) -> Self {
        let line_axis = best_line_axis(&cells, &sides);
        Self { cells, spacing, sides, line_axis }
    }

    /// The grid that fills `cell` with cells nearest to `spacing` (m) in each direction, at least two of them.
    #[must_use]
    pub fn fill(cell: &Cell, spacing: f64) -> Self {
        let mut cells = [1; 3];
        let mut edge = cell.size.to_array();
        for axis in 0..3 {
            if cell.sides[axis] != Side::Flat {
                cells[axis] = ((cell.size[axis] / spacing).round() as usize).max(2);
                edge[axis] = cell.size[axis] / cells[axis] as f64;
            }
        }
        Self::new(cells, edge, cell.sides)
    }

    /// The same grid with `axis` contiguous in memory.
    #[must_use]
    pub fn with_line_axis(mut self, axis: usize) -> Self {
        self.line_axis = axis;
        self
    }

    /// Size of the box, m.
    #[must_use]
    pub fn size(&self) -> Vec3 {
        let n = self.cells;
        let h = self.spacing;
        vec3(n[0] as f64 * h[0], n[1] as f64 * h[1], n[2] as f64 * h[2])
    }

    /// Number of cells.
    #[must_use]
    pub fn count(&self) -> usize {
        self.cells.iter().product()
    }

    /// Number of directions that are not flat.
    #[must_use]
    pub fn dimensions(&self) -> usize {
        self.sides.iter().filter(|s| **s != Side::Flat).count()
    }

    /// Volume of one cell, m³.
    #[must_use]
    pub fn cell_volume(&self) -> f64 {
        self.spacing.iter().product()
    }

    /// Area of a face normal to `axis`, m².
    #[must_use]
    pub fn face_area(&self, axis: usize) -> f64 {
        self.cell_volume() / self.spacing[axis]
    }

    /// Axes from contiguous to slowest in memory; a flat one is never first.
    #[must_use]
    pub fn memory_order(&self) -> [usize; 3] {
        let first = self.line_axis;
        let [a, b] = [(first + 1) % 3, (first + 2) % 3];
        // A flat direction goes in the middle so that planes of the slowest axis can be shared out to threads.
        let middle_first = self.sides[a] == Side::Flat || (self.sides[b] != Side::Flat && a < b);
        if middle_first { [first, a, b] } else { [first, b, a] }
    }

    /// How fields of this grid lie in memory.
    #[must_use]
    pub fn layout(&self) -> Layout {
        let mut stride = [0; 3];
        let (mut origin, mut len) = (0, 1);
        for (level, axis) in self.memory_order().into_iter().enumerate() {
            if self.sides[axis] == Side::Flat {
                continue;
            }
            stride[axis] = len;
            origin += GHOSTS * len;
            len *= self.cells[axis] + 2 * GHOSTS;
            if level == 0 {
                len = padded(len);
            }
        }
        Layout { origin, stride, len }
    }

    /// Cells (i, j, k) of the interior along each axis.
    #[must_use]
    pub fn cell_range(&self) -> [Range<isize>; 3] {
        self.cells.map(|n| 0..n as isize)
    }

    /// Faces normal to `axis` that carry a value of their own: both wall faces
    /// included, the repeated face of a periodic direction left out.
    #[must_use]
    pub fn face_range(&self, axis: usize) -> [Range<isize>; 3] {
        let mut r = self.cell_range();
        if self.sides[axis] == Side::Walls {
            r[axis].end += 1;
        }
        r
    }

    /// Transformed directions whose number of cells has a prime factor above 7,
    /// which costs 2 to 10 times the time per solve: axis, number, nearest good number.
    #[must_use]
    pub fn slow_sizes(&self) -> Vec<(usize, usize, usize)> {
        (0..3)
            .filter(|&a| {
                a != self.line_axis && self.sides[a] != Side::Flat && largest_prime(self.cells[a]) > 7
            })
            .map(|a| (a, self.cells[a], nearest_good_size(self.cells[a])))
            .collect()
    }

    /// Centre of cell (i, j, k), m.
    #[inline]
    #[must_use]
    pub fn cell_center(&self, i: isize, j: isize, k: isize) -> Vec3 {
        let h = self.spacing;
        vec3((i as f64 + 0.5) * h[0], (j as f64 + 0.5) * h[1], (k as f64 + 0.5) * h[2])
    }

    /// Centre of the lower face normal to `axis` of cell (i, j, k), m.
    #[inline]
    #[must_use]
    pub fn face_center(&self, axis: usize, i: isize, j: isize, k: isize) -> Vec3 {
        let mut r = self.cell_center(i, j, k);
        r[axis] -= 0.5 * self.spacing[axis];
        r
    }
}

/// Row length in memory: an odd number of cache lines, since rows a multiple
/// of half a page apart would fight for the same cache sets.
fn padded(row: usize) -> usize {
    8 * (row.div_ceil(8) | 1)
}

/// The axis for the tridiagonal solve: bounded rather than periodic, then the
/// one whose length is worst for a transform, then the longest.
fn best_line_axis(cells: &[usize; 3], sides: &[Side; 3]) -> usize {
    let rank = |axis: usize| {
        let kind = match sides[axis] {
            Side::Walls => 2,
            Side::Periodic => 1,
            Side::Flat => 0,
        };
        let ugly = largest_prime(cells[axis]).max(7);
        (kind, ugly, cells[axis], 2 - axis)
    };
    (0..3).max_by_key(|&axis| rank(axis)).unwrap_or(0)
}

/// The largest prime factor of `n`.
#[must_use]
pub fn largest_prime(mut n: usize) -> usize {
    let (mut largest, mut p) = (1, 2);
    while p * p <= n {
        while n.is_multiple_of(p) {
            largest = p;
            n /= p;
        }
        p += 1;
    }
    if n > 1 { largest.max(n) } else { largest }
}

/// The number of cells nearest to `n` whose prime factors are 2, 3, 5 and 7.
#[must_use]
pub fn nearest_good_size(n: usize) -> usize {
    let good = |m: usize| m > 0 && largest_prime(m) <= 7;
    (0..=n).find_map(|d| [n + d, n - d].into_iter().find(|&m| good(m))).unwrap_or(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flat_direction_has_no_stride() {
        let g = Grid::new([8, 1, 12], [1.0; 3], [Side::Walls, Side::Flat, Side::Walls]);
        let l = g.layout();
        assert_eq!(g.line_axis, 2);
        assert_eq!(l.stride, [24, 0, 1]);
        assert_eq!(l.len, 24 * 12);
        assert_eq!(l.index(0, 5, 0), l.index(0, 0, 0));
    }

    #[test]
    fn ghosts_stay_inside() {
        let g = Grid::new([5, 6, 7], [1.0; 3], [Side::Walls, Side::Periodic, Side::Walls]);
        let l = g.layout();
        assert_eq!(l.index(-2, -2, -2), 0);
        assert!(l.index(6, 7, 8) < l.len);
    }

    #[test]
    fn good_sizes() {
        assert_eq!(nearest_good_size(171), 168);
        assert_eq!(nearest_good_size(180), 180);
        assert_eq!(largest_prime(745), 149);
        assert_eq!(largest_prime(1), 1);
        let grid = Grid::new([171, 43, 745], [1.0; 3], [Side::Walls; 3]);
        assert_eq!(grid.slow_sizes(), [(0, 171, 168), (1, 43, 42)]);
    }

    #[test]
    fn tridiagonal_axis_is_the_ugly_or_the_long_one() {
        let walls = [Side::Walls; 3];
        assert_eq!(Grid::new([182, 21, 745], [1.0; 3], walls).line_axis, 2);
        assert_eq!(Grid::new([180, 45, 100], [1.0; 3], walls).line_axis, 0);
        let sides = [Side::Periodic, Side::Periodic, Side::Walls];
        assert_eq!(Grid::new([64, 64, 8], [1.0; 3], sides).line_axis, 2);
    }
}

//! The cell: a box from the origin to `size`, each direction walled, periodic or flat.

use crate::Vec3;
use serde::{Deserialize, Serialize};

/// What bounds the cell in one direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Side {
    /// Walls at both ends (what they are made of is the wall list's matter).
    Walls,
    /// The two ends are the same place.
    Periodic,
    /// No motion and no variation in this direction: a two-dimensional case.
    Flat,
}

/// The box `0 <= r <= size` that holds the bed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cell {
    /// Edge lengths, m.
    pub size: Vec3,
    /// Kind of each direction.
    pub sides: [Side; 3],
}

impl Cell {
    /// True where the direction `axis` is periodic.
    #[must_use]
    pub fn is_periodic(&self, axis: usize) -> bool {
        self.sides[axis] == Side::Periodic
    }

    /// The direction without extent, if the case is two-dimensional.
    #[must_use]
    pub fn flat_axis(&self) -> Option<usize> {
        self.sides.iter().position(|&s| s == Side::Flat)
    }

    /// Area of the base (x times y), m².
    #[must_use]
    pub fn base_area(&self) -> f64 {
        self.size.x * self.size.y
    }

    /// The shortest separation equivalent to `d` across periodic sides.
    ///
    /// Uses the nearest integer; truncation would miss images between half
    /// a cell and a whole one (Lan 2-6-2).
    #[must_use]
    pub fn nearest(&self, mut d: Vec3) -> Vec3 {
        for axis in 0..3 {
            if self.is_periodic(axis) {
                d[axis] -= self.size[axis] * (d[axis] / self.size[axis]).round();
            }
        }
        d
    }

    /// Wraps `r` into the cell across periodic sides; also the number of
    /// cells subtracted along each axis.
    #[must_use]
    pub fn wrap(&self, mut r: Vec3) -> (Vec3, [i32; 3]) {
        let mut crossed = [0; 3];
        for axis in 0..3 {
            if self.is_periodic(axis) {
                let n = (r[axis] / self.size[axis]).floor();
                if n != 0.0 {
                    r[axis] -= n * self.size[axis];
                    crossed[axis] = n as i32;
                }
                // Rounding may leave r at the far end: that is the near end.
                if r[axis] >= self.size[axis] {
                    r[axis] = 0.0;
                    crossed[axis] += 1;
                }
            }
        }
        (r, crossed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vec3;

    fn cell() -> Cell {
        Cell { size: vec3(2.0, 3.0, 4.0), sides: [Side::Periodic, Side::Walls, Side::Walls] }
    }

    #[test]
    fn nearest_image_between_half_and_whole_cell() {
        assert_eq!(cell().nearest(vec3(1.5, 2.5, 0.0)), vec3(-0.5, 2.5, 0.0));
    }

    #[test]
    fn wrap_counts_crossings() {
        let (r, n) = cell().wrap(vec3(-0.5, 5.0, 0.0));
        assert_eq!((r, n), (vec3(1.5, 5.0, 0.0), [-1, 0, 0]));
        let (r, n) = cell().wrap(vec3(-1e-30, 0.0, 0.0));
        assert_eq!((r.x, n[0]), (0.0, 0), "a rounding-sized crossing is none");
    }
}

//! Half a row as one value: three components of a vector and a number that goes along with them.

use brazilnut_base::Vec3;
use std::array::from_fn;
use std::ops::{Add, Mul, Sub};

/// Four numbers side by side; all operations are lane by lane.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C, align(32))]
pub struct Quad(pub [f64; 4]);

impl Quad {
    /// `x` in every lane.
    #[inline(always)]
    #[must_use]
    pub fn splat(x: f64) -> Self {
        Self([x; 4])
    }

    /// The four numbers of `row` from place `at` on.
    #[inline(always)]
    #[must_use]
    pub fn load(row: &[f64], at: usize) -> Self {
        let part = &row[at..at + 4];
        Self([part[0], part[1], part[2], part[3]])
    }

    /// Writes them to `row` from place `at` on.
    #[inline(always)]
    pub fn store(self, row: &mut [f64], at: usize) {
        row[at..at + 4].copy_from_slice(&self.0);
    }

    /// The same with `x` in the last lane.
    #[inline(always)]
    #[must_use]
    pub fn with(self, x: f64) -> Self {
        Self([self.0[0], self.0[1], self.0[2], x])
    }

    /// The first three lanes.
    #[inline(always)]
    #[must_use]
    pub fn vector(self) -> Vec3 {
        Vec3::new(self.0[0], self.0[1], self.0[2])
    }

    /// The smaller of each pair of lanes, `other` where they do not compare.
    #[inline(always)]
    #[must_use]
    pub fn min(self, other: Self) -> Self {
        Self(from_fn(|k| if self.0[k] < other.0[k] { self.0[k] } else { other.0[k] }))
    }

    /// The larger of each pair of lanes, `other` where they do not compare.
    #[inline(always)]
    #[must_use]
    pub fn max(self, other: Self) -> Self {
        Self(from_fn(|k| if self.0[k] > other.0[k] { self.0[k] } else { other.0[k] }))
    }
}

impl From<Vec3> for Quad {
    #[inline(always)]
    fn from(v: Vec3) -> Self {
        Self([v.x, v.y, v.z, 0.0])
    }
}

macro_rules! lanewise {
    ($trait:ident, $name:ident, $op:tt) => {
        impl $trait for Quad {
            type Output = Self;
            #[inline(always)]
            fn $name(self, o: Self) -> Self {
                Self(from_fn(|k| self.0[k] $op o.0[k]))
            }
        }
    };
}
lanewise!(Add, add, +);
lanewise!(Sub, sub, -);
lanewise!(Mul, mul, *);

impl Mul<f64> for Quad {
    type Output = Self;
    #[inline(always)]
    fn mul(self, s: f64) -> Self {
        Self(self.0.map(|x| x * s))
    }
}

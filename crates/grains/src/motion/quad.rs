//! Half a row as one value: three components of a vector and a number that goes along with them.

use brazilnut_base::Vec3;
use std::array::from_fn;
use std::ops::{Add, Mul, Sub};

/// Four numbers side by side; all operations are lane by lane.
///
/// A trait, so that the sets of instructions that have registers of four use
/// them: the compiler finds only some of these operations by itself, and
/// other ones in every version.
pub trait Quad:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Mul<f64, Output = Self>
{
    /// These four.
    fn of(lanes: [f64; 4]) -> Self;

    /// The four of them.
    fn lanes(self) -> [f64; 4];

    /// The four numbers of `row` from place `at` on.
    fn load(row: &[f64], at: usize) -> Self;

    /// Writes them to `row` from place `at` on.
    fn store(self, row: &mut [f64], at: usize);

    /// The same with `x` in the last lane.
    #[must_use]
    fn with(self, x: f64) -> Self;

    /// The smaller of each pair of lanes, `other` where they do not compare.
    #[must_use]
    fn min(self, other: Self) -> Self;

    /// The larger of each pair of lanes, `other` where they do not compare.
    #[must_use]
    fn max(self, other: Self) -> Self;

    /// `x` in every lane.
    #[inline(always)]
    fn splat(x: f64) -> Self {
        Self::of([x; 4])
    }

    /// A vector and zero.
    #[inline(always)]
    fn from(v: Vec3) -> Self {
        Self::of([v.x, v.y, v.z, 0.0])
    }

    /// The first three lanes.
    #[inline(always)]
    fn vector(self) -> Vec3 {
        let [x, y, z, _] = self.lanes();
        Vec3::new(x, y, z)
    }
}

/// Four numbers in an array, for every machine.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub struct Array([f64; 4]);

impl Quad for Array {
    #[inline(always)]
    fn of(lanes: [f64; 4]) -> Self {
        Self(lanes)
    }

    #[inline(always)]
    fn lanes(self) -> [f64; 4] {
        self.0
    }

    #[inline(always)]
    fn load(row: &[f64], at: usize) -> Self {
        let part = &row[at..at + 4];
        Self([part[0], part[1], part[2], part[3]])
    }

    #[inline(always)]
    fn store(self, row: &mut [f64], at: usize) {
        row[at..at + 4].copy_from_slice(&self.0);
    }

    #[inline(always)]
    fn with(self, x: f64) -> Self {
        Self([self.0[0], self.0[1], self.0[2], x])
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self(from_fn(|k| if self.0[k] < other.0[k] { self.0[k] } else { other.0[k] }))
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self(from_fn(|k| if self.0[k] > other.0[k] { self.0[k] } else { other.0[k] }))
    }
}

macro_rules! lanewise {
    ($trait:ident, $name:ident, $op:tt) => {
        impl $trait for Array {
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

impl Mul<f64> for Array {
    type Output = Self;
    #[inline(always)]
    fn mul(self, s: f64) -> Self {
        Self(self.0.map(|x| x * s))
    }
}

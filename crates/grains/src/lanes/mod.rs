//! Loading, transposing and scattering rows for several contacts at a time.

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
mod level;
#[cfg(test)]
mod suite;
#[cfg(target_arch = "x86_64")]
mod x86;

#[cfg(target_arch = "x86_64")]
pub use avx2::Avx2;
#[cfg(target_arch = "x86_64")]
pub use avx512::Avx512;
pub use level::{Job, Level};

use crate::contact::real::Real;
use crate::motion::{Array, Quad};
use crate::packed::{Couple, Force, Row, Spin};

impl Adds {
    /// Whether the first and the second body get the force.
    #[inline(always)]
    #[must_use]
    pub fn sides(self) -> (bool, bool) {
        (self != Self::Second, self != Self::First)
    }
}

/// To which of its two bodies a pair adds its force.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Adds {
    /// Both: they belong to the same block.
    Both,
    /// The first; the second's block evaluates the pair as well.
    First,
    /// The second.
    Second,
}

/// A lane type that knows how to move rows in and out.
pub trait Wide: Real {
    /// Half rows with the same instructions.
    type Quad: Quad;

    /// The first `WIDTH` values.
    fn load(from: &[f64]) -> Self;

    /// Writes the lanes to the first `WIDTH` places.
    fn store(self, to: &mut [f64]);

    /// Says that the rows and, if `SPINS`, the spins of `j` are read soon, and maybe their forces written, with
    /// which comes the row of the first.
    #[inline(always)]
    fn announce<const SPINS: bool>(
        _rows: &[Row],
        _spins: &[Spin],
        _forces: Option<(&[Force], usize)>,
        _j: &[u32],
    ) {
    }

    /// Columns of `rows[i] - rows[j]`, except columns 3 and 7, which are sums.
    #[inline(always)]
    fn relative(rows: &[Row], i: &[u32], j: &[u32]) -> [Self; 8] {
        let column = |c: usize| {
            Self::from_lanes(|k| {
                let (a, b) = (rows[i[k] as usize].0[c], rows[j[k] as usize].0[c]);
                if c & 3 == 3 { a + b } else { a - b }
            })
        };
        [column(0), column(1), column(2), column(3), column(4), column(5), column(6), column(7)]
    }

    /// Columns of `spins[i] + spins[j]`.
    #[inline(always)]
    fn spin_sum(spins: &[Spin], i: &[u32], j: &[u32]) -> [Self; 4] {
        let column = |c: usize| Self::from_lanes(|k| spins[i[k] as usize].0[c] + spins[j[k] as usize].0[c]);
        [column(0), column(1), column(2), column(3)]
    }

    /// Columns of the difference of angular velocities.
    #[inline(always)]
    fn spin_difference(spins: &[Spin], i: &[u32], j: &[u32]) -> [Self; 3] {
        let column = |c: usize| {
            Self::from_lanes(|k| {
                let (a, b) = (&spins[i[k] as usize].0, &spins[j[k] as usize].0);
                a[c] * a[3] - b[c] * b[3]
            })
        };
        [column(0), column(1), column(2)]
    }

    /// Adds force (columns 0-2) and lever sum (columns 3-5) to the first `count` pairs' bodies;
    /// `base` is the row of `forces[0]`.
    #[inline(always)]
    fn scatter<const SPINS: bool>(
        columns: &[Self; 6],
        forces: &mut [Force],
        (base_i, base_j): (usize, usize),
        i: &[u32],
        j: &[u32],
        count: usize,
        (first, second): (bool, bool),
    ) {
        for k in 0..count {
            if first {
                let f = &mut forces[i[k] as usize - base_i].0;
                for c in 0..3 {
                    f[c] += columns[c].lane(k);
                    if SPINS {
                        f[4 + c] += columns[3 + c].lane(k);
                    }
                }
            }
            if second {
                let f = &mut forces[j[k] as usize - base_j].0;
                for c in 0..3 {
                    f[c] -= columns[c].lane(k);
                    if SPINS {
                        f[4 + c] += columns[3 + c].lane(k);
                    }
                }
            }
        }
    }

    /// Adds a couple to the first bodies and its opposite to the second.
    #[inline(always)]
    fn scatter_couple(
        couple: &[Self; 3],
        couples: &mut [Couple],
        (base_i, base_j): (usize, usize),
        i: &[u32],
        j: &[u32],
        count: usize,
        (first, second): (bool, bool),
    ) {
        for k in 0..count {
            for c in 0..3 {
                if first {
                    couples[i[k] as usize - base_i].0[c] += couple[c].lane(k);
                }
                if second {
                    couples[j[k] as usize - base_j].0[c] -= couple[c].lane(k);
                }
            }
        }
    }
}

impl Wide for f64 {
    type Quad = Array;

    #[inline(always)]
    fn load(from: &[f64]) -> Self {
        from[0]
    }
    #[inline(always)]
    fn store(self, to: &mut [f64]) {
        to[0] = self;
    }
}

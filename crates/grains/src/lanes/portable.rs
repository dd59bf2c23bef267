//! Eight lanes in plain Rust.

use super::Wide;
use crate::contact::real::{Mask, Real};
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

/// Eight numbers.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub struct Lanes8(pub [f64; 8]);

/// Eight truth values.
#[derive(Clone, Copy, Debug)]
pub struct Mask8([bool; 8]);

macro_rules! lanewise {
    ($trait:ident, $name:ident, $op:tt) => {
        impl $trait for Lanes8 {
            type Output = Self;
            #[inline(always)]
            fn $name(self, o: Self) -> Self {
                Self(std::array::from_fn(|k| self.0[k] $op o.0[k]))
            }
        }
    };
}
lanewise!(Add, add, +);
lanewise!(Sub, sub, -);
lanewise!(Mul, mul, *);
lanewise!(Div, div, /);

impl Neg for Lanes8 {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(self.0.map(|x| -x))
    }
}

impl BitAnd for Mask8 {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, o: Self) -> Self {
        Self(std::array::from_fn(|k| self.0[k] & o.0[k]))
    }
}

impl BitOr for Mask8 {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, o: Self) -> Self {
        Self(std::array::from_fn(|k| self.0[k] | o.0[k]))
    }
}

impl Not for Mask8 {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        Self(self.0.map(|x| !x))
    }
}

impl Mask for Mask8 {
    #[inline(always)]
    fn any(self) -> bool {
        self.bits() != 0
    }
    #[inline(always)]
    fn bits(self) -> u8 {
        let mut bits = 0;
        for k in 0..8 {
            bits |= u8::from(self.0[k]) << k;
        }
        bits
    }
}

impl Real for Lanes8 {
    type Mask = Mask8;
    const WIDTH: usize = 8;
    #[inline(always)]
    fn splat(x: f64) -> Self {
        Self([x; 8])
    }
    #[inline(always)]
    fn from_lanes(f: impl FnMut(usize) -> f64) -> Self {
        Self(std::array::from_fn(f))
    }
    #[inline(always)]
    fn lane(self, k: usize) -> f64 {
        self.0[k]
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.map(f64::sqrt))
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.map(f64::abs))
    }
    #[inline(always)]
    fn min(self, o: Self) -> Self {
        Self(std::array::from_fn(|k| Real::min(self.0[k], o.0[k])))
    }
    #[inline(always)]
    fn max(self, o: Self) -> Self {
        Self(std::array::from_fn(|k| Real::max(self.0[k], o.0[k])))
    }
    #[inline(always)]
    fn lt(self, o: Self) -> Mask8 {
        Mask8(std::array::from_fn(|k| self.0[k] < o.0[k]))
    }
    #[inline(always)]
    fn le(self, o: Self) -> Mask8 {
        Mask8(std::array::from_fn(|k| self.0[k] <= o.0[k]))
    }
    #[inline(always)]
    fn pick(mask: Mask8, yes: Self, no: Self) -> Self {
        Self(std::array::from_fn(|k| if mask.0[k] { yes.0[k] } else { no.0[k] }))
    }
}

impl Wide for Lanes8 {
    #[inline(always)]
    fn load(from: &[f64]) -> Self {
        Self(std::array::from_fn(|k| from[k]))
    }
    #[inline(always)]
    fn store(self, to: &mut [f64]) {
        to[..8].copy_from_slice(&self.0);
    }
}

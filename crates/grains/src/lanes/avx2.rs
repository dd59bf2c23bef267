//! Eight lanes in two AVX registers.
#![allow(
    unsafe_code,
    reason = "instructions chosen at run time: a library that chooses at compile time cannot serve"
)]
// Every function below executes AVX2 instructions. A value of this type exists
// only inside a sweep that `dispatch` entered after asking the processor,
// which is what makes the calls sound.

use super::Wide;
use crate::contact::real::{Mask, Real};
use crate::packed::{Force, Row, Spin};
use std::arch::x86_64::*;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

/// Eight numbers.
#[derive(Clone, Copy, Debug)]
pub struct Avx2([__m256d; 2]);

/// Eight truth values, all bits of a lane set or none.
#[derive(Clone, Copy, Debug)]
pub struct Mask256([__m256d; 2]);

macro_rules! lanewise {
    ($type:ident, $trait:ident, $name:ident, $instruction:ident) => {
        impl $trait for $type {
            type Output = Self;
            #[inline(always)]
            fn $name(self, o: Self) -> Self {
                unsafe { Self([$instruction(self.0[0], o.0[0]), $instruction(self.0[1], o.0[1])]) }
            }
        }
    };
}
lanewise!(Avx2, Add, add, _mm256_add_pd);
lanewise!(Avx2, Sub, sub, _mm256_sub_pd);
lanewise!(Avx2, Mul, mul, _mm256_mul_pd);
lanewise!(Avx2, Div, div, _mm256_div_pd);
lanewise!(Mask256, BitAnd, bitand, _mm256_and_pd);
lanewise!(Mask256, BitOr, bitor, _mm256_or_pd);

impl Neg for Avx2 {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        unsafe {
            let sign = _mm256_set1_pd(-0.0);
            Self([_mm256_xor_pd(self.0[0], sign), _mm256_xor_pd(self.0[1], sign)])
        }
    }
}

impl Not for Mask256 {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        unsafe {
            let ones = _mm256_castsi256_pd(_mm256_set1_epi64x(-1));
            Self([_mm256_xor_pd(self.0[0], ones), _mm256_xor_pd(self.0[1], ones)])
        }
    }
}

impl Mask for Mask256 {
    #[inline(always)]
    fn any(self) -> bool {
        self.bits() != 0
    }
    #[inline(always)]
    fn bits(self) -> u8 {
        unsafe { (_mm256_movemask_pd(self.0[0]) | _mm256_movemask_pd(self.0[1]) << 4) as u8 }
    }
}

impl Real for Avx2 {
    type Mask = Mask256;
    const WIDTH: usize = 8;
    #[inline(always)]
    fn splat(x: f64) -> Self {
        unsafe { Self([_mm256_set1_pd(x); 2]) }
    }
    #[inline(always)]
    fn from_lanes(mut f: impl FnMut(usize) -> f64) -> Self {
        let mut a = [0.0; 8];
        for (k, a) in a.iter_mut().enumerate() {
            *a = f(k);
        }
        Self::load(&a)
    }
    #[inline(always)]
    fn lane(self, k: usize) -> f64 {
        let mut a = [0.0; 8];
        self.store(&mut a);
        a[k]
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        unsafe { Self([_mm256_sqrt_pd(self.0[0]), _mm256_sqrt_pd(self.0[1])]) }
    }
    #[inline(always)]
    fn abs(self) -> Self {
        unsafe {
            let sign = _mm256_set1_pd(-0.0);
            Self([_mm256_andnot_pd(sign, self.0[0]), _mm256_andnot_pd(sign, self.0[1])])
        }
    }
    #[inline(always)]
    fn min(self, o: Self) -> Self {
        unsafe { Self([_mm256_min_pd(self.0[0], o.0[0]), _mm256_min_pd(self.0[1], o.0[1])]) }
    }
    #[inline(always)]
    fn max(self, o: Self) -> Self {
        unsafe { Self([_mm256_max_pd(self.0[0], o.0[0]), _mm256_max_pd(self.0[1], o.0[1])]) }
    }
    #[inline(always)]
    fn lt(self, o: Self) -> Mask256 {
        unsafe {
            Mask256([
                _mm256_cmp_pd::<_CMP_LT_OQ>(self.0[0], o.0[0]),
                _mm256_cmp_pd::<_CMP_LT_OQ>(self.0[1], o.0[1]),
            ])
        }
    }
    #[inline(always)]
    fn le(self, o: Self) -> Mask256 {
        unsafe {
            Mask256([
                _mm256_cmp_pd::<_CMP_LE_OQ>(self.0[0], o.0[0]),
                _mm256_cmp_pd::<_CMP_LE_OQ>(self.0[1], o.0[1]),
            ])
        }
    }
    #[inline(always)]
    fn pick(mask: Mask256, yes: Self, no: Self) -> Self {
        unsafe {
            Self([
                _mm256_blendv_pd(no.0[0], yes.0[0], mask.0[0]),
                _mm256_blendv_pd(no.0[1], yes.0[1], mask.0[1]),
            ])
        }
    }
}

/// Rows of four become columns.
#[inline(always)]
fn transpose(r: [__m256d; 4]) -> [__m256d; 4] {
    unsafe {
        let (a, b) = (_mm256_unpacklo_pd(r[0], r[1]), _mm256_unpackhi_pd(r[0], r[1]));
        let (c, d) = (_mm256_unpacklo_pd(r[2], r[3]), _mm256_unpackhi_pd(r[2], r[3]));
        [
            _mm256_permute2f128_pd::<0x20>(a, c),
            _mm256_permute2f128_pd::<0x20>(b, d),
            _mm256_permute2f128_pd::<0x31>(a, c),
            _mm256_permute2f128_pd::<0x31>(b, d),
        ]
    }
}

/// Four columns of eight from eight rows of four. (No closures in this file: they would be compiled
/// without the instructions.)
#[inline(always)]
fn columns(r: [__m256d; 8]) -> [Avx2; 4] {
    let low = transpose([r[0], r[1], r[2], r[3]]);
    let high = transpose([r[4], r[5], r[6], r[7]]);
    [Avx2([low[0], high[0]]), Avx2([low[1], high[1]]), Avx2([low[2], high[2]]), Avx2([low[3], high[3]])]
}

/// Half of a row.
#[inline(always)]
fn part(row: &[f64], at: usize) -> __m256d {
    let part = &row[at..at + 4];
    unsafe { _mm256_loadu_pd(part.as_ptr()) }
}

impl Wide for Avx2 {
    #[inline(always)]
    fn load(from: &[f64]) -> Self {
        Self([part(from, 0), part(from, 4)])
    }

    #[inline(always)]
    fn store(self, to: &mut [f64]) {
        let to = &mut to[..8];
        unsafe {
            _mm256_storeu_pd(to.as_mut_ptr(), self.0[0]);
            _mm256_storeu_pd(to.as_mut_ptr().add(4), self.0[1]);
        }
    }

    #[inline(always)]
    fn relative(rows: &[Row], i: &[u32], j: &[u32]) -> [Self; 8] {
        let (i, j) = (&i[..8], &j[..8]);
        let mut half = [[Self::zero().0[0]; 8]; 2];
        for k in 0..8 {
            let (a, b) = (&rows[i[k] as usize].0, &rows[j[k] as usize].0);
            unsafe {
                let flip = _mm256_setr_pd(-0.0, -0.0, -0.0, 0.0);
                half[0][k] = _mm256_add_pd(part(a, 0), _mm256_xor_pd(part(b, 0), flip));
                half[1][k] = _mm256_add_pd(part(a, 4), _mm256_xor_pd(part(b, 4), flip));
            }
        }
        let ([a, b, c, d], [e, f, g, h]) = (columns(half[0]), columns(half[1]));
        [a, b, c, d, e, f, g, h]
    }

    #[inline(always)]
    fn spin_sum(spins: &[Spin], i: &[u32], j: &[u32]) -> [Self; 4] {
        let (i, j) = (&i[..8], &j[..8]);
        let mut sum = [Self::zero().0[0]; 8];
        for k in 0..8 {
            let (a, b) = (&spins[i[k] as usize].0, &spins[j[k] as usize].0);
            sum[k] = unsafe { _mm256_add_pd(part(a, 0), part(b, 0)) };
        }
        columns(sum)
    }

    #[inline(always)]
    fn scatter<const SPINS: bool>(
        c: &[Self; 6],
        forces: &mut [Force],
        (base_i, base_j): (usize, usize),
        i: &[u32],
        j: &[u32],
        count: usize,
        (first, second): (bool, bool),
    ) {
        let (i, j) = (&i[..8], &j[..8]);
        let o = Self::zero().0;
        for h in 0..2 {
            let force = transpose([c[0].0[h], c[1].0[h], c[2].0[h], o[h]]);
            let lever = transpose([c[3].0[h], c[4].0[h], c[5].0[h], o[h]]);
            for k in 0..4_usize.min(count.saturating_sub(4 * h)) {
                unsafe {
                    if first {
                        let f = &mut forces[i[4 * h + k] as usize - base_i].0;
                        let sum = _mm256_add_pd(part(f, 0), force[k]);
                        _mm256_storeu_pd(f.as_mut_ptr(), sum);
                        if SPINS {
                            let sum = _mm256_add_pd(part(f, 4), lever[k]);
                            _mm256_storeu_pd(f.as_mut_ptr().add(4), sum);
                        }
                    }
                    if second {
                        let f = &mut forces[j[4 * h + k] as usize - base_j].0;
                        let sum = _mm256_sub_pd(part(f, 0), force[k]);
                        _mm256_storeu_pd(f.as_mut_ptr(), sum);
                        if SPINS {
                            let sum = _mm256_add_pd(part(f, 4), lever[k]);
                            _mm256_storeu_pd(f.as_mut_ptr().add(4), sum);
                        }
                    }
                }
            }
        }
    }
}

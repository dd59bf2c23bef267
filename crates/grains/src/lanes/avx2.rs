//! Four lanes in one AVX register. Eight in two are no faster: half the values of a law are spilled.
#![allow(
    unsafe_code,
    reason = "instructions chosen at run time: a library that chooses at compile time cannot serve"
)]
// Every function below executes AVX2 instructions. A value of this type exists
// only inside a sweep that `dispatch` entered after asking the processor,
// which is what makes the calls sound.

use super::Wide;
use super::x86::{announce, lanes_of_a_register};
use crate::contact::real::{Mask, Real};
use crate::motion::Quad;
use crate::packed::{Force, Row, Spin};
use std::arch::x86_64::*;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

lanes_of_a_register! {
    /// Four numbers.
    Avx2 = __m256d of 4,
    mask Mask256,
    add _mm256_add_pd, sub _mm256_sub_pd, mul _mm256_mul_pd, div _mm256_div_pd,
    min _mm256_min_pd, max _mm256_max_pd, sqrt _mm256_sqrt_pd,
    xor _mm256_xor_pd, andnot _mm256_andnot_pd, set1 _mm256_set1_pd, loadu _mm256_loadu_pd, storeu _mm256_storeu_pd
}

/// Four truth values, all bits of a lane set or none.
#[derive(Clone, Copy, Debug)]
pub struct Mask256(__m256d);

impl Mask256 {
    #[inline(always)]
    fn less(a: Avx2, b: Avx2) -> Self {
        Self(unsafe { _mm256_cmp_pd::<_CMP_LT_OQ>(a.0, b.0) })
    }

    #[inline(always)]
    fn at_most(a: Avx2, b: Avx2) -> Self {
        Self(unsafe { _mm256_cmp_pd::<_CMP_LE_OQ>(a.0, b.0) })
    }

    #[inline(always)]
    fn pick(self, yes: Avx2, no: Avx2) -> Avx2 {
        Avx2(unsafe { _mm256_blendv_pd(no.0, yes.0, self.0) })
    }
}

impl BitAnd for Mask256 {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, o: Self) -> Self {
        Self(unsafe { _mm256_and_pd(self.0, o.0) })
    }
}

impl BitOr for Mask256 {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, o: Self) -> Self {
        Self(unsafe { _mm256_or_pd(self.0, o.0) })
    }
}

impl Not for Mask256 {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        Self(unsafe { _mm256_xor_pd(self.0, _mm256_castsi256_pd(_mm256_set1_epi64x(-1))) })
    }
}

impl Mask for Mask256 {
    #[inline(always)]
    fn any(self) -> bool {
        self.bits() != 0
    }
    #[inline(always)]
    fn bits(self) -> u8 {
        unsafe { _mm256_movemask_pd(self.0) as u8 }
    }
}

/// Rows of four become columns. (No closures in this file: they would be compiled without the instructions.)
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

/// Half of a row.
#[inline(always)]
fn part(row: &[f64], at: usize) -> __m256d {
    let part = &row[at..at + 4];
    unsafe { _mm256_loadu_pd(part.as_ptr()) }
}

impl Wide for Avx2 {
    type Quad = Self;

    #[inline(always)]
    fn load(from: &[f64]) -> Self {
        Self::from_slice(from)
    }

    #[inline(always)]
    fn store(self, to: &mut [f64]) {
        self.to_slice(to);
    }

    #[inline(always)]
    fn announce<const SPINS: bool>(
        rows: &[Row],
        spins: &[Spin],
        forces: Option<(&[Force], usize)>,
        j: &[u32],
    ) {
        announce::<SPINS>(rows, spins, forces, j);
    }

    #[inline(always)]
    fn relative(rows: &[Row], i: &[u32], j: &[u32]) -> [Self; 8] {
        let (i, j) = (&i[..4], &j[..4]);
        let mut half = [[Self::zero().0; 4]; 2];
        for k in 0..4 {
            let (a, b) = (&rows[i[k] as usize].0, &rows[j[k] as usize].0);
            unsafe {
                let flip = _mm256_setr_pd(-0.0, -0.0, -0.0, 0.0);
                half[0][k] = _mm256_add_pd(part(a, 0), _mm256_xor_pd(part(b, 0), flip));
                half[1][k] = _mm256_add_pd(part(a, 4), _mm256_xor_pd(part(b, 4), flip));
            }
        }
        let ([a, b, c, d], [e, f, g, h]) = (transpose(half[0]), transpose(half[1]));
        [Self(a), Self(b), Self(c), Self(d), Self(e), Self(f), Self(g), Self(h)]
    }

    #[inline(always)]
    fn spin_sum(spins: &[Spin], i: &[u32], j: &[u32]) -> [Self; 4] {
        let (i, j) = (&i[..4], &j[..4]);
        let mut sum = [Self::zero().0; 4];
        for k in 0..4 {
            let (a, b) = (&spins[i[k] as usize].0, &spins[j[k] as usize].0);
            sum[k] = unsafe { _mm256_add_pd(part(a, 0), part(b, 0)) };
        }
        let [a, b, c, d] = transpose(sum);
        [Self(a), Self(b), Self(c), Self(d)]
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
        let (i, j) = (&i[..4], &j[..4]);
        let o = Self::zero().0;
        let force = transpose([c[0].0, c[1].0, c[2].0, o]);
        let lever = transpose([c[3].0, c[4].0, c[5].0, o]);
        for k in 0..4_usize.min(count) {
            unsafe {
                if first {
                    let f = &mut forces[i[k] as usize - base_i].0;
                    let sum = _mm256_add_pd(part(f, 0), force[k]);
                    _mm256_storeu_pd(f.as_mut_ptr(), sum);
                    if SPINS {
                        let sum = _mm256_add_pd(part(f, 4), lever[k]);
                        _mm256_storeu_pd(f.as_mut_ptr().add(4), sum);
                    }
                }
                if second {
                    let f = &mut forces[j[k] as usize - base_j].0;
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

impl Quad for Avx2 {
    #[inline(always)]
    fn of(lanes: [f64; 4]) -> Self {
        Self::from_slice(&lanes)
    }

    #[inline(always)]
    fn lanes(self) -> [f64; 4] {
        let mut lanes = [0.0; 4];
        self.to_slice(&mut lanes);
        lanes
    }

    #[inline(always)]
    fn load(row: &[f64], at: usize) -> Self {
        Self(part(row, at))
    }

    #[inline(always)]
    fn store(self, row: &mut [f64], at: usize) {
        self.to_slice(&mut row[at..]);
    }

    #[inline(always)]
    fn with(self, x: f64) -> Self {
        Self(unsafe { _mm256_blend_pd::<0b1000>(self.0, _mm256_set1_pd(x)) })
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self(unsafe { _mm256_min_pd(self.0, other.0) })
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self(unsafe { _mm256_max_pd(self.0, other.0) })
    }
}

impl Mul<f64> for Avx2 {
    type Output = Self;
    #[inline(always)]
    fn mul(self, x: f64) -> Self {
        Self(unsafe { _mm256_mul_pd(self.0, _mm256_set1_pd(x)) })
    }
}

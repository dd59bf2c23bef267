//! Eight lanes in one AVX-512 register.
#![allow(
    unsafe_code,
    reason = "instructions chosen at run time: a library that chooses at compile time cannot serve"
)]
// Every function below executes AVX-512 instructions. A value of this type
// exists only inside a sweep that `dispatch` entered after asking the
// processor, which is what makes the calls sound.

use super::x86::{announce, lanes_of_a_register};
use super::{Avx2, Wide};
use crate::contact::real::{Mask, Real};
use crate::packed::{Force, Row, Spin};
use std::arch::x86_64::*;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

lanes_of_a_register! {
    /// Eight numbers.
    Avx512 = __m512d of 8,
    mask Mask512,
    add _mm512_add_pd, sub _mm512_sub_pd, mul _mm512_mul_pd, div _mm512_div_pd,
    min _mm512_min_pd, max _mm512_max_pd, sqrt _mm512_sqrt_pd,
    xor _mm512_xor_pd, andnot _mm512_andnot_pd, set1 _mm512_set1_pd, loadu _mm512_loadu_pd, storeu _mm512_storeu_pd
}

/// Eight truth values.
#[derive(Clone, Copy, Debug)]
pub struct Mask512(__mmask8);

impl Mask512 {
    #[inline(always)]
    fn less(a: Avx512, b: Avx512) -> Self {
        Self(unsafe { _mm512_cmp_pd_mask::<_CMP_LT_OQ>(a.0, b.0) })
    }

    #[inline(always)]
    fn at_most(a: Avx512, b: Avx512) -> Self {
        Self(unsafe { _mm512_cmp_pd_mask::<_CMP_LE_OQ>(a.0, b.0) })
    }

    #[inline(always)]
    fn pick(self, yes: Avx512, no: Avx512) -> Avx512 {
        Avx512(unsafe { _mm512_mask_blend_pd(self.0, no.0, yes.0) })
    }
}

impl BitAnd for Mask512 {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, o: Self) -> Self {
        Self(self.0 & o.0)
    }
}

impl BitOr for Mask512 {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, o: Self) -> Self {
        Self(self.0 | o.0)
    }
}

impl Not for Mask512 {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        Self(!self.0)
    }
}

impl Mask for Mask512 {
    #[inline(always)]
    fn any(self) -> bool {
        self.0 != 0
    }
    #[inline(always)]
    fn bits(self) -> u8 {
        self.0
    }
}

/// The even and the odd places of two registers, in turn. (No closures in this file: they would be
/// compiled without the instructions.)
#[inline(always)]
fn interleave(a: __m512d, b: __m512d) -> (__m512d, __m512d) {
    unsafe { (_mm512_unpacklo_pd(a, b), _mm512_unpackhi_pd(a, b)) }
}

/// Rows become columns.
#[inline(always)]
fn transpose(r: [__m512d; 8]) -> [__m512d; 8] {
    let (e0, o0) = interleave(r[0], r[1]);
    let (e1, o1) = interleave(r[2], r[3]);
    let (e2, o2) = interleave(r[4], r[5]);
    let (e3, o3) = interleave(r[6], r[7]);
    let [c0, c2, c4, c6] = quarters([e0, e1, e2, e3]);
    let [c1, c3, c5, c7] = quarters([o0, o1, o2, o3]);
    [c0, c1, c2, c3, c4, c5, c6, c7]
}

/// The first, second, third and fourth pairs of four registers.
#[inline(always)]
fn quarters(t: [__m512d; 4]) -> [__m512d; 4] {
    unsafe {
        let a = _mm512_shuffle_f64x2::<0x88>(t[0], t[1]);
        let b = _mm512_shuffle_f64x2::<0x88>(t[2], t[3]);
        let c = _mm512_shuffle_f64x2::<0xdd>(t[0], t[1]);
        let d = _mm512_shuffle_f64x2::<0xdd>(t[2], t[3]);
        [
            _mm512_shuffle_f64x2::<0x88>(a, b),
            _mm512_shuffle_f64x2::<0x88>(c, d),
            _mm512_shuffle_f64x2::<0xdd>(a, b),
            _mm512_shuffle_f64x2::<0xdd>(c, d),
        ]
    }
}

/// Two rows of four side by side.
#[inline(always)]
fn beside(low: &[f64; 4], high: &[f64; 4]) -> __m512d {
    unsafe {
        let low = _mm512_castpd256_pd512(_mm256_loadu_pd(low.as_ptr()));
        _mm512_insertf64x4::<1>(low, _mm256_loadu_pd(high.as_ptr()))
    }
}

/// Sums of the spins of pairs `a` and `b`, side by side.
#[inline(always)]
fn spin_rows(spins: &[Spin], i: &[u32], j: &[u32], a: usize, b: usize) -> __m512d {
    let first = beside(&spins[i[a] as usize].0, &spins[i[b] as usize].0);
    let second = beside(&spins[j[a] as usize].0, &spins[j[b] as usize].0);
    unsafe { _mm512_add_pd(first, second) }
}

impl Wide for Avx512 {
    type Quad = Avx2;

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
        let (i, j) = (&i[..8], &j[..8]);
        let mut r = [Self::zero().0; 8];
        for k in 0..8 {
            let (a, b) = (&rows[i[k] as usize].0, &rows[j[k] as usize].0);
            // A product with 1 or -1 is exact, so this rounds once, as a difference or a sum does.
            r[k] = unsafe {
                let sign = _mm512_setr_pd(-1.0, -1.0, -1.0, 1.0, -1.0, -1.0, -1.0, 1.0);
                _mm512_fmadd_pd(_mm512_loadu_pd(b.as_ptr()), sign, _mm512_loadu_pd(a.as_ptr()))
            };
        }
        let [a, b, c, d, e, f, g, h] = transpose(r);
        [Self(a), Self(b), Self(c), Self(d), Self(e), Self(f), Self(g), Self(h)]
    }

    #[inline(always)]
    fn spin_sum(spins: &[Spin], i: &[u32], j: &[u32]) -> [Self; 4] {
        let (i, j) = (&i[..8], &j[..8]);
        let (e0, o0) = interleave(spin_rows(spins, i, j, 0, 2), spin_rows(spins, i, j, 1, 3));
        let (e1, o1) = interleave(spin_rows(spins, i, j, 4, 6), spin_rows(spins, i, j, 5, 7));
        unsafe {
            [
                Self(_mm512_shuffle_f64x2::<0x88>(e0, e1)),
                Self(_mm512_shuffle_f64x2::<0x88>(o0, o1)),
                Self(_mm512_shuffle_f64x2::<0xdd>(e0, e1)),
                Self(_mm512_shuffle_f64x2::<0xdd>(o0, o1)),
            ]
        }
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
        if SPINS {
            let o = Self::zero().0;
            let rows = transpose([c[0].0, c[1].0, c[2].0, o, c[3].0, c[4].0, c[5].0, o]);
            for k in 0..count {
                unsafe {
                    if first {
                        let f = &mut forces[i[k] as usize - base_i].0;
                        let sum = _mm512_add_pd(_mm512_loadu_pd(f.as_ptr()), rows[k]);
                        _mm512_storeu_pd(f.as_mut_ptr(), sum);
                    }
                    if second {
                        let f = &mut forces[j[k] as usize - base_j].0;
                        let sign = _mm512_setr_pd(-1.0, -1.0, -1.0, 1.0, 1.0, 1.0, 1.0, 1.0);
                        let sum = _mm512_fmadd_pd(rows[k], sign, _mm512_loadu_pd(f.as_ptr()));
                        _mm512_storeu_pd(f.as_mut_ptr(), sum);
                    }
                }
            }
        } else {
            let rows = narrow([c[0].0, c[1].0, c[2].0, Self::zero().0]);
            for k in 0..count {
                unsafe {
                    if first {
                        let f = &mut forces[i[k] as usize - base_i].0;
                        let sum = _mm256_add_pd(_mm256_loadu_pd(f.as_ptr()), rows[k]);
                        _mm256_storeu_pd(f.as_mut_ptr(), sum);
                    }
                    if second {
                        let f = &mut forces[j[k] as usize - base_j].0;
                        let sum = _mm256_sub_pd(_mm256_loadu_pd(f.as_ptr()), rows[k]);
                        _mm256_storeu_pd(f.as_mut_ptr(), sum);
                    }
                }
            }
        }
    }
}

/// Four columns become eight rows of four.
#[inline(always)]
fn narrow(c: [__m512d; 4]) -> [__m256d; 8] {
    let (a, p) = interleave(c[0], c[1]);
    let (b, q) = interleave(c[2], c[3]);
    unsafe {
        let front = _mm512_setr_epi64(0, 1, 8, 9, 2, 3, 10, 11);
        let back = _mm512_setr_epi64(4, 5, 12, 13, 6, 7, 14, 15);
        let even = [_mm512_permutex2var_pd(a, front, b), _mm512_permutex2var_pd(a, back, b)];
        let odd = [_mm512_permutex2var_pd(p, front, q), _mm512_permutex2var_pd(p, back, q)];
        [
            _mm512_castpd512_pd256(even[0]),
            _mm512_castpd512_pd256(odd[0]),
            _mm512_extractf64x4_pd::<1>(even[0]),
            _mm512_extractf64x4_pd::<1>(odd[0]),
            _mm512_castpd512_pd256(even[1]),
            _mm512_castpd512_pd256(odd[1]),
            _mm512_extractf64x4_pd::<1>(even[1]),
            _mm512_extractf64x4_pd::<1>(odd[1]),
        ]
    }
}

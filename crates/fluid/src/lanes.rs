//! Vectors of `W` numbers and the choice, at run time, of the instructions
//! that compute with them.
//!
//! Kernels are plain code over `[f64; W]` and slices, compiled once per
//! instruction set by [`dispatch`]. Threads must be entered before it: what
//! runs in another thread is compiled for the baseline otherwise.

use crate::pressure::rows::Rows;
use crate::spec::Instructions;

/// An instruction set: vectors of `W` numbers, with fused multiply-add or not.
///
/// Only [`dispatch`] makes one, so that a value proves that the processor has it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lanes<const W: usize, const FUSED: bool>(());

/// Code to be compiled once per instruction set.
pub(crate) trait Kernel {
    /// Runs with the chosen instructions; implementations are `#[inline(always)]`.
    fn run<const W: usize, const FUSED: bool>(self, lanes: Lanes<W, FUSED>);
}

/// The instruction set of this processor that a run uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Path {
    /// Eight numbers a vector, fused.
    Avx512,
    /// Four numbers a vector, fused.
    Avx2,
    /// Four numbers at a time, whatever the compiler makes of it.
    Portable,
}

impl Path {
    /// The path for `wanted` on this processor.
    #[must_use]
    pub fn choose(wanted: Instructions) -> Self {
        #[cfg(target_arch = "x86_64")]
        if wanted == Instructions::Best {
            let wide = is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512dq");
            let wide = wide && is_x86_feature_detected!("avx512vl");
            let fused = is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma");
            return match (wide && fused, fused) {
                (true, _) => Self::Avx512,
                (_, true) => Self::Avx2,
                _ => Self::Portable,
            };
        }
        let _ = wanted;
        Self::Portable
    }

    /// Numbers a vector.
    #[must_use]
    pub fn lanes(self) -> usize {
        if self == Self::Avx512 { 8 } else { 4 }
    }
}

/// Runs `kernel` with the instructions of `path`.
#[allow(
    unsafe_code,
    reason = "code compiled for a processor feature is unsafe to call; `Path::choose` checked it"
)]
pub(crate) fn dispatch<K: Kernel>(path: Path, kernel: K) {
    match path {
        #[cfg(target_arch = "x86_64")]
        // SAFETY: `Path::choose` found these features.
        Path::Avx512 => unsafe { avx512(kernel) },
        #[cfg(target_arch = "x86_64")]
        // SAFETY: `Path::choose` found these features.
        Path::Avx2 => unsafe { avx2(kernel) },
        _ => kernel.run(Lanes::<4, false>(())),
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512vl,avx2,fma")]
fn avx512<K: Kernel>(kernel: K) {
    kernel.run(Lanes::<8, true>(()));
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn avx2<K: Kernel>(kernel: K) {
    kernel.run(Lanes::<4, true>(()));
}

/// Returns the result of one vector instruction where the lanes have it.
///
/// Plain code over arrays usually becomes the same instruction, but not reliably.
macro_rules! native {
    ($wide:ident, $half:ident, $($x:ident),+) => {
        #[cfg(target_arch = "x86_64")]
        #[allow(unsafe_code, reason = "vector instructions; the lanes prove that the processor has them")]
        if FUSED && (W == 8 || W == 4) {
            use std::arch::x86_64::*;
            let mut out = [0.0; W];
            if W == 8 {
                // SAFETY: fused lanes of eight exist only where AVX-512 does; every array holds eight numbers.
                unsafe { _mm512_storeu_pd(out.as_mut_ptr(), $wide($(_mm512_loadu_pd($x.as_ptr())),+)) };
            } else {
                // SAFETY: fused lanes of four exist only where AVX2 and FMA do; every array holds four numbers.
                unsafe { _mm256_storeu_pd(out.as_mut_ptr(), $half($(_mm256_loadu_pd($x.as_ptr())),+)) };
            }
            return out;
        }
    };
}

/// Asks for the cache line at `place` ahead of its use.
#[inline(always)]
#[allow(unsafe_code, reason = "a hint by address")]
pub(crate) fn prefetch(place: *const f64) {
    #[cfg(target_arch = "x86_64")]
    {
        use std::arch::x86_64::{_MM_HINT_T1, _mm_prefetch};
        // SAFETY: every x86-64 processor has the instruction, and it changes nothing at any address.
        unsafe { _mm_prefetch::<_MM_HINT_T1>(place.cast()) };
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = place;
}

impl<const W: usize, const FUSED: bool> Lanes<W, FUSED> {
    /// The path that leads to these lanes.
    #[inline(always)]
    pub fn path(self) -> Path {
        match (W, FUSED) {
            (8, true) => Path::Avx512,
            (_, true) => Path::Avx2,
            _ => Path::Portable,
        }
    }

    /// a b + c, rounded once where the processor can.
    #[inline(always)]
    pub fn madd(self, a: f64, b: f64, c: f64) -> f64 {
        if FUSED { a.mul_add(b, c) } else { a * b + c }
    }

    /// a b + c in every lane.
    #[inline(always)]
    pub fn vmadd(self, a: [f64; W], b: [f64; W], c: [f64; W]) -> [f64; W] {
        native!(_mm512_fmadd_pd, _mm256_fmadd_pd, a, b, c);
        std::array::from_fn(|l| self.madd(a[l], b[l], c[l]))
    }

    /// a b - c in every lane.
    #[inline(always)]
    pub fn vmsub(self, a: [f64; W], b: [f64; W], c: [f64; W]) -> [f64; W] {
        native!(_mm512_fmsub_pd, _mm256_fmsub_pd, a, b, c);
        std::array::from_fn(|l| self.madd(a[l], b[l], -c[l]))
    }

    /// a + b in every lane.
    #[inline(always)]
    pub fn add(self, a: [f64; W], b: [f64; W]) -> [f64; W] {
        native!(_mm512_add_pd, _mm256_add_pd, a, b);
        std::array::from_fn(|l| a[l] + b[l])
    }

    /// a - b in every lane.
    #[inline(always)]
    pub fn sub(self, a: [f64; W], b: [f64; W]) -> [f64; W] {
        native!(_mm512_sub_pd, _mm256_sub_pd, a, b);
        std::array::from_fn(|l| a[l] - b[l])
    }

    /// a b in every lane.
    #[inline(always)]
    pub fn mul(self, a: [f64; W], b: [f64; W]) -> [f64; W] {
        native!(_mm512_mul_pd, _mm256_mul_pd, a, b);
        std::array::from_fn(|l| a[l] * b[l])
    }

    /// a / b in every lane.
    #[inline(always)]
    pub fn div(self, a: [f64; W], b: [f64; W]) -> [f64; W] {
        native!(_mm512_div_pd, _mm256_div_pd, a, b);
        std::array::from_fn(|l| a[l] / b[l])
    }

    /// The first `W` of `row`.
    #[inline(always)]
    pub fn load(self, row: &[f64]) -> [f64; W] {
        let mut v = [0.0; W];
        v.copy_from_slice(&row[..W]);
        v
    }

    /// Writes the first `W` of `row`.
    #[inline(always)]
    pub fn store(self, row: &mut [f64], v: [f64; W]) {
        row[..W].copy_from_slice(&v);
    }
}

/// Blocks of `W` by `W` numbers between rows and lanes.
impl<const W: usize, const FUSED: bool> Lanes<W, FUSED> {
    /// Columns `i..i + W` of the rows `first..first + W`.
    #[inline(always)]
    pub fn gather(self, rows: &Rows<'_>, first: usize, i: usize) -> [[f64; W]; W] {
        let mut block = [[0.0; W]; W];
        for (lane, b) in block.iter_mut().enumerate() {
            *b = self.load(&rows.row(first + lane)[i..]);
        }
        self.transposed(block)
    }

    /// Undoes [`Self::gather`].
    #[inline(always)]
    pub fn scatter(self, rows: &mut Rows<'_>, first: usize, i: usize, columns: [[f64; W]; W]) {
        for (lane, v) in self.transposed(columns).into_iter().enumerate() {
            self.store(&mut rows.row_mut(first + lane)[i..], v);
        }
    }

    /// Rows for columns.
    #[inline(always)]
    #[allow(
        unsafe_code,
        reason = "no plain code becomes the shuffles; the lanes prove that the processor has them"
    )]
    fn transposed(self, block: [[f64; W]; W]) -> [[f64; W]; W] {
        #[cfg(target_arch = "x86_64")]
        if FUSED && W == 8 {
            let mut out = [[0.0; W]; W];
            // SAFETY: lanes of eight exist only where AVX-512 does; both blocks hold 64 numbers.
            unsafe { transpose8(block.as_flattened(), out.as_flattened_mut()) };
            return out;
        }
        #[cfg(target_arch = "x86_64")]
        if FUSED && W == 4 {
            let mut out = [[0.0; W]; W];
            // SAFETY: fused lanes of four exist only where AVX2 does; both blocks hold 16 numbers.
            unsafe { transpose4(block.as_flattened(), out.as_flattened_mut()) };
            return out;
        }
        std::array::from_fn(|i| std::array::from_fn(|j| block[j][i]))
    }
}

#[cfg(target_arch = "x86_64")]
#[allow(unsafe_code, reason = "vector shuffles")]
#[inline]
#[target_feature(enable = "avx512f")]
unsafe fn transpose8(a: &[f64], out: &mut [f64]) {
    use std::arch::x86_64::*;
    assert!(a.len() == 64 && out.len() == 64);
    // SAFETY: eight numbers are read at 8 r, r < 8, of 64.
    let r: [__m512d; 8] = std::array::from_fn(|i| unsafe { _mm512_loadu_pd(a.as_ptr().add(8 * i)) });
    // Pairs, then quarters, then halves.
    let p: [__m512d; 8] = std::array::from_fn(|i| {
        let (a, b) = (r[i & !1], r[i | 1]);
        if i & 1 == 0 { _mm512_unpacklo_pd(a, b) } else { _mm512_unpackhi_pd(a, b) }
    });
    let q: [__m512d; 8] = std::array::from_fn(|i| {
        let (a, b) = (p[i & !2], p[i | 2]);
        if i & 2 == 0 { _mm512_shuffle_f64x2::<0x88>(a, b) } else { _mm512_shuffle_f64x2::<0xdd>(a, b) }
    });
    let s: [__m512d; 8] = std::array::from_fn(|i| {
        let (a, b) = (q[i & !4], q[i | 4]);
        if i & 4 == 0 { _mm512_shuffle_f64x2::<0x88>(a, b) } else { _mm512_shuffle_f64x2::<0xdd>(a, b) }
    });
    for i in 0..8 {
        // SAFETY: as for reading.
        unsafe { _mm512_storeu_pd(out.as_mut_ptr().add(8 * i), s[i]) };
    }
}

#[cfg(target_arch = "x86_64")]
#[allow(unsafe_code, reason = "vector shuffles")]
#[inline]
#[target_feature(enable = "avx2")]
unsafe fn transpose4(a: &[f64], out: &mut [f64]) {
    use std::arch::x86_64::*;
    assert!(a.len() == 16 && out.len() == 16);
    // SAFETY: four numbers are read at 4 r, r < 4, of 16.
    let r: [__m256d; 4] = std::array::from_fn(|i| unsafe { _mm256_loadu_pd(a.as_ptr().add(4 * i)) });
    let p: [__m256d; 4] = std::array::from_fn(|i| {
        let (a, b) = (r[i & !1], r[i | 1]);
        if i & 1 == 0 { _mm256_unpacklo_pd(a, b) } else { _mm256_unpackhi_pd(a, b) }
    });
    let s: [__m256d; 4] = std::array::from_fn(|i| {
        let (a, b) = (p[i & !2], p[i | 2]);
        if i & 2 == 0 { _mm256_permute2f128_pd::<0x20>(a, b) } else { _mm256_permute2f128_pd::<0x31>(a, b) }
    });
    for i in 0..4 {
        // SAFETY: as for reading.
        unsafe { _mm256_storeu_pd(out.as_mut_ptr().add(4 * i), s[i]) };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct There;
    impl Kernel for There {
        #[inline(always)]
        fn run<const W: usize, const F: bool>(self, l: Lanes<W, F>) {
            let mut data: Vec<f64> = (0..W * 16).map(|i| i as f64).collect();
            let kept = data.clone();
            let mut rows = Rows::of_plane(&mut data, 16);
            let columns = l.gather(&rows, 0, 3);
            for i in 0..W {
                for lane in 0..W {
                    assert_eq!(columns[i][lane], kept[lane * 16 + 3 + i]);
                }
            }
            l.scatter(&mut rows, 0, 3, columns);
            assert_eq!(data, kept);
        }
    }

    #[test]
    fn blocks_turn_and_return() {
        for path in [Path::Portable, Path::choose(Instructions::Best)] {
            dispatch(path, There);
        }
    }
}

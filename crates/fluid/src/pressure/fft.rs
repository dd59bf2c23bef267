//! Complex mixed-radix Fourier transforms of many lines at once: lanes across
//! lines, decimation in time, in place.
//!
//! `Z_k = sum_n z_n exp(-2 pi i k n / N)`, not normalised. The input must lie
//! in the order of [`Plan::source`]. The first and the last stage are the
//! caller's: they are where the numbers come from memory and go back to it.

use super::panel::complex;
use crate::lanes::{Kernel, Lanes, Path, dispatch};
use std::f64::consts::TAU;

/// The largest prime factor that the batched transform takes; longer ones go to the library.
pub const LARGEST_FACTOR: usize = 13;

/// One point of `W` lines: real parts, then imaginary parts.
pub(crate) type Complex<const W: usize> = [[f64; W]; 2];

/// Nothing.
pub(crate) const fn zero<const W: usize>() -> Complex<W> {
    [[0.0; W]; 2]
}

/// Factors and twiddles of one length.
#[derive(Clone, Debug)]
pub(crate) struct Plan {
    /// Which input belongs at each place.
    pub source: Vec<usize>,
    /// At least two.
    pub stages: Vec<Stage>,
}

/// All butterflies of one radix.
#[derive(Clone, Debug)]
pub(crate) struct Stage {
    pub radix: usize,
    /// Length of the transforms that this stage joins.
    pub part: usize,
    /// For each of the `part` places the `radix - 1` factors exp(-2 pi i p j / (radix part)).
    twiddles: Vec<[f64; 2]>,
    /// exp(-2 pi i q / radix), for radices without a written-out butterfly.
    roots: Vec<[f64; 2]>,
}

/// Calls a function of a constant radix, one of those listed, with the radix of a stage.
macro_rules! with_radix {
    ($radix:expr, [$($r:literal)+], $R:ident => $call:expr) => {
        match $radix {
            $($r => { const $R: usize = $r; $call })+
            other => unreachable!("no plan has a stage of radix {other} here"),
        }
    };
}
pub(crate) use with_radix;

/// cos and -sin of 2 pi k / n.
fn root(k: usize, n: usize) -> [f64; 2] {
    let k = k % n;
    let turn = if 2 * k > n { k as f64 - n as f64 } else { k as f64 };
    let (s, c) = (TAU * turn / n as f64).sin_cos();
    [c, -s]
}

/// Factors of `n` in the order in which the stages of a forward transform run.
///
/// The last is at most five: its butterflies are worked on in pairs, whose numbers should fit the registers. The first
/// is at most eight. Primes beyond five stand between. There are at least two.
fn factors(mut n: usize) -> Vec<usize> {
    let mut take = |r: usize| {
        let divides = n.is_multiple_of(r);
        n /= if divides { r } else { 1 };
        divides
    };
    let last = [4, 5, 3, 2, 1].into_iter().find(|&r| take(r)).expect("one divides all");
    let mut f = vec![];
    for r in [8, 5, 3, 4, 2] {
        while take(r) {
            f.push(r);
        }
    }
    // Eights leave a two where two fours would do.
    if f.last() == Some(&2)
        && let Some(eight) = f.iter().position(|&r| r == 8)
    {
        (f[eight], *f.last_mut().expect("a two")) = (4, 4);
    }
    if f.is_empty() {
        f.push(1);
    }
    for r in [7, 11, 13] {
        while take(r) {
            f.push(r);
        }
    }
    assert!(n == 1, "a prime factor is too large");
    f.push(last);
    f
}

impl Plan {
    /// The plan for lines of `n` points, all of whose prime factors are small; `reversed` has the paired stage first.
    pub fn new(n: usize, reversed: bool) -> Self {
        let mut radices = factors(n);
        if reversed {
            radices.reverse();
        }
        let mut stages = vec![];
        let mut part = 1;
        for &radix in &radices {
            let size = part * radix;
            let twiddles = (0..part).flat_map(|j| (1..radix).map(move |p| root(p * j, size))).collect();
            let roots = (0..radix).map(|q| root(q, radix)).collect();
            stages.push(Stage { radix, part, twiddles, roots });
            part = size;
        }
        let source = (0..n).map(|place| source_of(place, n, &radices)).collect();
        Self { source, stages }
    }
}

/// Which input stands at `place` after the subsequences have been sorted out.
fn source_of(place: usize, n: usize, radices: &[usize]) -> usize {
    let Some((&last, rest)) = radices.split_last() else { return 0 };
    let part = n / last;
    last * source_of(place % part, part, rest) + place / part
}

/// All butterflies of a stage, in place.
struct Pass<'a, const R: usize> {
    stage: &'a Stage,
    z: &'a mut [f64],
}

impl<const R: usize> Kernel for Pass<'_, R> {
    #[inline(always)]
    fn run<const W: usize, const F: bool>(self, l: Lanes<W, F>) {
        let part = self.stage.part;
        for block in complex::<W>(self.z).chunks_exact_mut(R * part) {
            let legs = parts::<R, _>(block, part);
            for j in 0..part {
                let y = self.stage.at(l, &legs, j);
                for q in 0..R {
                    legs[q][j] = y[q];
                }
            }
        }
    }
}

impl Stage {
    /// All butterflies, in place.
    pub fn run(&self, path: Path, z: &mut [f64]) {
        match self.radix {
            7 | 11 | 13 => dispatch(path, OddPass { stage: self, z }),
            _ => with_radix!(self.radix, [1 2 3 4 5 8], R => dispatch(path, Pass::<R> { stage: self, z })),
        }
    }

    /// The butterfly at place `j` of `legs`, the parts that this stage joins.
    #[inline(always)]
    pub fn at<const R: usize, const W: usize, const F: bool>(
        &self,
        l: Lanes<W, F>,
        legs: &[&mut [Complex<W>]; R],
        j: usize,
    ) -> [Complex<W>; R] {
        let mut x = [zero(); R];
        for q in 0..R {
            x[q] = legs[q][j];
        }
        self.butterfly(l, j, x)
    }

    /// The butterfly of the numbers `x` at place `j`, twiddles included.
    #[inline(always)]
    fn butterfly<const R: usize, const W: usize, const F: bool>(
        &self,
        l: Lanes<W, F>,
        j: usize,
        mut x: [Complex<W>; R],
    ) -> [Complex<W>; R] {
        let w = &self.twiddles[j * (R - 1)..][..R - 1];
        for q in 1..R {
            x[q] = turned(l, x[q], w[q - 1]);
        }
        self.plain_butterfly(l, x)
    }

    /// The butterfly without twiddles: that of a first stage.
    #[inline(always)]
    pub fn plain_butterfly<const R: usize, const W: usize, const F: bool>(
        &self,
        l: Lanes<W, F>,
        x: [Complex<W>; R],
    ) -> [Complex<W>; R] {
        match R {
            1 => x,
            2 => sized(butterfly2(l, sized(x))),
            3 => sized(butterfly3(l, sized(x))),
            4 => sized(butterfly4(l, sized(x))),
            5 => sized(butterfly5(l, sized(x))),
            8 => sized(butterfly8(l, sized(x))),
            _ => unreachable!("no butterfly of that radix"),
        }
    }
}

/// The same array under another name of its length.
#[inline(always)]
fn sized<const N: usize, const M: usize, const W: usize>(x: [Complex<W>; N]) -> [Complex<W>; M] {
    let mut y = [zero(); M];
    for (y, x) in y.iter_mut().zip(x) {
        *y = x;
    }
    y
}

#[inline(always)]
fn add<const W: usize, const F: bool>(l: Lanes<W, F>, a: Complex<W>, b: Complex<W>) -> Complex<W> {
    [l.add(a[0], b[0]), l.add(a[1], b[1])]
}

#[inline(always)]
fn sub<const W: usize, const F: bool>(l: Lanes<W, F>, a: Complex<W>, b: Complex<W>) -> Complex<W> {
    [l.sub(a[0], b[0]), l.sub(a[1], b[1])]
}

/// a + x b with real x.
#[inline(always)]
fn axpy<const W: usize, const F: bool>(l: Lanes<W, F>, x: f64, b: Complex<W>, a: Complex<W>) -> Complex<W> {
    let x = [x; W];
    [l.vmadd(x, b[0], a[0]), l.vmadd(x, b[1], a[1])]
}

#[inline(always)]
fn scaled<const W: usize, const F: bool>(l: Lanes<W, F>, x: f64, a: Complex<W>) -> Complex<W> {
    [l.mul([x; W], a[0]), l.mul([x; W], a[1])]
}

/// a w
#[inline(always)]
fn turned<const W: usize, const F: bool>(l: Lanes<W, F>, a: Complex<W>, w: [f64; 2]) -> Complex<W> {
    let (c, s) = ([w[0]; W], [w[1]; W]);
    [l.vmsub(a[0], c, l.mul(a[1], s)), l.vmadd(a[0], s, l.mul(a[1], c))]
}

/// a - i b
#[inline(always)]
fn minus_i<const W: usize, const F: bool>(l: Lanes<W, F>, a: Complex<W>, b: Complex<W>) -> Complex<W> {
    [l.add(a[0], b[1]), l.sub(a[1], b[0])]
}

/// a + i b
#[inline(always)]
fn plus_i<const W: usize, const F: bool>(l: Lanes<W, F>, a: Complex<W>, b: Complex<W>) -> Complex<W> {
    [l.sub(a[0], b[1]), l.add(a[1], b[0])]
}

/// Splits a block into `R` equal parts.
#[inline(always)]
pub(crate) fn parts<const R: usize, T>(mut block: &mut [T], part: usize) -> [&mut [T]; R] {
    std::array::from_fn(|_| {
        let (head, tail) = std::mem::take(&mut block).split_at_mut(part);
        block = tail;
        head
    })
}

#[inline(always)]
fn butterfly2<const W: usize, const F: bool>(l: Lanes<W, F>, x: [Complex<W>; 2]) -> [Complex<W>; 2] {
    [add(l, x[0], x[1]), sub(l, x[0], x[1])]
}

#[inline(always)]
fn butterfly3<const W: usize, const F: bool>(l: Lanes<W, F>, x: [Complex<W>; 3]) -> [Complex<W>; 3] {
    let sin = 0.75_f64.sqrt();
    let (sum, dif) = (add(l, x[1], x[2]), scaled(l, sin, sub(l, x[1], x[2])));
    let mid = axpy(l, -0.5, sum, x[0]);
    [add(l, x[0], sum), minus_i(l, mid, dif), plus_i(l, mid, dif)]
}

#[inline(always)]
fn butterfly4<const W: usize, const F: bool>(l: Lanes<W, F>, x: [Complex<W>; 4]) -> [Complex<W>; 4] {
    let (s, t) = (add(l, x[0], x[2]), sub(l, x[0], x[2]));
    let (u, v) = (add(l, x[1], x[3]), sub(l, x[1], x[3]));
    [add(l, s, u), minus_i(l, t, v), sub(l, s, u), plus_i(l, t, v)]
}

#[inline(always)]
fn butterfly5<const W: usize, const F: bool>(l: Lanes<W, F>, x: [Complex<W>; 5]) -> [Complex<W>; 5] {
    let [c1, s1] = root(1, 5);
    let [c2, s2] = root(2, 5);
    let (s1, s2) = (-s1, -s2);
    let (p1, m1) = (add(l, x[1], x[4]), sub(l, x[1], x[4]));
    let (p2, m2) = (add(l, x[2], x[3]), sub(l, x[2], x[3]));
    let r1 = axpy(l, c2, p2, axpy(l, c1, p1, x[0]));
    let r2 = axpy(l, c1, p2, axpy(l, c2, p1, x[0]));
    let i1 = axpy(l, s2, m2, scaled(l, s1, m1));
    let i2 = axpy(l, -s1, m2, scaled(l, s2, m1));
    let sum = add(l, x[0], add(l, p1, p2));
    [sum, minus_i(l, r1, i1), minus_i(l, r2, i2), plus_i(l, r2, i2), plus_i(l, r1, i1)]
}

/// Two of four, the odd one turned by eighths.
#[inline(always)]
fn butterfly8<const W: usize, const F: bool>(l: Lanes<W, F>, x: [Complex<W>; 8]) -> [Complex<W>; 8] {
    let e = butterfly4(l, [x[0], x[2], x[4], x[6]]);
    let o = butterfly4(l, [x[1], x[3], x[5], x[7]]);
    let h = 0.5_f64.sqrt();
    // o_1 (1 - i) / sqrt(2) and o_3 (1 + i) / sqrt(2).
    let first = scaled(l, h, [l.add(o[1][0], o[1][1]), l.sub(o[1][1], o[1][0])]);
    let third = scaled(l, h, [l.sub(o[3][0], o[3][1]), l.add(o[3][0], o[3][1])]);
    [
        add(l, e[0], o[0]),
        add(l, e[1], first),
        minus_i(l, e[2], o[2]),
        sub(l, e[3], third),
        sub(l, e[0], o[0]),
        sub(l, e[1], first),
        plus_i(l, e[2], o[2]),
        add(l, e[3], third),
    ]
}

/// Odd primes from seven to [`LARGEST_FACTOR`], from their definition, halved by symmetry; rare, so not worth code
/// of their own.
struct OddPass<'a> {
    stage: &'a Stage,
    z: &'a mut [f64],
}

impl Kernel for OddPass<'_> {
    #[inline(always)]
    fn run<const W: usize, const F: bool>(self, l: Lanes<W, F>) {
        let (s, z) = (self.stage, complex::<W>(self.z));
        let (r, m) = (s.radix, s.part);
        let half = (r - 1) / 2;
        for block in z.chunks_exact_mut(r * m) {
            for j in 0..m {
                let x0 = block[j];
                let (mut plus, mut minus) = ([zero(); LARGEST_FACTOR / 2], [zero(); LARGEST_FACTOR / 2]);
                let mut total = x0;
                for p in 1..=half {
                    let w = &s.twiddles[j * (r - 1)..][..r - 1];
                    let a = turned(l, block[j + p * m], w[p - 1]);
                    let b = turned(l, block[j + (r - p) * m], w[r - p - 1]);
                    (plus[p - 1], minus[p - 1]) = (add(l, a, b), sub(l, a, b));
                    total = add(l, total, plus[p - 1]);
                }
                block[j] = total;
                for q in 1..=half {
                    let (mut even, mut odd) = (x0, zero());
                    for p in 1..=half {
                        let [c, s] = s.roots[p * q % r];
                        even = axpy(l, c, plus[p - 1], even);
                        odd = axpy(l, -s, minus[p - 1], odd);
                    }
                    block[j + q * m] = minus_i(l, even, odd);
                    block[j + (r - q) * m] = plus_i(l, even, odd);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::Path;
    use crate::spec::Instructions;
    use rustfft::num_complex::Complex as Number;

    struct Check(usize, bool);
    impl Kernel for Check {
        #[inline(always)]
        fn run<const W: usize, const F: bool>(self, lanes: Lanes<W, F>) {
            let n = self.0;
            let value = |i: usize, lane: usize| ((i * 7 + lane * 3) % 11) as f64 - 4.5;
            let plan = Plan::new(n, self.1);
            let mut z: Vec<Complex<W>> = plan
                .source
                .iter()
                .map(|&i| {
                    let re = std::array::from_fn(|lane| value(i, lane));
                    let im = std::array::from_fn(|lane| value(i + 5, lane + 1));
                    [re, im]
                })
                .collect();
            for s in &plan.stages {
                s.run(lanes.path(), z.as_flattened_mut().as_flattened_mut());
            }
            let library = rustfft::FftPlanner::new().plan_fft_forward(n);
            for lane in 0..W {
                let mut y: Vec<_> =
                    (0..n).map(|i| Number::new(value(i, lane), value(i + 5, lane + 1))).collect();
                library.process(&mut y);
                for k in 0..n {
                    let error = (y[k].re - z[k][0][lane]).hypot(y[k].im - z[k][1][lane]);
                    // Rounding grows like log n; values are of order 5, sums of order 5 n.
                    assert!(error < 1e-14 * n as f64, "length {n}, k {k}: {error}");
                }
            }
        }
    }

    #[test]
    fn agrees_with_the_library() {
        for path in [Path::choose(Instructions::Best), Path::choose(Instructions::Portable)] {
            for n in [
                1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 16, 20, 24, 32, 35, 45, 64, 77, 96, 100, 117, 128, 143, 180,
                200, 243, 250, 256, 512,
            ] {
                for reversed in [false, true] {
                    dispatch(path, Check(n, reversed));
                }
            }
        }
    }
}

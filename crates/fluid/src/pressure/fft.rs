//! Complex mixed-radix Fourier transforms of many lines at once: lanes across
//! lines, decimation in time, in place.
//!
//! `Z_k = sum_n z_n exp(-2 pi i k n / N)`, not normalised. The input must lie
//! in the order of [`Plan::source`], which costs nothing when it is loaded so.

use crate::lanes::{Kernel, Lanes, dispatch};
use std::f64::consts::TAU;

/// The largest prime factor that the batched transform takes; longer ones go to the library.
pub const LARGEST_FACTOR: usize = 13;

/// One point of `W` lines: real parts, then imaginary parts.
pub(crate) type Complex<const W: usize> = [[f64; W]; 2];

/// Factors and twiddles of one length.
#[derive(Clone, Debug)]
pub(crate) struct Plan {
    /// Which input belongs at each place.
    pub source: Vec<usize>,
    stages: Vec<Stage>,
}

/// All butterflies of one radix.
#[derive(Clone, Debug)]
struct Stage {
    radix: usize,
    /// Length of the transforms that this stage joins.
    part: usize,
    /// For each of the `part` places the `radix - 1` factors exp(-2 pi i p j / (radix part)).
    twiddles: Vec<[f64; 2]>,
    /// exp(-2 pi i q / radix), for radices without a written-out butterfly.
    roots: Vec<[f64; 2]>,
}

/// cos and -sin of 2 pi k / n.
fn root(k: usize, n: usize) -> [f64; 2] {
    let k = k % n;
    let turn = if 2 * k > n { k as f64 - n as f64 } else { k as f64 };
    let (s, c) = (TAU * turn / n as f64).sin_cos();
    [c, -s]
}

/// Factors of `n` in the order in which the stages run.
fn factors(mut n: usize) -> Vec<usize> {
    let mut f = vec![];
    let mut take = |n: &mut usize, r: usize| {
        while n.is_multiple_of(r) {
            *n /= r;
            f.push(r);
        }
    };
    for r in [5, 3, 7, 11, 13] {
        take(&mut n, r);
    }
    debug_assert!(n.is_power_of_two(), "a prime factor is too large");
    // As few passes as there can be: two fours where eights alone would leave a two.
    let twos = n.trailing_zeros() as usize;
    let fours = if twos == 1 { 0 } else { [0, 2, 1][twos % 3] };
    let eights = (twos - 2 * fours) / 3;
    f.extend(std::iter::repeat_n(8, eights));
    f.extend(std::iter::repeat_n(4, fours));
    f.extend(std::iter::repeat_n(2, twos - 3 * eights - 2 * fours));
    f
}

impl Plan {
    /// The plan for lines of `n` points, all of whose prime factors are small.
    pub fn new(n: usize) -> Self {
        let radices = factors(n);
        let mut stages = vec![];
        let mut part = 1;
        for &radix in &radices {
            let size = part * radix;
            let twiddles = (0..part).flat_map(|j| (1..radix).map(move |p| root(p * j, size))).collect();
            let roots = if matches!(radix, 2..=5 | 8) {
                vec![]
            } else {
                (0..radix).map(|q| root(q, radix)).collect()
            };
            stages.push(Stage { radix, part, twiddles, roots });
            part = size;
        }
        let source = (0..n).map(|place| source_of(place, n, &radices)).collect();
        Self { source, stages }
    }

    /// Transforms in place.
    #[inline(always)]
    pub fn run<const W: usize, const F: bool>(&self, lanes: Lanes<W, F>, z: &mut [Complex<W>]) {
        // Entered anew, so that the butterflies are compiled once and not in every kernel that transforms.
        dispatch(
            lanes.path(),
            Butterflies { stages: &self.stages, z: z.as_flattened_mut().as_flattened_mut() },
        );
    }
}

struct Butterflies<'a> {
    stages: &'a [Stage],
    z: &'a mut [f64],
}

impl Kernel for Butterflies<'_> {
    #[inline(always)]
    fn run<const W: usize, const F: bool>(self, lanes: Lanes<W, F>) {
        let z = self.z.as_chunks_mut::<W>().0.as_chunks_mut::<2>().0;
        for s in self.stages {
            match s.radix {
                2 => pass2(lanes, z, s),
                3 => pass3(lanes, z, s),
                4 => pass4(lanes, z, s),
                5 => pass5(lanes, z, s),
                8 => pass8(lanes, z, s),
                _ => pass_odd(lanes, z, s),
            }
        }
    }
}

/// Which input stands at `place` after the subsequences have been sorted out.
fn source_of(place: usize, n: usize, radices: &[usize]) -> usize {
    let Some((&last, rest)) = radices.split_last() else { return 0 };
    let part = n / last;
    last * source_of(place % part, part, rest) + place / part
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
fn parts<const R: usize, T>(mut block: &mut [T], part: usize) -> [&mut [T]; R] {
    std::array::from_fn(|_| {
        let (head, tail) = std::mem::take(&mut block).split_at_mut(part);
        block = tail;
        head
    })
}

#[inline(always)]
fn pass2<const W: usize, const F: bool>(l: Lanes<W, F>, z: &mut [Complex<W>], s: &Stage) {
    for block in z.chunks_exact_mut(2 * s.part) {
        let [a, b] = parts::<2, _>(block, s.part);
        for ((a, b), w) in a.iter_mut().zip(b).zip(&s.twiddles) {
            let (x, y) = (*a, turned(l, *b, *w));
            (*a, *b) = (add(l, x, y), sub(l, x, y));
        }
    }
}

#[inline(always)]
fn pass3<const W: usize, const F: bool>(l: Lanes<W, F>, z: &mut [Complex<W>], s: &Stage) {
    let sin = 0.75_f64.sqrt();
    for block in z.chunks_exact_mut(3 * s.part) {
        let [a, b, c] = parts::<3, _>(block, s.part);
        for (((a, b), c), w) in a.iter_mut().zip(b).zip(c).zip(s.twiddles.as_chunks::<2>().0) {
            let (x, y, z) = (*a, turned(l, *b, w[0]), turned(l, *c, w[1]));
            let (sum, dif) = (add(l, y, z), scaled(l, sin, sub(l, y, z)));
            let mid = axpy(l, -0.5, sum, x);
            *a = add(l, x, sum);
            *b = minus_i(l, mid, dif);
            *c = plus_i(l, mid, dif);
        }
    }
}

#[inline(always)]
fn pass4<const W: usize, const F: bool>(l: Lanes<W, F>, z: &mut [Complex<W>], s: &Stage) {
    if s.part == 1 {
        for block in z.as_chunks_mut::<4>().0 {
            *block = butterfly4(l, *block);
        }
        return;
    }
    for block in z.chunks_exact_mut(4 * s.part) {
        let [a, b, c, d] = parts::<4, _>(block, s.part);
        let legs = a.iter_mut().zip(b).zip(c).zip(d);
        for ((((a, b), c), d), w) in legs.zip(s.twiddles.as_chunks::<3>().0) {
            let x = [*a, turned(l, *b, w[0]), turned(l, *c, w[1]), turned(l, *d, w[2])];
            [*a, *b, *c, *d] = butterfly4(l, x);
        }
    }
}

#[inline(always)]
fn butterfly4<const W: usize, const F: bool>(l: Lanes<W, F>, x: [Complex<W>; 4]) -> [Complex<W>; 4] {
    let (s, t) = (add(l, x[0], x[2]), sub(l, x[0], x[2]));
    let (u, v) = (add(l, x[1], x[3]), sub(l, x[1], x[3]));
    [add(l, s, u), minus_i(l, t, v), sub(l, s, u), plus_i(l, t, v)]
}

#[inline(always)]
fn pass8<const W: usize, const F: bool>(l: Lanes<W, F>, z: &mut [Complex<W>], s: &Stage) {
    if s.part == 1 {
        for block in z.as_chunks_mut::<8>().0 {
            *block = butterfly8(l, *block);
        }
        return;
    }
    for block in z.chunks_exact_mut(8 * s.part) {
        let [a, b, c, d, e, f, g, h] = parts::<8, _>(block, s.part);
        let low = a.iter_mut().zip(b).zip(c).zip(d);
        let high = e.iter_mut().zip(f).zip(g).zip(h);
        for ((low, high), w) in low.zip(high).zip(s.twiddles.as_chunks::<7>().0) {
            let ((((a, b), c), d), (((e, f), g), h)) = (low, high);
            let x = [
                *a,
                turned(l, *b, w[0]),
                turned(l, *c, w[1]),
                turned(l, *d, w[2]),
                turned(l, *e, w[3]),
                turned(l, *f, w[4]),
                turned(l, *g, w[5]),
                turned(l, *h, w[6]),
            ];
            [*a, *b, *c, *d, *e, *f, *g, *h] = butterfly8(l, x);
        }
    }
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

#[inline(always)]
fn pass5<const W: usize, const F: bool>(l: Lanes<W, F>, z: &mut [Complex<W>], s: &Stage) {
    let [c1, s1] = root(1, 5);
    let [c2, s2] = root(2, 5);
    let (s1, s2) = (-s1, -s2);
    for block in z.chunks_exact_mut(5 * s.part) {
        let [a, b, c, d, e] = parts::<5, _>(block, s.part);
        let legs = a.iter_mut().zip(b).zip(c).zip(d).zip(e);
        for (((((a, b), c), d), e), w) in legs.zip(s.twiddles.as_chunks::<4>().0) {
            let x0 = *a;
            let (x1, x2) = (turned(l, *b, w[0]), turned(l, *c, w[1]));
            let (x3, x4) = (turned(l, *d, w[2]), turned(l, *e, w[3]));
            let (p1, m1) = (add(l, x1, x4), sub(l, x1, x4));
            let (p2, m2) = (add(l, x2, x3), sub(l, x2, x3));
            let r1 = axpy(l, c2, p2, axpy(l, c1, p1, x0));
            let r2 = axpy(l, c1, p2, axpy(l, c2, p1, x0));
            let i1 = axpy(l, s2, m2, scaled(l, s1, m1));
            let i2 = axpy(l, -s1, m2, scaled(l, s2, m1));
            *a = add(l, x0, add(l, p1, p2));
            *b = minus_i(l, r1, i1);
            *c = minus_i(l, r2, i2);
            *d = plus_i(l, r2, i2);
            *e = plus_i(l, r1, i1);
        }
    }
}

/// Odd primes up to [`LARGEST_FACTOR`], from their definition, halved by symmetry.
#[inline(always)]
fn pass_odd<const W: usize, const F: bool>(l: Lanes<W, F>, z: &mut [Complex<W>], s: &Stage) {
    let (r, m) = (s.radix, s.part);
    let half = (r - 1) / 2;
    let zero = [[0.0; W], [0.0; W]];
    for block in z.chunks_exact_mut(r * m) {
        for j in 0..m {
            let x0 = block[j];
            let (mut plus, mut minus) = ([zero; LARGEST_FACTOR / 2], [zero; LARGEST_FACTOR / 2]);
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
                let (mut even, mut odd) = (x0, zero);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::Path;
    use crate::spec::Instructions;
    use rustfft::num_complex::Complex as Number;

    struct Check(usize);
    impl Kernel for Check {
        #[inline(always)]
        fn run<const W: usize, const F: bool>(self, lanes: Lanes<W, F>) {
            let n = self.0;
            let value = |i: usize, lane: usize| ((i * 7 + lane * 3) % 11) as f64 - 4.5;
            let plan = Plan::new(n);
            let mut z: Vec<Complex<W>> = plan
                .source
                .iter()
                .map(|&i| {
                    let re = std::array::from_fn(|lane| value(i, lane));
                    let im = std::array::from_fn(|lane| value(i + 5, lane + 1));
                    [re, im]
                })
                .collect();
            plan.run(lanes, &mut z);
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
                dispatch(path, Check(n));
            }
        }
    }
}

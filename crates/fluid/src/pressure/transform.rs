//! Real transforms along one direction of a block of rows: cosine where there
//! are walls, Fourier where it is periodic. They diagonalise the second
//! difference with zero slope half a cell beyond both ends, or with period n.
//!
//! Two lines ride in one complex transform of the same length: with Z the
//! transform of a + i b, the spectra follow from Z_k and Z_{n-k} (Makhoul 1980).
//!
//! ```text
//! cosine:  X_k = sum_i x_i cos(pi k (i + 1/2) / n)
//! Fourier: X_k = Re, X_{n-k} = -Im of sum_i x_i exp(-2 pi i k i / n)
//! ```

use super::fft::{Complex, Plan};
use super::rows::Rows;
use crate::lanes::{Lanes, prefetch};
use std::f64::consts::PI;

/// Which transform a direction takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// Walls at both ends.
    Cosine,
    /// Periodic.
    Fourier,
}

/// A transform of lines of one length, many lines at once.
#[derive(Clone, Debug)]
pub(crate) struct Transform {
    /// Points of a line.
    pub length: usize,
    plan: Plan,
    /// Which point of the line stands at each place of the complex input.
    source: Vec<usize>,
    /// Which point of the line the inverse leaves at each place.
    point: Vec<usize>,
    /// Where the spectrum's number k stands in the input of the inverse.
    place: Vec<usize>,
    /// cos and sin of the half-sample shift of number k, 0 <= k <= n / 2.
    shift: Vec<[f64; 2]>,
}

/// Eigenvalue of the second difference for number `k` of `n`, in units of 1/h².
#[must_use]
pub fn eigenvalue(family: Family, k: usize, n: usize) -> f64 {
    let half_angle = match family {
        Family::Cosine => PI * k as f64 / (2 * n) as f64,
        Family::Fourier => PI * k as f64 / n as f64,
    };
    -4.0 * half_angle.sin().powi(2)
}

/// `2 W` columns of row `r`, or `W` and zeros.
///
/// `HALF` is a constant: a condition here sends every vector through the stack.
#[inline(always)]
fn get<const HALF: bool, const W: usize, const F: bool>(
    l: Lanes<W, F>,
    rows: &impl Rows,
    r: usize,
    column: usize,
) -> Complex<W> {
    let row = &rows.row(r)[column..];
    [l.load(row), if HALF { [0.0; W] } else { l.load(&row[W..]) }]
}

/// Undoes [`get`].
#[inline(always)]
fn put<const HALF: bool, const W: usize, const F: bool>(
    l: Lanes<W, F>,
    rows: &mut impl Rows,
    r: usize,
    column: usize,
    x: Complex<W>,
) {
    let row = &mut rows.row_mut(r)[column..];
    l.store(row, x[0]);
    if !HALF {
        l.store(&mut row[W..], x[1]);
    }
}

/// Asks for what a transform will need after these columns of row `r`: a step
/// from row to row is too long for a processor to guess it.
#[inline(always)]
fn prefetch_beyond<const W: usize>(rows: &impl Rows, r: usize, column: usize) {
    let next = rows.row(r).as_ptr().wrapping_add(column + rows.ahead(2 * W));
    for line in (0..2 * W).step_by(8) {
        prefetch(next.wrapping_add(line));
    }
}

impl Transform {
    /// The transform of `length` points, all of whose prime factors are small.
    pub fn new(family: Family, length: usize) -> Self {
        let plan = Plan::new(length);
        let reorder = |i: usize| match family {
            Family::Fourier => i,
            Family::Cosine if 2 * i < length => 2 * i,
            Family::Cosine => 2 * (length - i) - 1,
        };
        let source = plan.source.iter().map(|&i| reorder(i)).collect();
        let point = (0..length).map(reorder).collect();
        let mut place = vec![0; length];
        for (p, &k) in plan.source.iter().enumerate() {
            place[k] = p;
        }
        let shift = (0..=length / 2)
            .map(|k| match family {
                Family::Fourier => [1.0, 0.0],
                Family::Cosine => {
                    let (s, c) = (PI * k as f64 / (2 * length) as f64).sin_cos();
                    [c, s]
                }
            })
            .collect();
        Self { length, plan, source, point, place, shift }
    }

    /// Transforms `2 W` columns from `column` on, in place; with `HALF`, only
    /// the first `W` of them.
    #[inline(always)]
    pub fn forward<const HALF: bool, const W: usize, const F: bool>(
        &self,
        l: Lanes<W, F>,
        rows: &mut impl Rows,
        column: usize,
        z: &mut [Complex<W>],
    ) {
        // Straight from memory to memory: a pair in between would go through the stack.
        for (z, &i) in z.iter_mut().zip(&self.source) {
            prefetch_beyond::<W>(rows, i, column);
            let row = &rows.row(i)[column..];
            z[0].copy_from_slice(&row[..W]);
            if HALF {
                z[1] = [0.0; W];
            } else {
                z[1].copy_from_slice(&row[W..2 * W]);
            }
        }
        self.plan.run(l, z);
        let n = self.length;
        put::<HALF, W, F>(l, rows, 0, column, z[0]);
        for k in 1..=n / 2 {
            let [c, s] = self.shift[k];
            let (p, q) = (z[k], z[n - k]);
            // Each of the two spectra at k, doubled: its real part, minus its imaginary part.
            let (re_a, im_a) = (l.add(p[0], q[0]), l.sub(q[1], p[1]));
            let (re_b, im_b) = (l.add(p[1], q[1]), l.sub(p[0], q[0]));
            let (c, s) = ([0.5 * c; W], [0.5 * s; W]);
            let x = [l.vmsub(c, re_a, l.mul(s, im_a)), l.vmsub(c, re_b, l.mul(s, im_b))];
            put::<HALF, W, F>(l, rows, k, column, x);
            if 2 * k < n {
                let y = [l.vmadd(s, re_a, l.mul(c, im_a)), l.vmadd(s, re_b, l.mul(c, im_b))];
                put::<HALF, W, F>(l, rows, n - k, column, y);
            }
        }
    }

    /// Undoes [`Self::forward`], times `length`.
    #[inline(always)]
    pub fn inverse<const HALF: bool, const W: usize, const F: bool>(
        &self,
        l: Lanes<W, F>,
        rows: &mut impl Rows,
        column: usize,
        z: &mut [Complex<W>],
    ) {
        let n = self.length;
        // Real and imaginary parts change places: a forward transform then inverts.
        let [re, im] = get::<HALF, W, F>(l, rows, 0, column);
        z[self.place[0]] = [im, re];
        for k in 1..=n / 2 {
            let [c, s] = self.shift[k];
            prefetch_beyond::<W>(rows, k, column);
            let [a, b] = get::<HALF, W, F>(l, rows, k, column);
            if 2 * k == n {
                let x = [c + s; W];
                z[self.place[k]] = [l.mul(x, b), l.mul(x, a)];
                break;
            }
            prefetch_beyond::<W>(rows, n - k, column);
            let [a_far, b_far] = get::<HALF, W, F>(l, rows, n - k, column);
            let (c, s) = ([c; W], [s; W]);
            let (re_a, im_a) = (l.vmadd(c, a, l.mul(s, a_far)), l.vmsub(c, a_far, l.mul(s, a)));
            let (re_b, im_b) = (l.vmadd(c, b, l.mul(s, b_far)), l.vmsub(c, b_far, l.mul(s, b)));
            z[self.place[k]] = [l.sub(re_b, im_a), l.add(re_a, im_b)];
            z[self.place[n - k]] = [l.add(re_b, im_a), l.sub(re_a, im_b)];
        }
        self.plan.run(l, z);
        for (z, &i) in z.iter().zip(&self.point) {
            let row = &mut rows.row_mut(i)[column..];
            row[..W].copy_from_slice(&z[1]);
            if !HALF {
                row[W..2 * W].copy_from_slice(&z[0]);
            }
        }
    }
}

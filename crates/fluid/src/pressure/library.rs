//! The same real transforms through the library's one-line complex transform,
//! two lines per call: for lengths with large prime factors, and as the
//! yardstick of the batched ones.

use super::rows::Rows;
use super::transform::Family;
use rustfft::num_complex::Complex;
use rustfft::{Fft, FftPlanner};
use std::cell::Cell;
use std::f64::consts::PI;
use std::sync::Arc;

/// Columns that are carried through memory together.
pub(crate) const PANEL: usize = 16;

thread_local! {
    static LINES: Cell<Vec<Complex<f64>>> = const { Cell::new(Vec::new()) };
}

/// A transform of lines of one length by the library.
#[derive(Clone)]
pub(crate) struct LibraryTransform {
    length: usize,
    family: Family,
    fft: Arc<dyn Fft<f64>>,
    /// cos and sin of the half-sample shift of number k.
    shift: Vec<[f64; 2]>,
}

impl std::fmt::Debug for LibraryTransform {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "LibraryTransform({:?}, {})", self.family, self.length)
    }
}

impl LibraryTransform {
    /// The transform of `length` points, any number.
    pub fn new(family: Family, length: usize) -> Self {
        let fft = FftPlanner::new().plan_fft_forward(length);
        let shift = (0..length)
            .map(|k| match family {
                Family::Fourier => [1.0, 0.0],
                Family::Cosine => {
                    let (s, c) = (PI * k as f64 / (2 * length) as f64).sin_cos();
                    [c, s]
                }
            })
            .collect();
        Self { length, family, fft, shift }
    }

    /// Which point of the line stands at place `i` of the complex line.
    fn point(&self, i: usize) -> usize {
        match self.family {
            Family::Fourier => i,
            Family::Cosine if 2 * i < self.length => 2 * i,
            Family::Cosine => 2 * (self.length - i) - 1,
        }
    }

    /// Lends a panel of `PANEL / 2` complex lines and the library's scratch.
    fn with_lines(&self, work: impl FnOnce(&mut [Complex<f64>], &mut [Complex<f64>])) {
        let (n, extra) = (self.length, self.fft.get_inplace_scratch_len());
        let mut memory = LINES.take();
        let len = n * PANEL / 2 + extra;
        if memory.len() < len {
            memory = vec![Complex::default(); len];
        }
        let (lines, scratch) = memory.split_at_mut(n * PANEL / 2);
        work(lines, &mut scratch[..extra]);
        LINES.set(memory);
    }

    /// Transforms `width` (even, at most [`PANEL`]) columns from `column` on, in place.
    pub fn forward(&self, rows: &mut Rows<'_>, column: usize, width: usize) {
        let n = self.length;
        self.with_lines(|lines, scratch| {
            for i in 0..n {
                let row = &rows.row(self.point(i))[column..column + width];
                for (pair, x) in row.as_chunks::<2>().0.iter().enumerate() {
                    lines[pair * n + i] = Complex::new(x[0], x[1]);
                }
            }
            for line in lines[..n * width / 2].chunks_exact_mut(n) {
                self.fft.process_with_scratch(line, scratch);
            }
            for k in 0..n {
                let far = (n - k) % n;
                let [c, s] = self.shift[k];
                let row = &mut rows.row_mut(k)[column..column + width];
                for (pair, x) in row.as_chunks_mut::<2>().0.iter_mut().enumerate() {
                    let (p, q) = (lines[pair * n + k], lines[pair * n + far]);
                    let (re, im) = (0.5 * (p.re + q.re), 0.5 * (p.im - q.im));
                    let (re2, im2) = (0.5 * (p.im + q.im), 0.5 * (q.re - p.re));
                    *x = match self.family {
                        Family::Cosine => [c * re + s * im, c * re2 + s * im2],
                        Family::Fourier if 2 * k <= n => [re, re2],
                        // The far half holds minus the imaginary parts of the near one.
                        Family::Fourier => [im, im2],
                    };
                }
            }
        });
    }

    /// Undoes [`Self::forward`], times `length`.
    pub fn inverse(&self, rows: &mut Rows<'_>, column: usize, width: usize) {
        let n = self.length;
        self.with_lines(|lines, scratch| {
            for k in 0..n {
                let [c, s] = self.shift[k];
                let near = &rows.row(k)[column..column + width];
                let far = &rows.row((n - k) % n)[column..column + width];
                for (pair, (x, y)) in near.as_chunks::<2>().0.iter().zip(far.as_chunks::<2>().0).enumerate() {
                    let closed = k == 0 || (self.family == Family::Fourier && 2 * k == n);
                    let (y0, y1) = if closed { (0.0, 0.0) } else { (y[0], y[1]) };
                    let upper = self.family == Family::Fourier && 2 * k > n;
                    // In the upper half near and far trade places, with the conjugate.
                    let (re, im) = if upper { (y0, x[0]) } else { (c * x[0] + s * y0, s * x[0] - c * y0) };
                    let (re2, im2) = if upper { (y1, x[1]) } else { (c * x[1] + s * y1, s * x[1] - c * y1) };
                    // Swapped, so that the forward transform inverts.
                    lines[pair * n + k] = Complex::new(im + re2, re - im2);
                }
            }
            for line in lines[..n * width / 2].chunks_exact_mut(n) {
                self.fft.process_with_scratch(line, scratch);
            }
            for i in 0..n {
                let row = &mut rows.row_mut(self.point(i))[column..column + width];
                for (pair, x) in row.as_chunks_mut::<2>().0.iter_mut().enumerate() {
                    let z = lines[pair * n + i];
                    *x = [z.im, z.re];
                }
            }
        });
    }
}

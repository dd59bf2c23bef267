//! The Poisson equation with a coefficient on each face, by conjugate
//! gradients that the direct solver for coefficient 1 preconditions.
//!
//! ```text
//! div(kappa grad q) = f
//! ```
//!
//! Closed faces have kappa = 0: walls, obstacles. Iterations depend on how much
//! kappa varies and hardly on the grid.

use super::poisson::Poisson;
use crate::shape::Shape;
use brazilnut_base::Side;
use rayon::prelude::*;

/// How an iteration ended.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Convergence {
    /// Iterations.
    pub iterations: usize,
    /// Largest residual, in the unit of the right side (of a step: Pa/m²).
    pub residual: f64,
    /// Whether the residual came below the tolerance.
    pub converged: bool,
}

/// Iterations after which a solve is given up.
const GIVE_UP: usize = 500;

/// Vectors of the iteration, in the direct solver's layout.
#[derive(Clone, Debug)]
pub(crate) struct ConjugateGradient {
    /// Right side on entry, residual during.
    pub residual: Vec<f64>,
    /// First guess on entry, solution on return.
    pub solution: Vec<f64>,
    smoothed: Vec<f64>,
    direction: Vec<f64>,
    image: Vec<f64>,
    partial: Vec<f64>,
}

/// The operator: coefficients on faces by level, divided by the squares of the spacings.
pub(crate) struct Operator<'a> {
    pub shape: &'a Shape,
    pub poisson: &'a Poisson,
    pub kappa: [&'a [f64]; 3],
}

impl ConjugateGradient {
    pub fn new(poisson: &Poisson) -> Self {
        let zeros = || vec![0.0; poisson.len()];
        Self {
            residual: zeros(),
            solution: zeros(),
            smoothed: zeros(),
            direction: zeros(),
            image: zeros(),
            partial: vec![0.0; poisson.cells[2]],
        }
    }

    /// Solves to a largest residual of `tolerance`.
    pub fn solve(&mut self, op: &Operator<'_>, tolerance: f64) -> Convergence {
        // The operator is negative: the iteration runs on its opposite.
        op.apply(&self.solution, &mut self.image, &mut self.partial);
        let mut worst = self.start(op);
        let mut previous = 0.0;
        for iterations in 0..GIVE_UP {
            if worst <= tolerance || !worst.is_finite() {
                return Convergence { iterations, residual: worst, converged: worst <= tolerance };
            }
            self.smoothed.copy_from_slice(&self.residual);
            op.poisson.solve(&mut self.smoothed);
            let product = -op.dot(&self.residual, &self.smoothed, &mut self.partial);
            let keep = if iterations == 0 { 0.0 } else { product / previous };
            previous = product;
            self.turn(op, keep);
            let curvature = op.apply(&self.direction, &mut self.image, &mut self.partial);
            if curvature <= 0.0 {
                return Convergence { iterations, residual: worst, converged: false };
            }
            worst = self.advance(op, product / curvature);
        }
        Convergence { iterations: GIVE_UP, residual: worst, converged: false }
    }

    /// residual = image - right side; its largest magnitude.
    fn start(&mut self, op: &Operator<'_>) -> f64 {
        let image = &self.image;
        op.each_row(&mut self.residual, &mut self.partial, |at, row| {
            let mut worst = 0.0_f64;
            for (r, b) in row.iter_mut().zip(&image[at..]) {
                *r = -*r - b;
                worst = worst.max(r.abs());
            }
            worst
        });
        largest(&self.partial)
    }

    /// direction = -smoothed + keep direction
    fn turn(&mut self, op: &Operator<'_>, keep: f64) {
        let smoothed = &self.smoothed;
        op.each_row(&mut self.direction, &mut self.partial, |at, row| {
            for (d, z) in row.iter_mut().zip(&smoothed[at..]) {
                *d = keep * *d - z;
            }
            0.0
        });
    }

    /// solution += step direction; residual -= step image; the largest residual.
    fn advance(&mut self, op: &Operator<'_>, step: f64) -> f64 {
        let (direction, image) = (&self.direction, &self.image);
        op.each_row(&mut self.solution, &mut self.partial, |at, row| {
            for (x, d) in row.iter_mut().zip(&direction[at..]) {
                *x += step * d;
            }
            0.0
        });
        op.each_row(&mut self.residual, &mut self.partial, |at, row| {
            let mut worst = 0.0_f64;
            for (r, b) in row.iter_mut().zip(&image[at..]) {
                *r -= step * b;
                worst = worst.max(r.abs());
            }
            worst
        });
        largest(&self.partial)
    }
}

/// The largest, or not a number if any is none.
fn largest(parts: &[f64]) -> f64 {
    parts.iter().fold(0.0, |a: f64, &b| if b.is_nan() { b } else { a.max(b) })
}

/// Sum of products in eight interleaved parts.
fn product(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; 8];
    let ((a, a_rest), (b, b_rest)) = (a.as_chunks::<8>(), b.as_chunks::<8>());
    for (a, b) in a.iter().zip(b) {
        for lane in 0..8 {
            sums[lane] += a[lane] * b[lane];
        }
    }
    for (lane, (a, b)) in a_rest.iter().zip(b_rest).enumerate() {
        sums[lane] += a * b;
    }
    sums.iter().sum()
}

impl Operator<'_> {
    /// Calls `work(place, row)` for each row of `data`; the largest result of each plane goes to `partial`.
    fn each_row(
        &self,
        data: &mut [f64],
        partial: &mut [f64],
        work: impl Fn(usize, &mut [f64]) -> f64 + Sync,
    ) {
        let (n, block) = (self.shape.n, self.poisson.block);
        let plane = |(k, (planes, result)): (usize, (&mut [f64], &mut f64))| {
            let parts = (0..n[1]).map(|j| {
                let row = &mut planes[j * block.pitch..][..n[0]];
                work(self.poisson.row(j, k), row)
            });
            *result = parts.fold(0.0, |a: f64, b| if b.is_nan() { b } else { a.max(b) });
        };
        let data = &mut data[..n[2] * block.plane];
        if self.poisson.parallel {
            data.par_chunks_mut(block.plane).zip(partial).enumerate().for_each(plane);
        } else {
            data.chunks_mut(block.plane).zip(partial).enumerate().for_each(plane);
        }
    }

    /// Sum of products of two vectors.
    fn dot(&self, a: &[f64], b: &[f64], partial: &mut [f64]) -> f64 {
        let n = self.shape.n;
        let plane = |(k, sum): (usize, &mut f64)| {
            let rows = (0..n[1]).map(|j| self.poisson.row(j, k));
            *sum = rows.map(|at| product(&a[at..at + n[0]], &b[at..at + n[0]])).sum();
        };
        if self.poisson.parallel {
            partial.par_iter_mut().enumerate().for_each(plane);
        } else {
            partial.iter_mut().enumerate().for_each(plane);
        }
        // Added in order, so that the sum is the same for any number of threads.
        partial.iter().sum()
    }

    /// image = -div(kappa grad x); the sum of x times image.
    fn apply(&self, x: &[f64], image: &mut [f64], partial: &mut [f64]) -> f64 {
        let (n, block) = (self.shape.n, self.poisson.block);
        let plane = |(k, (planes, sum)): (usize, (&mut [f64], &mut f64))| {
            let rows = (0..n[1]).map(|j| {
                let row = &mut planes[j * block.pitch..][..n[0]];
                self.apply_row(x, row, j, k);
                product(row, &x[self.poisson.row(j, k)..][..n[0]])
            });
            *sum = rows.sum();
        };
        let image = &mut image[..n[2] * block.plane];
        if self.poisson.parallel {
            image.par_chunks_mut(block.plane).zip(&mut *partial).enumerate().for_each(plane);
        } else {
            image.chunks_mut(block.plane).zip(&mut *partial).enumerate().for_each(plane);
        }
        partial.iter().sum()
    }

    fn apply_row(&self, x: &[f64], out: &mut [f64], j: usize, k: usize) {
        let shape = self.shape;
        let [n0, n1, n2] = shape.n;
        let s = shape.stride;
        let row = |j: usize, k: usize| &x[self.poisson.row(j, k)..][..n0];
        // Beyond a closed face any row will do, since its coefficient is zero.
        let behind = |i: usize, n: usize, level: usize| match (i, shape.side[level]) {
            (0, Side::Periodic) => n - 1,
            (0, _) => 0,
            _ => i - 1,
        };
        let ahead = |i: usize, n: usize, level: usize| match (i + 1 == n, shape.side[level]) {
            (true, Side::Periodic) => 0,
            (true, _) => i,
            _ => i + 1,
        };
        let here = row(j, k);
        let at = shape.row(j, k);
        let kappa = |level: usize, up: usize| &self.kappa[level][at + up * s[level]..][..n0];
        let neighbours = [
            (row(behind(j, n1, 1), k), kappa(1, 0)),
            (row(ahead(j, n1, 1), k), kappa(1, 1)),
            (row(j, behind(k, n2, 2)), kappa(2, 0)),
            (row(j, ahead(k, n2, 2)), kappa(2, 1)),
        ];
        let [(a, ka), (b, kb), (c, kc), (d, kd)] = neighbours;
        let kx = &self.kappa[0][at..=at + n0];
        for i in 0..n0 {
            let x = here[i];
            out[i] = ka[i] * (x - a[i]) + kb[i] * (x - b[i]) + kc[i] * (x - c[i]) + kd[i] * (x - d[i]);
        }
        for i in 1..n0 {
            out[i] += kx[i] * (here[i] - here[i - 1]);
        }
        for i in 0..n0 - 1 {
            out[i] += kx[i + 1] * (here[i] - here[i + 1]);
        }
        // At a held end the value beyond is zero.
        let round = shape.side[0] == Side::Periodic;
        out[0] += kx[0] * (here[0] - if round { here[n0 - 1] } else { 0.0 });
        out[n0 - 1] += kx[n0] * (here[n0 - 1] - if round { here[0] } else { 0.0 });
    }
}

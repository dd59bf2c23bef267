//! The projection: from v* to the nearest velocity without divergence.
//!
//! ```text
//! laplacian q = rho / dt div v*          (Clément 2.35)
//! v = v* - dt / rho grad q               (Clément 2.34)
//! ```
//!
//! q is the new pressure or its increment. The divergence rides with the
//! forward transform of a plane, the correction with the one back.

use crate::ghosts::Table;
use crate::lanes::{Kernel, Lanes, Path, dispatch};
use crate::pressure::Poisson;
use crate::pressure::poisson::Direction;
use crate::shape::Shape;
use brazilnut_base::Side;
use rayon::prelude::*;

/// Blocks of planes that the correction is cut into.
const BLOCKS: usize = 32;

/// What stands at the two ends of level 0.
#[derive(Clone, Copy, Debug)]
pub(crate) enum End<'a> {
    /// The line closes on itself.
    Periodic,
    /// A wall.
    Closed,
    /// Normal velocity into positive direction at each (j, k), m/s.
    Inflow(&'a [f64]),
    /// Pressure (or increment) held at this value, Pa.
    Held(f64),
}

/// What both sweeps need to know.
pub(crate) struct Projection<'a> {
    pub path: Path,
    pub parallel: bool,
    pub shape: &'a Shape,
    pub poisson: &'a Poisson,
    pub ends: &'a [End<'a>; 2],
    /// rho / dt, Pa s/m²
    pub strength: f64,
    /// Whether q is added to the pressure or replaces it.
    pub incremental: bool,
    pub ghosts: &'a Table,
}

impl Projection<'_> {
    /// Velocity through an end of row (j, k); `free` where it is not prescribed.
    #[inline(always)]
    fn normal(&self, end: usize, j: usize, k: usize, free: f64) -> f64 {
        match self.ends[end] {
            End::Closed => 0.0,
            End::Inflow(profile) => profile[j + k * self.shape.n[1]],
            _ => free,
        }
    }

    /// Right sides of all planes from v*, transformed along level 1, into `data`.
    pub fn gather(&self, star: [&mut [f64]; 3], data: &mut [f64]) {
        let shape = self.shape;
        let [u, v, w] = star;
        match shape.side[2] {
            Side::Walls => {
                w[shape.interior().start..][..shape.plane].fill(0.0);
                w[shape.interior().end..][..shape.plane].fill(0.0);
            }
            Side::Periodic => {
                let first = shape.interior().start;
                w.copy_within(first..first + shape.plane, shape.interior().end);
            }
            Side::Flat => {}
        }
        let w: &[f64] = w;
        let rows = data[..shape.n[2] * self.poisson.block.plane].par_chunks_mut(self.poisson.block.plane);
        let planes = (u[shape.interior()].par_chunks_mut(shape.plane))
            .zip(v[shape.interior()].par_chunks_mut(shape.plane))
            .zip(rows);
        let grain = if self.parallel { 1 } else { shape.n[2] };
        planes.enumerate().with_min_len(grain).for_each(|(k, ((u, v), rows))| {
            dispatch(self.path, Gather { of: self, k, u, v, w, rows });
        });
    }

    /// Velocity and pressure from v* and the solution in `data`, still transformed
    /// along level 1; the largest sum of |v| / h of each plane into `peaks`, 1/s.
    pub fn scatter(
        &self,
        star: [&[f64]; 3],
        data: &mut [f64],
        v: [&mut [f64]; 3],
        p: &mut [f64],
        peaks: &mut [f64],
    ) {
        let shape = self.shape;
        let per_block = shape.n[2].div_ceil(BLOCKS);
        let mut blocks: [Block<'_>; BLOCKS] = Default::default();
        let [u, v, w] = v;
        for (c, field) in [u, v, &mut *w, p].into_iter().enumerate() {
            let chunks = field[shape.interior()].chunks_mut(per_block * shape.plane);
            chunks.zip(&mut blocks).for_each(|(chunk, block)| block.fields[c] = chunk);
        }
        let rows =
            data[..shape.n[2] * self.poisson.block.plane].chunks_mut(per_block * self.poisson.block.plane);
        rows.zip(&mut blocks).for_each(|(chunk, block)| block.rows = chunk);
        peaks.chunks_mut(per_block).zip(&mut blocks).for_each(|(chunk, block)| block.peaks = chunk);
        let blocks = &mut blocks[..shape.n[2].div_ceil(per_block)];
        let work = |(b, block): (usize, &mut Block<'_>)| {
            dispatch(self.path, Scatter { of: self, first: b * per_block, star, block });
        };
        if self.parallel {
            blocks.par_iter_mut().enumerate().for_each(work);
        } else {
            blocks.iter_mut().enumerate().for_each(work);
        }
        self.join(star[2], data, w, per_block);
    }

    /// The slowest component at the first plane of each block, whose pressure behind another block made.
    fn join(&self, star: &[f64], data: &[f64], w: &mut [f64], per_block: usize) {
        let shape = self.shape;
        let c = 1.0 / (self.strength * shape.h[2]);
        let seam = |(b, planes): (usize, &mut [f64])| {
            let k = b * per_block;
            let plane = &mut planes[..shape.plane];
            if k == 0 && shape.side[2] != Side::Periodic {
                plane.fill(0.0);
                return;
            }
            let behind = if k == 0 { shape.n[2] - 1 } else { k - 1 };
            let base = (shape.ghosts(2) + k) * shape.plane;
            for j in 0..shape.n[1] {
                let at = shape.row(j, k);
                let n = shape.n[0];
                let (q, r) =
                    (&data[self.poisson.row(j, k)..][..n], &data[self.poisson.row(j, behind)..][..n]);
                let star = &star[at..at + n];
                let start = at - base - shape.ghosts(0);
                for (i, w) in plane[at - base..][..n].iter_mut().enumerate() {
                    *w = star[i] - c * (q[i] - r[i]);
                }
                self.ghosts[2][0].fill_row(&mut plane[start..]);
            }
            self.ghosts[2][1].fill_units(plane, shape.stride[1]);
        };
        let seams = w[shape.interior()].par_chunks_mut(per_block * shape.plane).enumerate();
        if shape.stride[2] == 0 {
            return;
        }
        seams.with_min_len(if self.parallel { 1 } else { BLOCKS }).for_each(seam);
    }
}

struct Gather<'a> {
    of: &'a Projection<'a>,
    k: usize,
    u: &'a mut [f64],
    v: &'a mut [f64],
    w: &'a [f64],
    rows: &'a mut [f64],
}

impl Kernel for Gather<'_> {
    #[inline(always)]
    fn run<const W: usize, const F: bool>(self, l: Lanes<W, F>) {
        let (of, shape, k) = (self.of, self.of.shape, self.k);
        let (n, s, h) = (shape.n, shape.stride, shape.h);
        let [a, b, c] = h.map(|h| of.strength / h);
        // Places within the plane, and in the whole field.
        let local = shape.row(0, 0) - shape.ghosts(2) * shape.plane;
        let last = local + n[1] * s[1];
        if shape.walled(1) {
            self.v[local..local + n[0]].fill(0.0);
            self.v[last..last + n[0]].fill(0.0);
        } else if s[1] != 0 {
            self.v.copy_within(local..local + n[0], last);
        }
        for j in 0..n[1] {
            let at = local + j * s[1];
            let u = &mut self.u[at..=at + n[0]];
            u[0] = of.normal(0, j, k, u[0]);
            u[n[0]] = if matches!(of.ends[1], End::Periodic) { u[0] } else { of.normal(1, j, k, u[n[0]]) };
            let (u0, u1) = (&u[..n[0]], &u[1..=n[0]]);
            let (v0, v1) = (&self.v[at..at + n[0]], &self.v[at + s[1]..][..n[0]]);
            let at = shape.row(j, k);
            let (w0, w1) = (&self.w[at..at + n[0]], &self.w[at + s[2]..][..n[0]]);
            let row = &mut self.rows[j * of.poisson.block.pitch..][..n[0]];
            for i in 0..n[0] {
                let plane = l.madd(a, u1[i] - u0[i], b * (v1[i] - v0[i]));
                row[i] = l.madd(c, w1[i] - w0[i], plane);
            }
            // A held pressure beyond the end enters the right side; its other half is in the matrix.
            for (end, i) in [(0, 0), (1, n[0] - 1)] {
                if let End::Held(value) = of.ends[end] {
                    row[i] -= 2.0 * value / (h[0] * h[0]);
                }
            }
        }
        of.poisson.transform_plane(l, self.rows, Direction::Forward);
    }
}

/// The fields of one block of planes: three components, pressure, solution.
#[derive(Default)]
struct Block<'a> {
    fields: [&'a mut [f64]; 4],
    rows: &'a mut [f64],
    peaks: &'a mut [f64],
}

struct Scatter<'a, 'b> {
    of: &'a Projection<'a>,
    first: usize,
    star: [&'a [f64]; 3],
    block: &'a mut Block<'b>,
}

impl Kernel for Scatter<'_, '_> {
    #[inline(always)]
    fn run<const W: usize, const F: bool>(self, l: Lanes<W, F>) {
        let (of, shape) = (self.of, self.of.shape);
        let n = shape.n;
        let plane = of.poisson.block.plane;
        let Block { fields, rows, peaks } = self.block;
        for m in 0..peaks.len() {
            of.poisson.transform_plane(l, &mut rows[m * plane..(m + 1) * plane], Direction::Inverse);
            for j in 0..n[1] {
                correct_row(l, of, (j, self.first + m, m), self.star, fields, rows);
            }
            for (field, ghosts) in fields.iter_mut().zip(of.ghosts) {
                ghosts[1].fill_units(&mut field[m * shape.plane..(m + 1) * shape.plane], shape.stride[1]);
            }
            peaks[m] = peak(shape, fields, m);
        }
    }
}

/// Row `j` of plane `k`, which is plane `m` of its block.
#[inline(always)]
fn correct_row<const W: usize, const F: bool>(
    l: Lanes<W, F>,
    of: &Projection<'_>,
    (j, k, m): (usize, usize, usize),
    star: [&[f64]; 3],
    fields: &mut [&mut [f64]; 4],
    rows: &[f64],
) {
    let (shape, poisson) = (of.shape, of.poisson);
    let n = shape.n[0];
    let [a, b, c] = shape.h.map(|h| 1.0 / (of.strength * h));
    let row = |j: usize, m: usize| &rows[poisson.row(j, m)..][..n];
    let q = row(j, m);
    let at = shape.row(j, k);
    let out = shape.row(j, 0) - shape.ghosts(2) * shape.plane + m * shape.plane;
    let [u, v, w, p] = fields;

    let (u, s) = (&mut u[out..=out + n], &star[0][at..=at + n]);
    for i in 1..n {
        u[i] = l.madd(-a, q[i] - q[i - 1], s[i]);
    }
    let beyond = |end: usize, edge: f64| match of.ends[end] {
        End::Held(value) => 2.0 * value - edge,
        End::Periodic => q[n - 1],
        _ => edge,
    };
    u[0] = of.normal(0, j, k, l.madd(-a, q[0] - beyond(0, q[0]), s[0]));
    u[n] = match of.ends[1] {
        End::Periodic => u[0],
        _ => of.normal(1, j, k, l.madd(-a, beyond(1, q[n - 1]) - q[n - 1], s[n])),
    };

    if shape.stride[1] != 0 {
        let (v, s) = (&mut v[out..out + n], &star[1][at..at + n]);
        if j > 0 || shape.side[1] == Side::Periodic {
            let r = row(if j == 0 { shape.n[1] - 1 } else { j - 1 }, m);
            for i in 0..n {
                v[i] = l.madd(-b, q[i] - r[i], s[i]);
            }
        } else {
            v.fill(0.0);
        }
    }
    // The first plane of a block waits for its neighbour's solution.
    if m > 0 {
        let (w, s, r) = (&mut w[out..out + n], &star[2][at..at + n], row(j, m - 1));
        for i in 0..n {
            w[i] = l.madd(-c, q[i] - r[i], s[i]);
        }
    }
    let p = &mut p[out..out + n];
    if of.incremental {
        for i in 0..n {
            p[i] += q[i];
        }
    } else {
        p.copy_from_slice(q);
    }
    let start = out - shape.ghosts(0);
    for (field, ghosts) in fields.iter_mut().zip(of.ghosts) {
        ghosts[0].fill_row(&mut field[start..]);
    }
}

/// The largest `sum |v| / h` over the rows of plane `m`, not a number if any value is none, 1/s.
#[inline(always)]
fn peak(shape: &Shape, fields: &[&mut [f64]; 4], m: usize) -> f64 {
    const LANES: usize = 8;
    let mut largest = [0.0_f64; LANES];
    let mut broken = [0.0_f64; LANES];
    let [a, b, c] = shape.h.map(|h| 1.0 / h);
    let mut visit = |lane: usize, u: f64, v: f64, w: f64| {
        let x = a * u.abs() + b * v.abs() + c * w.abs();
        largest[lane] = largest[lane].max(x);
        broken[lane] += x * 0.0;
    };
    for j in 0..shape.n[1] {
        let at = shape.row(j, 0) - shape.ghosts(2) * shape.plane + m * shape.plane;
        let row = |c: usize| fields[c][at..at + shape.n[0]].as_chunks::<LANES>();
        let ((u, u_rest), (v, v_rest), (w, w_rest)) = (row(0), row(1), row(2));
        for ((u, v), w) in u.iter().zip(v).zip(w) {
            for lane in 0..LANES {
                visit(lane, u[lane], v[lane], w[lane]);
            }
        }
        for ((u, v), w) in u_rest.iter().zip(v_rest).zip(w_rest) {
            visit(0, *u, *v, *w);
        }
    }
    let total: f64 = broken.iter().sum();
    largest.iter().fold(0.0_f64, |a, b| a.max(*b)) + total
}

//! Implicit diffusion: Crank-Nicolson, factored by direction (Kim & Moin 1985).
//!
//! The prediction holds the diffusion of v_n in full; the change is then smoothed:
//!
//! ```text
//! (1 - a d²/dx²) (1 - a d²/dy²) (1 - a d²/dz²) (v* - v) = change,   a = nu dt / 2
//! ```
//!
//! The factors differ from their sum by terms of third order in dt. No viscous limit on the step.

use crate::boundary::Boundary;
use crate::lanes::{Kernel, Lanes, Path, dispatch};
use crate::parallel::Scratch;
use crate::pressure::rows::{Block, Cut, Rows, for_each_slab};
use crate::pressure::tridiagonal::{End, Lines, decay};
use crate::shape::Shape;
use crate::spec::FluidSpec;
use brazilnut_base::Side;
use rayon::prelude::*;

/// Blocks of planes that the first sweep is cut into.
const BLOCKS: usize = 32;

/// The system of one component along one level.
#[derive(Clone, Debug, Default)]
pub(crate) struct System {
    /// First unknown and their number.
    first: usize,
    count: usize,
    ends: Option<[End; 2]>,
    /// Diagonal element over `a / h²`; the right side is scaled alike.
    diagonal: f64,
    scale: f64,
    /// Factors of the elimination.
    factors: Vec<f64>,
    /// What moving walls add to the first and last right side.
    push: [f64; 2],
}

/// Systems of all components along all levels.
pub(crate) type Systems = [[System; 3]; 3];

/// Prepares the systems for the coefficient `a` (m²), walls changing their speed by what `jump` says.
pub(crate) fn prepare(
    systems: &mut Systems,
    spec: &FluidSpec,
    shape: &Shape,
    a: f64,
    jump: impl Fn(usize, usize, usize) -> f64,
) {
    for component in 0..3 {
        for level in 0..3 {
            if shape.stride[level] == 0 || shape.stride[component] == 0 {
                continue;
            }
            let system = &mut systems[component][level];
            let n = shape.n[level];
            let ratio = a / shape.h[level].powi(2);
            system.diagonal = 2.0 + 1.0 / ratio;
            system.scale = 1.0 / ratio;
            (system.first, system.count, system.push) = (0, n, [0.0; 2]);
            if shape.side[level] == Side::Periodic {
                system.ends = Some([End::Periodic; 2]);
                continue;
            }
            let sides = &spec.sides[shape.axis[level]];
            let mut ends = [End::Fixed; 2];
            for (end, side) in sides.iter().enumerate() {
                let open = matches!(side, Boundary::Outflow { .. });
                ends[end] = match side {
                    _ if component == level && open => End::Slope,
                    _ if component == level => End::Fixed,
                    Boundary::FreeSlip | Boundary::Outflow { .. } => End::Slope,
                    _ => End::Value,
                };
                if ends[end] == End::Value {
                    system.push[end] = 2.0 * ratio * jump(component, level, end);
                }
            }
            if component == level {
                system.first = usize::from(ends[0] == End::Fixed);
                system.count = n - system.first + usize::from(ends[1] == End::Slope);
            }
            system.ends = Some(ends);
            system.eliminate();
        }
    }
}

impl System {
    fn eliminate(&mut self) {
        let Some(ends) = self.ends else { return };
        self.factors.clear();
        let mut before = -ends[0].diagonal();
        for i in 0..self.count {
            let last = if i + 1 == self.count { ends[1].diagonal() } else { 0.0 };
            before = 1.0 / (self.diagonal + last - before);
            self.factors.push(before);
        }
    }

    /// Solves along rows `first..first + count` of `rows`, all their columns `0..width` at once.
    #[inline(always)]
    fn along_rows<const W: usize, const F: bool>(&self, l: Lanes<W, F>, rows: &mut Rows<'_>, width: usize) {
        let Some(ends) = self.ends else { return };
        for (end, push) in self.push.into_iter().enumerate() {
            if push != 0.0 {
                let r = if end == 0 { self.first } else { self.first + self.count - 1 };
                rows.row_mut(r)[..width].iter_mut().for_each(|x| *x += push);
            }
        }
        let mut scratch = Scratch::take(2 * width);
        let (before, sum) = scratch.as_mut().split_at_mut(width);
        if ends[0] == End::Periodic {
            self.cyclic_rows(l, rows, before, sum);
            return;
        }
        before.fill(0.0);
        for (i, &c) in self.factors.iter().enumerate() {
            let row = &mut rows.row_mut(self.first + i)[..width];
            for (x, y) in row.iter_mut().zip(&mut *before) {
                *x = c * l.madd(*x, self.scale, *y);
                *y = *x;
            }
        }
        before.fill(0.0);
        for (i, &c) in self.factors.iter().enumerate().rev() {
            let row = &mut rows.row_mut(self.first + i)[..width];
            for (x, y) in row.iter_mut().zip(&mut *before) {
                *x = l.madd(c, *y, *x);
                *y = *x;
            }
        }
    }

    /// The two one-sided recurrences of a closed line, row by row.
    #[inline(always)]
    fn cyclic_rows<const W: usize, const F: bool>(
        &self,
        l: Lanes<W, F>,
        rows: &mut Rows<'_>,
        y: &mut [f64],
        g: &mut [f64],
    ) {
        let (n, width) = (self.count, y.len());
        let r = decay(self.diagonal);
        let closing = 1.0 / (1.0 - r.powi(n as i32));
        let scale = r * self.scale;
        for (forward, factor) in [(true, 1.0), (false, scale)] {
            let at = |i: usize| if forward { i } else { n - 1 - i };
            y.fill(0.0);
            for i in 0..n {
                g.copy_from_slice(&rows.row(at(i))[..width]);
                for (y, g) in y.iter_mut().zip(&*g) {
                    *y = l.madd(r, *y, factor * g);
                }
            }
            y.iter_mut().for_each(|y| *y *= closing);
            for i in 0..n {
                for (x, y) in rows.row_mut(at(i))[..width].iter_mut().zip(&mut *y) {
                    *y = l.madd(r, *y, factor * *x);
                    *x = *y;
                }
            }
        }
    }
}

/// Smooths the change from `v` to `star` of every component.
pub(crate) fn smooth(
    path: Path,
    parallel: bool,
    shape: &Shape,
    systems: &Systems,
    v: [&[f64]; 3],
    star: [&mut [f64]; 3],
) {
    let per_block = shape.n[2].div_ceil(BLOCKS);
    for (c, star) in star.into_iter().enumerate() {
        if shape.stride[c] == 0 {
            continue;
        }
        let v = v[c];
        let in_planes = |(b, planes): (usize, &mut [f64])| {
            dispatch(path, InPlanes { shape, systems: &systems[c], v, planes, first: b * per_block });
        };
        let planes = star[shape.interior()].par_chunks_mut(per_block * shape.plane);
        planes.enumerate().with_min_len(if parallel { 1 } else { BLOCKS }).for_each(in_planes);
        let rows = if shape.stride[1] == 0 { 1 } else { shape.n[1] + 2 * shape.ghosts(1) };
        let pitch = shape.plane / rows;
        let block = Block { pitch, rows, plane: shape.plane, planes: star.len() / shape.plane };
        let cut = if rows == 1 { Cut::Columns(64) } else { Cut::Row };
        let ghosts = shape.ghosts(2);
        for_each_slab(star, block, cut, parallel, |s, slab| {
            let offset = if rows == 1 { 64 * s } else { s * pitch };
            dispatch(path, Across { system: &systems[c][2], v, plane: shape.plane, offset, ghosts, slab });
        });
    }
}

/// Levels 0 and 1 of a block of planes; leaves the change.
struct InPlanes<'a> {
    shape: &'a Shape,
    systems: &'a [System; 3],
    v: &'a [f64],
    planes: &'a mut [f64],
    first: usize,
}

impl Kernel for InPlanes<'_> {
    #[inline(always)]
    fn run<const W: usize, const F: bool>(self, l: Lanes<W, F>) {
        let (shape, planes) = (self.shape, self.planes);
        let base = (shape.ghosts(2) + self.first) * shape.plane;
        for (x, v) in planes.iter_mut().zip(&self.v[base..]) {
            *x -= v;
        }
        let system = &self.systems[0];
        let Some(ends) = system.ends else { return };
        let lines = Lines { n: system.count, ends };
        let pitch = system.count.next_multiple_of(8);
        let mut memory = Scratch::take(W * pitch + lines.scratch(W));
        let (rows, scratch) = memory.as_mut().split_at_mut(W * pitch);
        let count = shape.n[1] * (planes.len() / shape.plane);
        let at = |row: usize| {
            let (k, j) = (row / shape.n[1], row % shape.n[1]);
            shape.row(j, self.first + k) + system.first - base
        };
        for group in (0..count).step_by(W) {
            let last = (group + W).min(count);
            for (row, out) in (group..last).zip(rows.chunks_exact_mut(pitch)) {
                out[..system.count].copy_from_slice(&planes[at(row)..][..system.count]);
                out[0] += system.push[0];
                out[system.count - 1] += system.push[1];
            }
            let diagonal = [[system.diagonal; W]];
            lines.solve(l, &mut Rows::of_plane(rows, pitch), 0, diagonal, system.scale, scratch);
            for (row, out) in (group..last).zip(rows.chunks_exact_mut(pitch)) {
                planes[at(row)..][..system.count].copy_from_slice(&out[..system.count]);
            }
        }
        // The rows below borrow it again.
        drop(memory);
        if shape.stride[1] != 0 {
            for plane in planes.chunks_exact_mut(shape.plane) {
                let interior = &mut plane[shape.ghosts(1) * shape.stride[1]..];
                let pitch = shape.stride[1];
                self.systems[1].along_rows(l, &mut Rows::of_plane(interior, pitch), pitch);
            }
        }
    }
}

/// Level 2 of one slab; adds what the change was taken from.
struct Across<'a, 'b> {
    system: &'a System,
    v: &'a [f64],
    plane: usize,
    offset: usize,
    ghosts: usize,
    slab: &'a mut Rows<'b>,
}

impl Kernel for Across<'_, '_> {
    #[inline(always)]
    fn run<const W: usize, const F: bool>(self, l: Lanes<W, F>) {
        let width = self.slab.width();
        let mut rows = self.slab.after(self.ghosts);
        self.system.along_rows(l, &mut rows, width);
        let system = self.system;
        for r in 0..system.first + system.count {
            let v = &self.v[self.offset + (r + self.ghosts) * self.plane..][..width];
            for (x, v) in rows.row_mut(r).iter_mut().zip(v) {
                *x += v;
            }
        }
    }
}

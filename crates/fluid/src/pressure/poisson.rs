//! The Poisson equation in a box, solved to rounding: transforms along two
//! directions, a tridiagonal system along the third.
//!
//! ```text
//! laplacian p = f, second differences, no slope at walls
//! ```
//!
//! Three sweeps over memory: planes forward, slabs (transform, tridiagonal,
//! transform back), planes back; the first and the last can be joined to what
//! a step does with the planes before and after.

use super::library::{LibraryTransform, PANEL};
use super::rows::{Block, Cut, Rows, for_each_slab};
use super::transform::{Family, Transform, eigenvalue};
use super::tridiagonal::{End, Lines, remove_mean, solve_closed_singular};
use crate::grid::{Grid, largest_prime};
use crate::lanes::{Kernel, Lanes, Path, dispatch};
use crate::parallel::{Scratch, WORTH_THREADS};
use crate::spec::Instructions;
use brazilnut_base::Side;

/// Which transforms to use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Transforms {
    /// Batched where the length has small factors, the library's otherwise.
    Best,
    /// The library's for all lengths.
    Library,
}

/// One direction's transform.
#[derive(Clone, Debug)]
enum Plan {
    /// A single point.
    None,
    Batched(Transform),
    Library(LibraryTransform),
}

/// A direct solver for one grid.
#[derive(Clone, Debug)]
pub struct Poisson {
    /// Cells from contiguous to slowest direction.
    pub(crate) cells: [usize; 3],
    pub(crate) block: Block,
    path: Path,
    pub(crate) parallel: bool,
    plans: [Plan; 2],
    /// Eigenvalues of both transformed directions times the square of the line's spacing.
    eigenvalues: [Vec<f64>; 2],
    lines: Lines,
    scale: f64,
    singular: bool,
}

impl Poisson {
    /// The solver for `grid`, with `open` ends of the line axis held at zero
    /// half a cell beyond the last centre.
    #[must_use]
    pub fn new(grid: &Grid, open: [bool; 2], instructions: Instructions, transforms: Transforms) -> Self {
        let order = grid.memory_order();
        let cells = order.map(|a| grid.cells[a]);
        let side = order.map(|a| grid.sides[a]);
        let h = order.map(|a| grid.spacing[a]);
        let family =
            |level: usize| if side[level] == Side::Periodic { Family::Fourier } else { Family::Cosine };
        let plans = [1, 2].map(|level| {
            let n = cells[level];
            if n == 1 {
                Plan::None
            } else if transforms == Transforms::Library || largest_prime(n) > super::fft::LARGEST_FACTOR {
                Plan::Library(LibraryTransform::new(family(level), n))
            } else {
                Plan::Batched(Transform::new(family(level), n))
            }
        });
        let pitch = 8 * (cells[0].div_ceil(8) | 1);
        let plane = 8 * ((pitch / 8 * cells[1]) | 1);
        // Groups of lines along the slowest direction are always whole.
        let planes = if cells[2] == 1 { 8 } else { cells[2].next_multiple_of(8) };
        let block = Block { pitch, rows: cells[1], plane, planes };
        let eigenvalues = [1, 2].map(|level| {
            let n = cells[level];
            let factor = (h[0] / h[level]).powi(2);
            let len = if level == 2 { planes } else { n };
            (0..len).map(|k| factor * eigenvalue(family(level), k.min(n - 1), n)).collect()
        });
        let end = |e: usize| match (side[0], open[e]) {
            (Side::Periodic, _) => End::Periodic,
            (_, true) => End::Value,
            _ => End::Slope,
        };
        let lines = Lines { n: cells[0], ends: [end(0), end(1)] };
        Self {
            cells,
            block,
            path: Path::choose(instructions),
            parallel: grid.count() >= WORTH_THREADS,
            plans,
            eigenvalues,
            lines,
            scale: -h[0] * h[0] / (cells[1] * cells[2]) as f64,
            singular: !lines.ends.contains(&End::Value),
        }
    }

    /// Numbers in the block that [`Self::solve`] works on.
    #[must_use]
    pub fn len(&self) -> usize {
        self.block.plane * self.block.planes
    }

    /// Never.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        false
    }

    /// Place of row (j, k) in the block, in memory order of the grid.
    #[inline]
    #[must_use]
    pub fn row(&self, j: usize, k: usize) -> usize {
        k * self.block.plane + j * self.block.pitch
    }

    /// True if a constant may be added to the solution; it then has no mean.
    #[must_use]
    pub fn is_singular(&self) -> bool {
        self.singular
    }

    /// Replaces the right side in `data` by the solution.
    pub fn solve(&self, data: &mut [f64]) {
        let n = self.cells[2];
        self.each_plane(&mut data[..n * self.block.plane], Direction::Forward);
        self.middle(data);
        self.each_plane(&mut data[..n * self.block.plane], Direction::Inverse);
    }

    fn each_plane(&self, data: &mut [f64], direction: Direction) {
        use rayon::prelude::*;
        let work = |plane: &mut [f64]| dispatch(self.path, PlaneKernel { poisson: self, plane, direction });
        if self.parallel {
            data.par_chunks_mut(self.block.plane).for_each(work);
        } else {
            data.chunks_mut(self.block.plane).for_each(work);
        }
    }

    /// From planes transformed forward to planes to be transformed back.
    pub(crate) fn middle(&self, data: &mut [f64]) {
        let slab = |cut, parallel, data: &mut [f64], what| {
            for_each_slab(data, self.block, cut, parallel, |s, slab| {
                dispatch(self.path, SlabKernel { poisson: self, s, slab, what });
            });
        };
        if self.block.rows > 1 {
            slab(Cut::Row, self.parallel, data, Part::All);
        } else {
            slab(Cut::Columns(PANEL), self.parallel, data, Part::Transform(Direction::Forward));
            slab(Cut::Planes(8), self.parallel, data, Part::Lines);
            slab(Cut::Columns(PANEL), self.parallel, data, Part::Transform(Direction::Inverse));
        }
    }

    /// Columns of a row that carry something, filled up to whole vectors.
    fn width(&self) -> usize {
        self.cells[0].next_multiple_of(8)
    }

    /// The first `width` columns of `rows`, along the direction of plan `level`.
    #[inline(always)]
    fn transform<const W: usize, const F: bool>(
        &self,
        l: Lanes<W, F>,
        level: usize,
        rows: &mut Rows<'_>,
        width: usize,
        direction: Direction,
    ) {
        match &self.plans[level] {
            Plan::None => {}
            Plan::Batched(t) => t.run(l.path(), rows, width, direction),
            Plan::Library(t) => {
                for column in (0..width).step_by(PANEL) {
                    let width = PANEL.min(width - column);
                    match direction {
                        Direction::Forward => t.forward(rows, column, width),
                        Direction::Inverse => t.inverse(rows, column, width),
                    }
                }
            }
        }
    }

    /// One plane, along its rows' direction.
    #[inline(always)]
    pub(crate) fn transform_plane<const W: usize, const F: bool>(
        &self,
        l: Lanes<W, F>,
        plane: &mut [f64],
        direction: Direction,
    ) {
        let pitch = self.block.pitch;
        if direction == Direction::Forward {
            // The padding shares transforms with the last columns: what it holds reaches them as rounding.
            for row in plane.chunks_exact_mut(pitch) {
                row[self.cells[0]..self.width()].fill(0.0);
            }
        }
        self.transform(l, 0, &mut Rows::of_plane(plane, pitch), self.width(), direction);
    }

    /// The lines `first..first + G W` of a slab whose row of each plane is `j`.
    #[inline(always)]
    fn solve_lines<const G: usize, const W: usize, const F: bool>(
        &self,
        l: Lanes<W, F>,
        slab: &mut Rows<'_>,
        (j, k): (usize, usize),
        first: usize,
        scratch: &mut [f64],
    ) {
        let mut diagonal = [[0.0; W]; G];
        for (line, d) in diagonal.as_flattened_mut().iter_mut().enumerate() {
            *d = 2.0 - self.eigenvalues[0][j] - self.eigenvalues[1][k + line];
        }
        let n = self.cells[0];
        if !(self.singular && j == 0 && k == 0) {
            self.lines.solve(l, slab, first, diagonal, self.scale, scratch);
            return;
        }
        let (line, scratch) = scratch.split_at_mut(n.next_multiple_of(8));
        let line = &mut line[..n];
        line.copy_from_slice(&slab.row(first)[..n]);
        self.lines.solve(l, slab, first, diagonal, self.scale, scratch);
        let row = &mut slab.row_mut(first)[..n];
        if self.lines.ends[0] == End::Periodic {
            solve_closed_singular(line);
            for (x, g) in row.iter_mut().zip(line) {
                *x = *g * self.scale;
            }
        } else {
            remove_mean(row);
        }
    }
}

/// Which way a transform goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Direction {
    Forward,
    Inverse,
}

/// What to do with a slab.
#[derive(Clone, Copy, Debug)]
enum Part {
    All,
    Transform(Direction),
    Lines,
}

struct PlaneKernel<'a> {
    poisson: &'a Poisson,
    plane: &'a mut [f64],
    direction: Direction,
}

impl Kernel for PlaneKernel<'_> {
    #[inline(always)]
    fn run<const W: usize, const F: bool>(self, l: Lanes<W, F>) {
        self.poisson.transform_plane(l, self.plane, self.direction);
    }
}

struct SlabKernel<'a, 'b> {
    poisson: &'a Poisson,
    s: usize,
    slab: &'a mut Rows<'b>,
    what: Part,
}

impl Kernel for SlabKernel<'_, '_> {
    #[inline(always)]
    fn run<const W: usize, const F: bool>(self, l: Lanes<W, F>) {
        let p = self.poisson;
        let width = self.slab.width().min(p.width());
        if let Part::All | Part::Transform(Direction::Forward) = self.what {
            p.transform(l, 1, self.slab, width, Direction::Forward);
        }
        if let Part::All | Part::Lines = self.what {
            let (j, k0) = if p.block.rows > 1 { (self.s, 0) } else { (0, 8 * self.s) };
            let mut scratch = Scratch::take(p.lines.scratch(2 * W) + p.cells[0].next_multiple_of(8));
            let (scratch, count) = (scratch.as_mut(), self.slab.count());
            for first in (0..count).step_by(2 * W) {
                let at = (j, k0 + first);
                if first + 2 * W <= count {
                    p.solve_lines::<2, W, F>(l, self.slab, at, first, scratch);
                } else {
                    p.solve_lines::<1, W, F>(l, self.slab, at, first, scratch);
                }
            }
        }
        if let Part::All | Part::Transform(Direction::Inverse) = self.what {
            p.transform(l, 1, self.slab, width, Direction::Inverse);
        }
    }
}

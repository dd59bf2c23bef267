//! The grid seen along memory: level 0 is contiguous, level 2 the slowest.

use crate::grid::{GHOSTS, Grid};
use brazilnut_base::Side;
use std::ops::Range;

/// Sizes and strides by level.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shape {
    /// Axis (0 x, 1 y, 2 z) of each level.
    pub axis: [usize; 3],
    /// Cells.
    pub n: [usize; 3],
    /// Distance in memory between neighbours, zero if flat.
    pub stride: [usize; 3],
    /// Cell edges, m.
    pub h: [f64; 3],
    /// What bounds each level.
    pub side: [Side; 3],
    /// Place of cell (0, 0, 0).
    pub origin: usize,
    /// Numbers in a plane, ghosts included.
    pub plane: usize,
}

impl Shape {
    pub fn new(grid: &Grid) -> Self {
        let axis = grid.memory_order();
        let layout = grid.layout();
        let stride = axis.map(|a| layout.stride[a]);
        let plane = if stride[2] == 0 { layout.len } else { stride[2] };
        Self {
            axis,
            n: axis.map(|a| grid.cells[a]),
            stride,
            h: axis.map(|a| grid.spacing[a]),
            side: axis.map(|a| grid.sides[a]),
            origin: layout.origin,
            plane,
        }
    }

    /// Ghost layers of a level.
    pub fn ghosts(&self, level: usize) -> usize {
        if self.side[level] == Side::Flat { 0 } else { GHOSTS }
    }

    /// Place of cell 0 of row (j, k).
    #[inline(always)]
    pub fn row(&self, j: usize, k: usize) -> usize {
        self.origin + j * self.stride[1] + k * self.stride[2]
    }

    /// The numbers of planes `0..n` of the slowest level, ghost planes left out.
    pub fn interior(&self) -> Range<usize> {
        let start = self.ghosts(2) * self.plane;
        start..start + self.n[2] * self.plane
    }

    /// True if the fluid is bounded by walls or openings along `level`.
    pub fn walled(&self, level: usize) -> bool {
        self.side[level] == Side::Walls
    }
}

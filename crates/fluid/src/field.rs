//! Fields on the staggered grid. Where a value sits is part of its type.

use crate::grid::{Grid, Layout};
use serde::{Deserialize, Serialize};

/// One value at the centre of each cell.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CellField {
    /// How the values lie.
    pub layout: Layout,
    /// The values, ghosts and padding included.
    pub values: Vec<f64>,
}

/// One value at the centre of each face normal to `AXIS` (0 x, 1 y, 2 z).
///
/// Index (i, j, k) is the lower face, along `AXIS`, of cell (i, j, k).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FaceField<const AXIS: usize> {
    /// How the values lie.
    pub layout: Layout,
    /// The values, ghosts and padding included.
    pub values: Vec<f64>,
}

/// A vector on the staggered grid: each component on the faces normal to it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Faces {
    /// x component.
    pub x: FaceField<0>,
    /// y component.
    pub y: FaceField<1>,
    /// z component.
    pub z: FaceField<2>,
}

macro_rules! accessors {
    () => {
        /// A field of zeros on `grid`.
        #[must_use]
        pub fn new(grid: &Grid) -> Self {
            let layout = grid.layout();
            Self { layout, values: vec![0.0; layout.len] }
        }

        /// The value at (i, j, k); ghosts reach two layers beyond the ends.
        #[inline]
        #[must_use]
        pub fn at(&self, i: isize, j: isize, k: isize) -> f64 {
            self.values[self.layout.index(i, j, k)]
        }

        /// The value at (i, j, k), to be changed.
        #[inline]
        #[must_use]
        pub fn at_mut(&mut self, i: isize, j: isize, k: isize) -> &mut f64 {
            &mut self.values[self.layout.index(i, j, k)]
        }
    };
}

impl CellField {
    accessors!();

    /// Sets each interior value from its (i, j, k).
    pub fn fill_with(&mut self, grid: &Grid, mut value: impl FnMut(isize, isize, isize) -> f64) {
        let [a, b, c] = grid.cell_range();
        for k in c {
            for j in b.clone() {
                for i in a.clone() {
                    *self.at_mut(i, j, k) = value(i, j, k);
                }
            }
        }
    }
}

impl<const AXIS: usize> FaceField<AXIS> {
    accessors!();

    /// Sets each value of [`Grid::face_range`] from its (i, j, k).
    pub fn fill_with(&mut self, grid: &Grid, mut value: impl FnMut(isize, isize, isize) -> f64) {
        let [a, b, c] = grid.face_range(AXIS);
        for k in c {
            for j in b.clone() {
                for i in a.clone() {
                    *self.at_mut(i, j, k) = value(i, j, k);
                }
            }
        }
    }
}

impl Faces {
    /// A field of zeros on `grid`.
    #[must_use]
    pub fn new(grid: &Grid) -> Self {
        Self { x: FaceField::new(grid), y: FaceField::new(grid), z: FaceField::new(grid) }
    }

    /// The values of one component.
    #[inline]
    #[must_use]
    pub fn component(&self, axis: usize) -> &[f64] {
        match axis {
            0 => &self.x.values,
            1 => &self.y.values,
            _ => &self.z.values,
        }
    }

    /// The values of one component, to be changed.
    #[inline]
    #[must_use]
    pub fn component_mut(&mut self, axis: usize) -> &mut [f64] {
        match axis {
            0 => &mut self.x.values,
            1 => &mut self.y.values,
            _ => &mut self.z.values,
        }
    }

    /// All components, the one normal to `order[0]` first.
    #[must_use]
    pub(crate) fn in_order(&self, order: [usize; 3]) -> [&[f64]; 3] {
        order.map(|axis| self.component(axis))
    }

    /// All components to be changed, the one normal to `order[0]` first.
    #[must_use]
    pub(crate) fn in_order_mut(&mut self, order: [usize; 3]) -> [&mut [f64]; 3] {
        let (x, y, z) = (&mut self.x.values[..], &mut self.y.values[..], &mut self.z.values[..]);
        match order {
            [0, 1, 2] => [x, y, z],
            [0, 2, 1] => [x, z, y],
            [1, 0, 2] => [y, x, z],
            [1, 2, 0] => [y, z, x],
            [2, 0, 1] => [z, x, y],
            _ => [z, y, x],
        }
    }

    /// The shared layout.
    #[must_use]
    pub fn layout(&self) -> Layout {
        self.x.layout
    }

    /// Sets every value, ghosts included.
    pub fn set_all(&mut self, value: f64) {
        for axis in 0..3 {
            self.component_mut(axis).fill(value);
        }
    }
}

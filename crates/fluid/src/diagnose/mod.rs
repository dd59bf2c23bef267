//! What can be read off a flow.

mod energy;
mod plane;
mod point;

pub use energy::{Budget, budget, kinetic_energy};
pub use plane::{streamfunction, vorticity};
pub use point::{pressure_at, velocity_at};

use crate::field::Faces;
use crate::flow::Flow;
use crate::grid::Grid;
use brazilnut_base::Side;

/// Largest `|div v|` over the cells, 1/s (Clément eq. 2.30).
#[must_use]
pub fn divergence(grid: &Grid, velocity: &Faces) -> f64 {
    let mut worst = 0.0_f64;
    each(grid.cell_range(), |i, j, k| {
        let at = grid.layout().index(i, j, k);
        let sum: f64 = (0..3).map(|a| slope(grid, velocity, a, at)).sum();
        worst = worst.max(sum.abs());
    });
    worst
}

/// Difference of component `axis` across a cell over its edge, 1/s.
fn slope(grid: &Grid, velocity: &Faces, axis: usize, at: usize) -> f64 {
    let v = velocity.component(axis);
    (v[at + grid.layout().stride[axis]] - v[at]) / grid.spacing[axis]
}

/// Largest Courant number `dt sum |v_i| / h_i` over the cells, at their lower faces.
#[must_use]
pub fn courant(grid: &Grid, flow: &Flow, dt: f64) -> f64 {
    let mut worst = 0.0_f64;
    each(grid.cell_range(), |i, j, k| {
        let at = grid.layout().index(i, j, k);
        let sum: f64 = (0..3).map(|a| flow.velocity.component(a)[at].abs() / grid.spacing[a]).sum();
        worst = worst.max(dt * sum);
    });
    worst
}

/// Volume per time through the faces normal to `axis` at plane `plane`, m³/s.
#[must_use]
pub fn flux(grid: &Grid, velocity: &Faces, axis: usize, plane: usize) -> f64 {
    let mut range = grid.cell_range();
    range[axis] = plane as isize..plane as isize + 1;
    flux_through(grid, velocity, axis, range)
}

/// Volume per time through the faces normal to `axis` with indices in `range`, m³/s.
#[must_use]
pub fn flux_through(grid: &Grid, velocity: &Faces, axis: usize, range: [std::ops::Range<isize>; 3]) -> f64 {
    let mut sum = 0.0;
    each(range, |i, j, k| sum += velocity.component(axis)[grid.layout().index(i, j, k)]);
    sum * grid.face_area(axis)
}

/// Momentum of the fluid, kg m/s: each face carries half a cell on either side.
#[must_use]
pub fn momentum(grid: &Grid, velocity: &Faces, density: f64) -> [f64; 3] {
    [0, 1, 2].map(|axis| {
        let mut sum = 0.0;
        each(grid.face_range(axis), |i, j, k| {
            sum += share(grid, axis, [i, j, k]) * velocity.component(axis)[grid.layout().index(i, j, k)];
        });
        density * grid.cell_volume() * sum
    })
}

/// Part of a cell volume that a face carries: half at a side of the box.
fn share(grid: &Grid, axis: usize, c: [isize; 3]) -> f64 {
    let end = grid.sides[axis] == Side::Walls && (c[axis] == 0 || c[axis] == grid.cells[axis] as isize);
    if end { 0.5 } else { 1.0 }
}

/// Visits all (i, j, k) of `range`.
fn each(range: [std::ops::Range<isize>; 3], mut visit: impl FnMut(isize, isize, isize)) {
    let [x, y, z] = range;
    for k in z {
        for j in y.clone() {
            for i in x.clone() {
                visit(i, j, k);
            }
        }
    }
}

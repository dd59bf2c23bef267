//! Streamfunction and vorticity on the corners of the cells of a plane.

use crate::field::Faces;
use crate::grid::Grid;
use brazilnut_base::{PlaneField, Side};

/// The empty field of the corners in the layer `layer` of the direction that is not in `axes`.
fn corners(grid: &Grid, axes: [usize; 2], layer: usize) -> (PlaneField, impl Fn(usize, usize) -> usize) {
    let [a, b] = axes;
    let normal = 3 - a - b;
    let shape = [grid.cells[a] + 1, grid.cells[b] + 1];
    let values = vec![0.0; shape[0] * shape[1]];
    let layout = grid.layout();
    let place = move |i: usize, j: usize| {
        let mut c = [0_isize; 3];
        (c[a], c[b], c[normal]) = (i as isize, j as isize, layer as isize);
        layout.index(c[0], c[1], c[2])
    };
    (PlaneField { axes, shape, spacing: [grid.spacing[a], grid.spacing[b]], values }, place)
}

/// Streamfunction of the flow in the plane of `axes` = (a, b), m²/s, zero at the first corner:
/// `d psi = -v_b da + v_a db` (Clément eq. 2.39).
///
/// Exact volume fluxes between corners where the flow is two-dimensional.
#[must_use]
pub fn streamfunction(grid: &Grid, velocity: &Faces, axes: [usize; 2], layer: usize) -> PlaneField {
    let (mut psi, place) = corners(grid, axes, layer);
    let (u, v) = (velocity.component(axes[0]), velocity.component(axes[1]));
    let [m, n] = psi.shape;
    let [h, l] = psi.spacing;
    for i in 1..m {
        psi.values[i] = psi.values[i - 1] - v[place(i - 1, 0)] * h;
    }
    for j in 1..n {
        for i in 0..m {
            psi.values[i + j * m] = psi.values[i + (j - 1) * m] + u[place(i, j - 1)] * l;
        }
    }
    psi
}

/// Vorticity normal to the plane of `axes` = (a, b), `dv_b/da - dv_a/db`, 1/s; needs ghosts.
#[must_use]
pub fn vorticity(grid: &Grid, velocity: &Faces, axes: [usize; 2], layer: usize) -> PlaneField {
    let (mut omega, place) = corners(grid, axes, layer);
    let (u, v) = (velocity.component(axes[0]), velocity.component(axes[1]));
    let stride = axes.map(|a| if grid.sides[a] == Side::Flat { 0 } else { grid.layout().stride[a] });
    let [m, n] = omega.shape;
    let [h, l] = omega.spacing;
    for j in 0..n {
        for i in 0..m {
            let at = place(i, j);
            omega.values[i + j * m] = (v[at] - v[at - stride[0]]) / h - (u[at] - u[at - stride[1]]) / l;
        }
    }
    omega
}

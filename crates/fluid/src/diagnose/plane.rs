//! Streamfunction and vorticity on the corners of the cells of a plane.

use crate::field::Faces;
use crate::grid::Grid;
use brazilnut_base::Side;

/// Numbers on the corners of the cells of one plane, walls included.
#[derive(Clone, Debug, PartialEq)]
pub struct Sheet {
    /// Axes of columns and rows.
    pub axes: [usize; 2],
    /// Corners along them.
    pub shape: [usize; 2],
    /// Distance between corners, m.
    pub spacing: [f64; 2],
    /// Row by row.
    pub values: Vec<f64>,
}

impl Sheet {
    /// The value at column `i` and row `j`.
    #[must_use]
    pub fn at(&self, i: usize, j: usize) -> f64 {
        self.values[i + j * self.shape[0]]
    }
}

/// A sheet filled corner by corner in the layer `layer` of the direction that is not in `axes`.
fn sheet(grid: &Grid, axes: [usize; 2], layer: usize) -> (Sheet, impl Fn(usize, usize) -> usize) {
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
    (Sheet { axes, shape, spacing: [grid.spacing[a], grid.spacing[b]], values }, place)
}

/// Streamfunction of the flow in the plane of `axes` = (a, b), m²/s, zero at the first corner:
/// `d psi = -v_b da + v_a db` (Clément eq. 2.39).
///
/// Exact volume fluxes between corners where the flow is two-dimensional.
#[must_use]
pub fn streamfunction(grid: &Grid, velocity: &Faces, axes: [usize; 2], layer: usize) -> Sheet {
    let (mut psi, place) = sheet(grid, axes, layer);
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
pub fn vorticity(grid: &Grid, velocity: &Faces, axes: [usize; 2], layer: usize) -> Sheet {
    let (mut omega, place) = sheet(grid, axes, layer);
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

/// The largest (`sign` 1) or smallest (-1) interior value and its place along both
/// axes (m), from a parabola through the extreme corner and its neighbours.
#[must_use]
pub fn extremum(sheet: &Sheet, sign: f64) -> (f64, [f64; 2]) {
    let [m, n] = sheet.shape;
    let mut best = (1, 1);
    for j in 1..n - 1 {
        for i in 1..m - 1 {
            if sign * sheet.at(i, j) > sign * sheet.at(best.0, best.1) {
                best = (i, j);
            }
        }
    }
    let (i, j) = best;
    let here = sheet.at(i, j);
    let parabola = |behind: f64, ahead: f64| {
        let (slope, curve) = (0.5 * (ahead - behind), ahead - 2.0 * here + behind);
        if curve == 0.0 { (0.0, 0.0) } else { (-slope / curve, -0.5 * slope * slope / curve) }
    };
    let (x, rise) = parabola(sheet.at(i - 1, j), sheet.at(i + 1, j));
    let (y, more) = parabola(sheet.at(i, j - 1), sheet.at(i, j + 1));
    (here + rise + more, [(i as f64 + x) * sheet.spacing[0], (j as f64 + y) * sheet.spacing[1]])
}

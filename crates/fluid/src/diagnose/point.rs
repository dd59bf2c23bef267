//! Values between grid points, trilinear.

use crate::field::Faces;
use crate::flow::Flow;
use crate::grid::{Grid, Layout};
use brazilnut_base::{Side, Vec3, vec3};

/// Velocity at `r` (m), m/s.
#[must_use]
pub fn velocity_at(grid: &Grid, velocity: &Faces, r: Vec3) -> Vec3 {
    let [x, y, z] = [0, 1, 2].map(|axis| {
        let mut offset = [0.5; 3];
        offset[axis] = 0.0;
        between(grid, velocity.component(axis), grid.layout(), r, offset)
    });
    vec3(x, y, z)
}

/// Reduced pressure at `r` (m), Pa.
#[must_use]
pub fn pressure_at(grid: &Grid, flow: &Flow, r: Vec3) -> f64 {
    between(grid, &flow.pressure.values, grid.layout(), r, [0.5; 3])
}

/// The value at `r` of a field whose point (0, 0, 0) stands at `offset` cells.
fn between(grid: &Grid, values: &[f64], layout: Layout, r: Vec3, offset: [f64; 3]) -> f64 {
    let (mut low, mut part) = ([0_isize; 3], [0.0; 3]);
    for axis in 0..3 {
        if grid.sides[axis] == Side::Flat {
            continue;
        }
        let mut x = r[axis] / grid.spacing[axis];
        if grid.sides[axis] == Side::Periodic {
            x = x.rem_euclid(grid.cells[axis] as f64);
        }
        let x = (x - offset[axis]).clamp(-1.0, grid.cells[axis] as f64);
        low[axis] = (x.floor() as isize).min(grid.cells[axis] as isize - 1);
        part[axis] = x - low[axis] as f64;
    }
    let mut sum = 0.0;
    for corner in 0..8_usize {
        let up = [corner & 1, corner >> 1 & 1, corner >> 2 & 1];
        let weight: f64 = (0..3).map(|a| if up[a] == 1 { part[a] } else { 1.0 - part[a] }).product();
        if weight != 0.0 {
            let [i, j, k] = [0, 1, 2].map(|a| low[a] + up[a] as isize);
            sum += weight * values[layout.index(i, j, k)];
        }
    }
    sum
}

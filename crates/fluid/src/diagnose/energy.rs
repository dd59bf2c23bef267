//! Kinetic energy and where it goes.

use super::{each, share};
use crate::boundary::Boundary;
use crate::flow::Flow;
use crate::solver::Solver;
use brazilnut_base::{Side, Vec3};

/// Kinetic energy and its rates of change.
///
/// `dE/dt = body + walls - dissipation` for closed and periodic boxes, exactly
/// in space for the central advection.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Budget {
    /// rho v² / 2 over the volume, J.
    pub kinetic: f64,
    /// rho nu (grad v)² over the volume, W.
    pub dissipation: f64,
    /// Work of the uniform acceleration, W.
    pub body: f64,
    /// Work of moving walls, W.
    pub walls: f64,
}

/// Kinetic energy, J.
#[must_use]
pub fn kinetic_energy(solver: &Solver, flow: &Flow) -> f64 {
    let (grid, layout) = (solver.grid(), solver.grid().layout());
    let mut sum = 0.0;
    for axis in 0..3 {
        let v = flow.velocity.component(axis);
        each(grid.face_range(axis), |i, j, k| {
            sum += share(grid, axis, [i, j, k]) * v[layout.index(i, j, k)].powi(2);
        });
    }
    0.5 * solver.spec().density * grid.cell_volume() * sum
}

/// The budget of `flow` under the uniform acceleration `body` (m/s²), its ghosts up to date.
#[must_use]
pub fn budget(solver: &Solver, flow: &Flow, body: Vec3) -> Budget {
    let (spec, grid, layout) = (solver.spec(), solver.grid(), solver.grid().layout());
    let mut budget = Budget { kinetic: kinetic_energy(solver, flow), ..Budget::default() };
    let viscous = spec.viscosity * grid.cell_volume();
    for axis in (0..3).filter(|&a| grid.sides[a] != Side::Flat) {
        let v = flow.velocity.component(axis);
        for d in (0..3).filter(|&d| grid.sides[d] != Side::Flat) {
            let (s, h, n) = (layout.stride[d], grid.spacing[d], grid.cells[d] as isize);
            each(grid.face_range(axis), |i, j, k| {
                let (at, c) = (layout.index(i, j, k), [i, j, k][d]);
                // The link to the neighbour behind; those ahead are its neighbours' links.
                let behind = (v[at] - v[at - s]) / h;
                let first = c == 0 && grid.sides[d] == Side::Walls;
                if first && d == axis {
                    return;
                }
                if first {
                    wall(&mut budget, spec.side(d, 0), viscous, h, v[at], v[at - s]);
                } else {
                    budget.dissipation += viscous * behind * behind;
                }
                if d != axis && c + 1 == n && grid.sides[d] == Side::Walls {
                    wall(&mut budget, spec.side(d, 1), viscous, h, v[at], v[at + s]);
                }
            });
        }
        if grid.sides[axis] == Side::Periodic {
            let mut sum = 0.0;
            each(grid.face_range(axis), |i, j, k| sum += v[layout.index(i, j, k)]);
            budget.body += spec.density * grid.cell_volume() * body[axis] * sum;
        }
    }
    budget
}

/// The half link from a value to a wall, across which the ghost mirrors it.
fn wall(budget: &mut Budget, side: Option<&Boundary>, viscous: f64, h: f64, here: f64, ghost: f64) {
    if matches!(side, Some(Boundary::NoSlip | Boundary::MovingLid { .. } | Boundary::Inflow { .. })) {
        let speed = 0.5 * (here + ghost);
        budget.dissipation += 2.0 * viscous * ((here - speed) / h).powi(2);
        budget.walls += 2.0 * viscous * (speed - here) * speed / (h * h);
    }
}

//! Is the flow still one that the equations describe?

use crate::flow::Flow;
use crate::solver::Solver;
use brazilnut_base::{Blowup, Tick};

impl Solver {
    /// Checks that all velocities are finite and that the Courant number
    /// `dt sum |v_i| / h_i` stays within the limit.
    ///
    /// # Errors
    /// The step, the quantity and the cell where it broke.
    pub fn health(&self, flow: &Flow, tick: Tick) -> Result<(), Blowup> {
        let limit = self.spec.courant_limit;
        if let Some(c) = self.convergence().filter(|c| !c.converged) {
            return Err(Blowup {
                tick,
                quantity: format!(
                    "pressure residual {:.3e} Pa/m² after {} iterations",
                    c.residual, c.iterations
                ),
                place: "fluid".into(),
                remedy: "look for a porosity near zero or a cell cut off by solids that something flows into"
                    .into(),
            });
        }
        // The step itself watched its result; only a suspicion is worth a search.
        let peak = self
            .peaks
            .iter()
            .fold(0.0_f64, |a, &b| if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) });
        let dt = tick.dt / self.substeps(flow, tick.dt) as f64;
        if self.watched && dt * peak <= 0.9 * limit {
            return Ok(());
        }
        let Some((cell, courant)) = self.worst_cell(flow, dt) else { return Ok(()) };
        let place = format!("fluid cell ({}, {}, {})", cell[0], cell[1], cell[2]);
        if !courant.is_finite() {
            return Err(Blowup {
                tick,
                quantity: "fluid velocity is not finite".into(),
                place,
                remedy: "take a smaller step, a finer grid or the koren advection".into(),
            });
        }
        if courant > limit {
            return Err(Blowup {
                tick,
                quantity: format!("Courant number {courant:.3} (limit {limit})"),
                place,
                remedy: format!("take steps of {:.3e} s or less", 0.5 * dt * limit / courant),
            });
        }
        Ok(())
    }

    /// The cell of the largest Courant number, or the first that is not finite.
    fn worst_cell(&self, flow: &Flow, dt: f64) -> Option<([isize; 3], f64)> {
        let grid = &self.spec.grid;
        let layout = grid.layout();
        let mut worst: Option<([isize; 3], f64)> = None;
        let [x, y, z] = grid.cell_range();
        for k in z {
            for j in y.clone() {
                for i in x.clone() {
                    let at = layout.index(i, j, k);
                    let sum: f64 =
                        (0..3).map(|a| flow.velocity.component(a)[at].abs() / grid.spacing[a]).sum();
                    let courant = dt * sum;
                    if !courant.is_finite() {
                        return Some(([i, j, k], courant));
                    }
                    if worst.is_none_or(|(_, c)| courant > c) {
                        worst = Some(([i, j, k], courant));
                    }
                }
            }
        }
        worst
    }
}

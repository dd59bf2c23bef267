//! The step around obstacles and through a medium: what the direct solver
//! alone cannot do.
//!
//! ```text
//! v = v* - dt m / rho grad q,   m = 1 / (1 + dt beta)
//! div(phi m grad q) = rho / dt div(phi v* + (1 - phi) u)
//! ```
//!
//! The second line follows from the first and `div(phi v + (1 - phi) u) = 0`
//! (Clément eq. 2.63, 2.65) by exact elimination; Clément's eq. 2.66 lacks the
//! part of it that comes from the slope of phi. Resistance is implicit through m.

use crate::field::{CellField, Faces};
use crate::ghosts::{self, Layers};
use crate::medium::{Medium, Resistance};
use crate::obstacles::{Link, links, open_faces};
use crate::pressure::Poisson;
use crate::pressure::conjugate_gradient::{ConjugateGradient, Convergence, Operator};
use crate::shape::Shape;
use crate::spec::FluidSpec;
use brazilnut_base::Side;

/// Largest divergence that the iteration leaves, in units of max |v| / h.
const TOLERANCE: f64 = 1e-11;

/// Coefficients and work space.
#[derive(Debug)]
pub(crate) struct General {
    /// 1 where the fluid passes.
    pub open: Faces,
    /// Neighbours behind surfaces.
    pub links: Vec<Link>,
    /// m, 0 where the fluid does not pass.
    pub mobility: Faces,
    /// phi m / h².
    kappa: Faces,
    iteration: ConjugateGradient,
    /// q with ghosts.
    pub increment: CellField,
    /// Ghosts of a change of pressure.
    pub change: [Layers; 3],
    /// How the last solve ended.
    pub convergence: Convergence,
}

impl General {
    pub fn new(spec: &FluidSpec, shape: &Shape, poisson: &Poisson) -> Self {
        let open = open_faces(spec);
        Self {
            links: links(spec, shape, &open),
            mobility: open.clone(),
            kappa: Faces::new(&spec.grid),
            iteration: ConjugateGradient::new(poisson),
            increment: CellField::new(&spec.grid),
            change: ghosts::change(spec, shape),
            convergence: Convergence { converged: true, ..Convergence::default() },
            open,
        }
    }

    /// m on all faces for a step of `dt` (s).
    pub fn set_mobility(&mut self, resistance: Option<&Resistance>, dt: f64) {
        let Some(resistance) = resistance else {
            self.mobility.clone_from(&self.open);
            return;
        };
        for axis in 0..3 {
            let rate = resistance.rate.component(axis);
            let open = self.open.component(axis);
            for ((m, beta), open) in self.mobility.component_mut(axis).iter_mut().zip(rate).zip(open) {
                *m = if *open == 0.0 { 0.0 } else { mobility(*beta, dt) };
            }
        }
    }

    /// Solves for q from v*, whose closed faces hold what passes them.
    ///
    /// `strength` is rho / dt; `guess` the first guess, in whose place the solution goes with ghosts to fill.
    pub fn solve(
        &mut self,
        shape: &Shape,
        poisson: &Poisson,
        star: [&[f64]; 3],
        medium: &Medium,
        strength: f64,
        held: [Option<f64>; 2],
        guess: Option<&CellField>,
    ) {
        self.set_kappa(shape, medium, held);
        let fastest = self.right_side(shape, poisson, star, medium, strength, held);
        let n = shape.n;
        for k in 0..n[2] {
            for j in 0..n[1] {
                let row = poisson.row(j, k);
                let row = &mut self.iteration.solution[row..row + n[0]];
                match guess {
                    Some(field) => row.copy_from_slice(&field.values[shape.row(j, k)..][..n[0]]),
                    None => row.fill(0.0),
                }
            }
        }
        let kappa = self.kappa.in_order(shape.axis);
        let operator = Operator { shape, poisson, kappa };
        self.convergence = self.iteration.solve(&operator, TOLERANCE * strength * fastest);
        for k in 0..n[2] {
            for j in 0..n[1] {
                let row = poisson.row(j, k);
                self.increment.values[shape.row(j, k)..][..n[0]]
                    .copy_from_slice(&self.iteration.solution[row..row + n[0]]);
            }
        }
    }

    fn set_kappa(&mut self, shape: &Shape, medium: &Medium, held: [Option<f64>; 2]) {
        for level in 0..3 {
            let axis = shape.axis[level];
            let per_area = shape.h[level].powi(-2);
            let mobility = self.mobility.component(axis);
            let kappa = self.kappa.component_mut(axis);
            for (kappa, m) in kappa.iter_mut().zip(mobility) {
                *kappa = m * per_area;
            }
            if let Some(mixture) = &medium.mixture {
                for (kappa, phi) in kappa.iter_mut().zip(mixture.porosity.component(axis)) {
                    *kappa *= phi;
                }
            }
        }
        // The held pressure stands half a cell beyond the last centre.
        for end in 0..2 {
            if held[end].is_some() {
                let kappa = self.kappa.component_mut(shape.axis[0]);
                for k in 0..shape.n[2] {
                    for j in 0..shape.n[1] {
                        kappa[shape.row(j, k) + end * shape.n[0]] *= 2.0;
                    }
                }
            }
        }
        close_ends(shape, &mut self.kappa);
    }

    /// rho / dt div(phi v* + (1 - phi) u) less what held pressures add; returns the largest |v| / h.
    fn right_side(
        &mut self,
        shape: &Shape,
        poisson: &Poisson,
        star: [&[f64]; 3],
        medium: &Medium,
        strength: f64,
        held: [Option<f64>; 2],
    ) -> f64 {
        let n = shape.n;
        let mut fastest = f64::MIN_POSITIVE;
        let open = self.open.in_order(shape.axis);
        let kappa = self.kappa.in_order(shape.axis);
        for k in 0..n[2] {
            for j in 0..n[1] {
                let at = shape.row(j, k);
                let row = poisson.row(j, k);
                let row = &mut self.iteration.residual[row..row + n[0]];
                row.fill(0.0);
                for level in (0..3).filter(|&l| shape.stride[l] != 0) {
                    let c = strength / shape.h[level];
                    let s = shape.stride[level];
                    let flux = |p: usize| match &medium.mixture {
                        None => star[level][p],
                        Some(m) => {
                            let axis = shape.axis[level];
                            // Grains that stand against a wall push nothing through it.
                            let solids = open[level][p] * m.solids_flux.component(axis)[p];
                            m.porosity.component(axis)[p] * star[level][p] + solids
                        }
                    };
                    // The far face of a periodic direction is the near one: a mixture need not repeat it.
                    let span = if shape.side[level] == Side::Periodic { n[level] * s } else { 0 };
                    for (i, f) in row.iter_mut().enumerate() {
                        let far =
                            if [i, j, k][level] + 1 == n[level] { at + i + s - span } else { at + i + s };
                        *f += c * (flux(far) - flux(at + i));
                        fastest = fastest.max(star[level][at + i].abs() / shape.h[level]);
                    }
                }
                for (end, i) in [(0, 0), (1, n[0] - 1)] {
                    if let Some(value) = held[end] {
                        row[i] -= kappa[0][at + end * n[0]] * value;
                    }
                }
            }
        }
        fastest
    }

    /// v = v* - dt m / rho grad q on all faces that the fluid passes; `strength` is rho / dt.
    pub fn correct(&self, shape: &Shape, star: [&[f64]; 3], strength: f64, velocity: [&mut [f64]; 3]) {
        let n = shape.n;
        let mobility = self.mobility.in_order(shape.axis);
        for (level, v) in velocity.into_iter().enumerate() {
            let s = shape.stride[level];
            if s == 0 {
                continue;
            }
            let c = 1.0 / (strength * shape.h[level]);
            // The last face too: an open end has one, a closed one keeps its own.
            let last = [0, 1, 2].map(|l| n[l] + usize::from(l == level && shape.side[l] != Side::Periodic));
            let q = &self.increment.values;
            for k in 0..last[2] {
                for j in 0..last[1] {
                    let at = shape.row(j, k);
                    for i in at..at + last[0] {
                        v[i] = star[level][i] - c * mobility[level][i] * (q[i] - q[i - s]);
                    }
                }
            }
        }
    }
}

/// Share of a velocity change that resistance `beta` (1/s) leaves over `dt` (s), implicitly.
fn mobility(beta: f64, dt: f64) -> f64 {
    1.0 / (1.0 + dt * beta)
}

/// Copies face 0 of periodic directions to face n.
pub(crate) fn close_ends(shape: &Shape, faces: &mut Faces) {
    let n = shape.n;
    for level in (0..3).filter(|&l| shape.side[l] == Side::Periodic) {
        let field = faces.component_mut(shape.axis[level]);
        let span = n[level] * shape.stride[level];
        let mut count = n;
        count[level] = 1;
        for k in 0..count[2] {
            for j in 0..count[1] {
                for i in 0..count[0] {
                    let at = shape.row(j, k) + i;
                    field[at + span] = field[at];
                }
            }
        }
    }
}

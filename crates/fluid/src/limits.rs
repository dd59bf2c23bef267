//! Upper limits of the step, each a formula with its reason.

use crate::flow::Flow;
use crate::solver::Solver;
use crate::spec::{Advection, Diffusion, FluidSpec, Scheme};
use brazilnut_base::Side;

/// Explicit diffusion, s: `dt <= 1 / (2 nu sum 1/h_i²)`, which is
/// `rho h² / (2 D eta)` on a cubic grid (Clément eq. 2.37); half of it for
/// Adams-Bashforth, whose stable stretch of the real axis is half as long.
#[must_use]
pub fn viscous(nu: f64, spacing: &[f64], scheme: Scheme) -> f64 {
    let euler = 0.5 / (nu * spacing.iter().map(|h| h.powi(-2)).sum::<f64>());
    if scheme == Scheme::SecondOrder { 0.5 * euler } else { euler }
}

/// Courant, s: `dt < 1 / sum(v / h_i)`, which is `h / (D v)` on a cubic grid
/// (Clément eq. 2.38): nothing crosses a cell in a step.
#[must_use]
pub fn courant(speed: f64, spacing: &[f64]) -> f64 {
    1.0 / spacing.iter().map(|h| speed / h).sum::<f64>()
}

/// Explicit Euler with central advection, s: `dt <= 2 nu / sum v_i²`, no
/// component above `speed` (Hirt 1968): the negative diffusion `v² dt / 2` of
/// the scheme must not exceed the viscosity.
#[must_use]
pub fn hirt(nu: f64, speed: f64, directions: usize) -> f64 {
    2.0 * nu / (directions as f64 * speed * speed)
}

/// Adams-Bashforth 2 with central advection, s: `dt <= (4 nu k² / w⁴)^(1/3)`.
///
/// An advected wave of frequency w grows at the rate `w⁴ dt³ / 4` and is
/// damped at `nu k²`. Worst is the wave of four cells: w = sum v / h_i, k² = sum 2 / h_i².
#[must_use]
pub fn adams_bashforth(nu: f64, speed: f64, spacing: &[f64]) -> f64 {
    let frequency: f64 = spacing.iter().map(|h| speed / h).sum();
    let damping: f64 = spacing.iter().map(|h| 2.0 * nu / (h * h)).sum();
    (4.0 * damping / frequency.powi(4)).cbrt()
}

/// All limits that hold for `spec` while no velocity component exceeds `speed` (m/s): name and seconds.
#[must_use]
pub fn step_limits(spec: &FluidSpec, speed: f64) -> Vec<(&'static str, f64)> {
    let spacing: Vec<f64> =
        (0..3).filter(|&a| spec.grid.sides[a] != Side::Flat).map(|a| spec.grid.spacing[a]).collect();
    let nu = spec.kinematic_viscosity();
    let mut limits = vec![];
    if spec.diffusion == Diffusion::Explicit && nu > 0.0 {
        limits.push(("viscous", viscous(nu, &spacing, spec.scheme)));
    }
    if speed > 0.0 && spec.advection != Advection::None {
        limits.push(("Courant", spec.courant_limit.min(1.0) * courant(speed, &spacing)));
        match (spec.advection, spec.scheme) {
            (Advection::Central, Scheme::FirstOrder) => limits.push(("Hirt", hirt(nu, speed, spacing.len()))),
            (Advection::Central, _) => limits.push(("Adams-Bashforth", adams_bashforth(nu, speed, &spacing))),
            _ => {}
        }
    }
    limits
}

/// Part of the sharpest limit that adaptive steps take.
const MARGIN: f64 = 0.8;
/// More parts than this are a flow that blows up.
const MOST: f64 = 1000.0;

impl Solver {
    /// How many equal parts a step of `dt` (s) needs for `flow` as it is; 1 where steps are fixed.
    #[must_use]
    pub fn substeps(&self, flow: &Flow, dt: f64) -> u64 {
        if !self.spec().adaptive {
            return 1;
        }
        // Ghosts too: they know the speed of a lid before the fluid does.
        let fastest = (0..3)
            .flat_map(|axis| flow.velocity.component(axis))
            .fold(0.0_f64, |a, v| if v.is_nan() { f64::INFINITY } else { a.max(v.abs()) });
        let limit = step_limits(self.spec(), fastest).into_iter().map(|l| l.1).fold(f64::INFINITY, f64::min);
        let parts = (dt / (MARGIN * limit)).ceil();
        if (1.0..=MOST).contains(&parts) { parts as u64 } else { 1 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cavity_of_the_thesis_at_reynolds_10000() {
        // 50 um, water, 1 m/s in two dimensions.
        let h = [50e-6; 2];
        assert!((viscous(1e-6, &h, Scheme::FirstOrder) - 6.25e-4).abs() < 1e-12);
        assert!((courant(1.0, &h) - 2.5e-5).abs() < 1e-18);
        // Both components at the lid's speed halve the 2e-6 s that hold for one.
        assert!((hirt(1e-6, 1.0, 1) - 2e-6).abs() < 1e-20);
        assert!((hirt(1e-6, 1.0, 2) - 1e-6).abs() < 1e-20);
    }
}

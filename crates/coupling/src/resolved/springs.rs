//! `fluid-springs`: tracers pull the fluid after their template (Clément 2009, 2.5.2; Höfler & Schwarzer 2000).
//!
//! The published spring acts on the slip of one step, epsilon = (v_f − v_t) dt, and so is a damper:
//! each step takes the part alpha of the slip away, which decays within tau = dt/alpha.

use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// How strong the springs are.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Strength {
    /// C_s as published; means a relaxation time only together with the step and the number of tracers.
    Cs(f64),
    /// Time in which the slip decays, s.
    RelaxationTime(f64),
}

/// Which mass the template carries.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Inertia {
    /// M_t = M − M_f: the enclosed fluid carries the rest (Höfler & Schwarzer 2000).
    #[default]
    Template,
    /// M, as printed in Clément eq. 2.100: the body then is M_f too heavy.
    Full,
}

/// The coupling of `fluid-springs`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Springs {
    /// Strength of the springs.
    pub strength: Strength,
    /// Damping constant gamma of a tracer, kg/s.
    pub damping: f64,
    /// Mass of the template.
    pub inertia: Inertia,
}

/// One body as the springs see it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpringBody {
    /// Number of tracers n.
    pub tracers: usize,
    /// Mass of a cell of fluid, rho Delta^D (kg).
    pub cell_mass: f64,
    /// Mass of the enclosed fluid M_f, kg.
    pub fluid_mass: f64,
    /// Mass of the template M_t = M − M_f, kg.
    pub template_mass: f64,
}

/// M_r = M_t dM/(M_t + dM), kg (Clément eq. 2.95).
#[must_use]
pub fn reduced_mass(template_mass: f64, cell_mass: f64) -> f64 {
    template_mass * cell_mass / (template_mass + cell_mass)
}

/// k dt² = 4 pi² C_s² M_r/n, kg (Clément eq. 2.97): impulse per slip of one tracer.
#[must_use]
pub fn spring_grip(c_s: f64, reduced_mass: f64, tracers: usize) -> f64 {
    4.0 * PI * PI * c_s * c_s * reduced_mass / tracers as f64
}

impl Springs {
    /// Impulse that a tracer gives the fluid per slip and step, (k dt + 2 gamma) dt, kg (Clément eq. 2.94).
    #[must_use]
    pub fn grip(&self, body: &SpringBody, dt: f64) -> f64 {
        let spring = match self.strength {
            Strength::Cs(c) => spring_grip(c, reduced_mass(body.template_mass, body.cell_mass), body.tracers),
            Strength::RelaxationTime(tau) => dt / tau * body.fluid_mass / body.tracers as f64,
        };
        spring + 2.0 * self.damping * dt
    }

    /// Part alpha of the slip that a step takes from the fluid of a tracer.
    #[must_use]
    pub fn alpha(&self, body: &SpringBody, dt: f64) -> f64 {
        self.grip(body, dt) * body.tracers as f64 / body.fluid_mass
    }

    /// Relaxation time tau = dt/alpha, s.
    #[must_use]
    pub fn relaxation_time(&self, body: &SpringBody, dt: f64) -> f64 {
        dt / self.alpha(body, dt)
    }

    /// Part of the slip that a step takes from fluid and template together, alpha (1 + M_f/M_carried);
    /// explicit springs are unstable from 2 on, and so are templates without mass.
    #[must_use]
    pub fn stiffness(&self, body: &SpringBody, dt: f64) -> f64 {
        let carried = match self.inertia {
            Inertia::Template => body.template_mass,
            Inertia::Full => body.template_mass + body.fluid_mass,
        };
        if carried <= 0.0 || body.template_mass <= 0.0 {
            return f64::INFINITY;
        }
        self.alpha(body, dt) * (1.0 + body.fluid_mass / carried)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Bronze in water, n_r = 3 (Clément chapters 3, 4).
    fn body(tracers: usize, ratio: f64) -> SpringBody {
        let cell_mass = 1.0;
        let fluid_mass = tracers as f64;
        SpringBody { tracers, cell_mass, fluid_mass, template_mass: (ratio - 1.0) * fluid_mass }
    }

    fn cs(c: f64) -> Springs {
        Springs { strength: Strength::Cs(c), damping: 0.0, inertia: Inertia::Template }
    }

    #[test]
    fn published_constants_as_parts_of_the_slip() {
        // 4 pi² C_s²/n at n = 113 with M_r = dM: 0.087, 0.79, 1.40 for C_s = 0.5, 1.5, 2, two digits.
        for (c, alpha) in [(0.5, 0.087), (1.5, 0.79), (2.0, 1.40)] {
            let a = cs(c).alpha(&body(113, 1e6), 1e-4);
            assert!((a / alpha - 1.0).abs() < 0.01, "{c}: {a}");
        }
        // The intruder of chapter 6: n_r = 10.5, n = 4849.
        let a = cs(0.5).alpha(&body(4849, 7.75), 1e-4);
        assert!((a / 0.002 - 1.0).abs() < 0.02, "{a}");
    }

    #[test]
    fn two_published_pairs_are_one_relaxation_time() {
        let b = body(113, 8.9);
        let slow = cs(0.5).relaxation_time(&b, 1e-5);
        let fast = cs(1.5).relaxation_time(&b, 1e-4);
        // C_s² per step: 0.25/1e-5 against 2.25/1e-4, 11 % apart.
        assert!((slow / fast - 0.9).abs() < 1e-12);
        assert!((fast / 1.27e-4 - 1.0).abs() < 0.01, "{fast}");
    }

    #[test]
    fn stiffness_of_light_templates_is_the_published_bound() {
        // alpha M_f/M_t = 4 pi² C_s²/(1 + n (ratio − 1)), to which alpha itself adds.
        let b = body(113, 1.05);
        let bound = 4.0 * PI * PI / (1.0 + 113.0 * 0.05);
        let s = cs(1.0);
        // Rounding.
        assert!((s.stiffness(&b, 1e-4) - s.alpha(&b, 1e-4) - bound).abs() < 1e-12);
        assert_eq!(cs(0.5).stiffness(&body(113, 1.0), 1e-4), f64::INFINITY);
    }
}

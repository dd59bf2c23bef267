//! The two beds at one instant: flows, accelerations, and what a landing does.

use super::{CoupledColumnsSpec, Resistance};
use crate::bed_equation::{BedLaw, Medium};
use crate::ode::fall_between;

/// Which of the two beds fly; the others rest on the floor.
pub(super) type Flying = [bool; 2];

/// gap₁, u₁, gap₂, u₂, v₁ (m, m/s; v₁ in the buoyant variant only), h₂ (m).
pub(super) type State = [f64; 6];

/// The speeds of the beds.
pub(super) fn speeds(y: &State) -> [f64; 2] {
    [y[1], y[3]]
}

/// The constants of the equations of motion.
pub(super) struct Columns<'a, L> {
    pub spec: &'a CoupledColumnsSpec,
    pub law: L,
    pub medium: Medium,
    /// c Γ of Clément eq. 5.7.
    pub drift: f64,
}

/// Flows and accelerations at one instant.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Instant {
    /// Superficial fluid velocities v₁, v₂, m/s.
    pub v: [f64; 2],
    /// Acceleration of each bed if it flies, m/s²; if it rests, what would lift it.
    pub lift: [f64; 2],
    /// v̇₁, m/s²; zero in the thesis's variant, where v₁ is not a state.
    pub v1_rate: f64,
    /// Pressure under column 1, hydrostatic part removed, Pa.
    pub pressure: f64,
}

impl<L: BedLaw> Columns<'_, L> {
    fn heights(&self, y: &State) -> [f64; 2] {
        [self.spec.total_height - y[5], y[5]]
    }

    /// Everything that follows from the state under effective gravity `weight` = g + z̈_c.
    pub fn instant(&self, y: &State, flying: Flying, weight: f64) -> Instant {
        if self.spec.buoyant { self.buoyant(y, flying, weight) } else { self.massless(y, weight) }
    }

    /// Clément eq. 5.2 to 5.5: the flows follow from the speeds alone.
    fn massless(&self, y: &State, weight: f64) -> Instant {
        let [h1, h2] = self.heights(y);
        let h1 = h1 * self.spec.pressure_ratio.at(h1, h2);
        let sum = -(y[1] + y[3]);
        let (v1, k) = match self.spec.resistance {
            Resistance::Bed => {
                let k = [y[1], y[3]].map(|u| self.law.coefficient(u, &self.medium));
                (sum * h2 * k[1] / (h2 * k[1] + h1 * k[0]), k)
            }
            Resistance::Fluid => {
                let v1 = self.divide(sum, h1, h2);
                (v1, [v1, sum - v1].map(|v| self.law.coefficient(v, &self.medium)))
            }
        };
        let v = [v1, sum - v1];
        let mass = self.spec.grain_density * (1.0 - self.spec.porosity);
        Instant {
            v,
            lift: [0, 1].map(|i| k[i] * v[i] / mass - weight),
            v1_rate: 0.0,
            pressure: self.heights(y)[0] * k[0] * v1,
        }
    }

    /// The part v₁ of `sum` = v₁ + v₂ for which K(v₁) v₁ r₁ = K(v₂) v₂ r₂.
    fn divide(&self, sum: f64, r1: f64, r2: f64) -> f64 {
        let gradient = |v: f64| self.law.gradient(v, &self.medium);
        // Both parts have the sign of the sum, which closes the bracket.
        let off = |part: f64| (r2 * gradient((1.0 - part) * sum) - r1 * gradient(part * sum)) * sum.signum();
        if sum == 0.0 { 0.0 } else { sum * fall_between(off, 0.0, off(0.0), 1.0, off(1.0)) }
    }

    /// The variant with the inertia and buoyancy of the fluid.
    ///
    /// With Π_i = ∂P_i + ρg' and q_i = (1−φ)u_i + φw_i the column fluxes,
    /// q̇_i = −a_i Π_i + b_i; q̇₁ + q̇₂ = 0 and Π₂h₂ = R Π₁h₁ give Π.
    fn buoyant(&self, y: &State, flying: Flying, weight: f64) -> Instant {
        let (phi, rho, rho_g) = (self.spec.porosity, self.spec.fluid_density, self.spec.grain_density);
        let share = self.shares(y);
        let v = [y[4], -(y[1] + y[3]) - y[4]];
        let drag = v.map(|v| phi * self.law.gradient(v, &self.medium));
        let sunk = (1.0 - rho / rho_g) * weight;
        let (mut a, mut b) = (0.0, 0.0);
        for i in 0..2 {
            a += self.mobility(flying[i]) * share[i];
            b += if flying[i] {
                -(1.0 - phi) * sunk + drag[i] * (1.0 / rho_g - 1.0 / rho)
            } else {
                -drag[i] / rho
            };
        }
        let x = b / a;
        let lift = [0, 1].map(|i| -sunk - x * share[i] / rho_g + drag[i] / (rho_g * (1.0 - phi)));
        let grains = if flying[0] { lift[0] } else { 0.0 };
        let fluid = -x * share[0] / rho - drag[0] / (rho * phi);
        Instant { v, lift, v1_rate: phi * (fluid - grains), pressure: -x }
    }

    /// Π_i over the common pressure: 1/h₁ and R/h₂, 1/m.
    fn shares(&self, y: &State) -> [f64; 2] {
        let [h1, h2] = self.heights(y);
        [1.0 / h1, self.spec.pressure_ratio.at(h1, h2) / h2]
    }

    /// a_i: how a pressure gradient moves what is in a column, m³/kg.
    fn mobility(&self, flying: bool) -> f64 {
        let fluid = self.spec.porosity / self.spec.fluid_density;
        if flying { fluid + (1.0 - self.spec.porosity) / self.spec.grain_density } else { fluid }
    }

    /// Velocity through the channel from 1 to 2 over A_r: u₂ + v₂, m/s (Clément eq. 5.3).
    pub fn exchange(&self, y: &State, v: [f64; 2]) -> f64 {
        y[3] + v[1]
    }

    /// The state just after bed `i` has landed without rebound.
    ///
    /// In the buoyant variant its grains stop at once but the volume still has
    /// to go somewhere: a pressure impulse, shared as the pressure is, speeds
    /// up the fluid in both columns and slows the other bed if it flies.
    pub fn land(&self, y: &State, flying: Flying, i: usize) -> State {
        let mut z = *y;
        z[2 * i] = 0.0;
        z[2 * i + 1] = 0.0;
        if !self.spec.buoyant {
            return z;
        }
        let (phi, rho) = (self.spec.porosity, self.spec.fluid_density);
        let (j, share, u) = (1 - i, self.shares(y), y[2 * i + 1]);
        let impulse = -(1.0 - phi) * u / (phi / rho * share[i] + self.mobility(flying[j]) * share[j]);
        let slowed = if flying[j] { -impulse * share[j] / self.spec.grain_density } else { 0.0 };
        z[2 * j + 1] += slowed;
        let grains = if i == 0 { -u } else { slowed };
        z[4] += phi * (-impulse * share[0] / rho - grains);
        z
    }
}

//! Kinetic theory of a vibrated layer (Lan 4.1; Richman & Martin 1992).
//!
//! A steady layer without mean flow over a floor whose velocity along its
//! normal fluctuates with rms V:
//!
//! * momentum dP/dz = −ρ_s ν g, P = ρ_s ν T (1 + 2(1+e)G);
//! * energy dQ/dz = −γ, Q = −κ dT/dz;
//! * no pressure and no flux at the top; at the floor the flux of
//!   [`closure::floor_flux_over_pressure`].
//!
//! The depth is infinite, so the mass above is the coordinate. The
//! Carnahan-Starling contact value knows no close packing: where the equation
//! of state asks for more than `densest`, ν stays there, transport and
//! dissipation are those at that packing, and the part of the pressure that
//! the collisions do not carry is left to lasting contacts.

pub mod closure;
mod profile;
mod report;
#[cfg(test)]
mod tests;

pub use profile::{KineticTheory, Layer, solve};

use crate::system::{Judge, Reader, Refusals, System};
use brazilnut_base::keys::{Check, Key, Kind};
use brazilnut_base::units::Dimension;
use brazilnut_base::values::Values;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// A layer of smooth spheres over a vibrating floor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct KineticTheorySpec {
    /// Gravity, m/s².
    pub gravity: f64,
    /// Diameter of the grains, m.
    pub diameter: f64,
    /// Hold-up m_t = N π d²/(6A): volume of the grains over base area and diameter (Lan eq. 4-1-3).
    pub hold_up: f64,
    /// Height of the cell, m, if it is known.
    pub cell_height: Option<f64>,
    /// Rms velocity of the floor along its normal, m/s.
    pub floor_velocity: f64,
    /// Restitution coefficient between grains.
    pub restitution: f64,
    /// Restitution coefficient between grain and floor.
    pub floor_restitution: f64,
    /// Solids fraction that is never exceeded.
    pub densest: f64,
    /// Relative error per integration step.
    pub tolerance: f64,
    /// Heights in the tables and figures.
    pub points: u32,
}

/// Keys of the table `[kinetic-theory]`.
pub const KEYS: &[Key] = &[
    Key::optional("hold_up", Kind::Quantity(Dimension::NONE), "Volume of the grains over base area and diameter; without it from the grains and the cell.").with(Check::Positive),
    Key::optional("diameter", Kind::Quantity(Dimension::LENGTH), "Diameter of the grains; without it the mean of the grains.").with(Check::Positive),
    Key::optional("floor_velocity", Kind::Quantity(Dimension::VELOCITY), "Rms velocity of the floor along its normal; without it that of the shaking, peak/sqrt(2) for a sinusoid.").with(Check::Positive),
    Key::optional("restitution", Kind::Quantity(Dimension::NONE), "Restitution coefficient between grains; without it that of the contact.").with(Check::Between(0.0, 1.0)),
    Key::optional("floor_restitution", Kind::Quantity(Dimension::NONE), "Restitution coefficient between grain and floor; without it that between grains.").with(Check::Between(0.0, 1.0)),
    Key::default("densest", Kind::Quantity(Dimension::NONE), "0.74", "Solids fraction that is never exceeded: the Carnahan-Starling contact value knows no close packing.").with(Check::Inside(0.0, 1.0)),
    Key::default("tolerance", Kind::Quantity(Dimension::NONE), "1e-9", "Relative error of one integration step.").with(Check::Between(1e-13, 1e-3)),
    Key::default("points", Kind::Integer, "400", "Heights in the tables and figures.").with(Check::Between(2.0, 1e6)),
];

impl KineticTheorySpec {
    /// The layer of a case: its `[kinetic-theory]` table first, then its common tables.
    ///
    /// # Errors
    /// Every value that is missing or refused, with the reason.
    pub fn from_values(table: &Values, system: &System) -> Result<Self, Refusals> {
        let mut r = Reader::new("kinetic-theory", table, system);
        let diameter = r.diameter();
        let restitution = r.needed("restitution", system.restitution, ", or that of the contact");
        let hold_up = system.solids_height.map(|s| s / diameter);
        let squares =
            system.shake.harmonics.iter().map(|h| 0.5 * (TAU * h.frequency * h.amplitude.z).powi(2));
        let shaken = Some(squares.sum::<f64>().sqrt()).filter(|&v| v > 0.0);
        let spec = Self {
            gravity: system.gravity,
            diameter,
            hold_up: r.needed("hold_up", hold_up, ", or describe grains and the cell's base"),
            cell_height: system.cell_height,
            floor_velocity: r.needed("floor_velocity", shaken, ", or shake vertically"),
            restitution,
            floor_restitution: r.number("floor_restitution", system.wall_restitution.unwrap_or(restitution)),
            densest: r.number("densest", 0.74),
            tolerance: r.number("tolerance", 1e-9),
            points: r.count("points", 400),
        };
        let spec = r.done(spec)?;
        spec.validate()?;
        Ok(spec)
    }

    /// Whether the specification makes sense.
    ///
    /// # Errors
    /// Every key at fault with the reason.
    pub fn validate(&self) -> Result<(), Refusals> {
        let mut judge = Judge::default();
        judge.gravity(self.gravity, "the layer does not stay on the floor");
        judge.positive([
            (self.diameter, "diameter", "m"),
            (self.hold_up, "hold_up", ""),
            (self.floor_velocity, "floor_velocity", "m/s"),
        ]);
        let densest = self.densest;
        judge.demand(densest > 0.0 && densest < 1.0, "densest", || {
            format!("is {densest}, must lie between 0 and 1")
        });
        for (e, key) in [(self.restitution, "restitution"), (self.floor_restitution, "floor_restitution")] {
            judge.demand((0.0..=1.0).contains(&e), key, || format!("is {e}, must lie between 0 and 1"));
        }
        judge.demand(self.restitution < 1.0 || self.floor_restitution < 1.0, "restitution", || {
            "is 1 between grains and at the floor: nothing dissipates, the layer heats up without end".into()
        });
        judge.fits("hold_up", self.hold_up * self.diameter / densest, self.cell_height);
        judge.tolerance(self.tolerance);
        judge.count(self.points, 2, "points");
        judge.verdict()
    }

    /// V_b = V/√(d g) (Lan eq. 4-1-3).
    #[must_use]
    pub fn boundary_velocity(&self) -> f64 {
        self.floor_velocity / (self.diameter * self.gravity).sqrt()
    }
}

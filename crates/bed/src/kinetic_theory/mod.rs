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

use crate::system::{Refusals, System, demand, need, verdict};
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
        let mut refusals = Refusals::new();
        let r = &mut refusals;
        let diameter = need(
            table.number_opt("diameter").or(system.grain_diameter),
            "diameter",
            "set [kinetic-theory] diameter, or describe grains",
            r,
        );
        let restitution = need(
            table.number_opt("restitution").or(system.restitution),
            "restitution",
            "set [kinetic-theory] restitution, or that of the contact",
            r,
        );
        let hold_up = table.number_opt("hold_up").or(system.solids_height.map(|s| s / diameter));
        let squares =
            system.shake.harmonics.iter().map(|h| 0.5 * (TAU * h.frequency * h.amplitude.z).powi(2));
        let shaken = Some(squares.sum::<f64>().sqrt()).filter(|&v| v > 0.0);
        let spec = Self {
            gravity: system.gravity,
            diameter,
            hold_up: need(
                hold_up,
                "hold_up",
                "set [kinetic-theory] hold_up, or describe grains and the cell's base",
                r,
            ),
            cell_height: system.cell_height,
            floor_velocity: need(
                table.number_opt("floor_velocity").or(shaken),
                "floor_velocity",
                "set [kinetic-theory] floor_velocity, or shake vertically",
                r,
            ),
            restitution,
            floor_restitution: table
                .number_opt("floor_restitution")
                .or(system.wall_restitution)
                .unwrap_or(restitution),
            densest: table.number_opt("densest").unwrap_or(0.74),
            tolerance: table.number_opt("tolerance").unwrap_or(1e-9),
            points: table.integer_opt("points").map_or(400, |n| n as u32),
        };
        verdict(refusals)?;
        spec.validate()?;
        Ok(spec)
    }

    /// Whether the specification makes sense.
    ///
    /// # Errors
    /// Every key at fault with the reason.
    pub fn validate(&self) -> Result<(), Refusals> {
        let mut r = Refusals::new();
        let positive = |x: f64| x > 0.0 && x.is_finite();
        demand(
            positive(self.gravity),
            "gravity",
            || format!("is {} m/s²: without gravity the layer does not stay on the floor", self.gravity),
            &mut r,
        );
        demand(
            positive(self.diameter),
            "diameter",
            || format!("is {} m, must be greater than zero", self.diameter),
            &mut r,
        );
        demand(
            positive(self.hold_up),
            "hold_up",
            || format!("is {}, must be greater than zero", self.hold_up),
            &mut r,
        );
        demand(
            positive(self.floor_velocity),
            "floor_velocity",
            || {
                format!(
                    "is {} m/s, must be greater than zero: a floor at rest feeds no layer",
                    self.floor_velocity
                )
            },
            &mut r,
        );
        demand(
            self.densest > 0.0 && self.densest < 1.0,
            "densest",
            || format!("is {}, must lie between 0 and 1", self.densest),
            &mut r,
        );
        for (e, key) in [(self.restitution, "restitution"), (self.floor_restitution, "floor_restitution")] {
            demand((0.0..=1.0).contains(&e), key, || format!("is {e}, must lie between 0 and 1"), &mut r);
        }
        demand(
            self.restitution < 1.0 || self.floor_restitution < 1.0,
            "restitution",
            || {
                "is 1 between grains and at the floor: nothing dissipates, the layer heats up without end"
                    .into()
            },
            &mut r,
        );
        if let Some(cell) = self.cell_height {
            let least = self.hold_up * self.diameter / self.densest;
            demand(
                least <= cell,
                "hold_up",
                || {
                    format!(
                        "of {} cannot be met: at the densest packing {} it is {least:.4} m high and the cell is {cell} m",
                        self.hold_up, self.densest
                    )
                },
                &mut r,
            );
        }
        demand(
            (1e-13..=1e-3).contains(&self.tolerance),
            "tolerance",
            || format!("is {}, must lie between 1e-13 and 1e-3", self.tolerance),
            &mut r,
        );
        demand(self.points >= 2, "points", || "must be at least 2".into(), &mut r);
        verdict(r)
    }

    /// V_b = V/√(d g) (Lan eq. 4-1-3).
    #[must_use]
    pub fn boundary_velocity(&self) -> f64 {
        self.floor_velocity / (self.diameter * self.gravity).sqrt()
    }
}

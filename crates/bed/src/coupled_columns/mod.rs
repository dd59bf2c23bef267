//! Two plugs joined by a channel at their bases: the partition instability (Clément 5.7).
//!
//! Columns 1 and 2 (heights h_i, speeds u_i relative to the cell, superficial
//! fluid velocities v_i relative to the grains, all upwards):
//!
//! * pressure: h₂ K₂ v₂ = R h₁ K₁ v₁ (Clément eq. 5.2), R the `pressure_ratio`;
//! * volume: u₁ + v₁ = −(u₂ + v₂), v = A_r (u₂ + v₂) through the channel from
//!   1 to 2 (Clément eq. 5.3, missing in print, from a closed incompressible cell);
//! * motion: u̇_i + g + z̈_c = K_i v_i/(ρ_g (1−φ)) (Clément eq. 5.4, 5.5; the K'_i
//!   of 5.6 is the equation `ergun-kozeny` over ρ_g (1−φ), printed at |u_i|
//!   where the flow |v_i| is meant: `resistance` has both);
//! * grains: while both fly they move through the channel at c v Γ (Clément
//!   eq. 5.7), hence ḣ₂ = −ḣ₁ = c v Γ / A_r (not stated in print).
//!
//! A bed that has landed rests and still passes fluid. The thesis has it wait
//! for the next throw; with `relaunch` it also leaves when the flow lifts it,
//! which the overpressure under the other bed's fall does. The thesis leaves out buoyancy and the
//! inertia of the fluid although it is water; `buoyant` has both:
//!
//! ρ_g(1−φ)u̇_i = −(1−φ)∂P_i − (1−φ)ρ_g g' + F_i,
//! ρφẇ_i = −φ∂P_i − φρg' − F_i, v_i = φ(w_i − u_i), F_i = φ K_i v_i, g' = g + z̈_c.

mod columns;
mod history;
mod report;
#[cfg(test)]
mod tests;

pub use history::{ColumnSample, CoupledColumns, Moment, collapse_exponent, solve};

use crate::bed_equation::{BedEquation, Medium, menu};
use crate::system::{Judge, Reader, Refusals, System};
use brazilnut_base::keys::{Check, Key, Kind};
use brazilnut_base::motion::Motion;
use brazilnut_base::units::Dimension;
use brazilnut_base::values::Values;
use serde::{Deserialize, Serialize};

/// Exponent of the pressure ratio fitted to the two values that the thesis
/// states: 1.5 at h₂/h₁ = 15 (Clément Fig. 5.14) and 1.55 at 21 (Fig. 5.15)
/// give 0.150 and 0.144.
pub const FITTED_EXPONENT: f64 = 0.147;

/// R = ΔP₂/ΔP₁ over the heights of the columns.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum PressureRatio {
    /// The same at all heights; 1 is the thesis's choice.
    Constant(f64),
    /// (h₂/h₁)^p: 0 for a channel without resistance, 1 for one so long that the beds fly by themselves.
    Power(f64),
}

impl PressureRatio {
    /// R at heights `h1` and `h2`, m.
    #[must_use]
    pub fn at(self, h1: f64, h2: f64) -> f64 {
        match self {
            Self::Constant(r) => r,
            Self::Power(p) => (h2 / h1).powf(p),
        }
    }
}

/// At which speed the resistance K_i of Clément eq. 5.6 is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Resistance {
    /// |u_i|, as printed.
    Bed,
    /// |v_i|, the flow through the bed.
    Fluid,
}

/// Two columns over a shaken floor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CoupledColumnsSpec {
    /// Motion of the floor.
    pub shake: Motion,
    /// Gravity, m/s².
    pub gravity: f64,
    /// Height of both columns together, m.
    pub total_height: f64,
    /// Height of column 2 over column 1 at the start, m.
    pub height_difference: f64,
    /// Height of the cell, m, if it is known.
    pub cell_height: Option<f64>,
    /// Porosity.
    pub porosity: f64,
    /// Diameter of the grains, m.
    pub diameter: f64,
    /// Density of the grains, kg/m³.
    pub grain_density: f64,
    /// Density of the fluid, kg/m³.
    pub fluid_density: f64,
    /// Dynamic viscosity of the fluid, Pa s.
    pub viscosity: f64,
    /// Pressure drop through the beds.
    pub bed_equation: BedEquation,
    /// A_r: area of a column over that of the channel.
    pub area_ratio: f64,
    /// c of Clément eq. 5.7.
    pub coupling: f64,
    /// R of Clément eq. 5.2.
    pub pressure_ratio: PressureRatio,
    /// With buoyancy and the inertia of the fluid in the beds; its resistance is always that of the flow.
    pub buoyant: bool,
    /// Speed at which the resistance is taken.
    pub resistance: Resistance,
    /// Whether the flow can lift a landed bed before it is next thrown.
    pub relaunch: bool,
    /// Time to follow, s; ends sooner if a column runs empty.
    pub duration: f64,
    /// Relative error per integration step.
    pub tolerance: f64,
    /// Phases per cycle in the tables.
    pub phases: u32,
}

/// Keys of the table `[coupled-columns]`.
pub const KEYS: &[Key] = &[
    Key::optional("total_height", Kind::Quantity(Dimension::LENGTH), "Height of both columns together; without it twice that of the settled or randomly packed grains.").with(Check::Positive),
    Key::default("height_difference", Kind::Quantity(Dimension::LENGTH), "\"4 mm\"", "Height of column 2 over column 1 at the start."),
    Key::optional("porosity", Kind::Quantity(Dimension::NONE), "Fluid fraction of the beds; without it that of the settled grains, else 0.42.").with(Check::Inside(0.0, 1.0)),
    Key::optional("diameter", Kind::Quantity(Dimension::LENGTH), "Diameter of the grains in the bed equation; without it the mean of the grains.").with(Check::Positive),
    Key::optional("grain_density", Kind::Quantity(Dimension::DENSITY), "Density of the grains; without it that of their material.").with(Check::Positive),
    Key::default("bed_equation", Kind::Choice(menu::MENU), "\"ergun-kozeny\"", "Pressure drop through the beds."),
    Key::default("area_ratio", Kind::Quantity(Dimension::NONE), "2.5", "Area of a column over that of the lower channel.").with(Check::Positive),
    Key::default("coupling", Kind::Quantity(Dimension::NONE), "0.019", "c in the grains' velocity c v Gamma through the channel: a fitted parameter.").with(Check::NonNegative),
    Key::default("pressure_ratio", Kind::QuantityOr(Dimension::NONE, &["fitted", "long-channel"]), "1.0", "Pressure under column 2 over that under column 1: a number; \"fitted\", (h2/h1)^0.147 after the thesis's simulations; or \"long-channel\", h2/h1, for beds that fly by themselves.").with(Check::Positive),
    Key::default("buoyant", Kind::Flag, "false", "With the buoyancy and inertia of the fluid, which the thesis leaves out here."),
    Key::default("resistance", Kind::Word(&["fluid", "bed"]), "\"fluid\"", "Speed at which the bed equation's resistance is taken: that of the fluid through the bed, or, as Clément eq. 5.6 is printed, that of the bed."),
    Key::default("relaunch", Kind::Flag, "false", "Whether the flow can lift a landed bed before the floor next throws it."),
    Key::default("duration", Kind::Quantity(Dimension::TIME), "\"30 s\"", "Time to follow; ends sooner if a column runs empty.").with(Check::Positive),
    Key::default("tolerance", Kind::Quantity(Dimension::NONE), "1e-8", "Relative error of one integration step.").with(Check::Between(1e-13, 1e-3)),
    Key::default("phases", Kind::Integer, "360", "Phases per cycle in the tables and figures.").with(Check::Between(8.0, 1e5)),
];

impl CoupledColumnsSpec {
    /// The columns of a case: its `[coupled-columns]` table first, then its common tables.
    ///
    /// # Errors
    /// Every value that is missing or refused, with the reason.
    pub fn from_values(table: &Values, system: &System) -> Result<Self, Refusals> {
        let mut r = Reader::new("coupled-columns", table, system);
        let porosity = r.porosity();
        let both = r.bed_height(porosity).map(|h| 2.0 * h);
        let pressure_ratio = match table.text_opt("pressure_ratio") {
            Some("fitted") => PressureRatio::Power(FITTED_EXPONENT),
            Some("long-channel") => PressureRatio::Power(1.0),
            _ => PressureRatio::Constant(table.number_opt("pressure_ratio").unwrap_or(1.0)),
        };
        let spec = Self {
            shake: system.shake.clone(),
            gravity: system.gravity,
            total_height: r.needed("total_height", both, ", or describe grains to pack"),
            height_difference: r.number("height_difference", 4e-3),
            cell_height: system.cell_height,
            porosity,
            diameter: r.diameter(),
            grain_density: r.grain_density(),
            fluid_density: system.fluid_density.unwrap_or(0.0),
            viscosity: r.viscosity(),
            bed_equation: r.bed_equation(BedEquation::ErgunKozeny),
            area_ratio: r.number("area_ratio", 2.5),
            coupling: r.number("coupling", 0.019),
            pressure_ratio,
            buoyant: table.flag("buoyant"),
            resistance: if table.text_opt("resistance") == Some("bed") {
                Resistance::Bed
            } else {
                Resistance::Fluid
            },
            relaunch: table.flag("relaunch"),
            duration: r.number("duration", 30.0),
            tolerance: r.number("tolerance", 1e-8),
            phases: r.count("phases", 360),
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
        judge.gravity(self.gravity, "the beds never land");
        judge.shake(&self.shake, self.gravity);
        judge.positive([
            (self.total_height, "total_height", "m"),
            (self.diameter, "diameter", "m"),
            (self.grain_density, "grain_density", "kg/m³"),
            (self.viscosity, "viscosity", "Pa s"),
            (self.area_ratio, "area_ratio", ""),
            (self.duration, "duration", "s"),
        ]);
        judge.porosity(self.porosity);
        judge.not_negative([(self.fluid_density, "density", "kg/m³"), (self.coupling, "coupling", "")]);
        if self.buoyant {
            let reason = || "of the fluid is zero: a buoyant model needs a fluid with mass".into();
            judge.demand(self.fluid_density > 0.0, "density", reason);
            judge.sinks(self.fluid_density, self.grain_density);
        }
        let least = (self.total_height - self.height_difference.abs()) / 2.0;
        judge.demand(least > self.diameter, "height_difference", || {
            let difference = self.height_difference;
            format!("of {difference} m leaves a column of {least:.2e} m, less than one grain")
        });
        let most = (self.total_height + self.height_difference.abs()) / 2.0;
        judge.fits("total_height", most, self.cell_height);
        let ratio = match self.pressure_ratio {
            PressureRatio::Constant(x) => x > 0.0 && x.is_finite(),
            PressureRatio::Power(p) => p.is_finite(),
        };
        judge.demand(ratio, "pressure_ratio", || "must be greater than zero".into());
        judge.tolerance(self.tolerance);
        judge.count(self.phases, 8, "phases");
        judge.verdict()
    }

    /// The beds as the bed equation sees them.
    #[must_use]
    pub fn medium(&self) -> Medium {
        Medium {
            porosity: self.porosity,
            diameter: self.diameter,
            density: self.fluid_density,
            viscosity: self.viscosity,
        }
    }
}

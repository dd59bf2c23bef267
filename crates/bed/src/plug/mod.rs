//! Kroll and modified Kroll: the flight of a porous plug (Clément 2.3, 2.3.1).
//!
//! The bed is a plug of fixed porosity φ and height h. Between take-off and
//! landing its speed u relative to the cell obeys, with z̈_c the acceleration
//! of the floor and K the bed equation's coefficient,
//!
//! * Kroll: u̇ + γ u + g + z̈_c = 0 (Clément eq. 2.50);
//! * modified: u̇ [1 + ρ(1−φ)/(ρ_g φ)] + (1 − ρ/ρ_g)(g + z̈_c) + γ u = 0 (Clément eq. 2.51);
//!
//! γ = K(u)/(ρ_g (1−φ)). A landing is perfectly inelastic. The base pressure,
//! without its hydrostatic part, is −h [K(u) u + ρ(1−φ)/φ u̇]; Kroll's
//! massless fluid has the first term only.

mod flight;
mod report;
#[cfg(test)]
mod tests;

pub use flight::{Flight, Peak, Peaks, Plug, Sample, solve};

use crate::bed_equation::{BedEquation, Medium, menu};
use crate::system::{Judge, Reader, Refusals, System};
use brazilnut_base::keys::{Check, Key, Kind};
use brazilnut_base::motion::Motion;
use brazilnut_base::units::Dimension;
use brazilnut_base::values::Values;
use serde::{Deserialize, Serialize};

/// A plug over a shaken floor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlugSpec {
    /// Motion of the floor; its vertical part must be periodic after the ramp.
    pub shake: Motion,
    /// Gravity, m/s².
    pub gravity: f64,
    /// Height of the bed, m.
    pub height: f64,
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
    /// Pressure drop through the bed.
    pub bed_equation: BedEquation,
    /// With buoyancy and added mass (Clément eq. 2.51).
    pub modified: bool,
    /// Relative error per integration step.
    pub tolerance: f64,
    /// Most shake cycles to follow until the motion repeats itself.
    pub cycles: u32,
    /// Phases per cycle in the tables.
    pub phases: u32,
}

/// Keys of the table `[plug]`.
pub const KEYS: &[Key] = &[
    Key::optional(
        "height",
        Kind::Quantity(Dimension::LENGTH),
        "Height of the bed at rest; without it that of the settled or randomly packed grains.",
    )
    .with(Check::Positive),
    Key::optional(
        "porosity",
        Kind::Quantity(Dimension::NONE),
        "Fluid fraction of the bed; without it that of the settled grains, else 0.42.",
    )
    .with(Check::Inside(0.0, 1.0)),
    Key::optional(
        "diameter",
        Kind::Quantity(Dimension::LENGTH),
        "Diameter of the grains in the bed equation; without it the mean of the grains.",
    )
    .with(Check::Positive),
    Key::optional(
        "grain_density",
        Kind::Quantity(Dimension::DENSITY),
        "Density of the grains; without it that of their material.",
    )
    .with(Check::Positive),
    Key::default("bed_equation", Kind::Choice(menu::MENU), "\"ergun\"", "Pressure drop through the bed."),
    Key::default(
        "tolerance",
        Kind::Quantity(Dimension::NONE),
        "1e-10",
        "Relative error of one integration step.",
    )
    .with(Check::Between(1e-13, 1e-3)),
    Key::default(
        "cycles",
        Kind::Integer,
        "500",
        "Most shake cycles to follow until the motion repeats itself.",
    )
    .with(Check::Between(1.0, 1e6)),
    Key::default("phases", Kind::Integer, "360", "Phases per cycle in the tables and figures.")
        .with(Check::Between(8.0, 1e5)),
];

impl PlugSpec {
    /// The plug of a case: its `[plug]` table first, then its common tables.
    /// Without a fluid it flies freely.
    ///
    /// # Errors
    /// Every value that is missing or refused, with the reason.
    pub fn from_values(table: &Values, system: &System, modified: bool) -> Result<Self, Refusals> {
        let mut r = Reader::new("plug", table, system);
        let porosity = r.porosity();
        let spec = Self {
            shake: system.shake.clone(),
            gravity: system.gravity,
            height: r.needed("height", r.bed_height(porosity), ", or describe grains to pack"),
            cell_height: system.cell_height,
            porosity,
            diameter: r.diameter(),
            grain_density: r.grain_density(),
            fluid_density: system.fluid_density.unwrap_or(0.0),
            viscosity: system.viscosity.unwrap_or(0.0),
            bed_equation: r.bed_equation(BedEquation::Ergun),
            modified,
            tolerance: r.number("tolerance", 1e-10),
            cycles: r.count("cycles", 500),
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
        judge.gravity(self.gravity, "the plug never lands");
        judge.shake(&self.shake, self.gravity);
        judge.positive([
            (self.height, "height", "m"),
            (self.diameter, "diameter", "m"),
            (self.grain_density, "grain_density", "kg/m³"),
        ]);
        judge.porosity(self.porosity);
        judge.not_negative([(self.fluid_density, "density", "kg/m³"), (self.viscosity, "viscosity", "Pa s")]);
        if self.modified {
            judge.sinks(self.fluid_density, self.grain_density);
        }
        judge.fits("height", self.height, self.cell_height);
        judge.tolerance(self.tolerance);
        judge.count(self.cycles, 1, "cycles");
        judge.count(self.phases, 8, "phases");
        judge.verdict()
    }

    /// The bed as the bed equation sees it.
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

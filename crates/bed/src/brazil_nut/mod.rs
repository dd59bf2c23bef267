//! A dense intruder in a shaken, fluid-immersed bed: the Brazil-nut column (Clément 6.5).
//!
//! The bed is a modified-Kroll plug (Clément eq. 6.1, 6.2, with γu = +∂P/((1−φ)ρ_H)),
//! which the intruder does not disturb. While it flies the intruder, its
//! centre at z_I over the floor of the cell, obeys
//!
//! ρ_I V_I z̈_I = −(ρ_I − ρ) V_I (g + z̈_c) + F_fluid + F_bed (Clément eq. 6.3),
//!
//! * F_fluid = V_I (−∂P) × `drag_factor`, the gradient that of the flow
//!   through the bed, the factor 1/(1−φ) (Clément eq. 6.4; a large
//!   impermeable sphere in Darcy flow would feel 3/2);
//! * F_bed = −α [1 − exp(−(h − (z_I − z + r_I))/l)] v/|v|, v = ż_I − u: it
//!   opposes the motion through the bed (Clément eq. 6.5 lacks the sign) and
//!   is a dry friction, so that the intruder may also ride with the bed.
//!
//! Grains fill every gap: when the bed lands the intruder stays where it is.
//! It starts at the base and has risen when its top is level with the surface,
//! where F_bed ends.

mod report;
mod ride;
#[cfg(test)]
mod tests;

pub use ride::{BrazilNut, Rise, solve};

use crate::bed_equation::{BedEquation, Medium, menu};
use crate::system::{Judge, Reader, Refusals, System};
use brazilnut_base::keys::{Check, Key, Kind};
use brazilnut_base::motion::Motion;
use brazilnut_base::units::Dimension;
use brazilnut_base::values::Values;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// A bed with an intruder over a shaken floor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BrazilNutSpec {
    /// Motion of the floor.
    pub shake: Motion,
    /// Gravity, m/s².
    pub gravity: f64,
    /// Height of the bed, m.
    pub height: f64,
    /// Height of the cell, m, if it is known.
    pub cell_height: Option<f64>,
    /// Porosity.
    pub porosity: f64,
    /// Diameter of the host grains, m.
    pub diameter: f64,
    /// Density of the host grains, kg/m³.
    pub grain_density: f64,
    /// Density of the fluid, kg/m³.
    pub fluid_density: f64,
    /// Dynamic viscosity of the fluid, Pa s.
    pub viscosity: f64,
    /// Pressure drop through the bed.
    pub bed_equation: BedEquation,
    /// Diameter of the intruder, m.
    pub intruder_diameter: f64,
    /// Density of the intruder, kg/m³.
    pub intruder_density: f64,
    /// α: strength of the bed's force, N.
    pub alpha: f64,
    /// l: depth over which it sets in, m.
    pub range: f64,
    /// F_fluid over V_I (−∂P).
    pub drag_factor: f64,
    /// Gap H between the intruder's lowest point and the base at the start, m.
    pub start: f64,
    /// Most shake cycles to follow.
    pub cycles: u32,
    /// Relative error per integration step.
    pub tolerance: f64,
}

/// Keys of the table `[brazil-nut-column]`.
pub const KEYS: &[Key] = &[
    Key::optional("height", Kind::Quantity(Dimension::LENGTH), "Height of the bed at rest; without it that of the settled or randomly packed grains.").with(Check::Positive),
    Key::optional("porosity", Kind::Quantity(Dimension::NONE), "Fluid fraction of the bed; without it that of the settled grains, else 0.42.").with(Check::Inside(0.0, 1.0)),
    Key::optional("diameter", Kind::Quantity(Dimension::LENGTH), "Diameter of the host grains; without it the mean of the grains.").with(Check::Positive),
    Key::optional("grain_density", Kind::Quantity(Dimension::DENSITY), "Density of the host grains; without it that of their material.").with(Check::Positive),
    Key::optional("intruder_diameter", Kind::Quantity(Dimension::LENGTH), "Diameter of the intruder; without it that of the grain called intruder.").with(Check::Positive),
    Key::optional("intruder_density", Kind::Quantity(Dimension::DENSITY), "Density of the intruder; without it that of its material.").with(Check::Positive),
    Key::default("bed_equation", Kind::Choice(menu::MENU), "\"ergun\"", "Pressure drop through the bed."),
    Key::optional("alpha", Kind::Quantity(Dimension::FORCE), "Strength of the bed's force on the intruder: a fitted parameter that grows with Gamma; the model needs it.").with(Check::NonNegative),
    Key::optional("range", Kind::Quantity(Dimension::LENGTH), "Depth over which the bed's force sets in below the surface: a fitted parameter; the model needs it.").with(Check::Positive),
    Key::optional("drag_factor", Kind::Quantity(Dimension::NONE), "Fluid force on the intruder over its volume times the pressure gradient; without it 1/(1 - porosity).").with(Check::NonNegative),
    Key::default("start", Kind::Quantity(Dimension::LENGTH), "\"0 m\"", "Gap between the intruder's lowest point and the base at the start.").with(Check::NonNegative),
    Key::default("cycles", Kind::Integer, "600", "Most shake cycles to follow.").with(Check::Between(1.0, 1e6)),
    Key::default("tolerance", Kind::Quantity(Dimension::NONE), "1e-10", "Relative error of one integration step.").with(Check::Between(1e-13, 1e-3)),
];

impl BrazilNutSpec {
    /// The column of a case: its `[brazil-nut-column]` table first, then its common tables.
    ///
    /// # Errors
    /// Every value that is missing or refused, with the reason.
    pub fn from_values(table: &Values, system: &System) -> Result<Self, Refusals> {
        let mut r = Reader::new("brazil-nut-column", table, system);
        let porosity = r.porosity();
        let intruder = ", or describe a grain called intruder";
        let spec = Self {
            shake: system.shake.clone(),
            gravity: system.gravity,
            height: r.needed("height", r.bed_height(porosity), ", or describe grains to pack"),
            cell_height: system.cell_height,
            porosity,
            diameter: r.diameter(),
            grain_density: r.grain_density(),
            fluid_density: system.fluid_density.unwrap_or(0.0),
            viscosity: r.viscosity(),
            bed_equation: r.bed_equation(BedEquation::Ergun),
            intruder_diameter: r.needed("intruder_diameter", system.intruder_diameter, intruder),
            intruder_density: r.needed("intruder_density", system.intruder_density, intruder),
            alpha: r.needed("alpha", None, ""),
            range: r.needed("range", None, ""),
            drag_factor: r.number("drag_factor", 1.0 / (1.0 - porosity)),
            start: r.number("start", 0.0),
            cycles: r.count("cycles", 600),
            tolerance: r.number("tolerance", 1e-10),
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
        judge.gravity(self.gravity, "the bed never lands");
        judge.shake(&self.shake, self.gravity);
        judge.positive([
            (self.height, "height", "m"),
            (self.diameter, "diameter", "m"),
            (self.grain_density, "grain_density", "kg/m³"),
            (self.viscosity, "viscosity", "Pa s"),
            (self.intruder_diameter, "intruder_diameter", "m"),
            (self.range, "range", "m"),
        ]);
        judge.not_negative([
            (self.alpha, "alpha", "N"),
            (self.drag_factor, "drag_factor", ""),
            (self.start, "start", "m"),
            (self.fluid_density, "density", "kg/m³"),
        ]);
        judge.porosity(self.porosity);
        judge.sinks(self.fluid_density, self.grain_density);
        judge.demand(self.intruder_density > self.fluid_density, "intruder_density", || {
            let density = self.intruder_density;
            format!("({density} kg/m³) is not above that of the fluid: the model is for a dense intruder")
        });
        judge.demand(self.start + self.intruder_diameter < self.height, "intruder_diameter", || {
            let Self { intruder_diameter, start, height, .. } = self;
            format!(
                "({intruder_diameter} m) and the start at {start} m leave no depth in a bed of {height} m"
            )
        });
        judge.fits("height", self.height, self.cell_height);
        judge.count(self.cycles, 1, "cycles");
        judge.tolerance(self.tolerance);
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

    /// Volume of the intruder, m³.
    #[must_use]
    pub fn intruder_volume(&self) -> f64 {
        PI / 6.0 * self.intruder_diameter.powi(3)
    }

    /// Weight of the immersed intruder, N: what α is to be compared with.
    #[must_use]
    pub fn immersed_weight(&self) -> f64 {
        (self.intruder_density - self.fluid_density) * self.intruder_volume() * self.gravity
    }
}

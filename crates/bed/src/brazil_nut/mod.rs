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
use crate::shake::Shake;
use crate::system::{Refusals, System, demand, need, verdict};
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
        let mut refusals = Refusals::new();
        let r = &mut refusals;
        let porosity = system.porosity(table);
        let spec = Self {
            shake: system.shake.clone(),
            gravity: system.gravity,
            height: need(
                system.height(table, porosity),
                "height",
                "set [brazil-nut-column] height, or describe grains to pack",
                r,
            ),
            cell_height: system.cell_height,
            porosity,
            diameter: need(
                table.number_opt("diameter").or(system.grain_diameter),
                "diameter",
                "set [brazil-nut-column] diameter, or describe grains",
                r,
            ),
            grain_density: need(
                table.number_opt("grain_density").or(system.grain_density),
                "grain_density",
                "set [brazil-nut-column] grain_density, or describe grains",
                r,
            ),
            fluid_density: system.fluid_density.unwrap_or(0.0),
            viscosity: need(
                system.viscosity,
                "viscosity",
                "the bed moves against a fluid: add a [fluid] table",
                r,
            ),
            bed_equation: table
                .text_opt("bed_equation")
                .and_then(BedEquation::from_name)
                .unwrap_or(BedEquation::Ergun),
            intruder_diameter: need(
                table.number_opt("intruder_diameter").or(system.intruder_diameter),
                "intruder_diameter",
                "set [brazil-nut-column] intruder_diameter, or describe a grain called intruder",
                r,
            ),
            intruder_density: need(
                table.number_opt("intruder_density").or(system.intruder_density),
                "intruder_density",
                "set [brazil-nut-column] intruder_density, or describe a grain called intruder",
                r,
            ),
            alpha: need(table.number_opt("alpha"), "alpha", "set [brazil-nut-column] alpha", r),
            range: need(table.number_opt("range"), "range", "set [brazil-nut-column] range", r),
            drag_factor: table.number_opt("drag_factor").unwrap_or(1.0 / (1.0 - porosity)),
            start: table.number_opt("start").unwrap_or(0.0),
            cycles: table.integer_opt("cycles").map_or(600, |n| n as u32),
            tolerance: table.number_opt("tolerance").unwrap_or(1e-10),
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
            || format!("is {} m/s²: without gravity the bed never lands", self.gravity),
            &mut r,
        );
        if let Err(reason) = Shake::new(&self.shake, self.gravity) {
            r.push(("gamma", reason));
        }
        for (value, key, unit) in [
            (self.height, "height", "m"),
            (self.diameter, "diameter", "m"),
            (self.grain_density, "grain_density", "kg/m³"),
            (self.viscosity, "viscosity", "Pa s"),
            (self.intruder_diameter, "intruder_diameter", "m"),
            (self.range, "range", "m"),
        ] {
            demand(positive(value), key, || format!("is {value} {unit}, must be greater than zero"), &mut r);
        }
        for (value, key) in [(self.alpha, "alpha"), (self.drag_factor, "drag_factor"), (self.start, "start")]
        {
            demand(
                value >= 0.0 && value.is_finite(),
                key,
                || format!("is {value}, must be zero or greater"),
                &mut r,
            );
        }
        demand(
            self.porosity > 0.0 && self.porosity < 1.0,
            "porosity",
            || format!("is {}, must lie between 0 and 1: it is the fluid fraction of the bed", self.porosity),
            &mut r,
        );
        demand(
            self.fluid_density >= 0.0 && self.fluid_density < self.grain_density,
            "density",
            || {
                format!(
                    "of the fluid ({} kg/m³) must lie between 0 and that of the grains ({} kg/m³)",
                    self.fluid_density, self.grain_density
                )
            },
            &mut r,
        );
        demand(
            self.intruder_density > self.fluid_density,
            "intruder_density",
            || {
                format!(
                    "({} kg/m³) is not above that of the fluid: the model is for a dense intruder",
                    self.intruder_density
                )
            },
            &mut r,
        );
        demand(
            self.start + self.intruder_diameter < self.height,
            "intruder_diameter",
            || {
                format!(
                    "({} m) and the start at {} m leave no depth in a bed of {} m",
                    self.intruder_diameter, self.start, self.height
                )
            },
            &mut r,
        );
        if let Some(cell) = self.cell_height {
            demand(
                self.height <= cell,
                "height",
                || format!("of the bed ({} m) exceeds that of the cell ({cell} m)", self.height),
                &mut r,
            );
        }
        demand(self.cycles >= 1, "cycles", || "must be at least 1".into(), &mut r);
        demand(
            (1e-13..=1e-3).contains(&self.tolerance),
            "tolerance",
            || format!("is {}, must lie between 1e-13 and 1e-3", self.tolerance),
            &mut r,
        );
        verdict(r)
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

//! What a model needs from the rest of the case, and what it hands back.

use crate::bed_equation::BedEquation;
use crate::shake::Shake;
use brazilnut_base::Table;
use brazilnut_base::figure::Figure;
use brazilnut_base::motion::Motion;
use brazilnut_base::values::Values;

/// Why a specification is refused: the key at fault and the reason.
pub type Refusals = Vec<(&'static str, String)>;

/// Solids have this porosity where nothing else is said: the random packing of Clément 2.4.1.
pub const RANDOM_PACKING: f64 = 0.42;

/// The common tables of a case as far as these models need them, in SI;
/// `None` where the case says nothing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct System {
    /// Motion of the cell or floor.
    pub shake: Motion,
    /// Gravity, positive downwards, m/s².
    pub gravity: f64,
    /// Height of the cell, m.
    pub cell_height: Option<f64>,
    /// Density of the fluid, kg/m³; none without a fluid.
    pub fluid_density: Option<f64>,
    /// Dynamic viscosity of the fluid, Pa s.
    pub viscosity: Option<f64>,
    /// Density of the grains, kg/m³.
    pub grain_density: Option<f64>,
    /// Mean diameter of the grains, m.
    pub grain_diameter: Option<f64>,
    /// Volume of all grains over the base area, m.
    pub solids_height: Option<f64>,
    /// Height of the settled bed, m.
    pub bed_height: Option<f64>,
    /// Porosity of the settled bed.
    pub porosity: Option<f64>,
    /// Restitution coefficient between grains.
    pub restitution: Option<f64>,
    /// Restitution coefficient between grain and floor.
    pub wall_restitution: Option<f64>,
    /// Density of the intruder, kg/m³.
    pub intruder_density: Option<f64>,
    /// Diameter of the intruder, m.
    pub intruder_diameter: Option<f64>,
}

/// Reads the specification of one model: its own table first, then the common tables of the case.
/// Notes what neither has.
pub(crate) struct Reader<'a> {
    /// The table of the model.
    pub table: &'a Values,
    /// The common tables.
    pub system: &'a System,
    name: &'static str,
    refusals: Refusals,
}

impl<'a> Reader<'a> {
    /// For the model whose table is called `name`.
    pub fn new(name: &'static str, table: &'a Values, system: &'a System) -> Self {
        Self { table, system, name, refusals: Refusals::new() }
    }

    /// A value that must be there from somewhere; `otherwise` says where else it may come from.
    pub fn needed(&mut self, key: &'static str, common: Option<f64>, otherwise: &str) -> f64 {
        self.table.number_opt(key).or(common).unwrap_or_else(|| {
            self.refusals.push((key, format!("not given: set [{}] {key}{otherwise}", self.name)));
            f64::NAN
        })
    }

    /// A value that has a default.
    pub fn number(&self, key: &str, default: f64) -> f64 {
        self.table.number_opt(key).unwrap_or(default)
    }

    /// A count that has a default.
    pub fn count(&self, key: &str, default: u32) -> u32 {
        self.table.integer_opt(key).map_or(default, |n| n as u32)
    }

    /// The porosity: the model's table, else the settled bed, else random packing.
    pub fn porosity(&self) -> f64 {
        self.number("porosity", self.system.porosity.unwrap_or(RANDOM_PACKING))
    }

    /// The height of the settled bed, else of the grains at this porosity.
    pub fn bed_height(&self, porosity: f64) -> Option<f64> {
        self.system.bed_height.or(self.system.solids_height.map(|s| s / (1.0 - porosity)))
    }

    /// The mean diameter of the grains.
    pub fn diameter(&mut self) -> f64 {
        self.needed("diameter", self.system.grain_diameter, ", or describe grains")
    }

    /// The density of the grains.
    pub fn grain_density(&mut self) -> f64 {
        self.needed("grain_density", self.system.grain_density, ", or describe grains")
    }

    /// The viscosity of a fluid that must be there.
    pub fn viscosity(&mut self) -> f64 {
        self.system.viscosity.unwrap_or_else(|| {
            self.refusals
                .push(("viscosity", "not given: the bed moves against a fluid, add a [fluid] table".into()));
            f64::NAN
        })
    }

    /// The bed equation.
    pub fn bed_equation(&self, default: BedEquation) -> BedEquation {
        self.table.text_opt("bed_equation").and_then(BedEquation::from_name).unwrap_or(default)
    }

    /// The specification, if nothing was missing.
    pub fn done<T>(self, spec: T) -> Result<T, Refusals> {
        if self.refusals.is_empty() { Ok(spec) } else { Err(self.refusals) }
    }
}

/// Judges a specification and notes every key at fault.
#[derive(Default)]
pub(crate) struct Judge(Refusals);

impl Judge {
    /// Notes a refusal unless `holds`.
    pub fn demand(&mut self, holds: bool, key: &'static str, reason: impl FnOnce() -> String) {
        if !holds {
            self.0.push((key, reason()));
        }
    }

    /// Gravity must pull down; `without` says what happens otherwise.
    pub fn gravity(&mut self, gravity: f64, without: &str) {
        let holds = gravity > 0.0 && gravity.is_finite();
        self.demand(holds, "gravity", || format!("is {gravity} m/s²: without gravity {without}"));
    }

    /// The floor must throw the bed in a way the model can follow.
    pub fn shake(&mut self, shake: &Motion, gravity: f64) {
        if let Err(reason) = Shake::new(shake, gravity) {
            self.0.push(("gamma", reason));
        }
    }

    /// Values above zero, with their units.
    pub fn positive<const N: usize>(&mut self, values: [(f64, &'static str, &str); N]) {
        for (x, key, unit) in values {
            let holds = x > 0.0 && x.is_finite();
            self.demand(holds, key, || {
                format!("is {x} {unit}, must be greater than zero").replace("  ", " ")
            });
        }
    }

    /// Values of zero or more, with their units.
    pub fn not_negative<const N: usize>(&mut self, values: [(f64, &'static str, &str); N]) {
        for (x, key, unit) in values {
            let holds = x >= 0.0 && x.is_finite();
            self.demand(holds, key, || format!("is {x} {unit}, must be zero or greater").replace("  ", " "));
        }
    }

    /// Porosity is a fraction.
    pub fn porosity(&mut self, x: f64) {
        self.demand(x > 0.0 && x < 1.0, "porosity", || {
            format!("is {x}, must lie between 0 and 1: it is the fluid fraction of the bed")
        });
    }

    /// The fluid must be lighter than the grains.
    pub fn sinks(&mut self, fluid: f64, grains: f64) {
        self.demand(fluid < grains, "density", || {
            format!("of the fluid ({fluid} kg/m³) is not below that of the grains ({grains} kg/m³): such a bed floats")
        });
    }

    /// A bed of `height` (m) must fit into the cell, if that is known.
    pub fn fits(&mut self, key: &'static str, height: f64, cell: Option<f64>) {
        if let Some(cell) = cell {
            self.demand(height <= cell, key, || {
                format!("puts the bed to {height} m and the cell is {cell} m high")
            });
        }
    }

    /// The relative error of an integration step.
    pub fn tolerance(&mut self, x: f64) {
        self.demand((1e-13..=1e-3).contains(&x), "tolerance", || {
            format!("is {x}, must lie between 1e-13 and 1e-3")
        });
    }

    /// A count of at least `least`.
    pub fn count(&mut self, n: u32, least: u32, key: &'static str) {
        self.demand(n >= least, key, || format!("must be at least {least}"));
    }

    /// `Ok` if nothing was refused.
    pub fn verdict(self) -> Result<(), Refusals> {
        if self.0.is_empty() { Ok(()) } else { Err(self.0) }
    }
}

/// The refusal of an integration that came to a standstill at time `t`, s.
pub(crate) fn stalled(t: f64) -> Refusals {
    vec![(
        "tolerance",
        format!("the integration came to a standstill at t = {t:.6} s: try another tolerance"),
    )]
}

/// What a model hands over for the run directory.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// Plots, the most telling first.
    pub figures: Vec<Figure>,
    /// Tables under their file names.
    pub tables: Vec<(String, Table)>,
}

//! What a model needs from the rest of the case, and what it hands back.

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

impl System {
    /// The porosity: the model's table, else the settled bed, else random packing.
    pub(crate) fn porosity(&self, table: &Values) -> f64 {
        table.number_opt("porosity").or(self.porosity).unwrap_or(RANDOM_PACKING)
    }

    /// The height: the model's table, else the settled bed, else the grains at this porosity.
    pub(crate) fn height(&self, table: &Values, porosity: f64) -> Option<f64> {
        let packed = self.solids_height.map(|s| s / (1.0 - porosity));
        table.number_opt("height").or(self.bed_height).or(packed)
    }
}

/// Takes a value that must be there from somewhere; notes its absence otherwise.
pub(crate) fn need(value: Option<f64>, key: &'static str, remedy: &str, refusals: &mut Refusals) -> f64 {
    value.unwrap_or_else(|| {
        refusals.push((key, format!("not given: {remedy}")));
        f64::NAN
    })
}

/// Notes a refusal unless `holds`.
pub(crate) fn demand(
    holds: bool,
    key: &'static str,
    reason: impl FnOnce() -> String,
    refusals: &mut Refusals,
) {
    if !holds {
        refusals.push((key, reason()));
    }
}

/// `Ok` if nothing was refused.
pub(crate) fn verdict(refusals: Refusals) -> Result<(), Refusals> {
    if refusals.is_empty() { Ok(()) } else { Err(refusals) }
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

//! What a case may say in `[simple-drag]`.

use super::{Porosity, SimpleDrag, Superficial};
use crate::body::Body;
use brazilnut_base::keys::{Check, Key, Kind};
use brazilnut_base::menu::Entry;
use brazilnut_base::units::Dimension;
use brazilnut_base::values::Values;
use brazilnut_bed::bed_equation::{self, BedEquation};

/// What `superficial` may name.
pub const SUPERFICIAL: &[Entry] = &[
    Entry {
        name: "u",
        summary: "No net flux through a section of the bed, as under a thrown plug.",
        formula: "V0 = -u",
        source: "Kroll 1954; Clément eq. 2.45",
    },
    Entry {
        name: "phi-u",
        summary: "The fluid in the pores is at rest.",
        formula: "V0 = -phi u",
        source: "Clément 2.4.2 with v = 0",
    },
];

/// Keys of `[simple-drag]`.
pub const KEYS: &[Key] = &[
    Key::default(
        "bed_equation",
        Kind::Choice(bed_equation::menu::MENU),
        "\"ergun\"",
        "Pressure gradient of the bed.",
    ),
    // 0.42 is a random packing of equal spheres (Clément 2.4.1).
    Key::default(
        "porosity",
        Kind::QuantityOr(Dimension::NONE, &["local"]),
        "0.42",
        "Fluid fraction of the bed, or \"local\": mapped from the grains.",
    )
    .with(Check::Inside(0.0, 1.0)),
    Key::default(
        "superficial",
        Kind::Choice(SUPERFICIAL),
        "\"u\"",
        "Superficial velocity of the fluid at rest.",
    ),
    Key::default(
        "mapping_diameters",
        Kind::Quantity(Dimension::NONE),
        "3",
        "Edge of the cells of a local porosity in mean diameters.",
    )
    .with(Check::Positive),
    Key::default("refresh", Kind::Integer, "10", "Steps between two mappings of a local porosity.")
        .with(Check::Positive),
];

impl SimpleDrag {
    /// The rung from a table with [`KEYS`], for grains of mean `diameter` (m) per species.
    #[must_use]
    pub fn read(values: &Values, density: f64, viscosity: f64, diameter: Vec<f64>, body: Body) -> Self {
        let mean = diameter.iter().sum::<f64>() / diameter.len().max(1) as f64;
        let porosity = values.number_opt("porosity").map_or(
            Porosity::Local {
                spacing: values.number("mapping_diameters") * mean,
                refresh: values.integer("refresh").max(1) as u64,
            },
            Porosity::Fixed,
        );
        let superficial = match values.text("superficial") {
            "phi-u" => Superficial::PhiU,
            _ => Superficial::U,
        };
        let equation = BedEquation::from_name(values.text("bed_equation")).unwrap_or(BedEquation::Ergun);
        Self { equation, porosity, superficial, density, viscosity, diameter, body }
    }
}

//! The ways of placing that a case may name.

use super::{Filling, PackingError, expansion, insertion, lattice};
use crate::Grains;
use brazilnut_base::keys::{Absent, Check, Key, Kind};
use brazilnut_base::menu::Entry;
use brazilnut_base::units::Dimension;
use brazilnut_base::values::Values;
use serde::{Deserialize, Serialize};

/// How grains get their places. Positions from a file take another road: [`super::read_csv`] and [`super::from_list`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Placement {
    /// Cubic lattice with jitter.
    Lattice {
        /// Free gap between sites over the largest diameter.
        gap: f64,
        /// Largest shift over half the gap, 0 to 1.
        jitter: f64,
        /// Species mixed at random, or layer by layer as listed.
        mixed: bool,
    },
    /// Random insertion without overlap.
    Random,
    /// Random points whose grains grow until they have their size.
    Expansion,
    /// A loose random column that falls.
    Rain {
        /// Downward speed, m/s.
        speed: f64,
        /// Species mixed at random, or layer by layer as listed.
        mixed: bool,
    },
}

impl Placement {
    /// Places the grains.
    ///
    /// # Errors
    /// [`PackingError`] with cause and remedy.
    pub fn place(&self, filling: &Filling) -> Result<Grains, PackingError> {
        match *self {
            Self::Lattice { gap, jitter, mixed } => lattice::lattice(filling, gap, jitter, mixed),
            Self::Random => insertion::random(filling),
            Self::Expansion => expansion::expansion(filling),
            Self::Rain { speed, mixed } => insertion::rain(filling, speed, mixed),
        }
    }

    /// The choice from a table with [`PLACEMENT_KEYS`]; `None` if it names positions from a file.
    #[must_use]
    pub fn read(values: &Values) -> Option<Self> {
        let mixed = values.flag("mixed");
        Some(match values.text("placement") {
            "lattice" => Self::Lattice { gap: values.number("gap"), jitter: values.number("jitter"), mixed },
            "random" => Self::Random,
            "expansion" => Self::Expansion,
            "rain" => Self::Rain { speed: values.number("speed"), mixed },
            _ => return None,
        })
    }
}

/// The menu.
pub const PLACEMENTS: &[Entry] = &[
    Entry {
        name: "lattice",
        summary: "cubic lattice from the floor up, each grain shifted at random within its gap",
        formula: "pitch (1 + gap) d_max, shift <= jitter gap d_max/2",
        source: "Clément 2009, 3.2",
    },
    Entry {
        name: "random",
        summary: "random insertion without overlap, large grains first; up to solids fraction 0.35",
        formula: "",
        source: "random sequential addition",
    },
    Entry {
        name: "expansion",
        summary: "random points whose grains grow and push each other apart until all have their size",
        formula: "r_i(0) = min(R_i, R_i/(R_i + R_j) r_ij) to the nearest neighbour j, then dr_i/dt = const",
        source: "Lan 1994, 2.2",
    },
    Entry {
        name: "rain",
        summary: "a loose random column over the floor that falls at a given speed, to be settled",
        formula: "",
        source: "",
    },
    Entry {
        name: "file",
        summary: "positions, radii and velocities from CSV with a header or extended XYZ",
        formula: "",
        source: "",
    },
];

/// Keys of the table that says how grains are placed.
pub const PLACEMENT_KEYS: &[Key] = &[
    Key::default("placement", Kind::Choice(PLACEMENTS), "\"lattice\"", "How the grains get their places."),
    Key::default(
        "gap",
        Kind::Quantity(Dimension::NONE),
        "0.05",
        "Lattice: gap between sites over the largest diameter.",
    )
    .with(Check::NonNegative),
    Key::default(
        "jitter",
        Kind::Quantity(Dimension::NONE),
        "1.0",
        "Lattice: random shift over half the gap.",
    )
    .with(Check::Between(0.0, 1.0)),
    Key::default("speed", Kind::Quantity(Dimension::VELOCITY), "0.0", "Rain: downward speed.")
        .with(Check::NonNegative),
    Key::default(
        "mixed",
        Kind::Flag,
        "true",
        "Lattice and rain: species mixed at random; otherwise layers in the order listed.",
    ),
    Key::optional("file", Kind::Text, "File: path of a `.csv` or `.xyz`, relative to the case."),
];

const CLASS_KEYS: &[Key] = &[
    Key::required("diameter", Kind::Quantity(Dimension::LENGTH), "Diameter.").with(Check::Positive),
    Key::required("share", Kind::Quantity(Dimension::NONE), "Share of the number of grains.")
        .with(Check::NonNegative),
];

/// Keys of a diameter; a bare value is the mean.
pub const DIAMETER_KEYS: &[Key] = &[
    Key::optional("mean", Kind::Quantity(Dimension::LENGTH), "Mean diameter.").with(Check::Positive),
    Key {
        name: "spread",
        kind: Kind::Quantity(Dimension::NONE),
        absent: Absent::Nothing,
        check: Check::Between(0.0, 0.99),
        doc: "Half-width over mean of an even distribution; 0 if left out.",
    },
    Key::optional("standard_deviation", Kind::Quantity(Dimension::LENGTH), "Of a normal distribution.")
        .with(Check::Positive),
    Key::optional(
        "minimum",
        Kind::Quantity(Dimension::LENGTH),
        "Lower bound of the normal distribution; mean - 3 deviations if left out.",
    )
    .with(Check::Positive),
    Key::optional(
        "maximum",
        Kind::Quantity(Dimension::LENGTH),
        "Upper bound of the normal distribution; mean + 3 deviations if left out.",
    )
    .with(Check::Positive),
    Key::optional(
        "classes",
        Kind::Tables(CLASS_KEYS),
        "Diameters with their shares of the number of grains.",
    ),
];

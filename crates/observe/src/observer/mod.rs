//! What every observer is, and the choices a case may make.

pub mod menu;

mod base_pressure;
mod bed;
mod collisions;
mod convection;
mod diffusion;
mod energy;
mod field;
mod flow;
mod flow_energy;
mod flow_field;
mod gap;
mod layers;
mod mixing;
mod probe;
mod profile;
mod radial;
mod rise;
mod streamfunction;
mod surface;
mod trajectory;
mod walls;
mod zone_stats;

use crate::view::{Needs, View};
use crate::zones::Direction;
use brazilnut_base::figure::Figure;
use brazilnut_base::keys::{Check, Key, Kind};
use brazilnut_base::menu::Entry;
use brazilnut_base::units::Dimension;
use brazilnut_base::values::Values;
use brazilnut_base::{Cell, Column, Table, Vec3};
use brazilnut_grains::Grains;
use serde::{Deserialize, Serialize};

/// What a case fixes before the first step.
#[derive(Clone, Copy, Debug)]
pub struct Setting<'a> {
    /// The cell.
    pub cell: &'a Cell,
    /// Names of the species with their numbers of grains, by index.
    pub species: &'a [(String, usize)],
    /// Names of the walls, by index.
    pub walls: &'a [String],
    /// Names of the ledger's entries.
    pub ledger: &'a [&'static str],
    /// Shaking frequency, Hz.
    pub frequency: Option<f64>,
    /// Steps in a shake cycle.
    pub steps_per_cycle: Option<u64>,
    /// Time step, s.
    pub dt: f64,
    /// Steps from time 0 to the end of the run.
    pub steps: u64,
    /// Acceleration of gravity, m/s².
    pub gravity: Vec3,
    /// Mean diameter of all grains, m.
    pub mean_diameter: f64,
    /// Largest diameter, m.
    pub largest_diameter: f64,
    /// True if there is a fluid with a flow field.
    pub has_flow: bool,
    /// Seed of the run.
    pub seed: u64,
    /// When the observer in question samples; filled in by [`crate::Watch`].
    pub sampling: Sampling,
}

/// When an observer samples.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Sampling {
    /// Time between two samples, s.
    pub interval: f64,
    /// Samples in a shake cycle, if that is a whole number.
    pub per_cycle: Option<u64>,
    /// Shake cycles between two samples, if that is a whole number.
    pub cycles: Option<u64>,
    /// Phase of the first sample in a cycle, in cycles.
    pub phase: f64,
}

/// Key and message of everything that is wrong with a table.
pub type Faults = Vec<(String, String)>;

/// One way of looking at a run.
///
/// Implementors are saved with the run: plain data, nothing skipped.
pub trait Observe: Sized {
    /// Name, definition with formula and units, source.
    const ENTRY: Entry;
    /// Its own keys, beside [`crate::watch::COMMON`].
    const KEYS: &'static [Key];

    /// Reads its table.
    ///
    /// # Errors
    /// Everything that is wrong, by key.
    fn from_values(values: &Values, setting: &Setting) -> Result<Self, Faults>;

    /// What must be prepared beside the grains.
    fn needs(&self) -> Needs {
        Needs::default()
    }

    /// Columns of its series; none if it keeps no series.
    fn columns(&self) -> Vec<Column> {
        vec![]
    }

    /// Takes a sample: a row of the series, if there is one.
    fn observe(&mut self, view: &View) -> Option<Vec<f64>>;

    /// Means with errors, profiles, fields, spectra.
    fn results(&self) -> Vec<(String, Table)> {
        vec![]
    }

    /// Plots for the report; `series` holds the rows returned so far.
    fn figures(&self, series: &Table) -> Vec<Figure> {
        let _ = series;
        vec![]
    }
}

/// Which grains.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Selection {
    /// All of them.
    All,
    /// Those of a species, by index.
    Species(u16),
}

impl Selection {
    /// Reads the key `of`; all grains without it.
    ///
    /// # Errors
    /// The species is not in the case.
    pub fn read(values: &Values, setting: &Setting) -> Result<Self, Faults> {
        let Some(name) = values.text_opt("of") else { return Ok(Self::All) };
        species_index(setting, name).map(Self::Species).ok_or_else(|| vec![unknown_species(setting, name)])
    }

    /// Whether grain `k` is meant.
    #[must_use]
    pub fn takes(self, grains: &Grains, k: usize) -> bool {
        match self {
            Self::All => true,
            Self::Species(s) => grains.species[k] == s,
        }
    }

    /// How many grains a case of this `setting` has of them.
    #[must_use]
    pub fn count(self, setting: &Setting) -> usize {
        match self {
            Self::All => setting.species.iter().map(|s| s.1).sum(),
            Self::Species(s) => setting.species[usize::from(s)].1,
        }
    }
}

fn species_index(setting: &Setting, name: &str) -> Option<u16> {
    setting.species.iter().position(|s| s.0 == name).map(|k| k as u16)
}

fn unknown_species(setting: &Setting, name: &str) -> (String, String) {
    let known: Vec<&str> = setting.species.iter().map(|s| s.0.as_str()).collect();
    let near = brazilnut_base::menu::nearest(name, known.iter().copied());
    let hint = near.map_or_else(String::new, |n| format!("; did you mean `{n}`?"));
    ("of".into(), format!("no grains are called `{name}` (there are: {}){hint}", known.join(", ")))
}

/// Keys of the columns across the cell that some observers stand in.
pub(crate) const COLUMNS: [Key; 2] = [
    Key::default("across", Kind::Word(&["x", "y"]), "\"x\"", "Direction along which the columns stand."),
    Key::optional(
        "size",
        Kind::Quantity(Dimension::LENGTH),
        "Width of a column, adjusted to divide the cell evenly; two mean diameters if left out.",
    )
    .with(Check::Positive),
];

/// The columns of [`COLUMNS`].
pub(crate) fn columns_across(values: &Values, setting: &Setting) -> Result<Direction, Faults> {
    let axis = usize::from(values.text("across") == "y");
    if setting.cell.flat_axis() == Some(axis) {
        return Err(vec![("across".into(), format!("the cell has no extent along {}", AXES[axis]))]);
    }
    let size = values.number_opt("size").unwrap_or(2.0 * setting.mean_diameter);
    let columns = Direction::across(setting.cell, axis, size);
    few_enough(columns.count)?;
    Ok(columns)
}

/// More zones than this would take hundreds of megabytes of sums.
const MOST_ZONES: usize = 200_000;

/// Refuses a `size` that makes too many zones.
pub(crate) fn few_enough(zones: usize) -> Result<(), Faults> {
    if zones <= MOST_ZONES {
        return Ok(());
    }
    Err(vec![("size".into(), format!("{zones} zones are too many (at most {MOST_ZONES})"))])
}

/// Letters of the axes.
pub(crate) const AXES: [&str; 3] = ["x", "y", "z"];

/// The two axes of a plane named `xz`, `yz` or `xy`.
pub(crate) fn plane_axes(plane: &str) -> [usize; 2] {
    match plane {
        "xy" => [0, 1],
        "yz" => [1, 2],
        _ => [0, 2],
    }
}

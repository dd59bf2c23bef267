//! What profiles and fields share: sums over zones with their errors.

use super::{Faults, Selection, Setting, few_enough};
use crate::accumulate::{Batched, Estimate};
use crate::view::View;
use crate::zones::Zones;
use crate::zones::sums::{self, Frame, QUANTITIES, SUMS, Weight};
use brazilnut_base::keys::{Key, Kind};
use brazilnut_base::values::Values;
use brazilnut_base::{Column, Table};
use serde::{Deserialize, Serialize};

/// A key that both have.
pub const FRAME: Key = Key::default(
    "frame",
    Kind::Word(&["cell", "floor"]),
    "\"cell\"",
    "Frame of places and velocities: the cell's, or that of a floor that moves alone.",
);

/// The other one.
pub const WEIGHT: Key = Key::default(
    "weight",
    Kind::Word(&["volume", "centre"]),
    "\"volume\"",
    "Where a grain counts: in every zone by the fraction of its volume there, or as a whole in the zone of its centre.",
);

/// From so many zones on, errors have to come from fewer batches.
const MANY: usize = 10_000;

/// Sums over zones and samples.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ZoneStats {
    pub of: Selection,
    pub zones: Zones,
    pub frame: Frame,
    pub weight: Weight,
    pub flat: bool,
    pub sums: Batched,
}

impl ZoneStats {
    /// Reads what both observers have in common.
    pub fn new(values: &Values, setting: &Setting, zones: Zones) -> Result<Self, Faults> {
        few_enough(zones.len())?;
        let frame = if values.text("frame") == "floor" { Frame::Floor } else { Frame::Cell };
        Ok(Self {
            of: Selection::read(values, setting)?,
            frame,
            weight: if values.text("weight") == "centre" { Weight::Centre } else { Weight::Volume },
            flat: setting.cell.flat_axis().is_some(),
            sums: Batched::new(
                SUMS * zones.len(),
                if zones.len() > MANY { 4 } else { 16 },
                setting.sampling.per_cycle.unwrap_or(1),
            ),
            zones,
        })
    }

    /// Takes a sample and returns its sums.
    pub fn sample(&mut self, view: &View) -> Vec<f64> {
        let now = sums::at(view, &self.zones, self.of, self.frame, self.weight);
        self.sums.add(&now);
        now
    }

    /// All quantities from sums over `samples` samples, zone by zone.
    pub fn quantities(&self, sums: &[f64], samples: f64, out: &mut [f64]) {
        for (k, (s, o)) in sums.chunks_exact(SUMS).zip(out.chunks_exact_mut(QUANTITIES.len())).enumerate() {
            sums::derive(s, samples, self.zones.volume(k), self.flat, o);
        }
    }

    /// Long-term means with errors, zone by zone.
    pub fn means(&self) -> Vec<Vec<Estimate>> {
        let all =
            self.sums.estimates(self.zones.len() * QUANTITIES.len(), |s, n, out| self.quantities(s, n, out));
        all.chunks(QUANTITIES.len()).map(<[Estimate]>::to_vec).collect()
    }

    /// Means over the whole cell, fluctuations still about the mean velocity of each zone: one row.
    pub fn cell(&self) -> Table {
        let volume: f64 = (0..self.zones.len()).map(|k| self.zones.volume(k)).sum();
        let means = self.sums.estimates(QUANTITIES.len(), |s, n, out| {
            let mut all = [0.0; SUMS];
            for zone in s.chunks_exact(SUMS) {
                all.iter_mut().zip(zone).for_each(|(a, x)| *a += x);
            }
            sums::derive(&all, n, volume, self.flat, out);
        });
        let mut t = Table::default();
        for (name, unit) in QUANTITIES {
            t.columns.push(Column::new(*name, *unit));
            t.columns.push(Column::new(format!("{name}_error"), *unit));
        }
        t.rows.push(means.iter().flat_map(|e| [e.value, e.error]).collect());
        t
    }

    /// The long-term means as a table: coordinates, then each quantity with its error.
    pub fn table(&self, means: &[Vec<Estimate>]) -> Table {
        let mut columns: Vec<(String, &str)> =
            self.zones.coordinates().iter().map(|c| ((*c).to_string(), "m")).collect();
        for (name, unit) in QUANTITIES {
            columns.push(((*name).to_string(), unit));
            columns.push((format!("{name}_error"), unit));
        }
        let columns: Vec<(&str, &str)> = columns.iter().map(|(n, u)| (n.as_str(), *u)).collect();
        let mut t = Table::new(&columns);
        for (k, zone) in means.iter().enumerate() {
            let mut row = self.zones.centre(k);
            row.extend(zone.iter().flat_map(|e| [e.value, e.error]));
            t.rows.push(row);
        }
        t
    }
}

/// Place of a quantity among [`QUANTITIES`].
pub fn place(name: &str) -> usize {
    QUANTITIES.iter().position(|q| q.0 == name).unwrap_or(0)
}

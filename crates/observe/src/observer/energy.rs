//! The energy ledger as a series.

use super::{Faults, Observe, Setting};
use crate::view::View;
use brazilnut_base::figure::{Axis, Body, Curve, Figure};
use brazilnut_base::keys::Key;
use brazilnut_base::menu::Entry;
use brazilnut_base::values::Values;
use brazilnut_base::{Column, Table};
use serde::{Deserialize, Serialize};

/// The ledger, entry by entry.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Energy {
    names: Vec<String>,
}

impl Observe for Energy {
    const ENTRY: Entry = Entry {
        name: "energy",
        summary: "The energy ledger: work put in, energy held, energy lost, each summed per contact and per wall (J).",
        formula: "one column per entry of the ledger, cumulative since time 0 (energies held: at the instant)",
        source: "",
    };

    const KEYS: &'static [Key] = &[];

    fn from_values(_: &Values, setting: &Setting) -> Result<Self, Faults> {
        Ok(Self { names: setting.ledger.iter().map(|n| (*n).to_string()).collect() })
    }

    fn columns(&self) -> Vec<Column> {
        self.names.iter().map(|n| Column::new(n, "J")).collect()
    }

    fn observe(&mut self, view: &View) -> Option<Vec<f64>> {
        let value = |name: &String| view.ledger.iter().find(|e| e.0 == name).map_or(f64::NAN, |e| e.1);
        Some(self.names.iter().map(value).collect())
    }

    fn figures(&self, series: &Table) -> Vec<Figure> {
        let curves = self
            .names
            .iter()
            .filter_map(|n| Some(Curve::line(n.replace('_', " "), super::bed::pairs(series, n)?)))
            .collect();
        vec![Figure {
            title: "Energy ledger".into(),
            caption: "Each entry is summed where the energy is spent, none is the remainder of the others."
                .into(),
            body: Body::Curves { x: Axis::linear("time", "s"), y: Axis::linear("energy", "J"), curves },
        }]
    }
}

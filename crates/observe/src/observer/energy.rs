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
        let all: Vec<Curve> = self
            .names
            .iter()
            .filter_map(|n| Some(Curve::line(n.replace('_', " "), super::bed::pairs(series, n)?)))
            .collect();
        let size = |c: &Curve| c.points.iter().map(|p| p[1].abs()).fold(0.0, f64::max);
        let largest = all.iter().map(size).fold(0.0, f64::max);
        let (curves, small): (Vec<Curve>, Vec<Curve>) =
            all.into_iter().partition(|c| size(c) > 0.0 && size(c) >= SMALLEST * largest);
        let (zero, small): (Vec<&Curve>, Vec<&Curve>) = small.iter().partition(|c| size(c) == 0.0);
        let mut caption =
            "Each entry is summed where the energy is spent, none is the remainder of the others."
                .to_string();
        let list = |curves: &[&Curve], text: fn(&str, f64) -> String| {
            curves.iter().map(|c| text(&c.label, size(c))).collect::<Vec<_>>().join(", ")
        };
        if !small.is_empty() {
            let list = list(&small, |label, size| format!("{label} ({size:.1e} J at most)"));
            caption.push_str(&format!(" Too small to draw: {list}."));
        }
        if !zero.is_empty() {
            caption.push_str(&format!(" Zero throughout: {}.", list(&zero, |label, _| label.into())));
        }
        vec![Figure {
            title: "Energy ledger".into(),
            caption,
            body: Body::Curves { x: Axis::linear("time", "s"), y: Axis::linear("energy", "J"), curves },
        }]
    }
}

/// Entries that stay below this part of the largest would lie on the axis: they are named, not drawn.
const SMALLEST: f64 = 1e-3;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_cannot_be_seen_is_named() {
        let names = ["work", "elastic", "rotation"].map(String::from);
        let mut series = Table::new(&[("time", "s"), ("work", "J"), ("elastic", "J"), ("rotation", "J")]);
        series.rows = vec![vec![0.0, 0.0, 1e-5, 0.0], vec![1.0, -2.0, 3e-5, 0.0]];
        let figure = Energy { names: names.to_vec() }.figures(&series).remove(0);
        let Body::Curves { curves, .. } = figure.body else { panic!("curves") };
        assert_eq!(curves.iter().map(|c| &*c.label).collect::<Vec<_>>(), ["work"]);
        assert!(figure.caption.contains("elastic (3.0e-5 J at most)"), "{}", figure.caption);
        assert!(figure.caption.contains("Zero throughout: rotation."), "{}", figure.caption);
    }
}

//! Height of chosen grains: the intruder.

use super::{Faults, Observe, Selection, Setting};
use crate::height;
use crate::view::View;
use brazilnut_base::figure::{Axis, Body, Curve, Figure};
use brazilnut_base::keys::{Check, Key, Kind};
use brazilnut_base::menu::Entry;
use brazilnut_base::units::Dimension;
use brazilnut_base::values::Values;
use brazilnut_base::{Column, Table};
use serde::{Deserialize, Serialize};

/// How high the chosen grains stand, and how deep below the surface of the others.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Rise {
    of: Selection,
    percentile: f64,
}

impl Observe for Rise {
    const ENTRY: Entry = Entry {
        name: "height",
        summary: "Height of chosen grains above the floor and their depth below the surface of the bed: the rise of an intruder.",
        formula: "height = sum(m z)/sum(m) of the chosen centres above the floor (m); lowest, highest: the same of single grains\n\
                  surface: height below which lie the tops of a fraction `percentile` of the mass of the other grains (m)\n\
                  depth = surface - (highest centre + its radius) (m), negative once a grain stands out; velocity_z: mean, mass-weighted (m/s)",
        source: "Clément 2009, 6.4; Lan 1994, 5.2",
    };

    const KEYS: &'static [Key] = &[Key::default(
        "percentile",
        Kind::Quantity(Dimension::NONE),
        "0.95",
        "Fraction of the mass of the others under the surface.",
    )
    .with(Check::Inside(0.5, 1.0))];

    fn from_values(values: &Values, setting: &Setting) -> Result<Self, Faults> {
        Ok(Self { of: Selection::read(values, setting)?, percentile: values.number("percentile") })
    }

    fn columns(&self) -> Vec<Column> {
        [
            ("height", "m"),
            ("lowest", "m"),
            ("highest", "m"),
            ("surface", "m"),
            ("depth", "m"),
            ("velocity_z", "m/s"),
        ]
        .map(|(n, u)| Column::new(n, u))
        .to_vec()
    }

    fn observe(&mut self, view: &View) -> Option<Vec<f64>> {
        let g = view.grains;
        let floor = view.floor_height();
        let (mut mass, mut moment, mut momentum) = (0.0, 0.0, 0.0);
        let (mut low, mut high, mut top) = (f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY);
        let mut others = vec![];
        for k in 0..g.len() {
            let (z, r) = (g.position[k].z - floor, g.radius[k]);
            if self.of.takes(g, k) {
                mass += g.mass[k];
                moment += g.mass[k] * z;
                momentum += g.mass[k] * g.velocity[k].z;
                (low, high, top) = (low.min(z), high.max(z), top.max(z + r));
            } else {
                others.push((z + r, g.mass[k]));
            }
        }
        let surface = height::quantile(&mut others, self.percentile);
        Some(vec![moment / mass, low, high, surface, surface - top, momentum / mass])
    }

    fn figures(&self, series: &Table) -> Vec<Figure> {
        let curve =
            |column: &str, label: &str| super::bed::pairs(series, column).map(|p| Curve::line(label, p));
        vec![Figure {
            title: "Height of the chosen grains".into(),
            caption: format!(
                "Centre of the chosen grains above the floor, and the surface of the others: {:.0} % of their mass has its top below.",
                100.0 * self.percentile
            ),
            body: Body::Curves {
                x: Axis::linear("time", "s"),
                y: Axis::linear("height", "m"),
                curves: [curve("height", "chosen grains"), curve("surface", "surface")]
                    .into_iter()
                    .flatten()
                    .collect(),
            },
        }]
    }
}

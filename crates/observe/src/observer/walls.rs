//! Forces of the grains on the walls.

use super::{AXES, Faults, Observe, Setting};
use crate::view::View;
use brazilnut_base::figure::{Axis, Body, Curve, Figure};
use brazilnut_base::keys::Key;
use brazilnut_base::menu::Entry;
use brazilnut_base::values::Values;
use brazilnut_base::{Column, Table};
use serde::{Deserialize, Serialize};

/// Wall forces as a series.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Walls {
    names: Vec<String>,
}

impl Observe for Walls {
    const ENTRY: Entry = Entry {
        name: "walls",
        summary: "Force of the grains on every wall, the base among them.",
        formula: "sum over the contacts with a wall of the force on it (N); z up",
        source: "",
    };

    const KEYS: &'static [Key] = &[];

    fn from_values(_: &Values, setting: &Setting) -> Result<Self, Faults> {
        Ok(Self { names: setting.walls.to_vec() })
    }

    fn columns(&self) -> Vec<Column> {
        let of = |n: &String| AXES.map(|a| Column::new(format!("{}_force_{a}", n.replace('-', "_")), "N"));
        self.names.iter().flat_map(of).collect()
    }

    fn observe(&mut self, view: &View) -> Option<Vec<f64>> {
        let force = |n: &String| {
            view.walls.iter().find(|w| w.name == n).map_or([f64::NAN; 3], |w| w.force.to_array())
        };
        Some(self.names.iter().flat_map(force).collect())
    }

    fn figures(&self, series: &Table) -> Vec<Figure> {
        let curves = series
            .columns
            .iter()
            .filter(|c| c.name.ends_with("force_z"))
            .filter_map(|c| Some(Curve::line(c.name.replace('_', " "), super::bed::pairs(series, &c.name)?)))
            .collect();
        vec![Figure {
            title: "Vertical force on the walls".into(),
            caption: "Force of the grains on each wall at the sampled instants; positive upwards.".into(),
            body: Body::Curves { x: Axis::linear("time", "s"), y: Axis::linear("force", "N"), curves },
        }]
    }
}

//! Paths of chosen grains.

use super::{AXES, Faults, Observe, Selection, Setting};
use crate::view::{Needs, Partner, View};
use brazilnut_base::figure::{Axis, Body, Curve, Figure};
use brazilnut_base::keys::{Key, Kind};
use brazilnut_base::menu::Entry;
use brazilnut_base::values::{Value, Values};
use brazilnut_base::{Column, Table};
use serde::{Deserialize, Serialize};

/// Position, velocity and coordination of chosen grains.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trajectory {
    of: Selection,
    /// Identities; those of a species are found in the first sample.
    grains: Vec<u32>,
    count: usize,
}

/// More columns than this nobody reads; all grains together are what the grain files hold.
const MOST: usize = 100;

impl Observe for Trajectory {
    const ENTRY: Entry = Entry {
        name: "trajectory",
        summary: "Paths of chosen grains: position, velocity, number of contacts.",
        formula: "x, y without periodic jumps (m); height: centre above the floor (m); velocities in the frame of the cell (m/s); \
                  contacts: grains and walls touched",
        source: "Lan 1994, Figs A5.12-A5.17",
    };

    const KEYS: &'static [Key] = &[Key::optional(
        "grains",
        Kind::List(&Kind::Integer),
        "Identities of the grains, from 0 in the order of the case; instead of `of`.",
    )];

    fn from_values(values: &Values, setting: &Setting) -> Result<Self, Faults> {
        let of = Selection::read(values, setting)?;
        let total = Selection::All.count(setting);
        let mut grains = vec![];
        for v in values.list("grains") {
            match v {
                Value::Integer(k) if (0..total as i64).contains(k) => grains.push(*k as u32),
                other => {
                    let message = format!("identities run from 0 to {}, not {other:?}", total as i64 - 1);
                    return Err(vec![("grains".into(), message)]);
                }
            }
        }
        let count = if grains.is_empty() { of.count(setting) } else { grains.len() };
        if grains.is_empty() && of == Selection::All {
            return Err(vec![(
                "of".into(),
                "say which grains: `of = \"species\"` or `grains = [0, 1]`".into(),
            )]);
        }
        if count > MOST {
            let message = format!(
                "{count} grains are too many for one table (at most {MOST}); name some with `grains = [...]`"
            );
            return Err(vec![("of".into(), message)]);
        }
        Ok(Self { of, grains, count })
    }

    fn needs(&self) -> Needs {
        Needs { contacts: true, flow: false }
    }

    fn columns(&self) -> Vec<Column> {
        let names = [("x", "m"), ("y", "m"), ("height", "m")]
            .into_iter()
            .map(|(n, u)| (n.to_string(), u))
            .chain(AXES.iter().map(|a| (format!("velocity_{a}"), "m/s")))
            .chain([("contacts".to_string(), "1")]);
        let tail = |k: usize| if self.count == 1 { String::new() } else { format!("_{k}") };
        let names: Vec<_> = names.collect();
        (0..self.count)
            .flat_map(|k| names.iter().map(move |(n, u)| (format!("{n}{}", tail(k)), *u)).collect::<Vec<_>>())
            .map(|(n, u)| Column::new(n, u))
            .collect()
    }

    fn observe(&mut self, view: &View) -> Option<Vec<f64>> {
        let g = view.grains;
        if self.grains.is_empty() {
            self.grains = (0..g.len()).filter(|&k| self.of.takes(g, k)).map(|k| k as u32).collect();
        }
        let mut row = Vec::with_capacity(7 * self.count);
        for &id in self.grains.iter().take(self.count) {
            let k = id as usize;
            let (r, v) = (view.unwrapped(k), g.velocity[k]);
            let touching = view.contacts.iter().filter(|c| c.i == id || c.with == Partner::Grain(id)).count();
            row.extend([r.x, r.y, r.z - view.floor_height(), v.x, v.y, v.z, touching as f64]);
        }
        // A species that is not there yet still fills its columns.
        row.resize(7 * self.count, f64::NAN);
        Some(row)
    }

    fn figures(&self, series: &Table) -> Vec<Figure> {
        let curves = series
            .columns
            .iter()
            .filter(|c| c.name.starts_with("height"))
            .filter_map(|c| Some(Curve::line(c.name.replace('_', " "), super::bed::pairs(series, &c.name)?)))
            .collect();
        vec![Figure {
            title: "Height of chosen grains".into(),
            caption: "Centre of each grain above the floor.".into(),
            body: Body::Curves { x: Axis::linear("time", "s"), y: Axis::linear("height", "m"), curves },
        }]
    }
}

//! How often grains collide.

use super::{Faults, Observe, Setting};
use crate::view::View;
use brazilnut_base::figure::{Axis, Body, Curve, Figure};
use brazilnut_base::keys::Key;
use brazilnut_base::menu::Entry;
use brazilnut_base::values::Values;
use brazilnut_base::{Column, Table};
use brazilnut_grains::Collisions as Counts;
use serde::{Deserialize, Serialize};

/// Collisions per grain and their rate.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Collisions {
    first: Option<Counts>,
    last: Option<(f64, Counts)>,
}

impl Observe for Collisions {
    const ENTRY: Entry = Entry {
        name: "collisions",
        summary: "Collisions per grain since the first sample, and their rate.",
        formula: "a collision is a contact that begins; each between two grains counts for both\n\
                  collisions_per_grain = (2 grain-grain + grain-wall)/N since the first sample (1)\n\
                  rate: the same between two samples over the time between them (1/s); contacts that last count once",
        source: "Lan 1994, 4.2 (Fig. A4.12)",
    };

    const KEYS: &'static [Key] = &[];

    fn from_values(_: &Values, _: &Setting) -> Result<Self, Faults> {
        Ok(Self { first: None, last: None })
    }

    fn columns(&self) -> Vec<Column> {
        [
            ("collisions_per_grain", "1"),
            ("rate", "Hz"),
            ("rate_between_grains", "Hz"),
            ("rate_with_walls", "Hz"),
        ]
        .map(|(n, u)| Column::new(n, u))
        .to_vec()
    }

    fn observe(&mut self, view: &View) -> Option<Vec<f64>> {
        let n = view.grains.len() as f64;
        let now = view.collisions;
        let first = *self.first.get_or_insert(now);
        let before = self.last.replace((view.tick.time, now));
        let per_grain =
            |a: Counts, b: Counts| (2.0 * (b.grains - a.grains) as f64 / n, (b.walls - a.walls) as f64 / n);
        let (g, w) = per_grain(first, now);
        let (rate_g, rate_w) = before.map_or((f64::NAN, f64::NAN), |(t, counts)| {
            let (g, w) = per_grain(counts, now);
            (g / (view.tick.time - t), w / (view.tick.time - t))
        });
        Some(vec![g + w, rate_g + rate_w, rate_g, rate_w])
    }

    fn figures(&self, series: &Table) -> Vec<Figure> {
        let curve =
            |column: &str, label: &str| super::bed::pairs(series, column).map(|p| Curve::line(label, p));
        let curves = [curve("rate_between_grains", "between grains"), curve("rate_with_walls", "with walls")];
        vec![Figure {
            title: "Collision rate per grain".into(),
            caption: "Contacts that begin per grain and second, between one sample and the next; each between two grains counts for both.".into(),
            body: Body::Curves {
                x: Axis::linear("time", "s"),
                y: Axis::linear("rate", "Hz"),
                curves: curves.into_iter().flatten().collect(),
            },
        }]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthetic::Stage;
    use brazilnut_base::vec3;

    #[test]
    fn counts_for_both_partners_and_from_the_first_sample() {
        let mut stage = Stage::new(vec3(1.0, 1.0, 1.0), "walls");
        (0..4).for_each(|_| stage.add(vec3(0.5, 0.5, 0.5), 0.1));
        let mut c = Collisions { first: None, last: None };
        let mut row = vec![];
        for (t, grains, walls) in [(0.0, 100, 7), (0.5, 110, 9), (1.0, 112, 13)] {
            stage.time = t;
            stage.collisions = Counts { grains, walls };
            row = c.observe(&stage.view()).unwrap();
        }
        // (2*12 + 6)/4 since the start; in the last half second 2*2/4 and 4/4.
        assert_eq!(row, [7.5, 4.0, 2.0, 2.0]);
    }
}

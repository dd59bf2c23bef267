//! The shape of the bed's surface.

use super::{AXES, COLUMNS, Faults, Observe, Selection, Setting, columns_across};
use crate::accumulate::Batched;
use crate::height::quantile;
use crate::view::View;
use crate::zones::Direction;
use brazilnut_base::figure::{Axis, Body, Curve, Figure};
use brazilnut_base::keys::{Check, Key, Kind};
use brazilnut_base::menu::Entry;
use brazilnut_base::units::Dimension;
use brazilnut_base::values::Values;
use brazilnut_base::{Column, Table};
use serde::{Deserialize, Serialize};

/// Height of the bed in columns across the cell.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Surface {
    of: Selection,
    percentile: f64,
    columns: Direction,
    /// Heights, squares apart: sums and counts of columns that hold grains.
    sums: Batched,
}

impl Observe for Surface {
    const ENTRY: Entry = Entry {
        name: "surface",
        summary: "Height of the bed in columns across the cell, its dome and its tilt.",
        formula: "height_k: height above the floor (m) below which lie the tops z + r of a fraction `percentile` of the mass whose centres are in column k\n\
                  dome: mean height of the middle third of the columns minus that of the first and last of all columns (m)\n\
                  tilt: slope of the least-squares line through the heights (1)",
        source: "Clément 2009, Figs 4.1, 4.4, 4.5",
    };

    const KEYS: &'static [Key] = &[
        COLUMNS[0],
        COLUMNS[1],
        Key::default(
            "percentile",
            Kind::Quantity(Dimension::NONE),
            "0.95",
            "Fraction of the mass under the surface.",
        )
        .with(Check::Inside(0.5, 1.0)),
    ];

    fn from_values(values: &Values, setting: &Setting) -> Result<Self, Faults> {
        let columns = columns_across(values, setting)?;
        Ok(Self {
            of: Selection::read(values, setting)?,
            percentile: values.number("percentile"),
            sums: Batched::new(2 * columns.count, 16, setting.sampling.per_cycle.unwrap_or(1)),
            columns,
        })
    }

    fn columns(&self) -> Vec<Column> {
        [("dome", "m"), ("tilt", "1")]
            .into_iter()
            .map(|(n, u)| Column::new(n, u))
            .chain((0..self.columns.count).map(|k| Column::new(format!("height_{k}"), "m")))
            .collect()
    }

    fn observe(&mut self, view: &View) -> Option<Vec<f64>> {
        let g = view.grains;
        let n = self.columns.count;
        let mut tops = vec![vec![]; n];
        for k in (0..g.len()).filter(|&k| self.of.takes(g, k)) {
            let r = g.position[k];
            tops[self.columns.find(r[self.columns.axis])].push((r.z + g.radius[k], g.mass[k]));
        }
        let floor = view.floor_height();
        let heights: Vec<f64> = tops.iter_mut().map(|t| quantile(t, self.percentile) - floor).collect();
        let sums = self.sums.open();
        for (k, h) in heights.iter().enumerate().filter(|(_, h)| h.is_finite()) {
            sums[k] += h;
            sums[n + k] += 1.0;
        }
        let mut row = vec![dome(&heights), tilt(&heights, self.columns.width)];
        row.extend(heights);
        Some(row)
    }

    fn results(&self) -> Vec<(String, Table)> {
        let n = self.columns.count;
        let heights = self.sums.estimates(n, |s, _, out| (0..n).for_each(|k| out[k] = s[k] / s[n + k]));
        let mut t = Table::new(&[(AXES[self.columns.axis], "m"), ("height", "m"), ("height_error", "m")]);
        t.rows =
            heights.iter().enumerate().map(|(k, h)| vec![self.columns.centre(k), h.value, h.error]).collect();
        vec![("mean".into(), t)]
    }

    fn figures(&self, series: &Table) -> Vec<Figure> {
        let (_, mean) = self.results().remove(0);
        let points = mean.rows.iter().map(|r| [r[0], r[1]]).collect();
        let error = mean.rows.iter().map(|r| r[2]).collect();
        let mut curves = vec![Curve { error, ..Curve::line("mean", points) }];
        for (label, row) in [("first sample", series.rows.first()), ("last sample", series.rows.last())] {
            let heights: Option<Vec<[f64; 2]>> = row.map(|r| {
                let tail = &r[r.len() - self.columns.count..];
                tail.iter().enumerate().map(|(k, h)| [self.columns.centre(k), *h]).collect()
            });
            curves.extend(heights.map(|p| Curve::line(label, p)));
        }
        vec![Figure {
            title: "Surface of the bed".into(),
            caption: format!(
                "Height above the floor below which lie the tops of {:.0} % of the mass in each column of {:.3e} m.",
                100.0 * self.percentile,
                self.columns.width
            ),
            body: Body::Curves {
                x: Axis::linear(AXES[self.columns.axis], "m"),
                y: Axis::linear("height", "m"),
                curves,
            },
        }]
    }
}

/// Middle third of the columns against the two at the ends, m.
fn dome(heights: &[f64]) -> f64 {
    let n = heights.len();
    let mean = |of: &[f64]| of.iter().sum::<f64>() / of.len() as f64;
    if n < 3 {
        return f64::NAN;
    }
    mean(&heights[n / 3..n - n / 3]) - 0.5 * (heights[0] + heights[n - 1])
}

/// Slope of the least-squares line through heights at equal distances.
fn tilt(heights: &[f64], spacing: f64) -> f64 {
    let middle = 0.5 * (heights.len() as f64 - 1.0);
    let (mut xx, mut xy) = (0.0, 0.0);
    for (k, h) in heights.iter().enumerate() {
        let x = (k as f64 - middle) * spacing;
        xx += x * x;
        xy += x * h;
    }
    xy / xx
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slope_and_a_roof() {
        let slope: Vec<f64> = (0..9).map(|k| 1.0 + 0.2 * f64::from(k)).collect();
        assert!((tilt(&slope, 0.5) - 0.4).abs() < 1e-14 && dome(&slope).abs() < 1e-14);
        let roof: Vec<f64> = (0..9).map(|k| 4.0 - (f64::from(k) - 4.0).abs()).collect();
        // Middle third 3, 4, 3; ends 0.
        assert!(tilt(&roof, 0.5).abs() < 1e-14 && (dome(&roof) - 10.0 / 3.0).abs() < 1e-14);
    }
}

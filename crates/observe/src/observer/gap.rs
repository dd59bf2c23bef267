//! The gap under the bed, place by place: arches.

use super::{AXES, COLUMNS, Faults, Observe, Selection, Setting, columns_across};
use crate::accumulate::Batched;
use crate::view::View;
use crate::zones::Direction;
use brazilnut_base::figure::{Axis, Body, Curve, Figure, Raster};
use brazilnut_base::keys::Key;
use brazilnut_base::menu::Entry;
use brazilnut_base::values::Values;
use brazilnut_base::{Column, Table};
use serde::{Deserialize, Serialize};

/// Height of the lower edge of the bed in columns across the cell.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Gap {
    of: Selection,
    columns: Direction,
    per_cycle: usize,
    /// Gaps, then counts of samples in which the column held grains.
    sums: Batched,
}

/// Columns before the gaps: `mean` and `unevenness`.
const WHOLE: usize = 2;

impl Observe for Gap {
    const ENTRY: Entry = Entry {
        name: "gap",
        summary: "Gap between floor and bed in columns across the cell, and how uneven it is: arches.",
        formula: "gap_k = min(z - r) of the grains whose centres are in column k, above the floor (m); not a number without grains\n\
                  mean: over the columns that hold grains (m)\n\
                  unevenness = sqrt(mean of (gap_k - mean)^2) (m): zero for a bed that lies flat or is thrown flat",
        source: "Lan 1994, 5.1.3 (Figs A5.10, A5.11)",
    };

    const KEYS: &'static [Key] = &COLUMNS;

    fn from_values(values: &Values, setting: &Setting) -> Result<Self, Faults> {
        let columns = columns_across(values, setting)?;
        let per_cycle = setting.sampling.per_cycle.unwrap_or(1);
        Ok(Self {
            of: Selection::read(values, setting)?,
            per_cycle: per_cycle as usize,
            sums: Batched::new(2 * columns.count, 16, per_cycle),
            columns,
        })
    }

    fn columns(&self) -> Vec<Column> {
        ["mean", "unevenness"]
            .into_iter()
            .map(|n| Column::new(n, "m"))
            .chain((0..self.columns.count).map(|k| Column::new(format!("gap_{k}"), "m")))
            .collect()
    }

    fn observe(&mut self, view: &View) -> Option<Vec<f64>> {
        let (g, n) = (view.grains, self.columns.count);
        let mut row = vec![f64::NAN; WHOLE + n];
        for k in (0..g.len()).filter(|&k| self.of.takes(g, k)) {
            let r = g.position[k];
            let gap = &mut row[WHOLE + self.columns.find(r[self.columns.axis])];
            // The smaller of the two; what is not a number yet gives way.
            *gap = gap.min(r.z - g.radius[k] - view.floor_height());
        }
        let sums = self.sums.open();
        let (mut count, mut mean) = (0.0, 0.0);
        for (k, gap) in row[WHOLE..].iter().enumerate().filter(|(_, gap)| gap.is_finite()) {
            sums[k] += gap;
            sums[n + k] += 1.0;
            count += 1.0;
            mean += gap;
        }
        mean /= count;
        let held = row[WHOLE..].iter().filter(|gap| gap.is_finite());
        let square: f64 = held.map(|gap| (gap - mean) * (gap - mean)).sum();
        (row[0], row[1]) = (mean, (square / count).sqrt());
        Some(row)
    }

    fn results(&self) -> Vec<(String, Table)> {
        let n = self.columns.count;
        let gaps = self.sums.estimates(n, |s, _, out| (0..n).for_each(|k| out[k] = s[k] / s[n + k]));
        let mut t = Table::new(&[(AXES[self.columns.axis], "m"), ("gap", "m"), ("gap_error", "m")]);
        t.rows =
            gaps.iter().enumerate().map(|(k, h)| vec![self.columns.centre(k), h.value, h.error]).collect();
        vec![("long-term".into(), t)]
    }

    fn figures(&self, series: &Table) -> Vec<Figure> {
        let (_, mean) = self.results().remove(0);
        let over_x = Figure {
            title: "Mean gap under the bed".into(),
            caption: format!(
                "Lowest point of the grains in each column of {:.3e} m above the floor, mean over {} samples.",
                self.columns.width,
                self.sums.rows()
            ),
            body: Body::Curves {
                x: Axis::linear(AXES[self.columns.axis], "m"),
                y: Axis::linear("gap", "m"),
                curves: vec![Curve {
                    error: mean.rows.iter().map(|r| r[2]).collect(),
                    ..Curve::line("gap", mean.rows.iter().map(|r| [r[0], r[1]]).collect())
                }],
            },
        };
        std::iter::once(over_x).chain(self.last_cycle(series)).collect()
    }
}

impl Gap {
    /// Gap against place and phase in the last whole cycle of the series; none if a cycle has a single sample.
    fn last_cycle(&self, series: &Table) -> Option<Figure> {
        let (m, n) = (self.per_cycle, self.columns.count);
        let start = series.rows.len().checked_sub(m).filter(|_| m > 1)?;
        let rows = &series.rows[start..];
        // Time and cycle stand before the observer's own columns.
        let gaps = |r: &Vec<f64>| r[2 + WHOLE..].to_vec();
        let first = rows[0][1];
        let (low, high) = (360.0 * first.rem_euclid(1.0), 360.0 / m as f64);
        Some(Figure {
            title: "Gap under the bed in the last cycle".into(),
            caption: format!(
                "Lowest point of the grains in each column above the floor from cycle {first:.2} on. \
                 Phase 0 is the floor moving up at its fastest; it is highest at 90° and lowest at 270°."
            ),
            body: Body::Map {
                x: Axis::linear(AXES[self.columns.axis], "m"),
                y: Axis::linear("phase", "deg"),
                raster: Some(Raster {
                    shape: [n, m],
                    extent: [
                        self.columns.origin,
                        self.columns.origin + n as f64 * self.columns.width,
                        low - 0.5 * high,
                        low + (m as f64 - 0.5) * high,
                    ],
                    values: rows.iter().flat_map(gaps).collect(),
                    label: "gap".into(),
                    unit: "m".into(),
                }),
                arrows: vec![],
                arrow_unit: String::new(),
                lines: vec![],
            },
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthetic::{Stage, setting, values};
    use brazilnut_base::vec3;

    #[test]
    fn an_arch_stands_over_the_floor() {
        // Grains of radius 0.05 whose lower edges follow a parabola 0.1 high, over a floor that is 0.2 below.
        let mut stage = Stage::new(vec3(1.0, 0.1, 1.0), "walls");
        stage.floor.displacement.z = -0.2;
        let arch = |x: f64| 0.4 * x * (1.0 - x);
        for k in 0..10 {
            let x = 0.05 + 0.1 * f64::from(k);
            stage.add(vec3(x, 0.05, arch(x) + 0.05), 0.05);
            stage.add(vec3(x, 0.05, arch(x) + 0.15), 0.05);
        }
        let (cell, species) = (stage.cell, [("all".to_string(), 20)]);
        let mut gap =
            Gap::from_values(&values(Gap::KEYS, &[("size", 0.1)]), &setting(&cell, &species)).unwrap();
        let row = gap.observe(&stage.view()).unwrap();
        assert_eq!(gap.columns().len(), row.len());
        for k in 0..10 {
            assert!((row[WHOLE + k] - 0.2 - arch(0.05 + 0.1 * k as f64)).abs() < 1e-15);
        }
        let mean = row[WHOLE..].iter().sum::<f64>() / 10.0;
        let square = row[WHOLE..].iter().map(|g| (g - mean) * (g - mean)).sum::<f64>() / 10.0;
        assert!((row[0] - mean).abs() < 1e-15 && (row[1] - square.sqrt()).abs() < 1e-15);
        assert!((gap.results()[0].1.column("gap").unwrap()[3] - row[WHOLE + 3]).abs() < 1e-15);
        // A column without grains has no gap, and the others do not notice.
        stage.grains.position[0].x = 0.15;
        stage.grains.position[1].x = 0.15;
        let row = gap.observe(&stage.view()).unwrap();
        assert!(row[WHOLE].is_nan() && row[0].is_finite() && row[1].is_finite());
    }
}

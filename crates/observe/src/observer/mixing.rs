//! How well two kinds of grains are mixed.

use super::{Faults, Observe, Selection, Setting, few_enough};
use crate::height;
use crate::view::View;
use crate::zones::{Direction, Grid};
use brazilnut_base::figure::{Axis, Body, Curve, Figure};
use brazilnut_base::keys::{Check, Key, Kind};
use brazilnut_base::menu::Entry;
use brazilnut_base::units::Dimension;
use brazilnut_base::values::Values;
use brazilnut_base::{Column, Table};
use serde::{Deserialize, Serialize};

/// Lacey index and separation of the centres of mass.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Mixing {
    of: Selection,
    by_layer: bool,
    /// Height that divides the starting layers, from the first sample.
    halves: Vec<bool>,
    grid: Grid,
    least: u64,
}

impl Observe for Mixing {
    const ENTRY: Entry = Entry {
        name: "mixing",
        summary: "Lacey mixing index of two kinds of grains, and the distance between their centres of mass.",
        formula: "cells of edge `size`; x_c = fraction by number of the chosen kind among the n_c grains with centres in cell c, cells with n_c >= `least`\n\
                  s^2 = sum n_c (x_c - p)^2/sum n_c, p = the fraction over those cells, s_0^2 = p (1 - p), s_r^2 = s_0^2 <1/n>, <1/n> = (number of cells)/sum n_c\n\
                  lacey = (s_0^2 - s^2)/(s_0^2 - s_r^2): 0 apart, 1 mixed at random\n\
                  separation = z centre of mass of the chosen kind minus that of the others (m); segregation = separation over half the height of the bed: 1 and -1 are thin layers apart\n\
                  chosen kind: the species `of`, or without it the grains that lie above the median height in the first sample",
        source: "Lacey 1954",
    };

    const KEYS: &'static [Key] = &[
        Key::optional(
            "size",
            Kind::Quantity(Dimension::LENGTH),
            "Edge of a cell, adjusted to divide the cell evenly; three mean diameters if left out.",
        )
        .with(Check::Positive),
        Key::default("least", Kind::Integer, "5", "Cells with fewer grains are left out.")
            .with(Check::Between(2.0, 1e6)),
    ];

    fn from_values(values: &Values, setting: &Setting) -> Result<Self, Faults> {
        let of = Selection::read(values, setting)?;
        let size = values.number_opt("size").unwrap_or(3.0 * setting.mean_diameter);
        let axes = (0..3).filter(|&a| setting.cell.flat_axis() != Some(a));
        let grid = Grid::new(setting.cell, axes.map(|a| Direction::across(setting.cell, a, size)).collect());
        few_enough(grid.len())?;
        Ok(Self {
            of,
            by_layer: of == Selection::All,
            halves: vec![],
            grid,
            least: values.integer("least") as u64,
        })
    }

    fn columns(&self) -> Vec<Column> {
        [("lacey", "1"), ("separation", "m"), ("segregation", "1"), ("cells", "1")]
            .map(|(n, u)| Column::new(n, u))
            .to_vec()
    }

    fn observe(&mut self, view: &View) -> Option<Vec<f64>> {
        let g = view.grains;
        if self.by_layer && self.halves.is_empty() {
            let mut z: Vec<(f64, f64)> = g.position.iter().map(|r| (r.z, 1.0)).collect();
            let median = height::quantile(&mut z, 0.5);
            self.halves = g.position.iter().map(|r| r.z > median).collect();
        }
        let chosen = |k: usize| if self.by_layer { self.halves[k] } else { self.of.takes(g, k) };
        let mut cells = vec![(0_u64, 0_u64); self.grid.len()];
        let mut moments = [(0.0, 0.0); 2];
        for k in 0..g.len() {
            let cell = &mut cells[self.grid.find(g.position[k])];
            cell.0 += 1;
            cell.1 += u64::from(chosen(k));
            let m = &mut moments[usize::from(chosen(k))];
            m.0 += g.mass[k];
            m.1 += g.mass[k] * g.position[k].z;
        }
        let (lacey, count) = lacey(&cells, self.least);
        let separation = moments[1].1 / moments[1].0 - moments[0].1 / moments[0].0;
        let bed = height::lid(view, Selection::All, 0.95);
        Some(vec![lacey, separation, separation / (0.5 * bed), count])
    }

    fn figures(&self, series: &Table) -> Vec<Figure> {
        let curve =
            |column: &str, label: &str| super::bed::pairs(series, column).map(|p| Curve::line(label, p));
        vec![Figure {
            title: "Mixing and segregation".into(),
            caption: "Lacey index: 0 apart, 1 mixed at random. Segregation: height of the chosen kind's centre of mass above \
                      the others', over half the height of the bed."
                .into(),
            body: Body::Curves {
                x: Axis::linear("time", "s"),
                y: Axis::linear("index", "1"),
                curves: [curve("lacey", "Lacey index"), curve("segregation", "segregation")].into_iter().flatten().collect(),
            },
        }]
    }
}

/// Lacey's index from (grains, chosen grains) by cell, and the number of cells that count.
fn lacey(cells: &[(u64, u64)], least: u64) -> (f64, f64) {
    let counted = || cells.iter().filter(|c| c.0 >= least).map(|c| (c.0 as f64, c.1 as f64));
    let n: f64 = counted().map(|c| c.0).sum();
    let count = counted().count() as f64;
    let p = counted().map(|c| c.1).sum::<f64>() / n;
    let s2 = counted().map(|(n, m)| n * (m / n - p).powi(2)).sum::<f64>() / n;
    let s02 = p * (1.0 - p);
    ((s02 - s2) / (s02 - s02 * count / n), count)
}

#[cfg(test)]
mod tests {
    use super::*;
    use brazilnut_base::random;
    use rand::RngExt;

    #[test]
    fn apart_and_at_random() {
        assert_eq!(lacey(&[(10, 10), (10, 0), (10, 10), (10, 0)], 5).0, 0.0);
        let mut rng = random::stream(1, "lacey", 0);
        let cells: Vec<(u64, u64)> =
            (0..4000).map(|_| (20, (0..20).filter(|_| rng.random::<f64>() < 0.3).count() as u64)).collect();
        // 1 - (s²/s_r² - 1)/19 with s² known to sqrt(2/4000) = 2 %: 0.1 % here.
        assert!((lacey(&cells, 5).0 - 1.0).abs() < 0.005);
        // Too few grains do not count.
        assert_eq!(lacey(&[(10, 10), (10, 0), (2, 1)], 5).1, 2.0);
    }
}

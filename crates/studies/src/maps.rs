//! Mean velocity fields that the observer `field` writes, cell by cell of the plane of x and z.

use crate::runs::column;
use brazilnut_base::Table;
use brazilnut_base::figure::{Axis, Body, Figure, Raster};

/// Mean velocities over cells; the columns run fastest.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// Centres of the columns, m.
    x: Vec<f64>,
    /// Centre of each cell above the lowest place of the cell of the case, m.
    z: Vec<f64>,
    solids_fraction: Vec<f64>,
    /// Along x and z, m/s; zero where no grain was.
    velocity: Vec<[f64; 2]>,
    /// Cells of a smaller solids fraction are left out.
    least: f64,
}

impl Field {
    /// From a table `long-term`; cells of a solids fraction below `least` will be left out.
    #[must_use]
    pub fn new(cells: &Table, least: f64) -> Self {
        let [x, z, solids_fraction, u, w] =
            ["x", "z", "solids_fraction", "velocity_x", "velocity_z"].map(|c| column(cells, c));
        let columns = z.iter().take_while(|&&h| h == z[0]).count();
        let known = |v: f64| if v.is_finite() { v } else { 0.0 };
        let velocity = u.iter().zip(&w).map(|(u, w)| [known(*u), known(*w)]).collect();
        Self { x: x[..columns].to_vec(), z, solids_fraction, velocity, least }
    }

    /// The mean over runs of equal length, weighted by how long grains were in each cell.
    ///
    /// # Panics
    /// Without a run.
    #[must_use]
    pub fn mean<'a>(fields: impl Iterator<Item = &'a Self>) -> Self {
        let all: Vec<&Self> = fields.collect();
        let mut mean = all[0].clone();
        for k in 0..mean.z.len() {
            let nu: f64 = all.iter().map(|f| f.solids_fraction[k]).sum();
            for axis in 0..2 {
                let flux: f64 = all.iter().map(|f| f.solids_fraction[k] * f.velocity[k][axis]).sum();
                mean.velocity[k][axis] = if nu > 0.0 { flux / nu } else { 0.0 };
            }
            mean.solids_fraction[k] = nu / all.len() as f64;
        }
        mean
    }

    fn held(&self, k: usize) -> bool {
        self.solids_fraction[k] >= self.least
    }

    /// Mean of |u| over some cells, m/s.
    fn speed_over(&self, cells: impl Iterator<Item = usize>) -> f64 {
        let held = cells.filter(|&k| self.held(k)).map(|k| self.velocity[k][0].hypot(self.velocity[k][1]));
        let (sum, n) = held.fold((0.0, 0.0), |(s, n), v| (s + v, n + 1.0));
        sum / n
    }

    /// Mean of |u| over all cells, m/s (Lan, Table 5.1).
    #[must_use]
    pub fn speed(&self) -> f64 {
        self.speed_over(0..self.z.len())
    }

    /// Mean of |u| over the cells of the middle half of the columns over that of the eight columns at each
    /// wall (Lan, Fig. A5.9; eight diameters is the width of its rolls).
    #[must_use]
    pub fn middle_over_walls(&self) -> f64 {
        let n = self.x.len();
        let mean = |columns: Vec<usize>| self.speed_over(columns.into_iter().flat_map(|i| self.column(i)));
        mean((n / 4..n - n / 4).collect()) / mean((0..8.min(n)).chain(n.saturating_sub(8)..n).collect())
    }

    /// The cells of column `i`.
    fn column(&self, i: usize) -> impl Iterator<Item = usize> + use<> {
        (i..self.z.len()).step_by(self.x.len())
    }

    /// Place of each column, m, and mean of |u| over its cells, m/s (Lan, Figs A5.2).
    #[must_use]
    pub fn speeds(&self) -> Vec<[f64; 2]> {
        (0..self.x.len()).map(|i| [self.x[i], self.speed_over(self.column(i))]).collect()
    }

    /// Distance of each column from the nearer end, m, and mean vertical velocity of its grains, m/s; the
    /// mean of both sides. Less that of all grains: a bed that stands higher at the end than at the start
    /// does not turn over for that.
    #[must_use]
    pub fn folded(&self) -> Vec<[f64; 2]> {
        let n = self.x.len();
        let vertical = |cells: &mut dyn Iterator<Item = usize>| {
            let of = |k: usize| (self.solids_fraction[k] * self.velocity[k][1], self.solids_fraction[k]);
            let (flux, mass) = cells.map(of).fold((0.0, 0.0), |s, c| (s.0 + c.0, s.1 + c.1));
            flux / mass
        };
        let all = vertical(&mut (0..self.z.len()));
        let column = |i: usize| vertical(&mut self.column(i)) - all;
        (0..n.div_ceil(2)).map(|i| [self.x[i], 0.5 * (column(i) + column(n - 1 - i))]).collect()
    }

    /// Mean vertical velocity of the grains of the two columns at the ends, m/s, as in [`Self::folded`].
    #[must_use]
    pub fn along_the_walls(&self) -> f64 {
        self.folded()[0][1]
    }

    /// Mean vertical velocity of the grains of the middle fifth of the columns, m/s, as in [`Self::folded`].
    #[must_use]
    pub fn in_the_middle(&self) -> f64 {
        let v = self.folded();
        let middle = &v[v.len() - v.len().div_ceil(5)..];
        middle.iter().map(|p| p[1]).sum::<f64>() / middle.len() as f64
    }

    /// Distance from the end at which the vertical velocity changes its sign for the `n`th time, m, linear
    /// between the columns; not a number if it does not.
    #[must_use]
    pub fn turning(&self, n: usize) -> f64 {
        let v = self.folded();
        let turns = v.windows(2).filter(|p| p[0][1] * p[1][1] <= 0.0 && p[0][1] != 0.0);
        let at = |p: &[[f64; 2]]| p[0][0] + (p[1][0] - p[0][0]) * p[0][1] / (p[0][1] - p[1][1]);
        turns.map(at).nth(n - 1).unwrap_or(f64::NAN)
    }

    /// Arrows over the shaded solids fraction.
    #[must_use]
    pub fn map(&self, title: String, caption: &str) -> Figure {
        let columns = self.x.len();
        let held: Vec<usize> = (0..self.z.len()).filter(|&k| self.held(k)).collect();
        // Rows above the bed say nothing.
        let rows = held.iter().map(|k| k / columns + 1).max().unwrap_or(1);
        let (width, height) = (2.0 * self.x[0], 2.0 * self.z[0]);
        let shade = |k: usize| if self.held(k) { self.solids_fraction[k] } else { f64::NAN };
        Figure {
            title,
            caption: caption.into(),
            body: Body::Map {
                x: Axis::linear("x", "m"),
                y: Axis::linear("z", "m"),
                raster: Some(Raster {
                    shape: [columns, rows],
                    extent: [0.0, columns as f64 * width, 0.0, rows as f64 * height],
                    values: (0..columns * rows).map(shade).collect(),
                    label: "solids fraction".into(),
                    unit: "1".into(),
                }),
                arrows: held.iter().map(|&k| ([self.x[k % columns], self.z[k]], self.velocity[k])).collect(),
                arrow_unit: "m/s".into(),
                lines: vec![],
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A roll pair on six columns and two rows: down in the outer ones, up in the others.
    fn rolls(scale: f64, solids: f64) -> Field {
        let mut t = Table::new(&[
            ("x", "m"),
            ("z", "m"),
            ("solids_fraction", "1"),
            ("velocity_x", "m/s"),
            ("velocity_z", "m/s"),
        ]);
        for row in 0..2 {
            for (i, w) in [-2.0, 1.0, 1.0, 1.0, 1.0, -2.0].into_iter().enumerate() {
                t.rows.push(vec![0.05 + 0.1 * i as f64, 0.05 + 0.1 * f64::from(row), solids, 0.0, scale * w]);
            }
        }
        // A cell without grains above them.
        for i in 0..6 {
            t.rows.push(vec![0.05 + 0.1 * f64::from(i), 0.25, 0.0, f64::NAN, f64::NAN]);
        }
        Field::new(&t, 0.05)
    }

    #[test]
    fn speed_stream_and_sign_of_a_pair_of_rolls() {
        let f = rolls(1.0, 0.5);
        assert!((f.speed() - 8.0 / 6.0).abs() < 1e-15 && (f.along_the_walls() + 2.0).abs() < 1e-15);
        // Columns 1 to 4 over all, each counted twice: 1 over 8/6.
        assert!((f.middle_over_walls() - 0.75).abs() < 1e-15);
        assert!((f.in_the_middle() - 1.0).abs() < 1e-15);
        // Between 0.05 (-2) and 0.15 (+1).
        assert!((f.turning(1) - (0.05 + 0.1 * 2.0 / 3.0)).abs() < 1e-15 && f.turning(2).is_nan());
        assert_eq!(f.speeds().len(), 6);
    }

    #[test]
    fn a_mean_of_fields_is_weighted_by_their_grains() {
        let (a, b) = (rolls(1.0, 0.1), rolls(-1.0, 0.3));
        let m = Field::mean([&a, &b].into_iter());
        // (0.1 - 0.3)/0.4 of the first.
        assert!((m.along_the_walls() - 1.0).abs() < 1e-15 && (m.speed() - 0.5 * 8.0 / 6.0).abs() < 1e-15);
        assert_eq!(Field::mean(std::iter::once(&a)), a);
    }
}

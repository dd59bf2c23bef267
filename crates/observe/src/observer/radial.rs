//! The radial distribution function.

use super::{Faults, Observe, Selection, Setting};
use crate::accumulate::Batched;
use crate::height;
use crate::pairs::near;
use crate::view::View;
use brazilnut_base::figure::{Axis, Body, Curve, Figure};
use brazilnut_base::keys::{Check, Key, Kind};
use brazilnut_base::menu::Entry;
use brazilnut_base::units::Dimension;
use brazilnut_base::values::Values;
use brazilnut_base::{Cell, Side, Table, Vec3};
use serde::{Deserialize, Serialize};
use std::f64::consts::{PI, TAU};

/// Pair distances inside the bed, against those of points without order.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Radial {
    of: Selection,
    reach: f64,
    bins: usize,
    diameter: f64,
    /// Pairs found and expected, bin by bin.
    sums: Batched,
}

impl Observe for Radial {
    const ENTRY: Entry = Entry {
        name: "radial-distribution",
        summary: "Radial distribution function g(r) of the centres inside the bed.",
        formula: "g(r) = pairs found/pairs expected of centres placed without order, in bins of r (1)\n\
                  window: a box from one mean diameter off the walls and the floor to one mean diameter below the lid (95 % of the mass), taken anew in each sample\n\
                  expected in dr: n (n - 1)/V 4 pi r^2 dr k(r), n centres in the window of volume V, k(r) = <prod_a (1 - r |e_a|/L_a)> over directions e \
                  (translation correction; 1 along periodic sides; areas instead of volumes in two dimensions)",
        source: "",
    };

    const KEYS: &'static [Key] = &[
        Key::optional(
            "reach",
            Kind::Quantity(Dimension::LENGTH),
            "Largest distance; three mean diameters if left out, and never more than the window holds.",
        )
        .with(Check::Positive),
        Key::default("bins", Kind::Integer, "150", "Number of bins.").with(Check::Between(4.0, 100_000.0)),
    ];

    fn from_values(values: &Values, setting: &Setting) -> Result<Self, Faults> {
        let bins = values.integer("bins") as usize;
        Ok(Self {
            of: Selection::read(values, setting)?,
            reach: values.number_opt("reach").unwrap_or(3.0 * setting.mean_diameter),
            bins,
            diameter: setting.mean_diameter,
            sums: Batched::new(2 * bins, 16, setting.sampling.per_cycle.unwrap_or(1)),
        })
    }

    fn observe(&mut self, view: &View) -> Option<Vec<f64>> {
        let (low, high) = self.window(view);
        let centres: Vec<Vec3> = (0..view.grains.len())
            .filter(|&k| self.of.takes(view.grains, k))
            .map(|k| view.grains.position[k])
            .filter(|r| (0..3).all(|a| r[a] >= low[a] && r[a] <= high[a]))
            .collect();
        let size = high - low;
        let reach = (0..3)
            .filter(|&a| view.cell.sides[a] != Side::Flat)
            .map(|a| if view.cell.is_periodic(a) { 0.5 * size[a] } else { size[a] })
            .fold(self.reach, f64::min);
        if reach <= 0.0 || centres.len() < 2 {
            return None;
        }
        let width = self.reach / self.bins as f64;
        let mut found = vec![0.0; self.bins];
        near(&centres, view.cell, low, high, reach, |r| {
            found[((r / width) as usize).min(self.bins - 1)] += 2.0;
        });
        let n = centres.len() as f64;
        // A bin that the window cuts off is not compared.
        let whole = ((reach / width * (1.0 + 1e-12)) as usize).min(self.bins);
        let sums = self.sums.open();
        for bin in 0..whole {
            let r = bin as f64 * width;
            sums[bin] += found[bin];
            sums[self.bins + bin] += expected(view.cell, size, n, r, r + width);
        }
        None
    }

    fn results(&self) -> Vec<(String, Table)> {
        let g = self.sums.estimates(self.bins, |s, _, out| {
            (0..self.bins).for_each(|k| out[k] = s[k] / s[self.bins + k]);
        });
        let width = self.reach / self.bins as f64;
        let mut t = Table::new(&[("r", "m"), ("g", "1"), ("g_error", "1")]);
        t.rows =
            g.iter().enumerate().map(|(k, e)| vec![(k as f64 + 0.5) * width, e.value, e.error]).collect();
        vec![("g".into(), t)]
    }

    fn figures(&self, _: &Table) -> Vec<Figure> {
        let (_, t) = self.results().remove(0);
        let held = || t.rows.iter().filter(|r| r[1].is_finite());
        vec![Figure {
            title: "Radial distribution".into(),
            caption: format!(
                "Pairs of centres at the distance r over pairs of points without order, mean over {} samples.",
                self.sums.rows()
            ),
            body: Body::Curves {
                x: Axis::linear("r", "m"),
                y: Axis::linear("g(r)", "1"),
                curves: vec![Curve {
                    error: held().map(|r| r[2]).collect(),
                    ..Curve::line("g", held().map(|r| [r[0], r[1]]).collect())
                }],
            },
        }]
    }
}

impl Radial {
    /// The box whose centres are compared.
    fn window(&self, view: &View) -> (Vec3, Vec3) {
        let (mut low, mut high) = (Vec3::ZERO, view.cell.size);
        for a in 0..2 {
            if view.cell.sides[a] == Side::Walls {
                low[a] += self.diameter;
                high[a] -= self.diameter;
            }
        }
        if view.cell.sides[2] == Side::Walls {
            let floor = view.floor_height();
            low.z = floor + self.diameter;
            high.z = floor + height::lid(view, self.of, 0.95) - self.diameter;
        }
        (low, high)
    }
}

/// Ordered pairs at distances from `r0` to `r1` among `n` points without order in a window of edges `size`.
///
/// n (n - 1)/V times the integral of 4 pi r² k(r) by Simpson's rule; the integrand is a polynomial of fifth order,
/// nearly straight over a bin.
fn expected(cell: &Cell, size: Vec3, n: f64, r0: f64, r1: f64) -> f64 {
    let flat = cell.flat_axis();
    let volume: f64 = (0..3).filter(|&a| flat != Some(a)).map(|a| size[a]).product();
    let shell = |r: f64| if flat.is_some() { TAU * r } else { 4.0 * PI * r * r };
    let f = |r: f64| shell(r) * kept(cell, size, r);
    n * (n - 1.0) / volume * (r1 - r0) / 6.0 * (f(r0) + 4.0 * f(0.5 * (r0 + r1)) + f(r1))
}

/// Mean over directions of the part of the window that a shift by `r` keeps inside,
/// <prod (1 - r |e_a|/L_a)> over bounded axes, with <|e_a|> = 1/2, <|e_a e_b|> = 2/(3 pi),
/// <|e_x e_y e_z|> = 1/(4 pi); on the circle 2/pi and 1/pi.
fn kept(cell: &Cell, size: Vec3, r: f64) -> f64 {
    let q: Vec<f64> = (0..3).filter(|&a| cell.sides[a] == Side::Walls).map(|a| r / size[a]).collect();
    let (one, two) = if cell.flat_axis().is_some() { (2.0 / PI, 1.0 / PI) } else { (0.5, 2.0 / (3.0 * PI)) };
    let singles: f64 = q.iter().sum();
    match q.as_slice() {
        [] => 1.0,
        [_] => 1.0 - one * singles,
        [a, b] => 1.0 - one * singles + two * a * b,
        [a, b, c] => 1.0 - one * singles + two * (a * b + b * c + a * c) - a * b * c / (4.0 * PI),
        _ => f64::NAN,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthetic::{Stage, setting, values};
    use brazilnut_base::vec3;

    fn radial(stage: &Stage, reach: f64, bins: f64) -> Radial {
        let species = [("all".to_string(), stage.grains.len())];
        let v = values(Radial::KEYS, &[("reach", reach), ("bins", bins)]);
        let mut s = setting(&stage.cell, &species);
        s.sampling.per_cycle = None;
        Radial::from_values(&v, &s).unwrap()
    }

    #[test]
    fn points_without_order_have_g_one_whatever_the_walls() {
        for sides in ["walls", "periodic"] {
            let mut g = None;
            for seed in 0..64 {
                let mut stage = Stage::new(vec3(0.4, 0.5, 0.6), sides);
                stage.scatter(600, 0.01, seed);
                let r = g.get_or_insert_with(|| radial(&stage, 0.2, 10.0));
                let _ = r.observe(&stage.view());
            }
            let t = g.unwrap().results().remove(0).1;
            for row in &t.rows[2..] {
                // Independent samples: the reported error is the true one, known to 25 % from 8 to 16 batches.
                assert!((row[1] - 1.0).abs() < 4.5 * row[2] && row[2] < 0.03, "{sides} {row:?}");
            }
        }
    }

    #[test]
    fn a_lattice_peaks_at_its_spacings() {
        let mut stage = Stage::new(vec3(1.0, 1.0, 1.0), "periodic");
        for k in 0..1000 {
            stage
                .add((vec3(f64::from(k % 10), f64::from(k / 10 % 10), f64::from(k / 100)) + 0.5) * 0.1, 0.05);
        }
        let mut r = radial(&stage, 0.16, 16.0);
        let _ = r.observe(&stage.view());
        let g = r.results().remove(0).1.column("g").unwrap();
        let peaks: Vec<usize> = (0..16).filter(|&k| g[k] > 0.0).collect();
        // 0.1 and 0.1414.
        assert!(peaks.iter().all(|k| [9, 10, 14].contains(k)), "{peaks:?}");
        assert!(g[14] > 1.0);
    }
}

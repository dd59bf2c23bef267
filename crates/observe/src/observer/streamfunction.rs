//! Streamlines and vortices of a flow in two dimensions.

use super::{AXES, Faults, Observe, Setting};
use crate::view::{Needs, View};
use brazilnut_base::figure::{Axis, Body, Figure, Raster};
use brazilnut_base::keys::Key;
use brazilnut_base::menu::Entry;
use brazilnut_base::plane::Extremum;
use brazilnut_base::values::Values;
use brazilnut_base::{Column, PlaneField, Table};
use serde::{Deserialize, Serialize};

/// Streamfunction and vorticity, averaged over the samples.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Streamfunction {
    axes: [usize; 2],
    samples: u64,
    /// Sums over the samples; none before the first.
    sums: Option<Fields>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Fields {
    streamfunction: PlaneField,
    vorticity: PlaneField,
}

/// Extrema weaker than this part of the strongest are rounding or drift, not vortices.
const WEAKEST: f64 = 1e-6;
/// Streamlines of the main vortex, as parts of its streamfunction.
const MAIN: [f64; 11] = [0.02, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.98];
/// Streamlines of vortices that turn the other way: each of half the streamfunction of the one before.
const HALVINGS: i32 = 9;

impl Observe for Streamfunction {
    const ENTRY: Entry = Entry {
        name: "streamfunction",
        summary: "Streamlines and vortices of the fluid in a cell with a flat direction.",
        formula: "d psi = -v_b da + v_a db in the plane (a, b), at the corners of the grid cells, zero at the first (m²/s)\n\
                  lowest, highest: extrema of psi inside with their places, by parabolas through neighbouring corners; a vortex turns clockwise at a minimum\n\
                  table `vortices`: all extrema of the mean over the samples stronger than 1e-6 of the strongest, with the vorticity dv_b/da - dv_a/db there (1/s)",
        source: "Clément 2009, eq. 2.39, Fig. 2.10",
    };

    const KEYS: &'static [Key] = &[];

    fn from_values(_: &Values, setting: &Setting) -> Result<Self, Faults> {
        let Some(flat) = setting.cell.flat_axis() else {
            let why = "a streamfunction needs a cell with a flat direction";
            return Err(vec![("what".into(), why.into())]);
        };
        Ok(Self { axes: [[1, 2], [0, 2], [0, 1]][flat], samples: 0, sums: None })
    }

    fn needs(&self) -> Needs {
        Needs { contacts: false, flow: true }
    }

    fn columns(&self) -> Vec<Column> {
        let mut all = vec![];
        for end in ["lowest", "highest"] {
            all.push(Column::new(end, "m^2/s"));
            all.extend(self.axes.map(|a| Column::new(format!("{end}_{}", AXES[a]), "m")));
        }
        all
    }

    fn observe(&mut self, view: &View) -> Option<Vec<f64>> {
        let flow = view.fluid.and_then(|f| f.flow)?;
        let now = Fields { streamfunction: flow.streamfunction()?, vorticity: flow.vorticity()? };
        let row = [-1.0, 1.0].map(|sign| match now.streamfunction.extrema(sign).first() {
            Some(e) => [e.value, e.at[0], e.at[1]],
            None => [f64::NAN; 3],
        });
        self.samples += 1;
        match &mut self.sums {
            None => self.sums = Some(now),
            Some(sums) => {
                add(&mut sums.streamfunction, &now.streamfunction);
                add(&mut sums.vorticity, &now.vorticity);
            }
        }
        Some(row.concat())
    }

    fn results(&self) -> Vec<(String, Table)> {
        let Some(mean) = self.mean() else { return vec![] };
        let [a, b] = self.axes.map(|a| AXES[a]);
        let mut t = Table::new(&[("streamfunction", "m^2/s"), (a, "m"), (b, "m"), ("vorticity", "1/s")]);
        for v in vortices(&mean.streamfunction) {
            t.rows.push(vec![v.value, v.at[0], v.at[1], mean.vorticity.interpolate(v.at)]);
        }
        vec![("vortices".into(), t)]
    }

    fn figures(&self, _: &Table) -> Vec<Figure> {
        let Some(mean) = self.mean() else { return vec![] };
        let [m, n] = mean.streamfunction.shape;
        let [h, l] = mean.streamfunction.spacing;
        let psi = &mean.streamfunction;
        // The raster shows cells: each the mean of its corners.
        let cell = |i: usize, j: usize| {
            0.25 * (psi.at(i, j) + psi.at(i + 1, j) + psi.at(i, j + 1) + psi.at(i + 1, j + 1))
        };
        let values = (0..n - 1).flat_map(|j| (0..m - 1).map(move |i| cell(i, j))).collect();
        let [low, high] = [-1.0, 1.0].map(|s| psi.extrema(s).first().map_or(0.0, |e| e.value));
        let (main, other) = if -low > high { (low, high.max(0.0)) } else { (high, low.min(0.0)) };
        let mut levels: Vec<f64> = MAIN.iter().map(|part| part * main).collect();
        if other.abs() > WEAKEST * main.abs() {
            levels.extend((0..HALVINGS).map(|k| 0.7 * other * 0.5_f64.powi(k)));
        }
        let samples = self.samples;
        vec![Figure {
            title: "Streamlines".into(),
            caption: format!(
                "Contours of the streamfunction, mean over {samples} sample(s): at 2, 10, 20 … 90 and 98 % of the main \
                 vortex ({main:.4e} m²/s), and in the vortices that turn the other way each at half of the one before."
            ),
            body: Body::Map {
                x: Axis::linear(AXES[self.axes[0]], "m"),
                y: Axis::linear(AXES[self.axes[1]], "m"),
                raster: Some(Raster {
                    shape: [m - 1, n - 1],
                    extent: [0.0, (m - 1) as f64 * h, 0.0, (n - 1) as f64 * l],
                    values,
                    label: "streamfunction".into(),
                    unit: "m^2/s".into(),
                }),
                arrows: vec![],
                arrow_unit: String::new(),
                lines: levels.into_iter().flat_map(|level| psi.contour(level)).collect(),
            },
        }]
    }
}

impl Streamfunction {
    fn mean(&self) -> Option<Fields> {
        let mut mean = self.sums.clone()?;
        let n = self.samples as f64;
        mean.streamfunction.values.iter_mut().for_each(|x| *x /= n);
        mean.vorticity.values.iter_mut().for_each(|x| *x /= n);
        Some(mean)
    }
}

fn add(sum: &mut PlaneField, now: &PlaneField) {
    sum.values.iter_mut().zip(&now.values).for_each(|(s, x)| *s += x);
}

/// Extrema of both signs that count, the strongest first.
fn vortices(psi: &PlaneField) -> Vec<Extremum> {
    let mut all = psi.extrema(-1.0);
    all.extend(psi.extrema(1.0));
    all.sort_by(|a, b| b.value.abs().total_cmp(&a.value.abs()));
    let strongest = all.first().map_or(0.0, |e| e.value.abs());
    all.retain(|e| e.value.abs() > WEAKEST * strongest);
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// psi = sin(2 pi x) sin(pi z) + offset in a unit square.
    fn rolls(offset: f64) -> Fields {
        let (n, h) = (65, 1.0 / 64.0);
        let values = (0..n * n)
            .map(|c| ((c % n) as f64 * h, (c / n) as f64 * h))
            .map(|(x, z)| (2.0 * PI * x).sin() * (PI * z).sin() + offset);
        let psi = PlaneField { axes: [0, 2], shape: [n, n], spacing: [h, h], values: values.collect() };
        let mut omega = psi.clone();
        omega.values.iter_mut().for_each(|x| *x *= 5.0);
        Fields { streamfunction: psi, vorticity: omega }
    }

    #[test]
    fn two_rolls_are_two_vortices() {
        let mut twice = rolls(0.0);
        add(&mut twice.streamfunction, &rolls(0.2).streamfunction);
        add(&mut twice.vorticity, &rolls(0.2).vorticity);
        let o = Streamfunction { axes: [0, 2], samples: 2, sums: Some(twice) };
        let t = &o.results()[0].1;
        assert_eq!(t.rows.len(), 2);
        for (row, (value, x)) in t.rows.iter().zip([(1.1, 0.25), (-0.9, 0.75)]) {
            assert!((row[0] - value).abs() < 1e-12 && (row[1] - x).abs() < 1e-12, "{row:?}");
            assert!((row[2] - 0.5).abs() < 1e-12 && (row[3] - 5.0 * value).abs() < 1e-12, "{row:?}");
        }
        let Body::Map { lines, .. } = &o.figures(&Table::default())[0].body else { panic!("a map") };
        assert!(lines.len() >= 20, "{}", lines.len());
    }
}

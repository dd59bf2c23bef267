//! How the floor's motion goes up through the bed.

use super::{AXES, Faults, Observe, Selection, Setting, few_enough};
use crate::stats::correlation::{cross, peak};
use crate::stats::spectrum::Welch;
use crate::view::View;
use crate::zones::{Direction, Grid};
use brazilnut_base::figure::{Axis, Body, Curve, Figure};
use brazilnut_base::keys::{Check, Key, Kind};
use brazilnut_base::menu::Entry;
use brazilnut_base::units::Dimension;
use brazilnut_base::values::Values;
use brazilnut_base::{Column, Table};
use serde::{Deserialize, Serialize};

/// Mean velocities of layers, their spectra and their lag behind the floor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Layers {
    of: Selection,
    grid: Grid,
    component: usize,
    interval: f64,
    frequency: f64,
    segment: usize,
    /// Largest lag, samples.
    reach: usize,
    welch: Welch,
    /// The samples of a segment, series by series, the floor first.
    held: Vec<Vec<f64>>,
    /// Sums of the cross-correlations with the floor, layer by layer, and of the segments.
    correlation: Vec<Vec<f64>>,
    segments: u64,
    /// Samples in which a layer held grains.
    present: Vec<u64>,
    samples: u64,
}

impl Observe for Layers {
    const ENTRY: Entry = Entry {
        name: "layers",
        summary: "Mean velocity of layers: series, power spectra, cross-correlation with the floor, lag behind it.",
        formula: "u_k(t) = sum m^ v/sum m^ over the parts of grains in layer k (Lan 3-1-1), zero while it is empty, and the floor's velocity, both in the laboratory's frame (m/s)\n\
                  spectrum: one-sided power spectral density (Welch, Hann window, segments of `segment` samples, half overlapping) ((m/s)^2/Hz)\n\
                  correlation_k(tau) = <u_floor(t) u_k(t + tau)> without the means (Lan 3-2-3) ((m/s)^2)\n\
                  lag: tau of its highest value between -1/4 and 3/4 of a shake cycle (s); phase_lag: by the cross spectrum at the shake's frequency (deg, -180 to 180)",
        source: "Lan 1994, 4.3 (Figs A4.13, A4.14)",
    };

    const KEYS: &'static [Key] = &[
        Key::optional(
            "size",
            Kind::Quantity(Dimension::LENGTH),
            "Thickness of a layer, adjusted to divide the cell evenly; one mean diameter if left out.",
        )
        .with(Check::Positive),
        Key::default("component", Kind::Word(&AXES), "\"z\"", "Component of the velocities."),
        Key::default(
            "segment",
            Kind::Integer,
            "512",
            "Samples in a segment of the spectra and correlations.",
        )
        .with(Check::Between(8.0, 1_048_576.0)),
    ];

    fn from_values(values: &Values, setting: &Setting) -> Result<Self, Faults> {
        let size = values.number_opt("size").unwrap_or(setting.mean_diameter);
        let layers = Direction { periodic: false, ..Direction::across(setting.cell, 2, size) };
        few_enough(layers.count)?;
        let Some(frequency) = setting.frequency else {
            return Err(vec![(
                "what".into(),
                "nothing shakes in this case: there is no floor to lag behind".into(),
            )]);
        };
        let interval = setting.sampling.interval;
        let period = 1.0 / (frequency * interval);
        let segment = (values.integer("segment") as usize).next_multiple_of(2);
        if period < 4.0 {
            return Err(vec![(
                "every".into(),
                format!("{period:.1} samples a cycle are too few: take eight or more"),
            )]);
        }
        let series = layers.count + 1;
        let reach = (period.ceil() as usize).min(segment - 1);
        Ok(Self {
            of: Selection::read(values, setting)?,
            component: AXES.iter().position(|a| *a == values.text("component")).unwrap_or(2),
            interval,
            frequency,
            segment,
            reach,
            welch: Welch::new(series, segment),
            held: vec![vec![]; series],
            correlation: vec![vec![0.0; 2 * reach + 1]; series],
            segments: 0,
            present: vec![0; layers.count],
            samples: 0,
            grid: Grid::new(setting.cell, vec![layers]),
        })
    }

    fn columns(&self) -> Vec<Column> {
        let layers = (0..self.grid.len()).map(|k| format!("layer_{k}"));
        std::iter::once("floor".to_string()).chain(layers).map(|n| Column::new(n, "m/s")).collect()
    }

    fn observe(&mut self, view: &View) -> Option<Vec<f64>> {
        let g = view.grains;
        let n = self.grid.len();
        let (mut mass, mut momentum, mut scratch) = (vec![0.0; n], vec![0.0; n], vec![]);
        let frame = view.frame.velocity[self.component];
        for k in (0..g.len()).filter(|&k| self.of.takes(g, k)) {
            self.grid.spread(g.position[k], g.radius[k], &mut scratch, |zone, part| {
                mass[zone] += part * g.mass[k];
                momentum[zone] += part * g.mass[k] * g.velocity[k][self.component];
            });
        }
        let mut row = vec![frame + view.floor.velocity[self.component]];
        for k in 0..n {
            self.present[k] += u64::from(mass[k] > 0.0);
            row.push(if mass[k] > 0.0 { momentum[k] / mass[k] + frame } else { 0.0 });
        }
        self.samples += 1;
        self.welch.add(&row);
        self.held.iter_mut().zip(&row).for_each(|(h, x)| h.push(*x));
        if self.held[0].len() == self.segment {
            self.correlate();
        }
        Some(row)
    }

    fn results(&self) -> Vec<(String, Table)> {
        if self.segments == 0 {
            return vec![];
        }
        vec![
            ("layers".into(), self.layers()),
            ("correlation".into(), self.correlations()),
            ("spectra".into(), self.spectra()),
        ]
    }

    fn figures(&self, _: &Table) -> Vec<Figure> {
        if self.segments == 0 {
            return vec![];
        }
        let f = self.welch.frequencies(self.interval);
        let shown: Vec<usize> =
            (0..self.grid.len()).filter(|&k| 2 * self.present[k] > self.samples).collect();
        let every = shown.len().div_ceil(6).max(1);
        let shown: Vec<usize> = shown.into_iter().step_by(every).collect();
        let spectrum = |s: usize, label: String| {
            let p = self.welch.density(s, self.interval);
            Curve::line(label, f.iter().zip(p).skip(1).map(|(f, p)| [*f, p]).collect())
        };
        let label = |k: &usize| format!("layer at {:.3e} m", self.grid.directions[0].centre(*k));
        let correlations = self.correlations();
        let correlation = |column: usize, label: String| {
            Curve::line(label, correlations.rows.iter().map(|r| [r[0], r[1 + column]]).collect())
        };
        let both = |f: &dyn Fn(usize, String) -> Curve| -> Vec<Curve> {
            std::iter::once(f(0, "floor".into())).chain(shown.iter().map(|k| f(k + 1, label(k)))).collect()
        };
        let table = self.layers();
        let lag = table.rows.iter().filter(|r| r[1] > 0.5).map(|r| [r[0], r[8]]).collect();
        vec![
            Figure {
                title: "Spectra of the layers' velocity".into(),
                caption: format!("Power spectral density of the mean velocity of layers along {} ({} segments of {} samples, Hann window).", AXES[self.component], self.welch.segments(), self.segment),
                body: Body::Curves {
                    x: Axis::log("frequency", "Hz"),
                    y: Axis::log("power spectral density", "(m/s)^2/Hz"),
                    curves: both(&spectrum),
                },
            },
            Figure {
                title: "Correlation of the layers with the floor".into(),
                caption: "<u_floor(t) u_layer(t + tau)>: a peak at a positive lag comes after the floor.".into(),
                body: Body::Curves {
                    x: Axis::linear("lag", "s"),
                    y: Axis::linear("cross-correlation", "(m/s)^2"),
                    curves: both(&correlation),
                },
            },
            Figure {
                title: "Lag of the layers behind the floor".into(),
                caption: "Lag of the highest cross-correlation, of layers that hold grains more than half of the time.".into(),
                body: Body::Curves {
                    x: Axis::linear("height", "m"),
                    y: Axis::linear("lag", "s"),
                    curves: vec![Curve::line("lag", lag)],
                },
            },
        ]
    }
}

impl Layers {
    /// Adds the correlations of a full segment and begins the next.
    fn correlate(&mut self) {
        for h in &mut self.held {
            let mean = h.iter().sum::<f64>() / h.len() as f64;
            h.iter_mut().for_each(|x| *x -= mean);
        }
        for (sums, layer) in self.correlation.iter_mut().zip(&self.held) {
            let c = cross(&self.held[0], layer, self.reach);
            sums.iter_mut().zip(c).for_each(|(s, c)| *s += c);
        }
        self.held.iter_mut().for_each(Vec::clear);
        self.segments += 1;
    }

    /// Lag of a layer's highest correlation, s.
    fn lag(&self, series: usize) -> f64 {
        let quarter = (0.25 / (self.frequency * self.interval)).round() as usize;
        let first = self.reach.saturating_sub(quarter);
        let last = (self.reach + 3 * quarter).min(2 * self.reach);
        let c = &self.correlation[series][first..=last];
        if c.iter().all(|x| *x == 0.0) {
            return f64::NAN;
        }
        peak(c).map_or(f64::NAN, |p| (first as f64 + p - self.reach as f64) * self.interval)
    }

    fn layers(&self) -> Table {
        let mut t = Table::new(&[
            ("height", "m"),
            ("present", "1"),
            ("velocity_variance", "m^2/s^2"),
            ("peak_frequency", "Hz"),
            ("peak_density", "(m/s)^2/Hz"),
            ("shake_density", "(m/s)^2/Hz"),
            ("coherence", "1"),
            ("phase_lag", "deg"),
            ("lag", "s"),
        ]);
        let f = self.welch.frequencies(self.interval);
        let shake = self.welch.bin(self.frequency, self.interval);
        for k in 0..self.grid.len() {
            let p = self.welch.density(k + 1, self.interval);
            let top = (1..p.len()).max_by(|&a, &b| p[a].total_cmp(&p[b])).unwrap_or(0);
            let (phase, coherence) = self.welch.lag(k + 1)[shake];
            let held = |x: f64| if self.present[k] > 0 { x } else { f64::NAN };
            t.rows.push(vec![
                self.grid.directions[0].centre(k),
                self.present[k] as f64 / self.samples as f64,
                p.iter().sum::<f64>() * f[1],
                held(f[top]),
                p[top],
                p[shake],
                coherence,
                held(phase.to_degrees()),
                self.lag(k + 1),
            ]);
        }
        t
    }

    fn correlations(&self) -> Table {
        let mut t = Table::new(&[("lag", "s")]);
        t.columns.extend(self.columns().into_iter().map(|c| Column::new(c.name, "m^2/s^2")));
        t.rows = (0..=2 * self.reach)
            .map(|k| {
                let mut row = vec![(k as f64 - self.reach as f64) * self.interval];
                row.extend(self.correlation.iter().map(|c| c[k] / self.segments as f64));
                row
            })
            .collect();
        t
    }

    fn spectra(&self) -> Table {
        let mut t = Table::new(&[("frequency", "Hz")]);
        t.columns.extend(self.columns().into_iter().map(|c| Column::new(c.name, "(m/s)^2/Hz")));
        t.rows = self.welch.frequencies(self.interval).into_iter().map(|f| vec![f]).collect();
        for s in 0..=self.grid.len() {
            for (row, p) in t.rows.iter_mut().zip(self.welch.density(s, self.interval)) {
                row.push(p);
            }
        }
        t
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::known::white;
    use crate::synthetic::{Stage, setting, values};
    use brazilnut_base::vec3;
    use std::f64::consts::TAU;

    #[test]
    fn finds_the_lag_and_the_decay_that_were_put_in() {
        let mut stage = Stage::new(vec3(0.1, 0.1, 0.1), "walls");
        for k in 0..5 {
            stage.add(vec3(0.05, 0.05, 0.01 + 0.02 * f64::from(k)), 0.01);
        }
        let cell = stage.cell;
        let species = [("all".to_string(), 5)];
        let mut s = setting(&cell, &species);
        s.frequency = Some(5.0);
        let mut l = Layers::from_values(&values(Layers::KEYS, &[("segment", 200.0)]), &s).unwrap();
        let noise = white(5 * 4000, 0.01, 5);
        for n in 0..4000 {
            let t = 0.01 * n as f64;
            stage.floor.velocity.z = (TAU * 5.0 * t).cos();
            for k in 0..5 {
                // Each layer 8 ms behind the one below, and half as fast.
                let delay = 0.008 * (k + 1) as f64;
                stage.grains.velocity[k].z =
                    0.5_f64.powi(k as i32 + 1) * (TAU * 5.0 * (t - delay)).cos() + noise[5 * n + k];
            }
            let row = l.observe(&stage.view()).unwrap();
            assert_eq!(row.len(), 6);
        }
        let t = l.layers();
        for k in 0..3 {
            let delay = 0.008 * (k + 1) as f64;
            let row = &t.rows[k];
            assert_eq!(row[3], 5.0);
            // Signal to noise falls to one eighth: the lag of a 0.2 s period is then good to a millisecond.
            assert!((row[8] - delay).abs() < 2e-3, "{row:?}");
            assert!((row[7] - delay * 5.0 * 360.0).abs() < 4.0, "{row:?}");
            if k > 0 {
                assert!((row[5] / t.rows[k - 1][5] - 0.25).abs() < 0.03);
            }
        }
    }
}

//! What is asked of every series: means, phase averages, spectra.

use crate::accumulate::{Batched, Estimate};
use crate::observer::Sampling;
use crate::phase::PhaseAverage;
use crate::stats::blocking::Blocking;
use crate::stats::correlogram::Correlogram;
use crate::stats::spectrum::Welch;
use crate::stats::steady::mser;
use brazilnut_base::figure::{Axis, Body, Curve, Figure};
use brazilnut_base::{Column, Table};
use serde::{Deserialize, Serialize};

/// Statistics of the columns of a series, in memory of fixed size.
///
/// Where a segment length is given, the spectrum and the autocorrelation of
/// every column are taken over segments of so many samples.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Series {
    sampling: Sampling,
    start: f64,
    /// Means over whole cycles (over samples where they are no part of a cycle), column by column.
    columns: Vec<Blocking>,
    /// Sums and counts of the cycle that is not full.
    cycle: Vec<(f64, u32)>,
    held: u64,
    batches: Batched,
    phases: Option<PhaseAverage>,
    spectrum: Option<Welch>,
    correlogram: Option<Correlogram>,
}

/// Batches of the steady-state test.
const BATCHES: usize = 64;
/// Batches behind the error of a phase average.
const CYCLES: usize = 16;
/// Curves in one figure.
const CURVES: usize = 8;

impl Series {
    /// For `columns` columns; spectra of segments of `segment` samples if asked for.
    #[must_use]
    pub fn new(columns: usize, sampling: Sampling, segment: Option<usize>) -> Self {
        let per_cycle = sampling.per_cycle.filter(|&n| n > 1);
        Self {
            sampling,
            start: f64::NAN,
            columns: vec![Blocking::default(); columns],
            cycle: vec![(0.0, 0); columns],
            held: 0,
            batches: Batched::new(2 * columns, BATCHES, sampling.per_cycle.unwrap_or(1)),
            phases: per_cycle.map(|n| PhaseAverage::new(n as usize, sampling.phase, 2 * columns, CYCLES)),
            spectrum: segment.map(|n| Welch::new(columns, n)),
            correlogram: segment.map(|n| Correlogram::new(columns, n)),
        }
    }

    /// Takes a row.
    pub fn add(&mut self, time: f64, cycle: f64, row: &[f64]) {
        if self.batches.rows() == 0 {
            self.start = time;
        }
        for (c, &x) in self.cycle.iter_mut().zip(row).filter(|(_, x)| x.is_finite()) {
            *c = (c.0 + x, c.1 + 1);
        }
        self.held += 1;
        if self.held == self.block() {
            self.columns.iter_mut().zip(&mut self.cycle).for_each(|(b, c)| {
                if c.1 > 0 {
                    b.add(c.0 / f64::from(c.1));
                }
                *c = (0.0, 0);
            });
            self.held = 0;
        }
        count(self.batches.open(), row);
        if let Some(p) = &mut self.phases {
            count(p.open(cycle), row);
        }
        if let Some(s) = &mut self.spectrum {
            s.add(row);
        }
        if let Some(c) = &mut self.correlogram {
            c.add(row);
        }
    }

    /// Samples behind one value of the means: a cycle, so that the shake itself is no scatter.
    fn block(&self) -> u64 {
        self.sampling.per_cycle.unwrap_or(1)
    }

    /// The tables, with the columns' names and units.
    #[must_use]
    pub fn results(&self, columns: &[Column]) -> Vec<(String, Table)> {
        let mut all = vec![("means".to_string(), self.means(columns))];
        if let Some(p) = &self.phases {
            all.push(("by-phase".into(), by_phase(p, columns)));
        }
        if let Some(s) = self.spectrum.as_ref().filter(|s| s.segments() > 0) {
            all.push(("spectrum".into(), self.spectrum(s, columns)));
        }
        if let Some(c) = self.correlogram.as_ref().filter(|c| c.segments() > 0) {
            all.push(("autocorrelation".into(), self.autocorrelation(c, columns)));
        }
        all
    }

    fn means(&self, columns: &[Column]) -> Table {
        let mut t = Table::default();
        let mut row = vec![];
        for (k, c) in columns.iter().enumerate() {
            let Estimate { value, error } = self.columns[k].mean();
            let tau = self.columns[k].correlation_time() * self.block() as f64 * self.sampling.interval;
            for (tail, unit, x) in [
                ("", c.unit.as_str(), value),
                ("_error", c.unit.as_str(), error),
                ("_correlation_time", "s", tau),
                ("_steady_from", "s", self.steady_from(k)),
            ] {
                t.columns.push(Column::new(format!("{}{tail}", c.name), unit));
                row.push(x);
            }
        }
        t.rows.push(row);
        t
    }

    /// Time from which column `k` is steady by MSER over batches; NaN if the series is too short to tell.
    fn steady_from(&self, k: usize) -> f64 {
        let n = self.batches.length();
        let columns = self.columns.len();
        let mean = |b: usize| self.batches.batch(b)[k] / self.batches.batch(b)[columns + k];
        let x: Vec<f64> = (0..self.batches.full()).map(mean).collect();
        if x.iter().any(|x| !x.is_finite()) {
            return f64::NAN;
        }
        mser(&x).map_or(f64::NAN, |d| self.start + (d as u64 * n) as f64 * self.sampling.interval)
    }

    fn spectrum(&self, s: &Welch, columns: &[Column]) -> Table {
        let mut t = Table::new(&[("frequency", "Hz")]);
        t.columns.extend(columns.iter().map(|c| Column::new(&*c.name, per_hertz(&c.unit))));
        t.rows = s.frequencies(self.sampling.interval).into_iter().map(|f| vec![f]).collect();
        for k in 0..columns.len() {
            for (row, p) in t.rows.iter_mut().zip(s.density(k, self.sampling.interval)) {
                row.push(p);
            }
        }
        t
    }

    fn autocorrelation(&self, c: &Correlogram, columns: &[Column]) -> Table {
        let mut t = Table::new(&[("lag", "s")]);
        t.columns.extend(columns.iter().map(|c| Column::new(&*c.name, "1")));
        let curves: Vec<Vec<f64>> = (0..columns.len()).map(|k| c.normalised(k)).collect();
        let lags = curves.first().map_or(0, Vec::len);
        t.rows = (0..lags)
            .map(|l| {
                std::iter::once(l as f64 * self.sampling.interval)
                    .chain(curves.iter().map(|c| c[l]))
                    .collect()
            })
            .collect();
        t
    }

    /// Plots of the phase averages and spectra, columns of one unit together.
    #[must_use]
    pub fn figures(&self, name: &str, columns: &[Column]) -> Vec<Figure> {
        let mut figures = vec![];
        for unit in units(columns) {
            let of_unit: Vec<usize> =
                (0..columns.len()).filter(|&k| columns[k].unit == unit).take(CURVES).collect();
            if let Some(p) = &self.phases {
                figures.push(phase_figure(name, p, columns, &of_unit, &unit));
            }
            if let Some(s) = self.spectrum.as_ref().filter(|s| s.segments() > 0) {
                figures.push(self.spectrum_figure(name, s, columns, &of_unit, &unit));
            }
        }
        figures
    }

    fn spectrum_figure(&self, name: &str, s: &Welch, columns: &[Column], of: &[usize], unit: &str) -> Figure {
        let f = s.frequencies(self.sampling.interval);
        let curve = |&k: &usize| {
            let p = s.density(k, self.sampling.interval);
            // The first bin holds what is left of the mean and has no place on a logarithmic axis.
            Curve::line(words(&columns[k].name), f.iter().zip(p).skip(1).map(|(f, p)| [*f, p]).collect())
        };
        Figure {
            title: format!("Spectrum: {name}"),
            caption: format!(
                "One-sided power spectral density by Welch's method: {} segments of {} samples, half overlapping, Hann window.",
                s.segments(),
                2 * (f.len() - 1)
            ),
            body: Body::Curves {
                x: Axis::log("frequency", "Hz"),
                y: Axis::log("power spectral density", &per_hertz(unit)),
                curves: of.iter().map(curve).collect(),
            },
        }
    }
}

/// Adds the values of a row, and that they were there: what is not a number is left out.
fn count(sums: &mut [f64], row: &[f64]) {
    let (values, present) = sums.split_at_mut(row.len());
    for (k, &x) in row.iter().enumerate().filter(|(_, x)| x.is_finite()) {
        values[k] += x;
        present[k] += 1.0;
    }
}

/// Means of what was counted.
fn counted(sums: &Batched, columns: usize) -> Vec<Estimate> {
    sums.estimates(columns, |s, _, out| (0..columns).for_each(|k| out[k] = s[k] / s[columns + k]))
}

fn by_phase(p: &PhaseAverage, columns: &[Column]) -> Table {
    let mut t = Table::new(&[("phase", "deg"), ("samples", "1")]);
    for c in columns {
        t.columns.push(c.clone());
        t.columns.push(Column::new(format!("{}_error", c.name), &*c.unit));
    }
    for (k, bin) in p.bins().iter().enumerate().filter(|(_, b)| b.rows() > 0) {
        let mut row = vec![p.degrees(k), bin.rows() as f64];
        row.extend(counted(bin, columns.len()).iter().flat_map(|m| [m.value, m.error]));
        t.rows.push(row);
    }
    t
}

fn phase_figure(name: &str, p: &PhaseAverage, columns: &[Column], of: &[usize], unit: &str) -> Figure {
    let held = p.bins().iter().enumerate().filter(|(_, b)| b.rows() > 0);
    let means: Vec<_> = held.map(|(k, b)| (p.degrees(k), counted(b, columns.len()))).collect();
    let curve = |&k: &usize| Curve {
        error: means.iter().map(|(_, m)| m[k].error).collect(),
        ..Curve::line(words(&columns[k].name), means.iter().map(|(d, m)| [*d, m[k].value]).collect())
    };
    let cycles = p.bins().iter().map(Batched::rows).max().unwrap_or(0);
    Figure {
        title: format!("By phase: {name}"),
        caption: format!(
            "Mean over {cycles} cycles at equal phase, with standard errors from batches of cycles. \
             Phase 0 is the floor moving up at its fastest."
        ),
        body: Body::Curves {
            x: Axis::linear("phase", "deg"),
            y: Axis::linear("mean at equal phase", unit),
            curves: of.iter().map(curve).collect(),
        },
    }
}

fn words(column: &str) -> String {
    column.replace('_', " ")
}

fn per_hertz(unit: &str) -> String {
    if unit == "1" { "1/Hz".into() } else { format!("({unit})^2/Hz") }
}

fn units(columns: &[Column]) -> Vec<String> {
    let mut all: Vec<String> = vec![];
    for c in columns {
        if !all.contains(&c.unit) {
            all.push(c.unit.clone());
        }
    }
    all
}

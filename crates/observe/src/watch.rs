//! When an observer looks, and what is asked of every series.

use crate::observer::menu::{self, Observer};
use crate::observer::{Faults, Sampling, Setting};
use crate::series::Series;
use crate::stats::steady::Steady;
use crate::view::{Needs, View};
use brazilnut_base::figure::Figure;
use brazilnut_base::keys::{Check, Key, Kind};
use brazilnut_base::schedule::{Every, Schedule};
use brazilnut_base::units::Dimension;
use brazilnut_base::values::Values;
use brazilnut_base::{Column, Table, Tick};
use serde::{Deserialize, Serialize};

/// Keys of every `[[observe]]` table.
pub const COMMON: &[Key] = &[
    Key::required("what", Kind::Choice(menu::MENU), "What is measured."),
    Key::optional("name", Kind::Text, "Name of its tables; the name of the observer if left out."),
    Key::default(
        "every",
        Kind::Every,
        "\"cycle\"",
        "When: \"cycle\", \"24 per cycle\", \"5 cycles\", \"100 steps\", \"0.1 s\". Above 8192 samples a cycle there are no averages by phase.",
    ),
    Key::default(
        "phase",
        Kind::Quantity(Dimension::NONE),
        "0",
        "Phase of cycle schedules as an angle (\"90 deg\"); 0 is the floor moving up at its fastest.",
    ),
    Key::optional("of", Kind::Text, "Name of the grains that are meant; all if left out."),
    Key::default(
        "from",
        Kind::QuantityOr(Dimension::TIME, &["steady"]),
        "0",
        "First time of a sample; \"steady\": once the kinetic energy of the grains has become steady (MSER over batches of cycles).",
    )
    .with(Check::NonNegative),
    Key::optional(
        "until",
        Kind::Quantity(Dimension::TIME),
        "Last time of a sample; the end of the run if left out.",
    )
    .with(Check::Positive),
    Key::optional(
        "spectrum",
        Kind::Integer,
        "Take the power spectral density and the autocorrelation of every column of the series, in segments of so many samples.",
    )
    .with(Check::Between(8.0, 1_048_576.0)),
];

/// An observer with its schedule.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Watch {
    /// Name of its tables.
    pub name: String,
    schedule: Schedule,
    from: f64,
    until: f64,
    /// Present until the bed has been found steady, if that is when sampling begins.
    waiting: Option<Steady>,
    series: Option<Series>,
    samples: u64,
    observer: Observer,
}

impl Watch {
    /// Reads an `[[observe]]` table, common keys and its own.
    ///
    /// # Errors
    /// Everything that is wrong, by key.
    pub fn from_values(values: &Values, setting: &Setting) -> Result<Self, Faults> {
        let what = values.text("what");
        let fault = |key: &str, message: &str| vec![(key.to_string(), message.to_string())];
        let every = values.every_opt("every").unwrap_or(Every::Cycles(1));
        let turn = values.number("phase") / std::f64::consts::TAU;
        let schedule =
            Schedule::new(every, turn.rem_euclid(1.0), setting.dt, setting.steps_per_cycle, setting.steps)
                .ok_or_else(|| match setting.steps_per_cycle {
                    None => fault("every", "nothing shakes in this case: give a time or a number of steps"),
                    Some(n) => {
                        fault("every", &format!("a cycle has {n} steps: the number per cycle must divide it"))
                    }
                })?;
        let mut setting = *setting;
        setting.sampling = sampling(every, schedule, &setting);
        let observer = Observer::from_values(what, values, &setting)?;
        let columns = observer.columns().len();
        let segment = values.integer_opt("spectrum").map(|n| n as usize);
        if columns == 0 && segment.is_some() {
            return Err(fault("spectrum", "this observer keeps no series"));
        }
        let series = (columns > 0).then(|| Series::new(columns, setting.sampling, segment));
        let steady = values.text_opt("from") == Some("steady");
        Ok(Self {
            name: values.text_opt("name").unwrap_or(what).to_string(),
            schedule,
            from: values.number_opt("from").unwrap_or(0.0),
            waiting: steady.then(|| Steady::new(setting.sampling.per_cycle.unwrap_or(1))),
            series,
            samples: 0,
            until: values.number_opt("until").unwrap_or(f64::INFINITY),
            observer,
        })
    }

    /// Whether a sample falls on this step boundary.
    #[must_use]
    pub fn is_due(&self, tick: &Tick) -> bool {
        // Half a step of slack: times are whole steps only to rounding.
        let slack = 0.5 * tick.dt;
        tick.time > self.from - slack && tick.time < self.until + slack && self.schedule.is_due(tick.index)
    }

    /// What must be prepared for a sample.
    #[must_use]
    pub fn needs(&self) -> Needs {
        self.observer.needs()
    }

    /// Samples taken so far.
    #[must_use]
    pub fn samples(&self) -> u64 {
        self.samples
    }

    /// What is observed.
    #[must_use]
    pub fn observer(&self) -> &Observer {
        &self.observer
    }

    /// Columns of the series, time first; none if there is no series.
    #[must_use]
    pub fn columns(&self) -> Vec<Column> {
        let own = self.observer.columns();
        if own.is_empty() {
            return own;
        }
        let mut all = vec![Column::new("time", "s"), Column::new("cycle", "1")];
        all.extend(own);
        all
    }

    /// Takes a sample: a row of the series, if there is one.
    pub fn observe(&mut self, view: &View) -> Option<Vec<f64>> {
        if let Some(steady) = &mut self.waiting {
            if !steady.add(kinetic_energy(view)) {
                return None;
            }
            self.waiting = None;
        }
        self.samples += 1;
        let row = self.observer.observe(view)?;
        if let Some(series) = &mut self.series {
            series.add(view.tick.time, view.cycle, &row);
        }
        let mut all = Vec::with_capacity(row.len() + 2);
        all.extend([view.tick.time, view.cycle]);
        all.extend(row);
        Some(all)
    }

    /// Means with errors, profiles, fields, spectra; tables are named within the watch (`means`, `by-phase`).
    /// None without a sample.
    #[must_use]
    pub fn results(&self) -> Vec<(String, Table)> {
        if self.samples == 0 {
            return vec![];
        }
        let mut all = self.observer.results();
        if let Some(series) = &self.series {
            all.extend(series.results(&self.observer.columns()));
        }
        all
    }

    /// Plots for the report; `series` holds the rows returned so far. None without a sample.
    #[must_use]
    pub fn figures(&self, series: &Table) -> Vec<Figure> {
        if self.samples == 0 {
            return vec![];
        }
        let mut all = self.observer.figures(series);
        if let Some(s) = &self.series {
            all.extend(s.figures(&self.name, &self.observer.columns()));
        }
        all
    }
}

/// Kinetic energy of translation of all grains, J.
fn kinetic_energy(view: &View) -> f64 {
    let g = view.grains;
    (0..g.len()).map(|k| 0.5 * g.mass[k] * g.velocity[k].length_squared()).sum()
}

/// Samples of a cycle above which no phase has an average of its own: one of every step of a long cycle would take
/// gigabytes.
const MOST_PHASES: u64 = 8192;

/// What a schedule means in time and cycles.
fn sampling(every: Every, schedule: Schedule, setting: &Setting) -> Sampling {
    if every == Every::End {
        return Sampling { interval: setting.steps as f64 * setting.dt, ..Sampling::default() };
    }
    let whole = |a: u64, b: u64| (b > 0 && a.is_multiple_of(b)).then(|| a / b);
    let spc = setting.steps_per_cycle;
    Sampling {
        interval: schedule.period as f64 * setting.dt,
        per_cycle: spc.and_then(|s| whole(s, schedule.period)).filter(|&n| n <= MOST_PHASES),
        cycles: spc.and_then(|s| whole(schedule.period, s)),
        phase: spc.map_or(0.0, |s| (schedule.offset % schedule.period.min(s)) as f64 / s as f64),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthetic::{Stage, setting, values};
    use brazilnut_base::values::Value;
    use brazilnut_base::vec3;

    fn table(extra: &[(&str, Value)]) -> Values {
        let keys: Vec<Key> = COMMON.iter().chain(menu::keys("bed").unwrap()).copied().collect();
        let mut v = values(&keys, &[]);
        v.insert("what", Value::Text("bed".into()), None);
        for (k, x) in extra {
            assert!(keys.iter().any(|key| key.name == *k), "no key {k}");
            v.insert(k, x.clone(), None);
        }
        v
    }

    fn watch(extra: &[(&str, Value)]) -> Result<Watch, Faults> {
        let cell = Stage::new(vec3(1.0, 1.0, 1.0), "walls").cell;
        Watch::from_values(&table(extra), &setting(&cell, &[("all".into(), 1)]))
    }

    #[test]
    fn samples_fall_on_the_phase_and_in_the_span() {
        let w = watch(&[
            ("every", Value::Every(Every::Cycles(1))),
            ("phase", Value::Number(std::f64::consts::FRAC_PI_2)),
            ("from", Value::Number(0.2)),
            ("until", Value::Number(0.5)),
        ])
        .unwrap();
        let due: Vec<u64> = (0..1000).filter(|&i| w.is_due(&Tick::at(i, 1e-3))).collect();
        assert_eq!(due, [225, 325, 425]);
    }

    #[test]
    fn without_a_sample_there_is_nothing_to_show() {
        let w = watch(&[("from", Value::Number(1e9))]).unwrap();
        assert!(w.samples() == 0 && w.results().is_empty() && w.figures(&Table::default()).is_empty());
    }

    #[test]
    fn a_schedule_that_does_not_fit_is_refused_with_its_key() {
        let faults = watch(&[("every", Value::Every(Every::PerCycle(7)))]).unwrap_err();
        assert_eq!(faults[0].0, "every");
        assert!(faults[0].1.contains("100 steps"), "{}", faults[0].1);
        let faults = watch(&[("of", Value::Text("al".into()))]).unwrap_err();
        assert!(faults[0].1.contains("did you mean `all`"), "{}", faults[0].1);
    }

    #[test]
    fn a_series_brings_its_means_phases_and_spectrum() {
        let mut stage = Stage::new(vec3(1.0, 1.0, 1.0), "walls");
        stage.add(vec3(0.5, 0.5, 0.5), 0.1);
        let mut w =
            watch(&[("every", Value::Every(Every::PerCycle(10))), ("spectrum", Value::Integer(64))]).unwrap();
        for k in 0..640 {
            stage.time = 0.01 * f64::from(k);
            stage.grains.position[0].z = 0.5 + 0.1 * (std::f64::consts::TAU * 10.0 * stage.time).sin();
            assert!(w.is_due(&stage.view().tick));
            let row = w.observe(&stage.view()).unwrap();
            assert_eq!(row.len(), w.columns().len());
        }
        let results = w.results();
        let table = |name: &str| &results.iter().find(|r| r.0 == name).unwrap().1;
        let gap = table("by-phase").column("gap").unwrap();
        assert_eq!(gap.len(), 10);
        // Phase 72° is the third of ten bins.
        assert!((gap[2] - 0.4 - 0.1 * 72_f64.to_radians().sin()).abs() < 1e-12);
        let power = table("spectrum").column("gap").unwrap();
        let f = table("spectrum").column("frequency").unwrap();
        let peak = (0..power.len()).max_by(|&a, &b| power[a].total_cmp(&power[b])).unwrap();
        assert!((f[peak] - 10.0).abs() < 1.0);
        let mean = table("means").column("centre_of_mass_z").unwrap();
        assert!((mean[0] - 0.5).abs() < 1e-12);
        let rho = table("autocorrelation").column("gap").unwrap();
        // Segments of 6.4 periods: the part of a period left over shifts the products by some per cent.
        assert!((rho[10] - 1.0).abs() < 0.1 && (rho[5] + 1.0).abs() < 0.1, "{} {}", rho[10], rho[5]);
        assert!(!w.figures(&Table::default()).is_empty());
        // Saved and read back in the middle of segments and batches, it goes on the same.
        let mut again: Watch = rmp_serde::from_slice(&rmp_serde::to_vec(&w).unwrap()).unwrap();
        for k in 640..777 {
            stage.time = 0.01 * f64::from(k);
            stage.grains.position[0].z = 0.5 + 0.1 * (f64::from(k) * 0.3).cos();
            let (a, b) = (w.observe(&stage.view()), again.observe(&stage.view()));
            assert_eq!(format!("{a:?}"), format!("{b:?}"));
        }
        assert_eq!(rmp_serde::to_vec(&w).unwrap(), rmp_serde::to_vec(&again).unwrap());
    }

    #[test]
    fn waits_until_the_bed_is_steady() {
        let mut stage = Stage::new(vec3(1.0, 1.0, 1.0), "walls");
        stage.add(vec3(0.5, 0.5, 0.5), 0.1);
        let mut w =
            watch(&[("every", Value::Every(Every::Cycles(1))), ("from", Value::Text("steady".into()))])
                .unwrap();
        let noise = crate::stats::known::white(600, 1e-4, 3);
        let mut first = None;
        for k in 0..600 {
            stage.time = 0.1 * k as f64;
            stage.grains.velocity[0].x = 1.0 + noise[k] + 3.0 * (-(k as f64) / 20.0).exp();
            if w.observe(&stage.view()).is_some() && first.is_none() {
                first = Some(k);
            }
        }
        // The transient sinks into the noise of 0.01 after 20 ln(300) = 114 samples; as much must follow.
        let first = first.unwrap();
        assert!((120..500).contains(&first), "{first}");
    }
}

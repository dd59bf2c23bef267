//! When an observer looks, and what is asked of every series.

use crate::observer::menu::{self, Observer};
use crate::observer::{Faults, Sampling, Setting};
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
        "When: \"cycle\", \"24 per cycle\", \"5 cycles\", \"100 steps\", \"0.1 s\".",
    ),
    Key::default(
        "phase",
        Kind::Quantity(Dimension::NONE),
        "0",
        "Phase of cycle schedules as an angle (\"90 deg\"); 0 is the floor moving up at its fastest.",
    ),
    Key::optional("of", Kind::Text, "Name of the grains that are meant; all if left out."),
    Key::default("from", Kind::Quantity(Dimension::TIME), "0", "First time of a sample.")
        .with(Check::NonNegative),
    Key::optional(
        "until",
        Kind::Quantity(Dimension::TIME),
        "Last time of a sample; the end of the run if left out.",
    )
    .with(Check::Positive),
];

/// An observer with its schedule.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Watch {
    /// Name of its tables.
    pub name: String,
    schedule: Schedule,
    from: f64,
    until: f64,
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
        setting.sampling = sampling(schedule, &setting);
        let observer = Observer::from_values(what, values, &setting)?;
        Ok(Self {
            name: values.text_opt("name").unwrap_or(what).to_string(),
            schedule,
            from: values.number("from"),
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
        let row = self.observer.observe(view)?;
        let mut all = Vec::with_capacity(row.len() + 2);
        all.extend([view.tick.time, view.cycle]);
        all.extend(row);
        Some(all)
    }

    /// Means with errors, profiles, fields, spectra.
    #[must_use]
    pub fn results(&self) -> Vec<(String, Table)> {
        self.observer.results()
    }

    /// Plots for the report; `series` holds the rows returned so far.
    #[must_use]
    pub fn figures(&self, series: &Table) -> Vec<Figure> {
        self.observer.figures(series)
    }
}

/// What a schedule means in time and cycles.
fn sampling(schedule: Schedule, setting: &Setting) -> Sampling {
    let whole = |a: u64, b: u64| (b > 0 && a.is_multiple_of(b)).then(|| a / b);
    let spc = setting.steps_per_cycle;
    Sampling {
        interval: schedule.period as f64 * setting.dt,
        per_cycle: spc.and_then(|s| whole(s, schedule.period)),
        cycles: spc.and_then(|s| whole(schedule.period, s)),
    }
}

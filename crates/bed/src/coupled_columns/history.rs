//! From flight to flight until a column is empty.

use super::CoupledColumnsSpec;
use super::columns::{Columns, Flying, State, speeds};
use crate::bed_equation::BedLaw;
use crate::ode::{Accuracy, Ending, Step, integrate};
use crate::shake::Shake;
use crate::system::{Refusals, stalled};
use crate::with_bed_law;
use std::f64::consts::TAU;

/// Heights at the start of one cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment {
    /// Time, s.
    pub time: f64,
    /// Height of column 1, m.
    pub h1: f64,
    /// Height of column 2, m.
    pub h2: f64,
}

/// Both columns at one phase.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ColumnSample {
    /// Degrees since the start of the cycle.
    pub phase: f64,
    /// Gaps under the beds, m.
    pub gap: [f64; 2],
    /// Velocities of the beds relative to the cell, m/s.
    pub u: [f64; 2],
    /// Superficial fluid velocities relative to the beds, m/s.
    pub v: [f64; 2],
    /// Velocity through the channel from 1 to 2, m/s.
    pub channel: f64,
    /// Pressure under column 1, hydrostatic part removed, Pa.
    pub pressure: f64,
}

/// The transfer between the columns.
#[derive(Clone, Debug)]
pub struct CoupledColumns {
    /// What was solved.
    pub spec: CoupledColumnsSpec,
    /// Period of the shake, s.
    pub period: f64,
    /// Γ of the shake.
    pub gamma: f64,
    /// Heights, once a cycle.
    pub history: Vec<Moment>,
    /// When a column came down to one grain, if it did, s.
    pub emptied: Option<f64>,
    /// Phases of the first landing of each column, degrees.
    pub landing_phases: [Option<f64>; 2],
    /// The first cycle after the ramp.
    pub first_cycle: Vec<ColumnSample>,
}

/// Follows the columns.
///
/// # Errors
/// The refusals of [`CoupledColumnsSpec::validate`], or an integration at a standstill.
pub fn solve(spec: &CoupledColumnsSpec) -> Result<CoupledColumns, Refusals> {
    spec.validate()?;
    let shake = Shake::new(&spec.shake, spec.gravity).map_err(|e| vec![("gamma", e)])?;
    let (medium, drift) = (spec.medium(), spec.coupling * shake.gamma());
    with_bed_law!(spec.bed_equation, law => {
        let columns = Columns { spec, law, medium, drift };
        Run { columns, shake: &shake, time: 0.0, flying: [false; 2], landings: [None; 2] }.follow()
    })
}

/// Hold over gravity below which a resting bed leaves the floor when the other
/// bed does: equal beds leave together, whatever the rounding.
const TOUCHING: f64 = 1e-9;

struct Run<'a, L> {
    columns: Columns<'a, L>,
    shake: &'a Shake,
    time: f64,
    flying: Flying,
    landings: [Option<f64>; 2],
}

impl<L: BedLaw> Run<'_, L> {
    fn follow(mut self) -> Result<CoupledColumns, Refusals> {
        let spec = self.columns.spec;
        let period = self.shake.period;
        let mut y: State = [0.0; 6];
        y[5] = 0.5 * (spec.total_height + spec.height_difference);
        let moment = |time: f64, y: &State| Moment { time, h1: spec.total_height - y[5], h2: y[5] };
        let mut history = vec![moment(0.0, &y)];
        let mut first_cycle = vec![];
        let shown = (self.shake.ramp() / period).ceil() as u64;
        let mut emptied = None;
        for cycle in 0..(spec.duration / period).ceil() as u64 {
            let mut pieces: Vec<(Flying, Step<6>)> = vec![];
            let empty = self.cycle(&mut y, (cycle + 1) as f64 * period, |flying, s| {
                if cycle == shown {
                    pieces.push((flying, *s));
                }
            })?;
            if cycle == shown {
                first_cycle = self.samples(&pieces, cycle as f64 * period);
            }
            history.push(moment(self.time, &y));
            if empty {
                emptied = Some(self.time);
                break;
            }
        }
        Ok(CoupledColumns {
            spec: spec.clone(),
            period,
            gamma: self.shake.gamma(),
            history,
            emptied,
            landing_phases: self.landings,
            first_cycle,
        })
    }

    /// Advances to `end`, or until a column is down to one grain (then true).
    fn cycle(
        &mut self,
        y: &mut State,
        end: f64,
        mut seen: impl FnMut(Flying, &Step<6>),
    ) -> Result<bool, Refusals> {
        let spec = self.columns.spec;
        let speed = self.shake.gravity * self.shake.period / TAU;
        let length = speed * self.shake.period / TAU;
        let scale = [length, speed, length, speed, speed, spec.total_height];
        let accuracy = Accuracy {
            relative: spec.tolerance,
            absolute: scale.map(|s| spec.tolerance * s),
            longest: 0.05 * self.shake.period,
        };
        self.launch(y, 0.0, None);
        // Each flight costs two events; beds that rounding throws and drops at once must not go on for ever.
        for _ in 0..1000 {
            let flying = self.flying;
            let outcome = integrate(
                |t, y| self.slope(t, y, flying),
                |t, y| self.events(t, y, flying),
                self.time,
                *y,
                end,
                &accuracy,
                |s| seen(flying, s),
            );
            match outcome {
                Ending::Reached(state) => {
                    (self.time, *y) = (end, state);
                    return Ok(false);
                }
                Ending::Stuck(t) => return Err(stalled(t)),
                Ending::Event { which, time, state } => {
                    (self.time, *y) = (time, state);
                    match which {
                        2 => return Ok(true),
                        i if flying[i] => self.land(y, i),
                        i => {
                            self.flying[i] = true;
                            self.launch(y, TOUCHING, None);
                        }
                    }
                }
            }
        }
        Err(stalled(self.time))
    }

    fn slope(&self, t: f64, y: &State, flying: Flying) -> State {
        let now = self.columns.instant(y, flying, self.shake.weight(t));
        let gain =
            if flying == [true; 2] { self.columns.drift * self.columns.exchange(y, now.v) } else { 0.0 };
        let fly = |i: usize| if flying[i] { (speeds(y)[i], now.lift[i]) } else { (0.0, 0.0) };
        let ((g1, u1), (g2, u2)) = (fly(0), fly(1));
        [g1, u1, g2, u2, now.v1_rate, gain]
    }

    /// A flying bed's gap, a resting bed's hold on the floor, and what is left of the shallower column.
    fn events(&self, t: f64, y: &State, flying: Flying) -> [f64; 3] {
        let left = y[5].min(self.columns.spec.total_height - y[5]) - self.columns.spec.diameter;
        let hold = if flying == [true; 2] { [0.0; 2] } else { self.hold(t, y, flying) };
        let at = |i: usize| if flying[i] { y[2 * i] } else { hold[i] };
        [at(0), at(1), left]
    }

    /// Acceleration with which each bed is held to the floor, m/s²; it leaves when this turns negative.
    fn hold(&self, t: f64, y: &State, flying: Flying) -> [f64; 2] {
        let weight = self.shake.weight(t);
        let lift = self.columns.instant(y, flying, weight).lift;
        lift.map(|l| if self.columns.spec.relaunch { -l } else { weight.max(-l) })
    }

    fn land(&mut self, y: &mut State, i: usize) {
        *y = self.columns.land(y, self.flying, i);
        self.flying[i] = false;
        if self.time >= self.shake.ramp() {
            let phase = 360.0 * (self.time / self.shake.period).fract();
            let _ = self.landings[i].get_or_insert(phase);
        }
        // What has just landed flies again only if it is really lifted.
        self.launch(y, TOUCHING, Some(i));
    }

    /// Sets flying every resting bed that is held by less than `margin` g; for `landed` the margin is zero.
    fn launch(&mut self, y: &State, margin: f64, landed: Option<usize>) {
        let hold = self.hold(self.time, y, self.flying);
        for i in 0..2 {
            let margin = if landed == Some(i) { 0.0 } else { margin * self.shake.gravity };
            if !self.flying[i] && hold[i] < margin {
                self.flying[i] = true;
            }
        }
    }

    fn samples(&self, pieces: &[(Flying, Step<6>)], start: f64) -> Vec<ColumnSample> {
        let n = self.columns.spec.phases;
        (0..n)
            .filter_map(|k| {
                let part = f64::from(k) / f64::from(n);
                let t = start + part * self.shake.period;
                let (flying, step) = pieces.get(pieces.partition_point(|(_, s)| s.end < t))?;
                let y = step.at(t.max(step.start));
                let now = self.columns.instant(&y, *flying, self.shake.weight(t));
                Some(ColumnSample {
                    phase: 360.0 * part,
                    gap: [y[0], y[2]],
                    u: speeds(&y),
                    v: now.v,
                    channel: self.columns.spec.area_ratio * self.columns.exchange(&y, now.v),
                    pressure: now.pressure,
                })
            })
            .collect()
    }
}

impl CoupledColumns {
    /// When the height difference first reached `difference` (m), s; between cycles by a straight line.
    #[must_use]
    pub fn time_to(&self, difference: f64) -> Option<f64> {
        let dh = |m: &Moment| m.h2 - m.h1;
        let k = self.history.iter().position(|m| dh(m) >= difference)?;
        let b = &self.history[k];
        let Some(a) = k.checked_sub(1).map(|k| &self.history[k]) else { return Some(b.time) };
        Some(a.time + (b.time - a.time) * (difference - dh(a)) / (dh(b) - dh(a)))
    }

    /// The height difference at time `t` (s), m; that at the end if it ended sooner.
    #[must_use]
    pub fn difference_at(&self, t: f64) -> f64 {
        let k = self.history.partition_point(|m| m.time < t).min(self.history.len() - 1);
        self.history[k].h2 - self.history[k].h1
    }
}

/// p of t ∝ Γ^−p by least squares through the logarithms of (Γ, t); NaN for fewer than two points.
#[must_use]
pub fn collapse_exponent(times: &[(f64, f64)]) -> f64 {
    let n = times.len() as f64;
    let points: Vec<(f64, f64)> = times.iter().map(|(g, t)| (g.ln(), t.ln())).collect();
    let (mx, my) = points.iter().fold((0.0, 0.0), |m, p| (m.0 + p.0 / n, m.1 + p.1 / n));
    let (xx, xy) =
        points.iter().fold((0.0, 0.0), |s, p| (s.0 + (p.0 - mx).powi(2), s.1 + (p.0 - mx) * (p.1 - my)));
    -xy / xx
}

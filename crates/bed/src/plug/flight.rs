//! Flights of a plug from take-off to landing, until they repeat themselves.

use super::PlugSpec;
use crate::bed_equation::{BedLaw, Medium};
use crate::ode::{Accuracy, Ending, MOST_STEPS, Step, integrate};
use crate::shake::{Shake, minimum};
use crate::system::{Refusals, stalled};
use crate::with_bed_law;
use std::f64::consts::TAU;

/// Take-offs whose phases differ by less than this fraction of a cycle are the same.
const SAME_PHASE: f64 = 1e-9;
/// A motion that nearly repeats itself sooner, within this, is given time to do so.
const NEAR_PHASE: f64 = 1e-5;

/// One flight.
#[derive(Clone, Debug)]
pub struct Flight {
    /// Take-off, s.
    pub takeoff: f64,
    /// Landing, s.
    pub landing: f64,
    steps: Vec<Step<2>>,
}

/// The plug at one phase.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sample {
    /// Degrees since the start of the cycle in which the motion's period starts.
    pub phase: f64,
    /// Gap under the bed, m.
    pub gap: f64,
    /// Velocity relative to the cell, m/s.
    pub velocity: f64,
    /// Base pressure from the flow through the bed alone, Pa.
    pub viscous_pressure: f64,
    /// Base pressure with the inertia of the fluid, Pa; hydrostatic part removed.
    pub pressure: f64,
}

/// An extreme value and the phase at which it occurs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Peak {
    /// The value.
    pub value: f64,
    /// Its phase, degrees.
    pub phase: f64,
}

/// The extremes of a period of the motion.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Peaks {
    /// Largest gap, m.
    pub gap: Peak,
    /// Largest viscous pressure, Pa.
    pub viscous_over: Peak,
    /// Least viscous pressure, Pa.
    pub viscous_under: Peak,
    /// Largest pressure, Pa.
    pub over: Peak,
    /// Least pressure, Pa.
    pub under: Peak,
}

/// A plug in its periodic state.
#[derive(Clone, Debug)]
pub struct Plug {
    /// What was solved.
    pub spec: PlugSpec,
    /// Period of the shake, s.
    pub period: f64,
    /// Γ: largest downward acceleration of the floor over gravity.
    pub gamma: f64,
    /// Cycles after which the motion repeats itself; `None` if it did not within the limit.
    pub multiplicity: Option<u32>,
    /// Cycles before the motion that repeats itself.
    pub transient: u32,
    /// The flights of one period of the motion; empty if the bed is never thrown.
    pub flights: Vec<Flight>,
    /// Its extremes.
    pub peaks: Peaks,
    shown: u32,
    origin: f64,
}

/// Throws the plug until its motion repeats itself.
///
/// # Errors
/// The refusals of [`PlugSpec::validate`], or an integration at a standstill.
pub fn solve(spec: &PlugSpec) -> Result<Plug, Refusals> {
    spec.validate()?;
    let shake = Shake::new(&spec.shake, spec.gravity).map_err(|e| vec![("gamma", e)])?;
    with_bed_law!(spec.bed_equation, law => settle(spec, &shake, &Bed::new(spec, law)))
}

/// The constants of the equation of motion.
struct Bed<L> {
    law: L,
    medium: Medium,
    height: f64,
    /// 1 + ρ(1−φ)/(ρ_g φ), or 1.
    inertia: f64,
    /// 1 − ρ/ρ_g, or 1.
    buoyancy: f64,
    /// ρ_g (1−φ), kg/m³.
    mass: f64,
    /// ρ(1−φ)/φ, kg/m³, or 0.
    added: f64,
}

impl<L: BedLaw> Bed<L> {
    fn new(spec: &PlugSpec, law: L) -> Self {
        let (phi, solids) = (spec.porosity, 1.0 - spec.porosity);
        let density = if spec.modified { spec.fluid_density } else { 0.0 };
        Self {
            law,
            medium: spec.medium(),
            height: spec.height,
            inertia: 1.0 + density * solids / (spec.grain_density * phi),
            buoyancy: 1.0 - density / spec.grain_density,
            mass: spec.grain_density * solids,
            added: density * solids / phi,
        }
    }

    /// u̇ of Clément eq. 2.50 and 2.51, m/s², for velocity `u` and effective gravity `weight` = g + z̈_c.
    #[inline]
    fn acceleration(&self, u: f64, weight: f64) -> f64 {
        -(self.buoyancy * weight + self.law.gradient(u, &self.medium) / self.mass) / self.inertia
    }

    /// Base pressure −h K(u) u, Pa.
    fn viscous_pressure(&self, u: f64) -> f64 {
        -self.height * self.law.gradient(u, &self.medium)
    }

    /// Base pressure −h [K(u) u + ρ(1−φ)/φ u̇], Pa.
    fn pressure(&self, u: f64, weight: f64) -> f64 {
        self.viscous_pressure(u) - self.height * self.added * self.acceleration(u, weight)
    }

    /// One flight from rest on the floor at `takeoff`, at most to `limit`; `None` if it has not landed by then.
    fn fly(
        &self,
        shake: &Shake,
        takeoff: f64,
        limit: f64,
        tolerance: f64,
    ) -> Result<Option<Flight>, Refusals> {
        // Gap and speed of free flight over one period set the scales.
        let speed = shake.gravity * shake.period / TAU;
        let accuracy = Accuracy {
            relative: tolerance,
            absolute: [tolerance * speed * shake.period / TAU, tolerance * speed],
            longest: 0.05 * shake.period,
        };
        let slope = |t: f64, y: &[f64; 2]| [y[1], self.acceleration(y[1], shake.weight(t))];
        let mut steps = Vec::with_capacity(48);
        match integrate(slope, |_, y| [y[0]], takeoff, [0.0; 2], limit, &accuracy, |s| steps.push(*s)) {
            Ending::Event { time, .. } => Ok(Some(Flight { takeoff, landing: time, steps })),
            Ending::Reached(_) => Ok(None),
            Ending::Stuck(t) => Err(stalled(t)),
        }
    }
}

/// Follows flights until one starts at the phase of an earlier one.
fn settle<L: BedLaw>(spec: &PlugSpec, shake: &Shake, bed: &Bed<L>) -> Result<Plug, Refusals> {
    let period = shake.period;
    let limit = shake.ramp() + f64::from(spec.cycles) * period;
    let mut flights: Vec<Flight> = vec![];
    let mut next = shake.next_throw(0.0);
    let mut found = None;
    while let Some(takeoff) = next.filter(|&t| t < limit) {
        if takeoff >= shake.ramp() {
            found = recurrence(&flights, takeoff, shake);
        }
        if found.is_some() {
            break;
        }
        let Some(flight) = bed.fly(shake, takeoff, limit + 100.0 * period, spec.tolerance)? else { break };
        if flight.landing <= flight.takeoff {
            // Thrown by no more than rounding.
            next = None;
            break;
        }
        next = shake.next_throw(flight.landing);
        flights.push(flight);
        if flights.iter().map(|f| f.steps.len()).sum::<usize>() > MOST_STEPS {
            return Err(stalled(takeoff));
        }
    }
    let at_rest = next.is_none();
    let (first, multiplicity) = match found {
        Some((first, cycles)) => (first, Some(cycles)),
        None if at_rest => (flights.len(), Some(1)),
        // Not periodic: the last sixteen cycles stand for it.
        None => (flights.partition_point(|f| f.takeoff < limit - 16.0 * period), None),
    };
    let flights = flights.split_off(first);
    let start = flights.first().map_or(shake.ramp(), |f| f.takeoff);
    let origin = (start / period).floor() * period;
    let end = flights.last().map_or(start, |f| f.landing);
    let shown = multiplicity.unwrap_or_else(|| ((end - origin) / period).ceil() as u32);
    let mut plug = Plug {
        spec: spec.clone(),
        period,
        gamma: shake.gamma(),
        multiplicity,
        transient: (origin / period).round() as u32,
        flights,
        peaks: Peaks::default(),
        shown,
        origin,
    };
    plug.peaks = plug.find_peaks(shake, bed);
    Ok(plug)
}

/// The earlier flight that began at the phase of `takeoff`, and the cycles since.
///
/// A slow approach to a shorter period looks like a longer one for a while:
/// no repetition is accepted as long as a shorter one is near.
fn recurrence(flights: &[Flight], takeoff: f64, shake: &Shake) -> Option<(usize, u32)> {
    for (k, f) in flights.iter().enumerate().rev() {
        if f.takeoff < shake.ramp() {
            return None;
        }
        let cycles = (takeoff - f.takeoff) / shake.period;
        let off = (cycles - cycles.round()).abs();
        if off < SAME_PHASE && cycles.round() >= 1.0 {
            return Some((k, cycles.round() as u32));
        }
        if off < NEAR_PHASE {
            return None;
        }
    }
    None
}

impl Plug {
    /// Phase of time `t` in degrees since the start of the cycle in which the period starts.
    fn phase(&self, t: f64) -> f64 {
        360.0 * (t - self.origin) / self.period
    }

    /// Phase of the first take-off, degrees (Clément eq. 2.44 for a sinusoid).
    #[must_use]
    pub fn takeoff_phase(&self) -> Option<f64> {
        self.flights.first().map(|f| self.phase(f.takeoff))
    }

    /// Phase of the first landing, degrees; above 360 in a later cycle than the take-off.
    #[must_use]
    pub fn landing_phase(&self) -> Option<f64> {
        self.flights.first().map(|f| self.phase(f.landing))
    }

    /// Take-off and landing phases (degrees) and largest gap (m) of each flight.
    #[must_use]
    pub fn flight_phases(&self) -> Vec<(f64, f64, f64)> {
        let gap = |f: &Flight| highest(f, |_, y| y[0]).value;
        self.flights.iter().map(|f| (self.phase(f.takeoff), self.phase(f.landing), gap(f))).collect()
    }

    /// Number of cycles that [`samples`](Self::samples) covers: the multiplicity if the motion is periodic.
    #[must_use]
    pub fn cycles_shown(&self) -> u32 {
        self.shown
    }

    /// Gap, velocity and pressures at `spec.phases` phases of each cycle of a period.
    #[must_use]
    pub fn samples(&self) -> Vec<Sample> {
        let Ok(shake) = Shake::new(&self.spec.shake, self.spec.gravity) else { return vec![] };
        let n = self.spec.phases;
        let bed = Bed::new(&self.spec, self.spec.bed_equation);
        (0..n * self.shown)
            .map(|k| {
                let t = self.origin + self.period * f64::from(k) / f64::from(n);
                let phase = 360.0 * f64::from(k) / f64::from(n);
                self.in_flight(t).map_or(Sample { phase, ..Sample::default() }, |(t, [gap, u])| Sample {
                    phase,
                    gap,
                    velocity: u,
                    viscous_pressure: bed.viscous_pressure(u),
                    pressure: bed.pressure(u, shake.weight(t)),
                })
            })
            .collect()
    }

    /// Time and state of the flight that passes through `t`, or through `t` one period of the motion later.
    fn in_flight(&self, t: f64) -> Option<(f64, [f64; 2])> {
        let turn = f64::from(self.multiplicity.unwrap_or(0)) * self.period;
        [t, t + turn].into_iter().find_map(|t| {
            let flight = self.flights.iter().find(|f| (f.takeoff..=f.landing).contains(&t))?;
            let k = flight.steps.partition_point(|s| s.end < t).min(flight.steps.len() - 1);
            Some((t, flight.steps[k].at(t)))
        })
    }

    fn find_peaks<L: BedLaw>(&self, shake: &Shake, bed: &Bed<L>) -> Peaks {
        let mut peaks = Peaks::default();
        for flight in &self.flights {
            let keep = |best: &mut Peak, sign: f64, value: &dyn Fn(f64, &[f64; 2]) -> f64| {
                let p = highest(flight, |t, y| sign * value(t, y));
                if p.value > sign * best.value {
                    *best = Peak { value: sign * p.value, phase: self.phase(p.phase) };
                }
            };
            let viscous = |_: f64, y: &[f64; 2]| bed.viscous_pressure(y[1]);
            let total = |t: f64, y: &[f64; 2]| bed.pressure(y[1], shake.weight(t));
            keep(&mut peaks.gap, 1.0, &|_, y| y[0]);
            keep(&mut peaks.viscous_over, 1.0, &viscous);
            keep(&mut peaks.viscous_under, -1.0, &viscous);
            keep(&mut peaks.over, 1.0, &total);
            keep(&mut peaks.under, -1.0, &total);
        }
        peaks
    }
}

/// The largest value along a flight, and the time at which it occurs.
fn highest(flight: &Flight, value: impl Fn(f64, &[f64; 2]) -> f64) -> Peak {
    let mut best = Peak { value: f64::NEG_INFINITY, phase: 0.0 };
    let mut at = 0;
    for (k, s) in flight.steps.iter().enumerate() {
        for t in [s.start, 0.5 * (s.start + s.end), s.end] {
            let v = value(t, &s.at(t));
            if v > best.value {
                (best, at) = (Peak { value: v, phase: t }, k);
            }
        }
    }
    for s in &flight.steps[at.saturating_sub(1)..(at + 2).min(flight.steps.len())] {
        let t = minimum(|t| -value(t, &s.at(t)), s.start, s.end);
        let v = value(t, &s.at(t));
        if v > best.value {
            best = Peak { value: v, phase: t };
        }
    }
    best
}

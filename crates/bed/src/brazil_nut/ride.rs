//! The intruder's ride on the flights of the bed.

use super::BrazilNutSpec;
use crate::bed_equation::{BedLaw, Medium};
use crate::ode::{Accuracy, Ending, Step, integrate};
use crate::shake::Shake;
use crate::system::{Refusals, stalled};
use crate::with_bed_law;
use std::f64::consts::TAU;

/// Gap of the bed, its velocity, height of the intruder's centre, its velocity (m, m/s, in the cell).
pub(super) type State = [f64; 4];

/// The intruder after one flight of the bed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rise {
    /// Landing of the bed, s.
    pub time: f64,
    /// Gap H between the intruder's lowest point and the base, m.
    pub gap: f64,
}

/// The way of the intruder through the bed.
#[derive(Clone, Debug)]
pub struct BrazilNut {
    /// What was solved.
    pub spec: BrazilNutSpec,
    /// Period of the shake, s.
    pub period: f64,
    /// Γ of the shake.
    pub gamma: f64,
    /// The start, and the intruder after each flight.
    pub history: Vec<Rise>,
    /// When its top came level with the surface, if it did, s.
    pub emerged: Option<f64>,
    /// The first flight: phase (deg), gap under the bed, height of the intruder's centre (m).
    pub first_flight: Vec<[f64; 3]>,
}

/// Follows the intruder to the surface.
///
/// # Errors
/// The refusals of [`BrazilNutSpec::validate`], or an integration at a standstill.
pub fn solve(spec: &BrazilNutSpec) -> Result<BrazilNut, Refusals> {
    spec.validate()?;
    let shake = Shake::new(&spec.shake, spec.gravity).map_err(|e| vec![("gamma", e)])?;
    with_bed_law!(spec.bed_equation, law => Column::new(spec, &shake, law).rise())
}

/// How the intruder moves through the bed.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Ride {
    /// With the bed: friction holds it.
    Held,
    /// Upwards through the bed (+1) or downwards (−1).
    Sliding(f64),
    /// On the base of the cell.
    Grounded,
}

struct Column<'a, L> {
    spec: &'a BrazilNutSpec,
    shake: &'a Shake,
    law: L,
    medium: Medium,
    /// 1 + ρ(1−φ)/(ρ_H φ).
    inertia: f64,
    /// 1 − ρ/ρ_H.
    buoyancy: f64,
    /// ρ_H (1−φ), kg/m³.
    mass: f64,
    volume: f64,
    radius: f64,
}

impl<'a, L: BedLaw> Column<'a, L> {
    fn new(spec: &'a BrazilNutSpec, shake: &'a Shake, law: L) -> Self {
        let (phi, ratio) = (spec.porosity, spec.fluid_density / spec.grain_density);
        Self {
            spec,
            shake,
            law,
            medium: spec.medium(),
            inertia: 1.0 + ratio * (1.0 - phi) / phi,
            buoyancy: 1.0 - ratio,
            mass: spec.grain_density * (1.0 - phi),
            volume: spec.intruder_volume(),
            radius: 0.5 * spec.intruder_diameter,
        }
    }

    /// u̇ of Clément eq. 6.1, m/s².
    fn bed(&self, u: f64, weight: f64) -> f64 {
        -(self.buoyancy * weight + self.law.gradient(u, &self.medium) / self.mass) / self.inertia
    }

    /// z̈_I of Clément eq. 6.3 without F_bed, m/s².
    fn intruder(&self, u: f64, weight: f64) -> f64 {
        let fluid = -self.law.gradient(u, &self.medium) * self.spec.drag_factor;
        (fluid - (self.spec.intruder_density - self.spec.fluid_density) * weight) / self.spec.intruder_density
    }

    /// |F_bed|/(ρ_I V_I) of Clément eq. 6.5, m/s²; zero once the intruder's top is out of the bed.
    fn friction(&self, y: &State) -> f64 {
        let depth = self.spec.height - (y[2] - y[0] + self.radius);
        let grip = if depth > 0.0 { -(-depth / self.spec.range).exp_m1() } else { 0.0 };
        self.spec.alpha * grip / (self.spec.intruder_density * self.volume)
    }

    /// What friction can hold, m/s²; a little more than it, so that an intruder
    /// that no force moves through the bed is not thrown about by rounding.
    fn grip(&self, y: &State) -> f64 {
        self.friction(y) + 1e-9 * self.shake.gravity
    }

    fn slope(&self, t: f64, y: &State, ride: Ride) -> State {
        let weight = self.shake.weight(t);
        let bed = self.bed(y[1], weight);
        let (velocity, acceleration) = match ride {
            Ride::Held => (y[1], bed),
            Ride::Sliding(way) => (y[3], self.intruder(y[1], weight) - way * self.friction(y)),
            Ride::Grounded => (0.0, 0.0),
        };
        [y[1], bed, velocity, acceleration]
    }

    /// Landing of the bed; end of the present ride; the intruder's reaching the base.
    fn events(&self, t: f64, y: &State, ride: Ride) -> [f64; 3] {
        let weight = self.shake.weight(t);
        let pull = || self.intruder(y[1], weight);
        let end = match ride {
            Ride::Held => self.grip(y) - (pull() - self.bed(y[1], weight)).abs(),
            Ride::Sliding(way) => way * (y[3] - y[1]),
            // The bed passes it at −u.
            Ride::Grounded => -(pull() + self.friction(y) * y[1].signum()),
        };
        let base = if ride == Ride::Grounded { 1.0 } else { y[2] - self.radius };
        [y[0], end, base]
    }

    /// The ride of an intruder that is at rest relative to the bed.
    fn choose(&self, t: f64, y: &State) -> Ride {
        let weight = self.shake.weight(t);
        let pull = self.intruder(y[1], weight) - self.bed(y[1], weight);
        if pull.abs() <= self.grip(y) { Ride::Held } else { Ride::Sliding(pull.signum()) }
    }

    /// One flight of the bed from `takeoff`, the intruder's centre at `centre`: landing and the
    /// centre then; `None` if the bed does not land within a hundred cycles.
    fn fly(
        &self,
        takeoff: f64,
        centre: f64,
        mut seen: impl FnMut(&Step<4>),
    ) -> Result<Option<(f64, f64)>, Refusals> {
        let speed = self.shake.gravity * self.shake.period / TAU;
        let length = speed * self.shake.period / TAU;
        let accuracy = Accuracy {
            relative: self.spec.tolerance,
            absolute: [length, speed, length, speed].map(|s| self.spec.tolerance * s),
            longest: 0.05 * self.shake.period,
        };
        let (mut t, mut y) = (takeoff, [0.0, 0.0, centre, 0.0]);
        let mut ride = self.choose(t, &y);
        let limit = takeoff + 100.0 * self.shake.period;
        // Each ride lasts until the forces have changed: a handful a flight.
        for _ in 0..1000 {
            let outcome = integrate(
                |t, y| self.slope(t, y, ride),
                |t, y| self.events(t, y, ride),
                t,
                y,
                limit,
                &accuracy,
                &mut seen,
            );
            let which = match outcome {
                Ending::Event { which, time, state } => {
                    (t, y) = (time, state);
                    which
                }
                Ending::Reached(_) => return Ok(None),
                Ending::Stuck(t) => return Err(stalled(t)),
            };
            match (which, ride) {
                (0, _) => return Ok(Some((t, y[2].max(self.radius)))),
                (1, Ride::Held) => {
                    let weight = self.shake.weight(t);
                    ride = Ride::Sliding((self.intruder(y[1], weight) - self.bed(y[1], weight)).signum());
                }
                (1, Ride::Sliding(_)) => {
                    y[3] = y[1];
                    ride = self.choose(t, &y);
                }
                (1, Ride::Grounded) => ride = Ride::Sliding(-y[1].signum()),
                _ => {
                    (y[2], y[3]) = (self.radius, 0.0);
                    ride = Ride::Grounded;
                }
            }
        }
        Err(stalled(t))
    }

    fn rise(&self) -> Result<BrazilNut, Refusals> {
        let period = self.shake.period;
        let surface = self.spec.height - self.radius;
        let end = self.shake.ramp() + f64::from(self.spec.cycles) * period;
        let mut centre = self.spec.start + self.radius;
        let mut history = vec![Rise { time: 0.0, gap: self.spec.start }];
        let mut steps: Vec<Step<4>> = vec![];
        let mut emerged = None;
        let mut next = self.shake.next_throw(0.0);
        while let Some(takeoff) = next.filter(|&t| t < end) {
            let first = steps.is_empty();
            let keep = |s: &Step<4>| {
                if first {
                    steps.push(*s);
                }
            };
            let Some((landing, then)) = self.fly(takeoff, centre, keep)? else { break };
            if landing <= takeoff {
                // Thrown by no more than rounding.
                break;
            }
            // Out of the bed it falls back onto the surface.
            centre = then.min(self.spec.height + self.radius);
            history.push(Rise { time: landing, gap: centre - self.radius });
            if centre >= surface {
                emerged = Some(landing);
                break;
            }
            next = self.shake.next_throw(landing);
        }
        let first_flight = steps
            .iter()
            .flat_map(|s| {
                (0..8)
                    .map(move |k| s.start + (s.end - s.start) * f64::from(k) / 8.0)
                    .map(move |t| (t, s.at(t)))
            })
            .map(|(t, y)| [360.0 * (t / period - (steps[0].start / period).floor()), y[0], y[2]])
            .collect();
        Ok(BrazilNut {
            spec: self.spec.clone(),
            period,
            gamma: self.shake.gamma(),
            history,
            emerged,
            first_flight,
        })
    }
}

impl BrazilNut {
    /// Shake cycles until the intruder's top was level with the surface.
    #[must_use]
    pub fn cycles_to_surface(&self) -> Option<f64> {
        self.emerged.map(|t| (t / self.period).ceil())
    }

    /// When the gap under the intruder first reached `gap` (m), s; between flights by a straight line.
    #[must_use]
    pub fn time_to(&self, gap: f64) -> Option<f64> {
        let k = self.history.iter().position(|r| r.gap >= gap)?;
        let b = self.history[k];
        let Some(a) = k.checked_sub(1).map(|k| self.history[k]) else { return Some(b.time) };
        Some(a.time + (b.time - a.time) * (gap - a.gap) / (b.gap - a.gap))
    }
}

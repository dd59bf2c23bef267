//! Prescribed motion of the cell or of a wall.

use crate::Vec3;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// One harmonic: displacement `amplitude * sin(2 pi frequency t + phase)`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Harmonic {
    /// Displacement amplitude per axis, m.
    pub amplitude: Vec3,
    /// Frequency, Hz.
    pub frequency: f64,
    /// Phase per axis, rad.
    pub phase: Vec3,
}

/// A sum of harmonics that grows from rest over `ramp` seconds.
///
/// Phase 0 is the fastest upward motion: z = A sin(2 pi f t).
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Motion {
    /// The harmonics; empty means at rest.
    pub harmonics: Vec<Harmonic>,
    /// Duration of the ramp, s; zero starts at once.
    pub ramp: f64,
}

/// Displacement, velocity and acceleration at one instant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Moved {
    /// m
    pub displacement: Vec3,
    /// m/s
    pub velocity: Vec3,
    /// m/s²
    pub acceleration: Vec3,
}

impl Motion {
    /// A vertical sinusoid of displacement amplitude `a` (m) and frequency `f` (Hz).
    #[must_use]
    pub fn vertical(a: f64, f: f64) -> Self {
        let h = Harmonic { amplitude: Vec3::Z * a, frequency: f, phase: Vec3::ZERO };
        Self { harmonics: vec![h], ramp: 0.0 }
    }

    /// The motion at time `t` (s); at rest before 0.
    #[must_use]
    pub fn at(&self, t: f64) -> Moved {
        let mut m = Moved::default();
        if t < 0.0 {
            return m;
        }
        let (r, dr, ddr) = smooth_step(t, self.ramp);
        for h in &self.harmonics {
            let w = TAU * h.frequency;
            for axis in (0..3).filter(|&axis| h.amplitude[axis] != 0.0) {
                let (s, c) = (w * t + h.phase[axis]).sin_cos();
                let a = h.amplitude[axis];
                m.displacement[axis] += r * a * s;
                m.velocity[axis] += dr * a * s + r * a * w * c;
                m.acceleration[axis] += ddr * a * s + 2.0 * dr * a * w * c - r * a * w * w * s;
            }
        }
        m
    }

    /// The lowest frequency, Hz, if anything moves.
    #[must_use]
    pub fn frequency(&self) -> Option<f64> {
        self.harmonics.iter().map(|h| h.frequency).min_by(f64::total_cmp)
    }

    /// Largest speed that the motion can reach (sum of the harmonics' peaks), m/s.
    #[must_use]
    pub fn peak_speed(&self) -> f64 {
        self.harmonics.iter().map(|h| TAU * h.frequency * h.amplitude.length()).sum()
    }
}

/// 6 s^5 - 15 s^4 + 10 s^3 with s = t/ramp, and its first two time
/// derivatives: velocity and acceleration stay continuous, which a linear
/// ramp of the amplitude would not give.
fn smooth_step(t: f64, ramp: f64) -> (f64, f64, f64) {
    if ramp <= 0.0 || t >= ramp {
        return (1.0, 0.0, 0.0);
    }
    let s = t / ramp;
    (
        s * s * s * (10.0 + s * (6.0 * s - 15.0)),
        30.0 * s * s * (1.0 - s) * (1.0 - s) / ramp,
        60.0 * s * (1.0 - s) * (1.0 - 2.0 * s) / (ramp * ramp),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn velocity_and_acceleration_are_the_derivatives() {
        let mut m = Motion::vertical(1.3e-3, 10.0);
        m.ramp = 0.3;
        let h = 1e-6;
        for k in 1..40 {
            let t = 0.01 * f64::from(k) + 0.001;
            let (a, b, c) = (m.at(t - h), m.at(t), m.at(t + h));
            let v = (c.displacement - a.displacement) / (2.0 * h);
            let acc = (c.velocity - a.velocity) / (2.0 * h);
            // Central differences: truncation h² times a third derivative of order A w³.
            assert!((v - b.velocity).length() < 1e-6, "t = {t}");
            assert!((acc - b.acceleration).length() < 1e-4, "t = {t}");
        }
    }
}

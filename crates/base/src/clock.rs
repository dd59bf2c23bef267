//! The context that every advancing call receives.

use serde::{Deserialize, Serialize};

/// Where a step stands in time.
///
/// Time is `index * dt` and never a running sum, so that a resumed run sees
/// the same bits as an unbroken one. Time 0 is the start of the shaking;
/// settling happens before it and has a clock of its own.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tick {
    /// Time at the start of the step, s.
    pub time: f64,
    /// Length of the step, s.
    pub dt: f64,
    /// Number of steps taken before this one.
    pub index: u64,
}

impl Tick {
    /// The step number `index` of length `dt` (s).
    #[must_use]
    pub fn at(index: u64, dt: f64) -> Self {
        Self { time: index as f64 * dt, dt, index }
    }

    /// Time at the end of the step, s. A step before time 0 ends before it, whatever its number: what the
    /// shaking moves is at rest there.
    #[must_use]
    pub fn end(&self) -> f64 {
        if self.time < 0.0 { self.time + self.dt } else { (self.index + 1) as f64 * self.dt }
    }

    /// Part `k` of this step cut into `n` equal parts.
    #[must_use]
    pub fn substep(&self, k: u64, n: u64) -> Self {
        let dt = self.dt / n as f64;
        Self { time: self.time + k as f64 * dt, dt, index: self.index * n + k }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_meet_and_those_of_settling_stay_before_zero() {
        for k in 0..1000 {
            assert_eq!(Tick::at(k, 1e-3).end(), Tick::at(k + 1, 1e-3).time);
        }
        let settling = Tick { time: -1.0, ..Tick::at(123_456_789, 1e-3) };
        assert!(settling.end() < 0.0 && settling.substep(3, 4).end() < 0.0);
    }
}

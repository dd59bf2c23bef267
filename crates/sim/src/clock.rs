//! How time is cut: a whole number of steps per shake cycle.

use brazilnut_base::Tick;
use serde::{Deserialize, Serialize};

/// Lengths and counts of the steps of a run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Clock {
    /// Length of a step, s: a fluid step where there is a flow, a grain step elsewhere.
    pub dt: f64,
    /// Grain steps in a step.
    pub substeps: u64,
    /// Steps in a shake cycle, if anything shakes.
    pub steps_per_cycle: Option<u64>,
    /// Steps from time 0 to the end.
    pub end: u64,
}

/// Cycles are cut into a multiple of this many steps, so that common numbers
/// of phases per cycle fall on steps.
pub const PHASES: u64 = 120;

impl Clock {
    /// Cuts time into steps no longer than `largest` (s), in `substeps` parts
    /// no longer than `largest_grain` (s). With a shake of `frequency` (Hz) a
    /// cycle holds a whole number of steps, a multiple of [`PHASES`] unless
    /// the steps were given by hand (`exact`).
    #[must_use]
    pub fn new(largest: f64, largest_grain: f64, frequency: Option<f64>, exact: bool) -> Self {
        // A step that divides the cycle but for rounding must not be cut once more.
        let whole = |x: f64| if (x - x.round()).abs() < 1e-9 * x { x.round() } else { x.ceil() };
        let (dt, steps_per_cycle) = match frequency {
            Some(f) => {
                let n = whole(1.0 / (f * largest)).max(1.0) as u64;
                let n = if exact { n } else { n.div_ceil(PHASES) * PHASES };
                (1.0 / (f * n as f64), Some(n))
            }
            None => (largest, None),
        };
        let substeps = whole(dt / largest_grain).max(1.0) as u64;
        Self { dt, substeps, steps_per_cycle, end: 0 }
    }

    /// Length of a grain step, s.
    #[must_use]
    pub fn grain_dt(&self) -> f64 {
        self.dt / self.substeps as f64
    }

    /// Step number `index` of the run.
    #[must_use]
    pub fn tick(&self, index: u64) -> Tick {
        Tick::at(index, self.dt)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cycle_is_a_whole_number_of_steps_no_longer_than_asked() {
        let c = Clock::new(7.3e-6, 7.3e-6, Some(10.0), false);
        assert_eq!(c.steps_per_cycle.unwrap() % PHASES, 0);
        assert!(c.dt <= 7.3e-6 && (c.dt * c.steps_per_cycle.unwrap() as f64 - 0.1).abs() < 1e-15);
        let c = Clock::new(1e-5, 1e-5, Some(30.0), true);
        assert_eq!(c.steps_per_cycle, Some(3334));
        let c = Clock::new(1e-5, 1e-5, Some(10.0), true);
        assert_eq!(c.steps_per_cycle, Some(10_000));
    }

    #[test]
    fn grain_steps_divide_the_step() {
        let c = Clock::new(1e-4, 7e-6, None, true);
        assert_eq!(c.substeps, 15);
        assert!(c.grain_dt() <= 7e-6);
    }
}

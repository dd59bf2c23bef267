//! When something happens, apart from what happens.

use serde::{Deserialize, Serialize};

/// What a case says about when.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Every {
    /// Every `n` steps.
    Steps(u64),
    /// Every so many seconds, rounded to whole steps (at least one).
    Time(f64),
    /// `n` times a shake cycle, at equal phases counted from `phase`.
    PerCycle(u64),
    /// Every `n` shake cycles.
    Cycles(u64),
    /// Once, at the end of the run.
    End,
}

/// Whole-step schedule: due at `offset`, `offset + period`, …
///
/// Observers sample on step boundaries and never alter a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Schedule {
    /// Steps between two events.
    pub period: u64,
    /// The first event, in steps from time 0.
    pub offset: u64,
}

impl Schedule {
    /// Turns what the case says into steps. `phase` (0 to 1, a fraction of the
    /// cycle) shifts cycle schedules. `None` if the case names cycles and
    /// nothing shakes, or if phases per cycle do not divide the steps per cycle.
    #[must_use]
    pub fn new(every: Every, phase: f64, dt: f64, steps_per_cycle: Option<u64>, end: u64) -> Option<Self> {
        let shift = |spc: u64| ((phase * spc as f64).round() as u64) % spc.max(1);
        Some(match every {
            Every::Steps(n) => Self { period: n.max(1), offset: 0 },
            Every::Time(t) => Self { period: ((t / dt).round() as u64).max(1), offset: 0 },
            Every::PerCycle(n) => {
                let spc = steps_per_cycle?;
                if n == 0 || !spc.is_multiple_of(n) {
                    return None;
                }
                Self { period: spc / n, offset: shift(spc) % (spc / n) }
            }
            Every::Cycles(n) => {
                let spc = steps_per_cycle?;
                Self { period: spc * n.max(1), offset: shift(spc) }
            }
            Every::End => Self { period: u64::MAX, offset: end },
        })
    }

    /// True if an event falls on the boundary before step `index`.
    #[must_use]
    pub fn is_due(&self, index: u64) -> bool {
        index >= self.offset && (index - self.offset).is_multiple_of(self.period)
    }

    /// Number of events in `0..=last`.
    #[must_use]
    pub fn count(&self, last: u64) -> u64 {
        if last < self.offset { 0 } else { (last - self.offset) / self.period + 1 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn phases_fall_on_equal_fractions_of_the_cycle() {
        let s = Schedule::new(Every::PerCycle(4), 0.0, 1e-3, Some(100), 1000).unwrap();
        let due: Vec<u64> = (0..=100).filter(|&i| s.is_due(i)).collect();
        assert_eq!(due, [0, 25, 50, 75, 100]);
        assert_eq!(s.count(100), 5);
        assert!(Schedule::new(Every::PerCycle(3), 0.0, 1e-3, Some(100), 1000).is_none());
    }

    #[test]
    fn once_a_cycle_at_a_phase() {
        let s = Schedule::new(Every::Cycles(1), 0.25, 1e-3, Some(100), 1000).unwrap();
        assert!(s.is_due(25) && s.is_due(125) && !s.is_due(100));
    }
}

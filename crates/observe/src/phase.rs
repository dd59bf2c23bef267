//! Averages over cycles at equal phase.

use crate::accumulate::Batched;
use serde::{Deserialize, Serialize};

/// Means of rows in bins of the phase, with standard errors from batches of cycles.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PhaseAverage {
    bins: Vec<Batched>,
    first: f64,
}

impl PhaseAverage {
    /// `bins` phases from `first` (in cycles) on, of rows of `width` numbers, `kept` batches each.
    #[must_use]
    pub fn new(bins: usize, first: f64, width: usize, kept: usize) -> Self {
        Self { bins: vec![Batched::new(width, kept, 1); bins.max(1)], first }
    }

    /// The bin of a time in cycles: the nearest of `first + k/bins`.
    #[must_use]
    pub fn bin(&self, cycle: f64) -> usize {
        let n = self.bins.len() as f64;
        ((cycle - self.first).rem_euclid(1.0) * n).round() as usize % self.bins.len()
    }

    /// Takes a row at the time `cycle` (in cycles).
    pub fn add(&mut self, cycle: f64, row: &[f64]) {
        self.open(cycle).iter_mut().zip(row).for_each(|(s, x)| *s += x);
    }

    /// The sums that take the row at the time `cycle`, which counts as added.
    pub fn open(&mut self, cycle: f64) -> &mut [f64] {
        let k = self.bin(cycle);
        self.bins[k].open()
    }

    /// The sums of each bin.
    #[must_use]
    pub fn bins(&self) -> &[Batched] {
        &self.bins
    }

    /// Phase of bin `k` in degrees; 0 is the floor moving up at its fastest.
    #[must_use]
    pub fn degrees(&self, k: usize) -> f64 {
        360.0 * (self.first + k as f64 / self.bins.len() as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::known::white;

    #[test]
    fn a_periodic_signal_in_noise() {
        let mut p = PhaseAverage::new(12, 0.0, 1, 16);
        let noise = white(12 * 400, 0.25, 2);
        for (k, e) in noise.iter().enumerate() {
            let cycle = k as f64 / 12.0;
            p.add(cycle, &[(std::f64::consts::TAU * cycle).cos() + e]);
        }
        for (k, bin) in p.bins().iter().enumerate() {
            let (degrees, m) = (p.degrees(k), bin.means());
            // Standard error 0.5/sqrt(400) = 0.025, itself known from 12 to 16 batches to 20 %.
            assert!((m[0].error / 0.025 - 1.0).abs() < 0.6, "{:?}", m[0]);
            assert!((m[0].value - degrees.to_radians().cos()).abs() < 4.0 * 0.025);
        }
    }

    #[test]
    fn rounding_of_the_time_does_not_shift_the_bin() {
        let p = PhaseAverage::new(8, 0.0, 1, 4);
        assert_eq!(p.bin(2.999_999_999), 0);
        assert_eq!(p.bin(3.124_999_999), 1);
        // Samples half way between the eighths of a cycle.
        let p = PhaseAverage::new(8, 0.0625, 1, 4);
        assert_eq!((p.bin(3.062_499_9), p.bin(3.062_500_1), p.degrees(1)), (0, 0, 67.5));
    }
}

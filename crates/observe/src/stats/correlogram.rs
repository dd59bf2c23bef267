//! Autocorrelation of a series while it grows.

use super::correlation::auto;
use serde::{Deserialize, Serialize};

/// Autocorrelation functions of several series, averaged over segments of
/// `length` samples one after the other, the mean of each segment taken off,
/// lags up to half a segment.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Correlogram {
    length: usize,
    held: Vec<Vec<f64>>,
    sums: Vec<Vec<f64>>,
    segments: u64,
}

impl Correlogram {
    /// For `series` series.
    #[must_use]
    pub fn new(series: usize, length: usize) -> Self {
        let length = length.max(8);
        let sums = vec![vec![0.0; length / 2 + 1]; series];
        Self { length, held: vec![Vec::with_capacity(length); series], sums, segments: 0 }
    }

    /// Takes the next sample of every series. Not-a-number counts as zero.
    pub fn add(&mut self, row: &[f64]) {
        for (h, &x) in self.held.iter_mut().zip(row) {
            h.push(if x.is_finite() { x } else { 0.0 });
        }
        if self.held.first().is_some_and(|h| h.len() == self.length) {
            for (held, sums) in self.held.iter_mut().zip(&mut self.sums) {
                let mean = held.iter().sum::<f64>() / held.len() as f64;
                held.iter_mut().for_each(|x| *x -= mean);
                sums.iter_mut().zip(auto(held, self.length / 2)).for_each(|(s, c)| *s += c);
                held.clear();
            }
            self.segments += 1;
        }
    }

    /// Number of segments behind the averages.
    #[must_use]
    pub fn segments(&self) -> u64 {
        self.segments
    }

    /// Autocovariance of series `s` over that at lag 0, lag by lag.
    #[must_use]
    pub fn normalised(&self, s: usize) -> Vec<f64> {
        self.sums[s].iter().map(|c| c / self.sums[s][0]).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::known::ornstein_uhlenbeck;

    #[test]
    fn decays_as_the_process_does() {
        let mut c = Correlogram::new(1, 2000);
        ornstein_uhlenbeck(200_000, 1.0, 3.0, 10.0, 9).into_iter().for_each(|x| c.add(&[x]));
        assert_eq!(c.segments(), 100);
        let rho = c.normalised(0);
        for lag in [0, 5, 10, 20, 40] {
            // 1e4 correlation times: scatter of 1 %; taking off the mean of 2000 samples lowers all by 1 %.
            assert!((rho[lag] - (-(lag as f64) / 10.0).exp()).abs() < 0.035, "{lag}: {}", rho[lag]);
        }
    }
}

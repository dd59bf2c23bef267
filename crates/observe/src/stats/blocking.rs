//! Mean, standard error and correlation time of a series while it grows.

use crate::accumulate::Estimate;
use serde::{Deserialize, Serialize};

/// Averages over blocks of 1, 2, 4, … samples (Flyvbjerg & Petersen 1989), in
/// memory that grows with the logarithm of the series.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Blocking {
    levels: Vec<Level>,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Level {
    blocks: u64,
    mean: f64,
    /// Sum of squared deviations from the mean.
    spread: f64,
    /// First half of a pair that waits for its second.
    waiting: Option<f64>,
}

impl Level {
    /// Welford's update.
    fn add(&mut self, x: f64) {
        self.blocks += 1;
        let d = x - self.mean;
        self.mean += d / self.blocks as f64;
        self.spread += d * (x - self.mean);
    }

    /// Squared standard error of the mean if the blocks were independent.
    fn error2(&self) -> f64 {
        let n = self.blocks as f64;
        self.spread / (n * (n - 1.0))
    }
}

impl Blocking {
    /// Takes the next sample; what is not a number is left out.
    pub fn add(&mut self, x: f64) {
        if !x.is_finite() {
            return;
        }
        let mut x = x;
        for k in 0.. {
            if k == self.levels.len() {
                self.levels.push(Level::default());
            }
            let level = &mut self.levels[k];
            level.add(x);
            match level.waiting.take() {
                None => {
                    level.waiting = Some(x);
                    return;
                }
                Some(first) => x = 0.5 * (first + x),
            }
        }
    }

    /// Number of samples.
    #[must_use]
    pub fn samples(&self) -> u64 {
        self.levels.first().map_or(0, |l| l.blocks)
    }

    /// The mean with its standard error, correlations allowed for.
    ///
    /// The block length is the smallest B with B³ > 2 n (error_B/error_1)^4
    /// (Lee et al. 2011, Phys. Rev. E 83, 066706). NaN if the series is too
    /// short for that: fewer than some fifty correlation times.
    #[must_use]
    pub fn mean(&self) -> Estimate {
        let value = self.levels.first().map_or(f64::NAN, |l| l.mean);
        Estimate { value, error: self.chosen().map_or(f64::NAN, |l| l.error2().sqrt()) }
    }

    /// Integrated correlation time in samples, 1/2 + sum of the normalised
    /// autocorrelation over positive lags: half the factor by which
    /// correlations raise the squared error of the mean.
    #[must_use]
    pub fn correlation_time(&self) -> f64 {
        match (self.chosen(), self.levels.first()) {
            (Some(l), Some(first)) if first.spread > 0.0 => 0.5 * l.error2() / first.error2(),
            _ => f64::NAN,
        }
    }

    fn chosen(&self) -> Option<&Level> {
        let first = self.levels.first().filter(|l| l.blocks >= 2)?;
        let n = first.blocks as f64;
        let growth2 = |l: &Level| if first.spread > 0.0 { l.error2() / first.error2() } else { 1.0 };
        self.levels
            .iter()
            .enumerate()
            .take_while(|(_, l)| l.blocks >= 2)
            .find(|(k, l)| 8_f64.powi(*k as i32) > 2.0 * n * growth2(l) * growth2(l))
            .map(|(_, l)| l)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::known::{ornstein_uhlenbeck, white};

    #[test]
    fn error_and_correlation_time_of_a_correlated_series() {
        // AR(1) with a = exp(-1/10): tau_int = (1 + a)/(2 (1 - a)) = 10.008.
        let exact = 0.5 * (1.0 + (-0.1_f64).exp()) / (1.0 - (-0.1_f64).exp());
        let n = 1 << 18;
        let mut b = Blocking::default();
        for x in ornstein_uhlenbeck(n, 1.0, 4.0, 10.0, 3) {
            b.add(x + 7.0);
        }
        // The chosen level leaves some 1e3 blocks: its squared error is known to sqrt(2/1e3) = 4 %, and
        // blocks of finite length miss tau/B, about as much: three of both.
        assert!((b.correlation_time() / exact - 1.0).abs() < 0.2, "{}", b.correlation_time());
        let m = b.mean();
        let expected = (4.0 * 2.0 * exact / n as f64).sqrt();
        assert!((m.error / expected - 1.0).abs() < 0.1, "{} {expected}", m.error);
        assert!((m.value - 7.0).abs() < 4.0 * m.error);
    }

    #[test]
    fn white_noise_has_half_a_sample() {
        let mut b = Blocking::default();
        white(1 << 16, 1.0, 4).into_iter().for_each(|x| b.add(x));
        // Squared error at the chosen level of some thousand blocks: 5 % each; four of those.
        assert!((b.correlation_time() - 0.5).abs() < 0.1, "{}", b.correlation_time());
    }

    #[test]
    fn says_nothing_when_it_cannot() {
        let mut b = Blocking::default();
        assert!(b.mean().value.is_nan());
        (0..20).for_each(|k| b.add(f64::from(k)));
        assert!(b.mean().error.is_nan() && b.mean().value == 9.5);
    }

    #[test]
    fn a_constant_has_no_error() {
        let mut b = Blocking::default();
        (0..64).for_each(|_| b.add(2.5));
        assert_eq!((b.mean().value, b.mean().error), (2.5, 0.0));
    }
}

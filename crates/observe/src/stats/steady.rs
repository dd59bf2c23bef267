//! When averaging may begin.

use serde::{Deserialize, Serialize};

/// Number of leading values to leave out: the d that minimises the squared
/// standard error of the mean of the rest (MSER, White 1997),
/// sum_{i >= d} (x_i - mean_d)²/(n - d)².
///
/// `None` if the best d lies in the second half: the series is too short to tell.
#[must_use]
pub fn mser(x: &[f64]) -> Option<usize> {
    let n = x.len();
    if n < 10 {
        return None;
    }
    // Mean and spread of the tail, grown from its end; short tails look quiet by chance, so the last five are not tried.
    let (mut count, mut mean, mut spread) = (0.0, 0.0, 0.0);
    let mut best = (f64::INFINITY, 0);
    for d in (0..n).rev() {
        count += 1.0;
        let e = x[d] - mean;
        mean += e / count;
        spread += e * (x[d] - mean);
        if n - d > 5 && spread / (count * count) <= best.0 {
            best = (spread / (count * count), d);
        }
    }
    (best.1 <= n / 2).then_some(best.1)
}

/// Watches a quantity and says when it has become steady: batch means are
/// kept in a fixed number, merged in pairs when full, and [`mser`] asked each
/// time a batch closes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Steady {
    batches: Vec<f64>,
    length: u64,
    open: f64,
    held: u64,
    steady: bool,
}

/// At least this many batches before a verdict, twice as many at most.
const ENOUGH: usize = 32;

impl Steady {
    /// `length` samples make a batch at first: a whole shake cycle where there is one.
    #[must_use]
    pub fn new(length: u64) -> Self {
        Self { batches: vec![], length: length.max(1), open: 0.0, held: 0, steady: false }
    }

    /// Takes a sample and returns whether the quantity has been found steady.
    pub fn add(&mut self, x: f64) -> bool {
        if self.steady {
            return true;
        }
        self.open += x;
        self.held += 1;
        if self.held == self.length {
            self.batches.push(self.open / self.length as f64);
            self.open = 0.0;
            self.held = 0;
            self.steady = self.batches.len() >= ENOUGH && mser(&self.batches).is_some();
            if self.batches.len() == 2 * ENOUGH {
                self.batches = self.batches.chunks(2).map(|p| 0.5 * (p[0] + p[1])).collect();
                self.length *= 2;
            }
        }
        self.steady
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::known::ornstein_uhlenbeck;

    #[test]
    fn a_decaying_start_is_cut_off_and_a_steady_series_is_not() {
        let noise = ornstein_uhlenbeck(2000, 1.0, 1.0, 3.0, 7);
        let start: Vec<f64> =
            noise.iter().enumerate().map(|(k, e)| e + 20.0 * (-(k as f64) / 80.0).exp()).collect();
        let d = mser(&start).unwrap();
        // The transient falls below the noise of the mean (about 0.08) after 80 ln(20/0.08) = 440 samples
        // and below the noise itself after 240.
        assert!((200..600).contains(&d), "{d}");
        let d = mser(&noise).unwrap();
        assert!(d < 600, "{d}");
        let ramp: Vec<f64> = noise.iter().enumerate().map(|(k, e)| e + 0.1 * k as f64).collect();
        assert_eq!(mser(&ramp), None);
    }

    #[test]
    fn steadiness_is_declared_after_the_transient() {
        let mut s = Steady::new(10);
        let noise = ornstein_uhlenbeck(40_000, 1.0, 0.01, 3.0, 8);
        let at = (0..40_000).position(|k| s.add(noise[k] + 5.0 * (-(k as f64) / 1000.0).exp())).unwrap();
        // After 4000 samples the transient is 0.09, as large as the noise; the test asks for as much again after it.
        assert!((3000..20_000).contains(&at), "{at}");
        let mut drift = Steady::new(10);
        assert!((0..40_000).all(|k| !drift.add(1e-3 * f64::from(k))));
    }
}

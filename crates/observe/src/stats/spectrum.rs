//! Power spectral density by Welch's method, while the series grows.

use rustfft::FftPlanner;
use rustfft::num_complex::Complex;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Averaged spectra of several series sampled together: segments of `length`
/// samples, half overlapping, mean removed, Hann window (Welch 1967).
///
/// One-sided density: its integral over frequency is the variance.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Welch {
    length: usize,
    /// The latest samples, series by series, up to a full segment.
    held: Vec<Vec<f64>>,
    segments: u64,
    /// Sum of |X|², series by series.
    power: Vec<Vec<f64>>,
    /// Sum of conj(X_0) X_k, real and imaginary in turn, series by series.
    cross: Vec<Vec<f64>>,
}

impl Welch {
    /// For `series` series; `length` is made even, at least 8.
    #[must_use]
    pub fn new(series: usize, length: usize) -> Self {
        let length = length.max(8).next_multiple_of(2);
        let bins = length / 2 + 1;
        Self {
            length,
            held: vec![Vec::with_capacity(length); series],
            segments: 0,
            power: vec![vec![0.0; bins]; series],
            cross: vec![vec![0.0; 2 * bins]; series],
        }
    }

    /// Takes the next sample of every series. Not-a-number counts as zero.
    pub fn add(&mut self, row: &[f64]) {
        for (h, &x) in self.held.iter_mut().zip(row) {
            h.push(if x.is_finite() { x } else { 0.0 });
        }
        if self.held.first().is_some_and(|h| h.len() == self.length) {
            self.transform();
            let half = self.length / 2;
            self.held.iter_mut().for_each(|h| {
                h.drain(..half);
            });
        }
    }

    fn transform(&mut self) {
        let n = self.length;
        let plan = FftPlanner::new().plan_fft_forward(n);
        let hann = |k: usize| 0.5 - 0.5 * (TAU * k as f64 / n as f64).cos();
        let mut first = vec![];
        let mut x = vec![Complex::default(); n];
        for (s, held) in self.held.iter().enumerate() {
            let mean = held.iter().sum::<f64>() / n as f64;
            for k in 0..n {
                x[k] = Complex::new((held[k] - mean) * hann(k), 0.0);
            }
            plan.process(&mut x);
            if s == 0 {
                first = x[..=n / 2].to_vec();
            }
            for k in 0..=n / 2 {
                self.power[s][k] += x[k].norm_sqr();
                let c = first[k].conj() * x[k];
                self.cross[s][2 * k] += c.re;
                self.cross[s][2 * k + 1] += c.im;
            }
        }
        self.segments += 1;
    }

    /// Number of segments behind the averages.
    #[must_use]
    pub fn segments(&self) -> u64 {
        self.segments
    }

    /// Frequencies of the bins, Hz, for samples `interval` (s) apart.
    #[must_use]
    pub fn frequencies(&self, interval: f64) -> Vec<f64> {
        (0..=self.length / 2).map(|k| k as f64 / (self.length as f64 * interval)).collect()
    }

    /// Density of series `s` in its unit squared per Hz.
    #[must_use]
    pub fn density(&self, s: usize, interval: f64) -> Vec<f64> {
        // sum of hann² over a segment is 3 n/8.
        let scale = 2.0 * interval / (0.375 * self.length as f64 * self.segments as f64);
        let last = self.length / 2;
        self.power[s]
            .iter()
            .enumerate()
            .map(|(k, p)| p * scale * if k == 0 || k == last { 0.5 } else { 1.0 })
            .collect()
    }

    /// Phase (rad) by which series `s` lags behind series 0, and coherence, at each frequency.
    #[must_use]
    pub fn lag(&self, s: usize) -> Vec<(f64, f64)> {
        (0..=self.length / 2)
            .map(|k| {
                let (re, im) = (self.cross[s][2 * k], self.cross[s][2 * k + 1]);
                let coherence = (re * re + im * im) / (self.power[0][k] * self.power[s][k]);
                (-im.atan2(re), coherence)
            })
            .collect()
    }

    /// Bin nearest to `frequency` (Hz).
    #[must_use]
    pub fn bin(&self, frequency: f64, interval: f64) -> usize {
        ((frequency * self.length as f64 * interval).round().max(0.0) as usize).min(self.length / 2)
    }
}

/// Spectrum of a whole series: frequencies (Hz) and one-sided density, segments of `length` samples.
#[must_use]
pub fn welch(series: &[f64], interval: f64, length: usize) -> (Vec<f64>, Vec<f64>) {
    let mut w = Welch::new(1, length);
    series.iter().for_each(|&x| w.add(&[x]));
    (w.frequencies(interval), w.density(0, interval))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::known::{ornstein_uhlenbeck, white};

    #[test]
    fn a_sine_in_noise() {
        // Variance of the sine 2, density of white noise 2 s² dt = 2 * 0.25 * 0.01.
        let (dt, f) = (0.01, 7.03125);
        let noise = white(1 << 15, 0.25, 1);
        let x: Vec<f64> =
            noise.iter().enumerate().map(|(k, e)| e + 2.0 * (TAU * f * dt * k as f64).sin()).collect();
        let (freq, s) = welch(&x, dt, 1024);
        let peak = (0..s.len()).max_by(|&a, &b| s[a].total_cmp(&s[b])).unwrap();
        assert_eq!(freq[peak], f);
        let df = freq[1];
        let power: f64 = (peak - 3..=peak + 3).map(|k| s[k] * df).sum();
        // Hann spreads a sine over three bins; the noise under seven adds 7 df 2 s² dt = 0.0034.
        assert!((power - 2.0034).abs() < 0.02, "{power}");
        let floor: f64 = s[200..500].iter().sum::<f64>() / 300.0;
        // 300 bins times 63 half-overlapping segments: 1 %; four of those.
        assert!((floor / 0.005 - 1.0).abs() < 0.04, "{floor}");
    }

    #[test]
    fn density_integrates_to_the_variance_and_has_the_known_shape() {
        let (dt, tau, s2) = (0.01, 0.05, 3.0);
        let x = ornstein_uhlenbeck(1 << 17, dt, s2, tau, 2);
        let (f, s) = welch(&x, dt, 4096);
        let total: f64 = s.iter().sum::<f64>() * f[1];
        // The variance of a series of 1311 s = 26214 tau is known to sqrt(2 tau/T) = 0.9 %; four of those.
        assert!((total / s2 - 1.0).abs() < 0.036, "{total}");
        let a = (-dt / tau).exp();
        for k in [20, 100, 400, 1500] {
            // Density of AR(1): 2 dt s2 (1 - a²)/(1 - 2 a cos w + a²).
            let w = TAU * f[k] * dt;
            let exact = 2.0 * dt * s2 * (1.0 - a * a) / (1.0 - 2.0 * a * w.cos() + a * a);
            let near: f64 = s[k - 8..=k + 8].iter().sum::<f64>() / 17.0;
            // 17 bins times 63 segments with half overlap: 4 %; three and a half of those.
            assert!((near / exact - 1.0).abs() < 0.14, "{k}: {near} {exact}");
        }
    }

    #[test]
    fn phase_lag_of_a_delayed_series() {
        let mut w = Welch::new(2, 256);
        let (dt, f) = (0.01, 6.25);
        for k in 0..4096 {
            let t = dt * f64::from(k);
            w.add(&[(TAU * f * t).sin(), 0.1 * (TAU * f * t - 0.9).sin()]);
        }
        let (phase, coherence) = w.lag(1)[w.bin(f, dt)];
        assert!((phase - 0.9).abs() < 1e-9 && coherence > 0.999_999);
    }
}

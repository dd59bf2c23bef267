//! Correlation functions by fast Fourier transform.

use rustfft::num_complex::Complex;
use rustfft::{Fft, FftPlanner};
use std::sync::Arc;

/// Mean products <x(t) y(t + tau)> for lags `-max..=max` (samples), `2 max + 1` values.
///
/// Each lag is averaged over the products there are, N - |tau| of them
/// (unbiased); the mean is not taken off (Lan eq. 3-2-2b, 3-2-3).
#[must_use]
pub fn cross(x: &[f64], y: &[f64], max: usize) -> Vec<f64> {
    let n = x.len().min(y.len());
    if n == 0 {
        return vec![];
    }
    let max = max.min(n - 1);
    let size = (n + max).next_power_of_two();
    let mut planner = FftPlanner::new();
    let forward = planner.plan_fft_forward(size);
    // Both real series in one transform: z = x + i y.
    let mut z = vec![Complex::default(); size];
    for k in 0..n {
        z[k] = Complex::new(x[k], y[k]);
    }
    forward.process(&mut z);
    let mut product = vec![Complex::default(); size];
    for k in 0..size {
        let (a, b) = (z[k], z[(size - k) % size].conj());
        let (fx, fy) = ((a + b) * 0.5, (a - b) * Complex::new(0.0, -0.5));
        product[k] = fx.conj() * fy;
    }
    planner.plan_fft_inverse(size).process(&mut product);
    (0..=2 * max)
        .map(|k| {
            let lag = k as i64 - max as i64;
            let at = lag.rem_euclid(size as i64) as usize;
            product[at].re / (size as f64 * (n as f64 - lag.abs() as f64))
        })
        .collect()
}

/// Mean products <x(t) x(t + tau)> for lags `0..=max` (samples) (Lan eq. 3-2-2b).
#[must_use]
pub fn auto(x: &[f64], max: usize) -> Vec<f64> {
    let mut c = Correlator::new(x.len(), max);
    let mut out = vec![0.0; c.lags()];
    c.auto_pair(x, &[], &mut out, &mut []);
    out
}

/// Mean square displacement <[r(t + tau) - r(t)]²> for lags `0..=max` of a path (Lan eq. 3-3-7),
/// from squares and an autocorrelation: N log N operations.
#[must_use]
pub fn mean_square_displacement(path: &[f64], max: usize) -> Vec<f64> {
    // About the middle, so that the difference of large squares loses least.
    let middle = path.iter().sum::<f64>() / path.len() as f64;
    let r: Vec<f64> = path.iter().map(|x| x - middle).collect();
    let mut product = auto(&r, max);
    displacement(&r, &mut product);
    product
}

/// Turns mean products of a path into mean square displacements:
/// <[r(t + tau) - r(t)]²> = <r²(t) + r²(t + tau)> - 2 <r(t) r(t + tau)>.
pub fn displacement(path: &[f64], product: &mut [f64]) {
    let n = path.len();
    let mut ends: f64 = 2.0 * path.iter().map(|x| x * x).sum::<f64>();
    for (lag, p) in product.iter_mut().enumerate() {
        if lag > 0 {
            ends -= path[lag - 1] * path[lag - 1] + path[n - lag] * path[n - lag];
        }
        *p = if lag == 0 { 0.0 } else { ends / (n - lag) as f64 - 2.0 * *p };
    }
}

/// Autocorrelations of many series of one length, two at a time, with one plan.
pub struct Correlator {
    samples: usize,
    lags: usize,
    forward: Arc<dyn Fft<f64>>,
    inverse: Arc<dyn Fft<f64>>,
    z: Vec<Complex<f64>>,
    product: Vec<Complex<f64>>,
    scratch: Vec<Complex<f64>>,
}

impl Correlator {
    /// For series of `samples` samples and lags `0..=max`.
    #[must_use]
    pub fn new(samples: usize, max: usize) -> Self {
        let lags = max.min(samples.saturating_sub(1)) + 1;
        let size = smooth(samples + lags);
        let mut planner = FftPlanner::new();
        let (forward, inverse) = (planner.plan_fft_forward(size), planner.plan_fft_inverse(size));
        let need = forward.get_inplace_scratch_len().max(inverse.get_inplace_scratch_len());
        let zero = Complex::default();
        Self {
            samples,
            lags,
            forward,
            inverse,
            z: vec![zero; size],
            product: vec![zero; size],
            scratch: vec![zero; need],
        }
    }

    /// Number of lags, 0 included.
    #[must_use]
    pub fn lags(&self) -> usize {
        self.lags
    }

    /// Autocorrelations of `x` and `y` (either may be empty), unbiased, the mean not taken off.
    pub fn auto_pair(&mut self, x: &[f64], y: &[f64], cx: &mut [f64], cy: &mut [f64]) {
        let size = self.z.len();
        for (k, z) in self.z.iter_mut().enumerate() {
            *z = Complex::new(x.get(k).copied().unwrap_or(0.0), y.get(k).copied().unwrap_or(0.0));
        }
        self.forward.process_with_scratch(&mut self.z, &mut self.scratch);
        for k in 0..size {
            // Spectra of the two real series out of that of x + i y; their powers go back together.
            let (a, b) = (self.z[k], self.z[(size - k) % size].conj());
            self.product[k] = Complex::new((a + b).norm_sqr(), (a - b).norm_sqr()) * 0.25;
        }
        self.inverse.process_with_scratch(&mut self.product, &mut self.scratch);
        let mean = |k: usize| 1.0 / (size as f64 * (self.samples - k) as f64);
        for (k, c) in cx.iter_mut().enumerate() {
            *c = self.product[k].re * mean(k);
        }
        for (k, c) in cy.iter_mut().enumerate() {
            *c = self.product[k].im * mean(k);
        }
    }
}

/// The next number of the form 2^a 3^b 5^c: transforms of such sizes are fast.
fn smooth(n: usize) -> usize {
    (n.max(1)..)
        .find(|&m| {
            [2, 3, 5].iter().fold(m, |mut m, p| {
                while m.is_multiple_of(*p) {
                    m /= p;
                }
                m
            }) == 1
        })
        .unwrap_or(n)
}

/// Integrated correlation time of a series in samples, 1/2 + sum rho(tau), summed
/// up to the first window of five times itself (Sokal 1997).
#[must_use]
pub fn integrated_time(x: &[f64]) -> f64 {
    let n = x.len() as f64;
    let mean = x.iter().sum::<f64>() / n;
    let d: Vec<f64> = x.iter().map(|x| x - mean).collect();
    let c = auto(&d, x.len() / 2);
    let mut tau = 0.5;
    for (lag, c_lag) in c.iter().enumerate().skip(1) {
        tau += c_lag / c[0];
        if lag as f64 >= 5.0 * tau {
            return tau;
        }
    }
    f64::NAN
}

/// Place (fraction of a sample included) of the largest of `values` by the parabola through it and its neighbours.
#[must_use]
pub fn peak(values: &[f64]) -> Option<f64> {
    let (k, _) = values.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1))?;
    if k == 0 || k + 1 == values.len() {
        return Some(k as f64);
    }
    let (a, b, c) = (values[k - 1], values[k], values[k + 1]);
    let curvature = a - 2.0 * b + c;
    Some(k as f64 + if curvature < 0.0 { 0.5 * (a - c) / curvature } else { 0.0 })
}

/// By how much `y` lags behind `x`, in samples: the highest cross-correlation within `±max`
/// of the series without their means (Lan 4.3). Give less than half a period for periodic series.
#[must_use]
pub fn lag(x: &[f64], y: &[f64], max: usize) -> Option<f64> {
    let centred = |s: &[f64]| -> Vec<f64> {
        let m = s.iter().sum::<f64>() / s.len() as f64;
        s.iter().map(|v| v - m).collect()
    };
    let c = cross(&centred(x), &centred(y), max);
    peak(&c).map(|p| p - (c.len() / 2) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::known::{ornstein_uhlenbeck, white};
    use std::f64::consts::TAU;

    #[test]
    fn agrees_with_the_sum_written_out() {
        let (x, y) = (white(57, 1.0, 1), white(57, 1.0, 2));
        let c = cross(&x, &y, 20);
        for (k, c) in c.iter().enumerate() {
            let lag = k as i64 - 20;
            let pairs: Vec<f64> = (0..57_i64)
                .filter(|t| (0..57).contains(&(t + lag)))
                .map(|t| x[t as usize] * y[(t + lag) as usize])
                .collect();
            let direct = pairs.iter().sum::<f64>() / pairs.len() as f64;
            assert!((c - direct).abs() < 1e-13, "{lag}");
        }
        let path: Vec<f64> = ornstein_uhlenbeck(40, 1.0, 1.0, 5.0, 1).iter().map(|x| x + 1e3).collect();
        for (lag, m) in mean_square_displacement(&path, 30).iter().enumerate() {
            let direct: f64 =
                (0..40 - lag).map(|t| (path[t + lag] - path[t]).powi(2)).sum::<f64>() / (40 - lag) as f64;
            // Rounding of a path offset by 1e3, after centring.
            assert!((m - direct).abs() < 1e-11, "{lag}");
        }
    }

    #[test]
    fn two_series_at_a_time() {
        let (x, y) = (white(100, 1.0, 1), white(100, 3.0, 2));
        let mut c = Correlator::new(100, 30);
        let (mut cx, mut cy) = (vec![0.0; 31], vec![0.0; 31]);
        c.auto_pair(&x, &y, &mut cx, &mut cy);
        for (a, b) in cx.iter().zip(auto(&x, 30)).chain(cy.iter().zip(auto(&y, 30))) {
            assert!((a - b).abs() < 1e-13);
        }
        assert_eq!([smooth(7), smooth(3000), smooth(3001)], [8, 3000, 3072]);
    }

    #[test]
    fn a_delayed_sine_lags_by_its_phase() {
        // Lan eq. 3-2-4: R_xy = x0²/2 cos(w tau - phi).
        let w = TAU / 50.0;
        let x: Vec<f64> = (0..5000).map(|t| (w * f64::from(t)).sin()).collect();
        let y: Vec<f64> = (0..5000).map(|t| 3.0 * (w * f64::from(t) - 0.7).sin()).collect();
        let c = cross(&x, &y, 24);
        for (k, c) in c.iter().enumerate() {
            // Products over 5000 samples: the oscillating part averages to below 1/(w N) = 2e-3 times 1.5.
            assert!((c - 1.5 * (w * (k as f64 - 24.0) - 0.7).cos()).abs() < 3e-3);
        }
        // A parabola through a cosine at 50 samples a period is off by less than 0.01 samples.
        assert!((lag(&x, &y, 24).unwrap() - 0.7 / w).abs() < 0.02);
    }

    #[test]
    fn noise_keeps_its_lag() {
        let x = white(20_000, 1.0, 8);
        let noise = white(20_000, 1.0, 9);
        let y: Vec<f64> = (0..20_000).map(|t| if t < 7 { 0.0 } else { x[t - 7] } + noise[t]).collect();
        assert!((lag(&x, &y, 50).unwrap() - 7.0).abs() < 0.05);
    }

    #[test]
    fn integral_of_the_correlation_of_a_known_process() {
        let x = ornstein_uhlenbeck(200_000, 1.0, 2.0, 8.0, 5);
        let a = (-0.125_f64).exp();
        let exact = 0.5 * (1.0 + a) / (1.0 - a);
        // Relative error sqrt(2 (2 W + 1)/n) with the window W = 5 tau = 40 (Sokal): 2.9 %; three of those.
        assert!((integrated_time(&x) / exact - 1.0).abs() < 0.09, "{}", integrated_time(&x));
    }
}

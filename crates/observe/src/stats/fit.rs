//! Straight lines.

use crate::accumulate::Estimate;

/// y = intercept + slope x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// Value at x = 0.
    pub intercept: Estimate,
    /// Slope.
    pub slope: Estimate,
}

/// Least squares; errors from the scatter about the line, as if the points were independent.
/// `None` with fewer than three points or one place only.
#[must_use]
pub fn line(x: &[f64], y: &[f64]) -> Option<Line> {
    let n = x.len().min(y.len());
    if n < 3 {
        return None;
    }
    let mean = |v: &[f64]| v[..n].iter().sum::<f64>() / n as f64;
    let (mx, my) = (mean(x), mean(y));
    let (mut xx, mut xy) = (0.0, 0.0);
    for k in 0..n {
        xx += (x[k] - mx) * (x[k] - mx);
        xy += (x[k] - mx) * (y[k] - my);
    }
    if xx <= 0.0 {
        return None;
    }
    let slope = xy / xx;
    let intercept = my - slope * mx;
    let chi2: f64 = (0..n).map(|k| (y[k] - intercept - slope * x[k]).powi(2)).sum();
    let s2 = chi2 / (n as f64 - 2.0);
    Some(Line {
        intercept: Estimate { value: intercept, error: (s2 * (1.0 / n as f64 + mx * mx / xx)).sqrt() },
        slope: Estimate { value: slope, error: (s2 / xx).sqrt() },
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::known::white;

    #[test]
    fn recovers_a_line_in_noise_with_its_error() {
        let x: Vec<f64> = (0..400).map(|k| f64::from(k) * 0.01).collect();
        let noise = white(400, 0.25, 6);
        let y: Vec<f64> = x.iter().zip(&noise).map(|(x, e)| 1.0 - 2.0 * x + e).collect();
        let l = line(&x, &y).unwrap();
        // 0.5/sqrt(sum (x - mean)²) = 0.5/sqrt(533) = 0.0217.
        assert!((l.slope.error / 0.0217 - 1.0).abs() < 0.15);
        assert!((l.slope.value + 2.0).abs() < 4.0 * l.slope.error);
        assert!((l.intercept.value - 1.0).abs() < 4.0 * l.intercept.error);
        assert!(line(&[1.0, 1.0, 1.0], &[0.0, 1.0, 2.0]).is_none());
    }
}

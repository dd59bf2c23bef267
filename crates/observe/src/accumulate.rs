//! Sums of fixed size that still know their error.

use serde::{Deserialize, Serialize};

/// A value with its standard error; the error is NaN where it is not known.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Estimate {
    /// The value.
    pub value: f64,
    /// Its standard error.
    pub error: f64,
}

/// Sums of rows over a run, kept in a fixed number of batches of equal
/// length. When all are full, neighbours are merged and the length doubles,
/// so that between half of them and all of them are in use.
///
/// Batches longer than the correlation time are independent: any function of
/// the totals gets a standard error from them by the jackknife.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Batched {
    width: usize,
    kept: usize,
    length: u64,
    rows: u64,
    sums: Vec<f64>,
}

impl Batched {
    /// Batches for rows of `width` numbers; `kept` is made even, at least 4;
    /// `length` rows fill a batch at first (a whole cycle, to begin with).
    #[must_use]
    pub fn new(width: usize, kept: usize, length: u64) -> Self {
        let kept = kept.max(4).next_multiple_of(2);
        Self { width, kept, length: length.max(1), rows: 0, sums: vec![0.0; width * kept] }
    }

    /// Adds one row.
    pub fn add(&mut self, row: &[f64]) {
        let batch = self.open();
        for (s, x) in batch.iter_mut().zip(row) {
            *s += x;
        }
    }

    /// The sums of the batch that takes the next row, which counts as added.
    pub fn open(&mut self) -> &mut [f64] {
        if self.rows == self.length * self.kept as u64 {
            self.merge();
        }
        let b = (self.rows / self.length) as usize;
        self.rows += 1;
        &mut self.sums[b * self.width..(b + 1) * self.width]
    }

    fn merge(&mut self) {
        let w = self.width;
        for b in 0..self.kept / 2 {
            for k in 0..w {
                self.sums[b * w + k] = self.sums[2 * b * w + k] + self.sums[(2 * b + 1) * w + k];
            }
        }
        self.sums[self.kept / 2 * w..].fill(0.0);
        self.length *= 2;
    }

    /// Number of rows added.
    #[must_use]
    pub fn rows(&self) -> u64 {
        self.rows
    }

    /// Number of full batches.
    #[must_use]
    pub fn full(&self) -> usize {
        (self.rows / self.length) as usize
    }

    /// Rows in a full batch.
    #[must_use]
    pub fn length(&self) -> u64 {
        self.length
    }

    /// The sums of batch `b`.
    #[must_use]
    pub fn batch(&self, b: usize) -> &[f64] {
        &self.sums[b * self.width..(b + 1) * self.width]
    }

    /// Sums over all rows.
    #[must_use]
    pub fn total(&self) -> Vec<f64> {
        let mut t = vec![0.0; self.width];
        for b in 0..self.kept {
            for (t, s) in t.iter_mut().zip(self.batch(b)) {
                *t += s;
            }
        }
        t
    }

    /// Functions of the sums, with errors by the jackknife: `f` receives sums,
    /// the number of rows behind them, and the place for its `outputs` values.
    ///
    /// error² = (B - 1)/B sum_b (f_(b) - mean f_(b))², f_(b) without batch b
    /// (Efron 1982).
    #[must_use]
    pub fn estimates(&self, outputs: usize, f: impl Fn(&[f64], f64, &mut [f64])) -> Vec<Estimate> {
        let total = self.total();
        let mut value = vec![f64::NAN; outputs];
        if self.rows == 0 {
            return value.iter().map(|&value| Estimate { value, error: f64::NAN }).collect();
        }
        f(&total, self.rows as f64, &mut value);
        let (mut mean, mut square) = (vec![0.0; outputs], vec![0.0; outputs]);
        let n = self.full();
        let mut without = total.clone();
        let mut out = vec![0.0; outputs];
        for b in 0..n {
            for k in 0..self.width {
                without[k] = total[k] - self.batch(b)[k];
            }
            f(&without, (self.rows - self.length) as f64, &mut out);
            for k in 0..outputs {
                // About the value, so that a small spread survives the squares.
                let d = out[k] - value[k];
                mean[k] += d;
                square[k] += d * d;
            }
        }
        let b = n as f64;
        (0..outputs)
            .map(|k| {
                let spread = square[k] - mean[k] * mean[k] / b;
                // Rounding may carry it below zero; what is not a number must stay so.
                let spread = if spread < 0.0 { 0.0 } else { spread };
                let error = if n < 2 { f64::NAN } else { ((b - 1.0) / b * spread).sqrt() };
                Estimate { value: value[k], error }
            })
            .collect()
    }

    /// The means of the columns.
    #[must_use]
    pub fn means(&self) -> Vec<Estimate> {
        self.estimates(self.width, |s, n, out| {
            for (o, s) in out.iter_mut().zip(s) {
                *o = s / n;
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn merging_loses_nothing() {
        let mut a = Batched::new(2, 4, 1);
        for k in 0..1000 {
            a.add(&[f64::from(k), 1.0]);
        }
        assert_eq!(a.total(), [999.0 * 500.0, 1000.0]);
        assert!(a.full() >= 2 && a.full() <= 4);
    }

    #[test]
    fn error_of_a_mean_is_that_of_its_batches() {
        // Four batches of one row: the jackknife of a mean is the textbook s/sqrt(n).
        let mut a = Batched::new(1, 4, 1);
        for x in [1.0, 2.0, 4.0, 9.0] {
            a.add(&[x]);
        }
        let e = a.means()[0];
        let s2: f64 = [1.0, 2.0, 4.0, 9.0].iter().map(|x| (x - 4.0_f64).powi(2)).sum::<f64>() / 3.0;
        assert_eq!(e.value, 4.0);
        assert!((e.error - (s2 / 4.0).sqrt()).abs() < 1e-14);
    }

    #[test]
    fn error_of_a_ratio_follows_its_scatter() {
        // x/y with y = 2 x has no scatter though both vary.
        let mut a = Batched::new(2, 8, 1);
        for k in 1..50 {
            a.add(&[f64::from(k), 2.0 * f64::from(k)]);
        }
        let e = a.estimates(1, |s, _, o| o[0] = s[0] / s[1])[0];
        assert!(e.error < 1e-15 && (e.value - 0.5).abs() < 1e-15);
    }
}

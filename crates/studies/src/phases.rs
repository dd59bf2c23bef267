//! Curves against the phase of the shake, averaged over cycles.

use crate::runs::column;
use brazilnut_base::Table;

/// A column of a table by phase.
pub struct PhaseCurve {
    /// Phase in degrees and value.
    pub points: Vec<[f64; 2]>,
    /// Standard error of each value.
    pub error: Vec<f64>,
}

impl PhaseCurve {
    /// The column `name` of `table` with its error.
    #[must_use]
    pub fn read(table: &Table, name: &str) -> Self {
        let [phase, value, error] =
            ["phase".to_string(), name.to_string(), format!("{name}_error")].map(|c| column(table, &c));
        Self { points: phase.into_iter().zip(value).map(|(p, v)| [p, v]).collect(), error }
    }

    /// The curve above its least value: grains of a resting bed do not all touch the floor.
    #[must_use]
    pub fn above_least(mut self) -> Self {
        let rest = least(&self.points)[1];
        self.points.iter_mut().for_each(|p| p[1] -= rest);
        self
    }
}

/// The point of the largest value.
#[must_use]
pub fn largest(points: &[[f64; 2]]) -> [f64; 2] {
    points.iter().copied().max_by(|a, b| a[1].total_cmp(&b[1])).unwrap_or([f64::NAN; 2])
}

/// The point of the least value.
#[must_use]
pub fn least(points: &[[f64; 2]]) -> [f64; 2] {
    points.iter().copied().min_by(|a, b| a[1].total_cmp(&b[1])).unwrap_or([f64::NAN; 2])
}

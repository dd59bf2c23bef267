//! What a study is.

use brazilnut_base::figure::Figure;
use brazilnut_runner::Failure;
use std::path::PathBuf;

/// One published table, figure or statement.
pub struct Study {
    /// Name, that of its folder in `studies/`.
    pub id: &'static str,
    /// What it is about.
    pub title: &'static str,
    /// What was published: the text of `published.toml`.
    pub published: &'static str,
    /// The README of its folder.
    pub readme: &'static str,
    /// Computes the quantities.
    pub run: fn(&Request) -> Result<Ran, Failure>,
}

/// How a study is to be run.
#[derive(Clone, Debug)]
pub struct Request {
    /// The short form.
    pub quick: bool,
    /// Folder for runs and plots.
    pub out: PathBuf,
}

/// What a study found.
#[derive(Clone, Debug, Default)]
pub struct Ran {
    /// The quantities, by the names in `published.toml`.
    pub computed: Vec<Computed>,
    /// Plots, with the published points on them where there are any.
    pub figures: Vec<Figure>,
}

/// One computed quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct Computed {
    /// Its name in `published.toml`.
    pub name: String,
    /// Its value in the unit given there.
    pub value: f64,
    /// Its standard error, if it is known.
    pub error: Option<f64>,
}

impl Computed {
    /// A quantity.
    #[must_use]
    pub fn new(name: impl Into<String>, value: f64) -> Self {
        Self { name: name.into(), value, error: None }
    }

    /// A result whose standard error is known.
    #[must_use]
    pub fn with_error(name: impl Into<String>, value: f64, error: f64) -> Self {
        Self { name: name.into(), value, error: Some(error) }
    }

    /// The mean of runs that differ by their seed, with its standard error.
    #[must_use]
    pub fn mean(name: impl Into<String>, of: &[f64]) -> Self {
        let n = of.len() as f64;
        let mean = of.iter().sum::<f64>() / n;
        let square: f64 = of.iter().map(|x| (x - mean) * (x - mean)).sum();
        let error = (of.len() > 1).then(|| (square / (n * (n - 1.0))).sqrt());
        Self { name: name.into(), value: mean, error }
    }

    /// The mean ratio of runs with the same seeds, with its standard error.
    #[must_use]
    pub fn ratio(name: impl Into<String>, above: &[f64], below: &[f64]) -> Self {
        let ratios: Vec<f64> = above.iter().zip(below).map(|(a, b)| a / b).collect();
        Self::mean(name, &ratios)
    }
}

impl From<(Vec<Computed>, Vec<Figure>)> for Ran {
    fn from((computed, figures): (Vec<Computed>, Vec<Figure>)) -> Self {
        Self { computed, figures }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn standard_error_of_three_runs() {
        let m = Computed::mean("x", &[1.0, 2.0, 6.0]);
        // Variance (4 + 1 + 9)/2 = 7; sqrt(7/3).
        assert!((m.value - 3.0).abs() < 1e-15 && (m.error.unwrap() - (7.0_f64 / 3.0).sqrt()).abs() < 1e-15);
        assert_eq!(Computed::mean("x", &[4.0]), Computed::new("x", 4.0));
    }
}

//! Distributions of diameters.

use super::PackingError;
use brazilnut_base::random::stream;
use brazilnut_base::values::Values;
use rand::RngExt;
use rand_distr::{Distribution, Normal};
use serde::{Deserialize, Serialize};

/// One class of a sieve analysis.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Class {
    /// Diameter, m.
    pub diameter: f64,
    /// Share of the number of grains, in any unit.
    pub share: f64,
}

/// How diameters are distributed, by number.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Sizes {
    /// Evenly between `mean (1 - spread)` and `mean (1 + spread)`.
    Even {
        /// Mean diameter, m.
        mean: f64,
        /// Half-width over mean.
        spread: f64,
    },
    /// Normal, drawn again where outside the bounds.
    Normal {
        /// Mean diameter before truncation, m.
        mean: f64,
        /// Standard deviation before truncation, m.
        deviation: f64,
        /// Smallest diameter, m.
        minimum: f64,
        /// Largest diameter, m.
        maximum: f64,
    },
    /// A list of diameters with their shares.
    Classes(Vec<Class>),
}

impl Sizes {
    /// All of one diameter, m.
    #[must_use]
    pub fn single(diameter: f64) -> Self {
        Self::Even { mean: diameter, spread: 0.0 }
    }

    /// The distribution from a table with [`DIAMETER_KEYS`](super::DIAMETER_KEYS).
    ///
    /// # Errors
    /// [`PackingError::Sizes`] if keys contradict each other or a size is not positive.
    pub fn read(values: &Values) -> Result<Self, PackingError> {
        let fail = |what: &str| Err(PackingError::Sizes(what.to_string()));
        let classes: Vec<Class> = values
            .tables("classes")
            .map(|t| Class { diameter: t.number("diameter"), share: t.number("share") })
            .collect();
        let sizes =
            match (values.number_opt("mean"), values.number_opt("standard_deviation"), classes.is_empty()) {
                (None, None, false) => Self::Classes(classes),
                (Some(_), _, false) => return fail("`mean` and `classes` cannot both be given"),
                (None, _, _) => return fail("a diameter needs `mean` or `classes`"),
                (Some(mean), None, true) => {
                    Self::Even { mean, spread: values.number_opt("spread").unwrap_or(0.0) }
                }
                (Some(_), Some(_), true) if values.has("spread") => {
                    return fail("`spread` and `standard_deviation` cannot both be given");
                }
                (Some(mean), Some(deviation), true) => Self::Normal {
                    mean,
                    deviation,
                    // Three deviations hold 99.7 %: beyond, one freak grain would set the time step.
                    minimum: values.number_opt("minimum").unwrap_or(mean - 3.0 * deviation),
                    maximum: values.number_opt("maximum").unwrap_or(mean + 3.0 * deviation),
                },
            };
        sizes.check()?;
        Ok(sizes)
    }

    /// Smallest and largest diameter that can be drawn, m.
    #[must_use]
    pub fn range(&self) -> [f64; 2] {
        match self {
            Self::Even { mean, spread } => [mean * (1.0 - spread), mean * (1.0 + spread)],
            Self::Normal { minimum, maximum, .. } => [*minimum, *maximum],
            Self::Classes(list) => {
                list.iter().fold([f64::INFINITY, 0.0], |[a, b], c| [a.min(c.diameter), b.max(c.diameter)])
            }
        }
    }

    /// Refuses what cannot be drawn from.
    ///
    /// # Errors
    /// [`PackingError::Sizes`] with the reason.
    pub fn check(&self) -> Result<(), PackingError> {
        let [low, high] = self.range();
        let fail = |what: String| Err(PackingError::Sizes(what));
        if !(low > 0.0 && high.is_finite()) {
            return fail(format!("the smallest diameter is {low:.3e} m, it must be greater than zero"));
        }
        match self {
            Self::Even { spread, .. } if !(0.0..1.0).contains(spread) => {
                fail(format!("`spread` is {spread}, it must be at least 0 and below 1"))
            }
            // Truncated farther out than this, redrawing would all but never end.
            Self::Normal { mean, deviation, .. }
                if low > mean + 3.0 * deviation || high < mean - 3.0 * deviation =>
            {
                fail("the bounds of the diameter lie beyond three standard deviations from the mean".into())
            }
            Self::Normal { deviation, .. } if *deviation <= 0.0 || high <= low => {
                fail("`standard_deviation` must be greater than zero and `maximum` above `minimum`".into())
            }
            Self::Classes(list) if list.iter().any(|c| c.share.is_nan() || c.share < 0.0) => {
                fail("a class has a negative share".into())
            }
            Self::Classes(list) if list.iter().map(|c| c.share).sum::<f64>() <= 0.0 => {
                fail("the shares of the classes add up to nothing".into())
            }
            _ => Ok(()),
        }
    }

    /// The diameter of the grain with identity `k`, m.
    #[must_use]
    pub fn draw(&self, seed: u64, k: usize) -> f64 {
        let mut random = stream(seed, "diameter", k as u64);
        match self {
            Self::Even { mean, spread } => mean * (1.0 + spread * (2.0 * random.random::<f64>() - 1.0)),
            Self::Normal { mean, deviation, minimum, maximum } => {
                let normal = Normal::new(*mean, *deviation).expect("checked");
                loop {
                    let d = normal.sample(&mut random);
                    if (*minimum..=*maximum).contains(&d) {
                        return d;
                    }
                }
            }
            Self::Classes(list) => {
                let total: f64 = list.iter().map(|c| c.share).sum();
                let mut left = random.random::<f64>() * total;
                for c in list {
                    left -= c.share;
                    if left < 0.0 {
                        return c.diameter;
                    }
                }
                // Rounding in the subtraction can pass the end of the list.
                list.iter().rev().find(|c| c.share > 0.0).expect("checked").diameter
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn moments(sizes: &Sizes) -> (f64, f64, f64, f64) {
        let d: Vec<f64> = (0..20_000).map(|k| sizes.draw(7, k)).collect();
        let n = d.len() as f64;
        let mean = d.iter().sum::<f64>() / n;
        let var = d.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / n;
        let (low, high) = d.iter().fold((f64::INFINITY, 0.0_f64), |(a, b), &x| (a.min(x), b.max(x)));
        (mean, var.sqrt(), low, high)
    }

    #[test]
    fn drawn_moments() {
        // Standard error of a mean of 20 000 draws is 0.7 % of the deviation; four of them allowed.
        let (mean, dev, low, high) = moments(&Sizes::Even { mean: 2.0, spread: 0.15 });
        let s = 0.3 / 3.0_f64.sqrt();
        assert!((mean - 2.0).abs() < 0.03 * s && (dev / s - 1.0).abs() < 0.02 && low >= 1.7 && high <= 2.3);
        let (mean, dev, low, high) =
            moments(&Sizes::Normal { mean: 2.0, deviation: 0.1, minimum: 1.7, maximum: 2.3 });
        // Truncation at three deviations takes 1.3 % off the deviation.
        assert!((mean - 2.0).abs() < 3e-3 && (dev - 0.0987).abs() < 2e-3 && low >= 1.7 && high <= 2.3);
        let classes =
            Sizes::Classes(vec![Class { diameter: 1.0, share: 3.0 }, Class { diameter: 2.0, share: 1.0 }]);
        assert!((moments(&classes).0 - 1.25).abs() < 0.013);
    }

    #[test]
    fn a_draw_depends_on_seed_and_grain_only() {
        let s = Sizes::Even { mean: 1.0, spread: 0.5 };
        assert_eq!(s.draw(1, 5), s.draw(1, 5));
        assert_ne!(s.draw(1, 5), s.draw(1, 6));
        assert_ne!(s.draw(1, 5), s.draw(2, 5));
    }

    #[test]
    fn nonsense_is_refused() {
        for s in [
            Sizes::Even { mean: 1.0, spread: 1.0 },
            Sizes::Even { mean: -1.0, spread: 0.0 },
            Sizes::Normal { mean: 1.0, deviation: 0.1, minimum: 2.0, maximum: 3.0 },
            Sizes::Normal { mean: 1.0, deviation: 0.5, minimum: -0.5, maximum: 2.5 },
            Sizes::Classes(vec![]),
            Sizes::Classes(vec![Class { diameter: 1.0, share: 0.0 }]),
        ] {
            assert!(s.check().is_err(), "{s:?}");
        }
    }
}

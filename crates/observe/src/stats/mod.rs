//! Estimators as pure functions, and the few that must run along with a series.

pub mod blocking;
pub mod correlation;
pub mod correlogram;
pub mod fit;
pub mod spectrum;
pub mod steady;

#[cfg(test)]
pub(crate) mod known {
    //! Series with known answers.

    use brazilnut_base::random;
    use rand_distr::{Distribution, Normal};

    /// Ornstein-Uhlenbeck process of variance `s2` and correlation time `tau`, exactly stepped:
    /// autocovariance s2 exp(-t/tau), integral s2 tau.
    pub fn ornstein_uhlenbeck(n: usize, dt: f64, s2: f64, tau: f64, seed: u64) -> Vec<f64> {
        let mut rng = random::stream(seed, "ornstein-uhlenbeck", 0);
        let a = (-dt / tau).exp();
        let normal = Normal::new(0.0, 1.0).unwrap();
        let mut x = s2.sqrt() * normal.sample(&mut rng);
        let kick = (s2 * (1.0 - a * a)).sqrt();
        (0..n)
            .map(|_| {
                let now = x;
                x = a * x + kick * normal.sample(&mut rng);
                now
            })
            .collect()
    }

    /// White noise of variance `s2`.
    pub fn white(n: usize, s2: f64, seed: u64) -> Vec<f64> {
        let mut rng = random::stream(seed, "white", 0);
        let normal = Normal::new(0.0, s2.sqrt()).unwrap();
        (0..n).map(|_| normal.sample(&mut rng)).collect()
    }
}

//! Flow between two parallel plates at y = 0 and y = H.

use std::f64::consts::PI;

/// Terms of the series after which start-up flows have decayed to rounding
/// for times of interest.
const TERMS: usize = 200;

/// Plane Poiseuille flow under a uniform acceleration g along the plates, m/s:
/// `u = g y (H - y) / (2 nu)`.
#[must_use]
pub fn poiseuille(acceleration: f64, height: f64, nu: f64, y: f64) -> f64 {
    acceleration * y * (height - y) / (2.0 * nu)
}

/// The same, started from rest at t = 0, m/s:
/// `u = u_steady - 4 g H²/(nu pi³) sum over odd n of sin(n pi y/H) exp(-n² pi² nu t/H²) / n³`.
#[must_use]
pub fn poiseuille_start(acceleration: f64, height: f64, nu: f64, y: f64, t: f64) -> f64 {
    let transient: f64 = (0..TERMS)
        .map(|m| {
            let n = (2 * m + 1) as f64;
            (n * PI * y / height).sin() * (-n * n * PI * PI * nu * t / (height * height)).exp() / n.powi(3)
        })
        .sum();
    poiseuille(acceleration, height, nu, y)
        - 4.0 * acceleration * height * height / (nu * PI.powi(3)) * transient
}

/// Plane Couette flow with the plate at H moving at U from t = 0 on, m/s:
/// `u = U y/H + (2 U/pi) sum (-1)^n / n sin(n pi y/H) exp(-n² pi² nu t/H²)`.
#[must_use]
pub fn couette_start(speed: f64, height: f64, nu: f64, y: f64, t: f64) -> f64 {
    let transient: f64 = (1..=TERMS)
        .map(|m| {
            let n = m as f64;
            let sign = if m % 2 == 0 { 1.0 } else { -1.0 };
            sign / n * (n * PI * y / height).sin() * (-n * n * PI * PI * nu * t / (height * height)).exp()
        })
        .sum();
    speed * y / height + 2.0 * speed / PI * transient
}

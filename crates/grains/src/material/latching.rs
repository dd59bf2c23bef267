//! Partially latching spring of Walton and Braun: K1 when loading, K2 = K1/e² when unloading (Lan 2.4.1).

use std::f64::consts::{FRAC_PI_2, PI};

/// Unloading stiffness for restitution `e`: K2 = K1/e², N/m (Lan 2-4-12).
#[must_use]
pub fn latching_unloading_stiffness(k1: f64, e: f64) -> f64 {
    k1 / (e * e)
}

/// Contact time: a quarter period on each stiffness, (1 + e)(pi/2) sqrt(m/K1), s (from Lan 2-5-2).
///
/// Lan counts twice the unloading part, which is shorter by 2e/(1 + e).
#[must_use]
pub fn latching_contact_time(m: f64, k1: f64, e: f64) -> f64 {
    (1.0 + e) * FRAC_PI_2 * (m / k1).sqrt()
}

/// Lan's step: his contact time, twice the unloading, in `n` parts: (pi e/n) sqrt(m/K1), s (Lan 2-5-4).
///
/// `m` effective mass, kg: half a grain's for equal grains.
#[must_use]
pub fn latching_step(m: f64, k1: f64, e: f64, n: f64) -> f64 {
    PI * e / n * (m / k1).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn printed_steps_of_lan_are_fifteenths() {
        let m = |d: f64, rho: f64| 0.5 * rho * PI * d * d * d / 6.0;
        // Tables 4.1 and 4.4, d 0.1 m, density 1200, e 0.9: five printed digits.
        assert!((latching_step(m(0.1, 1200.0), 2.7e8, 0.9, 15.0) - 6.4297e-6).abs() < 0.0005e-6);
        assert!((latching_step(m(0.1, 1200.0), 2.8e6, 0.9, 15.0) - 6.3139e-5).abs() < 0.0005e-5);
    }

    #[test]
    fn duration_by_restitution() {
        let (m, k) = (0.2, 1e5);
        // An elastic contact is half a period of one spring.
        assert!((latching_contact_time(m, k, 1.0) - PI * (m / k).sqrt()).abs() < 1e-18);
        assert!(
            (latching_contact_time(m, k, 0.9) / (15.0 * latching_step(m, k, 0.9, 15.0)) - 1.9 / 1.8).abs()
                < 1e-14
        );
        assert_eq!(latching_unloading_stiffness(k, 0.5), 4.0 * k);
    }
}

//! Hertzian elasticity: what the elastic constants of two bodies say about their contact.

use super::Elastic;
use std::f64::consts::PI;

/// Effective modulus: 1/E* = (1 - nu1²)/E1 + (1 - nu2²)/E2, Pa (Clément 2.7).
#[must_use]
pub fn effective_modulus(a: &Elastic, b: &Elastic) -> f64 {
    let compliance = |s: &Elastic| (1.0 - s.poisson_ratio * s.poisson_ratio) / s.youngs_modulus;
    1.0 / (compliance(a) + compliance(b))
}

/// Effective shear modulus: 1/G* = (2 - nu1)/G1 + (2 - nu2)/G2, Pa (Mindlin 1949).
#[must_use]
pub fn effective_shear_modulus(a: &Elastic, b: &Elastic) -> f64 {
    let compliance = |s: &Elastic| (2.0 - s.poisson_ratio) / s.shear_modulus();
    1.0 / (compliance(a) + compliance(b))
}

/// Hertz stiffness k in F = k delta^(3/2): (4/3) sqrt(r) E*, N m^(-3/2) (Clément 2.5).
///
/// `r` effective radius, m; `modulus` effective modulus, Pa.
#[must_use]
pub fn hertz_stiffness(r: f64, modulus: f64) -> f64 {
    4.0 / 3.0 * r.sqrt() * modulus
}

/// Tangential over normal stiffness of a Hertzian contact before slip: 8 G* a/(2 E* a) = 4 G*/E* (Mindlin 1949).
///
/// For equal materials 2(1 - nu)/(2 - nu).
#[must_use]
pub fn mindlin_ratio(a: &Elastic, b: &Elastic) -> f64 {
    4.0 * effective_shear_modulus(a, b) / effective_modulus(a, b)
}

/// Contact time over overlap/speed of an elastic Hertz impact: (4/5) B(2/5, 1/2) = 2 ∫₀¹ dx/sqrt(1 - x^(5/2)).
const HERTZ_TIME: f64 = 2.943_275_184_324_704_7;

/// Largest overlap of an elastic Hertz impact at speed `v`: (5 m v²/(4 k))^(2/5), m.
///
/// `m` effective mass, kg; `k` Hertz stiffness, N m^(-3/2). Energy m v²/2 = (2/5) k delta^(5/2).
#[must_use]
pub fn hertz_overlap(m: f64, k: f64, v: f64) -> f64 {
    (1.25 * m * v * v / k).powf(0.4)
}

/// Contact time of an elastic Hertz impact at speed `v`: 2.9433 delta_max/v, s (Landau & Lifshitz, Elasticity, § 9).
#[must_use]
pub fn hertz_contact_time(m: f64, k: f64, v: f64) -> f64 {
    HERTZ_TIME * hertz_overlap(m, k, v) / v
}

/// Smallest Hertz stiffness whose overlap at impact speed `v` stays below `overlap` (m): 5 m v²/(4 overlap^(5/2)).
#[must_use]
pub fn hertz_stiffness_for_overlap(m: f64, v: f64, overlap: f64) -> f64 {
    1.25 * m * v * v / overlap.powf(2.5)
}

/// Linear stiffness that stores the energy of an impact at speed `v` in the overlap that Hertz gives it:
/// K1 = m (v/delta_max)², N/m (Lan 2-5-5 to 2-5-9).
///
/// Lan puts the mass of one sphere (a sphere on the rigid floor) beside the stiffness of a pair; with
/// `m` the effective mass and `k` the Hertz stiffness of the same contact it holds for any contact.
#[must_use]
pub fn energy_equivalent_stiffness(m: f64, k: f64, v: f64) -> f64 {
    let x = v / hertz_overlap(m, k, v);
    m * x * x
}

/// Time a Rayleigh wave takes over a grain: pi r sqrt(rho/G)/(0.1631 nu + 0.8766), s (Thornton & Randall 1988).
///
/// `r` radius, m; `density` kg/m³. A step below 0.1-0.3 of it resolves the waves in quasi-static beds.
#[must_use]
pub fn rayleigh_time(r: f64, density: f64, elastic: &Elastic) -> f64 {
    PI * r * (density / elastic.shear_modulus()).sqrt() / (0.1631 * elastic.poisson_ratio + 0.8766)
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEEL: Elastic = Elastic { youngs_modulus: 1.93e11, poisson_ratio: 0.35 };

    #[test]
    fn steel_of_clement_table_2_1() {
        let r = 0.0127;
        let modulus = effective_modulus(&STEEL, &STEEL);
        let k = hertz_stiffness(super::super::effective_radius(r, r), modulus);
        // Half a unit of the last digit of the recomputed value; the thesis prints 1.942e9 (misprint).
        assert!((k - 1.168e10).abs() < 0.0005e10, "{k:e}");
        let m = 0.5 * 8030.0 * 4.0 / 3.0 * PI * r * r * r;
        let t = hertz_contact_time(m, k, 0.84);
        assert!((t - 81.39e-6).abs() < 0.01e-6, "{t:e}");
    }

    #[test]
    fn the_hertz_time_constant_is_its_integral() {
        // x = 1 - s² takes the singularity out of 2 ∫ dx/sqrt(1 - x^(5/2)); midpoint rule, error h²/24 f'' < 1e-7.
        let n = 4000;
        let sum: f64 = (0..n)
            .map(|i| {
                let s = (f64::from(i) + 0.5) / f64::from(n);
                4.0 * s / (1.0 - (1.0 - s * s).powf(2.5)).sqrt()
            })
            .sum();
        assert!((sum / f64::from(n) - HERTZ_TIME).abs() < 1e-7, "{}", sum / f64::from(n));
    }

    #[test]
    fn lan_equivalent_stiffness() {
        // Lan 2-5-10 as he applies it: one sphere's mass beside a pair's stiffness, V_b = 2.
        let printed = |d: f64, rho: f64, youngs_modulus: f64, poisson_ratio: f64| {
            let s = Elastic { youngs_modulus, poisson_ratio };
            let k = hertz_stiffness(d / 4.0, effective_modulus(&s, &s));
            let m = rho * PI * d * d * d / 6.0;
            energy_equivalent_stiffness(m, k, 2.0 * (2.0 * d * 9.81).sqrt())
        };
        // Acrylic of Table 4.1 and 1 cm glass (nu 0.22) of Table 4.2, two digits recomputed; printed 2.7e8 for both.
        assert!((printed(0.1, 1200.0, 3e9, 0.35) / 8.1e6 - 1.0).abs() < 0.01);
        assert!((printed(0.01, 2490.0, 6.89e10, 0.22) / 6.9e6 - 1.0).abs() < 0.02);
    }

    #[test]
    fn equal_stiffness_means_equal_energy_at_equal_overlap() {
        let (m, k, v) = (0.3, 4e9, 1.7);
        let delta = hertz_overlap(m, k, v);
        let k1 = energy_equivalent_stiffness(m, k, v);
        let (linear, hertz) = (0.5 * k1 * delta * delta, 0.4 * k * delta.powf(2.5));
        // Both are m v²/2 by other routes: rounding of powf only.
        assert!((linear / hertz - 1.0).abs() < 1e-13);
        assert!((hertz_stiffness_for_overlap(m, v, delta) / k - 1.0).abs() < 1e-13);
    }

    #[test]
    fn mindlin_ratio_of_equal_materials() {
        let s = Elastic { youngs_modulus: 7e10, poisson_ratio: 0.24 };
        assert!((mindlin_ratio(&s, &s) - 2.0 * (1.0 - 0.24) / (2.0 - 0.24)).abs() < 1e-15);
    }

    #[test]
    fn rayleigh_time_of_the_peer_bed() {
        // E 7e9 Pa, nu 0.24, d 1 mm: the peers' check reads 1.6e-6 s for the smallest grain of density 2500, two digits.
        let s = Elastic { youngs_modulus: 7e9, poisson_ratio: 0.24 };
        assert!((rayleigh_time(0.5e-3, 2500.0, &s) - 1.6e-6).abs() < 0.1e-6);
    }
}

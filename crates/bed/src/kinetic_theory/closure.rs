//! Constitutive relations of smooth, slightly inelastic spheres.
//!
//! ν is the solids fraction, G = ν g₀(ν), T = <C²>/3 the granular temperature
//! (m²/s²), d the diameter, ρ_s the density of the spheres.

use std::f64::consts::PI;

/// √π.
const SQRT_PI: f64 = 1.772_453_850_905_516;

/// Radial distribution at contact g₀ = (2−ν)/(2(1−ν)³) (Carnahan & Starling; Lan eq. 4-3-4).
///
/// It diverges at ν = 1 only and knows nothing of close packing.
#[must_use]
pub fn radial_distribution(nu: f64) -> f64 {
    (2.0 - nu) / (2.0 * (1.0 - nu).powi(3))
}

/// P/(ρ_s T) = ν (1 + 2(1+e)G).
#[must_use]
pub fn pressure_over_temperature(nu: f64, e: f64) -> f64 {
    nu * (1.0 + 2.0 * (1.0 + e) * nu * radial_distribution(nu))
}

/// The solids fraction at which P/(ρ_s T) is `x`, but no more than `densest`.
#[must_use]
pub fn solids_fraction(x: f64, e: f64, densest: f64) -> f64 {
    if x >= pressure_over_temperature(densest, e) {
        return densest;
    }
    let (mut low, mut high) = (0.0, densest.min(x));
    let mut nu = high * 0.5;
    for _ in 0..60 {
        let f = pressure_over_temperature(nu, e) - x;
        if f > 0.0 {
            high = nu
        } else {
            low = nu
        }
        let g = radial_distribution(nu);
        // d(ν² g₀)/dν = 2 ν g₀ + ν² g₀', with g₀'/g₀ = 3/(1−ν) − 1/(2−ν).
        let slope = 1.0 + 2.0 * (1.0 + e) * nu * g * (2.0 + nu * (3.0 / (1.0 - nu) - 1.0 / (2.0 - nu)));
        let newton = nu - f / slope;
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        if (next - nu).abs() <= 1e-15 * nu {
            return next;
        }
        nu = next;
    }
    nu
}

/// Conductivity κ/(ρ_s d √T) = (4/√π) M ν G, M = 1 + (9π/32)(1 + 5/(12G))²
/// (Jenkins & Richman, Arch. Ration. Mech. Anal. 87 (1985) 355, nearly elastic).
///
/// At ν → 0 it is 75√π/384, Chapman and Enskog's value for hard spheres.
#[must_use]
pub fn conductivity(nu: f64) -> f64 {
    let g0 = radial_distribution(nu);
    let collisional = nu * nu * g0 * (1.0 + 9.0 * PI / 32.0);
    let kinetic = 9.0 * PI / 32.0 * (5.0 / 6.0 * nu + 25.0 / (144.0 * g0));
    4.0 / SQRT_PI * (collisional + kinetic)
}

/// Dissipation γ d/(ρ_s T^(3/2)) = (12/√π)(1−e²) ν G.
#[must_use]
pub fn dissipation(nu: f64, e: f64) -> f64 {
    12.0 / SQRT_PI * (1.0 - e * e) * nu * nu * radial_distribution(nu)
}

/// Energy flux over pressure Q/P (m/s) that a flat floor hands to the grains,
/// `t` their temperature and `v2` the variance V² of its velocity along its normal (both m²/s²).
///
/// With grain and floor velocities independent and normal, the closing speed g
/// is normal with variance s² = T + V², and a collision (rate ∝ g) changes the
/// grain's velocity by (1+e_w)g. Momentum gives P ∝ (1+e_w)s²/2; the energy
/// gained is (1+e_w) g v + (1+e_w)² g²/2 with <v|g> = −g T/s², so that
///
/// Q/P = 2 √(2/π) s [V²/s² − (1−e_w)/2].
///
/// Limits: at rest (V = 0) −√(2/π)(1−e_w)√T, the loss to an inelastic wall;
/// slow floor 2√(2/π) V²/√T; cold grains (T = 0) √(2/π)(1+e_w)V, where each
/// collision gives the speed (1+e_w)g. A sinusoidal floor has bounded speed
/// and a phase that slow grains can follow: this form does not see either.
/// Boundary conditions written for bumpy floors (Richman & Martin's) carry
/// geometric averages over the bumps in front of the same two terms.
#[must_use]
pub fn floor_flux_over_pressure(t: f64, v2: f64, e_w: f64) -> f64 {
    let s2 = t + v2;
    2.0 * (2.0 / PI * s2).sqrt() * (v2 / s2 - 0.5 * (1.0 - e_w))
}

/// Self-diffusion coefficient D = d √(πT) / (8(1+e) ν g₀), m²/s (Savage; Lan eq. 4-3-3).
#[must_use]
pub fn self_diffusion(d: f64, t: f64, nu: f64, e: f64) -> f64 {
    d * (PI * t).sqrt() / (8.0 * (1.0 + e) * nu * radial_distribution(nu))
}

/// Collisions per grain and second (24/√π) ν g₀ √T / d.
///
/// Lan 4.2 prints 4 ν² d² √(π k T), which is no rate; with n = 6ν/(πd³)
/// grains per volume, 4 n d² g₀ √(πT) is.
#[must_use]
pub fn collision_rate(d: f64, t: f64, nu: f64) -> f64 {
    24.0 / SQRT_PI * nu * radial_distribution(nu) * t.sqrt() / d
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_equation_of_state_is_inverted() {
        for e in [0.6, 0.9, 1.0] {
            for nu in [1e-9, 1e-3, 0.1, 0.4, 0.64, 0.73] {
                let back = solids_fraction(pressure_over_temperature(nu, e), e, 0.74);
                // The slope magnifies rounding by up to d ln x / d ln ν, about 15 at 0.73.
                assert!((back / nu - 1.0).abs() < 1e-13, "{nu}: {back}");
            }
        }
        assert_eq!(solids_fraction(1e6, 0.9, 0.74), 0.74);
    }

    #[test]
    fn a_dilute_gas_conducts_like_chapman_and_enskog_s() {
        assert!((conductivity(0.0) - 75.0 * SQRT_PI / 384.0).abs() < 1e-15);
        // ν 0.5: g₀ = 6, G = 3, M = 1 + 0.88357 (1 + 0.13889)² = 2.14604, κ = 2.25676 · M · 1.5.
        assert!((conductivity(0.5) - 2.25676 * 2.14604 * 1.5).abs() < 2e-4);
    }

    #[test]
    fn floor_flux_has_its_limits() {
        let c = (2.0 / PI).sqrt();
        assert!((floor_flux_over_pressure(4.0, 0.0, 0.9) + c * 0.1 * 2.0).abs() < 1e-14);
        assert!((floor_flux_over_pressure(0.0, 4.0, 0.9) - c * 1.9 * 2.0).abs() < 1e-14);
        // Slow elastic floor: relative correction V²/(2T).
        assert!((floor_flux_over_pressure(1.0, 1e-8, 1.0) / (2.0 * c * 1e-8) - 1.0).abs() < 1e-8);
    }

    /// The derivation again, by adding up collisions of drawn velocities.
    #[test]
    fn floor_flux_is_what_collisions_add_up_to() {
        use brazilnut_base::random::stream;
        let mut draws = normals(stream(7, "floor flux", 0));
        let (t, v2, e_w) = (0.7_f64, 0.4_f64, 0.8);
        let (mut momentum, mut energy) = (0.0, 0.0);
        for _ in 0..400_000 {
            let v = t.sqrt() * draws();
            let g = v2.sqrt() * draws() - v;
            if g > 0.0 {
                let after = v + (1.0 + e_w) * g;
                momentum += g * (after - v);
                energy += g * 0.5 * (after * after - v * v);
            }
        }
        let expected = floor_flux_over_pressure(t, v2, e_w);
        // 200 000 collisions with a scatter of about 3 times the mean: 0.7 %; four times that.
        assert!((energy / momentum / expected - 1.0).abs() < 0.03, "{} {expected}", energy / momentum);
    }

    /// Normal numbers by Box and Muller.
    fn normals(mut rng: impl rand::Rng) -> impl FnMut() -> f64 {
        use rand::RngExt;
        move || {
            let (a, b): (f64, f64) = (rng.random(), rng.random());
            (-2.0 * (1.0 - a).ln()).sqrt() * (2.0 * PI * b).cos()
        }
    }

    /// Lan Table 4.5, both theory values, to the digits printed.
    #[test]
    fn self_diffusion_of_lan() {
        assert!((self_diffusion(0.1, 0.7950, 0.44, 0.9) - 0.00532).abs() < 5e-6);
        assert!((self_diffusion(0.1, 13.80, 0.14, 0.9) - 0.2116).abs() < 5e-5);
    }

    #[test]
    fn collision_rate_by_number_density() {
        let (d, t, nu) = (0.1_f64, 0.795_f64, 0.44);
        let n = 6.0 * nu / (PI * d.powi(3));
        let by_hand = 4.0 * n * d * d * radial_distribution(nu) * (PI * t).sqrt();
        assert!((collision_rate(d, t, nu) / by_hand - 1.0).abs() < 1e-14);
    }
}

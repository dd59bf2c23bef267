//! Linear spring and dashpot: F = k delta + c d(delta)/dt (Clément 2.1.3).

use std::f64::consts::PI;

/// Fraction of critical damping that gives restitution `e`: -ln e / sqrt(pi² + ln² e) (from Clément 2.18-2.20).
///
/// The damping of a contact is then `2 ratio sqrt(m k)`.
#[must_use]
pub fn damping_ratio(e: f64) -> f64 {
    let l = e.ln();
    if l == f64::NEG_INFINITY { 1.0 } else { -l / (PI * PI + l * l).sqrt() }
}

/// Damping for restitution `e`: sqrt(4 m k ln² e/(pi² + ln² e)), kg/s (Clément 2.23).
///
/// `m` effective mass, kg; `k` stiffness, N/m.
#[must_use]
pub fn linear_damping(m: f64, k: f64, e: f64) -> f64 {
    2.0 * damping_ratio(e) * (m * k).sqrt()
}

/// Restitution: exp(-pi eta/omega), eta = c/(2m), omega² = k/m - eta² (Clément 2.18-2.20); 0 if overdamped.
#[must_use]
pub fn linear_restitution(m: f64, k: f64, c: f64) -> f64 {
    let eta = c / (2.0 * m);
    let omega2 = k / m - eta * eta;
    if omega2 <= 0.0 { 0.0 } else { (-PI * eta / omega2.sqrt()).exp() }
}

/// Contact time pi/omega, s (Clément 2.17, 2.19): independent of the speed; infinite if overdamped.
#[must_use]
pub fn linear_contact_time(m: f64, k: f64, c: f64) -> f64 {
    let eta = c / (2.0 * m);
    let omega2 = k / m - eta * eta;
    if omega2 <= 0.0 { f64::INFINITY } else { PI / omega2.sqrt() }
}

/// Largest overlap of an undamped impact at speed `v`: v sqrt(m/k), m.
#[must_use]
pub fn linear_overlap(m: f64, k: f64, v: f64) -> f64 {
    v * (m / k).sqrt()
}

/// Stiffness for contact time `t` (s) at restitution `e`: m (pi² + ln² e)/t², N/m (Clément 2.17-2.19 solved for k).
#[must_use]
pub fn linear_stiffness_for_contact_time(m: f64, e: f64, t: f64) -> f64 {
    let l = e.ln();
    m * (PI * PI + l * l) / (t * t)
}

/// Smallest linear stiffness whose overlap at impact speed `v` stays below `overlap` (m): m (v/overlap)², N/m.
///
/// With `overlap` = [`OVERLAP_LIMIT`](super::OVERLAP_LIMIT) times the diameter, the rule of Lan 4.1.3.
#[must_use]
pub fn stiffness_for_overlap(m: f64, v: f64, overlap: f64) -> f64 {
    m * (v / overlap) * (v / overlap)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Steel of Clément Table 2.1 (r = 1.27 cm is the radius): effective mass of a pair, kg.
    fn steel_pair() -> f64 {
        0.5 * 8030.0 * 4.0 / 3.0 * PI * 0.0127_f64.powi(3)
    }

    #[test]
    fn steel_of_clement_table_2_2() {
        let (m, k, e) = (steel_pair(), 5.160e7, 0.879);
        // The printed damping 5.58 kg/s does not follow from eq. 2.23; the equation gives 109.4.
        let c = linear_damping(m, k, e);
        assert!((c - 109.4).abs() < 0.05, "{c}");
        assert!((linear_contact_time(m, k, c) - 81.24e-6).abs() < 0.005e-6);
        // Same expressions, rounding only.
        assert!((linear_restitution(m, k, c) - e).abs() < 1e-14);
        assert!((linear_restitution(m, k, 5.58) - 0.9934).abs() < 5e-5);
        assert!(
            (linear_stiffness_for_contact_time(m, e, linear_contact_time(m, k, c)) / k - 1.0).abs() < 1e-13
        );
    }

    #[test]
    fn overlap_rule_inverts_the_overlap() {
        let k = stiffness_for_overlap(0.3, 2.0, 1e-3);
        assert!((linear_overlap(0.3, k, 2.0) - 1e-3).abs() < 1e-17);
    }

    #[test]
    fn no_damping_without_loss_and_critical_damping_without_rebound() {
        assert_eq!(damping_ratio(1.0), 0.0);
        assert_eq!(damping_ratio(0.0), 1.0);
    }
}

//! How long a step may be before a packed bed begins to rattle.
//!
//! Verlet's scheme with the dashpot at the extrapolated velocity 3/2 v(t - dt/2) - 1/2 v(t - 3dt/2) has for one
//! oscillation, with h = omega dt, the characteristic equation
//!
//! ```text
//! (z - 1)² z + h² z² + zeta h (z - 1)(3z - 1) = 0,
//! ```
//!
//! whose roots leave the unit circle at z = -1, where h²/4 + 2 zeta h = 1. (With the half-step velocity of
//! Clément 2.12 it is h²/4 + zeta h = 1: steadier, one order less accurate.) For many contacts of springs K and
//! dashpots C the same holds with the largest eigenvalue of M⁻¹(K dt²/4 + C dt): a bed is stable while it is below 1.
//!
//! A grain held from all sides by z contacts adds up z/3 of what each gives along its normal and 2z/3 of what it
//! gives across; counted per effective mass the two factors are the same, since both bodies of a contact may move.
//! `tests/packed_step.rs` measures both sides of this on settled beds.

/// Contacts per grain of a settled bed that the rule counts with.
const CONTACTS: f64 = 6.0;

/// Part of the slip of a free pair that the dashpot of Coulomb's law takes in one step where none is given.
pub const RELAXED_PER_STEP: f64 = 0.125;

/// What a contact adds to the stability sum along its normal: h²/4 + 2 zeta h with h = omega dt.
#[must_use]
pub fn stability_share(h: f64, zeta: f64) -> f64 {
    h * (0.25 * h + 2.0 * zeta)
}

/// Largest stable step of a single damped oscillation: 2/omega (sqrt(1 + 4 zeta²) - 2 zeta), s.
///
/// `omega` angular frequency, 1/s; `zeta` fraction of critical damping.
#[must_use]
pub fn largest_stable_step(omega: f64, zeta: f64) -> f64 {
    step_of_share(omega, zeta, 1.0)
}

/// What acts across the normal of the contacts of a packed bed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Across {
    /// Nothing: smooth grains.
    Nothing,
    /// A dashpot that takes [`RELAXED_PER_STEP`] of the slip of a free pair, whatever the step.
    Coulomb,
    /// Springs and dashpots that move a free pair as fast as the normal ones.
    Springs,
}

/// Largest stable step of a packed bed whose smallest pair alone has angular frequency `omega` (1/s) and damping
/// ratio `zeta`, s: (z/3) along + (2z/3) across = 1 with z = 6.
#[must_use]
pub fn packed_step(omega: f64, zeta: f64, across: Across) -> f64 {
    let (along, other) = (CONTACTS / 3.0, 2.0 * CONTACTS / 3.0);
    let share = match across {
        Across::Nothing => 1.0 / along,
        Across::Coulomb => (1.0 - other * RELAXED_PER_STEP) / along,
        Across::Springs => 1.0 / (along + other),
    };
    step_of_share(omega, zeta, share)
}

/// Step at which the share of a contact is `share`, s.
fn step_of_share(omega: f64, zeta: f64, share: f64) -> f64 {
    2.0 / omega * ((share + 4.0 * zeta * zeta).sqrt() - 2.0 * zeta)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Amplitude after many steps of one oscillator, in the engine's order of operations; no further than the first
    /// that is beyond doubt.
    fn rings(zeta: f64, h: f64) -> f64 {
        let (mut x, mut half, mut v) = (1.0_f64, 0.0, 0.0);
        for _ in 0..4000 {
            if x.hypot(half) > 1e9 {
                break;
            }
            let a = -x - 2.0 * zeta * v;
            half += a * h;
            x += half * h;
            v = half + 0.5 * a * h;
        }
        x.hypot(half)
    }

    #[test]
    fn an_oscillator_grows_just_beyond_the_limit() {
        for zeta in [0.0, 0.03, 0.456, 1.0, 1.5] {
            let limit = largest_stable_step(1.0, zeta);
            // One percent off the limit the amplitude changes by at least 1.005 per step, over 4000 steps.
            assert!(rings(zeta, 0.99 * limit) < 20.0, "zeta {zeta}");
            assert!(rings(zeta, 1.01 * limit) > 1e6, "zeta {zeta}");
        }
    }

    #[test]
    fn the_step_of_a_share_has_that_share() {
        for (zeta, across, share) in
            [(0.456, Across::Nothing, 0.5), (0.456, Across::Coulomb, 0.25), (0.1, Across::Springs, 1.0 / 6.0)]
        {
            let h = packed_step(3.0, zeta, across) * 3.0;
            // Rounding of a square root and a difference.
            assert!((stability_share(h, zeta) - share).abs() < 1e-14);
        }
    }
}

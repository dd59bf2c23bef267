//! Wen and Yu's equation, for dilute suspensions.

use super::{BedLaw, Medium};

/// −dP/dz = 3/4 (1−φ) ρ C_d |V0| V0 φ^−3.65 / (φ d), C_d = (0.63 + 4.8/√Re)² (Clément eq. 2.71, 2.72).
///
/// The printed 2.71 has φ^−2.65: it lacks the factor 1/φ that turns the
/// exchange coefficient into the gradient of the whole bed (Clément eq. 2.54, 2.59).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WenYu;

impl BedLaw for WenYu {
    #[inline]
    fn coefficient(self, v0: f64, m: &Medium) -> f64 {
        0.75 * (1.0 - m.porosity) / (m.porosity * m.diameter) * drag(v0, m) * m.porosity.powf(-3.65)
    }
}

/// ρ C_d |V0| = (0.63 √(ρ|V0|) + 4.8 √(η/d))², kg/(m² s): finite at rest and
/// without fluid density, where C_d alone is not.
#[inline]
pub(super) fn drag(v0: f64, m: &Medium) -> f64 {
    let c = 0.63 * (m.density * v0.abs()).sqrt() + 4.8 * (m.viscosity / m.diameter).sqrt();
    c * c
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hand_value() {
        let m = Medium { porosity: 0.5, diameter: 1e-3, density: 1000.0, viscosity: 1e-3 };
        // Re 9: C_d = (0.63 + 1.6)² = 4.9729; V0 = 9e-3;
        // 0.75*0.5*1000*4.9729*8.1e-5/(0.5e-3) * 2^3.65 = 302.10 * 12.553; 4 digits by hand.
        let by_hand = 302.10 * 12.553;
        assert!((WenYu.gradient(9e-3, &m) / by_hand - 1.0).abs() < 1e-4);
    }
}

//! Ergun's equation: a viscous and an inertial part, for dense beds.

use super::darcy::viscous;
use super::{BedLaw, Medium};

/// −dP/dz = [150 η (1−φ)²/(d² φ³) + 1.75 ρ (1−φ)|V0|/(d φ³)] V0 (Clément eq. 2.70).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ergun;

/// The inertial part of Ergun with the Carman-Kozeny viscous part, 180 for 150 (Clément eq. 5.6).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErgunKozeny;

impl BedLaw for Ergun {
    #[inline]
    fn coefficient(self, v0: f64, m: &Medium) -> f64 {
        viscous(150.0, m) + inertial(v0, m)
    }
}

impl BedLaw for ErgunKozeny {
    #[inline]
    fn coefficient(self, v0: f64, m: &Medium) -> f64 {
        viscous(180.0, m) + inertial(v0, m)
    }
}

/// 1.75 ρ (1−φ) |V0| / (d φ³), Pa s/m².
#[inline]
fn inertial(v0: f64, m: &Medium) -> f64 {
    1.75 * m.density * (1.0 - m.porosity) * v0.abs() / (m.diameter * m.porosity.powi(3))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hand_values() {
        let m = Medium { porosity: 0.5, diameter: 1e-3, density: 1000.0, viscosity: 1e-3 };
        // Viscous 3.0e5 (Kozeny 3.6e5), inertial 1.75*1000*0.5*0.01/(1e-3*0.125) = 7.0e4; rounding only.
        assert!((Ergun.gradient(-0.01, &m) + 3.7e3).abs() < 1e-9);
        assert!((ErgunKozeny.gradient(0.01, &m) - 4.3e3).abs() < 1e-9);
    }
}

//! Darcy's law with the Carman-Kozeny permeability.

use super::{BedLaw, Medium};

/// −dP/dz = 180 η (1−φ)² V0 / (d² φ³) (Clément eq. 2.49).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Darcy;

impl BedLaw for Darcy {
    #[inline]
    fn coefficient(self, _v0: f64, m: &Medium) -> f64 {
        viscous(180.0, m)
    }
}

/// The linear part a η (1−φ)² / (d² φ³), Pa s/m².
#[inline]
pub(super) fn viscous(a: f64, m: &Medium) -> f64 {
    let s = 1.0 - m.porosity;
    a * m.viscosity * s * s / (m.diameter * m.diameter * m.porosity.powi(3))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hand_value() {
        let m = Medium { porosity: 0.5, diameter: 1e-3, density: 1000.0, viscosity: 1e-3 };
        // 180 * 1e-3 * 0.25 / (1e-6 * 0.125) = 3.6e5; rounding only.
        assert!((Darcy.gradient(0.01, &m) - 3.6e3).abs() < 1e-9);
    }
}

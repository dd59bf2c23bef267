//! Di Felice's equation, from dense to dilute.

use super::wen_yu::drag;
use super::{BedLaw, Medium};

/// −dP/dz = 3/4 (1−φ) ρ C_d |V0| V0 φ^−χ / (φ d), χ = 3.7 − 0.65 exp[−(1.5 − log₁₀Re)²/2] (Clément eq. 2.74, 2.75).
///
/// It is near Ergun when dense and near Wen-Yu when dilute, not equal to
/// either: over Re 0.01 to 1000 it is 0.71 to 0.99 times Ergun at φ 0.40 to
/// 0.50, and 0.87 to 1.01 times Wen-Yu at φ 0.80 to 0.99.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiFelice;

impl BedLaw for DiFelice {
    #[inline]
    fn coefficient(self, v0: f64, m: &Medium) -> f64 {
        let factor = 0.75 * (1.0 - m.porosity) / (m.porosity * m.diameter);
        factor * drag(v0, m) * m.porosity.powf(-exponent(m.reynolds(v0)))
    }
}

/// χ(Re) of Clément eq. 2.75; 3.7 at Re = 0.
#[inline]
fn exponent(reynolds: f64) -> f64 {
    let x = 1.5 - reynolds.log10();
    3.7 - 0.65 * (-0.5 * x * x).exp()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hand_values() {
        // At Re = 10^1.5 the exponential is 1; at rest log10 is −∞ and it is 0.
        assert!((exponent(10f64.powf(1.5)) - 3.05).abs() < 1e-12);
        assert_eq!(exponent(0.0), 3.7);
    }
}

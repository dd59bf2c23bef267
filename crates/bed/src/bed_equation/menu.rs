//! The bed equations a case may name.

use super::{BedLaw, Darcy, DiFelice, Ergun, ErgunKozeny, Medium, WenYu};
use brazilnut_base::menu::Entry;
use serde::{Deserialize, Serialize};

/// The choices of `bed_equation`, in the order of [`BedEquation::ALL`].
pub const MENU: &[Entry] = &[
    Entry {
        name: "darcy",
        summary: "Darcy's law with the Carman-Kozeny permeability: slow flow through a dense bed.",
        formula: "-dP/dz = 180 eta (1-phi)^2 V0 / (d^2 phi^3)",
        source: "Clément eq. 2.49",
    },
    Entry {
        name: "ergun",
        summary: "Ergun's viscous and inertial parts: dense beds, porosity below 0.8.",
        formula: "-dP/dz = [150 eta (1-phi)^2/(d^2 phi^3) + 1.75 rho (1-phi)|V0|/(d phi^3)] V0",
        source: "Clément eq. 2.70",
    },
    Entry {
        name: "ergun-kozeny",
        summary: "Ergun's inertial part on the Carman-Kozeny viscous part, as in the coupled columns.",
        formula: "-dP/dz = [180 eta (1-phi)^2/(d^2 phi^3) + 1.75 rho (1-phi)|V0|/(d phi^3)] V0",
        source: "Clément eq. 5.6",
    },
    Entry {
        name: "wen-yu",
        summary: "Wen and Yu: dilute suspensions, porosity above 0.8.",
        formula: "-dP/dz = 3/4 (1-phi) rho C_d |V0| V0 phi^-3.65/(phi d), C_d = (0.63 + 4.8/sqrt(Re))^2",
        source: "Clément eq. 2.71 with its missing factor 1/phi, 2.72",
    },
    Entry {
        name: "di-felice",
        summary: "Di Felice: one equation from dense to dilute.",
        formula: "-dP/dz = 3/4 (1-phi) rho C_d |V0| V0 phi^-chi/(phi d), chi = 3.7 - 0.65 exp[-(1.5 - log10 Re)^2/2]",
        source: "Clément eq. 2.74, 2.75",
    },
];

/// A bed equation chosen by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum BedEquation {
    /// `darcy`
    Darcy,
    /// `ergun`
    Ergun,
    /// `ergun-kozeny`
    ErgunKozeny,
    /// `wen-yu`
    WenYu,
    /// `di-felice`
    DiFelice,
}

/// Evaluates an expression with the law of a [`BedEquation`] bound to a name:
/// the one branch outside a loop that is generic in the law.
///
/// ```
/// use brazilnut_bed::{bed_equation::{BedEquation, BedLaw, Medium}, with_bed_law};
/// let m = Medium { porosity: 0.4, diameter: 1e-3, density: 1000.0, viscosity: 1e-3 };
/// let sum: f64 = with_bed_law!(BedEquation::Ergun, law => {
///     (0..10).map(|k| law.gradient(0.01 * f64::from(k), &m)).sum()
/// });
/// assert!(sum > 0.0); // Pa/m
/// ```
#[macro_export]
macro_rules! with_bed_law {
    ($equation:expr, $law:ident => $body:expr) => {
        match $equation {
            $crate::bed_equation::BedEquation::Darcy => {
                let $law = $crate::bed_equation::Darcy;
                $body
            }
            $crate::bed_equation::BedEquation::Ergun => {
                let $law = $crate::bed_equation::Ergun;
                $body
            }
            $crate::bed_equation::BedEquation::ErgunKozeny => {
                let $law = $crate::bed_equation::ErgunKozeny;
                $body
            }
            $crate::bed_equation::BedEquation::WenYu => {
                let $law = $crate::bed_equation::WenYu;
                $body
            }
            $crate::bed_equation::BedEquation::DiFelice => {
                let $law = $crate::bed_equation::DiFelice;
                $body
            }
        }
    };
}

impl BedEquation {
    /// Every choice, in the order of [`MENU`].
    pub const ALL: [Self; 5] = [Self::Darcy, Self::Ergun, Self::ErgunKozeny, Self::WenYu, Self::DiFelice];

    /// The equation called `name` in [`MENU`].
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        MENU.iter().position(|e| e.name == name).map(|k| Self::ALL[k])
    }

    /// Its name in [`MENU`].
    #[must_use]
    pub fn name(self) -> &'static str {
        MENU[Self::ALL.iter().position(|&e| e == self).unwrap_or(0)].name
    }

    /// −dP/dz, Pa/m, for the superficial velocity `v0`, m/s.
    #[must_use]
    pub fn gradient(self, v0: f64, medium: &Medium) -> f64 {
        BedLaw::gradient(self, v0, medium)
    }

    /// K = (−dP/dz)/V0, Pa s/m², finite at V0 = 0.
    #[must_use]
    pub fn coefficient(self, v0: f64, medium: &Medium) -> f64 {
        BedLaw::coefficient(self, v0, medium)
    }
}

impl BedLaw for BedEquation {
    fn coefficient(self, v0: f64, medium: &Medium) -> f64 {
        match self {
            Self::Darcy => Darcy.coefficient(v0, medium),
            Self::Ergun => Ergun.coefficient(v0, medium),
            Self::ErgunKozeny => ErgunKozeny.coefficient(v0, medium),
            Self::WenYu => WenYu.coefficient(v0, medium),
            Self::DiFelice => DiFelice.coefficient(v0, medium),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_lead_to_their_equation_and_back() {
        assert_eq!(MENU.len(), BedEquation::ALL.len());
        for e in BedEquation::ALL {
            assert_eq!(BedEquation::from_name(e.name()), Some(e));
        }
        assert_eq!(BedEquation::from_name("di-felice"), Some(BedEquation::DiFelice));
        assert_eq!(BedEquation::from_name("ergun-kozeny"), Some(BedEquation::ErgunKozeny));
        assert_eq!(BedEquation::from_name("wen-yu"), Some(BedEquation::WenYu));
        assert_eq!(BedEquation::from_name("forchheimer"), None);
    }
}

//! Bed equations: the pressure gradient that drives a fluid through a bed of spheres.
//!
//! Sign and meaning are the same for all: `gradient` is −dP/dz (Pa/m) of the
//! whole bed, without its hydrostatic part, for the superficial velocity
//! V0 = φ(v − u) (m/s), φ the porosity. A new equation is a file beside these
//! and one line in `menu.rs`; `suite.rs` then tests it.

mod darcy;
mod di_felice;
mod ergun;
pub mod menu;
#[cfg(test)]
mod suite;
mod wen_yu;

pub use darcy::Darcy;
pub use di_felice::DiFelice;
pub use ergun::{Ergun, ErgunKozeny};
pub use menu::BedEquation;
pub use wen_yu::WenYu;

use serde::{Deserialize, Serialize};

/// A bed of equal spheres and the fluid in it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Medium {
    /// Fluid fraction φ.
    pub porosity: f64,
    /// Diameter of the spheres d, m.
    pub diameter: f64,
    /// Density of the fluid ρ, kg/m³.
    pub density: f64,
    /// Dynamic viscosity of the fluid η, Pa s.
    pub viscosity: f64,
}

impl Medium {
    /// Particle Reynolds number ρ d |V0| / η (Clément eq. 2.73); 0 without density, even without viscosity.
    #[must_use]
    pub fn reynolds(&self, v0: f64) -> f64 {
        let inertia = self.density * self.diameter * v0.abs();
        if inertia == 0.0 { 0.0 } else { inertia / self.viscosity }
    }
}

/// One bed equation. Loops are generic in it; the choice is made once outside,
/// with [`with_bed_law!`](crate::with_bed_law).
pub trait BedLaw: Copy + Send + Sync {
    /// K(V0) = (−dP/dz) / V0, Pa s/m²; finite at V0 = 0, even in V0.
    fn coefficient(self, v0: f64, medium: &Medium) -> f64;

    /// −dP/dz = K(V0) V0, Pa/m.
    #[inline]
    fn gradient(self, v0: f64, medium: &Medium) -> f64 {
        self.coefficient(v0, medium) * v0
    }
}

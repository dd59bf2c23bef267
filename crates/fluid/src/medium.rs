//! What the fluid is told about solids that it cannot resolve.

use crate::field::Faces;
use crate::grid::Grid;

/// What fills the grid besides the fluid; the default is nothing.
#[derive(Clone, Debug, Default)]
pub struct Medium {
    /// Resistance against motion relative to the solids.
    pub resistance: Option<Resistance>,
    /// Porosity and motion of the solids, for the balance of volume.
    pub mixture: Option<Mixture>,
}

/// The term `-beta (v - u)` of Clément eq. 2.62.
#[derive(Clone, Debug)]
pub struct Resistance {
    /// beta on faces, 1/s.
    pub rate: Faces,
    /// Velocity u of the solids on faces, m/s.
    pub target: Faces,
}

/// The balance of volume `div(phi v + (1 - phi) u) = 0` (Clément eq. 2.63).
#[derive(Clone, Debug)]
pub struct Mixture {
    /// phi on faces.
    pub porosity: Faces,
    /// (1 - phi) u on faces, m/s.
    pub solids_flux: Faces,
}

impl Resistance {
    /// No resistance.
    #[must_use]
    pub fn none(grid: &Grid) -> Self {
        Self { rate: Faces::new(grid), target: Faces::new(grid) }
    }
}

impl Mixture {
    /// Fluid alone.
    #[must_use]
    pub fn clear(grid: &Grid) -> Self {
        let mut porosity = Faces::new(grid);
        porosity.set_all(1.0);
        Self { porosity, solids_flux: Faces::new(grid) }
    }
}

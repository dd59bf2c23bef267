//! What a case says about the coupling.

use crate::averaged::Averaged;
use crate::body::Body;
use crate::one_way::SimpleDrag;
use crate::resolved::lubrication::Lubrication;
use crate::resolved::{Forcing, Inertia, Layout, SpringBody, Springs};
use crate::transfer::KernelName;
use serde::{Deserialize, Serialize};

/// The rung and its numbers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum CouplingSpec {
    /// `dry`: no fluid.
    Dry,
    /// `simple-drag`
    SimpleDrag(SimpleDrag),
    /// `navier-stokes`
    Averaged(Averaged),
    /// `particle-template`, `fluid-springs`, `direct-forcing`
    Resolved(Resolved),
}

/// A coupling to a fluid that is resolved around every grain.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Resolved {
    /// How the fluid is held.
    pub method: Method,
    /// Kernel between tracers and faces.
    pub kernel: KernelName,
    /// How tracers fill a body.
    pub layout: Layout,
    /// How far the outermost shell lies below the surface, in spacings.
    pub retraction: f64,
    /// Films below the grid scale.
    pub lubrication: Option<Lubrication>,
    /// Density of the fluid, kg/m³.
    pub density: f64,
    /// Viscosity of the fluid, Pa s.
    pub viscosity: f64,
    /// Body of the grains.
    pub body: Body,
}

/// How a body holds the fluid.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Method {
    /// `particle-template`
    Template,
    /// `fluid-springs`
    Springs(Springs),
    /// `direct-forcing`
    Forcing(Forcing),
}

impl CouplingSpec {
    /// The name in the case file.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Dry => "dry",
            Self::SimpleDrag(_) => "simple-drag",
            Self::Averaged(_) => "navier-stokes",
            Self::Resolved(r) => match r.method {
                Method::Template => "particle-template",
                Method::Springs(_) => "fluid-springs",
                Method::Forcing(_) => "direct-forcing",
            },
        }
    }

    /// True if the rung moves a fluid on a grid.
    #[must_use]
    pub fn has_flow(&self) -> bool {
        matches!(self, Self::Averaged(_) | Self::Resolved(_))
    }

    /// True if the engine's grains leave out the mass of the fluid that they enclose.
    #[must_use]
    pub fn carries_template_mass(&self) -> bool {
        let Self::Resolved(Resolved { method: Method::Springs(s), .. }) = self else { return false };
        s.inertia == Inertia::Template
    }

    /// Mass and moment of inertia that the engine must be given for a grain of `mass` (kg),
    /// `inertia` (kg m²) and `radius` (m): contacts accelerate what stands in the equation of motion.
    ///
    /// The template's mass is not positive for grains no denser than the fluid: refuse those.
    #[must_use]
    pub fn carried(&self, mass: f64, inertia: f64, radius: f64) -> (f64, f64) {
        match self {
            Self::Resolved(r) if self.carries_template_mass() => {
                let fluid = r.density * r.body.volume(radius);
                (mass - fluid, inertia - fluid * r.body.gyration_squared(radius))
            }
            _ => (mass, inertia),
        }
    }
}

impl Resolved {
    /// A grain of full `mass` (kg) and `radius` (m) with `tracers` on a grid of cell volume `cell_volume` (m³).
    #[must_use]
    pub fn spring_body(&self, mass: f64, radius: f64, tracers: usize, cell_volume: f64) -> SpringBody {
        let fluid_mass = self.density * self.body.volume(radius);
        SpringBody {
            tracers,
            cell_mass: self.density * cell_volume,
            fluid_mass,
            template_mass: mass - fluid_mass,
        }
    }
}

//! `simple-drag`: the fluid pushes, the grains do not answer (Clément 2009, 2.4.1).
//!
//! The fluid is at rest in the cell. A grain feels the drag that a bed
//! equation gives for its own velocity, the buoyancy of the modified gravity,
//! gravity and the inertia of the frame:
//!
//! ```text
//! m du/dt = F_contacts + V_p (-grad P)(V0) / (1 - phi) + m g - m a - rho V_p (g - a)    (2.54, 2.57, 3.1-3.3)
//! ```

mod local;
mod menu;

pub use local::LocalPorosity;
pub use menu::{KEYS, SUPERFICIAL};

use crate::body::Body;
use crate::still::Still;
use brazilnut_base::{Tick, Vec3};
use brazilnut_bed::bed_equation::{BedEquation, BedLaw, Medium};
use brazilnut_bed::with_bed_law;
use brazilnut_grains::{Field, GrainAt, Grains, Push};
use serde::{Deserialize, Serialize};

/// What `simple-drag` needs to know.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SimpleDrag {
    /// The bed equation.
    pub equation: BedEquation,
    /// Fluid fraction.
    pub porosity: Porosity,
    /// What the bed equation takes for the superficial velocity.
    pub superficial: Superficial,
    /// Density of the fluid, kg/m³.
    pub density: f64,
    /// Viscosity of the fluid, Pa s.
    pub viscosity: f64,
    /// Mean diameter of each species, m.
    pub diameter: Vec<f64>,
    /// Body of the grains.
    pub body: Body,
}

/// Where the porosity comes from.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Porosity {
    /// The same everywhere, given.
    Fixed(f64),
    /// Mapped from the grains every `refresh` steps on cells of edge `spacing` (m).
    Local {
        /// Edge of the mapping cells, m.
        spacing: f64,
        /// Steps between two mappings.
        refresh: u64,
    },
}

/// Superficial velocity of a fluid at rest relative to a grain of velocity u.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Superficial {
    /// V0 = −u: no net flux through a section of the bed, as under a thrown plug.
    #[default]
    U,
    /// V0 = −phi u: the pore fluid is at rest.
    PhiU,
}

/// V_p K(|V0|) V0 / (1 − phi), N (Clément eq. 2.54), for the superficial velocity `v0` (m/s).
#[inline]
#[must_use]
pub fn bed_drag<L: BedLaw>(law: L, volume: f64, v0: Vec3, medium: &Medium) -> Vec3 {
    volume / (1.0 - medium.porosity) * law.coefficient(v0.length(), medium) * v0
}

/// −rho V_p g', N (Clément eq. 2.56 with g as a vector, 3.3).
#[inline]
#[must_use]
pub fn buoyancy(density: f64, volume: f64, modified_gravity: Vec3) -> Vec3 {
    -density * volume * modified_gravity
}

impl Superficial {
    /// The superficial velocity for a grain of velocity `u`, m/s.
    #[inline]
    #[must_use]
    pub fn of(self, u: Vec3, porosity: f64) -> Vec3 {
        match self {
            Self::U => -u,
            Self::PhiU => -porosity * u,
        }
    }
}

impl SimpleDrag {
    /// The map that a local porosity starts with; none where it is given.
    #[must_use]
    pub fn start(&self, cell: &brazilnut_base::Cell) -> Option<LocalPorosity> {
        match self.porosity {
            Porosity::Fixed(_) => None,
            Porosity::Local { spacing, .. } => Some(LocalPorosity::new(cell, spacing)),
        }
    }

    /// Maps the porosity anew if step `index` is one for it.
    pub fn refresh(&self, map: &mut Option<LocalPorosity>, grains: &Grains, index: u64) {
        if let (Porosity::Local { refresh, .. }, Some(map)) = (self.porosity, map)
            && index.is_multiple_of(refresh.max(1))
        {
            map.refresh(grains, self.body);
        }
    }

    /// The field with `law`, the law of [`Self::equation`], chosen once outside.
    #[must_use]
    pub fn field<'a, L: BedLaw>(
        &'a self,
        law: L,
        map: Option<&'a LocalPorosity>,
        still: Still,
    ) -> OneWay<'a, L> {
        OneWay { law, drag: self, map, still }
    }

    /// Drag on every grain without buoyancy, N, in the order of identity.
    ///
    /// Their sum over the base area is the base pressure of this rung: below zero while the bed rises.
    pub fn drag_forces(&self, map: Option<&LocalPorosity>, grains: &Grains, out: &mut Vec<Vec3>) {
        out.clear();
        let still = Still { gravity: Vec3::ZERO, frame: Vec3::ZERO };
        with_bed_law!(self.equation, law => {
            let field = self.field(law, map, still);
            out.extend((0..grains.len()).map(|k| {
                field.drag(grains.species[k], grains.radius[k], grains.position[k], grains.velocity[k])
            }));
        });
    }
}

/// What acts on a grain in a fluid at rest.
#[derive(Clone, Copy, Debug)]
pub struct OneWay<'a, L: BedLaw> {
    law: L,
    drag: &'a SimpleDrag,
    map: Option<&'a LocalPorosity>,
    still: Still,
}

impl<L: BedLaw> OneWay<'_, L> {
    /// Drag on a grain without buoyancy, N.
    #[inline]
    #[must_use]
    pub fn drag(&self, species: u16, radius: f64, position: Vec3, velocity: Vec3) -> Vec3 {
        let d = self.drag;
        let porosity = match (d.porosity, self.map) {
            (Porosity::Fixed(phi), _) => phi,
            (Porosity::Local { .. }, Some(map)) => map.at(position),
            (Porosity::Local { .. }, None) => 1.0 - LocalPorosity::LEAST_SOLIDS,
        };
        let diameter = d.diameter[species as usize];
        let medium = Medium { porosity, diameter, density: d.density, viscosity: d.viscosity };
        bed_drag(self.law, d.body.volume(radius), d.superficial.of(velocity, porosity), &medium)
    }
}

impl<L: BedLaw> Field for OneWay<'_, L> {
    #[inline]
    fn push(&self, _: &Tick, grain: &GrainAt) -> Push {
        let volume = self.drag.body.volume(grain.radius);
        let lift = buoyancy(self.drag.density, volume, self.still.modified_gravity());
        let drag = self.drag(grain.species, grain.radius, grain.position, grain.velocity);
        Push { fluid: drag + lift, ..self.still.body_forces(grain.mass) }
    }
}

#[cfg(test)]
mod tests;

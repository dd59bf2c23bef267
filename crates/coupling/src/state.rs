//! What a resumed run needs of the coupling.

use crate::averaged::AveragedReport;
use crate::load::Load;
use crate::one_way::LocalPorosity;
use crate::resolved::{Enclosed, Leak};
use brazilnut_base::Vec3;
use serde::{Deserialize, Serialize};

/// State of the coupling between two steps.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct CouplingState {
    /// Force and torque of the fluid on each grain in the last step, without hydrostatic buoyancy; by identity.
    pub loads: Vec<Load>,
    /// Momentum of the fluid in each body at the end of the last step; empty where the rung needs none.
    pub enclosed: Vec<Enclosed>,
    /// Slip that the coupling left.
    pub leak: Leak,
    /// Mean forces of the last step between fluid and grains.
    pub exchange: Exchange,
    /// `navier-stokes`: what the mapping found.
    pub averaged: AveragedReport,
    /// `particle-template`: force by stress against force by momentum.
    pub check: Check,
    /// `simple-drag`: the mapped porosity.
    pub porosity: Option<LocalPorosity>,
}

/// Forces between the phases in the last step, N.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Exchange {
    /// On the fluid, all tracers, covered faces or resisted faces together.
    pub on_fluid: Vec3,
    /// On the grains, less what the fluid that they enclose took up.
    pub on_grains: Vec3,
}

impl Exchange {
    /// What was lost on the way, N.
    #[must_use]
    pub fn residual(&self) -> Vec3 {
        self.on_fluid + self.on_grains
    }
}

/// Two ways to the same force, summed over grains and steps, N.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Check {
    /// Sum of the moduli of the differences.
    pub difference: f64,
    /// Sum of the moduli of the force by stress.
    pub force: f64,
}

impl Check {
    /// Mean difference over mean force.
    #[must_use]
    pub fn ratio(&self) -> f64 {
        if self.force > 0.0 { self.difference / self.force } else { 0.0 }
    }
}

//! What a run is made of: everything that does not change while it runs.

use crate::clock::Clock;
use brazilnut_base::motion::Motion;
use brazilnut_base::{Cell, Vec3};
use brazilnut_coupling::{CouplingSpec, SimpleDrag};
use brazilnut_fluid::FluidSpec;
use brazilnut_grains::{DemSpec, Grains, WallSpec};
use brazilnut_observe::Watch;

/// What the shaker moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shaken {
    /// The whole cell: computed in its frame (Clément 3.1).
    Cell,
    /// The floor alone, in the laboratory frame (Lan).
    Floor,
}

/// One species of grains, for observers and pictures.
#[derive(Clone, Debug, PartialEq)]
pub struct Species {
    /// Name in the case.
    pub name: String,
    /// Number of grains.
    pub count: usize,
    /// Mean diameter, m.
    pub diameter: f64,
}

/// When the bed counts as settled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Settle {
    /// It does not settle: time 0 is the start.
    None,
    /// For this time, s.
    For(f64),
    /// Until the root-mean-square speed has stayed below `speed` (m/s) for
    /// `calm` (s); an error after `limit` (s).
    UntilAtRest {
        /// m/s
        speed: f64,
        /// s
        calm: f64,
        /// s
        limit: f64,
    },
}

/// What surrounds the grains.
#[derive(Clone, Debug)]
pub enum Medium {
    /// Nothing.
    Dry,
    /// A fluid at rest that drags: one way.
    SimpleDrag(SimpleDrag),
    /// A flow that grains and fluid share.
    Coupled(Box<CouplingSpec>, Box<FluidSpec>),
    /// A flow without grains.
    Fluid(Box<FluidSpec>),
}

/// What happens when a guard is passed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// The run stops with the address.
    Stop,
    /// The run goes on with a warning.
    Warn,
}

/// Guards and when they look.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Guards {
    /// Steps between two looks.
    pub every: u64,
    /// What happens.
    pub action: Action,
    /// Largest mismatch of the energy ledger over the work put in.
    pub energy_residual: f64,
}

/// What a run is made of.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The cell.
    pub cell: Cell,
    /// Gravity, m/s².
    pub gravity: Vec3,
    /// The shaker.
    pub shaking: Motion,
    /// What it moves.
    pub shaken: Shaken,
    /// How time is cut.
    pub clock: Clock,
    /// How the bed settles before time 0.
    pub settle: Settle,
    /// The grain engine; its step is the clock's grain step.
    pub dem: DemSpec,
    /// Walls that go once the bed has settled; it settles once more without them.
    pub settling_walls: Vec<WallSpec>,
    /// The grains before the first step.
    pub start: Grains,
    /// The species, by index.
    pub species: Vec<Species>,
    /// What surrounds the grains.
    pub medium: Medium,
    /// What is measured.
    pub watches: Vec<Watch>,
    /// Guards.
    pub guards: Guards,
}

impl Plan {
    /// The fluid that is computed on a grid, if there is one.
    #[must_use]
    pub fn flow(&self) -> Option<&FluidSpec> {
        match &self.medium {
            Medium::Coupled(_, f) | Medium::Fluid(f) => Some(f),
            Medium::Dry | Medium::SimpleDrag(_) => None,
        }
    }

    /// Frequency of the shake, Hz, if anything shakes.
    #[must_use]
    pub fn frequency(&self) -> Option<f64> {
        self.shaking.frequency()
    }
}

//! All that changes while a run goes on: what a checkpoint holds.

use brazilnut_coupling::CouplingState;
use brazilnut_coupling::one_way::LocalPorosity;
use brazilnut_fluid::Flow;
use brazilnut_grains::{DemState, Ledger};
use brazilnut_observe::Watch;
use serde::{Deserialize, Serialize};

/// What the run is doing.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Stage {
    /// The bed comes to rest; steps count from the start of settling.
    Settling {
        /// Steps in a row during which the bed was at rest.
        calm: u64,
        /// The walls that stand only while the bed settles have gone; it settles once more without them.
        freed: bool,
    },
    /// Time runs from 0.
    Running,
}

/// The state of a run at a step boundary, samples of this boundary taken.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct State {
    /// What the run is doing.
    pub stage: Stage,
    /// Steps taken in this stage.
    pub step: u64,
    /// Steps that the settling took; while it goes on, those before the walls of settling went.
    pub settled_after: u64,
    /// The grains.
    pub dem: DemState,
    /// Porosity map of `simple-drag`, where it is local.
    pub porosity: Option<LocalPorosity>,
    /// The flow, where there is one.
    pub flow: Option<Flow>,
    /// What the coupling remembers, where grains and a flow are coupled.
    pub coupling: Option<CouplingState>,
    /// The energy ledger as it stood at time 0.
    pub before: Ledger,
    /// The observers with what they have gathered.
    pub watches: Vec<Watch>,
    /// Largest overlap over the smaller radius seen by the guards since time 0.
    pub largest_overlap: f64,
    /// Largest mismatch of the energy ledger over the work put in, seen by the guards since time 0.
    pub largest_residual: f64,
}

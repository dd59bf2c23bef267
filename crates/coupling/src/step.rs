//! One coupled step, as a list of calls.

use crate::coupling::Coupling;
use crate::state::CouplingState;
use crate::still::Still;
use brazilnut_base::motion::Motion;
use brazilnut_base::{Tick, Vec3};
use brazilnut_fluid::{Flow, Solver};
use brazilnut_grains::{Dem, DemState, Grains};

/// The grains' side: engine, state, and the picture that the coupling reads.
pub struct Beads<'a> {
    /// Engine.
    pub dem: &'a mut Dem,
    /// State.
    pub state: &'a mut DemState,
    /// Picture, filled anew in every step.
    pub grains: &'a mut Grains,
}

/// The fluid's side.
pub struct Stream<'a> {
    /// Solver.
    pub solver: &'a mut Solver,
    /// State.
    pub flow: &'a mut Flow,
}

/// One fluid step with `substeps` grain steps in it: for every rung with a flow.
///
/// `frame` is the motion of the cell's frame, zero where it is at rest.
pub fn step(
    coupling: &mut Coupling,
    state: &mut CouplingState,
    beads: &mut Beads<'_>,
    stream: &mut Stream<'_>,
    tick: Tick,
    substeps: u64,
    gravity: Vec3,
    frame: &Motion,
) {
    let still = |t: f64| Still { gravity, frame: frame.at(t).acceleration };
    beads.dem.export(beads.state, beads.grains);
    coupling.before_fluid(beads.grains, stream.flow, state);
    advance_fluid(coupling, beads.grains, stream, tick, still(tick.time).modified_gravity());
    coupling.after_fluid(beads.grains, stream.flow, state, tick.dt);
    for k in 0..substeps {
        let sub = tick.substep(k, substeps);
        if let Some(field) = coupling.held(state, still(sub.time)) {
            beads.dem.advance(beads.state, sub, &field);
        }
    }
}

fn advance_fluid(coupling: &mut Coupling, grains: &Grains, stream: &mut Stream<'_>, tick: Tick, body: Vec3) {
    let (mut during, medium) = coupling.parts();
    stream.solver.advance(stream.flow, tick, body, medium, |predicted| during.act(grains, predicted));
}

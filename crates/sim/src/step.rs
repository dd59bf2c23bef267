//! The step: pages of named calls.

use crate::plan::{Medium, Plan, Shaken};
use crate::state::State;
use brazilnut_base::motion::Motion;
use brazilnut_base::{Tick, Vec3};
use brazilnut_bed::with_bed_law;
use brazilnut_coupling::one_way::Porosity;
use brazilnut_coupling::step::{Beads, Stream, step as step_both};
use brazilnut_coupling::{Coupling, SimpleDrag, Still};
use brazilnut_fluid::Solver;
use brazilnut_grains::{Dem, Grains};

/// The engines of a run: their specifications and scratch.
pub(crate) struct Engines {
    /// The grains.
    pub dem: Dem,
    /// The fluid, where there is a flow.
    pub solver: Option<Solver>,
    /// What grains and flow hand each other; made at time 0, when sizes and places are known.
    pub coupling: Option<Coupling>,
}

/// Gravity and the acceleration of the frame at time `t`, m/s².
pub(crate) fn still(plan: &Plan, t: f64) -> Still {
    let frame = match plan.shaken {
        Shaken::Cell => plan.shaking.at(t).acceleration,
        Shaken::Floor => Vec3::ZERO,
    };
    Still { gravity: plan.gravity, frame }
}

/// One step of the run as its medium asks.
pub(crate) fn step(plan: &Plan, engines: &mut Engines, state: &mut State, grains: &mut Grains, tick: Tick) {
    match &plan.medium {
        Medium::Dry => dry(plan, &mut engines.dem, state, tick),
        Medium::SimpleDrag(drag) => simple_drag(plan, drag, &mut engines.dem, state, grains, tick),
        Medium::Coupled(..) => coupled(plan, engines, state, grains, tick),
        Medium::Fluid(_) => fluid(plan, engines, state, tick),
    }
}

/// Grains without a fluid.
pub(crate) fn dry(plan: &Plan, dem: &mut Dem, state: &mut State, tick: Tick) {
    for k in 0..plan.clock.substeps {
        let sub = tick.substep(k, plan.clock.substeps);
        dem.advance(&mut state.dem, sub, &still(plan, sub.time));
    }
}

/// Grains in a fluid at rest.
fn simple_drag(
    plan: &Plan,
    drag: &SimpleDrag,
    dem: &mut Dem,
    state: &mut State,
    grains: &mut Grains,
    tick: Tick,
) {
    if let Porosity::Local { refresh, .. } = drag.porosity
        && tick.index.is_multiple_of(refresh.max(1))
    {
        dem.export(&state.dem, grains);
        drag.refresh(&mut state.porosity, grains, tick.index);
    }
    with_bed_law!(drag.equation, law => {
        let field = drag.field(law, state.porosity.as_ref(), still(plan, tick.time));
        dem.advance(&mut state.dem, tick, &field);
    });
}

/// A flow without grains.
fn fluid(plan: &Plan, engines: &mut Engines, state: &mut State, tick: Tick) {
    let (Some(solver), Some(flow)) = (&mut engines.solver, &mut state.flow) else { return };
    let parts = solver.substeps(flow, tick.dt);
    for k in 0..parts {
        let part = tick.substep(k, parts);
        let body = still(plan, part.time).modified_gravity();
        solver.advance(flow, part, body, &brazilnut_fluid::Medium::default(), |_| ());
    }
}

/// Grains and flow.
fn coupled(plan: &Plan, engines: &mut Engines, state: &mut State, grains: &mut Grains, tick: Tick) {
    let Engines { dem, solver: Some(solver), coupling: Some(coupling) } = engines else { return };
    let (Some(flow), Some(shared)) = (&mut state.flow, &mut state.coupling) else { return };
    let at_rest = Motion::default();
    let frame = if plan.shaken == Shaken::Cell { &plan.shaking } else { &at_rest };
    let mut beads = Beads { dem, state: &mut state.dem, grains };
    let mut stream = Stream { solver, flow };
    let substeps = plan.clock.substeps;
    step_both(coupling, shared, &mut beads, &mut stream, tick, substeps, plan.gravity, frame);
}

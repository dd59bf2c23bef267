//! The step.

use crate::plan::{Medium, Plan, Shaken};
use crate::state::State;
use brazilnut_base::{Tick, Vec3};
use brazilnut_bed::with_bed_law;
use brazilnut_coupling::Still;
use brazilnut_coupling::one_way::Porosity;
use brazilnut_grains::{Dem, Grains};

/// Gravity and the acceleration of the frame at time `t`, m/s².
pub(crate) fn still(plan: &Plan, t: f64) -> Still {
    let frame = match plan.shaken {
        Shaken::Cell => plan.shaking.at(t).acceleration,
        Shaken::Floor => Vec3::ZERO,
    };
    Still { gravity: plan.gravity, frame }
}

/// One step of grains without a fluid.
pub(crate) fn dry(plan: &Plan, dem: &mut Dem, state: &mut State, tick: Tick) {
    for k in 0..plan.clock.substeps {
        let sub = tick.substep(k, plan.clock.substeps);
        dem.advance(&mut state.dem, sub, &still(plan, sub.time));
    }
}

/// One step of grains in a fluid at rest.
pub(crate) fn simple_drag(
    plan: &Plan,
    drag: &brazilnut_coupling::SimpleDrag,
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

/// One step of the run as its medium asks.
pub(crate) fn step(plan: &Plan, dem: &mut Dem, state: &mut State, grains: &mut Grains, tick: Tick) {
    match &plan.medium {
        Medium::Dry => dry(plan, dem, state, tick),
        Medium::SimpleDrag(drag) => simple_drag(plan, drag, dem, state, grains, tick),
    }
}

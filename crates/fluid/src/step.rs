//! One step, as a list of calls.

use crate::boundary::Boundary;
use crate::field::Faces;
use crate::flow::{Flow, Past};
use crate::general::close_ends;
use crate::ghosts;
use crate::inflow;
use crate::medium::Medium;
use crate::momentum::advection::Factors;
use crate::momentum::implicit::{prepare, smooth};
use crate::momentum::predict::{Recipe, predict};
use crate::project::{End, Projection};
use crate::solver::{Predicted, Solver};
use crate::spec::{Diffusion, FluidSpec, Scheme};
use brazilnut_base::{Side, Tick, Vec3};

/// Predict, let a coupling change the prediction, project.
pub(crate) fn advance(
    solver: &mut Solver,
    flow: &mut Flow,
    tick: Tick,
    body: Vec3,
    medium: &Medium,
    mut during: impl FnMut(&mut Predicted<'_>),
) {
    let recipe = recipe(solver, flow, tick, body);
    let general = solver.needs_general(medium);
    predict_velocity(solver, flow, tick, &recipe);
    if recipe.apart > 0.0 {
        diffuse(solver, flow, tick);
    }
    if general {
        around_solids(solver, flow, &recipe);
        resist(solver, medium, tick.dt);
    }
    during(&mut Predicted {
        grid: &solver.spec.grid,
        velocity: &mut solver.star,
        before: &flow.velocity,
        pressure: &flow.pressure,
        tick,
        density: solver.spec.density,
    });
    if general {
        project_general(solver, flow, tick, medium);
    } else {
        project(solver, flow, tick);
    }
    flow.body = absorbed(solver, body);
}

/// The part of `body` that the pressure balances: along directions with ends.
fn absorbed(solver: &Solver, mut body: Vec3) -> Vec3 {
    for axis in 0..3 {
        if solver.spec.grid.sides[axis] != Side::Walls {
            body[axis] = 0.0;
        }
    }
    body
}

fn recipe(solver: &Solver, flow: &Flow, tick: Tick, body: Vec3) -> Recipe {
    let (spec, shape) = (&solver.spec, &solver.shape);
    let nu = spec.kinematic_viscosity();
    let driving = body - absorbed(solver, body);
    let second = spec.scheme == Scheme::SecondOrder;
    let extrapolated = flow.past.as_ref().map_or(0.0, |past| 0.5 * tick.dt / past.dt);
    Recipe {
        advection: spec.advection,
        factors: shape.h.map(|h| Factors { advection: 0.25 / h, diffusion: nu / (h * h) }),
        body: [0, 1, 2].map(|l| if shape.side[l] == Side::Flat { 0.0 } else { driving[shape.axis[l]] }),
        weights: [tick.dt * (1.0 + extrapolated), tick.dt * extrapolated],
        pressure: shape.h.map(|h| if second { tick.dt / (spec.density * h) } else { 0.0 }),
        apart: if spec.diffusion == Diffusion::Implicit && nu > 0.0 { tick.dt } else { 0.0 },
        open_end: matches!(spec.side(shape.axis[0], 1), Some(Boundary::Outflow { .. })),
    }
}

fn predict_velocity(solver: &mut Solver, flow: &mut Flow, tick: Tick, recipe: &Recipe) {
    let order = solver.shape.axis;
    if solver.spec.scheme == Scheme::SecondOrder {
        let grid = &solver.spec.grid;
        flow.past.get_or_insert_with(|| Past { rate: Faces::new(grid), dt: tick.dt }).dt = tick.dt;
    }
    let past = flow.past.as_mut().map(|past| past.rate.in_order_mut(order));
    predict(
        solver.path,
        solver.poisson.parallel,
        &solver.shape,
        recipe,
        flow.velocity.in_order(order),
        &flow.pressure.values,
        solver.star.in_order_mut(order),
        past,
    );
}

/// Makes the diffusion in the prediction implicit.
fn diffuse(solver: &mut Solver, flow: &Flow, tick: Tick) {
    let (spec, shape) = (&solver.spec, &solver.shape);
    let jump = |component: usize, level: usize, end: usize| {
        let Boundary::MovingLid { motion, .. } = &spec.sides[shape.axis[level]][end] else { return 0.0 };
        (motion.at(tick.end()).velocity - motion.at(tick.time).velocity)[shape.axis[component]]
    };
    let a = 0.5 * spec.kinematic_viscosity() * tick.dt;
    prepare(&mut solver.systems, spec, shape, a, jump);
    let (v, star) = (flow.velocity.in_order(shape.axis), solver.star.in_order_mut(shape.axis));
    smooth(solver.path, solver.poisson.parallel, shape, &solver.systems, v, star);
}

fn project(solver: &mut Solver, flow: &mut Flow, tick: Tick) {
    let order = solver.shape.axis;
    let incremental = solver.spec.scheme == Scheme::SecondOrder;
    let table = ghosts::table(&solver.spec, &solver.shape, tick.end());
    let ends = ends(&solver.spec, &solver.inflow, incremental);
    let projection = Projection {
        path: solver.path,
        parallel: solver.poisson.parallel,
        shape: &solver.shape,
        poisson: &solver.poisson,
        ends: &ends,
        strength: solver.spec.density / tick.dt,
        incremental,
        ghosts: &table,
    };
    projection.gather(solver.star.in_order_mut(order), &mut solver.data);
    solver.poisson.middle(&mut solver.data);
    let velocity = flow.velocity.in_order_mut(order);
    let pressure = &mut flow.pressure.values;
    projection.scatter(solver.star.in_order(order), &mut solver.data, velocity, pressure, &mut solver.peaks);
    for level in 0..3 {
        let field = flow.velocity.component_mut(order[level]);
        table[level][2].fill_units(field, solver.shape.stride[2]);
    }
    table[3][2].fill_units(&mut flow.pressure.values, solver.shape.stride[2]);
}

/// Puts the surfaces of solids between the neighbours that they separate:
/// the value beyond is minus the one here, as at a sticking wall.
fn around_solids(solver: &mut Solver, flow: &mut Flow, recipe: &Recipe) {
    let order = solver.shape.axis;
    let Some(general) = &solver.general else { return };
    for link in &general.links {
        let axis = order[link.component];
        let v = flow.velocity.component(axis);
        let rate = -recipe.factors[link.level].diffusion * (v[link.here] + v[link.there]);
        solver.star.component_mut(axis)[link.here] += recipe.weights[0] * rate;
        if let Some(past) = &mut flow.past {
            past.rate.component_mut(axis)[link.here] += rate;
        }
    }
}

/// The implicit resistance of the medium: `v* <- m (v* + dt beta u)`.
fn resist(solver: &mut Solver, medium: &Medium, dt: f64) {
    let Some(general) = &mut solver.general else { return };
    general.set_mobility(medium.resistance.as_ref(), dt);
    let Some(resistance) = &medium.resistance else { return };
    for axis in 0..3 {
        let (beta, u) = (resistance.rate.component(axis), resistance.target.component(axis));
        let mobility = general.mobility.component(axis);
        let star = solver.star.component_mut(axis).iter_mut();
        for (((star, beta), u), m) in star.zip(beta).zip(u).zip(mobility) {
            *star = m * (*star + dt * beta * u);
        }
    }
}

/// The projection around obstacles or through a medium.
fn project_general(solver: &mut Solver, flow: &mut Flow, tick: Tick, medium: &Medium) {
    let order = solver.shape.axis;
    let incremental = solver.spec.scheme == Scheme::SecondOrder;
    let table = ghosts::table(&solver.spec, &solver.shape, tick.end());
    let held = ends(&solver.spec, &solver.inflow, incremental).map(|end| match end {
        End::Held(value) => Some(value),
        _ => None,
    });
    let Some(general) = &mut solver.general else { return };
    let shape = &solver.shape;
    for axis in 0..3 {
        let open = general.open.component(axis);
        for (star, open) in solver.star.component_mut(axis).iter_mut().zip(open) {
            *star *= open;
        }
    }
    inflow::impose(&solver.inflow, &solver.spec, shape, &mut solver.star);
    close_ends(shape, &mut solver.star);
    let strength = solver.spec.density / tick.dt;
    let guess = (!incremental).then_some(&flow.pressure);
    let star = solver.star.in_order(order);
    general.solve(shape, &solver.poisson, star, medium, strength, held, guess);
    let layers = if incremental { &general.change } else { &table[3] };
    ghosts::fill_field(&mut general.increment.values, shape, layers);
    general.correct(shape, star, strength, flow.velocity.in_order_mut(order));
    if incremental {
        for (p, q) in flow.pressure.values.iter_mut().zip(&general.increment.values) {
            *p += q;
        }
    } else {
        flow.pressure.values.copy_from_slice(&general.increment.values);
    }
    ghosts::fill(&mut flow.velocity, &mut flow.pressure, shape, &table);
    solver.watched = false;
}

/// What the projection meets at the ends of level 0.
fn ends<'a>(spec: &FluidSpec, inflow: &'a [Vec<f64>; 2], incremental: bool) -> [End<'a>; 2] {
    [0, 1].map(|end| match spec.side(spec.grid.line_axis, end) {
        None => End::Periodic,
        Some(Boundary::Outflow { pressure }) => End::Held(if incremental { 0.0 } else { *pressure }),
        Some(Boundary::Inflow { .. }) => End::Inflow(&inflow[end]),
        Some(_) => End::Closed,
    })
}

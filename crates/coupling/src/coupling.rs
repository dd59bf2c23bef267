//! One face for all rungs: before, during and after the fluid, and the field that the grains feel.

use crate::averaged::AveragedWork;
use crate::load::{Held, Load, hydrostatic_axes};
use crate::resolved::lubrication::Films;
use crate::resolved::sweep::Tally;
use crate::resolved::template::{Cover, Felt, exchanged};
use crate::resolved::{Enclosed, Forcing, Springs, TracerWork, forcing, tracers};
use crate::spec::{CouplingSpec, Method, Resolved};
use crate::state::{CouplingState, Exchange};
use crate::still::Still;
use brazilnut_base::{Cell, Side, Vec3};
use brazilnut_fluid::grid::GHOSTS;
use brazilnut_fluid::{Faces, Flow, Medium, Predicted, Scheme, Solver};
use brazilnut_grains::Grains;
use rayon::prelude::*;

/// A rung's tables and buffers; rebuilt from the case, not saved.
#[derive(Debug)]
pub struct Coupling {
    spec: CouplingSpec,
    cell: Cell,
    hydrostatic: Vec3,
    medium: Medium,
    rung: Rung,
}

/// What each kind of rung works with.
#[derive(Debug)]
enum Rung {
    /// Nothing to do around the fluid.
    Still,
    Averaged(Box<AveragedWork>),
    Resolved(Box<ResolvedWork>),
}

#[derive(Debug)]
struct ResolvedWork {
    holder: Holder,
    films: Option<Films>,
    /// What each grain gave to the fluid in the last step.
    given: Vec<Tally>,
    total: Tally,
    cell_volume: f64,
    /// Distance between tracers, m.
    spacing: f64,
    /// Loads of the step before.
    loads_before: Vec<Load>,
}

#[derive(Debug)]
enum Holder {
    Cover { cover: Cover, felt: Vec<Felt>, imposed: [Vec<Tally>; 3] },
    Springs { springs: Springs, work: Box<TracerWork>, grips: Vec<f64> },
    Forcing { forcing: Forcing, work: Box<TracerWork>, anticipate: bool },
}

impl Coupling {
    /// Prepares the rung of `spec` for the grains (identities, radii and species must not change after)
    /// and, where there is one, the fluid.
    #[must_use]
    pub fn new(spec: CouplingSpec, cell: Cell, solver: Option<&Solver>, grains: &Grains) -> Self {
        let mut medium = Medium::default();
        let rung = match (&spec, solver) {
            (CouplingSpec::Averaged(a), Some(s)) => {
                medium = AveragedWork::medium(s.grid());
                Rung::Averaged(Box::new(AveragedWork::new(a, s.grid(), &s.spec().solids)))
            }
            (CouplingSpec::Resolved(r), Some(s)) => {
                Rung::Resolved(Box::new(ResolvedWork::new(r, cell, s, grains)))
            }
            _ => Rung::Still,
        };
        let hydrostatic = if spec.has_flow() { hydrostatic_axes(cell.sides) } else { Vec3::ONE };
        Self { spec, cell, hydrostatic, medium, rung }
    }

    /// The rung.
    #[must_use]
    pub fn spec(&self) -> &CouplingSpec {
        &self.spec
    }

    /// What the fluid is told about the grains in the coming step.
    #[must_use]
    pub fn medium(&self) -> &Medium {
        &self.medium
    }

    /// Number of tracers, if the rung has any.
    #[must_use]
    pub fn tracers(&self) -> Option<&TracerWork> {
        let Rung::Resolved(r) = &self.rung else { return None };
        match &r.holder {
            Holder::Springs { work, .. } | Holder::Forcing { work, .. } => Some(work),
            Holder::Cover { .. } => None,
        }
    }

    /// The state at the start: no force yet.
    #[must_use]
    pub fn start(&self, grains: &Grains) -> CouplingState {
        let porosity = match &self.spec {
            CouplingSpec::SimpleDrag(d) => d.start(&self.cell),
            _ => None,
        };
        CouplingState { loads: vec![Load::default(); grains.len()], porosity, ..CouplingState::default() }
    }

    /// Maps what must be mapped for grains that have moved.
    pub fn before_fluid(&mut self, grains: &Grains, flow: &Flow, state: &mut CouplingState) {
        match (&self.spec, &mut self.rung) {
            (CouplingSpec::Averaged(spec), Rung::Averaged(work)) => {
                work.before_fluid(spec, grains, flow, &mut self.medium, &mut state.averaged);
            }
            (CouplingSpec::Resolved(spec), Rung::Resolved(work)) => {
                work.before_fluid(spec, grains, flow, state);
            }
            _ => {}
        }
    }

    /// The part of [`During::act`], and what the fluid is told: two borrows for one fluid step.
    pub fn parts(&mut self) -> (During<'_>, &Medium) {
        let resolved = match (&self.spec, &mut self.rung) {
            (CouplingSpec::Resolved(spec), Rung::Resolved(work)) => Some((spec, &mut **work)),
            _ => None,
        };
        (During { resolved }, &self.medium)
    }

    /// Forces on the grains from the flow at the end of its step of length `dt` (s).
    pub fn after_fluid(&mut self, grains: &Grains, flow: &Flow, state: &mut CouplingState, dt: f64) {
        match (&self.spec, &mut self.rung) {
            (CouplingSpec::Averaged(spec), Rung::Averaged(work)) => {
                work.after_fluid(spec, grains, flow, &self.medium, &mut state.loads, &mut state.averaged);
                let r = &state.averaged;
                state.exchange = Exchange { on_fluid: r.drag_on_fluid, on_grains: r.drag_on_grains };
            }
            (CouplingSpec::Resolved(spec), Rung::Resolved(work)) => {
                work.after_fluid(spec, grains, flow, state, dt);
            }
            _ => {}
        }
    }

    /// The field of a rung with a flow: loads held through the sub-steps.
    #[must_use]
    pub fn held<'a>(&self, state: &'a CouplingState, still: Still) -> Option<Held<'a>> {
        let (density, body) = match &self.spec {
            CouplingSpec::Averaged(a) => (a.density, a.body),
            CouplingSpec::Resolved(r) => (r.density, r.body),
            _ => return None,
        };
        Some(Held {
            still,
            loads: &state.loads,
            density,
            body,
            hydrostatic: self.hydrostatic,
            template_mass: self.spec.carries_template_mass(),
        })
    }
}

/// What may change the predicted velocity.
#[derive(Debug)]
pub struct During<'a> {
    resolved: Option<(&'a Resolved, &'a mut ResolvedWork)>,
}

impl During<'_> {
    /// Holds the fluid at the grains.
    pub fn act(&mut self, grains: &Grains, p: &mut Predicted<'_>) {
        if let Some((spec, work)) = &mut self.resolved {
            work.during_fluid(spec, grains, p);
        }
    }
}

impl ResolvedWork {
    fn new(spec: &Resolved, cell: Cell, solver: &Solver, grains: &Grains) -> Self {
        let grid = solver.grid();
        let work = || {
            let r = &grains.radius;
            Box::new(TracerWork::new(grid, spec.body, r, spec.layout, spec.retraction, spec.kernel))
        };
        let n = grains.len();
        let holder = match spec.method {
            Method::Template => Holder::Cover {
                cover: Cover::new(grid),
                felt: vec![Felt::default(); n],
                imposed: [0, 1, 2].map(|_| vec![Tally::default(); n]),
            },
            Method::Springs(springs) => Holder::Springs { springs, work: work(), grips: vec![0.0; n] },
            Method::Forcing(forcing) => {
                // A first-order prediction lacks the pressure; without it the slip removed would come back.
                let anticipate = solver.spec().scheme == Scheme::FirstOrder;
                Holder::Forcing { forcing, work: work(), anticipate }
            }
        };
        Self {
            holder,
            films: spec.lubrication.map(|law| Films::new(law, spec.viscosity, cell)),
            given: vec![Tally::default(); n],
            total: Tally::default(),
            cell_volume: grid.cell_volume(),
            spacing: tracers::spacing(grid),
            loads_before: vec![Load::default(); n],
        }
    }

    fn before_fluid(&mut self, spec: &Resolved, grains: &Grains, flow: &Flow, state: &mut CouplingState) {
        let unknown = state.enclosed.len() != grains.len();
        match &mut self.holder {
            Holder::Springs { work, .. } => work.sort(grains),
            Holder::Forcing { work, .. } => {
                work.sort(grains);
                if unknown {
                    work.look(grains, &flow.velocity);
                    enclosed(spec, grains, work, &mut state.enclosed);
                }
            }
            Holder::Cover { cover, felt, .. } => {
                if unknown {
                    cover.feel(grains, flow, spec.density, spec.viscosity, felt);
                    state.enclosed.clear();
                    state.enclosed.extend(felt.iter().map(|f| f.enclosed));
                }
            }
        }
    }

    fn during_fluid(&mut self, spec: &Resolved, grains: &Grains, p: &mut Predicted<'_>) {
        match &mut self.holder {
            Holder::Cover { cover, imposed, .. } => {
                cover.impose(grains, p.density, p.velocity, imposed);
                self.total = Tally::default();
                for (k, given) in self.given.iter_mut().enumerate() {
                    *given = Tally::default();
                    imposed.iter().for_each(|component| *given += component[k]);
                    self.total += *given;
                }
            }
            Holder::Springs { springs, work, grips } => {
                for (k, grip) in grips.iter_mut().enumerate() {
                    let tracers = work.templates.fit(k).0.points.len();
                    let r = grains.radius[k];
                    let full = match springs.inertia {
                        crate::resolved::Inertia::Template => {
                            grains.mass[k] + spec.density * spec.body.volume(r)
                        }
                        crate::resolved::Inertia::Full => grains.mass[k],
                    };
                    let body = spec.spring_body(full, r, tracers, self.cell_volume);
                    *grip = springs.grip(&body, p.tick.dt);
                }
                self.total = work.pull(grains, p.before, p.velocity, p.density, |k| grips[k]);
                self.given.copy_from_slice(&work.of_grain);
            }
            Holder::Forcing { forcing, work, anticipate } => {
                let pressure = p.tick.dt / p.density;
                if *anticipate {
                    push_by_pressure(p, -pressure);
                }
                self.total = work.force(grains, p.velocity, p.density, forcing.sweeps);
                if *anticipate {
                    push_by_pressure(p, pressure);
                }
                self.given.copy_from_slice(&work.of_grain);
            }
        }
    }

    fn after_fluid(
        &mut self,
        spec: &Resolved,
        grains: &Grains,
        flow: &Flow,
        state: &mut CouplingState,
        dt: f64,
    ) {
        state.exchange = Exchange { on_fluid: self.total.impulse / dt, on_grains: Vec3::ZERO };
        match &mut self.holder {
            Holder::Springs { .. } => {
                state.leak.book(&self.total);
                for (load, g) in state.loads.iter_mut().zip(&self.given) {
                    *load = Load { force: -g.impulse / dt, torque: -g.twist / dt };
                    state.exchange.on_grains += load.force;
                }
            }
            Holder::Forcing { work, .. } => {
                state.leak.book(&work.look(grains, &flow.velocity));
                self.loads_before.copy_from_slice(&state.loads);
                for k in 0..grains.len() {
                    let mass = spec.density * spec.body.volume(grains.radius[k]);
                    let after = Enclosed::of(&work.of_grain[k], mass);
                    let before = std::mem::replace(&mut state.enclosed[k], after);
                    state.loads[k] = forcing::load(&self.given[k], &before, &after, dt);
                    let taken_up = (after.momentum - before.momentum) / dt;
                    state.exchange.on_grains += state.loads[k].force - taken_up;
                }
            }
            Holder::Cover { cover, felt, .. } => {
                cover.feel(grains, flow, spec.density, spec.viscosity, felt);
                let mut slip = Tally::default();
                for k in 0..grains.len() {
                    let other = exchanged(&self.given[k], &state.enclosed[k], &felt[k], dt);
                    let taken_up = (felt[k].enclosed.momentum - state.enclosed[k].momentum) / dt;
                    state.enclosed[k] = felt[k].enclosed;
                    state.loads[k] = felt[k].stress;
                    state.check.difference += (other.force - felt[k].stress.force).length();
                    state.check.force += felt[k].stress.force.length();
                    state.exchange.on_grains += felt[k].stress.force - taken_up;
                    slip += felt[k].slip;
                }
                state.leak.book(&slip);
            }
        }
        let forced = matches!(self.holder, Holder::Forcing { .. });
        let spacing = self.spacing;
        // How far a grain's load follows new forces: light bodies of `direct-forcing` carry a virtual mass.
        let share = |k: usize| {
            let (r, displaced) = (grains.radius[k], spec.density * spec.body.volume(grains.radius[k]));
            if forced { forcing::following(spec.body, grains.mass[k] / displaced, r / spacing) } else { 1.0 }
        };
        if forced {
            for (k, load) in state.loads.iter_mut().enumerate() {
                *load = *load * share(k);
                *load += self.loads_before[k] * (1.0 - share(k));
            }
        }
        if let Some(films) = &mut self.films {
            films.add(grains, dt, &mut state.loads, share);
        }
    }
}

/// Momentum of the fluid in each body from what the tracers have just looked at.
fn enclosed(spec: &Resolved, grains: &Grains, work: &TracerWork, out: &mut Vec<Enclosed>) {
    out.clear();
    out.extend(
        work.of_grain
            .iter()
            .zip(&grains.radius)
            .map(|(mean, r)| Enclosed::of(mean, spec.density * spec.body.volume(*r))),
    );
}

/// Adds `factor` grad P to the predicted velocity on faces that are not on walls.
fn push_by_pressure(p: &mut Predicted<'_>, factor: f64) {
    let layout = p.grid.layout();
    let [line, middle, slow] = p.grid.memory_order();
    let plane = layout.stride[slow];
    for c in 0..3 {
        if p.grid.sides[c] == Side::Flat {
            continue;
        }
        let (stride, scale) = (layout.stride[c], factor / p.grid.spacing[c]);
        let mut range = p.grid.cell_range();
        if p.grid.sides[c] == Side::Walls {
            range[c].start = 1;
        }
        let values: &mut [f64] = Faces::component_mut(p.velocity, c);
        let pressure = &p.pressure.values;
        values.par_chunks_mut(plane).enumerate().for_each(|(level, values)| {
            if !range[slow].contains(&(level as isize - GHOSTS as isize)) {
                return;
            }
            for j in range[middle].clone() {
                let from = layout.origin % plane + (j * layout.stride[middle] as isize) as usize;
                let row = from + range[line].start as usize;
                let (behind, here) = (level * plane + row - stride, level * plane + row);
                let n = range[line].len();
                let (p0, p1) = (&pressure[behind..behind + n], &pressure[here..here + n]);
                for ((v, p0), p1) in values[row..row + n].iter_mut().zip(p0).zip(p1) {
                    *v += scale * (p1 - p0);
                }
            }
        });
    }
}

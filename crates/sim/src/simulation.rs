//! A run: its plan, its state, and the scratch of the engines.

use crate::flow_view::Seen;
use crate::plan::{Action, Medium, Plan, Settle, Shaken};
use crate::state::{Stage, State};
use crate::step::Engines;
use crate::{step, view};
use brazilnut_base::motion::Moved;
use brazilnut_base::parallel::sum;
use brazilnut_base::{Blowup, Cell, Tick, Vec3};
use brazilnut_coupling::one_way::LocalPorosity;
use brazilnut_coupling::{Coupling, CouplingSpec};
use brazilnut_fluid::{Flow, Solver};
use brazilnut_grains::{ContactView, Dem, DemSpec, Grains, Ledger, Partner, SpecError};
use brazilnut_observe::{ContactAt, FlowView, FluidAt, View, WallAt};

/// Whether there is more to do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ended {
    /// There is.
    No,
    /// The end of the plan is reached.
    Yes,
}

/// A run.
pub struct Simulation {
    plan: Plan,
    state: State,
    engines: Engines,
    scratch: Scratch,
}

/// What is rebuilt whenever it is needed.
#[derive(Default)]
struct Scratch {
    grains: Grains,
    contacts: Vec<ContactAt>,
    drag: Vec<Vec3>,
    /// Porosity that an averaged coupling's observers see.
    porosity: Option<LocalPorosity>,
    names: Vec<String>,
    warnings: Vec<String>,
}

impl Simulation {
    /// A run at its beginning.
    ///
    /// # Errors
    /// If the grain engine refuses its specification.
    pub fn new(plan: Plan) -> Result<Self, SpecError> {
        let settling = plan.settle != Settle::None;
        let stage = if settling {
            Stage::Settling { calm: 0, freed: plan.settling_walls.is_empty() }
        } else {
            Stage::Running
        };
        let mut dem = Dem::new(spec(&plan, stage))?;
        let solver = solver(&plan)?;
        let start = if settling { plan.start.clone() } else { carried(&plan, &plan.start) };
        let state = State {
            stage,
            step: 0,
            settled_after: 0,
            dem: dem.start(&start)?,
            porosity: match &plan.medium {
                Medium::SimpleDrag(d) => d.start(&plan.cell),
                _ => None,
            },
            flow: solver.as_ref().map(Solver::start),
            coupling: None,
            before: Ledger::default(),
            watches: plan.watches.clone(),
            largest_overlap: 0.0,
            largest_residual: 0.0,
        };
        let mut run = Self::assemble(plan, state, Engines { dem, solver, coupling: None });
        if !settling {
            run.couple();
        }
        Ok(run)
    }

    /// A run continued from `state`, which must come from the same plan.
    ///
    /// # Errors
    /// If the grain engine refuses its specification.
    pub fn resume(plan: Plan, state: State) -> Result<Self, SpecError> {
        let running = state.stage == Stage::Running;
        let dem = Dem::new(spec(&plan, state.stage))?;
        let solver = solver(&plan)?;
        let mut run = Self::assemble(plan, state, Engines { dem, solver, coupling: None });
        if running {
            run.couple();
        }
        Ok(run)
    }

    fn assemble(plan: Plan, state: State, engines: Engines) -> Self {
        let names = plan.species.iter().map(|s| s.name.clone()).collect();
        Self { plan, state, engines, scratch: Scratch { names, ..Scratch::default() } }
    }

    /// Prepares the coupling for the grains as they are; a resumed run keeps its state.
    fn couple(&mut self) {
        if let Medium::Coupled(spec, _) = &self.plan.medium {
            let Engines { dem, solver, coupling } = &mut self.engines;
            dem.export(&self.state.dem, &mut self.scratch.grains);
            let made = Coupling::new((**spec).clone(), self.plan.cell, solver.as_ref(), &self.scratch.grains);
            if self.state.coupling.is_none() {
                self.state.coupling = Some(made.start(&self.scratch.grains));
            }
            *coupling = Some(made);
        }
    }

    /// The plan.
    #[must_use]
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// The state.
    #[must_use]
    pub fn state(&self) -> &State {
        &self.state
    }

    /// The step boundary that the state stands at; before time 0 while settling.
    #[must_use]
    pub fn tick(&self) -> Tick {
        let tick = self.plan.clock.tick(self.state.step);
        match self.state.stage {
            Stage::Running => tick,
            // The shaker is at rest before time 0, however long settling takes.
            Stage::Settling { .. } => Tick { time: -1.0, ..tick },
        }
    }

    /// Whether the plan is carried out.
    #[must_use]
    pub fn ended(&self) -> Ended {
        let done = self.state.stage == Stage::Running && self.state.step >= self.plan.clock.end;
        if done { Ended::Yes } else { Ended::No }
    }

    /// One step; the guards look now and then. The end of settling is the
    /// boundary before step 0 of the run.
    ///
    /// # Errors
    /// The address of a blow-up, or that the bed does not come to rest.
    pub fn step(&mut self) -> Result<(), Blowup> {
        let tick = self.tick();
        match self.state.stage {
            Stage::Settling { .. } => step::dry(&self.plan, &mut self.engines.dem, &mut self.state, tick),
            Stage::Running => {
                step::step(&self.plan, &mut self.engines, &mut self.state, &mut self.scratch.grains, tick);
            }
        }
        self.state.step += 1;
        if self.state.step.is_multiple_of(self.plan.guards.every) {
            self.guard()?;
        }
        if let Stage::Settling { calm, freed } = self.state.stage {
            self.settle(calm, freed)?;
        }
        Ok(())
    }

    /// Counts calm steps; once there are enough, takes away the walls of settling or starts the run.
    fn settle(&mut self, calm: u64, freed: bool) -> Result<(), Blowup> {
        let dt = self.plan.clock.dt;
        let settled_for = self.state.step as f64 * dt;
        let done = match self.plan.settle {
            Settle::None => true,
            Settle::For(time) => settled_for >= time,
            Settle::UntilAtRest { speed, calm: needed, limit } => {
                // Looking costs a pass over all grains: every few steps is often enough.
                const STRIDE: u64 = 16;
                if !self.state.step.is_multiple_of(STRIDE) {
                    return Ok(());
                }
                let v = self.rms_speed();
                let calm = if v < speed { calm + STRIDE } else { 0 };
                self.state.stage = Stage::Settling { calm, freed };
                if settled_for > limit {
                    return Err(Blowup {
                        tick: self.tick(),
                        quantity: format!(
                            "the bed does not come to rest: rms speed {v:.2e} m/s after {limit} s"
                        ),
                        place: "all grains".into(),
                        remedy: "raise `time.rest_speed` or `time.settle_limit`, or set `time.settle`".into(),
                    });
                }
                calm as f64 * dt >= needed
            }
        };
        match (done, freed) {
            (false, _) => Ok(()),
            (true, false) => self.free(),
            (true, true) => self.begin(),
        }
    }

    /// Takes away the walls of settling: the bed spreads, and settles once more.
    fn free(&mut self) -> Result<(), Blowup> {
        self.guard()?;
        self.state.settled_after = self.state.step;
        self.state.step = 0;
        self.state.stage = Stage::Settling { calm: 0, freed: true };
        self.restart(|_, grains| grains.clone())
    }

    /// The grain engine anew with the walls of this stage and the grains that `change` makes of them.
    fn restart(&mut self, change: impl Fn(&Plan, &Grains) -> Grains) -> Result<(), Blowup> {
        self.engines.dem.export(&self.state.dem, &mut self.scratch.grains);
        let refused = |e: SpecError| Blowup {
            tick: self.plan.clock.tick(0),
            quantity: e.to_string(),
            place: "the grains after settling".into(),
            remedy: "check the obstacles".into(),
        };
        self.engines.dem = Dem::new(spec(&self.plan, self.state.stage)).map_err(refused)?;
        let grains = change(&self.plan, &self.scratch.grains);
        self.state.dem = self.engines.dem.start(&grains).map_err(refused)?;
        Ok(())
    }

    /// Time 0: the ledger starts, and grains leave to the fluid what it carries of them.
    fn begin(&mut self) -> Result<(), Blowup> {
        self.guard()?;
        self.state.settled_after += self.state.step;
        self.state.stage = Stage::Running;
        if matches!(&self.plan.medium, Medium::Coupled(c, _) if c.carries_template_mass()) {
            self.restart(carried)?;
        }
        self.couple();
        self.state.before = self.engines.dem.ledger(&self.state.dem);
        self.state.step = 0;
        self.state.largest_overlap = 0.0;
        self.state.largest_residual = 0.0;
        Ok(())
    }

    /// Looks whether the state still means anything.
    fn guard(&mut self) -> Result<(), Blowup> {
        let tick = self.tick();
        let dem = &self.engines.dem;
        let mut health = dem.health(&self.state.dem, tick);
        if let (Some(solver), Some(flow)) = (&self.engines.solver, &self.state.flow) {
            health = health.and(solver.health(flow, tick));
        }
        let mut overlap = self.state.largest_overlap;
        dem.contacts(&self.state.dem, |c| overlap = overlap.max(c.relative_overlap));
        self.state.largest_overlap = overlap;
        let ledger = self.ledger();
        let residual = ledger.residual().abs() / ledger.supplied().max(f64::MIN_POSITIVE);
        let running = self.state.stage == Stage::Running;
        // The mismatch is a fraction of nothing until a cycle's worth of work has been put in.
        let counts = running && self.plan.clock.steps_per_cycle.is_none_or(|n| self.state.step >= n);
        if counts {
            self.state.largest_residual = self.state.largest_residual.max(residual);
        }
        let energy = if counts && residual > self.plan.guards.energy_residual {
            Err(Blowup {
                tick,
                quantity: format!(
                    "energy residual {:.2} % of the work put in (limit {:.2} %)",
                    100.0 * residual,
                    100.0 * self.plan.guards.energy_residual
                ),
                place: "the whole bed".into(),
                remedy: "raise `time.steps_per_contact`, or `limits.energy_residual`".into(),
            })
        } else {
            Ok(())
        };
        match (health.and(energy), self.plan.guards.action) {
            (Err(b), Action::Warn) if ledger.residual().is_finite() => {
                let text = b.to_string();
                // Once per kind: the first words name the quantity.
                let kind = b.quantity.split_whitespace().next().unwrap_or_default().to_string();
                if !self.scratch.warnings.iter().any(|w| w.contains(&kind)) {
                    self.scratch.warnings.push(text);
                }
                Ok(())
            }
            (result, _) => result,
        }
    }

    /// Warnings of the guards so far.
    #[must_use]
    pub fn warnings(&self) -> &[String] {
        &self.scratch.warnings
    }

    /// Whether an observer is due at this boundary.
    #[must_use]
    pub fn is_sample_due(&self) -> bool {
        let tick = self.tick();
        self.state.stage == Stage::Running && self.state.watches.iter().any(|w| w.is_due(&tick))
    }

    /// Lets the observers that are due at this boundary look; `row` takes
    /// the index of the observer and its row.
    ///
    /// # Errors
    /// Whatever `row` returns.
    pub fn sample<E>(&mut self, mut row: impl FnMut(usize, &[f64]) -> Result<(), E>) -> Result<(), E> {
        if !self.is_sample_due() {
            return Ok(());
        }
        let tick = self.tick();
        let needs = self
            .state
            .watches
            .iter()
            .filter(|w| w.is_due(&tick))
            .fold(brazilnut_observe::Needs::default(), |n, w| n.or(w.needs()));
        let Self { plan, state, engines: Engines { dem, solver, .. }, scratch } = self;
        let State { dem: grains, watches, porosity, before, flow, coupling, .. } = state;
        dem.export(grains, &mut scratch.grains);
        scratch.contacts.clear();
        if needs.contacts {
            dem.contacts(grains, |c| scratch.contacts.push(contact(c, &scratch.grains, &plan.cell)));
        }
        match (&plan.medium, &*coupling) {
            (Medium::SimpleDrag(d), _) => {
                d.drag_forces(porosity.as_ref(), &scratch.grains, &mut scratch.drag)
            }
            (_, Some(c)) => {
                scratch.drag.clear();
                scratch.drag.extend(c.loads.iter().map(|l| l.force));
            }
            _ => {}
        }
        if needs.flow {
            map_porosity(plan, solver.as_ref(), &scratch.grains, &mut scratch.porosity);
        }
        let porosity = porosity.as_ref().or(scratch.porosity.as_ref());
        let seen = seen(plan, solver.as_ref(), flow.as_ref(), porosity, tick.time);
        let ledger = view::ledger(&view::since(&dem.ledger(grains), before));
        let walls: Vec<WallAt> = plan
            .dem
            .walls
            .iter()
            .zip(grains.wall_loads())
            .map(|(w, load)| WallAt {
                name: &w.name,
                force: load.force,
                displacement: w.motion.at(tick.time).displacement,
            })
            .collect();
        let moved = plan.shaking.at(tick.time);
        let (frame, floor) = match plan.shaken {
            Shaken::Cell => (moved, Moved::default()),
            Shaken::Floor => (Moved::default(), moved),
        };
        let (density, viscosity) = match &plan.medium {
            Medium::SimpleDrag(d) => (d.density, d.viscosity),
            Medium::Coupled(_, f) | Medium::Fluid(f) => (f.density, f.viscosity),
            Medium::Dry => (0.0, 0.0),
        };
        let fluid = (!matches!(plan.medium, Medium::Dry)).then(|| FluidAt {
            density,
            viscosity,
            flow: seen.as_ref().map(|s| s as &dyn FlowView),
            drag: &scratch.drag,
        });
        let view = View {
            tick,
            cycle: tick.time * plan.frequency().unwrap_or(0.0),
            frequency: plan.frequency(),
            cell: &plan.cell,
            grains: &scratch.grains,
            contacts: &scratch.contacts,
            walls: &walls,
            ledger: &ledger,
            collisions: grains.collisions(),
            fluid,
            frame,
            floor,
            gravity: plan.gravity,
            species: &scratch.names,
        };
        for (k, watch) in watches.iter_mut().enumerate() {
            if watch.is_due(&tick)
                && let Some(values) = watch.observe(&view)
            {
                row(k, &values)?;
            }
        }
        Ok(())
    }

    /// The grains now, for pictures and frames.
    pub fn grains(&mut self) -> &Grains {
        self.engines.dem.export(&self.state.dem, &mut self.scratch.grains);
        &self.scratch.grains
    }

    /// The grains and, where there is one, the flow now: for pictures and frames.
    pub fn look(&mut self) -> (&Grains, Option<impl FlowView + '_>) {
        let time = self.tick().time;
        let Self { plan, state, engines: Engines { dem, solver, .. }, scratch } = self;
        dem.export(&state.dem, &mut scratch.grains);
        map_porosity(plan, solver.as_ref(), &scratch.grains, &mut scratch.porosity);
        let porosity = state.porosity.as_ref().or(scratch.porosity.as_ref());
        (&scratch.grains, seen(plan, solver.as_ref(), state.flow.as_ref(), porosity, time))
    }

    /// The energy ledger since time 0 (since the start while settling).
    #[must_use]
    pub fn ledger(&self) -> Ledger {
        view::since(&self.engines.dem.ledger(&self.state.dem), &self.state.before)
    }

    /// Root-mean-square speed of the grains, m/s.
    fn rms_speed(&mut self) -> f64 {
        let grains = self.grains();
        let sum = sum(grains.velocity.iter().map(|v| v.length_squared()));
        (sum / grains.len().max(1) as f64).sqrt()
    }
}

/// The flow as observers see it.
fn seen<'a>(
    plan: &Plan,
    solver: Option<&'a Solver>,
    flow: Option<&'a Flow>,
    porosity: Option<&'a LocalPorosity>,
    time: f64,
) -> Option<Seen<'a>> {
    let resolved = is_resolved(plan);
    let (flow, solver) = (flow?, solver?);
    let body = step::still(plan, time).modified_gravity();
    let shared = matches!(plan.medium, Medium::Coupled(..));
    Some(Seen { flow, grid: solver.grid(), solver, body, shared, resolved, porosity })
}

/// A contact of the engine as observers see it.
fn contact(c: &ContactView, grains: &Grains, cell: &Cell) -> ContactAt {
    let centre = grains.position[c.first];
    let (with, branch) = match c.second {
        Partner::Grain(j) => {
            (brazilnut_observe::Partner::Grain(j as u32), cell.nearest(grains.position[j] - centre))
        }
        Partner::Wall(w) => (brazilnut_observe::Partner::Wall(w as u32), cell.nearest(c.point - centre)),
    };
    ContactAt { i: c.first as u32, with, overlap: c.overlap, force: c.force, branch }
}

/// The fluid solver, where the plan has a flow.
fn solver(plan: &Plan) -> Result<Option<Solver>, SpecError> {
    plan.flow()
        .map(|f| Solver::new(f.clone()).map_err(|e| SpecError::new("fluid", e.to_string())))
        .transpose()
}

/// True where grains are larger than the cells of the fluid's grid.
fn is_resolved(plan: &Plan) -> bool {
    matches!(&plan.medium, Medium::Coupled(c, _) if !matches!(**c, CouplingSpec::Averaged(_)))
}

/// Maps the grains of an averaged coupling onto the cells of the fluid's grid, for observers.
fn map_porosity(plan: &Plan, solver: Option<&Solver>, grains: &Grains, map: &mut Option<LocalPorosity>) {
    let (Medium::Coupled(spec, _), Some(solver)) = (&plan.medium, solver) else { return };
    if let CouplingSpec::Averaged(averaged) = &**spec {
        map.get_or_insert_with(|| LocalPorosity::on_cells(&plan.cell, solver.grid().cells))
            .refresh(grains, averaged.body);
    }
}

/// The grains with the mass that the coupling leaves to the engine.
fn carried(plan: &Plan, grains: &Grains) -> Grains {
    let mut grains = grains.clone();
    if let Medium::Coupled(spec, _) = &plan.medium {
        for k in 0..grains.len() {
            let (m, i) = spec.carried(grains.mass[k], grains.inertia[k], grains.radius[k]);
            (grains.mass[k], grains.inertia[k]) = (m, i);
        }
    }
    grains
}

/// The engine's specification: while the bed settles for the first time, with the walls of settling.
fn spec(plan: &Plan, stage: Stage) -> DemSpec {
    let mut spec = plan.dem.clone();
    if matches!(stage, Stage::Settling { freed: false, .. }) {
        spec.walls.extend(plan.settling_walls.iter().cloned());
    }
    spec
}

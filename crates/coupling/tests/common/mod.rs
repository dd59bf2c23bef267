//! A box of fluid with a few grains that do not touch.
#![allow(dead_code, reason = "each test file uses its part")]

use brazilnut_base::{Cell, Side, Tick, Vec3};
use brazilnut_coupling::resolved::lubrication::Lubrication;
use brazilnut_coupling::resolved::{Forcing, Inertia, Layout, RETRACTION, Springs, Strength};
use brazilnut_coupling::transfer::KernelName;
use brazilnut_coupling::{Body, Coupling, CouplingSpec, CouplingState, Held, Method, Resolved, Still};
use brazilnut_fluid::{Advection, Boundary, Faces, Flow, FluidSpec, Grid, Profile, Scheme, Solver};
use brazilnut_grains::contact::{NormalLaw, RollingLaw, TangentialLaw};
use brazilnut_grains::{
    ContactSpec, Dem, DemSpec, DemState, Grains, Integrator, Limits, Material, PairSpec, PairTable, Search,
};

pub const RHO: f64 = 1000.0;
pub const ETA: f64 = 1e-3;
pub const NU: f64 = ETA / RHO;

/// What to build.
#[derive(Clone)]
pub struct Plan {
    pub cells: [usize; 3],
    pub spacing: f64,
    pub sides: [Side; 3],
    /// nu dt / h²
    pub viscous: f64,
    pub scheme: Scheme,
    pub advection: Advection,
    pub method: Method,
    pub rotation: bool,
    pub substeps: u64,
    /// Speed at which fluid enters at low x and leaves at high x, between slippery sides, m/s.
    pub stream: Option<f64>,
    pub lubrication: Option<Lubrication>,
}

impl Plan {
    pub fn cube(n: usize, method: Method) -> Self {
        Self {
            cells: [n; 3],
            spacing: 1e-4,
            sides: [Side::Periodic; 3],
            viscous: 0.02,
            scheme: Scheme::SecondOrder,
            advection: Advection::Central,
            method,
            rotation: true,
            substeps: 1,
            stream: None,
            lubrication: None,
        }
    }

    pub fn dt(&self) -> f64 {
        self.viscous * self.spacing * self.spacing / NU
    }
}

pub fn forcing() -> Method {
    Method::Forcing(Forcing { sweeps: 3 })
}

/// Springs that take the part `alpha` of the slip in a step of `plan`.
pub fn springs(alpha: f64, dt: f64) -> Method {
    let strength = Strength::RelaxationTime(dt / alpha);
    Method::Springs(Springs { strength, damping: 0.0, inertia: Inertia::Template })
}

pub fn springs_for(plan: &Plan, alpha: f64) -> Plan {
    Plan { method: springs(alpha, plan.dt()), ..plan.clone() }
}

pub struct Rig {
    pub plan: Plan,
    pub cell: Cell,
    pub coupling: Coupling,
    pub state: CouplingState,
    pub dem: Dem,
    pub beads: DemState,
    pub grains: Grains,
    pub solver: Solver,
    pub flow: Flow,
    pub index: u64,
    /// 1 along axes whose pressure carries gravity; by default those with walls.
    pub hydrostatic: Option<Vec3>,
}

/// Grains: centre (m), radius (m), density over that of the fluid.
pub fn rig(plan: Plan, bodies: &[(Vec3, f64, f64)]) -> Rig {
    let grid = Grid::new(plan.cells, [plan.spacing; 3], plan.sides);
    let cell = Cell { size: grid.size(), sides: plan.sides };
    let body = match cell.flat_axis() {
        Some(a) => Body::Cylinder { length: cell.size[a] },
        None => Body::Sphere,
    };
    let mut fluid = FluidSpec::new(grid, RHO, ETA);
    fluid.scheme = plan.scheme;
    fluid.advection = plan.advection;
    if let Some(speed) = plan.stream {
        fluid.sides = std::array::from_fn(|_| [Boundary::FreeSlip, Boundary::FreeSlip]);
        let profile = Profile::Uniform(speed);
        fluid.sides[0] = [Boundary::Inflow { profile }, Boundary::Outflow { pressure: 0.0 }];
    }
    let solver = Solver::new(fluid).unwrap();
    let lattice = !matches!(plan.method, Method::Forcing(_));
    let spec = CouplingSpec::Resolved(Resolved {
        method: plan.method,
        kernel: KernelName::Trilinear,
        layout: if lattice { Layout::Lattice } else { Layout::Shells },
        retraction: RETRACTION,
        lubrication: plan.lubrication,
        density: RHO,
        viscosity: ETA,
        body,
    });
    let mut grains = Grains::default();
    for &(x, r, ratio) in bodies {
        let full = ratio * RHO * body.volume(r);
        let (m, i) = spec.carried(full, full * body.gyration_squared(r), r);
        grains.push(0, 0, r, m, i, x);
    }
    let coupling = Coupling::new(spec, cell, Some(&solver), &grains);
    let mut dem = Dem::new(DemSpec {
        cell,
        materials: vec![Material { name: "any".into(), density: RHO, elastic: None }],
        contact: ContactSpec {
            normal: NormalLaw::Linear,
            tangential: TangentialLaw::None,
            rolling: RollingLaw::None,
            pairs: PairTable::uniform(1, PairSpec { stiffness: Some(1.0), ..PairSpec::default() }),
        },
        walls: vec![],
        integrator: Integrator::VelocityVerlet,
        rotation: plan.rotation,
        dt: plan.dt() / plan.substeps as f64,
        limits: Limits::default(),
        search: Search::default(),
    })
    .unwrap();
    let beads = dem.start(&grains).unwrap();
    let state = coupling.start(&grains);
    let mut flow = solver.start();
    if let Some(speed) = plan.stream {
        flow.velocity.component_mut(0).fill(speed);
        solver.refresh(&mut flow, 0.0);
    }
    Rig { cell, coupling, state, dem, beads, grains, solver, flow, index: 0, hydrostatic: None, plan }
}

impl Rig {
    /// Sets the velocity of every grain before the first step.
    pub fn launch(&mut self, u: Vec3, w: Vec3) {
        self.grains.velocity.fill(u);
        self.grains.angular_velocity.fill(w);
        self.beads = self.dem.start(&self.grains).unwrap();
    }

    /// Grains stay where they are: the fluid alone.
    pub fn fluid_step(&mut self, body: Vec3) {
        let tick = Tick::at(self.index, self.plan.dt());
        self.coupling.before_fluid(&self.grains, &self.flow, &mut self.state);
        let (mut during, medium) = self.coupling.parts();
        let grains = &self.grains;
        self.solver.advance(&mut self.flow, tick, body, medium, |p| during.act(grains, p));
        self.coupling.after_fluid(&self.grains, &self.flow, &mut self.state, tick.dt);
    }

    pub fn step(&mut self, gravity: Vec3, frame: Vec3, body: Vec3) {
        self.dem.export(&self.beads, &mut self.grains);
        self.fluid_step(body);
        let tick = Tick::at(self.index, self.plan.dt());
        for k in 0..self.plan.substeps {
            let sub = tick.substep(k, self.plan.substeps);
            let mut field: Held<'_> = self.coupling.held(&self.state, Still { gravity, frame }).unwrap();
            if let Some(h) = self.hydrostatic {
                field.hydrostatic = h;
            }
            self.dem.advance(&mut self.beads, sub, &field);
        }
        self.dem.export(&self.beads, &mut self.grains);
        self.index += 1;
    }

    /// Momentum of all the fluid, that inside grains included, kg m/s.
    pub fn fluid_momentum(&self) -> Vec3 {
        RHO * self.solver.grid().cell_volume() * total(&self.flow.velocity, self.solver.grid())
    }

    /// Mean velocity of all the fluid, m/s.
    pub fn mean_velocity(&self) -> Vec3 {
        total(&self.flow.velocity, self.solver.grid()) / self.solver.grid().count() as f64
    }

    /// Momentum of the grains half a grain step ago, when their velocity was last kicked, kg m/s.
    pub fn grain_momentum(&self) -> Vec3 {
        let half = 0.5 * self.plan.dt() / self.plan.substeps as f64;
        (0..self.grains.len())
            .map(|k| self.grains.mass[k] * self.grains.velocity[k] - half * self.state.loads[k].force)
            .sum()
    }
}

/// Sum of all velocities on faces.
pub fn total(v: &Faces, grid: &Grid) -> Vec3 {
    let mut sum = Vec3::ZERO;
    for c in 0..3 {
        let [a, b, d] = grid.face_range(c);
        let values = v.component(c);
        for k in d {
            for j in b.clone() {
                for i in a.clone() {
                    sum[c] += values[v.layout().index(i, j, k)];
                }
            }
        }
    }
    sum
}

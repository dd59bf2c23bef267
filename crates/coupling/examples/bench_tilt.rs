//! Cost of a coupled step of the tilting bed (Clément 2009, Table 4.3), stage by stage, beside that of the fluid
//! alone on the same grid, both taken in turn in one run.
//!
//! `cargo run --release -p brazilnut-coupling --example bench_tilt -- [STEPS] [METHODS]`, methods by their first
//! letters, e.g. `sdp` for springs, direct forcing and particle template; `RAYON_NUM_THREADS` sets the threads. One
//! thread is timed by its own processor time, which other jobs on the machine disturb least.

use brazilnut_base::motion::Motion;
use brazilnut_base::{Cell, Side, Tick, Vec3, vec3};
use brazilnut_coupling::resolved::{Forcing, Inertia, Layout, RETRACTION, Springs, Strength};
use brazilnut_coupling::transfer::KernelName;
use brazilnut_coupling::{Body, Coupling, CouplingSpec, Method, Resolved, Still};
use brazilnut_fluid::{Flow, FluidSpec, Grid, Medium, Scheme, Solver};
use brazilnut_grains::contact::{NormalLaw, RollingLaw, TangentialLaw};
use brazilnut_grains::{
    ContactSpec, Dem, DemSpec, Grains, Gravity, Integrator, Limits, Material, PairSpec, PairTable, Search,
    WallShape, WallSpec,
};
use std::time::Instant;

const GRAINS: usize = 2500;
const RADIUS: f64 = 350e-6;
const DENSITY: f64 = 8900.0;
const RHO: f64 = 1000.0;
const ETA: f64 = 1e-3;
const STEP: f64 = 1e-4;
/// The contact of two templates lasts 77 µs: a tenth of it.
const SUBSTEPS: u64 = 13;
const CELLS: [usize; 3] = [180, 45, 180];
const SIZE: Vec3 = vec3(20e-3, 5e-3, 20e-3);
const SIDES: [Side; 3] = [Side::Walls; 3];

const STAGES: [&str; 6] = ["sort", "fluid", "tracers", "look", "grains", "all"];

fn main() {
    let mut args = std::env::args().skip(1);
    let steps: u64 = args.next().and_then(|a| a.parse().ok()).unwrap_or(20);
    let wanted = args.next().unwrap_or_else(|| "sdp".into());
    println!(
        "threads {}, {CELLS:?} cells, {GRAINS} grains, {SUBSTEPS} grain steps",
        rayon::current_num_threads()
    );
    let springs = Springs { strength: Strength::Cs(1.5), damping: 0.0, inertia: Inertia::Template };
    let methods = [
        ('s', Method::Springs(springs), Layout::Lattice),
        ('d', Method::Forcing(Forcing { sweeps: 3 }), Layout::Shells),
        ('p', Method::Template, Layout::Lattice),
    ];
    let pool = rayon::ThreadPoolBuilder::new().build().expect("threads");
    pool.install(|| {
        for (letter, method, layout) in methods {
            if wanted.contains(letter) {
                bench(method, layout, steps);
            }
        }
    });
}

/// Time of this thread on its processor where it is the only one and the system tells; else wall time.
struct Clock(Instant, Option<f64>);

impl Clock {
    fn start() -> Self {
        Self(Instant::now(), on_processor())
    }

    fn seconds(&self) -> f64 {
        let (wall, from) = (self.0.elapsed().as_secs_f64(), self.1);
        from.zip(on_processor()).map_or(wall, |(from, to)| to - from)
    }
}

fn on_processor() -> Option<f64> {
    if rayon::current_num_threads() > 1 {
        return None;
    }
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    Some(1e-9 * text.split_whitespace().next()?.parse::<f64>().ok()?)
}

/// Grain steps as a map of time to work.
fn engine(dt: f64) -> Dem {
    let plane = |axis: usize, end: usize| WallSpec {
        name: format!("{axis}{end}"),
        shape: WallShape::Plane {
            point: if end == 0 { Vec3::ZERO } else { SIZE },
            normal: if end == 0 { Vec3::AXES[axis] } else { -Vec3::AXES[axis] },
        },
        material: 0,
        motion: Motion::default(),
    };
    let pair = PairSpec { stiffness: Some(1500.0), restitution: 0.2, friction: 0.2, ..PairSpec::default() };
    Dem::new(DemSpec {
        cell: Cell { size: SIZE, sides: SIDES },
        materials: vec![Material { name: "bronze".into(), density: DENSITY, elastic: None }],
        contact: ContactSpec {
            normal: NormalLaw::Linear,
            tangential: TangentialLaw::Coulomb,
            rolling: RollingLaw::None,
            pairs: PairTable::uniform(1, pair),
        },
        walls: (0..6).map(|k| plane(k / 2, k % 2)).collect(),
        integrator: Integrator::VelocityVerlet,
        rotation: true,
        dt,
        limits: Limits::default(),
        search: Search::default(),
    })
    .expect("a sound bed")
}

/// A bed that has fallen from a jittered lattice.
fn settled(spec: &CouplingSpec) -> Grains {
    let mut grains = Grains::default();
    let pitch = 745e-6;
    let row = |length: f64| (length / pitch) as usize;
    let (a, b) = (row(SIZE.x), row(SIZE.y));
    for k in 0..GRAINS {
        let jitter = |s: f64| 30e-6 * ((k as f64 * s).fract() - 0.5);
        let at = vec3((k % a) as f64, (k / a % b) as f64, (k / (a * b)) as f64);
        let x = pitch * (at + 0.5) + vec3(jitter(0.618), jitter(0.755), jitter(0.570));
        let mass = DENSITY * Body::Sphere.volume(RADIUS);
        let (m, i) = spec.carried(mass, mass * Body::Sphere.gyration_squared(RADIUS), RADIUS);
        grains.push(0, 0, RADIUS, m, i, x);
    }
    let mut dem = engine(STEP / SUBSTEPS as f64);
    let mut state = dem.start(&grains).expect("grains inside");
    for k in 0..3000 {
        dem.advance(&mut state, Tick::at(k, STEP / SUBSTEPS as f64), &Gravity(vec3(0.0, 0.0, -9.81)));
    }
    dem.export(&state, &mut grains);
    grains
}

fn solver() -> Solver {
    let spacing = [0, 1, 2].map(|a| SIZE[a] / CELLS[a] as f64);
    let mut spec = FluidSpec::new(Grid::new(CELLS, spacing, SIDES), RHO, ETA);
    spec.scheme = Scheme::FirstOrder;
    Solver::new(spec).expect("a plain box")
}

fn bench(method: Method, layout: Layout, steps: u64) {
    let spec = CouplingSpec::Resolved(Resolved {
        method,
        kernel: KernelName::Trilinear,
        layout,
        retraction: RETRACTION,
        lubrication: None,
        density: RHO,
        viscosity: ETA,
        body: Body::Sphere,
    });
    let name = spec.name();
    let mut grains = settled(&spec);
    let shaker = Motion::vertical(2.0 * 9.81 / (std::f64::consts::TAU * 10.0).powi(2), 10.0);
    let gravity = vec3(0.0, 0.0, -9.81);
    let (mut fluid, mut alone) = (solver(), solver());
    let mut free: Flow = alone.start();
    let mut flow = fluid.start();
    let mut coupling = Coupling::new(spec, Cell { size: SIZE, sides: SIDES }, Some(&fluid), &grains);
    let mut state = coupling.start(&grains);
    let mut dem = engine(STEP / SUBSTEPS as f64);
    let mut beads = dem.start(&grains).expect("grains inside");
    let mut spent: [Vec<f64>; 6] = Default::default();
    let mut only = vec![];
    for n in 0..steps {
        let tick = Tick::at(n, STEP);
        let still = |t: f64| Still { gravity, frame: shaker.at(t).acceleration };
        let body = still(tick.time).modified_gravity();
        let clock = Clock::start();
        alone.advance(&mut free, tick, body, &Medium::default(), |_| {});
        only.push(clock.seconds());

        let clock = Clock::start();
        let mut last = 0.0;
        let mut lap = |stage: usize, less: f64| {
            let now = clock.seconds();
            spent[stage].push(now - last - less);
            last = now;
        };
        dem.export(&beads, &mut grains);
        coupling.before_fluid(&grains, &flow, &mut state);
        lap(0, 0.0);
        let mut within = 0.0;
        let (mut during, medium) = coupling.parts();
        fluid.advance(&mut flow, tick, body, medium, |p| {
            let clock = Clock::start();
            during.act(&grains, p);
            within = clock.seconds();
        });
        lap(1, within);
        coupling.after_fluid(&grains, &flow, &mut state, tick.dt);
        lap(3, 0.0);
        for k in 0..SUBSTEPS {
            let sub = tick.substep(k, SUBSTEPS);
            let field = coupling.held(&state, still(sub.time)).expect("a rung with a flow");
            dem.advance(&mut beads, sub, &field);
        }
        lap(4, 0.0);
        spent[2].push(within);
        spent[5].push(clock.seconds());
    }
    let cells = CELLS.iter().product::<usize>() as f64;
    let alone = median(&mut only);
    println!(
        "\n{name}: fluid only {:.1} ms ({:.1} ns a cell); contacts a grain {:.2}",
        1e3 * alone,
        1e9 * alone / cells,
        beads.contact_count() as f64 / GRAINS as f64
    );
    for (stage, spent) in STAGES.iter().zip(&mut spent) {
        let t = median(spent);
        println!("  {stage:8} {:7.1} ms {:6.2} x the fluid only", 1e3 * t, t / alone);
    }
    if let Some(work) = coupling.tracers() {
        let n = work.templates.count() as f64;
        let one = median(&mut spent[2]) / n;
        println!(
            "  {n} tracers, each {:.1} ns = {:.2} cells of the fluid only",
            1e9 * one,
            one / (alone / cells)
        );
    }
}

fn median(x: &mut [f64]) -> f64 {
    x.sort_by(f64::total_cmp);
    x[x.len() / 2]
}

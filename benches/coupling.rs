//! Cost of a coupled step of the tilting bed (Clément 2009, Table 4.3), stage by stage, beside that of the fluid
//! alone on the same grid, both taken in turn. A step of `fluid-springs` must cost at most 2.5 steps of the fluid
//! alone, and a tracer of it at most 6 of its cells. See `benches/README.md`.

use brazilnut_base::motion::Motion;
use brazilnut_base::{Cell, Side, Tick, Vec3, vec3};
use brazilnut_benches::{Clock, median};
use brazilnut_coupling::resolved::{Forcing, Inertia, Layout, RETRACTION, Springs, Strength};
use brazilnut_coupling::transfer::KernelName;
use brazilnut_coupling::{Body, Coupling, CouplingSpec, Method, Resolved, Still};
use brazilnut_fluid::{Flow, FluidSpec, Grid, Medium, Scheme, Solver};
use brazilnut_grains::contact::{NormalLaw, RollingLaw, TangentialLaw};
use brazilnut_grains::{
    ContactSpec, Dem, DemSpec, Grains, Gravity, Integrator, Limits, Material, PairSpec, PairTable, Search,
    WallShape, WallSpec,
};
use clap::Parser;
use std::error::Error;

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

/// Largest cost of a step of `fluid-springs` in steps of the fluid alone, and of its tracer in cells of these.
const MUST: [f64; 2] = [2.5, 6.0];

/// Cost of a coupled step of the tilting bed, in steps of the fluid alone.
#[derive(Parser)]
struct Args {
    /// Steps; the median of each stage counts.
    #[arg(long, default_value_t = 20)]
    steps: u64,
    /// Methods by their first letters: s fluid-springs, d direct-forcing, p particle-template.
    #[arg(long, default_value = "sdp")]
    methods: String,
    /// Numbers of threads.
    #[arg(long, value_delimiter = ',', default_value = "1,2")]
    threads: Vec<usize>,
    /// Given by cargo.
    #[arg(long, hide = true)]
    bench: bool,
}

fn main() -> Result<(), Box<dyn Error>> {
    let args = Args::parse();
    println!("{CELLS:?} cells, {GRAINS} grains, {SUBSTEPS} grain steps; medians of {} steps", args.steps);
    let springs = Springs { strength: Strength::Cs(1.5), damping: 0.0, inertia: Inertia::Template };
    let methods = [
        ('s', Method::Springs(springs), Layout::Lattice),
        ('d', Method::Forcing(Forcing { sweeps: 3 }), Layout::Shells),
        ('p', Method::Template, Layout::Lattice),
    ];
    if let Some(other) = args.methods.chars().find(|c| methods.iter().all(|m| m.0 != *c)) {
        return Err(format!("there is no method {other}; there are s, d and p").into());
    }
    for (_, method, layout) in methods.into_iter().filter(|m| args.methods.contains(m.0)) {
        for &threads in &args.threads {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
            pool.install(|| bench(method, layout, args.steps, threads));
        }
    }
    Ok(())
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

fn bench(method: Method, layout: Layout, steps: u64, threads: usize) {
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
        only.push(clock.lap().seconds(threads));

        let clock = Clock::start();
        let mut last = 0.0;
        let mut lap = |stage: usize, less: f64| {
            let now = clock.lap().seconds(threads);
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
            within = clock.lap().seconds(threads);
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
        spent[5].push(clock.lap().seconds(threads));
    }
    let cells = CELLS.iter().product::<usize>() as f64;
    let alone = median(only);
    println!(
        "\n{name}, {threads} thread(s): fluid alone {:.1} ms ({:.1} ns a cell); contacts a grain {:.2}",
        1e3 * alone,
        1e9 * alone / cells,
        beads.contact_count() as f64 / GRAINS as f64
    );
    // The claims are about `fluid-springs`.
    let must = |most: f64| match method {
        Method::Springs(_) => format!(" (must be at most {most})"),
        _ => String::new(),
    };
    let spent = spent.map(median);
    for (stage, t) in STAGES.iter().zip(spent) {
        let must = if *stage == "all" { must(MUST[0]) } else { String::new() };
        println!("  {stage:8} {:7.1} ms {:6.2} x the fluid alone{must}", 1e3 * t, t / alone);
    }
    if let Some(work) = coupling.tracers() {
        let n = work.templates.count() as f64;
        let one = spent[2] / n;
        println!(
            "  {n} tracers, each {:.1} ns = {:.2} cells of the fluid alone{}",
            1e9 * one,
            one / (alone / cells),
            must(MUST[1])
        );
    }
}

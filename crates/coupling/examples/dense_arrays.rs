//! Drag of a simple cubic array of fixed spheres in creeping flow, by every resolved coupling.
//!
//! `cargo run --release -p brazilnut-coupling --example dense_arrays [-- STEP POINTS...]`
//!
//! STEP is the viscous number nu dt / h² (default 0.01), POINTS the points per radius (default 3 5 8 12).
//! Reference: Zick & Homsy 1982, Table 2, drag = 6 pi eta a K U with U the superficial velocity.

use brazilnut_base::{Cell, Side, Tick, Vec3, vec3};
use brazilnut_coupling::resolved::{Forcing, Inertia, Layout, Springs, Strength};
use brazilnut_coupling::transfer::KernelName;
use brazilnut_coupling::{Body, Coupling, CouplingSpec, Method, Resolved};
use brazilnut_fluid::{Advection, FluidSpec, Grid, Scheme, Solver};
use brazilnut_grains::Grains;
use std::f64::consts::PI;

/// Solid fraction (the last: touching spheres) and K.
const ZICK_HOMSY: [(f64, f64); 4] = [(0.064, 2.810), (0.216, 7.442), (0.343, 15.4), (PI / 6.0, 42.1)];

const DENSITY: f64 = 1000.0;
const VISCOSITY: f64 = 1e-3;
const SPACING: f64 = 1e-4;

struct Case {
    name: &'static str,
    method: Method,
    layout: Layout,
    retraction: f64,
}

fn cases(dt: f64) -> Vec<Case> {
    let springs = |alpha: f64| {
        let strength = Strength::RelaxationTime(dt / alpha);
        Method::Springs(Springs { strength, damping: 0.0, inertia: Inertia::Template })
    };
    let forcing = |sweeps| Method::Forcing(Forcing { sweeps });
    let case = |name, method, layout, retraction| Case { name, method, layout, retraction };
    vec![
        case("particle-template", Method::Template, Layout::Lattice, 0.0),
        case("fluid-springs a=0.09", springs(0.09), Layout::Lattice, 0.0),
        case("fluid-springs a=0.79", springs(0.79), Layout::Lattice, 0.0),
        case("direct-forcing lattice", forcing(3), Layout::Lattice, 0.0),
        case("direct-forcing shells 0.3", forcing(3), Layout::Shells, 0.3),
        case("direct-forcing shells 0.4", forcing(3), Layout::Shells, 0.4),
    ]
}

/// K and leak of an array of solid fraction `solids` with about `points` cells per radius.
fn drag(case: &Case, solids: f64, points: f64, viscous_number: f64, scheme: Scheme) -> (f64, f64, f64, u64) {
    let n = (points * (4.0 * PI / (3.0 * solids)).cbrt()).round() as usize;
    let h = SPACING;
    let size = n as f64 * h;
    let radius = size * (3.0 * solids / (4.0 * PI)).cbrt();
    let nu = VISCOSITY / DENSITY;
    let dt = viscous_number * h * h / nu;
    let cell = Cell { size: Vec3::splat(size), sides: [Side::Periodic; 3] };
    let mut spec = FluidSpec::new(Grid::new([n; 3], [h; 3], cell.sides), DENSITY, VISCOSITY);
    spec.advection = Advection::None;
    spec.scheme = scheme;
    let mut solver = Solver::new(spec).expect("the specification is sound");
    let mut grains = Grains::default();
    // Off the symmetric places of the grid.
    let at = Vec3::splat(0.5 * size) + h * vec3(0.13, 0.27, 0.41);
    grains.push(0, 0, radius, 1.0, 1.0, at);
    let coupling = CouplingSpec::Resolved(Resolved {
        method: case.method,
        kernel: KernelName::Trilinear,
        layout: case.layout,
        retraction: case.retraction,
        lubrication: None,
        density: DENSITY,
        viscosity: VISCOSITY,
        body: Body::Sphere,
    });
    let mut coupling = Coupling::new(coupling, cell, Some(&solver), &grains);
    let mut state = coupling.start(&grains);
    let speed = 1e-4;
    let mut flow = solver.start();
    flow.velocity.component_mut(0).fill(speed);
    solver.refresh(&mut flow, 0.0);
    let mass = DENSITY * size.powi(3);
    let (mut force, mut last) = (0.0, 0.0);
    for step in 0..200_000 {
        // The body force follows the drag and keeps the mean velocity.
        let mean = mean_x(&flow.velocity.x, solver.grid());
        let body = vec3(force / mass + 0.1 * (speed - mean) / dt, 0.0, 0.0);
        coupling.before_fluid(&grains, &flow, &mut state);
        let (mut during, medium) = coupling.parts();
        solver.advance(&mut flow, Tick::at(step, dt), body, medium, |p| during.act(&grains, p));
        coupling.after_fluid(&grains, &flow, &mut state, dt);
        force = -state.exchange.on_fluid.x;
        let settle = (0.05 * (n * n) as f64 / viscous_number / 40.0) as u64;
        if step % settle.max(50) == 0 {
            if step > 0 && (force / last - 1.0f64).abs() < 1e-4 && (mean / speed - 1.0).abs() < 1e-4 {
                last = force;
                let k = last / (6.0 * PI * VISCOSITY * radius * speed);
                let leak = through(&coupling, &flow, &grains, speed);
                return (k, leak, radius / h, step);
            }
            last = force;
        }
    }
    (f64::NAN, f64::NAN, radius / h, 0)
}

/// Mean speed at the tracers over the superficial velocity.
fn through(coupling: &Coupling, flow: &brazilnut_fluid::Flow, grains: &Grains, speed: f64) -> f64 {
    let Some(work) = coupling.tracers() else { return 0.0 };
    let mut work = work.clone();
    let t = work.look(grains, &flow.velocity);
    t.slip / work.templates.count() as f64 / speed
}

fn mean_x(v: &brazilnut_fluid::FaceField<0>, grid: &Grid) -> f64 {
    let [a, b, c] = grid.cell_range();
    let mut sum = 0.0;
    for k in c {
        for j in b.clone() {
            for i in a.clone() {
                sum += v.at(i, j, k);
            }
        }
    }
    sum / grid.count() as f64
}

fn main() {
    let args: Vec<f64> = std::env::args().skip(1).filter_map(|a| a.parse().ok()).collect();
    let number = args.first().copied().unwrap_or(0.01);
    let points = if args.len() > 1 { args[1..].to_vec() } else { vec![3.0, 5.0, 8.0, 12.0] };
    println!(
        "nu dt/h² = {number}; error of K against Zick & Homsy 1982 in %, leak in % of the superficial velocity"
    );
    print!("{:>28} {:>6}", "coupling", "n_r");
    for (solids, k) in ZICK_HOMSY {
        print!("   {solids:.4} (K {k:>5.2})");
    }
    println!();
    let dt = number * SPACING * SPACING / (VISCOSITY / DENSITY);
    for p in points {
        for case in cases(dt) {
            for scheme in [Scheme::SecondOrder, Scheme::FirstOrder] {
                let order = if scheme == Scheme::FirstOrder { "1" } else { "2" };
                print!("{:>26} {order} {p:>6}", case.name);
                for (solids, k) in ZICK_HOMSY {
                    let (got, leak, n_r, _steps) = drag(&case, solids, p, number, scheme);
                    print!("  {:>+6.1} ({:>4.1}, {n_r:.2})", 100.0 * (got / k - 1.0), 100.0 * leak);
                    use std::io::Write;
                    let _ = std::io::stdout().flush();
                }
                println!();
            }
        }
    }
}

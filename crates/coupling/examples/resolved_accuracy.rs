//! Errors of every resolved coupling for one sphere in known flows, against points per radius: the tables of
//! `docs/resolved-accuracy.md`.
//!
//! `cargo run --release -p brazilnut-coupling --example resolved_accuracy -- TABLES [POINTS...]`, TABLES being one
//! or more of `creep` (Re 1: ten minutes for five points, hours beyond), `stream`, `settle`, `spin`, `release`, separated by
//! commas; POINTS are 3 and 5 by default.
//! Dense arrays have an example of their own, `dense_arrays`.

#[path = "../tests/common/mod.rs"]
mod common;

use brazilnut_base::{Side, Vec3, vec3};
use brazilnut_coupling::Method;
use brazilnut_coupling::resolved::Strength;
use brazilnut_fluid::Advection;
use common::{ETA, NU, Plan, RHO, forcing, rig, springs_for};
use std::f64::consts::PI;
use std::io::Write;

/// Largest path of the fluid per step in spacings, and largest viscous number: the second-order scheme bears 1/12.
const COURANT: f64 = 0.3;
const VISCOUS: f64 = 0.06;

/// Stands for a number that was left out.
const NOT_RUN: f64 = f64::NEG_INFINITY;

/// Two places of the centre between grid points, in spacings.
const PLACES: [Vec3; 2] = [vec3(0.13, 0.27, 0.41), vec3(0.5, 0.02, 0.25)];

fn main() {
    let mut args = std::env::args().skip(1);
    let tables = args.next().unwrap_or_else(|| "stream,settle,spin,release".into());
    let mut points: Vec<usize> = args.filter_map(|a| a.parse().ok()).collect();
    if points.is_empty() {
        points = vec![3, 5];
    }
    for table in tables.split(',') {
        match table {
            "creep" => stream(&points, &[1.0]),
            "stream" => stream(&points, &[20.0, 100.0]),
            "settle" => settle(&points),
            "spin" => spin(&points),
            "release" => release(&points),
            other => eprintln!("no table {other}"),
        }
    }
}

/// The couplings compared.
fn methods(plan: &Plan) -> [(&'static str, Plan); 4] {
    [
        ("particle-template", Plan { method: Method::Template, ..plan.clone() }),
        ("fluid-springs, alpha 0.09", springs_for(plan, 0.09)),
        ("fluid-springs, alpha 0.79", springs_for(plan, 0.79)),
        ("direct-forcing", plan.clone()),
    ]
}

fn row(name: &str, points: usize, results: &[f64]) {
    print!("| {name} | {points} |");
    for r in results {
        match *r {
            NOT_RUN => print!(" not run |"),
            r if r.abs() < 1e3 => print!(" {r:+.1} |"),
            _ => print!(" unstable |"),
        }
    }
    println!();
    let _ = std::io::stdout().flush();
}

fn head(title: &str, columns: &[String]) {
    println!("\n{title}\n");
    println!("| coupling | n_r | {} |", columns.join(" | "));
    println!("| --- | --- |{}", " --- |".repeat(columns.len()));
}

/// C_D = 24/Re (1 + 0.15 Re^0.687), within 5 % up to Re 800 (Schiller & Naumann 1935).
fn schiller_naumann(re: f64) -> f64 {
    24.0 / re * (1.0 + 0.15 * re.powf(0.687))
}

/// False for what a case would refuse: bodies no denser than the fluid in an explicit coupling, and springs that take
/// twice the slip of fluid and template together.
fn bears(plan: &Plan, ratio: f64) -> bool {
    match plan.method {
        Method::Forcing(_) => true,
        Method::Template => ratio > 1.0,
        Method::Springs(s) => match s.strength {
            Strength::RelaxationTime(tau) => ratio > 1.0 && plan.dt() / tau * ratio / (ratio - 1.0) < 2.0,
            Strength::Cs(_) => false,
        },
    }
}

/// Viscous number of a step at Reynolds number `re` with `points` per radius.
fn viscous(re: f64, points: usize) -> f64 {
    VISCOUS.min(COURANT * 2.0 * points as f64 / re)
}

fn box_of(points: usize, long: usize, viscous: f64) -> Plan {
    let d = 2 * points;
    Plan {
        cells: [long * d, 4 * d, 4 * d],
        sides: [Side::Walls; 3],
        viscous,
        advection: Advection::Central,
        ..Plan::cube(d, forcing())
    }
}

/// A fixed sphere in a uniform stream: slippery sides four diameters apart, area blockage 0.049.
fn stream(points: &[usize], numbers: &[f64]) {
    let columns: Vec<String> =
        numbers.iter().flat_map(|re| [format!("Re {re}, place 1"), format!("Re {re}, place 2")]).collect();
    head("Drag of a fixed sphere in a stream, against Schiller & Naumann, %", &columns);
    for &p in points {
        for k in 0..4 {
            let mut results = vec![];
            let mut name = "";
            for &re in numbers {
                for place in PLACES {
                    let (n, plan) = methods(&box_of(p, 10, viscous(re, p)))[k].clone();
                    name = n;
                    results.push(100.0 * (drag_in_stream(plan, p, re, place) / schiller_naumann(re) - 1.0));
                }
            }
            row(name, p, &results);
        }
    }
}

fn drag_in_stream(plan: Plan, points: usize, re: f64, place: Vec3) -> f64 {
    let h = plan.spacing;
    let a = points as f64 * h;
    let speed = re * NU / (2.0 * a);
    let at = vec3(6.0, 4.0, 4.0) * a + h * place;
    let mut rig = rig(Plan { stream: Some(speed), ..plan }, &[(at, a, 2.0)]);
    // The flow is steady after the wake has formed: 15 diameters, or the viscous time of the box.
    let steps = ((if re < 2.0 { 6.0 } else { 15.0 }) * 2.0 * a / speed / rig.plan.dt()) as usize;
    for _ in 0..steps {
        rig.fluid_step(Vec3::ZERO);
        rig.index += 1;
    }
    -rig.state.exchange.on_fluid.x / (0.5 * RHO * speed * speed * PI * a * a)
}

/// Density of the settling sphere over that of the fluid.
const RATIO: f64 = 1.5;

/// A sphere that falls through a fluid at rest on the whole.
fn settle(points: &[usize]) {
    let numbers = [20.0, 100.0];
    head(
        "Terminal speed of a settling sphere, against Schiller & Naumann, %",
        &numbers.map(|re| format!("Re {re}")),
    );
    for &p in points {
        for k in 0..4 {
            let mut results = vec![];
            let mut name = "";
            for re in numbers {
                let plan = Plan { sides: [Side::Periodic; 3], ..box_of(p, 20, viscous(1.2 * re, p)) };
                let (n, plan) = methods(&plan)[k].clone();
                name = n;
                let run = bears(&plan, RATIO);
                results.push(if run { 100.0 * (terminal(plan, p, re) - 1.0) } else { NOT_RUN });
            }
            row(name, p, &results);
        }
    }
}

/// Terminal speed over that of the drag law.
fn terminal(plan: Plan, points: usize, re: f64) -> f64 {
    let h = plan.spacing;
    let a = points as f64 * h;
    let speed = re * NU / (2.0 * a);
    let drag = schiller_naumann(re) * 0.5 * RHO * speed * speed * PI * a * a;
    let g = drag / ((RATIO - 1.0) * RHO * 4.0 / 3.0 * PI * a.powi(3));
    let at = vec3(34.0, 4.0, 4.0) * a + h * PLACES[0];
    let mut rig = rig(plan, &[(at, a, RATIO)]);
    rig.hydrostatic = Some(Vec3::ONE);
    let mass = RHO * rig.solver.grid().size().element_product();
    let dt = rig.plan.dt();
    // Twelve diameters at terminal speed, the mean over the last two: a sphere crosses the grid in that time.
    let steps = (12.0 * 2.0 * a / speed / dt) as usize;
    let last = (2.0 * 2.0 * a / speed / dt) as usize;
    let mut path = 0.0;
    for n in 0..steps {
        let lag = -rig.mean_velocity() / dt;
        let body = -rig.state.exchange.on_fluid / mass + 0.1 * lag;
        rig.step(Vec3::X * -g, Vec3::ZERO, body);
        if n >= steps - last {
            path -= rig.grains.velocity[0].x * dt;
        }
    }
    path / (last as f64 * dt) / speed
}

/// Torque of a sphere that turns in place, Re = w a²/nu.
fn spin(points: &[usize]) {
    let numbers = [1.0, 20.0, 100.0];
    head(
        "Torque of a spun sphere, against 8 pi eta a³ w (Re 1) and Dennis, Singh & Ingham 1980, %",
        &numbers.map(|re| format!("Re {re}")),
    );
    for &p in points {
        for k in 0..4 {
            let mut results = vec![];
            let mut name = "";
            for re in numbers {
                let viscous = VISCOUS.min(COURANT * p as f64 / re);
                let plan = Plan {
                    sides: [Side::Walls; 3],
                    viscous,
                    advection: Advection::Central,
                    ..Plan::cube(8 * p, forcing())
                };
                let (n, plan) = methods(&plan)[k].clone();
                name = n;
                results.push(100.0 * (torque(plan, p, re) - 1.0));
            }
            row(name, p, &results);
        }
    }
}

/// Torque over the reference.
fn torque(plan: Plan, points: usize, re: f64) -> f64 {
    let h = plan.spacing;
    let a = points as f64 * h;
    let w = re * NU / (a * a);
    let at = Vec3::splat(4.0 * a) + h * PLACES[0];
    let mut rig = rig(plan, &[(at, a, 2.0)]);
    rig.grains.angular_velocity[0] = Vec3::Z * w;
    // Creeping: the start-up decays as (a²/nu t)^3/2, 0.3 % after eight; fast: a few turns.
    let time = if re < 2.0 { 8.0 * a * a / NU } else { 20.0 / w };
    for _ in 0..(time / rig.plan.dt()) as usize {
        rig.fluid_step(Vec3::ZERO);
        rig.index += 1;
    }
    let got = -rig.state.loads[0].torque.z;
    // Half the width of the cube is four radii: the wall adds (a/b)³ (Lamb 1932, concentric spheres).
    let stokes = 8.0 * PI * ETA * a.powi(3) * w * (1.0 + 1.0 / 64.0);
    // M = C rho w² a^5/2, C = 6.45 Re^-1/2 + 32.1/Re for 20 <= Re <= 1000.
    let fast = 0.5 * RHO * w * w * a.powi(5) * (6.45 / re.sqrt() + 32.1 / re);
    got / if re < 2.0 { stokes } else { fast }
}

/// A sphere released at rest: its acceleration at times short against d²/nu, drawn to time zero along √t.
fn release(points: &[usize]) {
    let ratios = [0.1, 0.3, 0.5, 0.7, 0.9, 1.1, 1.5, 2.5];
    head(
        "Acceleration of a released sphere, against (rho_g - rho) g/(rho_g + rho/2), %",
        &ratios.map(|r| format!("density ratio {r}")),
    );
    for &p in points {
        for k in 0..4 {
            let mut results = vec![];
            let mut name = "";
            for ratio in ratios {
                let plan = Plan { viscous: 0.01, advection: Advection::None, ..Plan::cube(8 * p, forcing()) };
                let (n, plan) = methods(&plan)[k].clone();
                name = n;
                let expected = (ratio - 1.0) / (ratio + 0.5);
                let run = bears(&plan, ratio);
                results.push(if run { 100.0 * (start(plan, p, ratio) / expected - 1.0) } else { NOT_RUN });
            }
            row(name, p, &results);
        }
    }
}

/// Acceleration over g.
fn start(plan: Plan, points: usize, ratio: f64) -> f64 {
    let h = plan.spacing;
    let (n, dt) = (plan.cells[0] as f64, plan.dt());
    let mut rig = rig(plan, &[(Vec3::splat(0.5 * n * h) + h * PLACES[0], points as f64 * h, ratio)]);
    rig.hydrostatic = Some(Vec3::ONE);
    let g = -1e-3;
    let mass = RHO * rig.solver.grid().size().element_product();
    let mut speeds = vec![0.0];
    for _ in 0..48 {
        let body = -rig.state.exchange.on_fluid / mass;
        rig.step(Vec3::Z * g, Vec3::ZERO, body);
        speeds.push(rig.grains.velocity[0].z);
    }
    let rate = |a: usize, b: usize| (speeds[b] - speeds[a]) / ((b - a) as f64 * dt);
    // Two stretches around times 1 : 4, whose roots are 1 : 2.
    (2.0 * rate(8, 12) - rate(36, 44)) / g
}

//! Errors of every resolved coupling for one sphere in known flows, against points per radius: the tables of
//! `docs/resolved-accuracy.md`.
//!
//! `cargo run --release -p brazilnut-coupling --example resolved_accuracy -- TABLES [POINTS...]`, TABLES being one
//! or more of `stream`, `settle`, `spin` (Re 20 and 100), `creep`, `sink`, `twist` (the same at Re 1) and `release`,
//! separated by commas; POINTS are 3 and 5 by default. An even number of at least six starts from the flow of half
//! as many, and goes on until the answer stands still.
//! Dense arrays have an example of their own, `dense_arrays`.

#[path = "../tests/common/mod.rs"]
mod common;

use brazilnut_base::{Side, Vec3, vec3};
use brazilnut_coupling::Method;
use brazilnut_coupling::resolved::Strength;
use brazilnut_fluid::Advection;
use common::{ETA, NU, Plan, RHO, Rig, forcing, rig, springs_for};
use std::f64::consts::PI;
use std::io::Write;

/// Largest path of the fluid per step in spacings, and largest viscous number: the second-order scheme bears 1/12.
const COURANT: f64 = 0.3;
const VISCOUS: f64 = 0.06;

/// Below this Reynolds number a flow is slow: times are viscous ones.
const SLOW: f64 = 2.0;

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
            "creep" => STREAM.table(&points, &[1.0]),
            "stream" => STREAM.table(&points, &[20.0, 100.0]),
            "sink" => SETTLE.table(&points, &[1.0]),
            "settle" => SETTLE.table(&points, &[20.0, 100.0]),
            "twist" => SPIN.table(&points, &[1.0]),
            "spin" => SPIN.table(&points, &[20.0, 100.0]),
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

/// A question with a steady answer, asked of a sphere with so many points per radius at a Reynolds number.
struct Question {
    title: &'static str,
    plan: fn(usize, f64) -> Plan,
    /// The sphere in its box, its centre between grid points as the last argument says.
    start: fn(Plan, usize, f64, Vec3) -> Rig,
    step: fn(&mut Rig, usize, f64),
    /// Over the reference.
    answer: fn(&Rig, usize, f64) -> f64,
    /// Time over which the answer is averaged, s.
    span: fn(usize, f64) -> f64,
    /// Spans after which the answer of a start from rest is taken.
    spans: fn(f64) -> usize,
    /// Density of the sphere over that of the fluid, if it moves.
    ratio: f64,
}

impl Question {
    fn table(&self, points: &[usize], numbers: &[f64]) {
        let columns: Vec<String> = numbers
            .iter()
            .flat_map(|re| [format!("Re {re}, place 1"), format!("Re {re}, place 2")])
            .collect();
        head(self.title, &columns);
        for &p in points {
            for (k, (name, _)) in methods(&(self.plan)(p, numbers[0])).into_iter().enumerate() {
                let mut results = vec![];
                for &re in numbers {
                    let run = bears(&self.method(k, p, re), self.ratio);
                    let error = |place| 100.0 * (self.ask(k, p, re, place).0 - 1.0);
                    results.extend(PLACES.map(|place| if run { error(place) } else { NOT_RUN }));
                }
                row(name, p, &results);
            }
        }
    }

    /// The plan of the `k`-th coupling.
    fn method(&self, k: usize, points: usize, re: f64) -> Plan {
        methods(&(self.plan)(points, re))[k].1.clone()
    }

    /// The answer, and the rig that gave it. From the flow of half as many points, until a span changes it by less
    /// than a thousandth; two spans at least.
    fn ask(&self, k: usize, points: usize, re: f64, place: Vec3) -> (f64, Rig) {
        let mut rig = (self.start)(self.method(k, points, re), points, re, place);
        let refined = points >= 6 && points.is_multiple_of(2);
        if refined {
            refine(&mut rig, &self.ask(k, points / 2, re, place).1);
        }
        let steps = ((self.span)(points, re) / rig.plan.dt()).ceil() as usize;
        let mut last = f64::INFINITY;
        for _ in 0..(self.spans)(re) {
            let mut sum = 0.0;
            for _ in 0..steps {
                (self.step)(&mut rig, points, re);
                sum += (self.answer)(&rig, points, re);
            }
            let mean = sum / steps as f64;
            let still = (mean - last).abs() < 1e-3 * mean.abs();
            last = mean;
            if refined && still {
                break;
            }
        }
        (last, rig)
    }
}

/// Gives `fine` the flow and the sphere of `coarse`, of half as many points per radius and hence twice the velocity.
fn refine(fine: &mut Rig, coarse: &Rig) {
    let grid = fine.solver.grid().clone();
    let (old, new) = (coarse.flow.velocity.layout(), fine.flow.velocity.layout());
    for c in 0..3 {
        let from = coarse.flow.velocity.component(c);
        let to = fine.flow.velocity.component_mut(c);
        // Along an axis: the lower neighbour, and the weights of both.
        let place = |axis: usize, n: isize| {
            let x = 0.5 * n as f64 - if axis == c { 0.0 } else { 0.25 };
            (x.floor() as isize, [1.0 - (x - x.floor()), x - x.floor()])
        };
        let [xs, ys, zs] = grid.face_range(c);
        for k in zs {
            let (k0, z) = place(2, k);
            for j in ys.clone() {
                let (j0, y) = place(1, j);
                for i in xs.clone() {
                    let (i0, x) = place(0, i);
                    let corner = |n: usize| {
                        let [u, v, w] = [n & 1, n >> 1 & 1, n >> 2];
                        let at = old.index(i0 + u as isize, j0 + v as isize, k0 + w as isize);
                        x[u] * y[v] * z[w] * from[at]
                    };
                    to[new.index(i, j, k)] = 0.5 * (0..8).map(corner).sum::<f64>();
                }
            }
        }
    }
    fine.solver.refresh(&mut fine.flow, 0.0);
    if coarse.grains.velocity[0] != Vec3::ZERO {
        fine.grains.position[0] = 2.0 * coarse.grains.position[0];
        fine.launch(0.5 * coarse.grains.velocity[0], 0.5 * coarse.grains.angular_velocity[0]);
    }
}

/// Radius of the sphere in m, and its speed at `re` in m/s.
fn scales(points: usize, re: f64) -> (f64, f64) {
    let a = points as f64 * Plan::cube(1, forcing()).spacing;
    (a, re * NU / (2.0 * a))
}

/// Time in which the speed of [`scales`] goes half a diameter, s; at Re 1 half of d²/nu as well.
fn passage(points: usize, re: f64) -> f64 {
    let (a, speed) = scales(points, re);
    a / speed
}

/// A fixed sphere in a uniform stream: slippery sides four diameters apart, area blockage 0.049.
const STREAM: Question = Question {
    title: "Drag of a fixed sphere in a stream, against Schiller & Naumann, %",
    plan: |points, re| box_of(points, 10, viscous(re, points)),
    start: |plan, points, re, place| {
        let (a, speed) = scales(points, re);
        let at = vec3(6.0, 4.0, 4.0) * a + plan.spacing * place;
        rig(Plan { stream: Some(speed), ..plan }, &[(at, a, 2.0)])
    },
    step: |rig, _, _| still(rig),
    answer: |rig, points, re| {
        let (a, speed) = scales(points, re);
        let unit = 0.5 * RHO * speed * speed * PI * a * a;
        -rig.state.exchange.on_fluid.x / unit / schiller_naumann(re)
    },
    span: passage,
    // The wake has formed (15 diameters), or the viscous time of the box has passed.
    spans: |re| if re < SLOW { 12 } else { 30 },
    ratio: 2.0,
};

/// A step of the fluid around a sphere whose centre stays.
fn still(rig: &mut Rig) {
    rig.fluid_step(Vec3::ZERO);
    rig.index += 1;
}

/// Density of the settling sphere over that of the fluid.
const RATIO: f64 = 1.5;

/// A sphere that falls through a fluid at rest on the whole. A slow one has no wake, and a shorter box.
const SETTLE: Question = Question {
    title: "Terminal speed of a settling sphere, against Schiller & Naumann, %",
    plan: |points, re| {
        let long = if re < SLOW { 8 } else { 20 };
        Plan { sides: [Side::Periodic; 3], ..box_of(points, long, viscous(1.2 * re, points)) }
    },
    start: |plan, points, re, place| {
        let (a, _) = scales(points, re);
        let at = vec3(if re < SLOW { 14.0 } else { 34.0 }, 4.0, 4.0) * a + plan.spacing * place;
        let mut rig = rig(plan, &[(at, a, RATIO)]);
        rig.hydrostatic = Some(Vec3::ONE);
        rig
    },
    step: |rig, points, re| {
        let (a, speed) = scales(points, re);
        let drag = schiller_naumann(re) * 0.5 * RHO * speed * speed * PI * a * a;
        let g = drag / ((RATIO - 1.0) * RHO * 4.0 / 3.0 * PI * a.powi(3));
        let mass = RHO * rig.solver.grid().size().element_product();
        let lag = -rig.mean_velocity() / rig.plan.dt();
        let body = -rig.state.exchange.on_fluid / mass + 0.1 * lag;
        rig.step(Vec3::X * -g, Vec3::ZERO, body);
    },
    answer: |rig, points, re| -rig.grains.velocity[0].x / scales(points, re).1,
    // A sphere crosses whole cells in it.
    span: passage,
    spans: |re| if re < SLOW { 12 } else { 24 },
    ratio: RATIO,
};

/// Torque of a sphere that turns in place, Re = w a²/nu, in a cube of eight radii.
const SPIN: Question = Question {
    title: "Torque of a spun sphere, against 8 pi eta a³ w (Re 1) and Dennis, Singh & Ingham 1980, %",
    plan: |points, re| Plan {
        sides: [Side::Walls; 3],
        viscous: VISCOUS.min(COURANT * points as f64 / re),
        advection: Advection::Central,
        ..Plan::cube(8 * points, forcing())
    },
    start: |plan, points, re, place| {
        let (a, _) = scales(points, re);
        let at = Vec3::splat(4.0 * a) + plan.spacing * place;
        let mut rig = rig(plan, &[(at, a, 2.0)]);
        rig.grains.angular_velocity[0] = Vec3::Z * re * NU / (a * a);
        rig
    },
    step: |rig, _, _| still(rig),
    answer: |rig, points, re| {
        let (a, _) = scales(points, re);
        let w = re * NU / (a * a);
        // Half the width of the cube is four radii: the wall adds (a/b)³ (Lamb 1932, concentric spheres).
        let slow = 8.0 * PI * ETA * a.powi(3) * w * (1.0 + 1.0 / 64.0);
        // M = C rho w² a^5/2, C = 6.45 Re^-1/2 + 32.1/Re for 20 <= Re <= 1000.
        let fast = 0.5 * RHO * w * w * a.powi(5) * (6.45 / re.sqrt() + 32.1 / re);
        -rig.state.loads[0].torque.z / if re < SLOW { slow } else { fast }
    },
    span: |points, re| {
        let (a, _) = scales(points, re);
        a * a / NU / if re < SLOW { 1.0 } else { 0.5 * re }
    },
    // Creeping: the start-up decays as (a²/nu t)^3/2, 0.3 % after eight; fast: twenty radians.
    spans: |re| if re < SLOW { 8 } else { 10 },
    ratio: 2.0,
};

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

//! The part of the start-up sheet about a flow on a grid.

use crate::progress::duration;
use crate::sheet::si;
use brazilnut_base::Side;
use brazilnut_case::build::Built;
use brazilnut_coupling::{CouplingSpec, Method};
use brazilnut_fluid::{Advection, Diffusion, FluidSpec, Scheme, step_limits};
use brazilnut_report::sheet::Sheet;
use brazilnut_report::text::significant;
use brazilnut_sim::plan::Medium;

/// Seconds per cell and step assumed for the estimate, of one core of a current machine (docs/performance.md).
const PER_CELL: f64 = 20e-9;

/// Seconds per grain and fluid step that averaging grains onto a grid takes.
const PER_AVERAGED_GRAIN: f64 = 1.3e-6;

/// Numbers per cell that a flow and its solver keep: velocity, pressure, the
/// remembered rates, the prediction, and the pressure equation, with ghosts.
const WORDS: f64 = 16.0;

/// Seconds that a step of the flow is estimated to take on one core, with what joins it to the grains but without
/// these. A cell inside a resolved grain costs as much as so many others: measured with the tilting bed, a fifth of
/// whose cells are (docs/performance.md).
pub fn step_time(b: &Built) -> f64 {
    let (coupling, spec) = match &b.plan.medium {
        Medium::Coupled(coupling, spec) => (Some(coupling), spec),
        Medium::Fluid(spec) => (None, spec),
        _ => return 0.0,
    };
    let flow = PER_CELL * spec.grid.count() as f64;
    match coupling.map(|c| &**c) {
        Some(CouplingSpec::Averaged(_)) => flow + PER_AVERAGED_GRAIN * b.plan.start.len() as f64,
        Some(CouplingSpec::Resolved(r)) => {
            let solid: f64 = b.plan.start.radius.iter().map(|&a| r.body.volume(a)).sum();
            let each = match r.method {
                Method::Springs(_) => 4.6,
                Method::Template => 10.0,
                Method::Forcing(_) => 36.0,
            };
            flow + PER_CELL * each * solid / spec.grid.cell_volume()
        }
        _ => flow,
    }
}

/// Adds grid, scheme and step limits of the flow, if the run has one.
pub fn flow(s: &mut Sheet, b: &Built) {
    let Some(spec) = b.plan.flow() else { return };
    let (clock, speed) = (&b.plan.clock, b.facts.flow_speed);
    s.group("Flow");
    grid(s, spec);
    let scheme = match spec.scheme {
        Scheme::FirstOrder => "first-order",
        Scheme::SecondOrder => "second-order",
    };
    let advection = match spec.advection {
        Advection::Central => "central advection",
        Advection::Koren => "Koren advection",
        Advection::None => "no advection",
    };
    let diffusion = match spec.diffusion {
        Diffusion::Explicit => "explicit diffusion",
        Diffusion::Implicit => "implicit diffusion",
    };
    s.row("scheme", scheme, format!("{advection}, {diffusion}"));
    if spec.adaptive {
        s.row("steps", "adaptive", "each cut into as many parts as the flow needs");
    }
    let nu = spec.kinematic_viscosity();
    if b.plan.start.is_empty() && nu > 0.0 {
        let extent = (0..3).filter(|&a| spec.grid.sides[a] != Side::Flat).map(|a| spec.grid.size()[a]);
        let length = extent.fold(f64::INFINITY, f64::min);
        let at = format!("{} over {}", si(speed, "m/s"), si(length, "m"));
        s.row("Reynolds number", significant(speed * length / nu, 4), at);
    }
    let limits = step_limits(spec, speed);
    for (name, limit) in &limits {
        s.row(format!("{name} limit"), si(*limit, "s"), format!("of the step, at {}", si(speed, "m/s")));
    }
    let largest = limits.iter().map(|l| l.1).fold(f64::INFINITY, f64::min);
    if largest.is_finite() {
        let part = format!("the step is {:.2} of it", clock.dt / largest);
        s.row("largest stable step", si(largest, "s"), part);
    }
    let cells = spec.grid.count() as f64;
    s.row("memory of the flow", format!("{} MB", significant(8e-6 * WORDS * cells, 3)), "estimated");
    if b.plan.start.is_empty() {
        let work = cells * clock.end as f64;
        s.row("cell-steps", format!("{work:.2e}"), "");
        s.row("run time", duration(step_time(b) * clock.end as f64), "estimated, on one core");
    }
}

fn grid(s: &mut Sheet, spec: &FluidSpec) {
    let mut grid = spec.grid.clone();
    if let Some(axis) = spec.open_axis() {
        grid.line_axis = axis;
    }
    let [a, b, c] = grid.cells;
    let edges: Vec<String> =
        (0..3).filter(|&a| grid.sides[a] != Side::Flat).map(|a| si(grid.spacing[a], "m")).collect();
    s.row("grid", format!("{a} x {b} x {c} cells"), format!("edges {}", edges.join(", ")));
    for (axis, n, good) in grid.slow_sizes() {
        let name = ["x", "y", "z"][axis];
        s.warn(format!(
            "{n} grid cells along {name} make steps slow (a prime factor above 7); {good} is the nearest good number: set `fluid.cells`"
        ));
    }
}

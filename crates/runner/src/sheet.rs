//! The start-up sheet: every limit and number before anything runs.

use crate::flow_sheet;
use crate::progress::duration;
use brazilnut_base::keys::Check;
use brazilnut_case::build::{Built, Facts};
use brazilnut_report::sheet::Sheet;
use brazilnut_sim::plan::{Medium, Settle, Shaken};
use std::f64::consts::TAU;

/// Particle-steps per second assumed for the estimate, of one core of a current machine.
const SPEED: f64 = 2.0e7;

/// The sheet of an assembled case.
#[must_use]
pub fn sheet(title: &str, model: &str, built: &Built) -> Sheet {
    let mut s = Sheet::new(format!("{title}: {model}"));
    let grains = !built.plan.start.is_empty();
    if grains {
        bed(&mut s, built);
    }
    shaker(&mut s, built);
    steps(&mut s, built);
    if grains {
        fluid(&mut s, built);
        coupling(&mut s, built);
    }
    flow_sheet::flow(&mut s, built);
    if grains {
        cost(&mut s, built);
    }
    s
}

/// `x` with a unit that reads well, four digits.
pub(crate) fn si(x: f64, unit: &str) -> String {
    use brazilnut_report::text::{readable_unit, significant};
    if unit == "kg" && x.abs() < 0.1 {
        return format!("{} g", significant(1e3 * x, 4));
    }
    let (name, size) = readable_unit(unit, x.abs());
    format!("{} {name}", significant(x / size, 4))
}

fn bed(s: &mut Sheet, b: &Built) {
    let (plan, f) = (&b.plan, &b.facts);
    s.group("Bed");
    s.row("grains", plan.start.len().to_string(), "");
    for k in &plan.species {
        s.row(format!("  {}", k.name), k.count.to_string(), format!("mean diameter {}", si(k.diameter, "m")));
    }
    s.row("mass", si(f.mass, "kg"), "");
    let wide = plan.cell.size.x.min(plan.cell.size.y) / f.diameter;
    s.row(
        "cell",
        format!(
            "{} x {} x {}",
            si(plan.cell.size.x, "m"),
            si(plan.cell.size.y, "m"),
            si(plan.cell.size.z, "m")
        ),
        format!("narrowest side {wide:.1} diameters"),
    );
    if plan.gravity.length() > 0.0 {
        s.row("bed height", si(f.height, "m"), format!("estimated, {:.1} diameters", f.height / f.diameter));
        if f.height > plan.cell.size.z {
            s.warn("the settled bed is higher than the cell");
        }
    }
}

fn shaker(s: &mut Sheet, b: &Built) {
    let Some((amplitude, frequency)) = b.facts.shake else { return };
    let (w, g) = (TAU * frequency, b.plan.gravity.length());
    s.group("Shaker");
    let moves = if b.plan.shaken == Shaken::Cell {
        "whole cell, computed in its frame"
    } else {
        "floor alone, laboratory frame"
    };
    s.row("frequency", si(frequency, "Hz"), moves);
    let grains = !b.plan.start.is_empty();
    let size = if grains { format!("{:.3} diameters", amplitude / b.facts.diameter) } else { String::new() };
    s.row("displacement amplitude", si(amplitude, "m"), size);
    s.row("peak velocity", si(amplitude * w, "m/s"), "");
    if g > 0.0 && grains {
        let gamma = amplitude * w * w / g;
        let off = if gamma > 1.0 {
            format!("take-off at {:.1} deg", (1.0 / gamma).asin().to_degrees())
        } else {
            "the bed is not thrown".into()
        };
        s.row("Gamma", format!("{gamma:.4}"), off);
        s.row(
            "shake strength",
            format!("{:.4}", (amplitude * w).powi(2) / (g * b.facts.diameter)),
            "A² ω² / (g d)",
        );
    }
}

fn steps(s: &mut Sheet, b: &Built) {
    let clock = &b.plan.clock;
    s.group("Time");
    if b.plan.start.is_empty() {
        s.row("step", si(clock.dt, "s"), "");
    } else {
        contacts(s, b);
    }
    if let Some(n) = clock.steps_per_cycle {
        s.row("steps per cycle", n.to_string(), "shaker period / step");
    }
    let cycles = clock.steps_per_cycle.map(|n| format!("{:.1} cycles", clock.end as f64 / n as f64));
    s.row("steps", clock.end.to_string(), cycles.unwrap_or_default());
    s.row("end", si(clock.end as f64 * clock.dt, "s"), "");
    if !b.plan.start.is_empty() {
        settling(s, b);
    }
}

fn contacts(s: &mut Sheet, b: &Built) {
    let (clock, f) = (&b.plan.clock, &b.facts);
    let grain = clock.grain_dt();
    let at = format!("shortest, at {}", si(f.speed, "m/s"));
    s.row("contact time", si(f.contact_time, "s"), at);
    s.row("grain step", si(grain, "s"), format!("{:.1} steps per contact", f.contact_time / grain));
    if f.contact_time / grain < 10.0 {
        s.warn(format!(
            "only {:.1} steps per contact: ten is the least for a trustworthy restitution (Clément 2.1.3)",
            f.contact_time / grain
        ));
    }
    let packed = f.contact_time / f.packed_step;
    s.row(
        "packed bed",
        si(f.packed_step, "s"),
        format!("largest stable step, {packed:.1} steps per contact"),
    );
    if grain > f.packed_step {
        s.warn(format!(
            "a packed bed is stiffer than a pair of grains and more strongly damped: steps of {} may make it rattle and gain energy; take `steps_per_contact` above {packed:.1}, or a higher restitution",
            si(grain, "s")
        ));
    }
    if clock.substeps > 1 {
        s.row("fluid step", si(clock.dt, "s"), format!("{} grain steps each", clock.substeps));
    }
    if let Some(t) = f.hertz_time {
        s.row("Hertz time", si(t, "s"), format!("of the materials, {:.1} steps", t / grain));
    }
    if let Some(t) = f.rayleigh_time {
        s.row("Rayleigh time", si(t, "s"), format!("step / Rayleigh time {:.3}", grain / t));
    }
}

fn settling(s: &mut Sheet, b: &Built) {
    let f = &b.facts;
    let settle = match b.plan.settle {
        Settle::None => "none".to_string(),
        Settle::For(t) => si(t, "s"),
        Settle::UntilAtRest { speed, .. } => format!("until rms speed < {}", si(speed, "m/s")),
    };
    s.row("settling", settle, "dry, before time 0");
    s.row(
        "largest overlap",
        format!("{:.2} %", 100.0 * f.overlap),
        "of the diameter, expected at that speed",
    );
    if f.overlap > 0.05 {
        s.warn(format!(
            "contacts are soft: an impact at {} overlaps by {:.0} % of a diameter; raise the stiffness",
            si(f.speed, "m/s"),
            100.0 * f.overlap
        ));
    }
}

fn fluid(s: &mut Sheet, b: &Built) {
    let (Some((density, viscosity)), false) = (b.facts.fluid, matches!(b.plan.medium, Medium::Dry)) else {
        return;
    };
    let Facts { diameter: d, grain_density, .. } = b.facts;
    s.group("Fluid");
    s.row("density ratio", format!("{:.3}", grain_density / density), "lightest grains over fluid");
    let speed = b.facts.shake.map_or(0.0, |(a, f)| a * TAU * f);
    if speed > 0.0 {
        let re = density * speed * d / viscosity;
        s.row("particle Reynolds number", format!("{re:.3}"), "diameter, peak shaker velocity");
        s.row("Stokes number", format!("{:.3}", grain_density / density * re / 9.0), "ρ_g/ρ Re/9");
    }
    if !Check::Positive.passes(grain_density - density) && matches!(b.plan.medium, Medium::SimpleDrag(_)) {
        s.warn("the grains are not heavier than the fluid: they will not settle in it");
    }
}

fn coupling(s: &mut Sheet, b: &Built) {
    let sheet = &b.facts.coupling;
    if !sheet.lines.is_empty() {
        s.group("Coupling");
    }
    for (name, value) in &sheet.lines {
        s.row(name.as_str(), value.as_str(), "");
    }
    for warning in &sheet.warnings {
        s.warn(warning.as_str());
    }
}

fn cost(s: &mut Sheet, b: &Built) {
    let n = b.plan.start.len() as f64;
    s.group("Cost");
    // Packed rows, forces and lists: what the engine holds per grain and per contact, about three contacts per grain.
    s.row("memory", si(n * (400.0 + 3.0 * 64.0), "B"), "estimated");
    let work = n * b.plan.clock.end as f64 * b.plan.clock.substeps as f64;
    s.row("particle-steps", format!("{work:.2e}"), "");
    let flow = flow_sheet::step_time(b) * b.plan.clock.end as f64;
    s.row("run time", duration(work / SPEED + flow), "estimated, on one core, without settling");
}

/// The sheet of a case as text, whatever its rung.
///
/// # Errors
/// What is wrong with the case.
pub fn text(case: &brazilnut_case::Case) -> Result<String, crate::Failure> {
    if brazilnut_case::check::is_analytical(case.model()) {
        // An analytical rung costs milliseconds: solving it is the check.
        let report = brazilnut_case::analytic::solve(case, case.model())?;
        return Ok(crate::analytic::sheet(case, &report).to_text(100));
    }
    let built = brazilnut_case::build::build(case)?;
    Ok(sheet(case.values.text("title"), case.model(), &built).to_text(100))
}

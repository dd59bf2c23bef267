//! The fluid of a case, for each rung that has one.

use crate::issue::Issues;
use crate::parts;
use brazilnut_base::values::Values;
use brazilnut_base::{Cell, Side, Vec3};
use brazilnut_coupling::CouplingSpec;
use brazilnut_coupling::averaged::Averaged;
use brazilnut_coupling::{Body, Resolved, SimpleDrag};
use brazilnut_fluid::{FluidSpec, Solid, keys};
use brazilnut_grains::packing::Shape;
use brazilnut_sim::plan::Species;

/// Body of the grains.
#[must_use]
pub fn body(v: &Values, cell: &Cell) -> Body {
    let cylinder = v.tables("grains").any(|g| g.text_opt("shape") == Some("cylinder"));
    Body::of(if cylinder { Shape::Cylinder } else { Shape::Sphere }, cell)
}

/// The rung `simple-drag`.
#[must_use]
pub fn simple_drag(v: &Values, cell: &Cell, species: &[Species]) -> Option<SimpleDrag> {
    let (t, f) = (v.table_opt("simple-drag")?, v.table_opt("fluid")?);
    let diameter = species.iter().map(|s| s.diameter).collect();
    Some(SimpleDrag::read(t, f.number_opt("density")?, f.number_opt("viscosity")?, diameter, body(v, cell)))
}

/// The rung `navier-stokes`.
#[must_use]
pub fn averaged(v: &Values, cell: &Cell, species: &[Species]) -> Option<CouplingSpec> {
    let (t, f) = (v.table_opt("navier-stokes")?, v.table_opt("fluid")?);
    let diameter = species.iter().map(|s| s.diameter).collect();
    let a = Averaged::read(t, f.number_opt("density")?, f.number_opt("viscosity")?, diameter, body(v, cell));
    Some(CouplingSpec::Averaged(a))
}

/// A rung that resolves the fluid around every grain, with the grid spacing it asks for (m).
pub fn resolved(
    v: &Values,
    cell: &Cell,
    species: &[Species],
    issues: &mut Issues,
) -> Option<(CouplingSpec, f64)> {
    let model = v.text("model");
    let (t, f) = (v.table_opt(model)?, v.table_opt("fluid")?);
    let (density, viscosity) = (f.number_opt("density")?, f.number_opt("viscosity")?);
    let smallest = species.iter().map(|s| s.diameter).fold(f64::INFINITY, f64::min);
    match Resolved::read(model, t, density, viscosity, body(v, cell)) {
        Ok(r) => Some((CouplingSpec::Resolved(r), 0.5 * smallest / t.number_opt("points_per_radius")?)),
        Err((key, why)) => {
            let span = t.span(key).or_else(|| v.span("model"));
            issues.add(
                span,
                format!("`{model}` is not complete"),
                why,
                format!("see `brazilnut describe {model}`"),
            );
            None
        }
    }
}

/// The fluid on a grid of cells of edge `spacing` (m), where the case does not say otherwise.
pub fn grid_fluid(v: &Values, cell: &Cell, spacing: f64, issues: &mut Issues) -> Option<FluidSpec> {
    let f = v.table_opt("fluid")?;
    let wanted = f.number_opt("spacing").unwrap_or(spacing);
    // More cells than fit any workstation's memory are a slip of the pen.
    const MOST: f64 = 1e9;
    let count: f64 = (0..3).map(|a| (cell.size[a] / wanted).max(1.0)).product();
    if count.is_nan() || count > MOST {
        issues.add(
            f.span("spacing"),
            "the grid is too fine",
            format!("{count:.1e} cells"),
            "give a larger `fluid.spacing`",
        );
        return None;
    }
    let grid = keys::read_grid(f, cell, spacing);
    let mut spec = FluidSpec::new(grid, f.number_opt("density")?, f.number_opt("viscosity")?);
    keys::read_numerics(f, &mut spec);
    if spec.adaptive && v.text("model") != "fluid" {
        issues.add(
            f.span("steps"),
            "adaptive steps are for a fluid alone",
            "constants of the coupling are defined per step",
            "remove `steps`, and give `time.dt` if the step that is found does not suit",
        );
    }
    for (k, name) in parts::SIDES.iter().enumerate() {
        let Some(side) = f.table_opt(name) else { continue };
        match keys::read_side(side) {
            Ok(boundary) => spec.sides[k / 2][k % 2] = boundary,
            Err(why) => issues.add(f.span(name), format!("`fluid.{name}` is not complete"), why, ""),
        }
    }
    for o in v.tables("obstacles").filter(|o| !o.flag("until_settled")) {
        let (Some(low), Some(high)) = (o.vector_opt("from"), o.vector_opt("to")) else { continue };
        let g = &spec.grid;
        let place = |r: Vec3, a: usize| ((r[a] / g.spacing[a]).round().max(0.0) as usize).min(g.cells[a]);
        let flat = |a: usize| g.sides[a] == Side::Flat;
        let low = std::array::from_fn(|a| if flat(a) { 0 } else { place(low, a) });
        let high = std::array::from_fn(|a| if flat(a) { 1 } else { place(high, a) });
        spec.solids.push(Solid { low, high });
    }
    if let Err(why) = spec.clone().checked() {
        let remedy = "see `brazilnut describe fluid`";
        issues.add(f.span.clone(), "the fluid cannot be set up like this", why.to_string(), remedy);
        return None;
    }
    Some(spec)
}

/// The largest step (s) that the scheme takes for flow no faster than `speed` (m/s), with a margin.
#[must_use]
pub fn largest_step(spec: &FluidSpec, speed: f64) -> f64 {
    // Half of the sharpest limit: the speed is an estimate.
    0.5 * brazilnut_fluid::step_limits(spec, speed).into_iter().map(|l| l.1).fold(f64::INFINITY, f64::min)
}

/// Fastest motion that the case expects of the fluid, m/s, if it says so.
#[must_use]
pub fn largest_speed(v: &Values) -> Option<f64> {
    v.table_opt("fluid")?.number_opt("largest_speed")
}

/// Fastest motion that sides drive the fluid with, m/s.
#[must_use]
pub fn driving_speed(v: &Values) -> f64 {
    let Some(f) = v.table_opt("fluid") else { return 0.0 };
    let sides = parts::SIDES.iter().filter_map(|s| f.table_opt(s));
    sides
        .map(|t| {
            t.vector_opt("velocity")
                .map_or(0.0, |u| u.length())
                .max(t.number_opt("speed").unwrap_or(0.0).abs())
        })
        .fold(0.0, f64::max)
}

//! The analytical rungs: from a case to their figures and tables.

use crate::case::Case;
use crate::issue::Issues;
use crate::parts;
use brazilnut_base::values::Values;
use brazilnut_bed::{Refusals, Report, System, brazil_nut, coupled_columns, kinetic_theory, plug};
use brazilnut_grains::packing::Sizes;
use std::f64::consts::PI;

/// Solves the analytical rung `model` on `case` (which may name another rung).
///
/// # Errors
/// What the model refuses, at the keys at fault.
pub fn solve(case: &Case, model: &str) -> Result<Report, Issues> {
    let v = &case.values;
    let s = system(v);
    let name = table(model);
    let t = v.table_opt(name).expect("the tables of the rungs have defaults");
    let report = match model {
        "kroll" | "modified-kroll" => plug::PlugSpec::from_values(t, &s, model == "modified-kroll")
            .and_then(|spec| plug::solve(&spec))
            .map(|p| p.report()),
        "coupled-columns" => coupled_columns::CoupledColumnsSpec::from_values(t, &s)
            .and_then(|spec| coupled_columns::solve(&spec))
            .map(|c| c.report()),
        "brazil-nut-column" => brazil_nut::BrazilNutSpec::from_values(t, &s)
            .and_then(|spec| brazil_nut::solve(&spec))
            .map(|b| b.report()),
        _ => kinetic_theory::KineticTheorySpec::from_values(t, &s)
            .and_then(|spec| kinetic_theory::solve(&spec))
            .map(|k| k.report()),
    };
    report.map_err(|refusals| refused(case, name, refusals))
}

/// The table that holds the keys of an analytical rung.
#[must_use]
pub fn table(model: &str) -> &'static str {
    match model {
        "kroll" | "modified-kroll" => "plug",
        "coupled-columns" => "coupled-columns",
        "brazil-nut-column" => "brazil-nut-column",
        _ => "kinetic-theory",
    }
}

fn refused(case: &Case, table: &str, refusals: Refusals) -> Issues {
    let mut issues = case.issues();
    for (key, reason) in refusals {
        let own = case.values.table_opt(table).filter(|t| t.is_written(key));
        let shaking = case.values.table_opt("shaking").filter(|t| t.is_written(key));
        let span = own.or(shaking).and_then(|t| t.span(key)).or_else(|| case.values.span("model"));
        issues.add(span, format!("`{table}` cannot use `{key}`"), reason, "");
    }
    issues
}

/// The common tables as these models see them.
#[must_use]
pub fn system(v: &Values) -> System {
    let cell = parts::cell(v);
    let fluid = v.table_opt("fluid");
    let kinds: Vec<Kind> = v.tables("grains").filter_map(|g| kind(v, g)).collect();
    // The bed is the most numerous species; an intruder is a species of few that are larger.
    let host = kinds.iter().max_by_key(|k| k.count);
    let intruder =
        kinds.iter().filter(|k| host.is_some_and(|h| k.count * 20 < h.count && k.diameter > h.diameter));
    let intruder = intruder.min_by_key(|k| k.count);
    let contact = v.table_opt("contact");
    let restitution = |t: Option<&Values>| t?.table_opt("restitution")?.number_opt("value");
    let names = parts::wall_materials(v);
    let wall_pair = contact.and_then(|c| {
        c.tables("pairs").find(|p| {
            p.list("between")
                .iter()
                .any(|x| matches!(x, brazilnut_base::values::Value::Text(s) if names.contains(s)))
        })
    });
    System {
        shake: parts::shaking(v),
        gravity: v.number("gravity"),
        cell_height: cell.map(|c| c.size.z),
        fluid_density: fluid.and_then(|f| f.number_opt("density")),
        viscosity: fluid.and_then(|f| f.number_opt("viscosity")),
        grain_density: host.map(|k| k.density),
        grain_diameter: host.map(|k| k.diameter),
        solids_height: cell.filter(|_| !kinds.is_empty()).map(|c| {
            kinds.iter().map(|k| k.count as f64 * PI / 6.0 * k.diameter.powi(3)).sum::<f64>() / c.base_area()
        }),
        bed_height: None,
        porosity: None,
        restitution: restitution(contact),
        wall_restitution: restitution(wall_pair).or_else(|| restitution(contact)),
        intruder_density: intruder.map(|k| k.density),
        intruder_diameter: intruder.map(|k| k.diameter),
    }
}

/// One species in short.
#[derive(Clone, Copy)]
struct Kind {
    count: i64,
    diameter: f64,
    density: f64,
}

fn kind(v: &Values, g: &Values) -> Option<Kind> {
    let [a, b] = Sizes::read(g.table_opt("diameter")?).ok()?.range();
    let material = g.text_opt("material")?;
    let density = v.named("materials").iter().find(|(n, _)| n == material)?.1.number_opt("density")?;
    Some(Kind { count: g.integer_opt("count").unwrap_or(1), diameter: 0.5 * (a + b), density })
}

//! Does the whole make sense? One small check per concern; each adds what it finds.

use crate::case::Case;
use crate::issue::Issues;
use crate::{parts, walls};
use brazilnut_base::values::Values;

/// Whether a rung moves grains.
#[must_use]
pub fn has_grains(model: &str) -> bool {
    matches!(
        model,
        "dry" | "simple-drag" | "navier-stokes" | "particle-template" | "fluid-springs" | "direct-forcing"
    )
}

/// Whether a rung computes a flow on a grid.
#[must_use]
pub fn has_flow(model: &str) -> bool {
    matches!(model, "fluid" | "navier-stokes" | "particle-template" | "fluid-springs" | "direct-forcing")
}

/// Whether a rung is an analytical one.
#[must_use]
pub fn is_analytical(model: &str) -> bool {
    matches!(model, "kroll" | "modified-kroll" | "coupled-columns" | "brazil-nut-column" | "kinetic-theory")
}

/// All checks that need no assembly.
pub fn check(case: &Case, issues: &mut Issues) {
    let v = &case.values;
    let Some(model) = v.text_opt("model") else { return };
    motions(v, model, issues);
    tables(v, model, issues);
    cell(v, issues);
    sides(v, issues);
    grains(v, model, issues);
    materials(v, model, issues);
    time(v, model, issues);
    observers(v, issues);
}

/// The shaker and what moves on its own.
fn motions(v: &Values, model: &str, issues: &mut Issues) {
    if let Some(s) = v.table_opt("shaking") {
        strength(v, s, "shaking", issues);
    }
    for (path, m) in parts::own_motions(v) {
        strength(v, m, &path, issues);
    }
    if !has_flow(model) {
        return;
    }
    // The grid of the fluid stands still in the cell.
    let moving = v.table_opt("shaking").filter(|_| parts::shakes_the_floor(v)).and_then(|s| s.span("of"));
    for span in
        moving.into_iter().chain(parts::own_motions(v).into_iter().filter_map(|(_, m)| m.span.clone()))
    {
        issues.add(
            Some(span),
            "a wall that moves on its own needs a dry bed",
            format!("the fluid of \"{model}\" does not see it move"),
            "shake the whole cell, or take `dry` or `simple-drag`",
        );
    }
}

/// Exactly one measure of how hard, and gravity where it is needed; `path` leads to the table `s`.
fn strength(v: &Values, s: &Values, path: &str, issues: &mut Issues) {
    let ways = ["gamma", "displacement_amplitude", "peak_velocity"];
    let given: Vec<&str> = ways.into_iter().filter(|w| s.has(w)).collect();
    match given.as_slice() {
        [] if ways.iter().any(|w| issues.is_broken(&format!("{path}.{w}"))) => {}
        [] => issues.add(
            s.span.clone(),
            format!("`{path}` does not say how hard"),
            "one of `gamma`, `displacement_amplitude`, `peak_velocity` is needed",
            "add `gamma = 2.0`",
        ),
        [one] => {
            if *one == "gamma" && v.number_opt("gravity") == Some(0.0) {
                issues.add(
                    s.span(one),
                    "`gamma` means nothing without gravity",
                    "it is the peak acceleration over gravity",
                    "give `displacement_amplitude` or `peak_velocity`",
                );
            }
        }
        [first, others @ ..] => {
            for other in others {
                issues.add(
                    s.span(other),
                    format!("`{path}` is over-determined"),
                    format!("`{first}` says how hard already"),
                    format!(
                        "keep one of {}",
                        given.iter().map(|w| format!("`{w}`")).collect::<Vec<_>>().join(", ")
                    ),
                );
            }
        }
    }
}

/// The tables that a rung cannot do without.
fn tables(v: &Values, model: &str, issues: &mut Issues) {
    let mut need = |name: &str, why: &str| {
        let missing = match v.get(name) {
            None => true,
            Some(brazilnut_base::values::Value::List(l)) => l.is_empty(),
            Some(_) => false,
        };
        if missing && !issues.is_broken(name) {
            let place = v.span("model");
            issues.add(
                place,
                format!("`{name}` is missing"),
                format!("the model \"{model}\" needs it {why}"),
                format!("add a table `{name}`"),
            );
        }
    };
    if has_grains(model) || has_flow(model) {
        need("cell", "to know the room");
        need("time", "to know when to end");
    }
    if has_grains(model) {
        need("grains", "to have something to move");
    }
    if has_flow(model)
        || model == "simple-drag"
        || matches!(model, "modified-kroll" | "kroll" | "coupled-columns" | "brazil-nut-column")
    {
        need("fluid", "for density and viscosity");
    }
    if is_analytical(model) && model != "kinetic-theory" {
        need("shaking", "to throw the bed");
    }
}

fn cell(v: &Values, issues: &mut Issues) {
    let Some(c) = v.table_opt("cell") else { return };
    if c.text_opt("x") == Some("flat") && c.text_opt("y") == Some("flat") {
        issues.add(c.span("y"), "only one direction may be flat", "x is flat already", "");
    }
}

/// What is said of a side must be about a wall, and bumps must hold the grains.
fn sides(v: &Values, issues: &mut Issues) {
    let smallest = v
        .tables("grains")
        .filter_map(|g| brazilnut_grains::packing::Sizes::read(g.table_opt("diameter")?).ok())
        .map(|s| s.range()[0])
        .fold(f64::INFINITY, f64::min);
    let bounds = |axis: &str| v.table_opt("cell").and_then(|c| c.text_opt(axis));
    // Bumps of a two-dimensional cell stand in a row without a hole.
    let flat = ["x", "y"].into_iter().any(|axis| bounds(axis) == Some("flat"));
    for (k, side) in parts::SIDES.iter().enumerate() {
        let Some(table) = walls::side_table(v, side) else { continue };
        let axis = ["x", "y", "z"][k / 2];
        if let Some(bounds) = bounds(axis).filter(|b| *b != "walls") {
            issues.add(
                v.table_opt("walls").and_then(|w| w.span(side)),
                format!("there is no wall `{side}`"),
                format!("the cell is {bounds} along {axis}"),
                "drop it, or give the cell walls there",
            );
        }
        if *side == "floor" && table.has("motion") && parts::shakes_the_floor(v) {
            issues.add(
                table.span("motion"),
                "the floor has two motions",
                "`shaking` moves the floor already",
                "keep one of them",
            );
        }
        if let Some((arrangement, radius)) = walls::bumps(v, side).filter(|_| !flat) {
            let hole = 2.0 * radius * walls::hole(arrangement);
            if smallest <= hole {
                issues.add(
                    table.span("bump_diameter").or_else(|| table.span("surface")),
                    format!("grains fall through the wall `{side}`"),
                    format!("a sphere of {hole:.3e} m passes between its bumps, the smallest grain has {smallest:.3e} m"),
                    "make the bumps smaller",
                );
            }
        }
    }
}

/// Smallest diameter of a grain, m.
const SMALLEST: f64 = 1e-9;

fn grains(v: &Values, model: &str, issues: &mut Issues) {
    let flat = v
        .table_opt("cell")
        .is_some_and(|c| c.text_opt("x") == Some("flat") || c.text_opt("y") == Some("flat"));
    let mut names: Vec<&str> = vec![];
    let mut shapes: Vec<&str> = vec![];
    for (k, g) in v.tables("grains").enumerate() {
        let broken = |key: &str| issues.is_broken(&format!("grains[{k}].{key}"));
        let (count_is_broken, diameter_is_broken) = (broken("count") || broken("at"), broken("diameter"));
        let (Some(name), Some(material)) = (g.text_opt("name"), g.text_opt("material")) else { continue };
        if names.contains(&name) {
            issues.add(
                g.span("name"),
                format!("two species are called \"{name}\""),
                "the second one",
                "give it another name",
            );
        }
        names.push(name);
        let known = v.named("materials");
        if !known.iter().any(|(n, _)| n == material) {
            let hint = brazilnut_base::menu::nearest(material, known.iter().map(|(n, _)| n.as_str()));
            issues.add(
                g.span("material"),
                format!("there is no material \"{material}\""),
                "not under `materials`",
                hint.map_or_else(
                    || format!("add a table `[materials.{material}]`"),
                    |h| format!("did you mean `{h}`?"),
                ),
            );
        }
        if has_grains(model) && !g.has("count") && !g.has("at") && !count_is_broken {
            issues.add(
                g.span.clone(),
                format!("how many grains of \"{name}\"?"),
                "needs `count`, or `at` for a single one",
                "add `count = 100`",
            );
        }
        if g.has("at") && g.integer_opt("count").is_some_and(|n| n != 1) {
            issues.add(
                g.span("count"),
                "a grain with a place is one grain",
                "`at` places a single grain",
                "drop `count` or `at`",
            );
        }
        let shape = g.text_opt("shape").unwrap_or("sphere");
        if shape == "cylinder" && !flat {
            issues.add(
                g.span("shape"),
                "cylinders need a two-dimensional cell",
                "no direction of the cell is flat",
                "add `y = \"flat\"` to `cell`",
            );
        }
        if shapes.first().is_some_and(|s| *s != shape) {
            issues.add(
                g.span("shape"),
                "spheres and cylinders do not mix",
                "the first species has another shape",
                "",
            );
        }
        shapes.push(shape);
        if let Some(d) = g.table_opt("diameter").filter(|_| !diameter_is_broken) {
            let (cause, remedy) = match brazilnut_grains::packing::Sizes::read(d) {
                Err(e) => (e.cause(), e.remedy()),
                Ok(sizes) if sizes.range()[0] < SMALLEST => {
                    (format!("{:e} m is less than a molecule", sizes.range()[0]), "check the unit".into())
                }
                Ok(_) => continue,
            };
            let message = format!("the diameter of \"{name}\" makes no sense");
            issues.add(g.span("diameter"), message, cause, remedy);
        }
    }
    let counts = || v.tables("grains").map(|g| g.integer_opt("count"));
    if has_grains(model) && counts().count() > 0 && counts().all(|n| n == Some(0)) {
        issues.add(
            v.span("grains"),
            "there are no grains",
            "every count is zero",
            "give a `count` above zero",
        );
    }
    if has_grains(model)
        && v.table_opt("start").is_some_and(|s| s.text_opt("placement") == Some("file") && !s.has("file"))
    {
        let start = v.table_opt("start").and_then(|s| s.span("placement"));
        issues.add(
            start,
            "which file?",
            "positions from a file need its name",
            "add `file = \"start.csv\"` to `start`",
        );
    }
}

/// Materials that contact pairs and walls name must exist; `wall` always does.
fn materials(v: &Values, model: &str, issues: &mut Issues) {
    if !has_grains(model) {
        return;
    }
    let walls = crate::parts::wall_materials(v);
    let known = |n: &str| walls.iter().any(|w| w == n) || v.named("materials").iter().any(|(m, _)| m == n);
    let Some(contact) = v.table_opt("contact") else { return };
    for pair in contact.tables("pairs") {
        let between: Vec<&str> = pair
            .list("between")
            .iter()
            .filter_map(|x| match x {
                brazilnut_base::values::Value::Text(s) => Some(s.as_str()),
                _ => None,
            })
            .collect();
        if between.len() != 2 {
            issues.add(
                pair.span("between"),
                "a pair has two materials",
                format!("this has {}", between.len()),
                "write `between = [\"glass\", \"wall\"]`",
            );
        }
        for name in between {
            if !known(name) {
                let names: Vec<String> =
                    walls.iter().cloned().chain(v.named("materials").iter().map(|m| m.0.clone())).collect();
                let hint = brazilnut_base::menu::nearest(name, names.iter().map(String::as_str));
                issues.add(
                    pair.span("between"),
                    format!("there is no material \"{name}\""),
                    "neither under `materials` nor of a wall",
                    hint.map_or_else(String::new, |h| format!("did you mean `{h}`?")),
                );
            }
        }
    }
}

/// The name of an observer is the name of its files.
fn observers(v: &Values, issues: &mut Issues) {
    for o in v.tables("observe") {
        let Some(name) = o.text_opt("name") else { continue };
        let plain = |c: char| c.is_alphanumeric() || matches!(c, '-' | '_' | ' ' | '.');
        if name.is_empty() || name.len() > 100 || name.starts_with('.') || !name.chars().all(plain) {
            issues.add(
                o.span("name"),
                format!("{name:?} cannot name an observer"),
                "its tables are files of this name",
                "use letters, digits, spaces, `-` and `_`",
            );
        }
    }
}

fn time(v: &Values, model: &str, issues: &mut Issues) {
    use brazilnut_base::schedule::Every;
    let Some(t) = v.table_opt("time") else { return };
    if !has_grains(model) && !has_flow(model) {
        return;
    }
    match t.every_opt("end") {
        Some(Every::Cycles(_)) if v.table_opt("shaking").is_none() => issues.add(
            t.span("end"),
            "nothing shakes, so there are no cycles",
            "`end` is in cycles",
            "give a time, or add a table `shaking`",
        ),
        Some(Every::PerCycle(_) | Every::End) => issues.add(
            t.span("end"),
            "`end` is not an end",
            "expected a time or a number of cycles",
            "write `end = \"8 s\"` or `end = \"100 cycles\"`",
        ),
        Some(Every::Time(x)) if x > LONGEST => too_long(t, issues),
        Some(Every::Cycles(n) | Every::Steps(n)) if n as f64 > LONGEST => too_long(t, issues),
        _ => {}
    }
}

/// No run is longer than this, in seconds, cycles or steps: beyond it the counts of steps lose meaning.
const LONGEST: f64 = 1e15;

fn too_long(t: &Values, issues: &mut Issues) {
    issues.add(t.span("end"), "the end is too far away", "no run gets there", "give an `end` below 1e15");
}

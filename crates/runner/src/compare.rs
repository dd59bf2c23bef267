//! Rungs of the ladder on one case, over each other.

use crate::failure::Failure;
use crate::run::{self, Options, Outcome};
use brazilnut_base::figure::{Axis, Body, Curve, Figure, Style};
use brazilnut_base::{Column, Table};
use brazilnut_case::{Case, check};
use brazilnut_report::html::{Content, Report};
use brazilnut_report::text::significant;
use brazilnut_store::{atomic, table};
use std::path::Path;
use std::time::Instant;

/// Observers that every rung with grains gets, so that curves can be laid over each other.
const OBSERVERS: &str = r#"
[[observe]]
what = "bed"
name = "compare-bed"
every = "60 per cycle"

[[observe]]
what = "base-pressure"
name = "compare-pressure"
every = "60 per cycle"
"#;

/// A quantity against phase: degrees, value, standard error.
type Curves = Vec<[f64; 3]>;

/// What one rung gave.
struct Rung {
    model: String,
    gap: Curves,
    pressure: Curves,
    seconds: f64,
}

/// Runs `models` on the case file at `path` into folders of `out` and writes
/// `out/report.html` with the curves over each other.
///
/// # Errors
/// As running each.
pub fn compare(
    path: &Path,
    set: &[String],
    models: &[String],
    out: &Path,
    options: &Options,
) -> Result<Outcome, Failure> {
    let mut cases = vec![];
    for model in models {
        let mut set = set.to_vec();
        set.push(format!("model={model}"));
        let more = if check::has_grains(model) { OBSERVERS } else { "" };
        let case = Case::load_and_append(path, &set, more)?;
        if matches!(model.as_str(), "coupled-columns" | "brazil-nut-column" | "kinetic-theory" | "fluid") {
            return Err(Failure::Usage(format!(
                "`{model}` has no gap or base pressure against phase to compare"
            )));
        }
        cases.push((model, case));
    }
    atomic::make_folder(out)?;
    let mut rungs = vec![];
    for (model, case) in &cases {
        let folder = out.join(model);
        let start = Instant::now();
        let o = Options { out: Some(folder.clone()), ..options.clone() };
        if let stopped @ Outcome::Stopped(_) = run::run(case, &o)? {
            return Ok(stopped);
        }
        let seconds = start.elapsed().as_secs_f64();
        rungs.push(read(model, &folder, seconds)?);
    }
    write(&cases[0].1, out, &rungs)?;
    Ok(Outcome::Done)
}

/// The curves of a finished run.
fn read(model: &str, folder: &Path, seconds: f64) -> Result<Rung, Failure> {
    let tables = folder.join("tables");
    let curve = |file: &str, value: &str, error: &str| -> Result<Curves, Failure> {
        let t = table::read(&tables.join(format!("{file}.csv")))?;
        let column = |n: &str| t.column(n);
        let (Some(phase), Some(y)) = (column("phase"), column(value)) else { return Ok(vec![]) };
        let e = column(error).unwrap_or_else(|| vec![0.0; y.len()]);
        Ok((0..y.len()).map(|k| [phase[k], y[k], e[k]]).collect())
    };
    let (gap, pressure) = if check::has_grains(model) {
        (
            above_rest(curve("compare-bed-by-phase", "gap_percentile", "gap_percentile_error")?),
            curve("compare-pressure-by-phase", "fluid_mean", "fluid_mean_error")?,
        )
    } else {
        (curve("phase", "gap", "")?, curve("phase", "pressure", "")?)
    };
    Ok(Rung { model: model.into(), gap, pressure, seconds })
}

/// Grains of a resting bed do not all touch the floor: the gap counts from its least value in the cycle.
fn above_rest(mut gap: Curves) -> Curves {
    let rest = gap.iter().map(|p| p[1]).fold(f64::INFINITY, f64::min);
    gap.iter_mut().for_each(|p| p[1] -= rest);
    gap
}

fn write(case: &Case, out: &Path, rungs: &[Rung]) -> Result<(), Failure> {
    let figure = |title: &str, unit: &str, pick: fn(&Rung) -> &Curves| {
        Figure {
        title: title.into(),
        caption: "Against the phase of the shake; 0 is the floor moving up at its fastest. Bands: standard error over the cycles. Hydrostatic part removed; the gap of grains counts from its least value in the cycle.".into(),
        body: Body::Curves {
            x: Axis::linear("phase", "deg"),
            y: Axis::linear(&title.to_lowercase(), unit),
            curves: rungs
                .iter()
                .filter(|r| !pick(r).is_empty())
                .map(|r| Curve {
                    label: r.model.clone(),
                    points: pick(r).iter().map(|p| [p[0], p[1]]).collect(),
                    error: if check::has_grains(&r.model) { pick(r).iter().map(|p| p[2]).collect() } else { vec![] },
                    style: if check::has_grains(&r.model) { Style::Line } else { Style::Dashed },
                })
                .collect(),
        },
    }
    };
    let peaks = peaks(rungs);
    let columns = peaks.columns.iter().map(|c| {
        if c.unit == "1" {
            c.name.replace('_', " ")
        } else {
            format!("{} [{}]", c.name.replace('_', " "), c.unit)
        }
    });
    let rows = rungs.iter().zip(&peaks.rows).map(|(r, row)| {
        std::iter::once(r.model.clone()).chain(row.iter().map(|x| significant(*x, 4))).collect()
    });
    let content = Content::Table {
        columns: std::iter::once("model".to_string()).chain(columns).collect(),
        rows: rows.collect(),
        caption: "Extremes of the curves averaged over cycles, and what each rung cost.".into(),
    };
    let html = Report::new(case.values.text("title"))
        .subtitle("rungs of the ladder on one case")
        .section(
            "Curves",
            vec![Content::Figures(vec![
                figure("Pressure under the bed", "Pa", |r| &r.pressure),
                figure("Gap under the bed", "m", |r| &r.gap),
            ])],
        )
        .section("Peaks", vec![content])
        .to_html();
    atomic::write(&out.join("report.html"), html.as_bytes())?;
    table::write(&out.join("peaks.csv"), &peaks)?;
    Ok(())
}

/// Extremes of each rung, in the order given.
fn peaks(rungs: &[Rung]) -> Table {
    let extreme = |c: &Curves, sign: f64| {
        c.iter()
            .map(|p| [p[0], p[1]])
            .max_by(|a, b| (sign * a[1]).total_cmp(&(sign * b[1])))
            .unwrap_or([f64::NAN; 2])
    };
    let columns = [
        ("overpressure", "Pa"),
        ("overpressure_phase", "deg"),
        ("underpressure", "Pa"),
        ("underpressure_phase", "deg"),
        ("largest_gap", "m"),
        ("largest_gap_phase", "deg"),
        ("wall_time", "s"),
    ];
    let mut t = Table { columns: columns.iter().map(|(n, u)| Column::new(*n, *u)).collect(), rows: vec![] };
    for r in rungs {
        let (high, low, gap) = (extreme(&r.pressure, 1.0), extreme(&r.pressure, -1.0), extreme(&r.gap, 1.0));
        t.rows.push(vec![high[1], high[0], low[1], low[0], gap[1], gap[0], r.seconds]);
    }
    t
}

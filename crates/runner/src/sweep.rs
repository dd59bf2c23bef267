//! One case over values of its keys: one table and plots at the end.

use crate::directory::Directory;
use crate::failure::Failure;
use crate::run::{self, Options, Outcome};
use brazilnut_base::figure::{Axis, Body, Curve, Figure, Style};
use brazilnut_base::{Column, Table};
use brazilnut_case::{Case, analytic, check};
use brazilnut_report::html::{Content, Report};
use brazilnut_store::{atomic, table};
use rayon::prelude::*;
use std::path::Path;

/// One key with its values, as written.
struct Swept {
    key: String,
    values: Vec<String>,
}

/// One point: an override per key, and its name.
struct Point {
    set: Vec<String>,
    values: Vec<f64>,
    name: String,
}

/// Runs the case at `path` for every combination of the values in `set`
/// (`key=a,b,c`). Analytical rungs are solved side by side and leave only the
/// table; runs of grains get a folder each, and one that is done is not run again.
///
/// # Errors
/// As running each.
pub fn sweep(path: &Path, set: &[String], out: &Path, options: &Options) -> Result<Outcome, Failure> {
    let axes: Vec<Swept> = set.iter().map(|s| axis(s)).collect::<Result<_, _>>()?;
    if axes.iter().all(|a| a.values.len() < 2) {
        return Err(Failure::Usage("a sweep needs values: `--set shaking.gamma=2,2.5,3`".into()));
    }
    let points = points(&axes);
    let text =
        std::fs::read_to_string(path).map_err(|e| Failure::Usage(format!("{}: {e}", path.display())))?;
    let folder = path.parent().map(Path::to_path_buf).unwrap_or_default();
    let load = |p: &Point| Case::parse(&text, &path.display().to_string(), folder.clone(), &p.set);
    // Every point is read before the first is run: a wrong value costs nothing.
    let cases: Vec<Case> = points.par_iter().map(load).collect::<Result<_, _>>()?;
    atomic::make_folder(out)?;
    let results: Vec<Vec<(Column, f64)>> = if check::is_analytical(cases[0].model()) {
        cases
            .par_iter()
            .map(|c| Ok(scalars(analytic::solve(c, c.model())?.tables)))
            .collect::<Result<_, Failure>>()?
    } else {
        let mut list = vec![];
        for (case, p) in cases.iter().zip(&points) {
            let directory = Directory::new(&out.join(&p.name));
            if !is_done(&directory) {
                let o = Options { out: Some(directory.root.clone()), ..options.clone() };
                let whole = brazilnut_store::checkpoint::list(&directory.checkpoints())?;
                let outcome =
                    if whole.is_empty() { run::run(case, &o)? } else { run::resume(&directory.root, &o)? };
                if let stopped @ Outcome::Stopped(_) = outcome {
                    return Ok(stopped);
                }
            }
            list.push(scalars(tables(&directory)?));
        }
        list
    };
    write(&cases[0], out, &axes, &points, &results)?;
    Ok(Outcome::Done)
}

fn axis(set: &str) -> Result<Swept, Failure> {
    let (key, values) = set
        .split_once('=')
        .ok_or_else(|| Failure::Usage(format!("`{set}` is not KEY=VALUE or KEY=A,B,C")))?;
    // A list in brackets is one value.
    let values = if values.trim_start().starts_with(['[', '{']) {
        vec![values.to_string()]
    } else {
        values.split(',').map(|v| v.trim().to_string()).collect()
    };
    Ok(Swept { key: key.trim().into(), values })
}

/// All combinations, the last key varying fastest.
fn points(axes: &[Swept]) -> Vec<Point> {
    let mut points = vec![Point { set: vec![], values: vec![], name: String::new() }];
    for a in axes {
        let varies = a.values.len() > 1;
        points = points
            .iter()
            .flat_map(|p| {
                a.values.iter().map(move |v| {
                    let mut q = Point { set: p.set.clone(), values: p.values.clone(), name: p.name.clone() };
                    q.set.push(format!("{}={v}", a.key));
                    if varies {
                        q.values.push(brazilnut_base::units::parse(v).map_or(f64::NAN, |x| x.0));
                        let clean = |s: &str| {
                            s.replace(|c: char| !c.is_ascii_alphanumeric() && c != '.' && c != '-', "_")
                        };
                        q.name = [q.name.as_str(), &format!("{}-{}", clean(&a.key), clean(v))]
                            .into_iter()
                            .filter(|s| !s.is_empty())
                            .collect::<Vec<_>>()
                            .join("_");
                    }
                    q
                })
            })
            .collect();
    }
    points
}

fn is_done(directory: &Directory) -> bool {
    std::fs::read_to_string(directory.status()).is_ok_and(|t| t.contains("\"status\": \"done\""))
}

/// The result tables of a finished run.
fn tables(directory: &Directory) -> Result<Vec<(String, Table)>, Failure> {
    let folder = directory.tables();
    let mut names: Vec<_> = std::fs::read_dir(&folder)
        .map_err(|e| Failure::Usage(format!("{}: {e}", folder.display())))?
        .flatten()
        .map(|e| e.path())
        .filter(|p| p.extension().is_some_and(|x| x == "csv"))
        .collect();
    names.sort();
    names
        .into_iter()
        .map(|p| Ok((p.file_stem().unwrap_or_default().to_string_lossy().into_owned(), table::read(&p)?)))
        .collect()
}

/// The numbers of all tables with a single row.
fn scalars(tables: Vec<(String, Table)>) -> Vec<(Column, f64)> {
    tables
        .into_iter()
        .filter(|(_, t)| t.rows.len() == 1)
        .flat_map(|(name, t)| {
            let row = t.rows[0].clone();
            t.columns
                .into_iter()
                .zip(row)
                .map(move |(c, x)| (Column::new(format!("{name}_{}", c.name).replace('-', "_"), c.unit), x))
        })
        .collect()
}

fn write(
    case: &Case,
    out: &Path,
    axes: &[Swept],
    points: &[Point],
    results: &[Vec<(Column, f64)>],
) -> Result<(), Failure> {
    let varied: Vec<&Swept> = axes.iter().filter(|a| a.values.len() > 1).collect();
    // A table that is empty at one point (a bed that is never thrown) must not shift the columns.
    let mut columns: Vec<Column> = vec![];
    for (c, _) in results.iter().flatten() {
        if !columns.contains(c) {
            columns.push(c.clone());
        }
    }
    let mut t = Table::default();
    t.columns.extend(varied.iter().map(|a| Column::new(a.key.replace('.', "_"), "SI")));
    t.columns.extend(columns.iter().cloned());
    for (p, r) in points.iter().zip(results) {
        let value = |c: &Column| r.iter().find(|(d, _)| d == c).map_or(f64::NAN, |(_, x)| *x);
        t.rows.push(p.values.iter().copied().chain(columns.iter().map(value)).collect());
    }
    table::write(&out.join("sweep.csv"), &t)?;
    let mut figures = vec![];
    if let [a] = varied[..] {
        for (k, c) in columns.iter().enumerate() {
            let points: Vec<[f64; 2]> =
                t.rows.iter().map(|r| [r[0], r[k + 1]]).filter(|p| p[1].is_finite()).collect();
            if points.len() > 1 {
                let style = if points.len() > 40 { Style::Line } else { Style::Points };
                figures.push(Figure {
                    title: c.name.replace('_', " "),
                    caption: String::new(),
                    body: Body::Curves {
                        x: Axis::linear(&a.key, "1"),
                        y: Axis::linear(&c.name.replace('_', " "), &c.unit),
                        curves: vec![Curve::line(case.model(), points).styled(style)],
                    },
                });
            }
        }
    }
    let mut content = vec![Content::Figures(figures)];
    if t.rows.len() <= 40 {
        content.push(Content::numbers(&t, "sweep.csv"));
    }
    let html = Report::new(case.values.text("title"))
        .subtitle(format!("sweep of {} points, model {}", points.len(), case.model()))
        .section("Results", content)
        .to_html();
    atomic::write(&out.join("report.html"), html.as_bytes())?;
    Ok(())
}

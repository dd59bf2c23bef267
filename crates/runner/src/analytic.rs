//! Running an analytical rung: the same directory and report as a run of grains.

use crate::directory::Directory;
use crate::failure::Failure;
use crate::report::{self, Shown};
use crate::run::{Options, default_out, make_root};
use crate::status::{Status, commit};
use brazilnut_bed::Report;
use brazilnut_case::{Case, analytic, parts};
use brazilnut_report::sheet::Sheet;
use brazilnut_report::text::significant;
use brazilnut_store::lock::Lock;
use brazilnut_store::{atomic, table};
use std::time::Instant;

/// Solves the case and writes its directory.
///
/// # Errors
/// What the model refuses, or a file that cannot be written.
pub fn run(case: &Case, options: &Options) -> Result<(), Failure> {
    let start = Instant::now();
    let solved = analytic::solve(case, case.model())?;
    let wall_seconds = start.elapsed().as_secs_f64();
    let directory = Directory::new(&options.out.clone().unwrap_or_else(|| default_out(case)));
    make_root(&directory)?;
    let _lock = Lock::take(&directory.root)?;
    directory.claim(options.replace)?;
    atomic::make_folder(&directory.tables())?;
    atomic::write(&directory.case(), case.resolved().as_bytes())?;
    for (name, t) in &solved.tables {
        table::write(&directory.tables().join(format!("{name}.csv")), t)?;
    }
    let status = Status {
        status: "done".into(),
        title: case.values.text("title").into(),
        model: case.model().into(),
        version: env!("CARGO_PKG_VERSION").into(),
        commit: commit(),
        seed: case.values.integer("seed"),
        threads: 1,
        wall_seconds,
        ..Status::default()
    };
    let sheet = sheet(case, &solved);
    let entry = brazilnut_case::models::MENU.iter().find(|e| e.name == case.model());
    let shown = Shown {
        name: case.model().into(),
        summary: entry.map_or(String::new(), |e| format!("{} ({})", e.summary, e.source)),
        figures: solved.figures,
        results: solved.tables,
    };
    report::write(&directory, &status, &sheet, &[shown])?;
    status.write(&directory)?;
    Ok(())
}

/// The start-up sheet: the shake, and the first row of every short table.
#[must_use]
pub fn sheet(case: &Case, solved: &Report) -> Sheet {
    let mut s = Sheet::new(format!("{}: {}", case.values.text("title"), case.model()));
    if let Some((amplitude, frequency)) = parts::fundamental(&case.values) {
        let w = std::f64::consts::TAU * frequency;
        let _ = s
            .group("Shaker")
            .row("frequency", format!("{} Hz", significant(frequency, 4)), "")
            .row("displacement amplitude", format!("{} m", significant(amplitude, 4)), "")
            .row("peak velocity", format!("{} m/s", significant(amplitude * w, 4)), "");
        let g = case.values.number("gravity");
        if g > 0.0 {
            let _ = s.row("Gamma", significant(amplitude * w * w / g, 5), "");
        }
    }
    for (name, t) in solved.tables.iter().filter(|(_, t)| t.rows.len() == 1) {
        let _ = s.group(name.replace('-', " "));
        for (c, x) in t.columns.iter().zip(&t.rows[0]) {
            let unit = if c.unit == "1" { String::new() } else { format!(" {}", c.unit) };
            let _ = s.row(c.name.replace('_', " "), format!("{}{unit}", significant(*x, 6)), "");
        }
    }
    s
}

//! Published results, executable: each study computes what a source prints,
//! beside the printed numbers.
//!
//! A study is a file here, a line in `menu.rs`, and a folder `studies/ID` with
//! what was published (`published.toml`, written by hand), the cases, and a
//! README with the deviations admitted.

mod clement_cavity;
mod clement_cylinder_drag;
mod clement_falling_cylinder;
mod clement_fig_2_4_to_2_7;
mod clement_fig_4_1_to_4_3;
mod clement_fig_5_17;
mod clement_fig_6_11;
mod clement_heap;
mod clement_lubrication;
mod clement_modified_kroll_peaks;
mod clement_sedimentation;
mod clement_sphere_drag;
mod clement_thrown_bed;
mod clement_tilt;
mod fall;
pub mod findings;
mod lan_acceleration;
mod lan_arching;
mod lan_convection;
mod lan_coupling_spectra;
mod lan_depth_profiles;
mod lan_expansion;
mod lan_kinetic_theory;
mod lan_large_sphere;
mod lan_self_diffusion;
mod lan_stiffness;
mod lan_temperature_collisions;
mod layers;
mod maps;
pub mod menu;
mod phases;
mod repeats;
mod runs;
pub mod study;

pub use findings::{Finding, Verdict};
pub use study::{Computed, Ran, Request, Study};

use brazilnut_base::menu::nearest;
use brazilnut_report::html::{Content, Report};
use brazilnut_report::plot;
use brazilnut_runner::Failure;
use brazilnut_store::atomic;
use std::fmt::Write;
use std::path::Path;

/// The studies with their recorded verdicts, as text.
#[must_use]
pub fn list() -> String {
    let mut out = String::new();
    for s in menu::MENU {
        let verdicts: Vec<String> = match findings::published(s) {
            Ok(p) => p.iter().map(|q| q.verdict.name().to_string()).collect(),
            Err(e) => vec![e],
        };
        let count = |v: &str| verdicts.iter().filter(|x| *x == v).count();
        let _ = writeln!(out, "{:<32} {}", s.id, s.title);
        let _ = writeln!(out, "{:<32} {} match, {} deviate", "", count("match"), count("deviates"));
    }
    out
}

/// Runs studies into folders below `out`; the exit code: 1 if a verdict
/// differs from the recorded one.
///
/// # Errors
/// An unknown study, or whatever its runs fail with.
pub fn run(ids: &[String], all: bool, quick: bool, out: &Path) -> Result<u8, Failure> {
    let mut chosen = vec![];
    for id in ids {
        match menu::MENU.iter().find(|s| s.id == id) {
            Some(s) => chosen.push(s),
            None => {
                let near = nearest(id, menu::MENU.iter().map(|s| s.id));
                let hint = near.map(|n| format!("; did you mean `{n}`?")).unwrap_or_default();
                return Err(Failure::Usage(format!(
                    "there is no study `{id}`{hint}; see `brazilnut study list`"
                )));
            }
        }
    }
    if all {
        chosen = menu::MENU.iter().collect();
    }
    if chosen.is_empty() {
        return Err(Failure::Usage("name a study, or say `--all`; see `brazilnut study list`".into()));
    }
    let mut differs = 0;
    for s in chosen {
        let folder = out.join(s.id);
        atomic::make_folder(&folder)?;
        eprintln!("{}{}", s.id, if quick { " (quick)" } else { "" });
        let start = std::time::Instant::now();
        let ran = (s.run)(&Request { quick, out: folder.clone() })?;
        let found = findings::judge(s, &ran.computed, quick).map_err(Failure::Usage)?;
        for f in &found {
            eprintln!("  {}", f.line());
        }
        eprintln!("  {:.1} s", start.elapsed().as_secs_f64());
        differs += found.iter().filter(|f| f.verdict != f.recorded).count();
        write(s, &folder, &ran, &found, quick)?;
    }
    if differs > 0 {
        eprintln!("{differs} verdict(s) differ from the recorded ones");
        return Ok(1);
    }
    Ok(0)
}

fn write(s: &Study, folder: &Path, ran: &Ran, found: &[Finding], quick: bool) -> Result<(), Failure> {
    let mut text = serde_json::to_string_pretty(found).expect("plain data");
    text.push('\n');
    atomic::write(&folder.join("findings.json"), text.as_bytes())?;
    for (k, figure) in ran.figures.iter().enumerate() {
        atomic::write(&folder.join(format!("figure-{}.svg", k + 1)), plot::svg(figure).as_bytes())?;
    }
    let columns = ["quantity", "unit", "computed", "published", "allowed", "verdict", "place"];
    let table = Content::Table {
        columns: columns.map(String::from).into(),
        rows: found.iter().map(Finding::row).collect(),
        caption: String::new(),
    };
    let html = Report::new(s.title)
        .subtitle(format!("study {}{}", s.id, if quick { ", quick form" } else { "" }))
        .section("Findings", vec![table])
        .section("Figures", vec![Content::Figures(ran.figures.clone())])
        .section("About", vec![Content::Verbatim(s.readme.into())])
        .to_html();
    atomic::write(&folder.join("report.html"), html.as_bytes())?;
    Ok(())
}

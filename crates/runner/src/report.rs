//! The report of a run.

use crate::directory::Directory;
use crate::status::Status;
use brazilnut_base::Table;
use brazilnut_base::figure::Figure;
use brazilnut_report::html::{Content, Image, Report};
use brazilnut_report::sheet::Sheet;
use brazilnut_report::text::significant;
use brazilnut_store::{StoreError, atomic};
use std::path::PathBuf;

/// What observers have to show, one entry per observer.
pub struct Shown {
    /// Name of its tables.
    pub name: String,
    /// One sentence of definition.
    pub summary: String,
    /// Plots.
    pub figures: Vec<Figure>,
    /// Results.
    pub results: Vec<(String, Table)>,
}

/// Result tables up to this many rows are printed in the report.
const ROWS: usize = 24;

/// Writes `report.html`.
///
/// # Errors
/// If it cannot be written, or the pictures cannot be read back.
pub fn write(
    directory: &Directory,
    status: &Status,
    sheet: &Sheet,
    shown: &[Shown],
) -> Result<(), StoreError> {
    let measured = shown.iter().flat_map(|s| {
        let mut content = vec![Content::Paragraph(format!("{}: {}", s.name, s.summary))];
        if !s.figures.is_empty() {
            content.push(Content::Figures(s.figures.clone()));
        }
        for (name, table) in &s.results {
            if !table.rows.is_empty() && table.rows.len() <= ROWS {
                content.push(Content::numbers(table, format!("{name} (tables/{name}.csv)")));
            }
        }
        content
    });
    let html = Report::new(status.title.clone())
        .subtitle(format!(
            "model {}, brazilnut {}, {} grains, {} steps, seed {}",
            status.model, status.version, status.grains, status.step, status.seed
        ))
        .section("Notice", notices(status, sheet))
        .section("Pictures", pictures(directory, "bed")?)
        .section("Flow", flow(directory)?)
        .section("Start-up sheet", vec![Content::Sheet(sheet.clone())])
        .section("Measured", measured.collect())
        .section("Energy", energy(status))
        .section("The run", vec![facts(status)])
        .section("Files", vec![Content::Verbatim(FILES.into())])
        .to_html();
    atomic::write(&directory.report(), html.as_bytes())
}

const FILES: &str = "case.toml      the case with every default written out
run.json       status, timings, energy ledger
tables/*.csv   what the observers measured; pandas.read_csv(path, comment=\"#\")
grains.pvd     the grains for ParaView: Glyph, sphere, scale by diameter, factor 1
fields.pvd     the flow for ParaView, where there is one
checkpoints/   to continue: brazilnut resume DIRECTORY";

fn notices(status: &Status, sheet: &Sheet) -> Vec<Content> {
    let all: Vec<String> =
        status.error.iter().chain(&status.warnings).chain(&sheet.warnings).cloned().collect();
    if all.is_empty() { vec![] } else { vec![Content::Warnings(all)] }
}

/// Files of the pictures called `kind` with this `extension`, in the order of time.
fn files(directory: &Directory, kind: &str, extension: &str) -> Vec<PathBuf> {
    let Ok(entries) = std::fs::read_dir(directory.pictures()) else { return vec![] };
    let named = |p: &PathBuf| {
        p.extension().is_some_and(|x| x == extension)
            && p.file_name().is_some_and(|n| n.to_string_lossy().starts_with(kind))
    };
    let mut paths: Vec<PathBuf> = entries.flatten().map(|e| e.path()).filter(named).collect();
    paths.sort();
    paths
}

/// The bed cut open with the fluid's arrows, then fluid and grains side by side.
fn flow(directory: &Directory) -> Result<Vec<Content>, StoreError> {
    let mut content = pictures(directory, "flow")?;
    for p in files(directory, "flow", "json") {
        let text = std::fs::read(&p).map_err(|e| StoreError::io(&p, "read", e))?;
        // A file that something else has damaged is left out: it only shows what the tables hold.
        if let Ok(figures) = serde_json::from_slice::<Vec<Figure>>(&text) {
            content.push(Content::Figures(figures));
        }
    }
    Ok(content)
}

fn pictures(directory: &Directory, kind: &str) -> Result<Vec<Content>, StoreError> {
    let mut images = vec![];
    for p in files(directory, kind, "png") {
        let png = std::fs::read(&p).map_err(|e| StoreError::io(&p, "read", e))?;
        let caption = std::fs::read_to_string(p.with_extension("txt")).unwrap_or_default();
        images.push(Image { png, caption, scale: None });
    }
    Ok(if images.is_empty() { vec![] } else { vec![Content::Images(images)] })
}

fn energy(status: &Status) -> Vec<Content> {
    // The ledger is that of the grains.
    if status.energy.is_empty() || status.grains == 0 {
        return vec![];
    }
    let rows = status.energy.iter().map(|(k, v)| vec![k.replace('_', " "), significant(*v, 6)]).collect();
    let caption = format!(
        "Each entry is summed from its own contributions since time 0, none is a remainder. Largest residual seen over the work put in: {} %.",
        significant(100.0 * status.largest_energy_residual, 3)
    );
    vec![Content::Table { columns: vec!["energy".into(), "J".into()], rows, caption }]
}

fn facts(s: &Status) -> Content {
    let mut sheet = Sheet::new("");
    let _ = sheet
        .row("status", s.status.clone(), "")
        .row("steps per second", significant(s.steps_per_second, 4), "")
        .row(
            "particle-steps per second",
            format!("{} million", significant(s.million_particle_steps_per_second, 4)),
            "",
        )
        .row("wall-clock time", crate::progress::duration(s.wall_seconds), "of this part of the run")
        .row("settling", format!("{} steps", s.settling_steps), "")
        .row(
            "largest overlap",
            format!("{} %", significant(100.0 * s.largest_overlap, 3)),
            "of the smaller radius, as the guards saw it",
        )
        .row("threads", s.threads.to_string(), "");
    for (name, value) in &s.coupling {
        let _ = sheet.row(name.clone(), significant(*value, 3), "");
    }
    for (stage, seconds) in &s.timing {
        let _ = sheet.row(stage.clone(), format!("{} s", significant(*seconds, 3)), "");
    }
    Content::Sheet(sheet)
}

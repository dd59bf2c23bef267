//! Short runs of the bundled cases with a fluid, and what their reports show of it.

use std::path::Path;
use std::process::Command;

/// Runs a bundled case with changes; the text of its report.
fn report(name: &str, changes: &[&str]) -> String {
    let folder = tempfile::tempdir().unwrap();
    let case = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../cases/{name}.toml"));
    let mut command = Command::new(env!("CARGO_BIN_EXE_brazilnut"));
    let _ =
        command.current_dir(folder.path()).args(["run", case.to_str().unwrap(), "--out", "run", "--quiet"]);
    for change in changes {
        let _ = command.args(["--set", change]);
    }
    let out = command.output().unwrap();
    assert!(out.status.success(), "{name} {changes:?}: {}", String::from_utf8_lossy(&out.stderr));
    std::fs::read_to_string(folder.path().join("run/report.html")).unwrap()
}

/// Settling cut short, a few steps, pictures at the end.
const SHORT: [&str; 3] = ["time.settle=1 ms", "time.end=2 ms", "output.pictures=2"];

fn shows_the_flow(html: &str) -> bool {
    html.contains("longest arrow") && html.contains(">Fluid<") && html.contains(">Grains<")
}

#[test]
fn a_partition_with_holes_an_intruder_and_a_cell_without_weight_run() {
    for name in ["partition", "brazil-nut"] {
        assert!(shows_the_flow(&report(name, &SHORT)), "{name}");
    }
    // 50 Hz: the flow is drawn at 135 and 225 degrees of the last cycle.
    let html = report("layers", &["time.end=1 cycles", "grains.0.count=12", "output.pictures=1"]);
    assert!(shows_the_flow(&html));
    assert_eq!(html.matches("longest arrow").count(), 4, "two pictures, each with alternative text");
}

#[test]
fn every_coupled_rung_shows_its_flow() {
    let few = [
        "grains.0.count=4",
        "cell.size=[\"10 mm\", \"6 mm\", \"6 mm\"]",
        "time.end=1 cycles",
        "output.pictures=2",
    ];
    for rung in ["navier-stokes", "particle-template", "fluid-springs", "direct-forcing"] {
        let model = format!("model={rung}");
        let changes: Vec<&str> = few.iter().copied().chain([model.as_str()]).collect();
        assert!(shows_the_flow(&report("layers", &changes)), "{rung}");
    }
}

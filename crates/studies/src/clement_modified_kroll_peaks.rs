//! Peak pressures under a plug of bronze in water (Clément 4.4).

use crate::study::Computed;
use brazilnut_base::figure::{Axis, Body, Curve, Figure, Style};
use brazilnut_base::motion::Motion;
use brazilnut_bed::bed_equation::BedEquation;
use brazilnut_bed::plug::{Plug, PlugSpec, Sample, solve};
use std::f64::consts::TAU;

/// f 10 Hz, Γ 2, h 8.74 mm, φ 0.45 (Clément 4.4); grains and fluid of Clément Table 4.1.
fn spec() -> PlugSpec {
    let f = 10.0;
    PlugSpec {
        shake: Motion::vertical(2.0 * 9.81 / (TAU * f).powi(2), f),
        gravity: 9.81,
        height: 8.74e-3,
        cell_height: Some(20e-3),
        porosity: 0.45,
        diameter: 7e-4,
        grain_density: 8900.0,
        fluid_density: 1000.0,
        viscosity: 1e-3,
        bed_equation: BedEquation::Ergun,
        modified: true,
        tolerance: 1e-10,
        cycles: 100,
        phases: 360,
    }
}

fn solved(spec: &PlugSpec) -> Plug {
    solve(spec).expect("the study's own parameters are valid")
}

/// The published number called `name`.
fn published(name: &str) -> f64 {
    let text = include_str!("../../../studies/clement-modified-kroll-peaks/published.toml");
    let file: toml::Table = text.parse().expect("published.toml is a table");
    let list = file["quantity"].as_array().into_iter().flatten();
    let found = list.filter(|q| q["name"].as_str() == Some(name)).find_map(|q| q["published"].as_float());
    found.expect("the quantity has a published number")
}

/// The porosity between 0.40 and 0.50 at which `value` of the plug is `wanted`; it falls with porosity.
fn porosity_at(value: fn(&Plug) -> f64, wanted: f64) -> f64 {
    let (mut low, mut high) = (0.40, 0.50);
    for _ in 0..40 {
        let porosity = 0.5 * (low + high);
        if value(&solved(&PlugSpec { porosity, ..spec() })) > wanted {
            low = porosity
        } else {
            high = porosity
        }
    }
    0.5 * (low + high)
}

/// The quantities and a plot; the short form is the full one.
#[must_use]
pub fn run(_quick: bool) -> (Vec<Computed>, Vec<Figure>) {
    let modified = solved(&spec());
    let kroll = solved(&PlugSpec { modified: false, ..spec() });
    let peaks = &modified.peaks;
    let (over, under) = (published("overpressure"), published("underpressure"));
    let computed = vec![
        Computed::new("overpressure", peaks.viscous_over.value),
        Computed::new("underpressure", peaks.viscous_under.value),
        Computed::new("take-off phase", modified.takeoff_phase().unwrap_or(f64::NAN)),
        Computed::new(
            "porosity for the published overpressure",
            porosity_at(|p| p.peaks.viscous_over.value, over),
        ),
        Computed::new(
            "porosity for the published underpressure",
            porosity_at(|p| -p.peaks.viscous_under.value, -under),
        ),
    ];
    let curve = |label: &str, plug: &Plug, value: fn(&Sample) -> f64| {
        Curve::line(label, plug.samples().iter().map(|s| [s.phase, value(s)]).collect())
    };
    let points = vec![[peaks.viscous_over.phase, over], [peaks.viscous_under.phase, under]];
    let figure = Figure {
        title: "Pressure under bronze in water".into(),
        caption: "Hydrostatic part removed. The published peaks are drawn at the computed phases: only their values are printed.".into(),
        body: Body::Curves {
            x: Axis::linear("phase", "deg"),
            y: Axis::linear("pressure", "Pa"),
            curves: vec![
                curve("modified Kroll, flow through the bed", &modified, |s| s.viscous_pressure),
                curve("modified Kroll, with the fluid's inertia", &modified, |s| s.pressure).styled(Style::Dashed),
                curve("Kroll", &kroll, |s| s.pressure).styled(Style::Dashed),
                Curve::line("published peaks", points).styled(Style::Points),
            ],
        },
    };
    (computed, vec![figure])
}

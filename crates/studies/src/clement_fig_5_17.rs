//! The partition instability in the coupled-column model (Clément 5.7, Fig. 5.17).

use crate::study::Computed;
use brazilnut_base::figure::{Axis, Body, Curve, Figure, Style};
use brazilnut_base::motion::Motion;
use brazilnut_bed::bed_equation::BedEquation;
use brazilnut_bed::coupled_columns::{
    CoupledColumns, CoupledColumnsSpec, PressureRatio, Resistance, collapse_exponent, solve,
};
use std::f64::consts::TAU;

const GAMMAS: [f64; 4] = [2.25, 2.5, 3.0, 3.5];

/// Clément Table 5.1, c of Clément 5.7, φ 0.42; the equations as printed.
fn spec(gamma: f64) -> CoupledColumnsSpec {
    let f = 15.0;
    CoupledColumnsSpec {
        shake: Motion::vertical(gamma * 9.81 / (TAU * f).powi(2), f),
        gravity: 9.81,
        total_height: 40e-3,
        height_difference: 4e-3,
        cell_height: Some(90e-3),
        porosity: 0.42,
        diameter: 725e-6,
        grain_density: 4500.0,
        fluid_density: 1000.0,
        viscosity: 8.91e-4,
        bed_equation: BedEquation::ErgunKozeny,
        area_ratio: 2.5,
        coupling: 0.019,
        pressure_ratio: PressureRatio::Constant(1.0),
        buoyant: false,
        resistance: Resistance::Bed,
        relaunch: false,
        duration: 60.0,
        tolerance: 1e-8,
        phases: 360,
    }
}

/// One run for each Γ, with a change to the printed equations.
fn runs(change: impl Fn(CoupledColumnsSpec) -> CoupledColumnsSpec) -> [CoupledColumns; 4] {
    GAMMAS.map(|g| solve(&change(spec(g))).expect("the study's own parameters are valid"))
}

/// τ = 100 Γ^−2.6 s (Clément 5.3).
fn tau(gamma: f64) -> f64 {
    100.0 * gamma.powf(-2.6)
}

/// Times to reach a height difference (m), s.
fn times(runs: &[CoupledColumns; 4], difference: f64) -> [f64; 4] {
    runs.each_ref().map(|r| r.time_to(difference).unwrap_or(f64::NAN))
}

fn exponent(runs: &[CoupledColumns; 4]) -> f64 {
    let t = times(runs, 8e-3);
    collapse_exponent(&std::array::from_fn::<_, 4, _>(|k| (GAMMAS[k], t[k])))
}

/// The quantities and plots; the short form is the full one.
#[must_use]
pub fn run(_quick: bool) -> (Vec<Computed>, Vec<Figure>) {
    let printed = runs(|s| s);
    let flow =
        runs(|s| CoupledColumnsSpec { resistance: Resistance::Fluid, tolerance: 1e-7, duration: 20.0, ..s });
    let buoyant = runs(|s| CoupledColumnsSpec { buoyant: true, tolerance: 1e-7, duration: 20.0, ..s });
    let lifted = runs(|s| CoupledColumnsSpec { relaunch: true, duration: 30.0, ..s });

    let early = times(&printed, 8e-3);
    let late: Vec<f64> = times(&printed, 16e-3).iter().zip(GAMMAS).map(|(t, g)| t / tau(g)).collect();
    let spread =
        late.iter().copied().fold(0.0, f64::max) / late.iter().copied().fold(f64::INFINITY, f64::min) - 1.0;
    let order = early.windows(2).map(|w| w[0] / w[1]).fold(f64::INFINITY, f64::min);
    let [shallow, deep] = printed[1].landing_phases.map(|p| p.unwrap_or(f64::NAN));
    let mut computed = vec![
        Computed::new("collapse exponent", exponent(&printed)),
        Computed::new("collapse exponent, resistance of the flow", exponent(&flow)),
        Computed::new("collapse exponent, buoyant", exponent(&buoyant)),
        Computed::new("spread of t/tau at 16 mm", spread),
        Computed::new("least speed-up from one acceleration to the next", order),
        Computed::new("landing of the deep column, gamma 2.5", deep),
        Computed::new("lead of the shallow column's landing, gamma 2.5", deep - shallow),
        Computed::new("height difference at 25 s, gamma 2.5", 1e3 * printed[1].difference_at(25.0)),
    ];
    for (t, g) in early.iter().zip(GAMMAS) {
        computed.push(Computed::new(format!("t/tau at 8 mm, gamma {g}"), t / tau(g)));
    }
    (
        computed,
        vec![
            growth(&printed),
            collapse(&printed),
            variants([&printed[1], &flow[1], &buoyant[1], &lifted[1]]),
        ],
    )
}

/// Δh (mm) over time in units of `unit(Γ)`.
fn curve(label: String, run: &CoupledColumns, unit: f64) -> Curve {
    Curve::line(label, run.history.iter().map(|m| [m.time / unit, 1e3 * (m.h2 - m.h1)]).collect())
}

fn figure(title: &str, caption: &str, x: Axis, curves: Vec<Curve>) -> Figure {
    Figure {
        title: title.into(),
        caption: caption.into(),
        body: Body::Curves { x, y: Axis::linear("height difference", "mm"), curves },
    }
}

fn growth(printed: &[CoupledColumns; 4]) -> Figure {
    let curves = printed.iter().map(|r| curve(format!("Γ = {:.2}", r.gamma), r, 1.0)).collect();
    figure("Height difference", "The equations as printed, c = 0.019.", Axis::linear("time", "s"), curves)
}

fn collapse(printed: &[CoupledColumns; 4]) -> Figure {
    let curves = printed.iter().map(|r| curve(format!("Γ = {:.2}", r.gamma), r, tau(r.gamma))).collect();
    let caption = "The same over t/τ, τ = 100 Γ^−2.6 s.";
    figure("Collapse", caption, Axis::linear("time over tau", "1"), curves)
}

fn variants([printed, flow, buoyant, lifted]: [&CoupledColumns; 4]) -> Figure {
    let curves = vec![
        curve("as printed".into(), printed, 1.0),
        curve("resistance at the speed of the flow".into(), flow, 1.0).styled(Style::Dashed),
        curve("with buoyancy and inertia of the fluid".into(), buoyant, 1.0).styled(Style::Dashed),
        curve("as printed, but the flow may lift a landed bed".into(), lifted, 1.0).styled(Style::Dashed),
    ];
    figure(
        "Variants at Γ = 2.5",
        "What the printed equations leave out, at the same c.",
        Axis::linear("time", "s"),
        curves,
    )
}

//! A bed of glass or bronze in water, thrown by a shaken cell (Clément 3.2, Table 3.1, Figs 3.1, 3.2).

use crate::phases::{PhaseCurve, largest, least};
use crate::runs::Done;
use crate::study::{Computed, Ran, Request};
use brazilnut_base::figure::{Axis, Body, Curve, Figure, Style};
use brazilnut_base::motion::Motion;
use brazilnut_bed::bed_equation::BedEquation;
use brazilnut_bed::plug::{Plug, PlugSpec, solve};
use brazilnut_runner::Failure;
use std::f64::consts::TAU;

const CASE: (&str, &str) =
    ("studies/clement-thrown-bed/case.toml", include_str!("../../../studies/clement-thrown-bed/case.toml"));

/// Materials of the two beds with their densities, kg/m³.
const MATERIALS: [(&str, f64); 2] = [("glass", 2500.0), ("bronze", 8900.0)];

/// A rung as it is run: what it is called, and what it lays over the case.
struct Rung {
    name: &'static str,
    model: &'static str,
    short: bool,
    overrides: &'static [&'static [&'static str]],
}

/// `navier-stokes` and the springs of C_s = 0.5 first: they are what the source recommends (Fig. 3.2).
const RUNGS: [Rung; 8] = [
    Rung { name: "navier-stokes", model: "navier-stokes", short: true, overrides: &[] },
    Rung { name: "fluid-springs", model: "fluid-springs", short: false, overrides: &[&RESOLVED] },
    Rung { name: "particle-template", model: "particle-template", short: false, overrides: &[&RESOLVED] },
    Rung { name: "direct-forcing", model: "direct-forcing", short: false, overrides: &[&RESOLVED] },
    Rung {
        name: "C_s 0.1",
        model: "fluid-springs",
        short: false,
        overrides: &[&RESOLVED, &["fluid-springs.relaxation_time=2.9e-3 s"]],
    },
    Rung {
        name: "C_s 0.2",
        model: "fluid-springs",
        short: false,
        overrides: &[&RESOLVED, &["fluid-springs.relaxation_time=7.2e-4 s"]],
    },
    // Stronger springs bear shorter steps only.
    Rung {
        name: "C_s 1",
        model: "fluid-springs",
        short: false,
        overrides: &[&RESOLVED, &["fluid-springs.relaxation_time=2.9e-5 s", "time.dt=2.5e-5 s"]],
    },
    Rung {
        name: "C_s 2",
        model: "fluid-springs",
        short: false,
        overrides: &[&RESOLVED, &["fluid-springs.relaxation_time=7.2e-6 s", "time.dt=6.25e-6 s"]],
    },
];

/// The step of the thesis's later chapters, less clear fluid above the bed, two cycles after the first.
const RESOLVED: [&str; 5] = [
    "time.dt=1e-4 s",
    "cell.size=[\"4 mm\", \"4 mm\", \"22 mm\"]",
    "time.end=3 cycles",
    "observe.0.from=0.05 s",
    "observe.1.from=0.05 s",
];

/// What the short form lays over all: a narrower bed as deep, longer fluid steps, one cycle after two.
const QUICK: [&str; 4] = [
    "cell.size=[\"2.8 mm\", \"2.8 mm\", \"30 mm\"]",
    "grains.0.count=294",
    "time.dt=5e-5 s",
    "time.end=3 cycles",
];

/// Curves of one run, averaged over cycles.
struct Run {
    name: &'static str,
    pressure: PhaseCurve,
    gap: PhaseCurve,
    /// The modified Kroll plug as high and as porous as this bed at rest.
    plug: Plug,
}

impl Run {
    fn new((material, density): (&str, f64), rung: &Rung, request: &Request) -> Result<Self, Failure> {
        let mut overrides = vec![format!("model={}", rung.model), format!("grains.0.material={material}")];
        overrides.extend(rung.overrides.iter().copied().flatten().map(|s| (*s).to_string()));
        if request.quick {
            overrides.extend(QUICK.map(String::from));
        }
        let folder = request.out.join(format!("{material}-{}", rung.name));
        let run = Done::new(CASE, &overrides, &folder, !request.quick)?;
        let bed = run.table("bed-by-phase")?;
        let curve = |name: &str| PhaseCurve::read(&bed, name);
        // The bed lies on the floor at phase 0: what it measures there is its state at rest.
        let at_rest = |name: &str| curve(name).points.first().map_or(f64::NAN, |p| p[1]);
        Ok(Self {
            name: rung.name,
            pressure: PhaseCurve::read(&run.table("base-pressure-by-phase")?, "fluid_mean"),
            gap: curve("gap_percentile").above_least(),
            plug: plug(density, at_rest("height_threshold"), 1.0 - at_rest("bulk_solids_fraction"))?,
        })
    }

    fn over(&self) -> f64 {
        largest(&self.pressure.points)[1]
    }

    /// Largest base pressure, least base pressure of the first half of the cycle and largest gap over those
    /// of the plug: the plug has no pressure of the landing itself, where a bed that stops draws fluid on.
    fn ratios(&self) -> [(&'static str, f64); 3] {
        let peaks = &self.plug.peaks;
        let thrown: Vec<[f64; 2]> = self.pressure.points.iter().copied().filter(|p| p[0] < 180.0).collect();
        [
            ("overpressure", self.over() / peaks.over.value),
            ("underpressure", least(&thrown)[1] / peaks.under.value),
            ("gap", largest(&self.gap.points)[1] / peaks.gap.value),
        ]
    }
}

/// The modified Kroll plug of Table 3.1 with Ergun, for a bed of `height` (m) and `porosity`.
fn plug(grain_density: f64, height: f64, porosity: f64) -> Result<Plug, Failure> {
    let f = 20.0;
    let spec = PlugSpec {
        shake: Motion::vertical(2.0 * 9.81 / (TAU * f).powi(2), f),
        gravity: 9.81,
        height,
        cell_height: None,
        porosity,
        diameter: 7e-4,
        grain_density,
        fluid_density: 1000.0,
        viscosity: 8.91e-4,
        bed_equation: BedEquation::Ergun,
        modified: true,
        tolerance: 1e-10,
        cycles: 100,
        phases: 360,
    };
    solve(&spec).map_err(|refusals| Failure::Usage(format!("no plug like this bed: {refusals:?}")))
}

/// What is judged of one material's runs.
fn judged(material: &str, runs: &[Run]) -> Vec<Computed> {
    let mut list = vec![];
    for r in runs {
        let ratios = r.ratios();
        match r.name {
            // The source only says that it fails.
            "particle-template" => {
                let worst = ratios.iter().map(|(_, x)| (x - 1.0).abs()).fold(0.0, f64::max);
                let name = format!("{material}, {}: largest deviation from modified Kroll's", r.name);
                list.push(Computed::new(name, worst));
            }
            // Their plug would be another one: against the springs of 0.5.
            name if name.starts_with("C_s") => {
                let half = runs.iter().find(|r| r.name == "fluid-springs").map_or(f64::NAN, Run::over);
                let name = format!("{material}, {name}: overpressure over that at C_s 0.5");
                list.push(Computed::new(name, r.over() / half));
            }
            name => list.extend(ratios.map(|(what, x)| {
                Computed::new(format!("{material}, {name}: {what} over modified Kroll's"), x)
            })),
        }
    }
    list
}

/// The quantities and plots. Full form: all rungs of Fig. 3.2 and strengths of Fig. 3.1, both materials.
///
/// # Errors
/// Whatever a run fails with.
pub fn run(request: &Request) -> Result<Ran, Failure> {
    let (mut computed, mut figures) = (vec![], vec![]);
    for material in MATERIALS {
        let rungs = RUNGS.iter().filter(|r| r.short || !request.quick);
        let runs: Vec<Run> = rungs.map(|r| Run::new(material, r, request)).collect::<Result<_, _>>()?;
        for r in &runs {
            eprintln!(
                "  {} {}: bed {:.2} mm, porosity {:.3}; modified Kroll {:.1}, {:.1} Pa, gap {:.3} mm",
                material.0,
                r.name,
                1e3 * r.plug.spec.height,
                r.plug.spec.porosity,
                r.plug.peaks.over.value,
                r.plug.peaks.under.value,
                1e3 * r.plug.peaks.gap.value
            );
        }
        computed.extend(judged(material.0, &runs));
        figures.extend(plots(material.0, &runs));
    }
    Ok(Ran { computed, figures })
}

fn plots(material: &str, runs: &[Run]) -> [Figure; 2] {
    let figure = |title: &str,
                  unit: &str,
                  curve: fn(&Run) -> &PhaseCurve,
                  plug: fn(&Run) -> Vec<[f64; 2]>| {
        let own = runs
            .iter()
            .map(|r| Curve { error: curve(r).error.clone(), ..Curve::line(r.name, curve(r).points.clone()) });
        let kroll = runs.first().map(|r| Curve::line("modified Kroll", plug(r)).styled(Style::Dashed));
        Figure {
            title: format!("{title}, {material}"),
            caption: "Averaged over cycles; phase 0 is the floor moving up at its fastest. Bands: standard error. Modified Kroll with Ergun for the measured height and porosity of the bed of navier-stokes.".into(),
            body: Body::Curves {
                x: Axis::linear("phase", "deg"),
                y: Axis::linear(&title.to_lowercase(), unit),
                curves: own.chain(kroll).collect(),
            },
        }
    };
    [
        figure(
            "Base pressure",
            "Pa",
            |r| &r.pressure,
            |r| r.plug.samples().iter().map(|s| [s.phase, s.pressure]).collect(),
        ),
        figure(
            "Gap under the bed",
            "m",
            |r| &r.gap,
            |r| r.plug.samples().iter().map(|s| [s.phase, s.gap]).collect(),
        ),
    ]
}

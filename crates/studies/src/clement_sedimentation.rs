//! 200 sedimenting cylinders by three rungs (Clément 2009, 2.6.2, Table 2.6, Figs 2.27-2.31).

use crate::runs::{Done, Frame, column};
use crate::study::{Computed, Ran, Request};
use brazilnut_base::Table;
use brazilnut_base::figure::{Axis, Body, Curve, Figure, Style};
use brazilnut_runner::Failure;

const CASE: (&str, &str) = (
    "studies/clement-sedimentation/case.toml",
    include_str!("../../../studies/clement-sedimentation/case.toml"),
);

/// The rungs and their names in Clément's thesis.
const RUNGS: [(&str, &str); 3] =
    [("navier-stokes", "NS"), ("particle-template", "PT"), ("fluid-springs", "FS")];

/// Printed step, s, spacing of the resolved rungs, m, and strength of the springs (Table 2.6).
const STEP: f64 = 1e-4;
const FINE: f64 = 1e-4;
const STRENGTH: f64 = 0.5;
/// Printed spacing of NS, m.
const COARSE: f64 = 4.4e-3;
/// Radius, m.
const RADIUS: f64 = 1e-3;
/// Excess of the cylinders' density over that of the fluid.
const EXCESS: f64 = 0.05;
/// Times of the printed pictures that are drawn, s; the third is at 4.5 s.
const SHOTS: [f64; 2] = [1.5, 3.0];

/// C_s that gives on a grid of `spacing` (m) with the step `dt` (s) the relaxation time of the printed springs:
/// C_s² M_r/(n dt) is the same (Clément eq. 2.95, 2.97).
fn strength(spacing: f64, dt: f64) -> f64 {
    let tracers = |h: f64| std::f64::consts::PI * (RADIUS / h) * (RADIUS / h);
    // Mass of the template in cells of fluid, M_t/dM = (s - 1) n.
    let reduced = |h: f64| EXCESS * tracers(h) / (EXCESS * tracers(h) + 1.0);
    let per_tracer = |h: f64| reduced(h) / tracers(h);
    STRENGTH * (dt / STEP * per_tracer(FINE) / per_tracer(spacing)).sqrt()
}

/// One run.
struct Bed {
    short: &'static str,
    bed: Table,
    frames: Vec<Frame>,
    flows: Vec<Table>,
}

impl Bed {
    /// The resolved rungs on a grid of `spacing` (m), all with the step `dt` (s).
    fn new(rung: usize, spacing: f64, dt: f64, request: &Request) -> Result<Self, Failure> {
        let (model, short) = RUNGS[rung];
        let mut overrides = vec![
            format!("model={model}"),
            format!("fluid.spacing={} m", if rung == 0 { COARSE } else { spacing }),
            format!("time.dt={dt} s"),
        ];
        if rung == 0 {
            // The force as printed (2.76): what conserves momentum is unstable where such light cylinders pack.
            overrides.push("navier-stokes.formulation=printed".into());
        }
        if rung == 2 {
            overrides.push(format!("fluid-springs.c_s={}", strength(spacing, dt)));
        }
        overrides.push(format!("time.end={} s", if request.quick { 0.6 } else { 3.0 }));
        let run = Done::new(CASE, &overrides, &request.out.join(short.to_lowercase()), !request.quick)?;
        let flows = if request.quick { 0 } else { SHOTS.len() };
        let flow = |k: usize| run.table(&format!("flow-{k}-field"));
        Ok(Self {
            short,
            bed: run.table("bed")?,
            frames: run.frames()?,
            flows: (0..flows).map(flow).collect::<Result<_, _>>()?,
        })
    }

    /// A column of the bed over time.
    fn series(&self, name: &str) -> Vec<[f64; 2]> {
        column(&self.bed, "time").into_iter().zip(column(&self.bed, name)).map(|(t, v)| [t, v]).collect()
    }

    /// Mean velocity of the bed along an axis, m/s, from its centre over a tenth of a second.
    fn velocity(&self, name: &str) -> Vec<[f64; 2]> {
        let path = self.series(name);
        path.windows(11).map(|w| [w[5][0], (w[10][1] - w[0][1]) / (w[10][0] - w[0][0])]).collect()
    }

    /// How far the bed has fallen at `time` (s), m.
    fn fallen(&self, time: f64) -> f64 {
        let path = self.series("centre_of_mass_z");
        let at = path.iter().find(|p| p[0] >= time - 1e-9).map_or(f64::NAN, |p| p[1]);
        path[0][1] - at
    }

    /// Standard deviation of the vertical velocities of the cylinders at the time of a picture, m/s.
    fn spread(&self, time: f64) -> f64 {
        let Some(f) = self.frames.iter().find(|f| (f.time - time).abs() < 1e-3) else { return f64::NAN };
        let n = f.velocity.len() as f64;
        let mean = f.velocity.iter().map(|v| v[2]).sum::<f64>() / n;
        (f.velocity.iter().map(|v| (v[2] - mean).powi(2)).sum::<f64>() / n).sqrt()
    }

    /// The cylinders and the flow at picture `k`.
    fn picture(&self, k: usize) -> Figure {
        let field = &self.flows[k];
        let [x, z, u, w] = ["x", "z", "mixture_x", "mixture_z"].map(|c| column(field, c));
        let arrows = (0..x.len())
            .filter(|&i| u[i].is_finite() && w[i].is_finite())
            .map(|i| ([x[i], z[i]], [u[i], w[i]]))
            .collect();
        let circle = |c: &[f64; 3]| {
            let angle = |i: i32| f64::from(i) * std::f64::consts::TAU / 24.0;
            (0..=24).map(|i| [c[0] + RADIUS * angle(i).cos(), c[2] + RADIUS * angle(i).sin()]).collect()
        };
        let frame = self.frames.iter().find(|f| (f.time - SHOTS[k]).abs() < 1e-3);
        Figure {
            title: format!("{} at {} s", self.short, SHOTS[k]),
            caption: "Cylinders, and the mean velocity of fluid and cylinders in cells of 2.2 mm.".into(),
            body: Body::Map {
                x: Axis::linear("x", "m"),
                y: Axis::linear("z", "m"),
                raster: None,
                arrows,
                arrow_unit: "m/s".into(),
                lines: frame.map_or(vec![], |f| f.position.iter().map(circle).collect()),
            },
        }
    }
}

/// The quantities and plots. Full form: the subset that decides.
///
/// # Errors
/// Whatever a run fails with.
pub fn run(request: &Request) -> Result<Ran, Failure> {
    let (spacing, dt) = (if request.quick { 4e-4 } else { 2e-4 }, 2e-4);
    let beds: Vec<Bed> = (0..3).map(|rung| Bed::new(rung, spacing, dt, request)).collect::<Result<_, _>>()?;
    let [ns, pt, fs] = &beds[..] else { return Ok(Ran::default()) };
    let mut computed = vec![];
    let times: &[f64] = if request.quick { &[0.5] } else { &[0.5, 1.5, 3.0] };
    for &t in times {
        for bed in [ns, pt] {
            let name = format!("way fallen by {t} s, {} over FS", bed.short);
            computed.push(Computed::new(name, bed.fallen(t) / fs.fallen(t)));
        }
    }
    let mut figures = histories(&beds);
    if !request.quick {
        let apart = |a: &Bed, b: &Bed| a.spread(1.5) / b.spread(1.5);
        computed.push(Computed::new("spread of the falling speeds at 1.5 s, NS over FS", apart(ns, fs)));
        computed.push(Computed::new("spread of the falling speeds at 1.5 s, PT over FS", apart(pt, fs)));
        for bed in &beds {
            figures.extend((0..SHOTS.len()).map(|k| bed.picture(k)));
        }
    }
    Ok(Ran { computed, figures })
}

/// Figure 2.31.
fn histories(beds: &[Bed]) -> Vec<Figure> {
    let style = |short: &str| match short {
        "NS" => Style::Dashed,
        _ => Style::Line,
    };
    let figure = |title: &str, unit: &str, of: &dyn Fn(&Bed) -> Vec<[f64; 2]>| Figure {
        title: title.into(),
        caption: "Mean over the cylinders.".into(),
        body: Body::Curves {
            x: Axis::linear("time", "s"),
            y: Axis::linear(title, unit),
            curves: beds.iter().map(|b| Curve::line(b.short, of(b)).styled(style(b.short))).collect(),
        },
    };
    vec![
        figure("vertical velocity", "m/s", &|b| b.velocity("centre_of_mass_z")),
        figure("horizontal velocity", "m/s", &|b| b.velocity("centre_of_mass_x")),
        figure("vertical position", "m", &|b| b.series("centre_of_mass_z")),
        figure("horizontal position", "m", &|b| b.series("centre_of_mass_x")),
    ]
}

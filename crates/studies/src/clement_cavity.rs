//! Flow in a square cavity driven by its lid (Clément 2.2.3, Figs 2.10-2.12).

use crate::runs::{Done, column};
use crate::study::{Computed, Ran, Request};
use brazilnut_base::figure::{Axis, Body, Curve, Figure, Style};
use brazilnut_runner::Failure;

const CASE: (&str, &str) =
    ("studies/clement-cavity/case.toml", include_str!("../../../studies/clement-cavity/case.toml"));

/// Published profiles along the two centre lines (Erturk et al. 2005).
const UPRIGHT: &str = include_str!("../../../studies/clement-cavity/cavity_erturk2005_u.csv");
const LEVEL: &str = include_str!("../../../studies/clement-cavity/cavity_erturk2005_v.csv");

/// Side of the cavity, m, and kinematic viscosity of water, m²/s (Table 2.3).
const LENGTH: f64 = 0.01;
const VISCOSITY: f64 = 1e-6;

/// One run: times in units of side over lid speed.
struct Plan {
    reynolds: u32,
    cells: u32,
    step: f64,
    end: f64,
    /// Time over which the flow is averaged before the end.
    mean: f64,
}

const COARSE: Plan = Plan { reynolds: 1000, cells: 128, step: 3.5e-3, end: 100.0, mean: 1.0 };
const QUICK: [Plan; 1] = [Plan { end: 40.0, ..COARSE }];
/// Streamfunction, over lid speed and side, of a vortex too faint for a figure: theory has weaker and weaker ones in every corner.
const FAINT: f64 = 1e-5;
/// Reynolds number from which on the flow swings for ever: its mean is taken.
const ONSET: u32 = 8000;
/// Steps: 0.9 of the scheme's limit with both components at the lid's speed.
const FULL: [Plan; 4] = [
    COARSE,
    Plan { cells: 256, step: 1.75e-3, end: 150.0, ..COARSE },
    Plan { reynolds: 5000, cells: 256, step: 1.3e-3, end: 600.0, ..COARSE },
    Plan { reynolds: 10_000, cells: 256, step: 1e-3, end: 900.0, mean: 200.0 },
];

/// An extremum of the streamfunction, in units of lid speed and side.
#[derive(Clone, Copy)]
struct Vortex {
    streamfunction: f64,
    x: f64,
    z: f64,
    vorticity: f64,
}

/// What a run gave, in units of lid speed and side.
struct Flow {
    plan: &'static Plan,
    /// (z, v_x) on the upright centre line, walls included.
    upright: Vec<[f64; 2]>,
    /// (x, v_z) on the level one.
    level: Vec<[f64; 2]>,
    /// The strongest first.
    vortices: Vec<Vortex>,
    /// Change of the main vortex over the last tenth of the run, over itself.
    drift: f64,
}

impl Flow {
    fn new(plan: &'static Plan, request: &Request) -> Result<Self, Failure> {
        let &Plan { reynolds, cells, .. } = plan;
        let speed = f64::from(reynolds) * VISCOSITY / LENGTH;
        let turn = LENGTH / speed;
        let half = 0.5 * LENGTH / f64::from(cells);
        let (first, last, middle) = (half, LENGTH - half, 0.5 * LENGTH);
        let mut set = vec![
            format!("fluid.cells=[{cells}, 1, {cells}]"),
            format!("fluid.lid.velocity=[{speed:?}, 0.0, 0.0]"),
            format!("time.dt={:e}", plan.step * turn),
            format!("time.end={:?} s", plan.end * turn),
            format!("observe.2.at=[{middle:?}, 0.0, {first:?}]"),
            format!("observe.2.to=[{middle:?}, 0.0, {last:?}]"),
            format!("observe.3.at=[{first:?}, 0.0, {middle:?}]"),
            format!("observe.3.to=[{last:?}, 0.0, {middle:?}]"),
        ];
        for k in 0..4 {
            set.push(format!("observe.{k}.every={} steps", (1.0 / plan.step).round()));
            if k > 0 {
                // The last sample stands up to one unit before the end.
                set.push(format!("observe.{k}.from={:?} s", (plan.end - plan.mean) * turn));
            }
            if k > 1 {
                set.push(format!("observe.{k}.points={cells}"));
            }
        }
        let run = Done::new(CASE, &set, &request.out.join(format!("re-{reynolds}-{cells}")), !request.quick)?;
        let profile = |name: &str, along: &str, what: &str, lid: f64| -> Result<Vec<[f64; 2]>, Failure> {
            let t = run.table(name)?;
            let mut points = vec![[0.0, 0.0]];
            points
                .extend(column(&t, along).iter().zip(column(&t, what)).map(|(s, v)| [s / LENGTH, v / speed]));
            points.push([1.0, lid]);
            Ok(points)
        };
        let t = run.table("mean-vortices")?;
        let [psi, x, z, omega] = ["streamfunction", "x", "z", "vorticity"].map(|c| column(&t, c));
        let vortices = (0..psi.len())
            .map(|k| Vortex {
                streamfunction: psi[k] / (speed * LENGTH),
                x: x[k] / LENGTH,
                z: z[k] / LENGTH,
                vorticity: omega[k] * turn,
            })
            .collect();
        let series = column(&run.table("developing")?, "lowest");
        let at = |k: usize| series.get(k).copied().unwrap_or(f64::NAN);
        let (before, last) = (at(series.len() * 9 / 10), at(series.len().saturating_sub(1)));
        Ok(Self {
            plan,
            upright: profile("upright-line", "z", "velocity_x", 1.0)?,
            level: profile("level-line", "x", "velocity_z", 0.0)?,
            vortices,
            drift: (last - before).abs() / last.abs(),
        })
    }

    fn label(&self) -> String {
        format!("Re {}, {} cells", self.plan.reynolds, self.plan.cells)
    }

    /// The strongest vortex with its centre in the given corner of the cavity, turning clockwise or not.
    fn vortex(&self, clockwise: bool, inside: impl Fn(&Vortex) -> bool) -> Option<Vortex> {
        self.vortices.iter().copied().find(|v| (v.streamfunction < 0.0) == clockwise && inside(v))
    }

    fn main(&self) -> Option<Vortex> {
        self.vortex(true, |v| (0.25..0.75).contains(&v.x) && (0.25..0.75).contains(&v.z))
    }

    fn bottom_right(&self) -> Option<Vortex> {
        self.vortex(false, |v| v.x > 0.5 && v.z < 0.5)
    }

    fn bottom_left(&self) -> Option<Vortex> {
        self.vortex(false, |v| v.x < 0.5 && v.z < 0.5)
    }

    /// The clockwise one between the anticlockwise one and the corner.
    fn inner_bottom_right(&self) -> Option<Vortex> {
        self.vortex(true, |v| v.x > 0.75 && v.z < 0.25)
    }

    fn top_left(&self) -> Option<Vortex> {
        self.vortex(false, |v| v.x < 0.5 && v.z > 0.5)
    }

    /// Volume through the centre lines over lid speed and side, the larger.
    fn net_flux(&self) -> f64 {
        let mean = |line: &[[f64; 2]]| {
            let inner = &line[1..line.len() - 1];
            inner.iter().map(|p| p[1]).sum::<f64>() / inner.len() as f64
        };
        mean(&self.upright).abs().max(mean(&self.level).abs())
    }

    /// Largest distance of a profile from the published points.
    fn apart(&self, line: &[[f64; 2]], table: &str) -> f64 {
        let points = published(table, self.plan.reynolds);
        points.iter().map(|[s, v]| (cubic(line, *s) - v).abs()).fold(0.0, f64::max)
    }
}

/// Place and velocity of a published profile; none if this Reynolds number is not in it.
fn published(table: &str, reynolds: u32) -> Vec<[f64; 2]> {
    let mut lines = table.lines().filter(|l| !l.starts_with('#'));
    let header = lines.next().unwrap_or_default();
    let wanted = format!("_Re{reynolds}");
    let Some(k) = header.split(',').position(|c| c.ends_with(&wanted)) else { return vec![] };
    lines
        .filter_map(|l| {
            let cells: Vec<&str> = l.split(',').collect();
            Some([cells.first()?.parse().ok()?, cells.get(k)?.parse().ok()?])
        })
        .collect()
}

/// The cubic through the four points of `line` around `s`.
fn cubic(line: &[[f64; 2]], s: f64) -> f64 {
    let after = line.iter().position(|p| p[0] > s).unwrap_or(line.len() - 1);
    let first = after.saturating_sub(2).min(line.len() - 4);
    let four = &line[first..first + 4];
    (0..4)
        .map(|k| {
            let others = (0..4).filter(|&m| m != k);
            four[k][1] * others.map(|m| (s - four[m][0]) / (four[k][0] - four[m][0])).product::<f64>()
        })
        .sum()
}

/// The quantities and plots; the short form stops before the flow is quite steady.
///
/// # Errors
/// Whatever the run fails with.
pub fn run(request: &Request) -> Result<Ran, Failure> {
    let plans: &'static [Plan] = if request.quick { &QUICK } else { &FULL };
    let flows: Vec<Flow> = plans.iter().map(|plan| Flow::new(plan, request)).collect::<Result<_, _>>()?;
    let computed = flows.iter().flat_map(quantities).collect();
    let figures = flows
        .iter()
        .flat_map(|flow| {
            let label = flow.label();
            [
                figure(
                    &format!("v_x on the upright centre line, {label}"),
                    ["z / L", "v_x / U"],
                    flow,
                    &flow.upright,
                    UPRIGHT,
                ),
                figure(
                    &format!("v_z on the level centre line, {label}"),
                    ["x / L", "v_z / U"],
                    flow,
                    &flow.level,
                    LEVEL,
                ),
            ]
        })
        .collect();
    Ok(Ran { computed, figures })
}

/// What one flow gives.
fn quantities(flow: &Flow) -> Vec<Computed> {
    let label = flow.label();
    let mut computed = vec![];
    let mut put = |what: &str, value: f64| computed.push(Computed::new(format!("{what}, {label}"), value));
    let mut vortices = vec![("main", flow.main())];
    // The corner vortices of other flows are not published.
    if flow.plan.reynolds == 1000 {
        vortices.extend([("bottom right", flow.bottom_right()), ("bottom left", flow.bottom_left())]);
    }
    for (name, v) in vortices {
        let value = |f: fn(&Vortex) -> f64| v.as_ref().map_or(f64::NAN, f);
        put(&format!("streamfunction of the {name} vortex"), value(|v| v.streamfunction));
        put(&format!("x of the {name} vortex"), value(|v| v.x));
        put(&format!("z of the {name} vortex"), value(|v| v.z));
        if name == "main" {
            put("vorticity of the main vortex", value(|v| v.vorticity));
        }
    }
    if !published(UPRIGHT, flow.plan.reynolds).is_empty() {
        put("distance of v_x from the table", flow.apart(&flow.upright, UPRIGHT));
        put("distance of v_z from the table", flow.apart(&flow.level, LEVEL));
    }
    if flow.plan.reynolds < ONSET {
        put("change over the last tenth of the run", flow.drift);
    }
    put("net flux through the centre lines", flow.net_flux());
    let seen = |all: &[Option<Vortex>]| {
        all.iter().flatten().filter(|v| v.streamfunction.abs() > FAINT).count() as f64
    };
    put("anticlockwise vortices at the bottom", seen(&[flow.bottom_left(), flow.bottom_right()]));
    put("anticlockwise vortices top left", seen(&[flow.top_left()]));
    put("clockwise vortices bottom right", seen(&[flow.inner_bottom_right()]));
    computed
}

fn figure(title: &str, [x, y]: [&str; 2], flow: &Flow, line: &[[f64; 2]], table: &str) -> Figure {
    let label = format!("Re {}, Erturk et al. 2005", flow.plan.reynolds);
    let mut curves = vec![Curve::line(flow.label(), line.to_vec())];
    let points = published(table, flow.plan.reynolds);
    if !points.is_empty() {
        curves.push(Curve::line(label, points).styled(Style::Points));
    }
    Figure {
        title: title.into(),
        caption: "The streamlines (Fig. 2.10) are in the report of the run.".into(),
        body: Body::Curves { x: Axis::linear(x, "1"), y: Axis::linear(y, "1"), curves },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cubic_is_met_between_uneven_points() {
        let f = |s: f64| 1.0 + s - 3.0 * s * s + 5.0 * s * s * s;
        let line: Vec<[f64; 2]> = [0.0, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0].map(|s| [s, f(s)]).to_vec();
        for s in [0.0, 0.02, 0.3, 0.44, 0.95, 1.0] {
            assert!((cubic(&line, s) - f(s)).abs() < 1e-14, "{s}");
        }
    }

    #[test]
    fn the_tables_are_read_by_their_reynolds_number() {
        let u = published(UPRIGHT, 5000);
        assert_eq!((u.len(), u[0]), (21, [0.02, -0.2223]));
        assert!(published(LEVEL, 1000).contains(&[0.5, 0.0258]));
        assert!(published(LEVEL, 10_000).is_empty());
    }
}

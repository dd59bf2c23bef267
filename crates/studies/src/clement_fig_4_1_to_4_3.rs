//! Convection driven by the friction of the walls, bronze in water by simple drag (Clément 4.3, Figs 4.1-4.3).

use crate::runs::{Done, column, first};
use crate::study::{Computed, Ran, Request};
use brazilnut_base::Table;
use brazilnut_base::figure::{Axis, Body, Curve, Figure, Raster};
use brazilnut_runner::Failure;

const CASE: (&str, &str) = (
    "studies/clement-fig-4-1-to-4-3/case.toml",
    include_str!("../../../studies/clement-fig-4-1-to-4-3/case.toml"),
);
/// Mean diameter of Clément Table 4.1, m.
const DIAMETER: f64 = 0.7e-3;
/// Samples, one a cycle, in the mean of a dome at the start or at the end.
const FEW: usize = 5;

/// Frictions of the walls of the subset that decides, each a run of 20 s of all grains.
const FRICTIONS: [f64; 3] = [0.0, 0.6, 1.0];
/// When the thesis shows the dome, s.
const SHOWN: f64 = 10.0;

/// What the short form lays over the case: a narrow bed of the same height, periodic in depth, for a short time.
const QUICK: [&str; 5] = [
    "cell.size=[\"10 mm\", \"1.75 mm\", \"20 mm\"]",
    "cell.y=periodic",
    "grains.0.count=290",
    "time.end=2 s",
    "observe.2.from=0.5 s",
];

/// Tables of a run.
struct Run {
    friction: f64,
    surface: Table,
    strength: Table,
    field: Table,
}

impl Run {
    fn new(request: &Request, friction: f64) -> Result<Self, Failure> {
        let form: &[&str] = if request.quick { &QUICK } else { &[] };
        let friction_of_walls = format!("contact.pairs.0.friction={friction:?}");
        let overrides: Vec<String> = form.iter().map(|&o| o.to_string()).chain([friction_of_walls]).collect();
        let run = Done::new(CASE, &overrides, &request.out.join(format!("mu-{friction}")), !request.quick)?;
        Ok(Self {
            friction,
            surface: run.table("surface")?,
            strength: run.table("convection-strength")?,
            field: run.table("convection-field")?,
        })
    }

    fn label(&self) -> String {
        format!("mu_W {}", self.friction)
    }

    /// The entry of the only row of the strength.
    fn strength(&self, name: &str) -> f64 {
        first(&self.strength, name)
    }

    /// Dome over time, s and m.
    fn dome(&self) -> Vec<[f64; 2]> {
        let [t, h] = ["time", "dome"].map(|c| column(&self.surface, c));
        t.into_iter().zip(h).map(|(t, h)| [t, h]).collect()
    }

    /// Mean dome of the first and of the last samples, m.
    fn ends(&self) -> [f64; 2] {
        let h: Vec<f64> = self.dome().iter().map(|p| p[1]).collect();
        let few = FEW.min(h.len());
        [mean(&h[..few]), mean(&h[h.len() - few..])]
    }

    /// Mean dome within five cycles of the time at which the thesis shows it, m.
    fn shown(&self) -> f64 {
        let near: Vec<f64> =
            self.dome().iter().filter(|p| (p[0] - SHOWN).abs() < 0.55).map(|p| p[1]).collect();
        mean(&near)
    }

    /// Sum of r x J over the left and over the right half about the middle of each, m²; positive if the
    /// half goes up on its right.
    fn circulation(&self) -> [f64; 2] {
        let [x, z, u, w] = ["x", "z", "j_x", "j_z"].map(|c| column(&self.field, c));
        let width = x.iter().fold(0.0_f64, |a, &b| a.max(b)) + x.iter().fold(f64::INFINITY, |a, &b| a.min(b));
        let moving = (0..x.len()).filter(|&k| u[k] != 0.0 || w[k] != 0.0);
        let middle = 0.5 * moving.map(|k| z[k]).fold(0.0, f64::max);
        let half = |right: bool| {
            let centre = width * if right { 0.75 } else { 0.25 };
            let cells = (0..x.len()).filter(|&k| (x[k] > 0.5 * width) == right);
            cells.map(|k| (x[k] - centre) * w[k] - (z[k] - middle) * u[k]).sum()
        };
        [half(false), half(true)]
    }
}

fn mean(list: &[f64]) -> f64 {
    list.iter().sum::<f64>() / list.len() as f64
}

/// The quantities and plots. Full form: three frictions of the walls, all grains, 20 s each.
///
/// # Errors
/// Whatever a run fails with.
pub fn run(request: &Request) -> Result<Ran, Failure> {
    let frictions: &[f64] = if request.quick { &[1.0] } else { &FRICTIONS };
    let runs: Vec<Run> = frictions.iter().map(|&mu| Run::new(request, mu)).collect::<Result<_, _>>()?;
    let rough = &runs[runs.len() - 1];
    let [first, last] = rough.ends();
    let mut computed = vec![
        Computed::new("rise of the dome, mu_W 1", (last - first) / DIAMETER),
        Computed::new("noise over J, mu_W 1", rough.strength("noise") / rough.strength("strength")),
    ];
    let mut figures = vec![dome(&runs)];
    figures.extend(runs.iter().map(field));
    if let [smooth, middle, rough] = &runs[..] {
        let [left, right] = rough.circulation();
        let ratio = |a: &Run, b: &Run| {
            let error = |r: &Run| r.strength("strength_error") / r.strength("strength");
            let ratio = a.strength("strength") / b.strength("strength");
            (ratio, ratio * error(a).hypot(error(b)))
        };
        let (low, low_error) = ratio(middle, smooth);
        let (high, high_error) = ratio(rough, middle);
        computed.extend([
            Computed::new("dome at 10 s, mu_W 1", rough.shown() / DIAMETER),
            Computed::new("dome at 10 s, mu_W 1 less mu_W 0", (rough.shown() - smooth.shown()) / DIAMETER),
            Computed::new(
                "product of the signs of the two circulations, mu_W 1",
                left.signum() * right.signum(),
            ),
            Computed::new("sign of the left circulation, mu_W 1", left.signum()),
            Computed::with_error("J at mu_W 0.6 over J at 0", low, low_error),
            Computed::with_error("J at mu_W 1 over J at 0.6", high, high_error),
        ]);
        figures.push(strengths(&runs));
    }
    Ok(Ran { computed, figures })
}

/// J and its noise floor against the friction of the walls (Fig. 4.3).
fn strengths(runs: &[Run]) -> Figure {
    let points = |name: &str| runs.iter().map(|r| [r.friction, r.strength(name)]).collect::<Vec<_>>();
    Figure {
        title: "Strength of the convection".into(),
        caption: "Noise: the same displacements shuffled among the grains (Fig. 4.3).".into(),
        body: Body::Curves {
            x: Axis::linear("friction of the walls", "1"),
            y: Axis::linear("J", "m"),
            curves: vec![Curve::line("J", points("strength")), Curve::line("noise floor", points("noise"))],
        },
    }
}

fn dome(runs: &[Run]) -> Figure {
    let curve = |run: &Run| {
        let points: Vec<[f64; 2]> = run.dome().iter().map(|p| [p[0], p[1] / DIAMETER]).collect();
        Curve::line(run.label(), points)
    };
    Figure {
        title: "Dome".into(),
        caption: "Height of the surface in the middle third less that at the walls, once a cycle at phase 0."
            .into(),
        body: Body::Curves {
            x: Axis::linear("time", "s"),
            y: Axis::linear("dome over diameter", "1"),
            curves: runs.iter().map(curve).collect(),
        },
    }
}

fn field(run: &Run) -> Figure {
    let [x, z, u, w] = ["x", "z", "j_x", "j_z"].map(|c| column(&run.field, c));
    let columns = z.iter().take_while(|&&h| h == z[0]).count().max(1);
    let (a, b) = (run.strength("cell_width"), run.strength("cell_height"));
    let rows = x.len() / columns;
    let raster = Raster {
        shape: [columns, rows],
        extent: [0.0, columns as f64 * a, 0.0, rows as f64 * b],
        values: u
            .iter()
            .zip(&w)
            .map(|(u, w)| Some(u.hypot(*w)).filter(|&s| s > 0.0).unwrap_or(f64::NAN))
            .collect(),
        label: "|J|".into(),
        unit: "m".into(),
    };
    let moving = (0..x.len()).filter(|&k| u[k] != 0.0 || w[k] != 0.0);
    Figure {
        title: format!("Displacement field, {}", run.label()),
        caption: "Displacements per cycle summed over the grains of each cell (Fig. 4.2).".into(),
        body: Body::Map {
            x: Axis::linear("x", "m"),
            y: Axis::linear("z", "m"),
            raster: Some(raster),
            arrows: moving.map(|k| ([x[k], z[k]], [u[k], w[k]])).collect(),
            arrow_unit: "m".into(),
            lines: vec![],
        },
    }
}

//! Convection driven by the friction of the walls, bronze in water by simple drag (Clément 4.3, Figs 4.1-4.3).

use crate::runs::{Done, column, first};
use crate::study::{Computed, Ran, Request};
use brazilnut_base::Table;
use brazilnut_base::figure::{Axis, Body, Curve, Figure, Raster, Style};
use brazilnut_runner::Failure;

const CASE: (&str, &str) = (
    "studies/clement-fig-4-1-to-4-3/case.toml",
    include_str!("../../../studies/clement-fig-4-1-to-4-3/case.toml"),
);
/// Mean diameter of Clément Table 4.1, m.
const DIAMETER: f64 = 0.7e-3;
/// Time from which the dome counts, s.
const LATE: f64 = 10.0;
/// Samples, one a cycle, in the mean of a dome at the start or at the end.
const FEW: usize = 5;

/// What the short form lays over the case: a narrow bed of the same height, periodic in depth, for a short time.
const QUICK: [&str; 5] = [
    "cell.size=[\"10 mm\", \"1.75 mm\", \"20 mm\"]",
    "cell.y=periodic",
    "grains.0.count=290",
    "time.end=2 s",
    "observe.2.from=0.5 s",
];

/// Tables of one run.
struct Run {
    friction: f64,
    surface: Table,
    strength: Table,
    field: Table,
}

impl Run {
    fn new(friction: f64, request: &Request) -> Result<Self, Failure> {
        let mut overrides = vec![format!("contact.pairs.0.friction={friction}")];
        if request.quick {
            overrides.extend(QUICK.map(String::from));
        }
        let folder = request.out.join(format!("mu-{friction}"));
        let run = Done::new(CASE, &overrides, &folder, !request.quick)?;
        Ok(Self {
            friction,
            surface: run.table("surface")?,
            strength: run.table("convection-strength")?,
            field: run.table("convection-field")?,
        })
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

    /// Mean dome from `LATE` on, m.
    fn late_dome(&self) -> f64 {
        let late: Vec<f64> = self.dome().iter().filter(|p| p[0] >= LATE).map(|p| p[1]).collect();
        mean(&late)
    }

    /// How much the dome rose from the first to the last samples, m.
    fn rise(&self) -> f64 {
        let h: Vec<f64> = self.dome().iter().map(|p| p[1]).collect();
        let few = FEW.min(h.len());
        mean(&h[h.len() - few..]) - mean(&h[..few])
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

/// The quantities and plots. Full form: the subset of Clément's runs that decides.
///
/// # Errors
/// Whatever a run fails with.
pub fn run(request: &Request) -> Result<Ran, Failure> {
    let frictions: &[f64] = if request.quick { &[0.0, 1.0] } else { &[0.0, 0.6, 1.0] };
    let runs: Vec<Run> = frictions.iter().map(|&f| Run::new(f, request)).collect::<Result<_, _>>()?;
    let (smooth, rough) = (&runs[0], &runs[runs.len() - 1]);
    let [left, right] = rough.circulation();
    let mut computed = vec![
        Computed::new("rise of the dome, mu_W 1 less mu_W 0", (rough.rise() - smooth.rise()) / DIAMETER),
        Computed::new("product of the signs of the two circulations, mu_W 1", left.signum() * right.signum()),
        Computed::new("sign of the left circulation, mu_W 1", left.signum()),
        Computed::new("noise over J, mu_W 1", rough.strength("noise") / rough.strength("strength")),
    ];
    if let [_, between, _] = &runs[..] {
        let ratio = |a: &Run, b: &Run| a.strength("strength") / b.strength("strength");
        computed.push(Computed::new("dome after 10 s, mu_W 1", rough.late_dome() / DIAMETER));
        computed.push(Computed::new("J at mu_W 0.6 over J at 0", ratio(between, smooth)));
        computed.push(Computed::new("J at mu_W 1 over J at 0.6", ratio(rough, between)));
    }
    Ok(Ran { computed, figures: vec![domes(&runs), strengths(&runs), field(rough)] })
}

fn domes(runs: &[Run]) -> Figure {
    let curve = |r: &Run| {
        let points = r.dome().iter().map(|p| [p[0], p[1] / DIAMETER]).collect();
        Curve::line(format!("μ_W = {}", r.friction), points)
    };
    Figure {
        title: "Dome".into(),
        caption: "Height of the surface in the middle third less that at the walls, once a cycle at phase 0; the dashed line is one diameter.".into(),
        body: Body::Curves {
            x: Axis::linear("time", "s"),
            y: Axis::linear("dome over diameter", "1"),
            curves: runs
                .iter()
                .map(curve)
                .chain([Curve::line("one diameter", vec![[0.0, 1.0], [20.0, 1.0]]).styled(Style::Dashed)])
                .collect(),
        },
    }
}

fn strengths(runs: &[Run]) -> Figure {
    let points = |name: &str| runs.iter().map(|r| [r.friction, r.strength(name)]).collect();
    let mut j = Curve::line("J", points("strength"));
    j.error = runs.iter().map(|r| r.strength("strength_error")).collect();
    let (width, cycles) = (1e3 * runs[0].strength("cell_width"), runs[0].strength("cycles"));
    Figure {
        title: "Strength of the convection".into(),
        caption: format!(
            "J of the field averaged over {cycles} cycles, cells {width:.2} mm wide, and its noise floor: the same displacements shuffled among the grains."
        ),
        body: Body::Curves {
            x: Axis::linear("friction of the walls", "1"),
            y: Axis::linear("J per cycle", "m"),
            curves: vec![j, Curve::line("shuffled", points("noise")).styled(Style::Dashed)],
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
        values: u.iter().zip(&w).map(|(u, w)| u.hypot(*w)).collect(),
        label: "|J|".into(),
        unit: "m".into(),
    };
    let moving = (0..x.len()).filter(|&k| u[k] != 0.0 || w[k] != 0.0);
    Figure {
        title: "Displacement field, μ_W = 1".into(),
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

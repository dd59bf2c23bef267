//! Arches under a wide shaken bed, and its rolls (Lan 5.1.3, Figs A5.8-A5.11).

use crate::maps::Field;
use crate::runs::{Done, SEEDS, column};
use crate::study::{Computed, Ran, Request};
use brazilnut_base::Table;
use brazilnut_base::figure::{Axis, Body, Curve, Figure};
use brazilnut_runner::Failure;

const CASE: (&str, &str) =
    ("studies/lan-arching/case.toml", include_str!("../../../studies/lan-arching/case.toml"));

/// Samples in a cycle.
const PER_CYCLE: usize = 24;
/// Gaps start at this column of the table, after time, cycle, mean and unevenness.
const GAPS: usize = 4;
/// Diameter of the grains, m.
const DIAMETER: f64 = 0.1;

/// Cells of a smaller solids fraction have few visitors and are left out.
const LEAST: f64 = 0.05;

/// What the short form lays over the case: a fifth of the width.
const QUICK: [&str; 3] = ["cell.size=[\"2 m\", \"0.1 m\", \"2.1 m\"]", "grains.0.count=191", "time.end=8 s"];

/// Tables of one run.
struct Run {
    gap: Table,
    by_phase: Table,
    field: Field,
}

impl Run {
    fn new(seed: u64, request: &Request) -> Result<Self, Failure> {
        let mut overrides = vec![format!("seed={seed}")];
        if request.quick {
            overrides.extend(QUICK.map(String::from));
        }
        let run = Done::new(CASE, &overrides, &request.out.join(format!("seed-{seed}")), !request.quick)?;
        Ok(Self {
            gap: run.table("gap")?,
            by_phase: run.table("gap-by-phase")?,
            field: Field::new(&run.table("field-long-term")?, LEAST),
        })
    }

    /// Phase (degrees) and unevenness of the gap (m), mean over the cycles.
    fn unevenness(&self) -> Vec<[f64; 2]> {
        let (phase, y) = (column(&self.by_phase, "phase"), column(&self.by_phase, "unevenness"));
        phase.into_iter().zip(y).map(|(p, y)| [p, y]).collect()
    }

    /// Mean unevenness over phases between `low` and `high` (degrees), m.
    fn between(&self, low: f64, high: f64) -> f64 {
        let y: Vec<f64> =
            self.unevenness().iter().filter(|p| p[0] >= low && p[0] < high).map(|p| p[1]).collect();
        y.iter().sum::<f64>() / y.len() as f64
    }

    /// Unevenness while the floor rises from its lowest place over that while it falls from its highest.
    fn rising_over_falling(&self) -> f64 {
        self.between(270.0, 360.0) / self.between(90.0, 180.0)
    }

    /// Largest unevenness over phase, in diameters.
    fn largest(&self) -> f64 {
        self.unevenness().iter().map(|p| p[1] / DIAMETER).fold(0.0, f64::max)
    }

    /// Smallest over largest unevenness over phase.
    fn flattest(&self) -> f64 {
        self.unevenness().iter().map(|p| p[1] / DIAMETER).fold(f64::INFINITY, f64::min) / self.largest()
    }

    /// Mean correlation coefficient of the gap along the bed with that `cycles` cycles later, at equal phase.
    fn likeness(&self, cycles: usize) -> f64 {
        let rows = &self.gap.rows;
        let pairs = rows.iter().zip(rows.iter().skip(cycles * PER_CYCLE));
        let all: Vec<f64> = pairs.map(|(a, b)| correlation(&a[GAPS..], &b[GAPS..])).collect();
        all.iter().sum::<f64>() / all.len() as f64
    }
}

/// Correlation coefficient over the columns in which both have a gap.
fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let both: Vec<(f64, f64)> =
        a.iter().zip(b).map(|(a, b)| (*a, *b)).filter(|(a, b)| (a + b).is_finite()).collect();
    let n = both.len() as f64;
    let (ma, mb) = (both.iter().map(|p| p.0).sum::<f64>() / n, both.iter().map(|p| p.1).sum::<f64>() / n);
    let sum = |f: &dyn Fn(f64, f64) -> f64| both.iter().map(|p| f(p.0 - ma, p.1 - mb)).sum::<f64>();
    sum(&|x, y| x * y) / (sum(&|x, _| x * x) * sum(&|_, y| y * y)).sqrt()
}

/// The quantities and plots.
///
/// # Errors
/// Whatever a run fails with.
pub fn run(request: &Request) -> Result<Ran, Failure> {
    let seeds = if request.quick { &SEEDS[..1] } else { &SEEDS };
    let runs: Vec<Run> = seeds.iter().map(|&s| Run::new(s, request)).collect::<Result<_, _>>()?;
    let mean =
        |name: &str, of: &dyn Fn(&Run) -> f64| Computed::mean(name, &runs.iter().map(of).collect::<Vec<_>>());
    let rising = mean("unevenness while the floor rises over that while it falls", &Run::rising_over_falling);
    if request.quick {
        return Ok(Ran { computed: vec![rising], figures: vec![by_phase(&runs), profiles(&runs[0])] });
    }
    let pooled = Field::mean(runs.iter().map(|r| &r.field));
    let computed = vec![
        rising,
        mean("smallest over largest unevenness", &Run::flattest),
        mean("largest unevenness", &Run::largest),
        mean("likeness of the gap a cycle later", &|r| r.likeness(1)),
        mean("mean vertical velocity along the walls", &|r| r.field.along_the_walls()),
        mean("width of a roll at a wall", &|r| r.field.turning(2) / DIAMETER),
        mean("speed in the middle over that at the walls", &|r| r.field.middle_over_walls()),
    ];
    let figures = vec![
        by_phase(&runs),
        likeness(&runs),
        profiles(&runs[0]),
        vertical(&pooled),
        pooled.map(
            "Mean velocity".into(),
            "Cells of one diameter, a grain counted where its centre is; mean of all seeds.",
        ),
    ];
    Ok(Ran { computed, figures })
}

fn by_phase(runs: &[Run]) -> Figure {
    let curve = |(k, r): (usize, &Run)| {
        Curve::line(
            format!("seed {}", k + 1),
            r.unevenness().iter().map(|p| [p[0], p[1] / DIAMETER]).collect(),
        )
    };
    Figure {
        title: "Unevenness of the gap over a cycle".into(),
        caption: "Standard deviation of the gap along the bed, mean over the cycles at equal phase. The floor moves up at its fastest at phase 0, is highest at 90° and lowest at 270°.".into(),
        body: Body::Curves {
            x: Axis::linear("phase", "deg"),
            y: Axis::linear("unevenness over diameter", "1"),
            curves: runs.iter().enumerate().map(curve).collect(),
        },
    }
}

fn likeness(runs: &[Run]) -> Figure {
    let curve = |(k, r): (usize, &Run)| {
        Curve::line(format!("seed {}", k + 1), (1..=12).map(|c| [c as f64, r.likeness(c)]).collect())
    };
    Figure {
        title: "Do the arches come again?".into(),
        caption:
            "Correlation coefficient of the gap along the bed with itself some cycles later, at equal phase."
                .into(),
        body: Body::Curves {
            x: Axis::linear("cycles later", "1"),
            y: Axis::linear("correlation", "1"),
            curves: runs.iter().enumerate().map(curve).collect(),
        },
    }
}

fn vertical(field: &Field) -> Figure {
    Figure {
        title: "Vertical velocity by column (Fig. A5.8a)".into(),
        caption: "Mean vertical velocity of the grains of each column against the distance from the nearer wall, mean of all seeds; below zero is down.".into(),
        body: Body::Curves {
            x: Axis::linear("distance from the wall", "m"),
            y: Axis::linear("vertical velocity", "m/s"),
            curves: vec![Curve::line("100 d wide", field.folded())],
        },
    }
}

/// Lower edge of the bed at the eight phases of Figs A5.10 in the last cycle.
fn profiles(run: &Run) -> Figure {
    let rows = &run.gap.rows;
    let last = &rows[rows.len().saturating_sub(PER_CYCLE)..];
    let curve = |row: &Vec<f64>| {
        let points = row[GAPS..].iter().enumerate().filter(|(_, g)| g.is_finite());
        let points = points.map(|(k, g)| [k as f64 + 0.5, g / DIAMETER]).collect();
        Curve::line(format!("{:.0}°", 360.0 * row[1].rem_euclid(1.0)), points)
    };
    Figure {
        title: "Gap under the bed in the last cycle (Figs A5.10)".into(),
        caption: "Lowest point of the grains in each column of one diameter above the floor, at eight phases, seed 1.".into(),
        body: Body::Curves {
            x: Axis::linear("x over diameter", "1"),
            y: Axis::linear("gap over diameter", "1"),
            curves: last.iter().step_by(PER_CYCLE / 8).map(curve).collect(),
        },
    }
}

//! Expansion of a vibrated layer (Lan 4.2, Table 4.3, Figs A4.5-A4.10).

use crate::layers::{Bed, GRAVITY, Layers, figures};
use crate::repeats::Repeats;
use crate::runs::{SEEDS, first};
use crate::study::{Computed, Ran, Request};
use brazilnut_base::Table;
use brazilnut_base::figure::{Axis, Body, Curve, Figure, Style};
use brazilnut_runner::Failure;
use std::f64::consts::TAU;

const CASE: (&str, &str) =
    ("studies/lan-expansion/case.toml", include_str!("../../../studies/lan-expansion/case.toml"));

/// Peak accelerations over gravity of Lan Table 4.3.
const GAMMAS: [f64; 9] = [1.0, 1.2, 2.0, 2.35, 2.8, 3.15, 3.6, 4.1, 30.0];
/// Those of the short form: below and above the threshold of expansion.
const QUICK: [f64; 2] = [1.2, 3.15];

/// What the full form lays over the case: a longer average.
const LONGER: [&str; 1] = ["time.end=5 s"];
/// What the fastest floor needs: stiffer springs, whose overlap is that of the others at 3.15 g, and room to fly.
const FASTEST: [&str; 2] = ["contact.stiffness=2e4 N/m", "cell.size=[\"15 mm\", \"15 mm\", \"900 mm\"]"];

pub const DIAMETER: f64 = 0.003;
const AMPLITUDE: f64 = 0.005;

/// One acceleration.
pub struct Run {
    /// Peak acceleration over gravity.
    pub gamma: f64,
    /// Profiles.
    pub bed: Bed,
    /// Other tables, seed by seed.
    means: [Vec<Table>; 3],
}

/// Tables of a run beside the profile.
const TABLES: [&str; 3] = ["bed-means", "collisions-means", "profile-cell"];

impl Run {
    fn new(gamma: f64, request: &Request) -> Result<Self, Failure> {
        let frequency = (gamma * GRAVITY / AMPLITUDE).sqrt() / TAU;
        let mut overrides = vec![format!("shaking.frequency={frequency:.5} Hz")];
        if !request.quick {
            overrides.extend(LONGER.map(String::from));
        }
        if gamma == 30.0 {
            overrides.extend(FASTEST.map(String::from));
        }
        // The studies of this table share their runs, unless these are short ones.
        let place =
            if request.quick { request.out.clone() } else { request.out.with_file_name("lan-expansion") };
        let folder = place.join(format!("gamma-{gamma}"));
        let seeds = if request.quick { 1 } else { SEEDS.len() as u64 };
        let runs = Repeats::new(CASE, &overrides, &folder, seeds, !request.quick)?;
        let [a, b, c] = TABLES.map(|t| runs.tables(t));
        let bed = Bed::new(format!("gamma {gamma}"), &runs, DIAMETER)?;
        Ok(Self { gamma, bed, means: [a?, b?, c?] })
    }

    /// The runs of the table.
    ///
    /// # Errors
    /// Whatever a run fails with.
    pub fn all(request: &Request) -> Result<Vec<Self>, Failure> {
        let gammas: &[f64] = if request.quick { &QUICK } else { &GAMMAS };
        gammas.iter().map(|&g| Self::new(g, request)).collect()
    }

    fn values(&self, table: usize, name: &str) -> Vec<f64> {
        self.means[table].iter().map(|t| first(t, name)).collect()
    }

    /// Height of the lid of the vibrated bed over the floor, in diameters, seed by seed.
    fn heights(&self) -> Vec<f64> {
        self.values(0, "height_lid").iter().map(|h| h / DIAMETER).collect()
    }

    /// Collisions per grain and second.
    #[must_use]
    pub fn rates(&self) -> Vec<f64> {
        self.values(1, "rate")
    }

    /// Temperature of the cell, m²/s².
    #[must_use]
    pub fn temperatures(&self) -> Vec<f64> {
        self.values(2, "temperature")
    }
}

/// The run at an acceleration.
#[must_use]
pub fn at(runs: &[Run], gamma: f64) -> &Run {
    runs.iter().find(|r| r.gamma == gamma).expect("the list of accelerations has it")
}

/// A curve of a quantity over the acceleration, with its error.
#[must_use]
pub fn curve(label: &str, runs: &[Run], values: impl Fn(&Run) -> Vec<f64>) -> Curve {
    let all: Vec<_> = runs.iter().map(|r| (r.gamma, Computed::mean("", &values(r)))).collect();
    let mut curve =
        Curve::line(label, all.iter().map(|(g, e)| [*g, e.value]).collect()).styled(Style::Points);
    curve.error = all.iter().map(|(_, e)| e.error.unwrap_or(0.0)).collect();
    curve
}

/// A plot over the acceleration.
#[must_use]
pub fn plot(title: &str, caption: &str, y: Axis, curves: Vec<Curve>) -> Figure {
    let body = Body::Curves { x: Axis::log("peak acceleration over gravity", "1"), y, curves };
    Figure { title: title.into(), caption: caption.into(), body }
}

/// The quantities and plots; the short form has two accelerations and one seed.
///
/// # Errors
/// Whatever a run fails with.
pub fn run(request: &Request) -> Result<Ran, Failure> {
    let runs = Run::all(request)?;
    let fluid = &at(&runs, 3.15).bed;
    let height = |gamma: f64| at(&runs, gamma).heights();
    let mut computed = vec![
        Computed::ratio("height at gamma 3.15 over that at 1.2", &height(3.15), &height(1.2)),
        fluid.find("W at the top over the least", |l| l.top() / l.w[l.coldest()]),
        fluid.find("layers from the least W to the densest", Layers::coldest_to_densest),
    ];
    if !request.quick {
        let fast = &at(&runs, 30.0).bed;
        let densest = |gamma: f64| -> Vec<f64> {
            at(&runs, gamma).bed.seeds.iter().map(|l| l.height[l.densest()]).collect()
        };
        computed.extend([
            Computed::ratio("height at gamma 1.2 over that at 1", &height(1.2), &height(1.0)),
            Computed::ratio("height at gamma 2 over that at 1.2", &height(2.0), &height(1.2)),
            Computed::ratio("height at gamma 4.1 over that at 2.8", &height(4.1), &height(2.8)),
            Computed::ratio("height at gamma 30 over that at 3.6", &height(30.0), &height(3.6)),
            fast.find("W at the floor over the largest", |l| {
                l.floor() / l.full().into_iter().map(|k| l.w[k]).fold(0.0, f64::max)
            }),
            Computed::ratio(
                "height of the densest layer at gamma 30 over that at 1.2",
                &densest(30.0),
                &densest(1.2),
            ),
            at(&runs, 2.0).bed.find("mass below five diameters", below_five),
            fast.find("mass below five diameters", below_five),
        ]);
    }
    Ok(Ran { computed, figures: plots(&runs) })
}

/// Share of the mass below five diameters over the floor's mean place.
fn below_five(l: &Layers) -> f64 {
    let k = l.height.partition_point(|h| *h < 5.0);
    l.below.get(k.saturating_sub(1)).copied().unwrap_or(f64::NAN)
}

fn plots(runs: &[Run]) -> Vec<Figure> {
    let lid = "Height over the floor below which lie the tops of 95 % of the mass, mean over cycles; bars: standard error of the seeds.";
    let hold_up = 239.0 * std::f64::consts::PI / (6.0 * 25.0);
    let mut all = vec![
        plot(
            "Height of the bed",
            lid,
            Axis::linear("height over diameter", "1"),
            vec![curve("lid", runs, Run::heights)],
        ),
        plot(
            "Bulk solids fraction",
            "Volume of the grains over that under the lid.",
            Axis::linear("solids fraction", "1"),
            vec![curve("vibrated", runs, |r| r.heights().iter().map(|h| hold_up / h).collect())],
        ),
    ];
    let beds: Vec<_> = runs.iter().map(|r| (&r.bed, None)).collect();
    let caption = "Layers one diameter thick, from the floor's mean place, mean over the seeds, where the solids fraction is 0.05 or more.";
    all.extend(figures(&beds, caption));
    let densest = |r: &Run| r.bed.seeds.iter().map(|l| l.height[l.densest()]).collect();
    all.push(plot(
        "Where the bed is densest",
        "Height of the densest layer over the floor's mean place.",
        Axis::linear("height over diameter", "1"),
        vec![curve("densest layer", runs, densest)],
    ));
    let below = runs.iter().map(|r| {
        let l = &r.bed.mean;
        Curve::line(
            &r.bed.name,
            l.height.iter().zip(&l.below).map(|(h, b)| [h + 0.5, *b]).filter(|p| p[0] < 45.0).collect(),
        )
    });
    all.push(Figure {
        title: "Mass below a height".into(),
        caption: "Share of the mass below a height over the floor's mean place (Fig. A4.9).".into(),
        body: Body::Curves {
            x: Axis::linear("height over diameter", "1"),
            y: Axis::linear("share of the mass", "1"),
            curves: below.collect(),
        },
    });
    all
}

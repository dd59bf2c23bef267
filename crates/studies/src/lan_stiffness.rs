//! Softer springs leave the profiles of a vibrated layer alone (Lan 4.1.3, Table 4.2, Fig. A4.3).

use crate::runs::{Done, column, first};
use crate::study::{Computed, Ran, Request};
use brazilnut_base::Table;
use brazilnut_base::figure::{Axis, Body, Curve, Figure};
use brazilnut_runner::Failure;

const CASE: (&str, &str) =
    ("studies/lan-stiffness/case.toml", include_str!("../../../studies/lan-stiffness/case.toml"));

/// Loading stiffnesses of Lan Table 4.2 as written in a case, N/m, from soft to hard.
const STIFFNESSES: [&str; 3] = ["1.2e5", "3.64e6", "2.7e8"];

/// Lan's diameter, m, and gravity: W = sqrt(T/(d g)).
const DIAMETER: f64 = 0.01;
const GRAVITY: f64 = 9.81;

/// What the short form lays over the case.
const QUICK: [&str; 2] = ["time.end=2.5 s", "observe.0.from=0.7 s"];

/// Layers with less than this are left out of comparisons: too few grains pass through.
const LEAST: f64 = 0.05;

/// Tables of one run.
struct Run {
    stiffness: &'static str,
    layers: Table,
    cell: Table,
}

impl Run {
    fn new(stiffness: &'static str, request: &Request) -> Result<Self, Failure> {
        let mut overrides = vec![format!("contact.stiffness={stiffness} N/m")];
        if request.quick {
            overrides.extend(QUICK.map(String::from));
        }
        let folder = request.out.join(format!("k-{stiffness}"));
        let run = Done::new(CASE, &overrides, &folder, !request.quick)?;
        Ok(Self { stiffness, layers: run.table("profile-long-term")?, cell: run.table("profile-cell")? })
    }

    fn solids(&self) -> Vec<f64> {
        column(&self.layers, "solids_fraction")
    }

    fn w(&self) -> Vec<f64> {
        column(&self.layers, "temperature").iter().map(|t| (t / (DIAMETER * GRAVITY)).sqrt()).collect()
    }

    fn mean_temperature(&self) -> f64 {
        first(&self.cell, "temperature")
    }

    /// Largest distance of the solids fraction from that of `other`, over the layers.
    fn solids_apart(&self, other: &Self) -> f64 {
        self.solids().iter().zip(other.solids()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    }

    /// Largest distance of W from that of `other` over the largest W, over the layers that hold enough.
    fn w_apart(&self, other: &Self) -> f64 {
        let (a, b, s, r) = (self.w(), other.w(), self.solids(), other.solids());
        let full = (0..a.len()).filter(|&k| s[k].min(r[k]) >= LEAST);
        let most = b.iter().copied().filter(|w| w.is_finite()).fold(0.0, f64::max);
        full.map(|k| (a[k] - b[k]).abs() / most).fold(0.0, f64::max)
    }

    fn curve(&self, values: &[f64]) -> Curve {
        let z = column(&self.layers, "z");
        let points = z.iter().zip(values).filter(|(_, v)| v.is_finite()).map(|(z, v)| [z / DIAMETER, *v]);
        Curve::line(format!("{} N/m", self.stiffness), points.collect())
    }
}

/// The quantities and plots; the short form leaves out the hardest spring.
///
/// # Errors
/// Whatever a run fails with.
pub fn run(request: &Request) -> Result<Ran, Failure> {
    let chosen = if request.quick { &STIFFNESSES[..2] } else { &STIFFNESSES[..] };
    let runs: Vec<Run> = chosen.iter().map(|s| Run::new(s, request)).collect::<Result<_, _>>()?;
    let mut computed = vec![];
    for pair in runs.windows(2) {
        let [soft, hard] = [&pair[0], &pair[1]];
        let name = |what: &str| format!("{what}, {} against {} N/m", soft.stiffness, hard.stiffness);
        let temperature = soft.mean_temperature() / hard.mean_temperature();
        computed.push(Computed::new(name("ratio of the mean temperatures"), temperature));
        computed
            .push(Computed::new(name("largest distance of the solids fractions"), soft.solids_apart(hard)));
        computed.push(Computed::new(name("largest distance of W over its largest"), soft.w_apart(hard)));
    }
    let figure = |title: &str, axis: Axis, value: fn(&Run) -> Vec<f64>| Figure {
        title: title.into(),
        caption: "Layers one diameter thick, V_b = 2, m_t = 2.5.".into(),
        body: Body::Curves {
            x: Axis::linear("height over diameter", "1"),
            y: axis,
            curves: runs.iter().map(|r| r.curve(&value(r))).collect(),
        },
    };
    let figures = vec![
        figure("Granular temperature", Axis::linear("W", "1"), Run::w),
        figure("Solids fraction", Axis::linear("solids fraction", "1"), Run::solids),
    ];
    Ok(Ran { computed, figures })
}

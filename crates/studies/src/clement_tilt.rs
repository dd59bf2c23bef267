//! A shaken bed in water piles up to one side of its cell (Clément 4.4, Tables 4.2-4.4, Figs 4.4-4.10).

use crate::phases::{PhaseCurve, largest, least};
use crate::runs::{Done, column};
use crate::study::{Computed, Ran, Request};
use brazilnut_base::Table;
use brazilnut_base::figure::{Axis, Body, Curve, Figure};
use brazilnut_runner::Failure;

const CASE: (&str, &str) =
    ("studies/clement-tilt/case.toml", include_str!("../../../studies/clement-tilt/case.toml"));

/// Mean diameter, m.
const DIAMETER: f64 = 0.7e-3;

/// Times of Fig. 4.4, s.
const TIMES: [f64; 4] = [0.0, 3.0, 6.0, 11.0];

/// Surfaces are averaged over this long before a time, s: single grains come and go.
const WINDOW: f64 = 1.0;

/// What the short form lays over the case: half as wide, two fifths as deep, three cycles.
const QUICK: [&str; 9] = [
    "cell.size=[\"10 mm\", \"5 mm\", \"10 mm\"]",
    "grains.0.count=500",
    "time.settle=0.15 s",
    "time.end=3 cycles",
    "output.pictures=0",
    "observe.2.from=0.1 s",
    "observe.3.from=0.1 s",
    "observe.3.point=[\"5 mm\", \"2.5 mm\", \"2 mm\"]",
    "observe.4.from=0.1 s",
];

/// Heights of the surface, column by column.
struct Surface {
    time: Vec<f64>,
    /// For each sample the heights from left to right, m.
    heights: Vec<Vec<f64>>,
}

impl Surface {
    fn read(table: &Table) -> Self {
        let columns: Vec<Vec<f64>> =
            (0..).map(|k| column(table, &format!("height_{k}"))).take_while(|c| !c.is_empty()).collect();
        let time = column(table, "time");
        let heights = (0..time.len()).map(|t| columns.iter().map(|c| c[t]).collect()).collect();
        Self { time, heights }
    }

    /// Mean heights over the window that ends at `t`; the first sample alone at 0.
    fn at(&self, t: f64) -> Vec<f64> {
        let half = 1e-6;
        let inside = |x: f64| x <= t + half && (x > t - WINDOW + half || t == 0.0);
        let rows: Vec<&Vec<f64>> =
            self.time.iter().zip(&self.heights).filter(|(x, _)| inside(**x)).map(|(_, h)| h).collect();
        let n = rows.first().map_or(0, |r| r.len());
        (0..n).map(|k| rows.iter().map(|r| r[k]).sum::<f64>() / rows.len() as f64).collect()
    }
}

/// Slope of the least-squares line through `heights` at equal distances over `width` (m).
fn slope(heights: &[f64], width: f64) -> f64 {
    let n = heights.len() as f64;
    let x = |k: usize| ((k as f64 + 0.5) / n - 0.5) * width;
    let (mut xx, mut xy) = (0.0, 0.0);
    for (k, h) in heights.iter().enumerate() {
        xx += x(k) * x(k);
        xy += x(k) * h;
    }
    xy / xx
}

/// The longest stretch of columns over which the surface goes one way, as a part of the width.
fn one_way(heights: &[f64]) -> f64 {
    let run = |sign: f64| {
        let (mut best, mut now) = (1, 1);
        for w in heights.windows(2) {
            now = if sign * (w[1] - w[0]) >= 0.0 { now + 1 } else { 1 };
            best = best.max(now);
        }
        best
    };
    f64::from(run(1.0).max(run(-1.0))) / heights.len() as f64
}

/// Mean height of the outermost three columns on both sides less that of the middle third, m.
fn wall_piles(heights: &[f64]) -> f64 {
    let mean = |h: &[f64]| h.iter().sum::<f64>() / h.len() as f64;
    let n = heights.len();
    0.5 * (mean(&heights[..3]) + mean(&heights[n - 3..])) - mean(&heights[n / 3..n - n / 3])
}

/// The quantities and plots: `navier-stokes`.
///
/// # Errors
/// Whatever the run fails with.
pub fn run(request: &Request) -> Result<Ran, Failure> {
    let overrides: Vec<String> = if request.quick { QUICK.map(String::from).into() } else { vec![] };
    let run = Done::new(CASE, &overrides, &request.out.join("navier-stokes"), !request.quick)?;
    let surface = Surface::read(&run.table("surface")?);
    let end = surface.time.last().copied().unwrap_or(f64::NAN);
    let width = if request.quick { 10e-3 } else { 20e-3 };
    let last = surface.at(end);
    // Counted from the shallow side.
    let mirrored = slope(&last, width) < 0.0;
    let table = run.table("base-pressure-by-phase")?;
    let places = if mirrored { [80, 60, 40, 20] } else { [20, 40, 60, 80] };
    let pressures = places.map(|x| PhaseCurve::read(&table, &format!("fluid_at_{x}")));
    let [over, under] = [largest, least].map(|f| pressures.each_ref().map(|c| f(&c.points)[1]));
    let mut computed = vec![
        Computed::new("slope at 0 s", slope(&surface.at(0.0), width).abs()),
        Computed::new("overpressure at 80 % over that at 20 % of the base", over[3] / over[0]),
        Computed::new("underpressure at 80 % over that at 20 % of the base", under[3] / under[0]),
        Computed::new("largest overpressure", over.iter().fold(0.0, |a, &b| f64::max(a, b))),
        Computed::new("least underpressure", under.iter().fold(0.0, |a, &b| f64::min(a, b))),
    ];
    if !request.quick {
        computed.push(Computed::new(
            "height of the piles at the walls, 3 s",
            wall_piles(&surface.at(3.0)) / DIAMETER,
        ));
        computed.push(Computed::new("part of the width that slopes one way, 11 s", one_way(&last)));
        let ratio = slope(&last, width).abs() / slope(&surface.at(3.0), width).abs();
        computed.push(Computed::new("slope at 11 s over that at 3 s", ratio));
        computed.extend(speeds(&run.table("flow-field-point")?));
    }
    Ok(Ran { computed, figures: vec![surfaces(&surface, width, end), pressure(&pressures)] })
}

/// Table 4.4, mm/s.
fn speeds(table: &Table) -> Vec<Computed> {
    let phase = column(table, "phase");
    let mut list = vec![];
    for degrees in [135.0, 225.0] {
        let row = phase.iter().position(|p| (p - degrees).abs() < 1.0);
        for (field, name) in [("grain", "grains"), ("fluid", "fluid"), ("mixture", "combined")] {
            let speed = row.map_or(f64::NAN, |k| column(table, &format!("{field}_speed"))[k]);
            list.push(Computed::new(format!("speed of the {name} at {degrees} deg"), 1e3 * speed));
        }
    }
    list
}

fn surfaces(surface: &Surface, width: f64, end: f64) -> Figure {
    let curve = |t: f64| {
        let h = surface.at(t);
        let x = |k: usize| (k as f64 + 0.5) / h.len() as f64 * width;
        let points = h.iter().enumerate().map(|(k, z)| [x(k), *z]).collect();
        Curve::line(format!("{t} s"), points)
    };
    Figure {
        title: "Surface".into(),
        caption: "Height of the bed at the times of Fig. 4.4, means over the second before (at 0 s the settled bed).".into(),
        body: Body::Curves {
            x: Axis::linear("x", "m"),
            y: Axis::linear("height", "m"),
            curves: TIMES.iter().filter(|t| **t <= end + 1e-9).map(|t| curve(*t)).collect(),
        },
    }
}

fn pressure(curves: &[PhaseCurve; 4]) -> Figure {
    let curve = |(c, part): (&PhaseCurve, &str)| Curve {
        error: c.error.clone(),
        ..Curve::line(part, c.points.clone())
    };
    let names = ["20 % from the shallow side", "40 %", "60 %", "80 %"];
    Figure {
        title: "Pressure along the base".into(),
        caption: "Averaged over cycles, hydrostatic part removed (Fig. 4.10).".into(),
        body: Body::Curves {
            x: Axis::linear("phase", "deg"),
            y: Axis::linear("pressure", "Pa"),
            curves: curves.iter().zip(names).map(curve).collect(),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ramp_slopes_one_way_and_a_valley_has_two_piles() {
        let ramp: Vec<f64> = (0..10).map(|k| 0.3 * f64::from(k)).collect();
        assert!((slope(&ramp, 10.0) - 0.3).abs() < 1e-14);
        assert_eq!(one_way(&ramp), 1.0);
        assert!(wall_piles(&ramp).abs() < 1e-14);
        let valley: Vec<f64> = (0..10).map(|k| (f64::from(k) - 4.5).abs()).collect();
        assert_eq!(one_way(&valley), 0.6);
        // Outer three 4.5, 3.5, 2.5; middle 1.5, 0.5, 0.5, 1.5.
        assert!((wall_piles(&valley) - 2.5).abs() < 1e-14);
    }
}

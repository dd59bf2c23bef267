//! A shaken bed in water piles up at the walls of its cell (Clément 4.4, Table 4.2, Fig. 4.4).

use crate::runs::{Done, column};
use crate::study::{Computed, Ran, Request};
use brazilnut_base::Table;
use brazilnut_base::figure::{Axis, Body, Curve, Figure};
use brazilnut_runner::Failure;

const CASE: (&str, &str) =
    ("studies/clement-tilt/case.toml", include_str!("../../../studies/clement-tilt/case.toml"));

/// Mean diameter, m.
const DIAMETER: f64 = 0.7e-3;

/// The part of the published run that decides: until both piles stand (Fig. 4.4 b).
const FULL: [&str; 1] = ["time.end=3 s"];

/// What the short form lays over the case: half as wide, two fifths as deep, three cycles.
const QUICK: [&str; 5] = [
    "cell.size=[\"10 mm\", \"5 mm\", \"10 mm\"]",
    "grains.0.count=500",
    "time.settle=0.15 s",
    "time.end=3 cycles",
    "output.pictures=0",
];

/// Surfaces are averaged over this long before a time, s: single grains come and go.
const WINDOW: f64 = 1.0;

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

    /// Heights of the settled bed, m.
    fn first(&self) -> Vec<f64> {
        self.heights.first().cloned().unwrap_or_default()
    }

    /// Mean heights over the window that ends at `t` (s), without the settled bed, m.
    fn at(&self, t: f64) -> Vec<f64> {
        // Sampling times carry rounding.
        let inside = |x: f64| x > 0.0 && x < t + 1e-6 && x > t - WINDOW + 1e-6;
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

/// Mean height of the outermost fifths of the columns over that of the middle third, m: of the lower pile.
fn lower_pile(heights: &[f64]) -> f64 {
    let mean = |h: &[f64]| h.iter().sum::<f64>() / h.len() as f64;
    let (n, fifth) = (heights.len(), heights.len().div_ceil(5));
    let sides = [mean(&heights[..fifth]), mean(&heights[n - fifth..])];
    sides[0].min(sides[1]) - mean(&heights[n / 3..n - n / 3])
}

/// The quantities and a plot.
///
/// # Errors
/// Whatever the run fails with.
pub fn run(request: &Request) -> Result<Ran, Failure> {
    let overrides: &[&str] = if request.quick { &QUICK } else { &FULL };
    let overrides: Vec<String> = overrides.iter().map(|s| (*s).to_string()).collect();
    let run = Done::new(CASE, &overrides, &request.out.join("navier-stokes"), !request.quick)?;
    let surface = Surface::read(&run.table("surface")?);
    let end = surface.time.last().copied().unwrap_or(f64::NAN);
    let width = if request.quick { 10e-3 } else { 20e-3 };
    let computed = vec![
        Computed::new("slope of the settled bed", slope(&surface.first(), width).abs()),
        Computed::new(
            "height of the lower pile at a wall, at the end",
            lower_pile(&surface.at(end)) / DIAMETER,
        ),
    ];
    let curve = |label: String, h: Vec<f64>| {
        let x = |k: usize| (k as f64 + 0.5) / h.len() as f64 * width;
        Curve::line(label, h.iter().enumerate().map(|(k, z)| [x(k), *z]).collect())
    };
    let mut curves = vec![curve("0 s".into(), surface.first())];
    curves.extend([end / 3.0, 2.0 * end / 3.0, end].map(|t| curve(format!("{t:.1} s"), surface.at(t))));
    let figure = Figure {
        title: "Surface".into(),
        caption: "Height of the bed, means over the second before; at 0 s the settled bed.".into(),
        body: Body::Curves { x: Axis::linear("x", "m"), y: Axis::linear("height", "m"), curves },
    };
    Ok(Ran { computed, figures: vec![figure] })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ramp_slopes_and_a_valley_has_two_piles() {
        let ramp: Vec<f64> = (0..10).map(|k| 0.3 * f64::from(k)).collect();
        assert!((slope(&ramp, 10.0) - 0.3).abs() < 1e-14);
        assert!(lower_pile(&ramp) < 0.0, "one pile is no pair");
        let valley: Vec<f64> = (0..10).map(|k| (f64::from(k) - 4.5).abs()).collect();
        // Outer two 4.5, 3.5; middle 1.5, 0.5, 0.5, 1.5.
        assert!((lower_pile(&valley) - 3.0).abs() < 1e-14);
    }

    #[test]
    fn the_mean_surface_leaves_out_the_settled_bed() {
        let surface = Surface { time: vec![0.0, 0.1, 0.2], heights: vec![vec![9.0], vec![1.0], vec![2.0]] };
        assert_eq!((surface.first(), surface.at(0.2)), (vec![9.0], vec![1.5]));
    }
}

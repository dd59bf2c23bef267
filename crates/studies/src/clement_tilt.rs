//! A shaken bed in water piles up at the walls of its cell and tilts (Clément 4.4, Tables 4.2, 4.4, Figs 4.4, 4.10).

use crate::repeats::Repeats;
use crate::runs::{Done, SEEDS, column};
use crate::study::{Computed, Ran, Request};
use brazilnut_base::Table;
use brazilnut_base::figure::{Axis, Body, Curve, Figure};
use brazilnut_runner::Failure;

const CASE: (&str, &str) =
    ("studies/clement-tilt/case.toml", include_str!("../../../studies/clement-tilt/case.toml"));

/// Mean diameter, m.
const DIAMETER: f64 = 0.7e-3;

/// When the thesis shows the surface, s (Fig. 4.4).
const SHOWN: [f64; 3] = [3.0, 6.0, 11.0];

/// Phases of Table 4.4, degrees.
const PHASES: [f64; 2] = [135.0, 225.0];

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

/// The longest part of the width over which `heights` only rise or only fall, but for a tenth of a diameter.
fn monotonic(heights: &[f64]) -> f64 {
    let longest = |sign: f64| {
        let (mut best, mut start, mut top) = (0, 0, f64::NEG_INFINITY);
        for (k, h) in heights.iter().map(|h| sign * h).enumerate() {
            if h < top - 0.1 * DIAMETER {
                (start, top) = (k, h);
            }
            top = top.max(h);
            best = best.max(k + 1 - start);
        }
        best
    };
    longest(1.0).max(longest(-1.0)) as f64 / heights.len() as f64
}

/// Largest and least pressure of the fluid along the base by phase, Pa, at 20, 40, 60, 80 % of the width.
fn peaks(by_phase: &Table) -> [[f64; 2]; 4] {
    [20, 40, 60, 80].map(|at| {
        let p = column(by_phase, &format!("fluid_at_{at}"));
        [p.iter().copied().fold(f64::NEG_INFINITY, f64::max), p.iter().copied().fold(f64::INFINITY, f64::min)]
    })
}

/// The quantities and plots. Full form: 11 s from three seeds.
///
/// # Errors
/// Whatever a run fails with.
pub fn run(request: &Request) -> Result<Ran, Failure> {
    let folder = request.out.join("navier-stokes");
    if request.quick {
        let overrides = QUICK.map(str::to_string);
        let surface = Surface::read(&Done::new(CASE, &overrides, &folder, false)?.table("surface")?);
        let end = surface.time.last().copied().unwrap_or(f64::NAN);
        let computed = vec![
            Computed::new("slope of the settled bed", slope(&surface.first(), 10e-3).abs()),
            Computed::new(
                "height of the lower pile at a wall, at the end",
                lower_pile(&surface.at(end)) / DIAMETER,
            ),
        ];
        return Ok(Ran { computed, figures: vec![shapes(&surface, &[end], 10e-3, "the short form")] });
    }
    let width = 20e-3;
    let runs = Repeats::new(CASE, &[], &folder, SEEDS.len() as u64, true)?;
    let surfaces: Vec<Surface> = runs.tables("surface")?.iter().map(Surface::read).collect();
    let mean = |name: String, value: &dyn Fn(&Surface) -> f64| {
        Computed::mean(name, &surfaces.iter().map(value).collect::<Vec<_>>())
    };
    let mut computed = vec![
        mean("slope of the settled bed".into(), &|s| slope(&s.first(), width).abs()),
        mean("height of the lower pile at a wall, at 3 s".into(), &|s| {
            lower_pile(&s.at(SHOWN[0])) / DIAMETER
        }),
    ];
    computed.push(mean("height of the lower pile at a wall, at the end".into(), &|s| {
        lower_pile(&s.at(SHOWN[2])) / DIAMETER
    }));
    for (early, late) in [(SHOWN[0], SHOWN[1]), (SHOWN[1], SHOWN[2])] {
        computed.push(mean(format!("slope at {late} s over that at {early} s"), &|s| {
            (slope(&s.at(late), width) / slope(&s.at(early), width)).abs()
        }));
    }
    computed.push(mean("part of the width that rises or falls throughout, at 11 s".into(), &|s| {
        monotonic(&s.at(SHOWN[2]))
    }));

    let points = runs.tables("flow-field-point")?;
    for phase in PHASES {
        for what in ["grain", "fluid", "mixture"] {
            let speed = |t: &Table| {
                let row = column(t, "phase").iter().position(|&p| (p - phase).abs() < 1e-6);
                row.and_then(|k| column(t, &format!("{what}_speed")).get(k).copied()).unwrap_or(f64::NAN)
            };
            let speeds: Vec<f64> = points.iter().map(speed).collect();
            computed.push(Computed::mean(format!("{what} speed at {phase} degrees"), &speeds));
        }
    }

    // From the shallow side, as in the figure.
    let tables = runs.tables("base-pressure-by-phase")?;
    let along: Vec<[[f64; 2]; 4]> = tables
        .iter()
        .zip(&surfaces)
        .map(|(table, surface)| {
            let mut p = peaks(table);
            if slope(&surface.at(SHOWN[2]), width) < 0.0 {
                p.reverse();
            }
            p
        })
        .collect();
    for (k, what) in ["overpressure", "underpressure"].into_iter().enumerate() {
        let deep: Vec<f64> = along.iter().map(|p| p[3][k]).collect();
        let ratio: Vec<f64> = along.iter().map(|p| p[3][k] / p[0][k]).collect();
        computed.push(Computed::mean(format!("{what} at 80 % of the base"), &deep));
        computed.push(Computed::mean(format!("{what} at 80 % over that at 20 %"), &ratio));
    }
    let mut figures: Vec<Figure> = surfaces
        .iter()
        .zip(SEEDS)
        .map(|(s, seed)| shapes(s, &SHOWN, width, &format!("seed {seed}")))
        .collect();
    figures.push(pressures(&tables[0]));
    Ok(Ran { computed, figures })
}

/// The settled surface and those at `times` (s).
fn shapes(surface: &Surface, times: &[f64], width: f64, of: &str) -> Figure {
    let curve = |label: String, h: Vec<f64>| {
        let x = |k: usize| (k as f64 + 0.5) / h.len() as f64 * width;
        Curve::line(label, h.iter().enumerate().map(|(k, z)| [x(k), *z]).collect())
    };
    let mut curves = vec![curve("0 s".into(), surface.first())];
    curves.extend(times.iter().map(|&t| curve(format!("{t:.1} s"), surface.at(t))));
    Figure {
        title: format!("Surface, {of}"),
        caption: "Height of the bed, means over the second before; at 0 s the settled bed.".into(),
        body: Body::Curves { x: Axis::linear("x", "m"), y: Axis::linear("height", "m"), curves },
    }
}

/// Pressure along the base against phase (Fig. 4.10).
fn pressures(table: &Table) -> Figure {
    let phase = column(table, "phase");
    let curve = |at: u32| {
        let p = column(table, &format!("fluid_at_{at}"));
        Curve::line(format!("{at} % of the width"), phase.iter().zip(p).map(|(x, y)| [*x, y]).collect())
    };
    Figure {
        title: "Pressure along the base, seed 1".into(),
        caption: "The fluid's part, the hydrostatic one removed, mean over the last two seconds.".into(),
        body: Body::Curves {
            x: Axis::linear("phase", "deg"),
            y: Axis::linear("pressure", "Pa"),
            curves: [20, 40, 60, 80].map(curve).to_vec(),
        },
    }
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
    fn a_step_back_ends_a_monotonic_part() {
        let d = DIAMETER;
        assert!((monotonic(&[0.0, d, 2.0 * d, 1.95 * d, 3.0 * d]) - 1.0).abs() < 1e-14);
        // Three of five: down, then up.
        assert!((monotonic(&[2.0 * d, d, 0.0, d, 2.0 * d]) - 0.6).abs() < 1e-14);
    }

    #[test]
    fn the_mean_surface_leaves_out_the_settled_bed() {
        let surface = Surface { time: vec![0.0, 0.1, 0.2], heights: vec![vec![9.0], vec![1.0], vec![2.0]] };
        assert_eq!((surface.first(), surface.at(0.2)), (vec![9.0], vec![1.5]));
    }
}

//! A sphere squeezes the fluid out between itself and a wall (Clément 2009, 2.8, Figs 2.34-2.36).

use crate::runs::{Done, column};
use crate::study::{Computed, Ran, Request};
use brazilnut_base::figure::{Axis, Body, Curve, Figure, Style};
use brazilnut_runner::Failure;

const CASE: (&str, &str) =
    ("studies/clement-lubrication/case.toml", include_str!("../../../studies/clement-lubrication/case.toml"));

/// Radius, m.
const RADIUS: f64 = 362.5e-6;
/// Height of the imaginary wall, m.
const MIDDLE: f64 = 7.25e-3;
/// Gaps at the start over the radius.
const STARTS: [f64; 7] = [0.2, 0.6, 1.0, 1.4, 1.8, 3.0, 5.0];
/// A gap at rest below this many radii is contact.
const TOUCHING: f64 = 0.01;

/// The path of the sphere: time (s), gap over the radius, velocity away from the wall (m/s).
struct Path {
    time: Vec<f64>,
    gap: Vec<f64>,
    velocity: Vec<f64>,
    /// Index of the first sample that moves away from the wall, or beyond the imaginary one.
    turn: usize,
}

impl Path {
    /// From a gap of `start` radii above the plane at `wall` (m).
    fn new(start: f64, wall: f64, request: &Request) -> Result<Self, Failure> {
        let z = wall + (1.0 + start) * RADIUS;
        let mut overrides = vec![format!("grains.0.at=[\"1.8125 mm\", \"1.8125 mm\", \"{z} m\"]")];
        let imaginary = wall > 0.0;
        if request.quick || imaginary {
            overrides.push("time.end=20 ms".into());
        }
        let folder = request.out.join(format!("{}{start}", if imaginary { "imaginary-" } else { "gap-" }));
        let table = Done::new(CASE, &overrides, &folder, !request.quick)?.table("trajectory")?;
        let gap: Vec<f64> = column(&table, "height").iter().map(|z| (z - wall - RADIUS) / RADIUS).collect();
        let velocity = column(&table, "velocity_z");
        let turn = if imaginary {
            gap.iter().position(|s| *s <= 0.0)
        } else {
            velocity.iter().position(|v| *v >= 0.0)
        };
        Ok(Self { time: column(&table, "time"), turn: turn.unwrap_or(gap.len() - 1), gap, velocity })
    }

    /// Speed of the last sample before the wall is touched, m/s.
    fn impact(&self) -> f64 {
        (0..self.turn).rev().find(|k| self.gap[*k] > 0.0).map_or(0.0, |k| -self.velocity[k])
    }

    /// Gap at the end, in radii.
    fn rest(&self) -> f64 {
        self.gap[self.gap.len() - 1].max(0.0)
    }

    /// How far it came back from its largest gap after the impact, in radii.
    fn back(&self) -> f64 {
        self.gap[self.turn..].iter().fold(0.0_f64, |a, b| a.max(*b)) - self.rest()
    }

    /// Speed at the gap `s` on the way in; on the way out with `s` of the sign it then has. Zero if it does not get there.
    fn speed(&self, s: f64, out: bool) -> f64 {
        let (low, high) = if out { (self.turn, self.gap.len()) } else { (0, self.turn + 1) };
        let crossed = |k: &usize| (self.gap[*k] - s) * (self.gap[*k + 1] - s) <= 0.0;
        (low..high - 1).find(crossed).map_or(0.0, |k| {
            let part = (s - self.gap[k]) / (self.gap[k + 1] - self.gap[k]);
            (self.velocity[k] + part * (self.velocity[k + 1] - self.velocity[k])).abs()
        })
    }

    /// Apparent coefficient of restitution at the gap `s` (Clément eq. 2.113).
    fn restitution(&self, s: f64, imaginary: bool) -> f64 {
        self.speed(if imaginary { -s } else { s }, true) / self.speed(s, false)
    }
}

/// The quantities and plots. Full form: the subset that decides.
///
/// # Errors
/// Whatever a run fails with.
pub fn run(request: &Request) -> Result<Ran, Failure> {
    let starts: &[f64] = if request.quick { &STARTS[2..3] } else { &STARTS };
    let paths: Vec<Path> = starts.iter().map(|s| Path::new(*s, 0.0, request)).collect::<Result<_, _>>()?;
    let imaginary = Path::new(1.0, MIDDLE, request)?;
    let one = &paths[starts.iter().position(|s| *s == 1.0).unwrap_or(0)];
    let early = imaginary.time.iter().position(|t| *t >= 0.999e-3).unwrap_or(0);
    let mut computed = vec![
        Computed::new("speed 1 ms after the release", -imaginary.velocity[early]),
        Computed::new("apparent e at s = 0.05 r", one.restitution(0.05, false)),
        Computed::new("apparent e at s = 0.5 r", one.restitution(0.5, false)),
        Computed::new("apparent e at s = 0.5 r, imaginary wall", imaginary.restitution(0.5, true)),
    ];
    if let [close, _, at_one, far, beyond, three, five] = &paths[..] {
        let touching = paths.iter().filter(|p| p.rest() < TOUCHING).map(Path::impact).fold(0.0, f64::max);
        computed.extend([
            Computed::new("way back from the largest gap, s0 = 1.4 r", far.back()),
            Computed::new("way back from the largest gap, s0 = 1.8 r", beyond.back()),
            Computed::new("way back at s0 = 3 r over that at 1.8 r", three.back() / beyond.back()),
            Computed::new("gap at rest at s0 = r over that at 0.2 r", at_one.rest() / close.rest()),
            Computed::new("gap at rest at s0 = 1.4 r over that at r", far.rest() / at_one.rest()),
            Computed::new("gap at rest, s0 = 5 r", five.rest()),
            Computed::new("largest impact speed that ends at the wall", touching),
            Computed::new("gap at rest after an impact at 0.12 m/s", at_impact(&paths, 0.12)),
        ]);
    }
    Ok(Ran { computed, figures: figures(starts, &paths, one, &imaginary) })
}

/// Gap at rest at an impact speed between those of the runs; linear.
fn at_impact(paths: &[Path], speed: f64) -> f64 {
    let mut list: Vec<[f64; 2]> = paths.iter().map(|p| [p.impact(), p.rest()]).collect();
    list.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let between = list.windows(2).find(|w| w[0][0] <= speed && speed <= w[1][0]);
    between.map_or(f64::NAN, |w| w[0][1] + (speed - w[0][0]) / (w[1][0] - w[0][0]) * (w[1][1] - w[0][1]))
}

fn figures(starts: &[f64], paths: &[Path], one: &Path, imaginary: &Path) -> Vec<Figure> {
    let figure = |title: &str, caption: &str, x, y, curves| Figure {
        title: title.into(),
        caption: caption.into(),
        body: Body::Curves { x, y, curves },
    };
    let gaps = starts.iter().zip(paths).map(|(s, p)| {
        Curve::line(format!("s0 = {s} r"), p.time.iter().zip(&p.gap).map(|(t, g)| [*t, *g]).collect())
    });
    let rests = paths.iter().map(|p| [p.impact(), p.rest()]).collect();
    let e = |p: &Path, is: bool| {
        (1..=50).map(|k| 0.01 * f64::from(k)).map(|s| [s, p.restitution(s, is)]).collect()
    };
    let gap = || Axis::linear("gap over radius", "1");
    vec![
        figure(
            "Approach and rebound",
            "Released at 0.26 m/s.",
            Axis::linear("time", "s"),
            gap(),
            gaps.collect(),
        ),
        figure(
            "Gap at rest over impact speed",
            "At the end of each run.",
            Axis::linear("impact speed", "m/s"),
            gap(),
            vec![Curve::line("FS", rests).styled(Style::Points)],
        ),
        figure(
            "Apparent restitution",
            "Speed away from the wall over speed towards it at one gap, s0 = r.",
            gap(),
            Axis::linear("e", "1"),
            vec![
                Curve::line("wall", e(one, false)),
                Curve::line("imaginary wall", e(imaginary, true)).styled(Style::Dashed),
            ],
        ),
    ]
}

//! Convection between rough side walls (Lan 5.1, Tables 5.1 and 5.2, Figs A5.1-A5.7).

use crate::maps::Field;
use crate::runs::{Done, SEEDS};
use crate::study::{Computed, Ran, Request};
use brazilnut_base::figure::{Axis, Body, Curve, Figure};
use brazilnut_runner::Failure;

const CASE: (&str, &str) =
    ("studies/lan-convection/case.toml", include_str!("../../../studies/lan-convection/case.toml"));

/// Diameter of the grains, m.
const DIAMETER: f64 = 0.1;

/// Frequency, Hz, and amplitude over diameter: Table 5.1, its middle row in both readings.
const AMPLITUDES: [(f64, f64); 4] = [(7.0, 0.5), (7.878, 0.4), (7.878, 0.3), (9.996, 0.25)];
/// That of most of the thesis; the table does not say.
const RESTITUTION: f64 = 0.9;
/// Friction between grains and at the walls (Table 5.2); its first pair is that of Table 5.1.
const FRICTIONS: [(f64, f64); 3] = [(0.8, 0.2), (0.8, 0.0), (0.0, 0.8)];

/// Cells of a smaller solids fraction have few visitors and are left out of means and maps.
const LEAST: f64 = 0.05;

/// What the short form lays over the case.
const QUICK: [&str; 2] = ["time.end=9 s", "observe.0.from=3 s"];

/// A bed and its mean fields, one per seed.
struct Bed {
    name: String,
    fields: Vec<Field>,
}

impl Bed {
    fn new(name: String, overrides: &[String], request: &Request) -> Result<Self, Failure> {
        let seeds = if request.quick { &SEEDS[..1] } else { &SEEDS };
        let field = |seed: &u64| {
            let mut all = overrides.to_vec();
            all.push(format!("seed={seed}"));
            if request.quick {
                all.extend(QUICK.map(String::from));
            }
            let folder = request.out.join(format!("{name}-seed-{seed}"));
            let run = Done::new(CASE, &all, &folder, !request.quick)?;
            Ok(Field::new(&run.table("field-long-term")?, LEAST))
        };
        let fields = seeds.iter().map(field).collect::<Result<_, Failure>>()?;
        Ok(Self { name, fields })
    }

    /// What `of` finds in the mean field of all seeds, with its error by the jackknife over the seeds.
    ///
    /// Scatter gives every cell a speed, which falls with the time of the mean: the mean field of three
    /// runs of 15 s is as good as one of 45 s, the mean speed of three such fields is not.
    fn pooled(&self, what: &str, of: impl Fn(&Field) -> f64) -> Computed {
        let n = self.fields.len();
        let value = of(&Field::mean(self.fields.iter()));
        let without = |k: usize| {
            let rest = self.fields.iter().enumerate().filter(|(i, _)| *i != k).map(|(_, f)| f);
            of(&Field::mean(rest))
        };
        let error = (n > 1).then(|| {
            let parts: Vec<f64> = (0..n).map(without).collect();
            let mean = parts.iter().sum::<f64>() / n as f64;
            let square: f64 = parts.iter().map(|x| (x - mean).powi(2)).sum();
            ((n - 1) as f64 / n as f64 * square).sqrt()
        });
        Computed { name: format!("{what}, {}", self.name), value, error }
    }

    fn speed(&self) -> Computed {
        self.pooled("mean convection speed", Field::speed)
    }

    fn along_the_walls(&self) -> Computed {
        self.pooled("mean vertical velocity along the walls", Field::along_the_walls)
    }

    fn down_stream(&self) -> Computed {
        self.pooled("width of the stream along a wall", |f| f.turning(1) / DIAMETER)
    }

    fn map(&self, title: &str) -> Figure {
        let caption = "Arrows: mean velocity of the grains whose centres are in a cell of one diameter (Lan, Fig. 5.1), mean of all seeds.";
        Field::mean(self.fields.iter()).map(format!("Mean velocity: {title}"), caption)
    }
}

/// A run of Table 5.1: restitution, then frequency (Hz) and amplitude over diameter.
fn amplitude(e: f64, (f, a): (f64, f64), request: &Request) -> Result<Bed, Failure> {
    let overrides = [
        format!("shaking.frequency={f} Hz"),
        format!("shaking.displacement_amplitude={} m", a * DIAMETER),
        format!("contact.restitution={e}"),
    ];
    Bed::new(format!("a {a} d, e {e}"), &overrides, request)
}

/// A run of Table 5.2: friction between grains and at the walls.
fn friction((grains, walls): (f64, f64), request: &Request) -> Result<Bed, Failure> {
    let overrides = [format!("contact.friction={grains}"), format!("contact.pairs.0.friction={walls}")];
    Bed::new(format!("friction {grains} and {walls}"), &overrides, request)
}

/// The quantities and plots.
///
/// # Errors
/// Whatever a run fails with.
pub fn run(request: &Request) -> Result<Ran, Failure> {
    if request.quick {
        return quick(request);
    }
    let beds: Vec<Bed> =
        AMPLITUDES.iter().map(|&a| amplitude(RESTITUTION, a, request)).collect::<Result<_, _>>()?;
    let [strong, middle, _, weak] = &beds[..] else { unreachable!("there are four amplitudes") };
    let soft = amplitude(0.6, AMPLITUDES[0], request)?;
    let pairs: Vec<Bed> = FRICTIONS.into_iter().map(|f| friction(f, request)).collect::<Result<_, _>>()?;
    let open = Bed::new("periodic sides".into(), &["cell.x=periodic".into()], request)?;
    let wide = Bed::new(
        "20d cell".into(),
        &["cell.size=[\"2.0 m\", \"0.3 m\", \"2.1 m\"]".into(), "grains.0.count=573".into()],
        request,
    )?;
    let mut computed: Vec<Computed> = beds.iter().chain([&soft, &open]).map(Bed::speed).collect();
    computed.extend([
        ratio("speed at 0.5 d over that at 0.4 d", strong, middle),
        ratio("speed at 0.4 d over that at 0.25 d", middle, weak),
        ratio("speed at 0.5 d over that at 0.25 d", strong, weak),
        ratio("speed at restitution 0.6 over that at 0.9", &soft, strong),
        ratio("speed at wall friction 0.8 over that at 0.2", strong, &pairs[0]),
    ]);
    computed.extend(std::iter::once(strong).chain(&pairs).chain([&wide]).map(Bed::along_the_walls));
    computed.extend([strong.down_stream(), pairs[1].down_stream(), wide.down_stream()]);
    let streams: Vec<&Bed> = std::iter::once(strong).chain(&pairs).chain([&wide]).collect();
    let figures = vec![
        strong.map("a 0.5 d, 7 Hz, friction 0.8 (Fig. A5.1c)"),
        weak.map("a 0.25 d, 9.996 Hz, friction 0.8 (Fig. A5.1a)"),
        pairs[1].map("rough grains, smooth walls (Fig. A5.5)"),
        pairs[2].map("smooth grains, rough walls (Fig. A5.6)"),
        wide.map("20 d by 3 d (Fig. A5.7)"),
        speeds(&beds),
        vertical(&streams),
    ];
    Ok(Ran { computed, figures })
}

/// The short form: the strongest and the weakest shaking, and smooth grains between rough walls.
fn quick(request: &Request) -> Result<Ran, Failure> {
    let strong = amplitude(RESTITUTION, AMPLITUDES[0], request)?;
    let smooth = friction(FRICTIONS[2], request)?;
    let computed = vec![strong.along_the_walls(), smooth.along_the_walls()];
    let figures = vec![strong.map("a 0.5 d, 7 Hz, friction 0.8"), vertical(&[&strong, &smooth])];
    Ok(Ran { computed, figures })
}

/// Ratio of two mean speeds, with the error of each.
fn ratio(name: &str, a: &Bed, b: &Bed) -> Computed {
    let (a, b) = (a.speed(), b.speed());
    let part = |c: &Computed| c.error.map(|e| (e / c.value).powi(2));
    let value = a.value / b.value;
    let error = part(&a).zip(part(&b)).map(|(x, y)| value * (x + y).sqrt());
    Computed { name: name.into(), value, error }
}

fn speeds(beds: &[Bed]) -> Figure {
    let curve = |bed: &Bed| Curve::line(&bed.name, Field::mean(bed.fields.iter()).speeds());
    Figure {
        title: "Speed by column (Figs A5.2)".into(),
        caption: "Mean magnitude of the mean velocity over the cells of each column, mean of all seeds."
            .into(),
        body: Body::Curves {
            x: Axis::linear("x", "m"),
            y: Axis::linear("mean speed", "m/s"),
            curves: beds.iter().map(curve).collect(),
        },
    }
}

fn vertical(beds: &[&Bed]) -> Figure {
    let curve = |bed: &&Bed| Curve::line(&bed.name, Field::mean(bed.fields.iter()).folded());
    Figure {
        title: "Vertical velocity by column (Table 5.2)".into(),
        caption: "Mean vertical velocity of the grains of each column against the distance from the nearer wall, mean of all seeds; below zero is down.".into(),
        body: Body::Curves {
            x: Axis::linear("distance from the wall", "m"),
            y: Axis::linear("vertical velocity", "m/s"),
            curves: beds.iter().map(curve).collect(),
        },
    }
}

//! Convection between rough side walls (Lan 5.1, Tables 5.1 and 5.2, Figs A5.1-A5.7); the cell of 100 d is that
//! of `lan-arching`.

use crate::maps::Field;
use crate::runs::{Done, SEEDS};
use crate::study::{Computed, Ran, Request};
use brazilnut_base::figure::{Axis, Body, Curve, Figure};
use brazilnut_runner::Failure;

const CASE: (&str, &str) =
    ("studies/lan-convection/case.toml", include_str!("../../../studies/lan-convection/case.toml"));

/// Diameter of the grains, m.
const DIAMETER: f64 = 0.1;

/// Frequency, Hz, and amplitude over diameter: Table 5.1, the amplitude of its middle row as its
/// frequency and acceleration have it and as printed.
const AMPLITUDES: [(f64, f64); 4] = [(7.0, 0.5), (7.878, 0.4), (7.878, 0.3), (9.996, 0.25)];
/// Friction between grains and at the walls: Table 5.2 without its first row, which is that of Table 5.1.
const FRICTIONS: [(f64, f64); 3] = [(0.8, 0.2), (0.8, 0.0), (0.0, 0.8)];

/// The same five layers in a cell 20 d wide (Fig. A5.7).
const WIDE: [&str; 2] = ["cell.size=[\"2 m\", \"0.3 m\", \"2.1 m\"]", "grains.0.count=573"];

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
    /// runs of 80 s is as good as one of 240 s, the mean speed of three such fields is not.
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

    fn in_the_middle(&self) -> Computed {
        self.pooled("mean vertical velocity in the middle", Field::in_the_middle)
    }

    fn map(&self, title: &str) -> Figure {
        let caption = "Arrows: mean velocity of the grains whose centres are in a cell of one diameter (Lan, Fig. 5.1), mean of all seeds.";
        Field::mean(self.fields.iter()).map(format!("Mean velocity: {title}"), caption)
    }
}

/// A run of Table 5.1: frequency (Hz) and amplitude over diameter.
fn amplitude((f, a): (f64, f64), request: &Request) -> Result<Bed, Failure> {
    let overrides =
        [format!("shaking.frequency={f} Hz"), format!("shaking.displacement_amplitude={} m", a * DIAMETER)];
    Bed::new(format!("a {a} d"), &overrides, request)
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
    let [strong, middle, printed, weak] = AMPLITUDES.map(|a| amplitude(a, request));
    let [strong, middle, printed, weak] = [strong?, middle?, printed?, weak?];
    let [less, smooth_walls, smooth_grains] = FRICTIONS.map(|f| friction(f, request));
    let [less, smooth_walls, smooth_grains] = [less?, smooth_walls?, smooth_grains?];
    let wide = Bed::new("20d cell".into(), &WIDE.map(String::from), request)?;
    let computed = vec![
        strong.speed(),
        middle.speed(),
        printed.speed(),
        weak.speed(),
        ratio("speed at 0.5 d over that at 0.25 d", &strong, &weak),
        strong.along_the_walls(),
        less.along_the_walls(),
        ratio("speed with wall friction 0.8 over that with 0.2", &strong, &less),
        smooth_walls.along_the_walls(),
        smooth_grains.along_the_walls(),
        strong.down_stream(),
        wide.along_the_walls(),
        wide.down_stream(),
        wide.in_the_middle(),
    ];
    let figures = vec![
        strong.map("a 0.5 d, 7 Hz, friction 0.8 (Fig. A5.1c)"),
        weak.map("a 0.25 d, 9.996 Hz, friction 0.8 (Fig. A5.1a)"),
        less.map("friction 0.8, at the walls 0.2 (Fig. A5.4)"),
        smooth_walls.map("rough grains, smooth walls (Fig. A5.5)"),
        smooth_grains.map("smooth grains, rough walls (Fig. A5.6)"),
        wide.map("a 0.5 d, 7 Hz, friction 0.8, cell of 20 d (Fig. A5.7)"),
        speeds(&[&strong, &middle, &printed, &weak]),
        vertical(&[&strong, &less, &smooth_walls, &smooth_grains, &wide]),
    ];
    Ok(Ran { computed, figures })
}

/// The short form: the strongest shaking alone.
fn quick(request: &Request) -> Result<Ran, Failure> {
    let strong = amplitude(AMPLITUDES[0], request)?;
    let figures = vec![strong.map("a 0.5 d, 7 Hz, friction 0.8"), vertical(&[&strong])];
    Ok(Ran { computed: vec![strong.along_the_walls()], figures })
}

/// Ratio of two mean speeds, with the error of each.
fn ratio(name: &str, a: &Bed, b: &Bed) -> Computed {
    let (a, b) = (a.speed(), b.speed());
    let part = |c: &Computed| c.error.map(|e| (e / c.value).powi(2));
    let value = a.value / b.value;
    let error = part(&a).zip(part(&b)).map(|(x, y)| value * (x + y).sqrt());
    Computed { name: name.into(), value, error }
}

fn speeds(beds: &[&Bed]) -> Figure {
    let curve = |bed: &&Bed| Curve::line(&bed.name, Field::mean(bed.fields.iter()).speeds());
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

//! A large sphere in a convecting bed (Lan 5.2, Figs A5.12-A5.17).

use crate::runs::{Done, SEEDS, column};
use crate::study::{Computed, Ran, Request};
use brazilnut_base::Table;
use brazilnut_base::figure::{Axis, Body, Curve, Figure};
use brazilnut_runner::Failure;

const CASE: (&str, &str) =
    ("studies/lan-large-sphere/case.toml", include_str!("../../../studies/lan-large-sphere/case.toml"));

/// Diameter of the grains, m.
const SMALL: f64 = 0.1;

/// Frequency of the floor, Hz.
const FLOOR: f64 = 7.0;

/// Samples per cycle of the tables `height` and `trajectory`, and cycles in a running mean (1 s).
const HEIGHTS: usize = 12;
const CYCLES: usize = 7;

/// Restitution of grains and of walls (Fig. A5.15), beside the case's 0.6 of both.
const RESTITUTIONS: [(f64, f64); 3] = [(0.9, 0.9), (0.9, 0.6), (0.6, 0.9)];

/// The same five layers in a cell 20 d wide (Fig. A5.13).
const WIDE: [&str; 4] = [
    "cell.size=[\"2 m\", \"0.3 m\", \"2.1 m\"]",
    "grains.0.count=573",
    "grains.1.at=[\"1 m\", \"0.15 m\", \"0.15 m\"]",
    "time.end=200 s",
];

/// A bed and its sphere, once per seed.
struct Bed {
    name: String,
    runs: Vec<Run>,
}

/// Tables of one run.
struct Run {
    height: Table,
    sphere: Table,
    spectrum: Table,
}

impl Bed {
    fn new(name: &str, overrides: &[String], seeds: &[u64], request: &Request) -> Result<Self, Failure> {
        let run = |seed: &u64| {
            let mut all = overrides.to_vec();
            all.push(format!("seed={seed}"));
            let run =
                Done::new(CASE, &all, &request.out.join(format!("{name}-seed-{seed}")), !request.quick)?;
            Ok(Run {
                height: run.table("height")?,
                sphere: run.table("trajectory")?,
                spectrum: run.table("trajectory-spectrum")?,
            })
        };
        let runs = seeds.iter().map(run).collect::<Result<_, Failure>>()?;
        Ok(Self { name: name.into(), runs })
    }

    fn each(&self, of: impl Fn(&Run) -> f64) -> Vec<f64> {
        self.runs.iter().map(of).collect()
    }

    fn mean(&self, what: &str, of: impl Fn(&Run) -> f64) -> Computed {
        Computed::mean(format!("{what}, {}", self.name), &self.each(of))
    }

    /// Its time to the top over that of another.
    fn slower_than(&self, other: &Self) -> Computed {
        let name = format!("time to the top, {} over {}", self.name, other.name);
        Computed::ratio(name, &self.each(Run::time_to_the_top), &other.each(Run::time_to_the_top))
    }
}

impl Run {
    /// Running means over a second of a column of the table `height`: middle of the second, value.
    fn running(&self, name: &str) -> Vec<[f64; 2]> {
        let window = HEIGHTS * CYCLES;
        let (t, y) = (column(&self.height, "time"), column(&self.height, name));
        let mean = |w: &[f64]| w.iter().sum::<f64>() / window as f64;
        t.windows(window).zip(y.windows(window)).step_by(HEIGHTS).map(|(t, y)| [mean(t), mean(y)]).collect()
    }

    /// When the top of the sphere has come up to the surface of the others, s; the end of the run if it does not.
    fn time_to_the_top(&self) -> f64 {
        let depth = self.running("depth");
        let end = column(&self.height, "time").last().copied().unwrap_or(f64::NAN);
        depth.iter().find(|p| p[1] <= 0.0).map_or(end, |p| p[0])
    }

    /// How far its top was below the surface of the others, at most, once it had come up, in diameters of the
    /// small ones.
    fn deepest_later(&self) -> f64 {
        let top = self.time_to_the_top();
        let later = self.running("depth").into_iter().filter(|p| p[0] > top);
        later.map(|p| p[1] / SMALL).fold(0.0, f64::max)
    }

    /// How far its centre rose above where it was at first, in diameters of the small ones.
    fn rise(&self) -> f64 {
        let h = self.running("height");
        (h.iter().map(|p| p[1]).fold(0.0, f64::max) - h[0][1]) / SMALL
    }

    /// Frequency of the largest power of the vertical velocity below the floor's, Hz. What is slower than
    /// the window of a second belongs to the rise itself.
    fn peak(&self) -> f64 {
        let (f, p) = (column(&self.spectrum, "frequency"), column(&self.spectrum, "velocity_z"));
        let slow = (0..f.len()).filter(|&k| f[k] > 1.0 && f[k] < FLOOR - 0.5);
        slow.max_by(|&a, &b| p[a].total_cmp(&p[b])).map_or(f64::NAN, |k| f[k])
    }

    /// Power within half a hertz of the published peak over that within half a hertz of the floor's frequency.
    fn slow_over_floor(&self) -> f64 {
        let (f, p) = (column(&self.spectrum, "frequency"), column(&self.spectrum, "velocity_z"));
        let power = |of: f64| (0..f.len()).filter(|&k| (f[k] - of).abs() <= 0.5).map(|k| p[k]).sum::<f64>();
        power(2.5) / power(FLOOR)
    }

    /// Rows of the trajectory while the sphere goes up under the full shake: phase in cycles, contacts, velocity.
    fn going_up(&self) -> Vec<[f64; 3]> {
        let [t, cycle, n, v] = ["time", "cycle", "contacts", "velocity_z"].map(|c| column(&self.sphere, c));
        let top = self.time_to_the_top();
        (0..t.len())
            .filter(|&k| t[k] > 1.0 && t[k] < top)
            .map(|k| [cycle[k].rem_euclid(1.0), n[k], v[k]])
            .collect()
    }

    /// Mean number of contacts while the floor rises over that while it falls.
    fn contacts_rising(&self) -> f64 {
        let rows = self.going_up();
        let mean = |up: bool| {
            let of = rows.iter().filter(|r| (r[0] < 0.25 || r[0] >= 0.75) == up);
            let (sum, n) = of.fold((0.0, 0.0), |(s, n), r| (s + r[1], n + 1.0));
            sum / n
        };
        mean(true) / mean(false)
    }

    /// Smallest number of contacts while the floor falls from its highest place to its fastest.
    fn fewest_contacts(&self) -> f64 {
        let falling = self.going_up().into_iter().filter(|r| (0.25..0.5).contains(&r[0]));
        falling.map(|r| r[1]).fold(f64::INFINITY, f64::min)
    }

    /// Correlation coefficient of the number of contacts and the vertical velocity.
    fn correlation(&self) -> f64 {
        let rows = self.going_up();
        let n = rows.len() as f64;
        let mean = |c: usize| rows.iter().map(|r| r[c]).sum::<f64>() / n;
        let (a, b) = (mean(1), mean(2));
        let sum = |f: &dyn Fn(&[f64; 3]) -> f64| rows.iter().map(f).sum::<f64>();
        let product = sum(&|r| (r[1] - a) * (r[2] - b));
        product / (sum(&|r| (r[1] - a).powi(2)) * sum(&|r| (r[2] - b).powi(2))).sqrt()
    }
}

/// The quantities and plots.
///
/// # Errors
/// Whatever a run fails with.
pub fn run(request: &Request) -> Result<Ran, Failure> {
    if request.quick {
        let bed = Bed::new("6d cell", &["time.end=12 s".into()], &SEEDS[..1], request)?;
        let computed = vec![bed.mean("rise", Run::rise)];
        return Ok(Ran { computed, figures: vec![heights(&bed, "Fig. A5.12")] });
    }
    let bed = Bed::new("6d cell", &[], &SEEDS, request)?;
    let restitutions = RESTITUTIONS.map(|(grains, walls)| {
        let overrides =
            [format!("contact.restitution={grains}"), format!("contact.pairs.0.restitution={walls}")];
        Bed::new(&format!("restitution {grains} and {walls}"), &overrides, &SEEDS, request)
    });
    let [lively, lively_grains, lively_walls] = restitutions;
    let [lively, lively_grains, lively_walls] = [lively?, lively_grains?, lively_walls?];
    let wide = Bed::new("20d cell", &WIDE.map(String::from), &SEEDS, request)?;
    let computed = vec![
        bed.mean("time to the top", Run::time_to_the_top),
        bed.mean("rise", Run::rise),
        bed.mean("peak of the spectrum below 7 Hz", Run::peak),
        bed.mean("power around 2.5 Hz over that around 7 Hz", Run::slow_over_floor),
        bed.mean("contacts while the floor rises over those while it falls", Run::contacts_rising),
        bed.mean("fewest contacts while the floor falls", Run::fewest_contacts),
        bed.mean("correlation of contacts and velocity", Run::correlation),
        bed.mean("deepest place after it has come up", Run::deepest_later),
        lively.mean("time to the top", Run::time_to_the_top),
        lively.slower_than(&bed),
        lively_grains.slower_than(&lively_walls),
        wide.mean("deepest place after it has come up", Run::deepest_later),
        wide.slower_than(&bed),
    ];
    let figures = vec![
        heights(&bed, "Fig. A5.12"),
        heights(&wide, "Fig. A5.13"),
        against_restitution(&[&bed, &lively_walls, &lively_grains, &lively]),
        spectra(&bed),
        cycle(&bed),
    ];
    Ok(Ran { computed, figures })
}

fn heights(bed: &Bed, place: &str) -> Figure {
    let curve = |(k, r): (usize, &Run)| Curve::line(format!("seed {}", k + 1), r.running("height"));
    Figure {
        title: format!("Height of the sphere, {} ({place})", bed.name),
        caption: "Centre of the sphere above the floor, running mean over a second.".into(),
        body: Body::Curves {
            x: Axis::linear("time", "s"),
            y: Axis::linear("height", "m"),
            curves: bed.runs.iter().enumerate().map(curve).collect(),
        },
    }
}

fn against_restitution(beds: &[&Bed]) -> Figure {
    let curve = |bed: &&Bed| Curve::line(&bed.name, bed.runs[0].running("height"));
    Figure {
        title: "Height of the sphere against restitution (Fig. A5.15)".into(),
        caption: "Centre of the sphere above the floor, running mean over a second, seed 1; restitution of grains and of walls, 0.6 of both in the 6d cell.".into(),
        body: Body::Curves {
            x: Axis::linear("time", "s"),
            y: Axis::linear("height", "m"),
            curves: beds.iter().map(curve).collect(),
        },
    }
}

fn spectra(bed: &Bed) -> Figure {
    let curve = |(k, r): (usize, &Run)| {
        let (f, p) = (column(&r.spectrum, "frequency"), column(&r.spectrum, "velocity_z"));
        let points = f.into_iter().zip(p).skip(1).filter(|p| p.0 < 20.0).map(|(f, p)| [f, p]).collect();
        Curve::line(format!("seed {}", k + 1), points)
    };
    Figure {
        title: "Spectrum of the sphere's vertical velocity (Fig. A5.14a)".into(),
        caption: "Power spectral density by Welch's method; the floor moves at 7 Hz.".into(),
        body: Body::Curves {
            x: Axis::log("frequency", "Hz"),
            y: Axis::log("power spectral density", "m^2/s"),
            curves: bed.runs.iter().enumerate().map(curve).collect(),
        },
    }
}

/// Contacts and velocity over a second of the rise.
fn cycle(bed: &Bed) -> Figure {
    let run = &bed.runs[0];
    let [t, n, v] = ["time", "contacts", "velocity_z"].map(|c| column(&run.sphere, c));
    let middle = 0.5 * run.time_to_the_top();
    let shown: Vec<usize> = (0..t.len()).filter(|&k| t[k] >= middle && t[k] < middle + 1.0).collect();
    let curve = |label: &str, y: &[f64]| Curve::line(label, shown.iter().map(|&k| [t[k], y[k]]).collect());
    Figure {
        title: "Contacts and velocity of the sphere (Fig. A5.17)".into(),
        caption: "A second of the rise, seed 1: number of grains and walls that touch it, and its vertical velocity in m/s.".into(),
        body: Body::Curves {
            x: Axis::linear("time", "s"),
            y: Axis::linear("contacts; velocity in m/s", "1"),
            curves: vec![curve("contacts", &n), curve("vertical velocity", &v)],
        },
    }
}

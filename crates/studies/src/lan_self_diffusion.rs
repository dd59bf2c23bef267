//! Self-diffusion of grains in a vibrated layer (Lan 4.4, Tables 4.4-4.8, Figs A4.15-A4.27).

use crate::repeats::Repeats;
use crate::runs::{SEEDS, column, first};
use crate::study::{Computed, Ran, Request};
use brazilnut_base::Table;
use brazilnut_base::figure::{Axis, Body, Curve, Figure, Style};
use brazilnut_bed::kinetic_theory::closure::self_diffusion;
use brazilnut_runner::Failure;

const CASE: (&str, &str) =
    ("studies/lan-self-diffusion/case.toml", include_str!("../../../studies/lan-self-diffusion/case.toml"));

/// One shake: peak acceleration over gravity as the thesis prints it or, where that does not follow from the other two,
/// as they give it; frequency, Hz; amplitude, mm.
#[derive(Clone, Copy)]
struct Shake {
    name: &'static str,
    frequency: f64,
    amplitude: f64,
    /// Table 4.5 prints the mean of the three directions; Tables 4.6 and 4.7 the directions across the shake.
    mean: bool,
}

/// Lan Tables 4.4-4.7: the same frequency with more and more amplitude, then the same amplitude.
const SHAKES: [Shake; 6] = [
    Shake { name: "90", frequency: 50.0, amplitude: 8.9, mean: true },
    Shake { name: "503", frequency: 50.0, amplitude: 50.0, mean: true },
    Shake { name: "10 at 50 Hz", frequency: 50.0, amplitude: 1.03, mean: false },
    Shake { name: "5", frequency: 5.0, amplitude: 50.0, mean: false },
    Shake { name: "10", frequency: 7.0, amplitude: 50.0, mean: false },
    Shake { name: "20", frequency: 10.0, amplitude: 50.0, mean: false },
];

/// Diameter, m, and restitution.
const DIAMETER: f64 = 0.1;
const RESTITUTION: f64 = 0.9;

/// What the short form lays over the case: the steady state is cut short.
const QUICK: [&str; 3] = ["time.end=8 s", "observe.0.from=4 s", "observe.1.from=4 s"];

/// Tables of the runs of one shake, by seed.
struct Run {
    shake: Shake,
    coefficients: Vec<Table>,
    curves: Vec<Table>,
    cell: Vec<Table>,
    slabs: Vec<Table>,
}

impl Run {
    fn new(shake: Shake, request: &Request) -> Result<Self, Failure> {
        let mut overrides = vec![
            format!("shaking.frequency={} Hz", shake.frequency),
            format!("shaking.displacement_amplitude={} mm", shake.amplitude),
        ];
        if request.quick {
            overrides.extend(QUICK.map(String::from));
        }
        let seeds = if request.quick { 1 } else { SEEDS.len() as u64 };
        let folder = request.out.join(format!("gamma-{}", shake.name.replace(' ', "-")));
        let runs = Repeats::new(CASE, &overrides, &folder, seeds, !request.quick)?;
        Ok(Self {
            shake,
            coefficients: runs.tables("diffusion-coefficients")?,
            curves: runs.tables("diffusion-curves")?,
            cell: runs.tables("profile-cell")?,
            slabs: runs.tables("profile-long-term")?,
        })
    }

    fn name(&self, what: &str) -> String {
        format!("{what}, gamma {}", self.shake.name)
    }

    /// A coefficient of each seed.
    fn coefficient(&self, name: &str) -> Vec<f64> {
        self.coefficients.iter().map(|t| first(t, name)).collect()
    }

    /// A mean over the cell, of each seed.
    fn cell(&self, name: &str) -> Vec<f64> {
        self.cell.iter().map(|t| first(t, name)).collect()
    }

    /// The mean over directions that the thesis prints for this shake, averaged over the seeds, m²/s.
    fn diffusion(&self) -> f64 {
        let of = |name: &str| average(&self.coefficient(name));
        if self.shake.mean {
            of("d_mean_by_velocities")
        } else {
            0.5 * (of("d_x_by_velocities") + of("d_y_by_velocities"))
        }
    }

    /// Solids fraction of the bed up to where nine tenths of its mass lie, of each seed.
    fn bulk(&self) -> Vec<f64> {
        self.slabs
            .iter()
            .map(|t| {
                let nu = column(t, "solids_fraction");
                let all: f64 = nu.iter().sum();
                let mut below = 0.0;
                let slabs = nu.iter().take_while(|n| {
                    below += *n;
                    below < 0.9 * all
                });
                let count = slabs.count() + 1;
                nu[..count.min(nu.len())].iter().sum::<f64>() / count as f64
            })
            .collect()
    }

    /// Self-diffusion over Savage's formula at the measured solids fraction and temperature (eq. 4-4-3).
    fn over_savage(&self) -> Vec<f64> {
        let formula = |nu: &f64, t: &f64| self_diffusion(DIAMETER, *t, *nu, RESTITUTION);
        let theory: Vec<f64> =
            self.bulk().iter().zip(&self.cell("temperature")).map(|(nu, t)| formula(nu, t)).collect();
        ratio(&self.coefficient("d_mean_by_velocities"), &theory)
    }

    fn computed(&self) -> Vec<Computed> {
        let put = |what: &str, of: &[f64]| Computed::mean(self.name(what), of);
        let over = |axis: &str| {
            ratio(
                &self.coefficient(&format!("d_{axis}_by_displacements")),
                &self.coefficient(&format!("d_{axis}_by_velocities")),
            )
        };
        if self.shake.mean {
            return vec![
                put("self-diffusion", &self.coefficient("d_mean_by_velocities")),
                put("self-diffusion by displacements over that by velocities", &over("mean")),
                put("mean temperature", &self.cell("temperature")),
                put("self-diffusion over Savage's formula", &self.over_savage()),
            ];
        }
        // Lan's z is our y.
        let mut list = vec![
            put("self-diffusion along x", &self.coefficient("d_x_by_velocities")),
            put("self-diffusion along y", &self.coefficient("d_y_by_velocities")),
        ];
        if self.shake.amplitude == 50.0 {
            let third: Vec<f64> = self.cell("temperature_x").iter().map(|t| t / 3.0).collect();
            list.push(put("a third of the temperature along x", &third));
        }
        if self.shake.name == "10" {
            list.push(put("self-diffusion along x by displacements over that by velocities", &over("x")));
            list.push(put("self-diffusion along y by displacements over that by velocities", &over("y")));
        }
        list
    }

    /// A curve of what was found over the lag.
    fn curve(&self, what: &str, label: &str, scale: f64) -> Curve {
        let (t, y) = (column(&self.curves[0], "lag"), column(&self.curves[0], what));
        Curve::line(label, t.into_iter().zip(y).map(|(t, y)| [t, y / scale]).collect())
    }

    fn figures(&self) -> [Figure; 2] {
        let figure = |title: String, caption: &str, y: Axis, curves: Vec<Curve>| Figure {
            title,
            caption: caption.into(),
            body: Body::Curves { x: Axis::linear("lag", "s"), y, curves },
        };
        let all = ["x", "y", "z"];
        let correlation = all.map(|a| {
            let name = format!("autocorrelation_{a}");
            let start = column(&self.curves[0], &name).first().copied().unwrap_or(1.0);
            self.curve(&name, &format!("along {a}"), start)
        });
        let mut displacement =
            all.map(|a| self.curve(&format!("displacement_{a}"), &format!("along {a}"), 1.0)).to_vec();
        let slope = 2.0 * first(&self.coefficients[0], "d_mean_by_velocities");
        let lags = column(&self.curves[0], "lag");
        displacement.push(
            Curve::line("2 D t, D by velocities", lags.iter().map(|&t| [t, slope * t]).collect())
                .styled(Style::Dashed),
        );
        [
            figure(
                format!("Velocity autocorrelation, Γ = {}", self.shake.name),
                "Over its value at lag 0; z is along the shake (Lan's y).",
                Axis::linear("autocorrelation", "1"),
                correlation.to_vec(),
            ),
            figure(
                format!("Mean square displacement, Γ = {}", self.shake.name),
                "Per direction; the slope is 2 D.",
                Axis::linear("mean square displacement", "m^2"),
                displacement,
            ),
        ]
    }
}

/// The quantities and plots; the short form is the first shake alone.
///
/// # Errors
/// Whatever a run fails with.
pub fn run(request: &Request) -> Result<Ran, Failure> {
    let chosen = if request.quick { &SHAKES[..1] } else { &SHAKES[..] };
    let runs: Vec<Run> = chosen.iter().map(|&s| Run::new(s, request)).collect::<Result<_, _>>()?;
    let mut computed: Vec<Computed> = runs.iter().flat_map(Run::computed).collect();
    let mut figures: Vec<Figure> = runs.iter().flat_map(Run::figures).collect();
    if let [strong, strongest, gentle, low, middle, high] = &runs[..] {
        let grows = |a: &Run, b: &Run| b.diffusion() / a.diffusion();
        computed.extend([
            Computed::new(
                "least growth of self-diffusion with the amplitude",
                grows(gentle, strong).min(grows(strong, strongest)),
            ),
            Computed::new("growth of self-diffusion with the frequency, gamma 5 to 20", grows(low, high)),
            Computed::new("self-diffusion at 7 Hz over that at 50 Hz, gamma 10", grows(gentle, middle)),
        ]);
        figures.push(with_temperature(&runs));
    }
    Ok(Ran { computed, figures })
}

/// Self-diffusion against temperature, with Savage's formula.
fn with_temperature(runs: &[Run]) -> Figure {
    let points = |value: &dyn Fn(&Run) -> f64| {
        let mut list: Vec<[f64; 2]> =
            runs.iter().map(|r| [average(&r.cell("temperature")), value(r)]).collect();
        list.sort_by(|a, b| a[0].total_cmp(&b[0]));
        list
    };
    let savage =
        |r: &Run| self_diffusion(DIAMETER, average(&r.cell("temperature")), average(&r.bulk()), RESTITUTION);
    Figure {
        title: "Self-diffusion against temperature".into(),
        caption: "Savage's formula at the measured solids fraction of the bed (up to 90 % of its mass) and temperature (Lan eq. 4-4-3).".into(),
        body: Body::Curves {
            x: Axis::log("temperature", "m^2/s^2"),
            y: Axis::log("self-diffusion", "m^2/s"),
            curves: vec![
                Curve::line("by velocities", points(&Run::diffusion)).styled(Style::Points),
                Curve::line("Savage's formula", points(&savage)).styled(Style::Dashed),
            ],
        },
    }
}

fn average(of: &[f64]) -> f64 {
    of.iter().sum::<f64>() / of.len() as f64
}

fn ratio(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a / b).collect()
}

//! Self-diffusion of grains in a vibrated layer (Lan 4.4, Tables 4.4-4.8, Figs A4.15-A4.27).

use crate::runs::{Done, column, first};
use crate::study::{Computed, Ran, Request};
use brazilnut_base::Table;
use brazilnut_base::figure::{Axis, Body, Curve, Figure, Style};
use brazilnut_runner::Failure;

const CASE: (&str, &str) =
    ("studies/lan-self-diffusion/case.toml", include_str!("../../../studies/lan-self-diffusion/case.toml"));

/// Peak acceleration over gravity (recomputed from the other two), frequency, Hz, and amplitude, mm
/// (Lan Tables 4.4-4.6).
const CASES: [(u32, f64, f64); 5] =
    [(90, 50.0, 8.9), (503, 50.0, 50.0), (5, 5.0, 50.0), (10, 7.0, 50.0), (20, 10.0, 50.0)];

/// What the short form lays over the case: the steady state is cut short.
const QUICK: [&str; 3] = ["time.end=8 s", "observe.0.from=4 s", "observe.1.from=4 s"];

/// Tables of one run.
struct Run {
    gamma: u32,
    coefficients: Table,
    curves: Table,
    cell: Table,
}

impl Run {
    fn new((gamma, frequency, amplitude): (u32, f64, f64), request: &Request) -> Result<Self, Failure> {
        let mut overrides = vec![
            format!("shaking.frequency={frequency} Hz"),
            format!("shaking.displacement_amplitude={amplitude} mm"),
        ];
        if request.quick {
            overrides.extend(QUICK.map(String::from));
        }
        let folder = request.out.join(format!("gamma-{gamma}"));
        let run = Done::new(CASE, &overrides, &folder, !request.quick)?;
        Ok(Self {
            gamma,
            coefficients: run.table("diffusion-coefficients")?,
            curves: run.table("diffusion-curves")?,
            cell: run.table("profile-cell")?,
        })
    }

    fn coefficient(&self, name: &str) -> f64 {
        first(&self.coefficients, name)
    }

    /// Cases that Lan Table 4.5 lists: the mean of the three directions.
    fn mean(&self) -> Vec<Computed> {
        let name = |what: &str| format!("{what}, gamma {}", self.gamma);
        let (velocities, displacements) =
            (self.coefficient("d_mean_by_velocities"), self.coefficient("d_mean_by_displacements"));
        vec![
            Computed::new(name("self-diffusion"), velocities),
            Computed::new(
                name("self-diffusion by displacements over that by velocities"),
                displacements / velocities,
            ),
            Computed::new(name("mean temperature"), first(&self.cell, "temperature")),
        ]
    }

    /// Cases of Lan Table 4.6: across the shake. Lan's z is our y.
    fn across(&self) -> Vec<Computed> {
        let name = |what: &str| format!("{what}, gamma {}", self.gamma);
        vec![
            Computed::new(name("self-diffusion along x"), self.coefficient("d_x_by_velocities")),
            Computed::new(name("self-diffusion along y"), self.coefficient("d_y_by_velocities")),
            Computed::new(
                name("a third of the temperature along x"),
                first(&self.cell, "temperature_x") / 3.0,
            ),
        ]
    }

    /// A curve of what was found over the lag.
    fn curve(&self, what: &str, label: &str, scale: f64) -> Curve {
        let (t, y) = (column(&self.curves, "lag"), column(&self.curves, what));
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
            let start = column(&self.curves, &name).first().copied().unwrap_or(1.0);
            self.curve(&name, &format!("along {a}"), start)
        });
        let mut displacement =
            all.map(|a| self.curve(&format!("displacement_{a}"), &format!("along {a}"), 1.0)).to_vec();
        let slope = 2.0 * self.coefficient("d_mean_by_velocities");
        let lags = column(&self.curves, "lag");
        displacement.push(
            Curve::line("2 D t, D by velocities", lags.iter().map(|&t| [t, slope * t]).collect())
                .styled(Style::Dashed),
        );
        [
            figure(
                format!("Velocity autocorrelation, Γ = {}", self.gamma),
                "Over its value at lag 0; z is along the shake (Lan's y).",
                Axis::linear("autocorrelation", "1"),
                correlation.to_vec(),
            ),
            figure(
                format!("Mean square displacement, Γ = {}", self.gamma),
                "Per direction; the slope is 2 D.",
                Axis::linear("mean square displacement", "m^2"),
                displacement,
            ),
        ]
    }
}

/// The quantities and plots; the short form is the first case alone.
///
/// # Errors
/// Whatever a run fails with.
pub fn run(request: &Request) -> Result<Ran, Failure> {
    let chosen = if request.quick { &CASES[..1] } else { &CASES[..] };
    let runs: Vec<Run> = chosen.iter().map(|&c| Run::new(c, request)).collect::<Result<_, _>>()?;
    let computed = runs.iter().flat_map(|r| if r.gamma >= 90 { r.mean() } else { r.across() }).collect();
    Ok(Ran { computed, figures: runs.iter().flat_map(Run::figures).collect() })
}

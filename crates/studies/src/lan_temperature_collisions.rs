//! Temperature and collisions of a vibrated layer over the acceleration (Lan 4.2, Figs A4.11-12).

use crate::lan_expansion::{DIAMETER, Run, at, curve, plot};
use crate::layers::{GRAVITY, Layers};
use crate::study::{Computed, Ran, Request};
use brazilnut_base::figure::{Axis, Style};
use brazilnut_runner::Failure;
use std::f64::consts::PI;

/// Collisions of a grain per second by kinetic theory, (24/sqrt(pi)) nu g0 sqrt(T)/d: Lan's formula of
/// section 4.2 with its dimensions put right, averaged over the mass of a profile.
fn kinetic(l: &Layers) -> f64 {
    let (mut sum, mut mass) = (0.0, 0.0);
    for k in l.full() {
        let nu = l.solids[k];
        let g0 = (2.0 - nu) / (2.0 * (1.0 - nu).powi(3));
        let root = l.w[k] * (DIAMETER * GRAVITY).sqrt();
        sum += nu * 24.0 / PI.sqrt() * nu * g0 * root / DIAMETER;
        mass += nu;
    }
    sum / mass
}

/// The quantities and plots, from the runs of `lan-expansion`.
///
/// # Errors
/// Whatever a run fails with.
pub fn run(request: &Request) -> Result<Ran, Failure> {
    let runs = Run::all(request)?;
    let temperature = |g: f64| at(&runs, g).temperatures();
    let rate = |g: f64| at(&runs, g).rates();
    let mut computed = vec![
        Computed::ratio("temperature at gamma 3.15 over that at 1.2", &temperature(3.15), &temperature(1.2)),
        Computed::ratio("collisions at gamma 3.15 over those at 1.2", &rate(3.15), &rate(1.2)),
    ];
    if !request.quick {
        // Slopes on log axes, of the means over the seeds.
        let mean = |of: Vec<f64>| of.iter().sum::<f64>() / of.len() as f64;
        let slope = |value: &dyn Fn(f64) -> Vec<f64>, a: f64, b: f64| {
            (mean(value(b)) / mean(value(a))).ln() / (b / a).ln()
        };
        let steps = runs.windows(2).map(|w| (w[0].gamma, w[1].gamma));
        let least_rise = steps.map(|(a, b)| mean(temperature(b)) / mean(temperature(a)));
        computed.extend([
            Computed::ratio("temperature at gamma 2 over that at 1.2", &temperature(2.0), &temperature(1.2)),
            Computed::new(
                "least rise of the temperature from one gamma to the next",
                least_rise.fold(f64::INFINITY, f64::min),
            ),
            Computed::new(
                "slope of the temperature beyond gamma 4.1 over that from 2 to 4.1",
                slope(&temperature, 4.1, 30.0) / slope(&temperature, 2.0, 4.1),
            ),
            Computed::ratio("collisions at gamma 2 over those at 1.2", &rate(2.0), &rate(1.2)),
            Computed::new(
                "slope of the collisions beyond gamma 4.1 over that from 1.2 to 2",
                slope(&rate, 4.1, 30.0) / slope(&rate, 1.2, 2.0),
            ),
        ]);
    }
    let theory = |r: &Run| r.bed.seeds.iter().map(kinetic).collect();
    let figures = vec![
        plot(
            "Temperature of the cell",
            "Fluctuations about the mean of each layer at each instant, over the whole mass; bars: standard error of the seeds.",
            Axis::log("granular temperature", "m^2/s^2"),
            vec![curve("granular temperature", &runs, Run::temperatures)],
        ),
        plot(
            "Collisions of a grain",
            "Contacts that begin, per grain and second, with grains and with the floor. Dashed: kinetic theory from the mean profiles, grains only.",
            Axis::log("collisions per grain", "Hz"),
            vec![
                curve("counted", &runs, Run::rates),
                curve("kinetic theory", &runs, theory).styled(Style::Dashed),
            ],
        ),
    ];
    Ok(Ran { computed, figures })
}

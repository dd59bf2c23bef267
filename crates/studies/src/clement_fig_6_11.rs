//! The rise of a steel intruder in the Brazil-nut column (Clément 6.5, Fig. 6.11).

use crate::study::Computed;
use brazilnut_base::figure::{Axis, Body, Curve, Figure, Style};
use brazilnut_base::motion::Motion;
use brazilnut_bed::bed_equation::BedEquation;
use brazilnut_bed::brazil_nut::{BrazilNut, BrazilNutSpec, solve};
use std::f64::consts::TAU;

/// Γ, α (N) and l (m) of Clément 6.5.
const FITS: [(f64, f64, f64); 3] = [(3.5, 9.83e-3, 4.0e-3), (4.0, 1.208e-2, 4.2e-3), (4.5, 1.445e-2, 4.5e-3)];

/// Clément Tables 6.1 and 6.2 at f 15 Hz, with φ 0.42 of Clément 6.5.
fn spec((gamma, alpha, range): (f64, f64, f64)) -> BrazilNutSpec {
    let f = 15.0;
    BrazilNutSpec {
        shake: Motion::vertical(gamma * 9.81 / (TAU * f).powi(2), f),
        gravity: 9.81,
        height: 26e-3,
        cell_height: Some(43e-3),
        porosity: 0.42,
        diameter: 2e-3,
        grain_density: 2500.0,
        fluid_density: 1000.0,
        viscosity: 1e-3,
        bed_equation: BedEquation::Ergun,
        intruder_diameter: 7e-3,
        intruder_density: 7750.0,
        alpha,
        range,
        drag_factor: 1.0 / (1.0 - 0.42),
        start: 0.0,
        cycles: 600,
        tolerance: 1e-10,
    }
}

fn solved(spec: &BrazilNutSpec) -> BrazilNut {
    solve(spec).expect("the study's own parameters are valid")
}

/// Cycles to the surface, infinite if it is not reached.
fn cycles(ride: &BrazilNut) -> f64 {
    ride.cycles_to_surface().unwrap_or(f64::INFINITY)
}

/// The strength α, N, at which the first fit takes `wanted` cycles; the rise slows down with α.
fn strength_for(wanted: f64) -> f64 {
    let (mut low, mut high) = (0.9 * FITS[0].1, 1.1 * FITS[0].1);
    for _ in 0..20 {
        let alpha = 0.5 * (low + high);
        if cycles(&solved(&BrazilNutSpec { alpha, cycles: 300, ..spec(FITS[0]) })) > wanted {
            high = alpha
        } else {
            low = alpha
        }
    }
    0.5 * (low + high)
}

/// The quantities and a plot; the short form is the full one.
#[must_use]
pub fn run(_quick: bool) -> (Vec<Computed>, Vec<Figure>) {
    let rides = FITS.map(|fit| solved(&spec(fit)));
    let weaker = FITS.map(|(g, a, l)| solved(&spec((g, 0.99 * a, l))));
    let n = rides.each_ref().map(cycles);
    let mut computed = vec![
        Computed::new("cycles to the surface, gamma 3.5", n[0]),
        Computed::new("rise time at 3.5 over that at 4.0", n[0] / n[1]),
        Computed::new("rise time at 4.0 over that at 4.5", n[1] / n[2]),
        Computed::new("strength for 101 cycles, gamma 3.5", strength_for(101.0)),
    ];
    for (ride, (g, ..)) in rides.iter().zip(FITS) {
        let last = ride.history[ride.history.len() - 1];
        computed.push(Computed::new(format!("final gap, gamma {g:.1}"), 1e3 * last.gap));
        let at = |mm: f64| ride.time_to(1e-3 * mm).unwrap_or(f64::NAN);
        computed.push(Computed::new(
            format!("first 3 mm over next 3 mm, gamma {g:.1}"),
            at(3.0) / (at(6.0) - at(3.0)),
        ));
    }
    let curve = |ride: &BrazilNut, more: &str| {
        let points = ride.history.iter().map(|r| [r.time, 1e3 * r.gap]).collect();
        Curve::line(format!("Γ = {:.1}{more}", ride.gamma), points)
    };
    let mut curves: Vec<Curve> = rides.iter().map(|r| curve(r, "")).collect();
    curves.extend(weaker.iter().map(|r| curve(r, ", α one percent smaller").styled(Style::Dashed)));
    let figure = Figure {
        title: "Gap under the intruder".into(),
        caption: "Published α and l, and α one percent smaller: the fits lie where the model is critical."
            .into(),
        body: Body::Curves { x: Axis::linear("time", "s"), y: Axis::linear("gap", "mm"), curves },
    };
    (computed, vec![figure])
}

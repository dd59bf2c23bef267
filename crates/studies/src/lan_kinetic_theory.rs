//! Temperature and solids fraction over a vibrating floor (Lan 4.1, Figs A4.1, A4.2), and Savage's self-diffusion.

use crate::study::Computed;
use brazilnut_base::figure::{Axis, Body, Curve, Figure};
use brazilnut_bed::kinetic_theory::closure::self_diffusion;
use brazilnut_bed::kinetic_theory::{KineticTheory, KineticTheorySpec, Layer, solve};

/// Hold-up and boundary velocity of Lan Table 4.1.
const CASES: [(f64, f64); 5] = [(1.0, 2.0), (2.5, 2.0), (5.0, 0.25), (5.0, 2.0), (5.0, 5.0)];

const DIAMETER: f64 = 0.1;

fn solved((hold_up, boundary_velocity): (f64, f64)) -> KineticTheory {
    let spec = KineticTheorySpec {
        gravity: 9.81,
        diameter: DIAMETER,
        hold_up,
        cell_height: None,
        floor_velocity: boundary_velocity * f64::sqrt(DIAMETER * 9.81),
        restitution: 0.9,
        floor_restitution: 0.9,
        densest: 0.74,
        tolerance: 1e-9,
        points: 400,
    };
    solve(&spec).expect("the study's own parameters are valid")
}

/// The quantities and plots; the short form is the full one.
#[must_use]
pub fn run(_quick: bool) -> (Vec<Computed>, Vec<Figure>) {
    let layers = CASES.map(solved);
    let mut computed = vec![];
    for (k, (m, v)) in layers.iter().zip(CASES) {
        let mut push =
            |what: &str, value: f64| computed.push(Computed::new(format!("{what}, m_t {m}, V_b {v}"), value));
        push("W at the floor", k.floor().w);
        push("W at the top", k.top.w);
        push("solids fraction at the floor", k.floor().solids_fraction);
        if k.capped == 0.0 {
            push("largest solids fraction", k.densest.solids_fraction);
            push("height of the densest layer", k.densest.height / DIAMETER);
        }
        let rise = k.layers.windows(2).map(|w| w[1].w - w[0].w).fold(f64::NEG_INFINITY, f64::max);
        push("largest rise of W with height", rise);
        push(
            "largest solids fraction over that at the floor",
            k.densest.solids_fraction / k.floor().solids_fraction,
        );
    }
    // Bulk values printed in Lan Table 4.5.
    computed.push(Computed::new("self-diffusion, gamma 90", self_diffusion(DIAMETER, 0.7950, 0.44, 0.9)));
    computed.push(Computed::new("self-diffusion, gamma 483", self_diffusion(DIAMETER, 13.80, 0.14, 0.9)));
    let figure = |title: &str, axis: Axis, value: fn(&Layer) -> f64| {
        let curves = layers.iter().zip(CASES).map(|(k, (m, v))| {
            let points =
                k.layers.iter().map(|l| [l.height / DIAMETER, value(l)]).filter(|p| p[0] < 20.0).collect();
            Curve::line(format!("m_t {m}, V_b {v}"), points)
        });
        Figure {
            title: title.into(),
            caption: "e = e_w = 0.9. At V_b 0.25 the solids fraction is held at 0.74, which the equation of state would pass.".into(),
            body: Body::Curves { x: Axis::linear("height over diameter", "1"), y: axis, curves: curves.collect() },
        }
    };
    let figures = vec![
        figure("Granular temperature", Axis::linear("W", "1"), |l| l.w),
        figure("Solids fraction", Axis::linear("solids fraction", "1"), |l| l.solids_fraction),
    ];
    (computed, figures)
}

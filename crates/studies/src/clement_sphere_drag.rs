//! Drag of a falling sphere (Clément 2009, 2.7, Fig. 2.32).

use crate::clement_falling_cylinder::{RUNGS, VISCOSITY};
use crate::fall::{Fall, sphere_coefficient, sphere_drag, terminal_speed};
use crate::runs::Done;
use crate::study::{Computed, Ran, Request};
use brazilnut_base::figure::{Axis, Body, Curve, Figure, Style};
use brazilnut_runner::Failure;

const CASE: (&str, &str) =
    ("studies/clement-sphere-drag/case.toml", include_str!("../../../studies/clement-sphere-drag/case.toml"));

const DIAMETER: f64 = 0.01;

/// Printed step, s, and strength of the springs (of the cylinders: section 2.7 prints neither).
const STEP: f64 = 1e-4;
const STRENGTH: f64 = 0.5;

/// Height of the centre where the floor begins to be felt, m.
const STOP: f64 = 0.03;

/// Rung, points per radius, ratio of the densities, step and end (s).
struct Drop {
    rung: usize,
    points: f64,
    ratio: f64,
    dt: f64,
    end: f64,
}

/// On coarser grids than the printed 16 points per radius; the steps keep to the scheme's limits.
const DECIDING: [(f64, f64, f64, f64); 2] = [(4.0, 1.1, 1e-3, 1.2), (4.0, 2.5, 2e-4, 0.4)];
const QUICK: [(f64, f64, f64, f64); 1] = [(2.5, 1.1, 5e-4, 0.8)];

impl Drop {
    fn fall(&self, request: &Request) -> Result<Fall, Failure> {
        let (model, short) = RUNGS[self.rung];
        let mut overrides = vec![
            format!("model={model}"),
            format!("materials.sphere.density={} kg/m^3", 1e3 * self.ratio),
            format!("fluid.spacing={} m", 0.5 * DIAMETER / self.points),
            format!("fluid.largest_speed={} m/s", 1.4 * endless(self.ratio)),
            format!("time.dt={} s", self.dt),
            format!("time.end={} s", self.end),
        ];
        if self.rung == 1 {
            // C_s² is proportional to the step for the same relaxation time.
            overrides.push(format!("fluid-springs.c_s={}", STRENGTH * (self.dt / STEP).sqrt()));
        }
        let name = format!("{}-density-{}-points-{}", short.to_lowercase(), 1e3 * self.ratio, self.points);
        let run = Done::new(CASE, &overrides, &request.out.join(name), !request.quick)?;
        Ok(Fall::new(&run)?.above(STOP))
    }
}

/// Speed in an endless fluid by White's curve, m/s.
fn endless(ratio: f64) -> f64 {
    terminal_speed(|u| sphere_coefficient(ratio, DIAMETER, u), sphere_drag, DIAMETER, VISCOSITY)
}

/// The quantities and plots. Full form: the subset that decides.
///
/// # Errors
/// Whatever a run fails with.
pub fn run(request: &Request) -> Result<Ran, Failure> {
    let list: &[(f64, f64, f64, f64)] = if request.quick { &QUICK } else { &DECIDING };
    let white = (0..=50).map(|k| 10f64.powf(0.04 * f64::from(k) + 1.5)).map(|re| [re, sphere_drag(re)]);
    let mut curves = vec![Curve::line("White 1991", white.collect()).styled(Style::Dashed)];
    let (mut computed, mut falls) = (vec![], vec![]);
    for (rung, (_, short)) in RUNGS.into_iter().enumerate() {
        let mut found = vec![];
        for &(points, ratio, dt, end) in list {
            let fall = Drop { rung, points, ratio, dt, end }.fall(request)?;
            let speed = fall.terminal();
            let reynolds = speed * DIAMETER / VISCOSITY;
            let drag = sphere_coefficient(ratio, DIAMETER, speed);
            let density = 1e3 * ratio;
            let name = format!("C_D over White's at {density} kg/m³, {short}");
            computed.push(Computed::new(name, drag / sphere_drag(reynolds)));
            found.push([reynolds, drag]);
            falls.push(fall.curve(format!("{short}, {density} kg/m³")));
        }
        curves.push(Curve::line(short, found).styled(Style::Points));
    }
    let figure = |title: &str, caption: &str, x, y, curves| Figure {
        title: title.into(),
        caption: caption.into(),
        body: Body::Curves { x, y, curves },
    };
    let (re, cd) = (Axis::log("Reynolds number", "1"), Axis::log("drag coefficient", "1"));
    let (t, v) = (Axis::linear("time", "s"), Axis::linear("downward speed", "m/s"));
    let caption = "d = 1 cm in a cell of 5 cm by 5 cm; the speeds are not freed of the walls.";
    let figures = vec![
        figure("Drag of a falling sphere", caption, re, cd, curves),
        figure("Falls", "Speeds as computed.", t, v, falls),
    ];
    Ok(Ran { computed, figures })
}

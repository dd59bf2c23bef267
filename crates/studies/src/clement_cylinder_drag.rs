//! Drag of a falling cylinder over its Reynolds number (Clément 2009, 2.6.1, Fig. 2.26).

use crate::clement_falling_cylinder::{Drop, RUNGS, VISCOSITY, endless, printed, wall_factor};
use crate::fall::{cylinder_coefficient, cylinder_drag};
use crate::study::{Computed, Ran, Request};
use brazilnut_base::figure::{Axis, Body, Curve, Figure, Style};
use brazilnut_runner::Failure;

/// Ratio of the densities, step and end (s).
type Point = (f64, f64, f64);

/// On the grid of 8 points per radius; the steps keep to the scheme's limits.
const DECIDING: [Point; 4] = [(1.01, 5e-4, 2.5), (1.1, 5e-4, 1.9), (2.0, 2e-4, 0.8), (10.0, 5e-5, 0.32)];

/// On the grid of 4.
const QUICK: [Point; 2] = [(1.1, 2.5e-4, 0.8), (2.0, 2e-4, 0.6)];

/// The quantities and plots. Full form: the subset that decides.
///
/// # Errors
/// Whatever a run fails with.
pub fn run(request: &Request) -> Result<Ran, Failure> {
    let (points, list): (f64, &[Point]) = if request.quick { (4.0, &QUICK) } else { (8.0, &DECIDING) };
    let white = (0..=60).map(|k| 10f64.powf(0.05 * f64::from(k) + 0.5)).map(|re| [re, cylinder_drag(re)]);
    let mut curves = vec![Curve::line("White 1991", white.collect()).styled(Style::Dashed)];
    let mut computed = vec![];
    let mut falls = vec![];
    for (rung, (_, short)) in RUNGS.into_iter().enumerate() {
        let mut found = vec![];
        for &(ratio, dt, end) in list {
            // Between the walls the fluid overtakes the cylinder by half of its speed.
            let swift = 1.6 * endless(ratio, 0.01);
            let drop = Drop { ratio, end, swift, aside: 1e-3, ..Drop::new(rung, points, dt) };
            let density = 1e3 * ratio;
            let fall = drop.fall(&format!("density-{density}"), request)?;
            let speed = fall.terminal() / wall_factor(printed(rung), drop.diameter / drop.width);
            let reynolds = speed * drop.diameter / VISCOSITY;
            let drag = cylinder_coefficient(ratio, drop.diameter, speed);
            let name = format!("C_D over White's at {density} kg/m³, {short}");
            computed.push(Computed::new(name, drag / cylinder_drag(reynolds)));
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
    let caption = "D = 1 cm, speeds freed of the walls by the printed fits.";
    let (re, cd) = (Axis::log("Reynolds number", "1"), Axis::log("drag coefficient", "1"));
    let (t, v) = (Axis::linear("time", "s"), Axis::linear("downward speed", "m/s"));
    let figures = vec![
        figure("Drag of a falling cylinder", caption, re, cd, curves),
        figure("Falls", "Speeds as computed, between the walls.", t, v, falls),
    ];
    Ok(Ran { computed, figures })
}

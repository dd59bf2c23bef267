//! A falling cylinder: strength of the springs, resolution, walls (Clément 2009, 2.6.1, Tables 2.4, 2.5, Figs 2.19-2.25).

use crate::fall::{Fall, cylinder_coefficient, cylinder_drag, fit, terminal_speed};
use crate::findings;
use crate::runs::Done;
use crate::study::{Computed, Ran, Request};
use brazilnut_base::figure::{Axis, Body, Curve, Figure, Style};
use brazilnut_coupling::resolved::{Inertia, SpringBody, Springs, Strength};
use brazilnut_runner::Failure;
use std::f64::consts::PI;

pub const CASE: (&str, &str) = (
    "studies/clement-falling-cylinder/case.toml",
    include_str!("../../../studies/clement-falling-cylinder/case.toml"),
);

/// The two rungs and their names in Clément's thesis.
pub const RUNGS: [(&str, &str); 2] = [("particle-template", "PT"), ("fluid-springs", "FS")];

/// Printed step, s, points per radius and strength of Tables 2.4 and 2.5.
const STEP: f64 = 1e-4;
const POINTS: f64 = 32.0;
const STRENGTH: f64 = 0.5;

/// Heights of the centre at the start and where the floor begins to be felt, m.
const START: f64 = 0.26;
const STOP: f64 = 0.08;

/// Kinematic viscosity, m²/s.
pub const VISCOSITY: f64 = 1e-5;

/// One run.
#[derive(Clone, Copy, Debug)]
pub struct Drop {
    /// Index into [`RUNGS`].
    pub rung: usize,
    /// Diameter, width of the cell and grid spacing, m.
    pub diameter: f64,
    pub width: f64,
    pub spacing: f64,
    /// Ratio of the densities.
    pub ratio: f64,
    /// C_s and the points per radius that it is meant for.
    pub strength: f64,
    pub meant_for: f64,
    /// Step and end, s.
    pub dt: f64,
    pub end: f64,
    /// Distance of the start from the middle, m: an exactly even flow sheds no vortex.
    pub aside: f64,
    /// Fastest motion expected of the fluid, m/s.
    pub swift: f64,
}

impl Drop {
    /// The printed cylinder of 1 cm, with C_s meant for this grid.
    #[must_use]
    pub fn new(rung: usize, points: f64, dt: f64) -> Self {
        Self {
            rung,
            diameter: 0.01,
            width: 0.1,
            spacing: 0.005 / points,
            ratio: 1.1,
            strength: STRENGTH,
            meant_for: points,
            dt,
            end: 1.0,
            aside: 0.0,
            swift: 0.2,
        }
    }

    /// Points per radius.
    #[must_use]
    pub fn points(&self) -> f64 {
        0.5 * self.diameter / self.spacing
    }

    /// C_s that gives on this grid and with this step the relaxation time that `strength` has on the grid it is
    /// meant for and with the printed step: C_s² is proportional to the step and to the number of tracers.
    fn c_s(&self) -> f64 {
        self.strength * (self.dt / STEP).sqrt() * self.points() / self.meant_for
    }

    /// Runs it in the folder `name`.
    ///
    /// # Errors
    /// Whatever the run fails with.
    pub fn fall(&self, name: &str, request: &Request) -> Result<Fall, Failure> {
        let (model, short) = RUNGS[self.rung];
        let mut overrides = vec![
            format!("model={model}"),
            format!("cell.size=[\"{} m\", \"1 cm\", \"30 cm\"]", self.width),
            format!("materials.cylinder.density={} kg/m^3", 1e3 * self.ratio),
            format!("grains.0.diameter={} m", self.diameter),
            format!("grains.0.at=[\"{} m\", \"5 mm\", \"{START} m\"]", 0.5 * self.width + self.aside),
            format!("fluid.spacing={} m", self.spacing),
            "fluid.scheme=second-order".into(),
            format!("fluid.largest_speed={} m/s", self.swift),
            format!("time.dt={} s", self.dt),
            format!("time.end={} s", self.end),
        ];
        if self.rung == 1 {
            overrides.push(format!("fluid-springs.c_s={}", self.c_s()));
        }
        let folder = request.out.join(format!("{}-{name}", short.to_lowercase()));
        Ok(Fall::new(&Done::new(CASE, &overrides, &folder, !request.quick)?)?.above(STOP))
    }
}

/// Speed of a cylinder in an endless fluid by White's curve, m/s.
#[must_use]
pub fn endless(ratio: f64, diameter: f64) -> f64 {
    terminal_speed(|u| cylinder_coefficient(ratio, diameter, u), cylinder_drag, diameter, VISCOSITY)
}

/// f(x) = 1 − c1 x − c2 x² (Clément eq. 2.102).
#[must_use]
pub fn wall_factor([c1, c2]: [f64; 2], x: f64) -> f64 {
    1.0 - c1 * x - c2 * x * x
}

/// Printed coefficients c1, c2 of a rung (Figs 2.24, 2.25; 0.302 in a caption).
#[must_use]
pub fn printed(rung: usize) -> [f64; 2] {
    ["c1", "c2"].map(|c| findings::printed("clement-falling-cylinder", &format!("{c}, {}", RUNGS[rung].1)))
}

/// C_s at which the printed springs become unstable: they then take twice the slip in a step.
fn unstable_from(points: f64, inertia: Inertia) -> f64 {
    let tracers = PI * points * points;
    let body = SpringBody {
        tracers: tracers as usize,
        cell_mass: 1.0,
        fluid_mass: tracers,
        template_mass: 0.1 * tracers,
    };
    let springs = Springs { strength: Strength::Cs(1.0), damping: 0.0, inertia };
    (2.0 / springs.stiffness(&body, STEP)).sqrt()
}

/// Speeds at several C_s, and their curves.
fn strengths(meant_for: f64, request: &Request, curves: &mut Vec<Curve>) -> Result<Vec<f64>, Failure> {
    let run = |(strength, end): (f64, f64)| {
        let drop = Drop { strength, meant_for, end, ..Drop::new(1, 8.0, 5e-4) };
        let fall = drop.fall(&format!("strength-{strength}-of-{meant_for}"), request)?;
        curves.push(fall.curve(format!("C_s {strength} of n_r {meant_for}")));
        Ok(fall.terminal())
    };
    // The weakest springs let the cylinder reach the floor early.
    [(0.01, 0.4), (0.25, 1.0), (0.5, 1.0), (1.0, 1.0)].into_iter().map(run).collect()
}

/// Speeds over D/L, normalised diameter by diameter; the coefficients c1, c2 of all.
fn walls(
    rung: usize,
    diameters: &[f64],
    widths: &[f64],
    points: f64,
    dt: f64,
    request: &Request,
) -> Result<(Vec<[f64; 2]>, [f64; 2]), Failure> {
    let mut normalised = vec![];
    for &diameter in diameters {
        let mut speeds = vec![];
        for &width in widths {
            let x = diameter / width;
            let expected = endless(1.1, diameter) * wall_factor(printed(rung), x);
            let end = (1.2 * (START - STOP) / expected + 0.3).min(3.0);
            let spacing = 0.5 * diameter / points;
            let drop = Drop { diameter, width, spacing, end, ..Drop::new(rung, points, dt) };
            let fall = drop.fall(&format!("d-{}-l-{}", 1e3 * diameter, 1e3 * width), request)?;
            speeds.push([x, fall.terminal()]);
        }
        let limit = fit(&speeds, &[0, 1, 2])[0];
        normalised.extend(speeds.iter().map(|[x, v]| [*x, v / limit]));
    }
    let lacking: Vec<[f64; 2]> = normalised.iter().map(|[x, f]| [*x, 1.0 - f]).collect();
    let c = fit(&lacking, &[1, 2]);
    Ok((normalised, [c[0], c[1]]))
}

/// The quantities and plots. Full form: the subset that decides.
///
/// # Errors
/// Whatever a run fails with.
pub fn run(request: &Request) -> Result<Ran, Failure> {
    let mut computed = vec![];
    let mut figures = vec![];
    if !request.quick {
        strength_of_springs(request, &mut computed, &mut figures)?;
    }
    resolution(request, &mut computed, &mut figures)?;
    confinement(request, &mut computed, &mut figures)?;
    Ok(Ran { computed, figures })
}

/// Figure 2.19.
fn strength_of_springs(
    request: &Request,
    computed: &mut Vec<Computed>,
    figures: &mut Vec<Figure>,
) -> Result<(), Failure> {
    let mut curves = vec![];
    for meant_for in [POINTS, 8.0] {
        let v = strengths(meant_for, request, &mut curves)?;
        for (k, strength) in [(0, "0.01"), (1, "0.25"), (3, "1.0")] {
            let name = format!("speed at C_s {strength} over that at 0.5, springs of n_r {meant_for}");
            computed.push(Computed::new(name, v[k] / v[2]));
        }
    }
    computed.push(Computed::new("largest stable C_s at n_r 32", unstable_from(POINTS, Inertia::Full)));
    figures.push(falls(
        "Strength of the springs",
        "D = 1 cm, n_r 8, relaxation times of the printed C_s.",
        curves,
    ));
    Ok(())
}

/// Figures 2.20, 2.21.
fn resolution(
    request: &Request,
    computed: &mut Vec<Computed>,
    figures: &mut Vec<Figure>,
) -> Result<(), Failure> {
    // Points per radius and step: the springs of coarse grids are stiff, fine grids have short limits.
    let grids: &[(f64, f64)] = if request.quick {
        &[(2.0, 1e-4), (4.0, 2.5e-4)]
    } else {
        &[(2.0, 1e-4), (4.0, 2.5e-4), (8.0, 5e-4), (16.0, 5e-4)]
    };
    let finest = grids.len() - 1;
    let mut speeds = [vec![], vec![]];
    let mut jagged = [0.0; 2];
    for (rung, (_, short)) in RUNGS.into_iter().enumerate() {
        let mut curves = vec![];
        for &(points, dt) in grids {
            let end = if request.quick { 0.8 } else { 1.0 };
            let fall =
                Drop { end, ..Drop::new(rung, points, dt) }.fall(&format!("points-{points}"), request)?;
            if points == 4.0 {
                jagged[rung] = fall.jaggedness();
            }
            speeds[rung].push(fall.terminal());
            curves.push(fall.curve(format!("n_r {points}")));
        }
        for k in 0..finest {
            let name = format!("speed at n_r {} over that at n_r {}, {short}", grids[k].0, grids[k + 1].0);
            computed.push(Computed::new(name, speeds[rung][k] / speeds[rung][k + 1]));
        }
        figures.push(falls(&format!("Resolution, {short}"), "D = 1 cm, C_s 0.5.", curves));
    }
    computed.push(Computed::new("jaggedness of PT over that of FS, n_r 4", jagged[0] / jagged[1]));
    if !request.quick {
        let ratio = speeds[0][finest] / speeds[1][finest];
        computed.push(Computed::new("speed of PT over that of FS, n_r 16", ratio));
    }
    Ok(())
}

/// Figures 2.22-2.25.
fn confinement(
    request: &Request,
    computed: &mut Vec<Computed>,
    figures: &mut Vec<Figure>,
) -> Result<(), Failure> {
    let widths = [0.05, 0.1, 0.2];
    let (diameters, points, dt, rungs): (&[f64], _, _, &[usize]) = if request.quick {
        (&[0.02], 4.0, 2.5e-4, &[1])
    } else {
        (&[0.015, 0.025, 0.04], 8.0, 5e-4, &[0, 1])
    };
    let at = |f: &dyn Fn(f64) -> f64| (0..=40).map(|k| 0.02 * f64::from(k)).map(|x| [x, f(x)]).collect();
    let mut curves = vec![
        Curve::line("PT, printed", at(&|x| wall_factor(printed(0), x))).styled(Style::Dashed),
        Curve::line("FS, printed", at(&|x| wall_factor(printed(1), x))).styled(Style::Dashed),
        Curve::line("Ristow 1997", at(&|x| 1.0 - 1.14 * x)).styled(Style::Dashed),
    ];
    for &rung in rungs {
        let short = RUNGS[rung].1;
        let (normalised, c) = walls(rung, diameters, &widths, points, dt, request)?;
        if !request.quick {
            computed.push(Computed::new(format!("c1, {short}"), c[0]));
            computed.push(Computed::new(format!("c2, {short}"), c[1]));
        }
        for x in [0.2, 0.4] {
            computed.push(Computed::new(format!("f at D/L {x}, {short}"), wall_factor(c, x)));
        }
        let away = |x: f64| (wall_factor(c, x) - (1.0 - 1.14 * x)).abs();
        let most = (0..=40).map(|k| away(0.01 * f64::from(k))).fold(0.0, f64::max);
        computed
            .push(Computed::new(format!("largest distance from Ristow's line up to D/L 0.4, {short}"), most));
        curves.push(Curve::line(format!("{short}, fit"), at(&|x| wall_factor(c, x))));
        curves.push(Curve::line(short, normalised).styled(Style::Points));
    }
    figures.push(Figure {
        title: "Terminal speed between walls".into(),
        caption: "Over the speed extrapolated to an endless fluid, diameter by diameter.".into(),
        body: Body::Curves { x: Axis::linear("D/L", "1"), y: Axis::linear("f", "1"), curves },
    });
    Ok(())
}

fn falls(title: &str, caption: &str, curves: Vec<Curve>) -> Figure {
    Figure {
        title: title.into(),
        caption: caption.into(),
        body: Body::Curves { x: Axis::linear("time", "s"), y: Axis::linear("downward speed", "m/s"), curves },
    }
}

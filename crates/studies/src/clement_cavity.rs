//! The lid-driven cavity (Clément 2.2.3, Table 2.3, Figs 2.10-2.12).

use crate::study::Computed;
use brazilnut_base::figure::{Axis, Body, Curve, Figure, Raster, Style};
use brazilnut_base::{Side, Tick, Vec3, vec3};
use brazilnut_fluid::diagnose::{Sheet, extremum, flux, streamfunction};
use brazilnut_fluid::{Boundary, Flow, FluidSpec, Grid, Medium, Solver, step_limits};

/// Clément Table 2.3: side of the square (m), density (kg/m³), viscosity (Pa s), cells along a side.
const SIDE: f64 = 0.01;
const DENSITY: f64 = 1000.0;
const VISCOSITY: f64 = 1e-3;
const CELLS: usize = 200;

/// Part of the sharpest step limit that is used; the steady state does not depend on it.
const STEP: f64 = 0.6;

/// Sampled points of published profiles.
const U: &str = include_str!("../../../studies/clement-cavity/cavity_erturk2005_u.csv");
const V: &str = include_str!("../../../studies/clement-cavity/cavity_erturk2005_v.csv");

/// One run: Reynolds number, cells along a side, duration and time from which on
/// fields are averaged, both in units of side over lid speed.
#[derive(Clone, Copy, Debug)]
struct Plan {
    reynolds: f64,
    cells: usize,
    duration: f64,
    average_from: f64,
}

/// What a run ended with, in units of the side and the lid's speed.
struct Cavity {
    plan: Plan,
    psi: Sheet,
    /// Profiles through the centre: (y, u) on x = 1/2 and (x, v) on y = 1/2.
    u: Vec<[f64; 2]>,
    v: Vec<[f64; 2]>,
    /// Largest net volume through the two centre lines.
    leak: f64,
    /// Change of the primary vortex' streamfunction over the last tenth of the run, relative.
    drift: f64,
}

impl Plan {
    fn run(self) -> Cavity {
        let speed = self.reynolds * VISCOSITY / (DENSITY * SIDE);
        let h = SIDE / self.cells as f64;
        let grid = Grid::new([self.cells, 1, self.cells], [h; 3], [Side::Walls, Side::Flat, Side::Walls]);
        let mut spec = FluidSpec::new(grid, DENSITY, VISCOSITY);
        spec.sides[2][1] = Boundary::lid(vec3(speed, 0.0, 0.0));
        let dt = STEP * step_limits(&spec, speed).into_iter().map(|l| l.1).fold(f64::INFINITY, f64::min);
        let mut solver = Solver::new(spec).expect("the study's own numbers are valid");
        let mut flow = solver.start();
        let step_of = |time: f64| (time * SIDE / speed / dt).ceil() as u64;
        let (steps, late) = (step_of(self.duration), step_of(0.9 * self.duration));
        // The mean is taken over samples a hundredth of the lid's turnover apart.
        let sample = step_of(0.01).max(1);
        let (mut mean, mut samples, mut before) = (Flow::at_rest(solver.grid()), 0.0, 0.0);
        for index in 0..steps {
            let tick = Tick::at(index, dt);
            solver.advance(&mut flow, tick, Vec3::ZERO, &Medium::default(), |_| {});
            solver.health(&flow, tick).expect("within its own step limits the cavity is stable");
            if index == late {
                before = extremum(&psi(&solver, &flow), -1.0).0;
            }
            if index >= step_of(self.average_from) && index % sample == 0 {
                samples += 1.0;
                for axis in [0, 2] {
                    let sum = mean.velocity.component_mut(axis).iter_mut();
                    sum.zip(flow.velocity.component(axis)).for_each(|(m, v)| *m += v);
                }
            }
        }
        let after = extremum(&psi(&solver, &flow), -1.0).0;
        let flow = if samples > 0.0 {
            for axis in [0, 2] {
                mean.velocity.component_mut(axis).iter_mut().for_each(|m| *m /= samples);
            }
            mean
        } else {
            flow
        };
        Cavity::read(self, &solver, &flow, speed, (after - before) / after)
    }
}

/// Streamfunction in m²/s on the corners of the cells.
fn psi(solver: &Solver, flow: &Flow) -> Sheet {
    streamfunction(solver.grid(), &flow.velocity, [0, 2], 0)
}

impl Cavity {
    fn read(plan: Plan, solver: &Solver, flow: &Flow, speed: f64, drift: f64) -> Self {
        let (grid, n) = (solver.grid(), plan.cells);
        let mut psi = psi(solver, flow);
        psi.values.iter_mut().for_each(|p| *p /= speed * SIDE);
        psi.spacing = [1.0 / n as f64; 2];
        // Both centre lines are grid lines of their component, since the number of cells is even.
        let middle = (n / 2) as isize;
        let place = |k: usize| (k as f64 + 0.5) / n as f64;
        let leak = flux(grid, &flow.velocity, 0, n / 2).abs().max(flux(grid, &flow.velocity, 2, n / 2).abs());
        Self {
            plan,
            psi,
            u: (0..n).map(|k| [place(k), flow.velocity.x.at(middle, 0, k as isize) / speed]).collect(),
            v: (0..n).map(|i| [place(i), flow.velocity.z.at(i as isize, 0, middle) / speed]).collect(),
            leak: leak / (speed * SIDE * grid.spacing[1]),
            drift,
        }
    }

    /// The strongest vortex of `sign` with its centre in `x` and `y`: streamfunction and place.
    fn vortex(&self, sign: f64, x: [f64; 2], y: [f64; 2]) -> (f64, [f64; 2]) {
        let n = self.plan.cells as f64;
        let [first, last] = [[x[0], y[0]], [x[1], y[1]]].map(|p| p.map(|s| (s * n).round() as usize));
        let mut part = Sheet {
            shape: [last[0] - first[0] + 1, last[1] - first[1] + 1],
            values: vec![],
            ..self.psi.clone()
        };
        for j in first[1]..=last[1] {
            part.values.extend((first[0]..=last[0]).map(|i| self.psi.at(i, j)));
        }
        let (psi, at) = extremum(&part, sign);
        (psi, [at[0] + first[0] as f64 / n, at[1] + first[1] as f64 / n])
    }

    fn primary(&self) -> (f64, [f64; 2]) {
        self.vortex(-1.0, [0.2, 0.8], [0.2, 0.8])
    }

    /// Counter-rotating vortices: bottom right, bottom left, top left.
    fn secondary(&self) -> [(f64, [f64; 2]); 3] {
        let (low, high) = ([0.0, 0.5], [0.5, 1.0]);
        [(high, low), (low, low), (low, high)].map(|(x, y)| self.vortex(1.0, x, y))
    }

    /// Number of counter-rotating vortices that carry more than a millionth of the lid's flow.
    fn seen(&self) -> f64 {
        self.secondary().iter().filter(|v| v.0 > 1e-6).count() as f64
    }

    /// The vortex in the bottom right corner that turns with the primary one.
    fn tertiary(&self) -> f64 {
        self.vortex(-1.0, [0.9, 1.0], [0.0, 0.1]).0
    }

    /// Largest distance of a profile from the published points.
    fn distance(&self, profile: &[[f64; 2]], published: &[[f64; 2]]) -> f64 {
        published.iter().map(|p| (cubic(profile, p[0]) - p[1]).abs()).fold(0.0, f64::max)
    }
}

/// Cubic interpolation in equidistant points.
fn cubic(points: &[[f64; 2]], x: f64) -> f64 {
    let h = points[1][0] - points[0][0];
    let first = (((x - points[0][0]) / h).floor() as isize - 1).clamp(0, points.len() as isize - 4) as usize;
    let four = &points[first..first + 4];
    (0..4)
        .map(|i| {
            let weight: f64 =
                (0..4).filter(|&j| j != i).map(|j| (x - four[j][0]) / (four[i][0] - four[j][0])).product();
            weight * four[i][1]
        })
        .sum()
}

/// Column `name` of published points against their first column.
fn points(text: &str, name: &str) -> Vec<[f64; 2]> {
    let mut lines = text.lines().filter(|l| !l.starts_with('#'));
    let header: Vec<&str> = lines.next().unwrap_or_default().split(',').collect();
    let column = header.iter().position(|h| *h == name).unwrap_or(1);
    let number = |line: &str, c: usize| line.split(',').nth(c).and_then(|x| x.parse().ok()).unwrap_or(f64::NAN);
    lines.map(|l| [number(l, 0), number(l, column)]).collect()
}

/// The quantities and plots. The short form is Reynolds number 1000 on half as many cells a side.
#[must_use]
pub fn run(quick: bool) -> (Vec<Computed>, Vec<Figure>) {
    let plan = |reynolds: f64, cells: usize, duration: f64, average_from: f64| Plan {
        reynolds,
        cells,
        duration,
        average_from,
    };
    let never = f64::INFINITY;
    let mut computed = vec![];
    let mut add = |name: String, value: f64| computed.push(Computed::new(name, value));
    let low = plan(1000.0, if quick { CELLS / 2 } else { CELLS }, 60.0, never).run();
    steady(&low, &mut add);
    for (which, (value, _)) in ["bottom right", "bottom left"].iter().zip(low.secondary()) {
        add(format!("{which} streamfunction, Re 1000"), value);
    }
    if quick {
        let figures = vec![profile_figure(&[&low], true), profile_figure(&[&low], false)];
        return (computed, figures);
    }
    for cells in [128, 256] {
        let (value, place) = plan(1000.0, cells, 60.0, never).run().primary();
        add(format!("primary streamfunction, Re 1000, {cells} cells"), value);
        add(format!("primary x, Re 1000, {cells} cells"), place[0]);
        add(format!("primary y, Re 1000, {cells} cells"), place[1]);
    }
    let middle = plan(5000.0, CELLS, 400.0, never).run();
    steady(&middle, &mut add);
    let high = plan(10000.0, CELLS, 600.0, 300.0).run();
    add("primary streamfunction, Re 10000, mean".into(), high.primary().0);
    add("secondary vortices, Re 10000".into(), high.seen());
    add("tertiary streamfunction, Re 10000".into(), high.tertiary());
    let all = [&low, &middle, &high];
    let grow = all.windows(2).flat_map(|w| [0, 1].map(|k| w[1].secondary()[k].0 / w[0].secondary()[k].0));
    add("least growth of a bottom vortex from one Re to the next".into(), grow.fold(f64::INFINITY, f64::min));
    let mut figures = vec![profile_figure(&all, true), profile_figure(&all, false)];
    figures.extend(all.map(contours));
    (computed, figures)
}

/// What is compared for a steady flow.
fn steady(cavity: &Cavity, add: &mut impl FnMut(String, f64)) {
    let re = cavity.plan.reynolds;
    let (value, place) = cavity.primary();
    add(format!("primary streamfunction, Re {re}"), value);
    add(format!("primary x, Re {re}"), place[0]);
    add(format!("primary y, Re {re}"), place[1]);
    let [u, v] = [(U, "u", &cavity.u), (V, "v", &cavity.v)]
        .map(|(text, c, own)| cavity.distance(own, &points(text, &format!("{c}_Re{re}"))));
    add(format!("largest distance of u, Re {re}"), u);
    add(format!("largest distance of v, Re {re}"), v);
    add(format!("secondary vortices, Re {re}"), cavity.seen());
    add(format!("net volume through the centre lines, Re {re}"), cavity.leak);
    add(format!("drift, Re {re}"), cavity.drift.abs());
}

fn profile_figure(cavities: &[&Cavity], of_u: bool) -> Figure {
    let mut curves = vec![];
    for c in cavities {
        let re = c.plan.reynolds;
        curves.push(Curve::line(format!("Re {re}"), if of_u { c.u.clone() } else { c.v.clone() }));
        let (text, name) = if of_u { (U, "u") } else { (V, "v") };
        if text.contains(&format!("_Re{re},")) || text.contains(&format!("_Re{re}\n")) {
            let published = points(text, &format!("{name}_Re{re}"));
            curves.push(Curve::line(format!("Erturk 2005, Re {re}"), published).styled(Style::Points));
        }
    }
    let (title, along, what) = if of_u {
        ("Horizontal velocity on the vertical centre line", "z / L", "v_x / U")
    } else {
        ("Vertical velocity on the horizontal centre line", "x / L", "v_z / U")
    };
    Figure {
        title: title.into(),
        caption: "Lines: this solver. Points: Erturk, Corke & Gökçöl 2005.".into(),
        body: Body::Curves { x: Axis::linear(along, "1"), y: Axis::linear(what, "1"), curves },
    }
}

/// Contours of the streamfunction, closer together in the corners' weak vortices.
fn contours(cavity: &Cavity) -> Figure {
    let levels = [
        -0.115, -0.11, -0.1, -0.09, -0.07, -0.05, -0.03, -0.01, -1e-3, -1e-4, -1e-5, 1e-6, 1e-5, 1e-4, 5e-4, 1e-3,
        1.5e-3, 2e-3, 3e-3,
    ];
    let lines = levels.iter().flat_map(|&level| contour(&cavity.psi, level)).collect();
    let re = cavity.plan.reynolds;
    Figure {
        title: format!("Streamlines, Re {re}"),
        caption: "Contours of the streamfunction over U L; the lid at the top moves to the right.".into(),
        body: Body::Map {
            x: Axis::linear("x / L", "1"),
            y: Axis::linear("z / L", "1"),
            raster: Some(Raster {
                shape: cavity.psi.shape,
                extent: [0.0, 1.0, 0.0, 1.0],
                values: cavity.psi.values.clone(),
                label: "streamfunction".into(),
                unit: "1".into(),
            }),
            arrows: vec![],
            arrow_unit: "1".into(),
            lines,
        },
    }
}

/// Segments of one contour, by marching squares.
fn contour(sheet: &Sheet, level: f64) -> Vec<Vec<[f64; 2]>> {
    let [m, n] = sheet.shape;
    let h = sheet.spacing;
    let mut segments = vec![];
    for j in 0..n - 1 {
        for i in 0..m - 1 {
            let corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
            let mut crossed = vec![];
            for e in 0..4 {
                let (a, b) = (corners[e], corners[(e + 1) % 4]);
                let (p, q) = (sheet.at(a.0, a.1) - level, sheet.at(b.0, b.1) - level);
                if (p < 0.0) != (q < 0.0) {
                    let t = p / (p - q);
                    let along = |a: usize, b: usize, h: f64| (a as f64 + t * (b as f64 - a as f64)) * h;
                    crossed.push([along(a.0, b.0, h[0]), along(a.1, b.1, h[1])]);
                }
            }
            segments.extend(crossed.chunks_exact(2).map(<[_]>::to_vec));
        }
    }
    segments
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn published_points_are_read() {
        let u = points(U, "u_Re5000");
        assert_eq!((u.len(), u[0], u[20]), (21, [0.02, -0.2223], [0.99, 0.6866]));
        assert_eq!(points(V, "v_Re1000")[1], [0.03, 0.1792]);
    }

    #[test]
    fn interpolation_is_exact_for_cubics() {
        let f = |x: f64| 1.0 - x + 2.0 * x * x - 3.0 * x.powi(3);
        let points: Vec<_> = (0..8).map(|k| (k as f64 + 0.5) / 8.0).map(|x| [x, f(x)]).collect();
        for x in [0.02, 0.3, 0.5, 0.97] {
            assert!((cubic(&points, x) - f(x)).abs() < 1e-13, "{x}");
        }
    }

    #[test]
    fn contour_of_a_plane_is_a_line() {
        let values = (0..16).map(|k| (k % 4) as f64).collect();
        let sheet = Sheet { axes: [0, 2], shape: [4, 4], spacing: [0.5, 1.0], values };
        let segments = contour(&sheet, 1.5);
        assert_eq!(segments.len(), 3);
        assert!(segments.iter().flatten().all(|p| (p[0] - 0.75).abs() < 1e-15));
    }
}

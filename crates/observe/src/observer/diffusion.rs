//! Self-diffusion by velocities and by displacements.

use super::{AXES, Faults, Observe, Selection, Setting};
use crate::accumulate::{Batched, Estimate};
use crate::stats::correlation::{Correlator, displacement};
use crate::stats::fit;
use crate::view::View;
use brazilnut_base::figure::{Axis, Body, Curve, Figure, Style};
use brazilnut_base::keys::{Check, Key, Kind};
use brazilnut_base::menu::Entry;
use brazilnut_base::units::Dimension;
use brazilnut_base::values::Values;
use brazilnut_base::{Table, Vec3, parallel};
use serde::{Deserialize, Serialize};

/// Velocity autocorrelation and mean square displacement of tracer grains.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Diffusion {
    of: Selection,
    relative: bool,
    interval: f64,
    lags: usize,
    /// Samples between which the slope of the displacement is fitted, and last of the integral.
    fit: [usize; 2],
    last: usize,
    most: usize,
    tracers: Vec<u32>,
    /// Velocities and paths of the current window: grain, axis, sample.
    velocity: Vec<f64>,
    path: Vec<f64>,
    held: usize,
    /// Per group of tracers and window: number of tracers, mean velocities, then six curves.
    sums: Batched,
}

/// Groups of tracers that count as samples of their own for the error.
const GROUPS: usize = 4;
/// Sums before the curves.
const HEAD: usize = 4;

impl Observe for Diffusion {
    const ENTRY: Entry = Entry {
        name: "diffusion",
        summary: "Self-diffusion per axis: by the integral of the velocity autocorrelation and by the slope of the mean square displacement.",
        formula: "C_a(tau) = <v_a(t) v_a(t + tau)> (m^2/s^2) over grains and times (Lan 3-2-6), velocities as they are, no mean taken off\n\
                  M_a(tau) = <[r_a(t + tau) - r_a(t)]^2> (m^2), paths without periodic jumps (Lan 3-3-7)\n\
                  D_a by velocities = integral of C_a from 0 to `integral_until`, trapezoids (Lan 4-4-2); D_a by displacements = half the slope \
                  of M_a between `fit_from` and `fit_until` (Lan 4-4-5) (m^2/s); D = (D_x + D_y + D_z)/3\n\
                  windows of 2 `lags` samples, one after the other; errors by the jackknife over windows and groups of tracers",
        source: "Lan 1994, 3.2, 3.3, 4.4",
    };

    const KEYS: &'static [Key] = &[
        Key::default(
            "lags",
            Kind::Integer,
            "500",
            "Largest lag, in samples; a window holds twice as many samples.",
        )
        .with(Check::Between(8.0, 1e6)),
        Key::default(
            "tracers",
            Kind::Integer,
            "500",
            "Largest number of grains that are followed, evenly picked.",
        )
        .with(Check::Between(1.0, 1e7)),
        Key::optional(
            "integral_until",
            Kind::Quantity(Dimension::TIME),
            "Upper end of the integral of the autocorrelation; the largest lag if left out.",
        )
        .with(Check::Positive),
        Key::optional(
            "fit_from",
            Kind::Quantity(Dimension::TIME),
            "Lag at which the fit of the displacement begins; half of the largest if left out.",
        )
        .with(Check::NonNegative),
        Key::optional(
            "fit_until",
            Kind::Quantity(Dimension::TIME),
            "Lag at which that fit ends; the largest if left out.",
        )
        .with(Check::Positive),
        Key::default(
            "relative",
            Kind::Word(&["cell", "centre-of-mass"]),
            "\"cell\"",
            "What velocities and paths are relative to; the centre of mass takes out the common motion.",
        ),
    ];

    fn from_values(values: &Values, setting: &Setting) -> Result<Self, Faults> {
        let interval = setting.sampling.interval;
        let lags = values.integer("lags") as usize;
        let mut faults = vec![];
        let mut sample = |key: &str, default: usize| {
            let Some(t) = values.number_opt(key) else { return default };
            let n = (t / interval).round() as usize;
            if n > lags {
                let most = lags as f64 * interval;
                faults.push((
                    key.to_string(),
                    format!("the largest lag is {most:.3e} s: raise `lags` or sample less often"),
                ));
            }
            n
        };
        let fit = [sample("fit_from", lags / 2), sample("fit_until", lags)];
        let last = sample("integral_until", lags);
        if fit[0] + 2 > fit[1] {
            faults.push(("fit_from".into(), "the fit needs at least three lags before `fit_until`".into()));
        }
        if !faults.is_empty() {
            return Err(faults);
        }
        Ok(Self {
            of: Selection::read(values, setting)?,
            relative: values.text("relative") == "centre-of-mass",
            interval,
            lags,
            fit,
            last,
            most: values.integer("tracers") as usize,
            tracers: vec![],
            velocity: vec![],
            path: vec![],
            held: 0,
            sums: Batched::new(HEAD + 6 * (lags + 1), 4 * GROUPS, 1),
        })
    }

    fn observe(&mut self, view: &View) -> Option<Vec<f64>> {
        if self.tracers.is_empty() {
            self.choose(view);
        }
        let window = 2 * self.lags;
        let (r0, v0) = if self.relative { centre_of_mass(view) } else { (Vec3::ZERO, Vec3::ZERO) };
        for (n, &k) in self.tracers.iter().enumerate() {
            let (v, r) = (view.grains.velocity[k as usize] - v0, view.unwrapped(k as usize) - r0);
            for a in 0..3 {
                self.velocity[(3 * n + a) * window + self.held] = v[a];
                self.path[(3 * n + a) * window + self.held] = r[a];
            }
        }
        self.held += 1;
        if self.held == window {
            self.close();
        }
        None
    }

    fn results(&self) -> Vec<(String, Table)> {
        if self.sums.rows() == 0 {
            return vec![];
        }
        let d = self.coefficients();
        let mut columns = vec![];
        for a in AXES.iter().chain(&["mean"]) {
            for (tail, unit) in [
                ("velocities", "m^2/s"),
                ("velocities_error", "m^2/s"),
                ("displacements", "m^2/s"),
                ("displacements_error", "m^2/s"),
            ] {
                columns.push((format!("d_{a}_by_{tail}"), unit));
            }
        }
        for a in AXES {
            columns.push((format!("velocity_variance_{a}"), "m^2/s^2"));
            columns.push((format!("velocity_variance_{a}_error"), "m^2/s^2"));
        }
        columns.push(("tracers".into(), "1"));
        columns.push(("windows".into(), "1"));
        let named: Vec<(&str, &str)> = columns.iter().map(|(n, u)| (n.as_str(), *u)).collect();
        let mut t = Table::new(&named);
        let mut row: Vec<f64> = d.iter().flat_map(|e| [e.value, e.error]).collect();
        row.extend([
            self.tracers.len() as f64,
            (self.sums.rows() as usize / GROUPS.min(self.tracers.len())) as f64,
        ]);
        t.rows.push(row);
        vec![("coefficients".into(), t), ("curves".into(), self.curves_table())]
    }

    fn figures(&self, _: &Table) -> Vec<Figure> {
        if self.sums.rows() == 0 {
            return vec![];
        }
        let curves = self.curves();
        let n = self.lags + 1;
        let axis_curve = |c: usize, label: &str| Curve {
            error: (0..n).map(|l| curves[c * n + l].error).collect(),
            ..Curve::line(
                label,
                (0..n).map(|l| [l as f64 * self.interval, curves[c * n + l].value]).collect(),
            )
        };
        let lag = Axis::linear("lag", "s");
        let mut slopes = vec![];
        for a in 0..3 {
            slopes.push(axis_curve(3 + a, AXES[a]));
            let line: Vec<[f64; 2]> = self.fitted(|l| curves[(3 + a) * n + l].value).map_or(vec![], |f| {
                self.fit
                    .map(|l| l as f64 * self.interval)
                    .map(|t| [t, f.intercept.value + f.slope.value * t])
                    .to_vec()
            });
            slopes.push(Curve::line(format!("{} fit", AXES[a]), line).styled(Style::Dashed));
        }
        vec![
            Figure {
                title: "Velocity autocorrelation".into(),
                caption: format!("<v(t) v(t + tau)> per axis over {} grains; the integral gives the self-diffusion. {}", self.tracers.len(), self.verdict()),
                body: Body::Curves {
                    x: lag.clone(),
                    y: Axis::linear("autocorrelation", "m^2/s^2"),
                    curves: (0..3).map(|a| axis_curve(a, AXES[a])).collect(),
                },
            },
            Figure {
                title: "Mean square displacement".into(),
                caption: "<[r(t + tau) - r(t)]²> per axis, paths without periodic jumps; half the slope of the fit is the self-diffusion.".into(),
                body: Body::Curves { x: lag.clone(), y: Axis::linear("mean square displacement", "m^2"), curves: slopes },
            },
            Figure {
                title: "Self-diffusion against the lag".into(),
                caption: "Lines: integral of the velocity autocorrelation up to the lag. Dashed: half the slope of the mean \
                          square displacement there. Both are flat where the motion has become diffusive, and should then meet."
                    .into(),
                body: Body::Curves { x: lag, y: Axis::linear("self-diffusion", "m^2/s"), curves: self.growing(&curves) },
            },
        ]
    }
}

impl Diffusion {
    /// Picks tracers evenly among the chosen grains and makes room for a window.
    fn choose(&mut self, view: &View) {
        let g = view.grains;
        let all: Vec<u32> = (0..g.len()).filter(|&k| self.of.takes(g, k)).map(|k| k as u32).collect();
        let n = self.most.min(all.len());
        self.tracers = (0..n).map(|k| all[k * all.len() / n]).collect();
        self.velocity = vec![0.0; 3 * n * 2 * self.lags];
        self.path = vec![0.0; 3 * n * 2 * self.lags];
    }

    /// Adds the curves of a full window, group by group, and begins the next.
    fn close(&mut self) {
        let window = 2 * self.lags;
        let n = self.lags + 1;
        let mut correlator = Correlator::new(window, self.lags);
        let (mut cv, mut cr, mut r) = (vec![0.0; n], vec![0.0; n], vec![0.0; window]);
        for group in parallel::cut(self.tracers.len(), GROUPS) {
            let sums = self.sums.open();
            sums[0] += group.len() as f64;
            for s in 3 * group.start..3 * group.end {
                let (v, path) =
                    (&self.velocity[s * window..(s + 1) * window], &self.path[s * window..(s + 1) * window]);
                let middle = path.iter().sum::<f64>() / window as f64;
                r.iter_mut().zip(path).for_each(|(r, x)| *r = x - middle);
                correlator.auto_pair(v, &r, &mut cv, &mut cr);
                displacement(&r, &mut cr);
                let axis = s % 3;
                sums[1 + axis] += v.iter().sum::<f64>() / window as f64;
                for (curve, values) in [(axis, &cv), (3 + axis, &cr)] {
                    let at = HEAD + curve * n;
                    sums[at..at + n].iter_mut().zip(values).for_each(|(s, c)| *s += c);
                }
            }
        }
        self.held = 0;
    }

    /// C_x, C_y, C_z, M_x, M_y, M_z lag by lag.
    fn curves(&self) -> Vec<Estimate> {
        self.sums.estimates(6 * (self.lags + 1), |s, _, out| {
            out.iter_mut().zip(&s[HEAD..]).for_each(|(o, x)| *o = x / s[0]);
        })
    }

    fn curves_table(&self) -> Table {
        let names = ["autocorrelation", "displacement"].iter().zip(["m^2/s^2", "m^2"]);
        let columns: Vec<(String, &str)> = names
            .flat_map(|(n, u)| {
                AXES.iter().flat_map(move |a| [(format!("{n}_{a}"), u), (format!("{n}_{a}_error"), u)])
            })
            .collect();
        let mut t = Table::new(&[("lag", "s")]);
        t.columns.extend(columns.iter().map(|(n, u)| brazilnut_base::Column::new(n, *u)));
        let (c, n) = (self.curves(), self.lags + 1);
        t.rows = (0..n)
            .map(|l| {
                let mut row = vec![l as f64 * self.interval];
                row.extend((0..6).flat_map(|k| [c[k * n + l].value, c[k * n + l].error]));
                row
            })
            .collect();
        t
    }

    fn fitted(&self, m: impl Fn(usize) -> f64) -> Option<fit::Line> {
        let lags = self.fit[0]..=self.fit[1];
        let x: Vec<f64> = lags.clone().map(|l| l as f64 * self.interval).collect();
        let y: Vec<f64> = lags.map(m).collect();
        fit::line(&x, &y)
    }

    /// D by velocities and by displacements for x, y, z and their mean, then the variances of the velocity.
    fn coefficients(&self) -> Vec<Estimate> {
        let n = self.lags + 1;
        self.sums.estimates(11, |s, _, out| {
            for a in 0..3 {
                let c = |l: usize| s[HEAD + a * n + l] / s[0];
                let ends = 0.5 * (c(0) + c(self.last));
                out[2 * a] = self.interval * (ends + (1..self.last).map(c).sum::<f64>());
                let line = self.fitted(|l| s[HEAD + (3 + a) * n + l] / s[0]);
                out[2 * a + 1] = line.map_or(f64::NAN, |f| 0.5 * f.slope.value);
                let mean = s[1 + a] / s[0];
                out[8 + a] = c(0) - mean * mean;
            }
            out[6] = (out[0] + out[2] + out[4]) / 3.0;
            out[7] = (out[1] + out[3] + out[5]) / 3.0;
        })
    }

    /// Both estimates as they grow with the lag.
    fn growing(&self, curves: &[Estimate]) -> Vec<Curve> {
        let n = self.lags + 1;
        let mut all = vec![];
        for a in 0..3 {
            let (c, m) = (|l: usize| curves[a * n + l].value, |l: usize| curves[(3 + a) * n + l].value);
            let mut integral = 0.0;
            let mut points = vec![[0.0, 0.0]];
            for l in 1..n {
                integral += 0.5 * self.interval * (c(l - 1) + c(l));
                points.push([l as f64 * self.interval, integral]);
            }
            // Slopes over a twentieth of the largest lag, so that they do not show every sample's noise.
            let h = (n / 40).max(1);
            let slope = |l: usize| 0.25 * (m(l + h) - m(l - h)) / (h as f64 * self.interval);
            let slopes = (h..n - h).map(|l| [l as f64 * self.interval, slope(l)]).collect();
            all.push(Curve::line(format!("{} by velocities", AXES[a]), points));
            all.push(Curve::line(format!("{} by displacements", AXES[a]), slopes).styled(Style::Dashed));
        }
        all
    }

    /// Whether both ways agree, and if not, what does not settle.
    fn verdict(&self) -> String {
        let d = self.coefficients();
        let (curves, n) = (self.curves(), self.lags + 1);
        let mut words = vec![];
        for a in 0..3 {
            let (v, r) = (d[2 * a], d[2 * a + 1]);
            let sigma = (v.value - r.value).abs() / v.error.hypot(r.error);
            let both = format!(
                "D_{} = {:.4e} ± {:.1e} by velocities, {:.4e} ± {:.1e} m²/s by displacements",
                AXES[a], v.value, v.error, r.value, r.error
            );
            let c = |l: usize| curves[a * n + l].value;
            let tail = self.interval * (self.last * 3 / 4..self.last).map(c).sum::<f64>();
            words.push(if sigma <= 2.0 {
                format!("{both}: they agree within two standard errors.")
            } else if tail.abs() > 0.1 * v.value.abs() {
                format!("{both}: they differ, and the last quarter of the integral still adds {tail:.1e}: the motion stays correlated to the largest lag.")
            } else {
                format!("{both}: they differ by {sigma:.1} standard errors; sample more often if the autocorrelation falls within a few samples.")
            });
        }
        words.join(" ")
    }
}

fn centre_of_mass(view: &View) -> (Vec3, Vec3) {
    let g = view.grains;
    let (mut m, mut r, mut v) = (0.0, Vec3::ZERO, Vec3::ZERO);
    for k in 0..g.len() {
        m += g.mass[k];
        r += g.mass[k] * view.unwrapped(k);
        v += g.mass[k] * g.velocity[k];
    }
    (r / m, v / m)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::known::ornstein_uhlenbeck;
    use crate::synthetic::{Stage, setting, values};
    use brazilnut_base::vec3;

    /// Grains with Ornstein-Uhlenbeck velocities, integrated by trapezoids through a periodic cell.
    fn gas(n: usize, samples: usize, lags: f64, s2: [f64; 3], tau: f64) -> Diffusion {
        let dt = 0.01;
        let mut stage = Stage::new(vec3(0.5, 0.5, 1e3), "periodic");
        stage.scatter(n, 0.01, 1);
        let paths: Vec<Vec<f64>> =
            (0..3 * n).map(|k| ornstein_uhlenbeck(samples, dt, s2[k % 3], tau, 100 + k as u64)).collect();
        let cell = stage.cell;
        let species = [("all".to_string(), n)];
        let v = values(Diffusion::KEYS, &[("lags", lags), ("fit_from", 0.3)]);
        let mut d = Diffusion::from_values(&v, &setting(&cell, &species)).unwrap();
        for t in 0..samples {
            for k in 0..n {
                let v = vec3(paths[3 * k][t], paths[3 * k + 1][t], paths[3 * k + 2][t]);
                let before = stage.grains.velocity[k];
                stage.grains.velocity[k] = v;
                let step = if t == 0 { Vec3::ZERO } else { 0.5 * dt * (before + v) };
                let (r, crossed) = cell.wrap(stage.grains.position[k] + step);
                stage.grains.position[k] = r;
                for a in 0..3 {
                    stage.grains.image[k][a] += crossed[a];
                }
            }
            assert!(d.observe(&stage.view()).is_none());
        }
        d
    }

    #[test]
    fn both_ways_give_the_known_diffusion_of_an_ornstein_uhlenbeck_gas() {
        let (s2, tau) = ([1.0, 4.0, 0.25], 0.05);
        let d = gas(400, 800, 100.0, s2, tau);
        let e = d.coefficients();
        for a in 0..3 {
            // Continuous D = s2 tau; trapezoids at dt = tau/5 give dt s2 (1 + q)/(2 (1 - q)), q = exp(-1/5), 0.3 % more.
            let q = (-0.2_f64).exp();
            let exact = s2[a] * 0.01 * 0.5 * (1.0 + q) / (1.0 - q);
            for x in [e[2 * a], e[2 * a + 1]] {
                // 400 grains over 160 correlation times: a few per cent; and the error must say so (factor two).
                assert!((x.value / exact - 1.0).abs() < 0.1, "{a}: {x:?} {exact}");
                assert!((x.value - exact).abs() < 5.0 * x.error, "{a}: {x:?} {exact}");
                assert!(x.error < 0.06 * exact, "{a}: {x:?}");
            }
            assert!((e[8 + a].value / s2[a] - 1.0).abs() < 0.03);
        }
        assert!(d.verdict().contains("agree"), "{}", d.verdict());
    }

    #[test]
    fn free_flight_is_ballistic_through_periodic_sides() {
        let mut stage = Stage::new(vec3(0.5, 0.5, 1.0), "periodic");
        stage.add(vec3(0.1, 0.1, 0.1), 0.01);
        stage.grains.velocity[0] = vec3(3.0, -2.0, 0.0);
        let cell = stage.cell;
        let species = [("all".to_string(), 1)];
        let mut d =
            Diffusion::from_values(&values(Diffusion::KEYS, &[("lags", 20.0)]), &setting(&cell, &species))
                .unwrap();
        for _ in 0..40 {
            let _ = d.observe(&stage.view());
            let (r, crossed) = cell.wrap(stage.grains.position[0] + 0.01 * stage.grains.velocity[0]);
            stage.grains.position[0] = r;
            (0..3).for_each(|a| stage.grains.image[0][a] += crossed[a]);
        }
        let m = d.curves();
        let at = |axis: usize, lag: usize| m[(3 + axis) * 21 + lag].value;
        for lag in 0..=20 {
            let t = 0.01 * lag as f64;
            assert!((at(0, lag) - 9.0 * t * t).abs() < 1e-13 && (at(1, lag) - 4.0 * t * t).abs() < 1e-13);
            assert!((m[lag].value - 9.0).abs() < 1e-12);
        }
    }

    #[test]
    fn a_lag_beyond_the_window_is_refused() {
        let cell = Stage::new(vec3(1.0, 1.0, 1.0), "walls").cell;
        let species = [("all".to_string(), 1)];
        let v = values(Diffusion::KEYS, &[("lags", 20.0), ("fit_until", 5.0)]);
        let faults = Diffusion::from_values(&v, &setting(&cell, &species)).unwrap_err();
        assert!(faults[0].0 == "fit_until" && faults[0].1.contains("raise `lags`"));
    }
}

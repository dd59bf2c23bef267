//! The start-up sheet: what the coupling's numbers mean, and what cannot work.

use crate::resolved::{Inertia, Springs, Templates, forcing, leak};
use crate::spec::{CouplingSpec, Method, Resolved};
use brazilnut_fluid::Grid;

/// One kind of grain.
#[derive(Clone, Debug, PartialEq)]
pub struct Population {
    /// Name of the species.
    pub name: String,
    /// Full mass of a mean grain, kg.
    pub mass: f64,
    /// Mean radius, m.
    pub radius: f64,
    /// Density, kg/m³.
    pub density: f64,
    /// Number of grains.
    pub count: usize,
}

/// What a check prints about the coupling.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sheet {
    /// Name and value.
    pub lines: Vec<(String, String)>,
    /// What cannot work.
    pub refusals: Vec<Refusal>,
    /// What may surprise.
    pub warnings: Vec<String>,
}

/// Something that cannot work, and what to do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// What is wrong.
    pub message: String,
    /// Why.
    pub cause: String,
    /// What to do.
    pub remedy: String,
}

/// From this ratio to the grain's mass on an explicit exchange of added mass overshoots.
const ADDED_MASS: f64 = 1.0;
/// Porosity of a random packing (Clément 2.4.1).
const PACKED: f64 = 0.42;

impl Sheet {
    /// For steps of length `dt` (s) and a shake of `frequency` (Hz).
    #[must_use]
    pub fn new(
        spec: &CouplingSpec,
        grid: Option<&Grid>,
        populations: &[Population],
        dt: f64,
        frequency: Option<f64>,
    ) -> Self {
        let mut sheet = Self::default();
        match (spec, grid) {
            (CouplingSpec::Averaged(a), Some(grid)) => {
                sheet.averaged(a, grid, populations);
                let exchange = match a.formulation {
                    crate::averaged::Formulation::A => "model A, equal and opposite; porosity floor",
                    crate::averaged::Formulation::Printed => "as printed (2.76), not equal and opposite",
                };
                sheet.line("exchange", exchange.into());
                sheet.line("porosity floor", format!("{}", a.porosity_floor));
            }
            (CouplingSpec::Resolved(r), Some(grid)) => {
                sheet.resolved(r, grid, populations, dt, frequency);
            }
            _ => {}
        }
        sheet
    }

    fn line(&mut self, name: impl Into<String>, value: String) {
        self.lines.push((name.into(), value));
    }

    fn refuse(&mut self, message: String, cause: String, remedy: &str) {
        self.refusals.push(Refusal { message, cause, remedy: remedy.into() });
    }

    fn averaged(&mut self, spec: &crate::averaged::Averaged, grid: &Grid, populations: &[Population]) {
        // The printed force takes no part of the solved pressure, and so no added mass.
        let density = match spec.formulation {
            crate::averaged::Formulation::A => spec.density,
            crate::averaged::Formulation::Printed => 0.0,
        };
        for p in populations {
            let h = crate::resolved::tracers::spacing(grid);
            let cells = 2.0 * p.radius / h;
            self.line(format!("diameter of {} over grid spacing", p.name), format!("{cells:.3}"));
            if cells > 1.0 {
                self.warnings.push(format!(
                    "{} are larger than a grid cell: a bed equation means little there; coarsen the grid or use a resolved rung",
                    p.name
                ));
            }
            let ratio = density * (1.0 - PACKED) / (p.density * PACKED);
            if ratio >= ADDED_MASS {
                self.refuse(
                    format!("{} are too light for `navier-stokes`", p.name),
                    format!("in a packed bed the added mass is {ratio:.2} times theirs: the explicit exchange overshoots"),
                    "use `direct-forcing`",
                );
            }
        }
    }

    fn resolved(
        &mut self,
        spec: &Resolved,
        grid: &Grid,
        populations: &[Population],
        dt: f64,
        frequency: Option<f64>,
    ) {
        let radii: Vec<f64> = populations.iter().map(|p| p.radius).collect();
        let templates = Templates::new(grid, spec.body, &radii, spec.layout, spec.retraction);
        let h = crate::resolved::tracers::spacing(grid);
        let viscous = spec.viscosity / spec.density * dt / (h * h);
        self.line("viscous number nu dt/h²", format!("{viscous:.2e}"));
        for (k, p) in populations.iter().enumerate() {
            self.line(format!("points per radius of {}", p.name), format!("{:.2}", p.radius / h));
            if p.radius / h < 2.0 {
                self.warnings.push(format!(
                    "{} have fewer than two grid cells per radius: their flow is not resolved",
                    p.name
                ));
            }
            let tracers = templates.fit(k).0.points.len();
            match spec.method {
                Method::Template => self.template(p, spec.density),
                Method::Springs(s) => {
                    self.line(format!("tracers of {}", p.name), tracers.to_string());
                    self.springs(spec, &s, p, tracers, grid, dt, frequency);
                }
                Method::Forcing(f) => {
                    self.line(format!("tracers of {}", p.name), tracers.to_string());
                    self.line("sweeps", f.sweeps.to_string());
                    let share = forcing::following(spec.body, p.density / spec.density, p.radius / h);
                    if share < 1.0 {
                        self.line(
                            format!("virtual mass of {}", p.name),
                            format!(
                                "{:.3} of their own: they are lighter than their added mass",
                                1.0 / share - 1.0
                            ),
                        );
                    }
                }
            }
        }
        if let Some(l) = &spec.lubrication {
            self.line("lubrication", format!("on, gaps {:.2e} to {:.2e} m", l.min_gap, l.max_gap));
        }
    }

    fn template(&mut self, p: &Population, density: f64) {
        if p.density <= density {
            self.refuse(
                format!("{} are too light for `particle-template`", p.name),
                "they are no denser than the fluid: the explicit force overshoots".into(),
                "use `direct-forcing`",
            );
        }
    }

    fn springs(
        &mut self,
        spec: &Resolved,
        springs: &Springs,
        p: &Population,
        tracers: usize,
        grid: &Grid,
        dt: f64,
        frequency: Option<f64>,
    ) {
        let body = spec.spring_body(p.mass, p.radius, tracers, grid.cell_volume());
        // Mass and volume come by different ways: equal densities leave a template of rounding.
        if body.template_mass <= 1e-9 * p.mass {
            self.refuse(
                format!("{} are too light for `fluid-springs`", p.name),
                "they are no denser than the fluid: their template has no mass".into(),
                "use `direct-forcing`",
            );
            return;
        }
        let (alpha, tau) = (springs.alpha(&body, dt), springs.relaxation_time(&body, dt));
        self.line(format!("slip of {} removed per step, alpha", p.name), format!("{alpha:.3}"));
        self.line(format!("relaxation time of {}, tau", p.name), format!("{tau:.3e} s"));
        if let Some(f) = frequency {
            self.line(format!("tau f of {}", p.name), format!("{:.3}", tau * f));
            if tau * f > leak::WARNING {
                self.warnings.push(format!(
                    "{} are nearly transparent: their slip decays in {:.2} of a shake; lower `relaxation_time`",
                    p.name,
                    tau * f
                ));
            }
        }
        let stiffness = springs.stiffness(&body, dt);
        let carried = if springs.inertia == Inertia::Template { "template" } else { "grain" };
        self.line(format!("stiffness of {} (stable below 2)", p.name), format!("{stiffness:.3}"));
        if stiffness >= 2.0 {
            self.refuse(
                format!("the springs of {} are unstable", p.name),
                format!("a step takes {stiffness:.2} of the slip away from fluid and {carried} (limit 2)"),
                "weaken the springs (longer `relaxation_time`, lower `c_s`) or shorten the step",
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::Body;
    use crate::resolved::{Forcing, Layout, Strength};
    use crate::transfer::KernelName;
    use brazilnut_base::Side;

    fn population(density: f64) -> Population {
        let radius = 350e-6;
        let mass = density * Body::Sphere.volume(radius);
        Population { name: "beads".into(), mass, radius, density, count: 600 }
    }

    fn sheet(method: Method, density: f64, dt: f64) -> Sheet {
        let spec = Resolved {
            method,
            kernel: KernelName::Trilinear,
            layout: Layout::Lattice,
            retraction: 0.0,
            lubrication: None,
            density: 1000.0,
            viscosity: 8.91e-4,
            body: Body::Sphere,
        };
        let h = 350e-6 / 3.0;
        let grid = Grid::new([36, 36, 256], [h; 3], [Side::Periodic, Side::Periodic, Side::Walls]);
        Sheet::new(&CouplingSpec::Resolved(spec), Some(&grid), &[population(density)], dt, Some(20.0))
    }

    fn springs(c: f64) -> Method {
        Method::Springs(Springs { strength: Strength::Cs(c), damping: 0.0, inertia: Inertia::Template })
    }

    #[test]
    fn published_thrown_bed_passes_and_its_meaning_is_printed() {
        let s = sheet(springs(0.5), 2500.0, 1e-5);
        assert!(s.refusals.is_empty() && s.warnings.is_empty(), "{s:?}");
        assert!(s.lines.iter().any(|(k, _)| k.contains("tau")));
    }

    #[test]
    fn what_is_unstable_is_refused() {
        assert_eq!(sheet(springs(2.5), 2500.0, 1e-5).refusals.len(), 1, "alpha beyond 2");
        assert_eq!(sheet(springs(0.5), 1000.0, 1e-5).refusals.len(), 1, "no template mass");
        assert_eq!(sheet(springs(1.5), 1010.0, 1e-5).refusals.len(), 1, "barely heavy");
        assert_eq!(sheet(Method::Template, 1000.0, 1e-5).refusals.len(), 1);
    }

    #[test]
    fn forced_bodies_lighter_than_their_added_mass_carry_a_virtual_one() {
        let said = |density: f64| {
            let s = sheet(Method::Forcing(Forcing { sweeps: 3 }), density, 1e-5);
            assert!(s.refusals.is_empty(), "{s:?}");
            s.lines.iter().any(|(k, _)| k.contains("virtual mass"))
        };
        assert!(said(700.0) && !said(910.0));
    }

    #[test]
    fn leaky_springs_warn() {
        let slow = Method::Springs(Springs {
            strength: Strength::RelaxationTime(50e-3),
            damping: 0.0,
            inertia: Inertia::Template,
        });
        assert_eq!(sheet(slow, 7750.0, 1e-4).warnings.len(), 1);
    }
}

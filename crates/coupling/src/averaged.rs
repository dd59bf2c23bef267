//! `navier-stokes`: grains smaller than the cells of the grid (Clément 2009, 2.4.2-2.4.5).
//!
//! Porosity phi and grain velocity u are mapped to the faces by a partition
//! of unity; a bed equation K gives the exchange (formulation "A": grains and
//! fluid share the pressure gradient):
//!
//! ```text
//! fluid:  dv/dt + (v . grad) v = -grad P / rho + nu laplacian v - beta (v - u),   beta = phi K / rho
//! volume: div(phi v + (1 - phi) u) = 0                                             (2.63)
//! grain:  F = V_p [-grad P + phi (-dP)_bed / (1 - phi)],   (-dP)_bed = K phi (v - u)
//! ```
//!
//! The drag that a face takes from the fluid is shared among the grains that
//! the kernel puts on it: what the fluid receives is what the grains give. The
//! printed force (2.76) is not equal and opposite; it is kept for comparison.
//!
//! A grain falls in the fluid that it drags along, and so too fast. A single one, 0.1 mm of glass in water after 80 ms,
//! against the terminal speed of Wen-Yu (`tests/averaged.rs`):
//!
//! | diameter over cell | 0.05 | 0.1 | 0.2 | 0.4 |
//! | --- | --- | --- | --- | --- |
//! | trilinear | 0.14 % | 1.2 % | 4.7 % | 15 % |
//! | roma | 0.08 % | 0.6 % | 3.2 % | 11 % |

mod map;
mod menu;

pub use map::{Mapped, Mapping};
pub use menu::{FORMULATIONS, KEYS};

use crate::body::Body;
use crate::load::Load;
use crate::transfer::KernelName;
use crate::with_kernel;
use brazilnut_base::Vec3;
use brazilnut_bed::bed_equation::{BedEquation, BedLaw, Medium as Bed};
use brazilnut_bed::with_bed_law;
use brazilnut_fluid::{Faces, Flow, Grid, Medium, Mixture, Resistance, Solid};
use brazilnut_grains::Grains;
use serde::{Deserialize, Serialize};

/// What `navier-stokes` needs to know.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Averaged {
    /// The bed equation.
    pub equation: BedEquation,
    /// The kernel between grains and faces.
    pub kernel: KernelName,
    /// Porosity is not let below this.
    pub porosity_floor: f64,
    /// The force on the grains.
    pub formulation: Formulation,
    /// Density of the fluid, kg/m³.
    pub density: f64,
    /// Viscosity of the fluid, Pa s.
    pub viscosity: f64,
    /// Mean diameter of each species, m.
    pub diameter: Vec<f64>,
    /// Body of the grains.
    pub body: Body,
}

/// The force on a grain.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Formulation {
    /// Model A: V_p [−grad P + phi (−dP)_bed/(1 − phi)]; equal and opposite.
    #[default]
    A,
    /// Clément eq. 2.76: V_p (−dP)_bed/(1 − phi). It stands for the drag and for the grains' share of
    /// the gradient of a steady flow (then it equals "a"), and is not equal and opposite.
    Printed,
}

/// What the last mapping found and the last step exchanged.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct AveragedReport {
    /// Least porosity mapped, before the floor.
    pub least_porosity: f64,
    /// Faces at which the floor held.
    pub floored: u64,
    /// Force of the drag on the fluid in the last step, N.
    pub drag_on_fluid: Vec3,
    /// Force of the drag on the grains, N.
    pub drag_on_grains: Vec3,
    /// Force of the pressure gradient on the grains, N.
    pub pressure_on_grains: Vec3,
}

/// Work space: tables and mapped fields; rebuilt from the case, not saved.
#[derive(Clone, Debug)]
pub struct AveragedWork {
    mapping: Mapping,
    mapped: Mapped,
    /// phi rho beta of each face, kg/(m³ s).
    exchange: Faces,
    /// Per volume of grains: −grad P (Pa/m), the drag coefficient c (kg/(m³ s)) and c v (N/m³).
    push: [Faces; 3],
}

/// beta = phi K(|V0|)/rho, 1/s (Clément eq. 2.61 for any bed equation), V0 = phi (v − u).
#[inline]
#[must_use]
pub fn exchange_rate<L: BedLaw>(law: L, slip: f64, bed: &Bed) -> f64 {
    bed.porosity * law.coefficient(bed.porosity * slip, bed) / bed.density
}

/// Least solids fraction that a bed equation is asked about.
const MOST_DILUTE: f64 = 1e-9;

impl AveragedWork {
    /// Work space for `grid` with inner `solids`.
    #[must_use]
    pub fn new(spec: &Averaged, grid: &Grid, solids: &[Solid]) -> Self {
        Self {
            mapping: Mapping::new(spec.kernel, grid, solids),
            mapped: Mapped::new(grid),
            exchange: Faces::new(grid),
            push: [Faces::new(grid), Faces::new(grid), Faces::new(grid)],
        }
    }

    /// Room for what the fluid is told.
    #[must_use]
    pub fn medium(grid: &Grid) -> Medium {
        Medium { resistance: Some(Resistance::none(grid)), mixture: Some(Mixture::clear(grid)) }
    }

    /// Maps the grains and fills `medium` for the coming fluid step.
    pub fn before_fluid(
        &mut self,
        spec: &Averaged,
        grains: &Grains,
        flow: &Flow,
        medium: &mut Medium,
        report: &mut AveragedReport,
    ) {
        let (Some(resistance), Some(mixture)) = (&mut medium.resistance, &mut medium.mixture) else {
            return;
        };
        self.mapping.map(spec, grains, &mut self.mapped);
        self.mapping.mixture(spec.porosity_floor, &self.mapped, mixture, &mut resistance.target, report);
        with_bed_law!(spec.equation, law => self.rates(spec, law, flow, mixture, resistance));
    }

    /// beta and phi rho beta on every face.
    fn rates<L: BedLaw>(
        &mut self,
        spec: &Averaged,
        law: L,
        flow: &Flow,
        mixture: &Mixture,
        resistance: &mut Resistance,
    ) {
        let Resistance { rate, target } = resistance;
        for c in 0..3 {
            let rate = rate.component_mut(c);
            let exchange = self.exchange.component_mut(c);
            for &(place, at) in self.mapping.free(c) {
                (rate[place], exchange[place]) = (0.0, 0.0);
                if self.mapped.solids.component(c)[place] <= 0.0 {
                    continue;
                }
                let v = self.mapping.vector_at(c, at, &flow.velocity);
                let u = self.mapping.vector_at(c, at, target);
                let bed = Bed {
                    porosity: mixture.porosity.component(c)[place].min(1.0 - MOST_DILUTE),
                    diameter: self.mapped.diameter(c, place),
                    density: spec.density,
                    viscosity: spec.viscosity,
                };
                rate[place] = exchange_rate(law, (v - u).length(), &bed);
                exchange[place] = bed.porosity * spec.density * rate[place];
            }
        }
    }

    /// The force on every grain from the flow at the end of the step.
    pub fn after_fluid(
        &mut self,
        spec: &Averaged,
        grains: &Grains,
        flow: &Flow,
        medium: &Medium,
        loads: &mut [Load],
        report: &mut AveragedReport,
    ) {
        let (Some(resistance), Some(mixture)) = (&medium.resistance, &medium.mixture) else { return };
        self.pushes(spec, flow, resistance, mixture, report);
        let [gradient, coefficient, carried] = &self.push;
        (report.drag_on_grains, report.pressure_on_grains) = (Vec3::ZERO, Vec3::ZERO);
        with_kernel!(spec.kernel, kernel => {
            for (k, load) in loads.iter_mut().enumerate() {
                let (x, u) = (grains.position[k], grains.velocity[k]);
                let (mut pressure, mut drag) = (Vec3::ZERO, Vec3::ZERO);
                self.mapping.gather(kernel, x, [gradient, coefficient, carried], |c, [p, b, bv]| {
                    pressure[c] = p;
                    drag[c] = bv - b * u[c];
                });
                let volume = spec.body.volume(grains.radius[k]);
                *load = Load { force: volume * (pressure + drag), torque: Vec3::ZERO };
                report.pressure_on_grains += volume * pressure;
                report.drag_on_grains += volume * drag;
            }
        });
    }

    /// What every face does to the grains on it.
    fn pushes(
        &mut self,
        spec: &Averaged,
        flow: &Flow,
        resistance: &Resistance,
        mixture: &Mixture,
        report: &mut AveragedReport,
    ) {
        let cell_volume = self.mapping.cell_volume;
        let [gradient, coefficient, carried] = &mut self.push;
        for c in 0..3 {
            let (v, u) = (flow.velocity.component(c), resistance.target.component(c));
            let solids = self.mapped.solids.component(c);
            let exchange = self.exchange.component(c);
            let porosity = mixture.porosity.component(c);
            let gradient = gradient.component_mut(c);
            let (coefficient, carried) = (coefficient.component_mut(c), carried.component_mut(c));
            let mut sum = 0.0;
            for &(place, at) in self.mapping.free(c) {
                let slope = self.mapping.slope(c, at, &flow.pressure.values);
                // The drag of the face's cell, shared by the volume of grains that the kernel puts there.
                let drag = exchange[place] * cell_volume;
                let shared = if solids[place] > 0.0 { drag / solids[place] } else { 0.0 };
                match spec.formulation {
                    Formulation::A => (gradient[place], coefficient[place]) = (-slope, shared),
                    Formulation::Printed => {
                        (gradient[place], coefficient[place]) = (0.0, shared / porosity[place]);
                    }
                }
                carried[place] = coefficient[place] * v[place];
                sum -= drag * (v[place] - u[place]);
            }
            report.drag_on_fluid[c] = sum;
        }
    }
}

#[cfg(test)]
mod tests;

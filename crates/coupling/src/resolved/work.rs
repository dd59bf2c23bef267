//! Work space of the couplings with tracers, and their steps.

use super::schedule::Schedule;
use super::sweep::{Scene, Tally};
use super::tracers::{LANES, Layout, Templates, Wide};
use crate::body::Body;
use crate::transfer::{KernelName, Stagger};
use crate::with_kernel;
use brazilnut_fluid::{Faces, Grid};
use brazilnut_grains::Grains;

/// Tables, templates and buffers; rebuilt from the case, not saved.
#[derive(Clone, Debug)]
pub struct TracerWork {
    kernel: KernelName,
    stagger: Stagger,
    /// The tracers of each grain.
    pub templates: Templates,
    schedule: Schedule,
    slips: Vec<Wide>,
    tallies: Vec<Tally>,
    /// What the tracers of each grain did, in the order of identity.
    pub of_grain: Vec<Tally>,
    cell_volume: f64,
}

impl TracerWork {
    /// Room for bodies of `radii` (m) on `grid`.
    #[must_use]
    pub fn new(
        grid: &Grid,
        body: Body,
        radii: &[f64],
        layout: Layout,
        retraction: f64,
        kernel: KernelName,
    ) -> Self {
        let templates = Templates::new(grid, body, radii, layout, retraction);
        let schedule = Schedule::new(grid, &templates);
        let batches = (0..radii.len()).map(|k| templates.fit(k).0.batches.len()).sum();
        let least = grid.spacing.iter().copied().fold(f64::INFINITY, f64::min);
        let largest = radii.iter().copied().fold(0.0, f64::max);
        Self {
            kernel,
            // A centre lies in the box, give or take an overlap; its tracers reach a radius beyond.
            stagger: Stagger::new(grid, (1.5 * largest / least) as usize + 4),
            slips: vec![[[0.0; LANES]; 3]; batches],
            tallies: vec![Tally::default(); schedule.items.len()],
            of_grain: vec![Tally::default(); radii.len()],
            schedule,
            templates,
            cell_volume: grid.cell_volume(),
        }
    }

    /// Sorts the tracers for the grains' places: to be called when they have moved.
    pub fn sort(&mut self, grains: &Grains) {
        self.schedule.sort(&self.templates, &grains.position);
    }

    /// Springs: the slip in `before` pulls the fluid in `field`. Returns the sum over all grains.
    pub fn pull(
        &mut self,
        grains: &Grains,
        before: &Faces,
        field: &mut Faces,
        density: f64,
        grip: impl Fn(usize) -> f64 + Sync,
    ) -> Tally {
        let per_mass = 1.0 / (density * self.cell_volume);
        let scene = scene(&self.stagger, &self.templates, &self.schedule, grains);
        with_kernel!(self.kernel, kernel => {
            scene.slip_and_push(kernel, before, grip, per_mass, field, &mut self.tallies);
        });
        self.add_up(grains)
    }

    /// Forcing: the slip in `field` is removed `sweeps` times. Returns the sum over all grains
    /// and sweeps, of the slip before each too.
    pub fn force(&mut self, grains: &Grains, field: &mut Faces, density: f64, sweeps: u32) -> Tally {
        let cell_mass = density * self.cell_volume;
        let scene = scene(&self.stagger, &self.templates, &self.schedule, grains);
        for g in &mut self.of_grain {
            *g = Tally::default();
        }
        let mut total = Tally::default();
        with_kernel!(self.kernel, kernel => {
            for _ in 0..sweeps {
                scene.slip(kernel, field, &mut self.slips, &mut self.tallies);
                scene.push(kernel, &self.slips, |_| cell_mass, 1.0 / cell_mass, field, &mut self.tallies);
                for (k, sum) in self.of_grain.iter_mut().enumerate() {
                    let t = scene.of_grain(k, &self.tallies);
                    *sum += t;
                    total += t;
                }
            }
        });
        total
    }

    /// Mean velocity in each body (`impulse`), its moment (`twist`) and the leak, into [`Self::of_grain`]; the sum.
    pub fn look(&mut self, grains: &Grains, field: &Faces) -> Tally {
        let scene = scene(&self.stagger, &self.templates, &self.schedule, grains);
        with_kernel!(self.kernel, kernel => {
            scene.enclosed(kernel, field, &mut self.slips, &mut self.tallies);
        });
        self.add_up(grains)
    }

    fn add_up(&mut self, grains: &Grains) -> Tally {
        let scene = scene(&self.stagger, &self.templates, &self.schedule, grains);
        let mut total = Tally::default();
        for (k, sum) in self.of_grain.iter_mut().enumerate() {
            *sum = scene.of_grain(k, &self.tallies);
            total += *sum;
        }
        total
    }
}

fn scene<'a>(
    stagger: &'a Stagger,
    templates: &'a Templates,
    schedule: &'a Schedule,
    grains: &'a Grains,
) -> Scene<'a> {
    Scene { stagger, templates, schedule, grains }
}

#[cfg(test)]
mod tests {
    use super::*;
    use brazilnut_base::{Side, vec3};

    /// Whatever the size, no slip is left larger by removing it: tracers that crowd must not remove it several times.
    #[test]
    fn sweeps_remove_the_slip_of_every_size() {
        let grid = Grid::new([16; 3], [1.0; 3], [Side::Walls; 3]);
        for r in (8..50).map(|k| 0.1 * f64::from(k)) {
            let mut grains = Grains::default();
            // On a face of the grid, where tracers near the centre have one number between them.
            grains.push(0, 0, r, 1.0, 1.0, vec3(8.0, 8.5, 8.5));
            let mut field = Faces::new(&grid);
            for c in 0..3 {
                // Noise, in which every way to slip is contained.
                let mut x = 0.3 + 0.1 * c as f64;
                for v in field.component_mut(c) {
                    x = 3.99 * x * (1.0 - x);
                    *v = x - 0.5;
                }
            }
            let mut work =
                TracerWork::new(&grid, Body::Sphere, &[r], Layout::Shells, 0.4, KernelName::Trilinear);
            work.sort(&grains);
            let mut slip = f64::INFINITY;
            for sweep in 0..12 {
                let left = work.force(&grains, &mut field, 1.0, 1).slip;
                assert!(left <= slip, "{r}, sweep {sweep}: {left} of {slip}");
                slip = left;
            }
        }
    }
}

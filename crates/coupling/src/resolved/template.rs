//! `particle-template`: covered points get the body's velocity (Clément 2009, 2.5.1).
//!
//! ```text
//! v* = u + w x r on faces inside the body                 before the projection
//! F_f = integral over the body of −grad P + eta laplacian v    (2.82), after it
//! ```
//!
//! The momentum that the imposition gives to the fluid, less what the enclosed
//! fluid keeps, is the same force by another way: a check that is reported.

use super::forcing::{Enclosed, load};
use super::sweep::Tally;
use crate::body::Body;
use crate::load::Load;
use brazilnut_base::{Side, Vec3};
use brazilnut_fluid::{CellField, Faces, Flow, Grid, Layout};
use brazilnut_grains::Grains;
use rayon::prelude::*;

/// The grid as bodies see it that cover its faces.
#[derive(Clone, Copy, Debug)]
pub struct Cover {
    cells: [isize; 3],
    spacing: Vec3,
    sides: [Side; 3],
    layout: Layout,
    order: [usize; 3],
    volume: f64,
}

/// What a body covers and feels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Felt {
    /// Integral of the stress divergence over covered faces, N, and its torque.
    pub stress: Load,
    /// Momentum of the fluid on covered faces.
    pub enclosed: Enclosed,
    /// Slip on covered faces after the step.
    pub slip: Tally,
}

impl Cover {
    /// For `grid`.
    #[must_use]
    pub fn new(grid: &Grid) -> Self {
        Self {
            cells: grid.cells.map(|n| n as isize),
            spacing: Vec3::from_array(grid.spacing),
            sides: grid.sides,
            layout: grid.layout(),
            order: grid.memory_order(),
            volume: grid.cell_volume(),
        }
    }

    /// Calls `f(place, arm, number)` for every run of free faces of `component` within `radius` (m) of `x` that are
    /// neighbours in memory, with the place and arm of the first.
    fn runs(&self, component: usize, x: Vec3, radius: f64, mut f: impl FnMut(usize, Vec3, usize)) {
        if self.sides[component] == Side::Flat {
            return;
        }
        let shift = |a: usize| if a == component { 0.0 } else { 0.5 };
        let range = |a: usize, half: f64| {
            if self.sides[a] == Side::Flat {
                return 0..=0;
            }
            let at = |edge: f64| edge / self.spacing[a] - shift(a);
            let (low, high) = (at(x[a] - half).ceil() as isize, at(x[a] + half).floor() as isize);
            match self.sides[a] {
                Side::Walls => low.max(isize::from(a == component))..=high.min(self.cells[a] - 1),
                _ => low..=high,
            }
        };
        let arm = |a: usize, i: isize| match self.sides[a] {
            Side::Flat => 0.0,
            _ => (i as f64 + shift(a)) * self.spacing[a] - x[a],
        };
        let place = |a: usize, i: isize| {
            let i = if self.sides[a] == Side::Periodic { i.rem_euclid(self.cells[a]) } else { i };
            i as usize * self.layout.stride[a]
        };
        let [line, middle, slow] = self.order;
        let mut r = Vec3::ZERO;
        for k in range(slow, radius) {
            r[slow] = arm(slow, k);
            let disc = (radius * radius - r[slow] * r[slow]).max(0.0);
            for j in range(middle, disc.sqrt()) {
                r[middle] = arm(middle, j);
                let row = self.layout.origin + place(slow, k) + place(middle, j);
                let (mut low, high) =
                    range(line, (disc - r[middle] * r[middle]).max(0.0).sqrt()).into_inner();
                while low <= high {
                    r[line] = arm(line, low);
                    // A run ends where a periodic side begins again.
                    let left = self.cells[line] - low.rem_euclid(self.cells[line]);
                    let number = (high + 1 - low).min(left);
                    f(row + place(line, low), r, number as usize);
                    low += number;
                }
            }
        }
    }

    /// Gives covered faces the velocity of their body; `given` gets the momentum exchanged, kg m/s,
    /// component by component.
    ///
    /// Where bodies overlap the last one wins: components go side by side, bodies one after another.
    pub fn impose(&self, grains: &Grains, density: f64, field: &mut Faces, given: &mut [Vec<Tally>; 3]) {
        let Faces { x, y, z } = field;
        let mut components = [&mut x.values, &mut y.values, &mut z.values];
        components.par_iter_mut().zip(given).enumerate().for_each(|(c, (values, given))| {
            for (g, given) in given.iter_mut().enumerate() {
                *given = self.impose_one(grains, g, c, density, values);
            }
        });
    }

    fn impose_one(&self, grains: &Grains, g: usize, c: usize, density: f64, values: &mut [f64]) -> Tally {
        let mass = density * self.volume;
        let (u, w) = (grains.velocity[g][c], grains.angular_velocity[g]);
        let mut sum = Moments::default();
        self.runs(c, grains.position[g], grains.radius[g], |place, arm, number| {
            let (first, step) = (u + w.cross(arm)[c], w.cross(self.along())[c]);
            let mut run = Moments { arm, ..Moments::default() };
            for (t, v) in values[place..place + number].iter_mut().enumerate() {
                let wanted = first + t as f64 * step;
                run.add(t, mass * (wanted - *v));
                *v = wanted;
            }
            sum.join(&run, self.along());
        });
        Tally {
            impulse: sum.total * Vec3::AXES[c],
            twist: sum.moment.cross(Vec3::AXES[c]),
            ..Tally::default()
        }
    }

    /// One spacing along the line axis, m.
    #[inline(always)]
    fn along(&self) -> Vec3 {
        let line = self.order[0];
        self.spacing[line] * Vec3::AXES[line]
    }

    /// Integrates the stress of `flow` over every body.
    pub fn feel(&self, grains: &Grains, flow: &Flow, density: f64, viscosity: f64, felt: &mut [Felt]) {
        // A block of grains per task: enough work to pay for the hand-over.
        felt.par_chunks_mut(64).enumerate().for_each(|(block, felt)| {
            for (k, felt) in felt.iter_mut().enumerate() {
                *felt = self.feel_one(grains, 64 * block + k, flow, density, viscosity);
            }
        });
    }

    fn feel_one(&self, grains: &Grains, g: usize, flow: &Flow, density: f64, viscosity: f64) -> Felt {
        let (u, w) = (grains.velocity[g], grains.angular_velocity[g]);
        let mut felt = Felt::default();
        for c in 0..3 {
            let v = flow.velocity.component(c);
            let (mut push, mut carried) = (Moments::default(), Moments::default());
            self.runs(c, grains.position[g], grains.radius[g], |place, arm, number| {
                let (first, step) = (u[c] + w.cross(arm)[c], w.cross(self.along())[c]);
                let mut run = [Moments { arm, ..Moments::default() }; 2];
                for t in 0..number {
                    run[0].add(t, self.stress(c, place + t, v, &flow.pressure, viscosity));
                    run[1].add(t, v[place + t]);
                    let wanted = first + t as f64 * step;
                    felt.slip.slip += (v[place + t] - wanted).abs();
                    felt.slip.speed += wanted.abs();
                }
                push.join(&run[0], self.along());
                carried.join(&run[1], self.along());
            });
            let axis = Vec3::AXES[c];
            felt.stress.force += self.volume * push.total * axis;
            felt.stress.torque += self.volume * push.moment.cross(axis);
            felt.enclosed.momentum += density * self.volume * carried.total * axis;
            felt.enclosed.angular += density * self.volume * carried.moment.cross(axis);
        }
        felt
    }

    /// −dP/dx_c + eta laplacian v_c, N/m³ (Clément eq. 2.82).
    #[inline]
    fn stress(&self, c: usize, place: usize, v: &[f64], pressure: &CellField, viscosity: f64) -> f64 {
        let stride = self.layout.stride;
        let slope = (pressure.values[place] - pressure.values[place - stride[c]]) / self.spacing[c];
        let mut laplacian = 0.0;
        for a in 0..3 {
            let (s, h) = (stride[a], self.spacing[a]);
            laplacian += (v[place + s] - 2.0 * v[place] + v[place - s]) / (h * h);
        }
        viscosity * laplacian - slope
    }
}

/// Sum of numbers and of their arms times them.
#[derive(Clone, Copy, Default)]
struct Moments {
    /// Arm of the first of a run.
    arm: Vec3,
    total: f64,
    /// Sum of place in the run times number.
    along: f64,
    moment: Vec3,
}

impl Moments {
    /// Adds the number at place `t` of a run.
    #[inline(always)]
    fn add(&mut self, t: usize, x: f64) {
        self.total += x;
        self.along += t as f64 * x;
    }

    /// Adds a run whose places are `step` (m) apart.
    #[inline(always)]
    fn join(&mut self, run: &Self, step: Vec3) {
        self.total += run.total;
        self.moment += run.total * run.arm + run.along * step;
    }
}

/// The same force from the momentum exchanged.
#[must_use]
pub fn exchanged(given: &Tally, before: &Enclosed, felt: &Felt, dt: f64) -> Load {
    load(given, before, &felt.enclosed, dt)
}

/// Volume of the faces of one component that a body covers over its own volume: how rough the template is.
#[must_use]
pub fn covered_volume(cover: &Cover, body: Body, x: Vec3, radius: f64, component: usize) -> f64 {
    let mut n = 0;
    cover.runs(component, x, radius, |_, _, number| n += number);
    n as f64 * cover.volume / body.volume(radius)
}

#[cfg(test)]
mod tests {
    use super::*;
    use brazilnut_base::vec3;

    fn grid(sides: [Side; 3]) -> Grid {
        Grid::new([16, if sides[1] == Side::Flat { 1 } else { 12 }, 14], [1.0, 1.1, 0.9], sides)
    }

    #[test]
    fn covers_the_volume_of_the_body() {
        let g = grid([Side::Periodic, Side::Walls, Side::Walls]);
        let flat = grid([Side::Walls, Side::Flat, Side::Walls]);
        // Places at all phases of the grid: the count of points is then that of an integral by midpoints.
        let shifts =
            |k: i32| vec3(0.1 * f64::from(k % 10), 0.11 * f64::from(k / 10 % 10), 0.09 * f64::from(k / 100));
        let mean = |g: &Grid, body: Body, c: usize| {
            let cover = Cover::new(g);
            let at = |k| vec3(7.5, 6.1, 5.9) + shifts(k);
            (0..1000).map(|k| covered_volume(&cover, body, at(k), 5.0, c)).sum::<f64>() / 1000.0
        };
        for c in 0..3 {
            // The midpoint rule with a tenth of a cell: 500 000 points, of which 30 000 at the surface.
            let v = mean(&g, Body::Sphere, c);
            assert!((v - 1.0).abs() < 1e-3, "component {c}: {v}");
        }
        let v = mean(&flat, Body::Cylinder { length: 1.1 }, 0);
        // 7900 points, of which 300 at the rim: counting error sqrt(300)/7900, twice.
        assert!((v - 1.0).abs() < 5e-3, "{v}");
    }

    #[test]
    fn imposes_rigid_motion_and_books_the_momentum() {
        let g = grid([Side::Periodic; 3]);
        let cover = Cover::new(&g);
        let mut grains = Grains::default();
        grains.push(0, 0, 3.0, 1.0, 1.0, vec3(0.2, 5.0, 13.9));
        grains.velocity[0] = vec3(1.0, -2.0, 0.5);
        grains.angular_velocity[0] = vec3(0.1, 0.2, -0.3);
        let mut field = Faces::new(&g);
        let mut given = [0, 1, 2].map(|_| vec![Tally::default()]);
        cover.impose(&grains, 2.0, &mut field, &mut given);
        for c in 0..3 {
            let sum: f64 = field.component(c).iter().sum();
            // Rounding of about 120 terms.
            assert!((2.0 * g.cell_volume() * sum - given[c][0].impulse[c]).abs() < 1e-10);
        }
        // Imposed again, nothing more is exchanged.
        cover.impose(&grains, 2.0, &mut field, &mut given);
        assert_eq!(given.map(|g| g[0].impulse), [Vec3::ZERO; 3]);
    }

    #[test]
    fn a_linear_pressure_pushes_with_the_covered_volume() {
        let g = grid([Side::Walls; 3]);
        let cover = Cover::new(&g);
        let mut flow = Flow::at_rest(&g);
        flow.pressure.fill_with(&g, |_, _, k| 7.0 * 0.9 * (k as f64 + 0.5));
        let mut grains = Grains::default();
        grains.push(0, 0, 3.0, 1.0, 1.0, vec3(8.0, 6.0, 6.0));
        let mut felt = [Felt::default()];
        cover.feel(&grains, &flow, 1.0, 1.0, &mut felt);
        let volume =
            covered_volume(&cover, Body::Sphere, grains.position[0], 3.0, 2) * Body::Sphere.volume(3.0);
        // Rounding.
        assert!((felt[0].stress.force.z + 7.0 * volume).abs() < 1e-9 * volume);
        assert!(felt[0].stress.force.x.abs() < 1e-9 * volume);
    }
}

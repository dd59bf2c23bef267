//! Fluid squeezed out of gaps that the grid does not resolve (Clément 2009, 2.8).
//!
//! ```text
//! F = −6 pi eta r*² (1/s − 1/s_max) ds/dt,   s_min <= s < s_max      (2.109-2.112)
//! ```
//!
//! From `s_max` on (a grid spacing) the grid does it; the part that it then
//! does is subtracted, so that the force starts at zero.

use crate::load::Load;
use brazilnut_base::{Cell, Side, Vec3};
use brazilnut_grains::Grains;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// Limits of the gap.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Lubrication {
    /// The gap below which the force no longer grows: roughness of the surfaces, m.
    pub min_gap: f64,
    /// The gap from which the grid resolves the film, m.
    pub max_gap: f64,
}

/// 6 pi eta r*² (1/s − 1/s_max), kg/s: force over approach speed (Clément eq. 2.111).
#[inline]
#[must_use]
pub fn film_resistance(viscosity: f64, effective_radius: f64, gap: f64, max_gap: f64) -> f64 {
    6.0 * PI * viscosity * effective_radius * effective_radius * (1.0 / gap - 1.0 / max_gap)
}

/// 1/r* = 1/r1 + 1/r2; a wall has infinite radius (Clément eq. 2.112).
#[inline]
#[must_use]
pub fn effective_radius(r1: f64, r2: f64) -> f64 {
    1.0 / (1.0 / r1 + 1.0 / r2)
}

/// A film between a grain and another grain or a wall.
#[derive(Clone, Copy, Debug)]
struct Film {
    first: u32,
    second: Option<u32>,
    /// From the second body to the first.
    normal: Vec3,
    resistance: f64,
}

/// The films of a cell, and buffers of their search.
#[derive(Clone, Debug)]
pub struct Films {
    law: Lubrication,
    viscosity: f64,
    cell: Cell,
    films: Vec<Film>,
    /// Velocity of each grain at the end of the step but for its films, m/s.
    ahead: Vec<Vec3>,
    /// Number of films of each grain.
    degree: Vec<u32>,
    starts: Vec<u32>,
    sorted: Vec<u32>,
}

impl Films {
    /// No films yet; in a fluid of `viscosity` (Pa s).
    #[must_use]
    pub fn new(law: Lubrication, viscosity: f64, cell: Cell) -> Self {
        let (films, ahead, degree, starts, sorted) = (vec![], vec![], vec![], vec![], vec![]);
        Self { law, viscosity, cell, films, ahead, degree, starts, sorted }
    }

    /// Number of films found last.
    #[must_use]
    pub fn count(&self) -> usize {
        self.films.len()
    }

    /// Adds the lubrication forces to `loads`, as means over a step of length `dt` (s). A grain's load takes up
    /// `share(k)` of a force, the rest being spent on its virtual mass.
    ///
    /// Each film is taken implicitly in the approach speed that the other loads leave, with the grains' masses shared
    /// among their films: stable for any gap, and the explicit force where the step resolves it. The speed before the step
    /// would not do: a film that stops a body would meet, one step late, the fluid's answer to the stop.
    pub fn add(&mut self, grains: &Grains, dt: f64, loads: &mut [Load], share: impl Fn(usize) -> f64) {
        self.find(grains);
        self.ahead.clear();
        let ahead = |k: usize| grains.velocity[k] + loads[k].force * (dt / grains.mass[k]);
        self.ahead.extend((0..grains.len()).map(ahead));
        for f in &self.films {
            let i = f.first as usize;
            let compliance = |k: usize| f64::from(self.degree[k]) * share(k) / grains.mass[k];
            let (v, c) = match f.second {
                Some(j) => {
                    let j = j as usize;
                    (self.ahead[i] - self.ahead[j], compliance(i) + compliance(j))
                }
                None => (self.ahead[i], compliance(i)),
            };
            let force = -f.resistance * v.dot(f.normal) / (1.0 + f.resistance * dt * c) * f.normal;
            loads[i].force += force * share(i);
            if let Some(j) = f.second {
                loads[j as usize].force -= force * share(j as usize);
            }
        }
    }

    /// All films, in the order of identities.
    fn find(&mut self, grains: &Grains) {
        let (law, viscosity, cell) = (self.law, self.viscosity, self.cell);
        let n = grains.len();
        self.films.clear();
        self.degree.clear();
        self.degree.resize(n, 0);
        let largest = grains.radius.iter().copied().fold(0.0, f64::max);
        let bins = Bins::new(&cell, 2.0 * largest + law.max_gap);
        self.sort(&bins, grains);
        for i in 0..n {
            let (x, r) = (grains.position[i], grains.radius[i]);
            bins.around(x, |bin| {
                for &j in &self.sorted[self.starts[bin] as usize..self.starts[bin + 1] as usize] {
                    if j as usize <= i {
                        continue;
                    }
                    let d = cell.nearest(x - grains.position[j as usize]);
                    let (length, other) = (d.length(), grains.radius[j as usize]);
                    let gap = length - r - other;
                    if gap < law.max_gap && length > 0.0 {
                        let resistance = film_resistance(
                            viscosity,
                            effective_radius(r, other),
                            gap.max(law.min_gap),
                            law.max_gap,
                        );
                        self.films.push(Film {
                            first: i as u32,
                            second: Some(j),
                            normal: d / length,
                            resistance,
                        });
                    }
                }
            });
            for axis in 0..3 {
                if cell.sides[axis] != Side::Walls {
                    continue;
                }
                for (gap, sign) in [(x[axis] - r, 1.0), (cell.size[axis] - x[axis] - r, -1.0)] {
                    if gap < law.max_gap {
                        let resistance = film_resistance(viscosity, r, gap.max(law.min_gap), law.max_gap);
                        let normal = sign * Vec3::AXES[axis];
                        self.films.push(Film { first: i as u32, second: None, normal, resistance });
                    }
                }
            }
        }
        for f in &self.films {
            self.degree[f.first as usize] += 1;
            if let Some(j) = f.second {
                self.degree[j as usize] += 1;
            }
        }
    }

    /// Grains by bin, in the order of identity within each.
    fn sort(&mut self, bins: &Bins, grains: &Grains) {
        self.starts.clear();
        self.starts.resize(bins.count() + 1, 0);
        self.sorted.clear();
        self.sorted.resize(grains.len(), 0);
        for x in &grains.position {
            self.starts[bins.of(*x) + 1] += 1;
        }
        for b in 0..bins.count() {
            self.starts[b + 1] += self.starts[b];
        }
        for (k, x) in grains.position.iter().enumerate().rev() {
            // Filled from the back of each bin, whose start is then restored.
            let b = bins.of(*x);
            self.starts[b + 1] -= 1;
            self.sorted[self.starts[b + 1] as usize] = k as u32;
        }
        // Every end has moved down to its bin's start: shift them back.
        for b in 0..bins.count() {
            self.starts[b] = self.starts[b + 1];
        }
        self.starts[bins.count()] = grains.len() as u32;
    }
}

/// Equal bins no smaller than the reach of a pair.
#[derive(Clone, Copy, Debug)]
struct Bins {
    n: [isize; 3],
    per_edge: Vec3,
    sides: [Side; 3],
}

impl Bins {
    fn new(cell: &Cell, reach: f64) -> Self {
        let n = [0, 1, 2].map(|a| match cell.sides[a] {
            Side::Flat => 1,
            _ => ((cell.size[a] / reach) as isize).max(1),
        });
        Self { n, per_edge: Vec3::from_array(n.map(|n| n as f64)) / cell.size, sides: cell.sides }
    }

    fn count(&self) -> usize {
        self.n.iter().product::<isize>() as usize
    }

    fn coordinate(&self, axis: usize, x: f64) -> isize {
        ((x * self.per_edge[axis]).floor() as isize).clamp(0, self.n[axis] - 1)
    }

    fn index(&self, i: [isize; 3]) -> usize {
        (i[0] + self.n[0] * (i[1] + self.n[1] * i[2])) as usize
    }

    fn of(&self, x: Vec3) -> usize {
        self.index([0, 1, 2].map(|a| self.coordinate(a, x[a])))
    }

    /// Calls `f` once for every bin that may hold a partner of a grain at `x`.
    fn around(&self, x: Vec3, mut f: impl FnMut(usize)) {
        let range = |a: usize| {
            let (c, n) = (self.coordinate(a, x[a]), self.n[a]);
            // With fewer than three bins a neighbour would come up twice.
            if n <= 3 && self.sides[a] == Side::Periodic { (0, n - 1) } else { (c - 1, c + 1) }
        };
        let [x0, y0, z0] = [range(0), range(1), range(2)];
        for k in z0.0..=z0.1 {
            for j in y0.0..=y0.1 {
                for i in x0.0..=x0.1 {
                    let mut at = [i, j, k];
                    let mut inside = true;
                    for a in 0..3 {
                        match self.sides[a] {
                            Side::Periodic => at[a] = at[a].rem_euclid(self.n[a]),
                            _ => inside &= at[a] >= 0 && at[a] < self.n[a],
                        }
                    }
                    if inside {
                        f(self.index(at));
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use brazilnut_base::vec3;

    const LAW: Lubrication = Lubrication { min_gap: 1e-6, max_gap: 1e-4 };

    fn cell() -> Cell {
        Cell { size: vec3(5e-3, 5e-3, 5e-3), sides: [Side::Periodic, Side::Periodic, Side::Walls] }
    }

    fn grain(grains: &mut Grains, x: Vec3, v: Vec3) {
        grains.push(0, 0, 0.5e-3, 1e-3, 1e-10, x);
        let k = grains.len() - 1;
        grains.velocity[k] = v;
    }

    fn films(viscosity: f64) -> Films {
        Films::new(LAW, viscosity, cell())
    }

    #[test]
    fn hand_value_between_two_spheres() {
        // r* = 0.25 mm, s = 10 um: 6 pi 1e-3 6.25e-8 (1e5 - 1e4) = 1.0603e-4 kg/s, at 0.2 m/s: 2.1206e-5 N.
        let mut g = Grains::default();
        grain(&mut g, vec3(1e-3, 2e-3, 2e-3), vec3(0.1, 0.0, 0.0));
        grain(&mut g, vec3(2.01e-3, 2e-3, 2e-3), vec3(-0.1, 5.0, 0.0));
        let mut loads = vec![Load::default(); 2];
        // A step so short that the implicit part does not count (1e-9 of the force).
        films(1e-3).add(&g, 1e-11, &mut loads, |_| 1.0);
        assert!((loads[0].force.x / -2.1206e-5 - 1.0).abs() < 1e-4, "{}", loads[0].force);
        assert_eq!(loads[0].force, -loads[1].force, "equal and opposite");
        assert_eq!(loads[0].force.y, 0.0, "only along the line of centres");
    }

    /// Zero from `max_gap` on, 1/s − 1/s_max within, the value at `min_gap` below it (Clément eq. 2.109-2.112).
    #[test]
    fn the_force_keeps_to_its_cut_offs() {
        let force = |gap: f64| {
            let mut g = Grains::default();
            grain(&mut g, vec3(1e-3, 2e-3, 2e-3), vec3(0.2, 0.0, 0.0));
            grain(&mut g, vec3(2e-3 + gap, 2e-3, 2e-3), Vec3::ZERO);
            let mut loads = vec![Load::default(); 2];
            films(1e-3).add(&g, 1e-11, &mut loads, |_| 1.0);
            -loads[0].force.x
        };
        assert_eq!(force(1.0001 * LAW.max_gap), 0.0);
        // Continuous at the upper cut-off: 1/s − 1/s_max there is a millionth of its value at a tenth of the gap.
        assert!(force(LAW.max_gap * (1.0 - 1e-6)) < 2e-7 * force(0.1 * LAW.max_gap));
        let ratio = force(5e-6) / force(2e-5);
        // (2e5 − 1e4)/(5e4 − 1e4); rounding of positions, 1e-16 m in 5e-6 m, and the implicit part, 1e-8.
        assert!((ratio / 4.75 - 1.0).abs() < 1e-7, "{ratio}");
        let floor = force(LAW.min_gap);
        for gap in [0.5 * LAW.min_gap, 0.0, -2e-6] {
            assert!((force(gap) / floor - 1.0).abs() < 1e-7, "no growth below the roughness, nor in contact");
        }
    }

    #[test]
    fn walls_and_images_count() {
        let mut g = Grains::default();
        grain(&mut g, vec3(0.2e-3, 2e-3, 0.51e-3), vec3(0.0, 0.0, -0.1));
        grain(&mut g, vec3(4.25e-3, 2e-3, 0.55e-3), vec3(0.0, 0.0, 0.0));
        let mut films = films(1e-3);
        let mut loads = vec![Load::default(); 2];
        films.add(&g, 1e-9, &mut loads, |_| 1.0);
        // Each grain and the floor, and the pair across the periodic side.
        assert_eq!(films.count(), 3);
        assert!(loads[0].force.z > 0.0);
    }

    #[test]
    fn a_tight_film_stops_the_approach_and_never_reverses_it() {
        let mut g = Grains::default();
        let (c, d) = (2.5e-3, 1e-3 + 1e-9);
        grain(&mut g, vec3(c, c, c), Vec3::ZERO);
        for (axis, sign) in [(0, 1.0), (0, -1.0), (1, 1.0), (1, -1.0), (2, 1.0), (2, -1.0)] {
            let n = sign * Vec3::AXES[axis];
            grain(&mut g, Vec3::splat(c) + d * n, -0.1 * n);
        }
        let dt = 1.0;
        let mut loads = vec![Load::default(); 7];
        films(1.0).add(&g, dt, &mut loads, |_| 1.0);
        for k in 1..7 {
            let v = g.velocity[k] + dt * loads[k].force / g.mass[k];
            let n = -g.velocity[k].normalize();
            // Between half stopped (mass shared with the partner's six films) and at rest.
            assert!(-v.dot(n) >= 0.0 && -v.dot(n) < 0.1, "grain {k}: {v}");
        }
    }

    /// Against all pairs.
    #[test]
    fn finds_the_films_that_all_pairs_have() {
        let cell = cell();
        let mut g = Grains::default();
        for k in 0..120 {
            let t = f64::from(k);
            let u = vec3((t * 0.754_877).fract(), (t * 0.569_840).fract(), (t * 0.318_329).fract());
            grain(&mut g, cell.size * u, Vec3::ZERO);
            g.radius[k as usize] = 1e-4 * (1.0 + (t * 0.41).fract());
        }
        let mut films = films(1.0);
        films.find(&g);
        let mut expected = 0;
        for i in 0..g.len() {
            for j in i + 1..g.len() {
                let d = cell.nearest(g.position[i] - g.position[j]).length();
                expected += usize::from(d - g.radius[i] - g.radius[j] < LAW.max_gap);
            }
            let (z, r) = (g.position[i].z, g.radius[i]);
            expected += usize::from(z - r < LAW.max_gap) + usize::from(cell.size.z - z - r < LAW.max_gap);
        }
        assert_eq!(films.count(), expected);
    }
}

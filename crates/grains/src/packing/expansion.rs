//! Radius expansion (Lan 2.2): random points grow into grains and push each other apart.

use super::draft::Draft;
use super::insertion::point;
use super::occupancy::Occupancy;
use super::{Filling, PackingError, Region};
use crate::Grains;
use brazilnut_base::Vec3;
use brazilnut_base::random::stream;

/// Growth per round over the final radius.
const GROWTH: f64 = 0.02;

/// Rounds after which the sum of overlaps must have fallen by a twentieth, or the cell counts as jammed.
const PATIENCE: usize = 200;

/// Pairs are pushed this much further apart than touching, over the radii's sum: then a round can end
/// without any overlap, which pushing to exact contact would only approach.
const EXCESS: f64 = 1e-4;

/// Distance over the mean radius up to which pairs are listed; the list is renewed when half of it is used up.
const SKIN: f64 = 0.6;

/// Random places for all open grains, then growth and relaxation until all have their size without overlap.
///
/// Lan lets the growing grains collide as in the simulation proper; here they are moved apart without
/// inertia, which leaves them at rest.
pub(super) fn expansion(filling: &Filling) -> Result<Grains, PackingError> {
    let mut draft = Draft::new(filling)?;
    let open = draft.open.clone();
    let mut bounds = vec![None; draft.grains.len()];
    for &k in &open {
        let b = draft.bounds(k)?;
        let mut random = stream(filling.seed, "placement", k as u64);
        draft.grains.position[k] = point(&mut random, filling, &b);
        bounds[k] = Some(b);
    }
    let target = draft.grains.radius.clone();
    let mut state =
        Growing { filling, target, radius: vec![], position: draft.grains.position.clone(), bounds };
    state.radius = state.allowable();
    if state.run() {
        draft.grains.position = state.position.iter().map(|&x| filling.cell.wrap(x).0).collect();
        return Ok(draft.grains);
    }
    let touched = state.overlapping();
    let left: Vec<usize> = open.into_iter().filter(|&k| touched[k]).collect();
    Err(draft.does_not_fit(
        "expansion",
        &left,
        "random beds jam near solids fraction 0.64 (0.84 in a flat cell): use a larger cell or fewer grains",
    ))
}

struct Growing<'a> {
    filling: &'a Filling,
    target: Vec<f64>,
    radius: Vec<f64>,
    position: Vec<Vec3>,
    /// Where the centre may be; none for grains placed by hand, which stand still.
    bounds: Vec<Option<Region>>,
}

impl Growing<'_> {
    /// Grows and relaxes; false if the grains jam.
    fn run(&mut self) -> bool {
        let mean = self.target.iter().sum::<f64>() / self.target.len().max(1) as f64;
        let (mut pairs, mut listed) = (vec![], vec![]);
        let mut least = f64::INFINITY;
        for round in 1.. {
            let mut full = true;
            for (r, &target) in self.radius.iter_mut().zip(&self.target) {
                full &= *r >= target;
                *r = (*r + GROWTH * target).min(target);
            }
            let moved = |(a, b): (&Vec3, &Vec3)| self.filling.cell.nearest(*a - *b).length();
            let drift = self.position.iter().zip(&listed).map(moved).fold(0.0, f64::max);
            if listed.is_empty() || drift > 0.5 * SKIN * mean {
                pairs = self.pairs(SKIN * mean);
                listed.clone_from(&self.position);
            }
            let overlap = self.push_apart(&pairs);
            // The list is complete only if nothing moved farther than its skin within the round.
            if full && overlap == 0.0 && !self.overlapping().contains(&true) {
                return true;
            }
            if full && round % PATIENCE == 0 {
                if overlap > 0.95 * least {
                    break;
                }
                least = overlap;
            }
        }
        false
    }

    /// Pairs that overlap or come within `skin` at full size, each once.
    fn pairs(&self, skin: f64) -> Vec<[u32; 2]> {
        let mut near = Occupancy::new(&self.filling.cell, &self.target);
        let mut pairs = vec![];
        for (k, &x) in self.position.iter().enumerate() {
            let r = self.target[k] + 0.5 * skin;
            let mut found = vec![];
            near.near(x, r, |j| {
                let reach = r + self.target[j] + 0.5 * skin;
                if self.filling.cell.nearest(x - self.position[j]).length_squared() < reach * reach {
                    found.push([j as u32, k as u32]);
                }
            });
            found.sort_unstable();
            found.dedup();
            pairs.extend(found);
            near.insert(k, x, r);
        }
        pairs
    }

    /// One round over the pairs in their order; the sum of the overlaps it met, m.
    fn push_apart(&mut self, pairs: &[[u32; 2]]) -> f64 {
        let mut overlap = 0.0;
        for &[a, b] in pairs {
            let (a, b) = (a as usize, b as usize);
            let share = match (self.bounds[a].is_some(), self.bounds[b].is_some()) {
                (true, true) => 0.5,
                (true, false) => 1.0,
                (false, true) => 0.0,
                (false, false) => continue,
            };
            let d = self.filling.cell.nearest(self.position[a] - self.position[b]);
            let (distance, touch) = (d.length(), self.radius[a] + self.radius[b]);
            if distance >= touch {
                continue;
            }
            overlap += touch - distance;
            // Two grains at one point part along any direction that the cell has.
            let away = if distance > 0.0 { d / distance } else { Vec3::X };
            let push = away * (touch * (1.0 + EXCESS) - distance);
            self.shift(a, push * share);
            self.shift(b, -push * (1.0 - share));
        }
        for k in 0..self.position.len() {
            overlap += self.leave_solids(k);
        }
        overlap
    }

    /// Moves grain `k` as far as its bounds allow.
    fn shift(&mut self, k: usize, by: Vec3) {
        let Some(b) = self.bounds[k] else { return };
        let cell = &self.filling.cell;
        let mut x = self.position[k] + by;
        for axis in 0..3 {
            let free = cell.is_periodic(axis) && b.low[axis] <= 0.0 && b.high[axis] >= cell.size[axis];
            if !free {
                x[axis] = x[axis].clamp(b.low[axis], b.high[axis]);
            }
        }
        self.position[k] = x;
    }

    /// Pushes grain `k` out of inner walls; how deep it was in, m.
    fn leave_solids(&mut self, k: usize) -> f64 {
        let mut depth = 0.0;
        for s in &self.filling.solids {
            let (x, r) = (self.position[k], self.radius[k]);
            let d = x - x.clamp(s.low, s.high);
            let distance = d.length();
            if distance >= r || self.bounds[k].is_none() {
                continue;
            }
            depth += r - distance;
            let push = if distance > 0.0 {
                d / distance * (r * (1.0 + EXCESS) - distance)
            } else {
                nearest_face(s, x, r)
            };
            self.shift(k, push);
        }
        depth
    }

    /// Radii to start from: the distance to the nearest neighbour shared by target radius (Lan 2.2).
    fn allowable(&self) -> Vec<f64> {
        let near = self.pairs(0.0);
        let mut radius = self.target.clone();
        for [a, b] in near {
            let (a, b) = (a as usize, b as usize);
            let distance = self.filling.cell.nearest(self.position[a] - self.position[b]).length();
            let scale = distance / (self.target[a] + self.target[b]);
            for k in [a, b] {
                if self.bounds[k].is_some() {
                    radius[k] = radius[k].min(self.target[k] * scale);
                }
            }
        }
        radius
    }

    /// Which grains overlap another or an inner wall at their present size.
    fn overlapping(&self) -> Vec<bool> {
        let mut touched = vec![false; self.position.len()];
        for [a, b] in self.pairs(0.0) {
            let (a, b) = (a as usize, b as usize);
            let distance = self.filling.cell.nearest(self.position[a] - self.position[b]).length();
            if distance < self.radius[a] + self.radius[b] {
                (touched[a], touched[b]) = (true, true);
            }
        }
        for (k, x) in self.position.iter().enumerate() {
            touched[k] |=
                self.filling.solids.iter().any(|s| (*x - x.clamp(s.low, s.high)).length() < self.radius[k]);
        }
        touched
    }
}

/// The way out through the nearest face for a sphere of radius `r` whose centre is inside `solid`.
fn nearest_face(solid: &Region, x: Vec3, r: f64) -> Vec3 {
    let (mut best, mut push) = (f64::INFINITY, Vec3::ZERO);
    for axis in 0..3 {
        for (depth, sign) in [(x[axis] - solid.low[axis], -1.0), (solid.high[axis] - x[axis], 1.0)] {
            if depth < best {
                best = depth;
                push = Vec3::ZERO;
                push[axis] = sign * (depth + r * (1.0 + EXCESS));
            }
        }
    }
    push
}

//! Which grains are near a point: cells that list every grain whose box reaches into them, so that
//! a grain of any size costs what its own box covers.

use brazilnut_base::{Cell, Vec3};
use std::ops::RangeInclusive;

const END: u32 = u32::MAX;

/// Linked cells over the bounding boxes of the grains placed so far.
pub(super) struct Occupancy {
    cell: Cell,
    count: [i64; 3],
    width: [f64; 3],
    head: Vec<u32>,
    /// Grain and next entry.
    entries: Vec<[u32; 2]>,
}

impl Occupancy {
    /// Empty, with cells as wide as the mean grain of `radii`.
    pub(super) fn new(cell: &Cell, radii: &[f64]) -> Self {
        let n = radii.len().max(1) as f64;
        let mut edge = 2.0 * radii.iter().sum::<f64>() / n;
        // A few cells per grain at most: in an empty box more would only cost memory.
        let volume = |edge: f64| (0..3).map(|a| (cell.size[a] / edge).max(1.0)).product::<f64>();
        while volume(edge) > 8.0 * n + 64.0 {
            edge *= 1.25;
        }
        let count = std::array::from_fn(|a| ((cell.size[a] / edge).floor() as i64).max(1));
        let width = std::array::from_fn(|a| cell.size[a] / count[a] as f64);
        let total = (count[0] * count[1] * count[2]) as usize;
        Self { cell: *cell, count, width, head: vec![END; total], entries: vec![] }
    }

    /// Adds grain `k`.
    pub(super) fn insert(&mut self, k: usize, x: Vec3, r: f64) {
        let [xs, ys, zs] = self.reach(x, r);
        for i in xs {
            for j in ys.clone() {
                for l in zs.clone() {
                    let c = self.slot([i, j, l]);
                    self.entries.push([k as u32, self.head[c]]);
                    self.head[c] = (self.entries.len() - 1) as u32;
                }
            }
        }
    }

    /// Calls `visit` with every grain that may touch a sphere of radius `r` at `x`; some more than once.
    pub(super) fn near(&self, x: Vec3, r: f64, mut visit: impl FnMut(usize)) {
        let [xs, ys, zs] = self.reach(x, r);
        for i in xs {
            for j in ys.clone() {
                for l in zs.clone() {
                    let mut e = self.head[self.slot([i, j, l])];
                    while e != END {
                        let [k, next] = self.entries[e as usize];
                        visit(k as usize);
                        e = next;
                    }
                }
            }
        }
    }

    /// Indices of the cells that the box of a sphere covers; periodic ones unwrapped, others cut at the ends.
    fn reach(&self, x: Vec3, r: f64) -> [RangeInclusive<i64>; 3] {
        std::array::from_fn(|a| {
            let low = ((x[a] - r) / self.width[a]).floor() as i64;
            let high = ((x[a] + r) / self.width[a]).floor() as i64;
            if self.cell.is_periodic(a) {
                low..=high.min(low + self.count[a] - 1)
            } else {
                let last = self.count[a] - 1;
                low.clamp(0, last)..=high.clamp(0, last)
            }
        })
    }

    fn slot(&self, i: [i64; 3]) -> usize {
        let [x, y, z]: [i64; 3] = std::array::from_fn(|a| i[a].rem_euclid(self.count[a]));
        ((z * self.count[1] + y) * self.count[0] + x) as usize
    }
}

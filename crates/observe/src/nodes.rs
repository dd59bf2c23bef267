//! Which cells of the fluid's grid lie inside grains.

use crate::view::{FlowView, View};
use brazilnut_base::Vec3;

/// The cells of a regular grid, and whether a grain covers their centres.
///
/// In a resolved coupling the cells inside grains count as grains, the others
/// as fluid (Clément 2009, 4.4, Figs 4.8, 4.9).
pub struct Nodes<'a> {
    flow: &'a dyn FlowView,
    covered: Vec<bool>,
}

impl<'a> Nodes<'a> {
    /// Marks the cells of `flow`; none are covered where the coupling averages over grains.
    #[must_use]
    pub fn new(view: &View, flow: &'a dyn FlowView) -> Self {
        let shape = flow.shape();
        let mut nodes = Self { flow, covered: vec![false; shape[0] * shape[1] * shape[2]] };
        if flow.is_resolved() {
            let first = flow.centre([0, 0, 0]);
            let spacing = Vec3::from_array([0, 1, 2].map(|a| spacing(flow, a, view.cell.size[a])));
            for k in 0..view.grains.len() {
                nodes.cover(view, first, spacing, view.grains.position[k], view.grains.radius[k]);
            }
        }
        nodes
    }

    fn cover(&mut self, view: &View, first: Vec3, spacing: Vec3, at: Vec3, r: f64) {
        let shape = self.flow.shape();
        let range = |a: usize| {
            let lo = ((at[a] - r - first[a]) / spacing[a]).ceil() as i64;
            let hi = ((at[a] + r - first[a]) / spacing[a]).floor() as i64;
            if shape[a] == 1 { 0..=0 } else { lo..=hi }
        };
        let place = |a: usize, k: i64| {
            let n = shape[a] as i64;
            if view.cell.is_periodic(a) { Some(k.rem_euclid(n)) } else { (0..n).contains(&k).then_some(k) }
        };
        let square = |a: usize, k: i64| {
            if shape[a] == 1 { 0.0 } else { (first[a] + k as f64 * spacing[a] - at[a]).powi(2) }
        };
        for z in range(2) {
            for y in range(1) {
                for x in range(0) {
                    if square(0, x) + square(1, y) + square(2, z) < r * r
                        && let (Some(i), Some(j), Some(k)) = (place(0, x), place(1, y), place(2, z))
                    {
                        self.covered[i as usize + shape[0] * (j as usize + shape[1] * k as usize)] = true;
                    }
                }
            }
        }
    }

    /// Calls `f` with every cell, its centre, and whether a grain covers it.
    pub fn each(&self, mut f: impl FnMut([usize; 3], Vec3, bool)) {
        let [nx, ny, nz] = self.flow.shape();
        for k in 0..nz {
            for j in 0..ny {
                for i in 0..nx {
                    f([i, j, k], self.flow.centre([i, j, k]), self.covered[i + nx * (j + ny * k)]);
                }
            }
        }
    }
}

/// Distance of neighbouring cells along `axis`, m.
pub fn spacing(flow: &dyn FlowView, axis: usize, size: f64) -> f64 {
    if flow.shape()[axis] < 2 {
        return size;
    }
    let mut next = [0; 3];
    next[axis] = 1;
    flow.centre(next)[axis] - flow.centre([0; 3])[axis]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthetic::{Stage, Uniform};
    use brazilnut_base::vec3;

    #[test]
    fn covered_cells_fill_the_volume_of_the_grains() {
        let mut stage = Stage::new(vec3(1.0, 1.0, 1.0), "periodic");
        // One grain through a periodic side.
        stage.add(vec3(0.02, 0.5, 0.5), 0.2);
        let flow = Uniform {
            cells: [60; 3],
            size: stage.cell.size,
            velocity: Vec3::ZERO,
            slope: 0.0,
            porosity: 1.0,
            resolved: true,
        };
        let nodes = Nodes::new(&stage.view(), &flow);
        let (mut count, mut wrong) = (0, 0);
        nodes.each(|_, at, covered| {
            count += i32::from(covered);
            let d = stage.cell.nearest(at - stage.grains.position[0]).length();
            wrong += i32::from(covered != (d < 0.2));
        });
        assert_eq!(wrong, 0);
        let volume = f64::from(count) / 60_f64.powi(3);
        // Counting cells: a part of a surface layer of one spacing, 1 % here.
        assert!((volume / (4.0 / 3.0 * std::f64::consts::PI * 0.008) - 1.0).abs() < 0.01, "{volume}");
    }
}

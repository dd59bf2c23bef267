//! Fluid and grains in the plane through the middle of the cell.

use brazilnut_base::figure::{Axis, Body, Figure, Raster};
use brazilnut_base::{Cell, Vec3};
use brazilnut_grains::Grains;
use brazilnut_observe::FlowView;
use std::f64::consts::TAU;

/// Arrows of the fluid along the longer edge of the plane.
const ARROWS: usize = 32;
/// Shades along the longer edge.
const SHADES: usize = 128;
/// Corners of the outline of a grain.
const CORNERS: usize = 24;

/// The vertical plane through the middle of a cell, shown up to a height.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plane {
    /// Axis along the plane, and the one that it cuts.
    along: usize,
    across: usize,
    /// Place on the axis that it cuts, m.
    at: f64,
    /// Extent along the plane and upwards, m.
    size: [f64; 2],
}

impl Plane {
    /// The plane that shows most: along x unless x is flat, up to `top` (m).
    pub fn of(cell: &Cell, top: f64) -> Self {
        let along = usize::from(cell.flat_axis() == Some(0));
        let across = 1 - along;
        Self { along, across, at: 0.5 * cell.size[across], size: [cell.size[along], top.min(cell.size.z)] }
    }

    /// The point of space at `x` along the plane and height `z`, m.
    pub fn point(&self, x: f64, z: f64) -> Vec3 {
        let mut p = Vec3::Z * z;
        p[self.along] = x;
        p[self.across] = self.at;
        p
    }

    /// Components of a vector in the plane.
    fn components(&self, v: Vec3) -> [f64; 2] {
        [v[self.along], v.z]
    }

    /// Grains cut by the plane: index and radius of the cut, m.
    fn cut<'a>(&'a self, grains: &'a Grains) -> impl Iterator<Item = (usize, f64)> + 'a {
        (0..grains.len()).filter_map(|k| {
            let off = grains.position[k][self.across] - self.at;
            let r = grains.radius[k];
            (off.abs() < r && grains.position[k].z < self.size[1]).then(|| (k, (r * r - off * off).sqrt()))
        })
    }

    /// True for what lies at or behind the plane, seen from the front.
    pub fn is_behind(&self, r: Vec3) -> bool {
        // The camera looks along +y at a plane along x, along -x at one along y.
        if self.along == 0 { r.y >= self.at } else { r.x <= self.at }
    }

    /// Even points of the plane, about `count` along its longer edge, no closer than cells of the grid.
    fn points(&self, flow: &dyn FlowView, count: usize) -> ([usize; 2], [f64; 2]) {
        let longest = self.size[0].max(self.size[1]);
        let shape = [0, 1].map(|k| {
            let cells = flow.shape()[[self.along, 2][k]];
            ((count as f64 * self.size[k] / longest).round() as usize).clamp(1, cells.max(4))
        });
        (shape, [0, 1].map(|k| self.size[k] / shape[k] as f64))
    }

    /// Places and velocities of the fluid between the grains, m and m/s.
    pub fn fluid(&self, grains: &Grains, flow: &dyn FlowView) -> Vec<(Vec3, Vec3)> {
        let ([n, m], [dx, dz]) = self.points(flow, ARROWS);
        let discs: Vec<(Vec3, f64)> = self.cut(grains).map(|(k, r)| (grains.position[k], r)).collect();
        let covered = |p: Vec3| {
            discs.iter().any(|(c, r)| {
                let [x, z] = self.components(p - *c);
                x * x + z * z < r * r
            })
        };
        (0..n * m)
            .map(|k| self.point(((k % n) as f64 + 0.5) * dx, ((k / n) as f64 + 0.5) * dz))
            .filter(|p| !(flow.is_resolved() && covered(*p)))
            .map(|p| (p, flow.velocity(p)))
            .collect()
    }

    /// Fluid and grains side by side, with the outlines of the grains that the plane cuts.
    pub fn figures(&self, grains: &Grains, flow: &dyn FlowView, caption: &str) -> Vec<Figure> {
        let outline = |(k, r): (usize, f64)| {
            let [x, z] = self.components(grains.position[k]);
            let corner = |c: usize| {
                let (s, c) = (TAU * c as f64 / CORNERS as f64).sin_cos();
                [x + r * c, z + r * s]
            };
            (0..=CORNERS).map(corner).collect()
        };
        let mut lines: Vec<Vec<[f64; 2]>> = self.cut(grains).map(outline).collect();
        // The frame of what is shown, so that both maps have the same scale.
        let [w, h] = self.size;
        lines.push(vec![[0.0, 0.0], [w, 0.0], [w, h], [0.0, h], [0.0, 0.0]]);
        let ([n, m], [dx, dz]) = self.points(flow, SHADES);
        let speed = |k: usize| {
            let p = self.point(((k % n) as f64 + 0.5) * dx, ((k / n) as f64 + 0.5) * dz);
            let [u, w] = self.components(flow.velocity(p));
            u.hypot(w)
        };
        let raster = Raster {
            shape: [n, m],
            extent: [0.0, self.size[0], 0.0, self.size[1]],
            values: (0..n * m).map(speed).collect(),
            label: "speed of the fluid".into(),
            unit: "m/s".into(),
        };
        let arrow = |r: Vec3, v: Vec3| (self.components(r), self.components(v));
        let fluid = self.fluid(grains, flow).into_iter().map(|(r, v)| arrow(r, v)).collect();
        let moving = self.cut(grains).map(|(k, _)| arrow(grains.position[k], grains.velocity[k])).collect();
        let figure = |title: &str, raster, arrows| Figure {
            title: title.into(),
            caption: format!(
                "{caption}. Vertical plane through the middle of the cell, velocities in its frame; outlines: the grains it cuts."
            ),
            body: Body::Map {
                x: Axis::linear(["x", "y"][self.along], "m"),
                y: Axis::linear("z", "m"),
                raster,
                arrows,
                arrow_unit: "m/s".into(),
                lines: lines.clone(),
            },
        };
        vec![figure("Fluid", Some(raster), fluid), figure("Grains", None, moving)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use brazilnut_base::{Side, vec3};
    use brazilnut_observe::FlowBalance;

    /// Solid rotation about y on 10 by 10 by 10 cells of a box of edge 1.
    struct Turning;

    impl FlowView for Turning {
        fn velocity(&self, at: Vec3) -> Vec3 {
            vec3(at.z - 0.5, 7.0, 0.5 - at.x)
        }
        fn pressure(&self, _: Vec3) -> f64 {
            0.0
        }
        fn porosity(&self, _: Vec3) -> f64 {
            1.0
        }
        fn is_resolved(&self) -> bool {
            true
        }
        fn shape(&self) -> [usize; 3] {
            [10; 3]
        }
        fn centre(&self, cell: [usize; 3]) -> Vec3 {
            Vec3::from_array(cell.map(|i| 0.1 * (i as f64 + 0.5)))
        }
        fn balance(&self, _: f64) -> FlowBalance {
            FlowBalance::default()
        }
    }

    #[test]
    fn arrows_stand_in_the_plane_and_outside_its_grains() {
        let cell = Cell { size: Vec3::ONE, sides: [Side::Walls; 3] };
        let plane = Plane::of(&cell, 1.0);
        let mut grains = Grains::default();
        grains.push(0, 0, 0.2, 1.0, 1.0, vec3(0.5, 0.6, 0.5));
        grains.push(0, 0, 0.2, 1.0, 1.0, vec3(0.5, 0.8, 0.5));
        let figures = plane.figures(&grains, &Turning, "now");
        let [Body::Map { arrows, lines, .. }, Body::Map { arrows: moving, .. }] =
            [&figures[0].body, &figures[1].body]
        else {
            panic!("two maps")
        };
        // The second grain is 0.3 behind the plane; the first is cut 0.1 off its centre, in a circle of 0.1732.
        assert_eq!((lines.len(), moving.len()), (2, 1));
        assert!(lines[0].iter().all(|p| ((p[0] - 0.5).hypot(p[1] - 0.5) - 0.03_f64.sqrt()).abs() < 1e-12));
        // Centres of 10 x 10 cells but for the four at (0.05, 0.05) from the middle and the eight at
        // (0.15, 0.05), 0.158 away.
        assert_eq!(arrows.len(), 100 - 12);
        for ([x, z], [u, w]) in arrows {
            assert!((u - (z - 0.5)).abs() < 1e-12 && (w - (0.5 - x)).abs() < 1e-12);
        }
    }
}

//! Parts of the cell over which grains are averaged, each grain weighted by
//! the exact fraction of it inside (Lan 3.1, Fig. 3.1).

pub mod ball;
pub mod grid;
pub mod region;
pub mod rings;
pub mod sums;

pub use grid::{Body, Direction, Grid};
pub use region::Region;
pub use rings::Rings;

use brazilnut_base::Vec3;
use serde::{Deserialize, Serialize};

/// Any partition of the cell.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Zones {
    /// Slabs, columns or boxes.
    Grid(Grid),
    /// Annuli in slabs.
    Rings(Rings),
}

impl Zones {
    /// Number of zones.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::Grid(g) => g.len(),
            Self::Rings(r) => r.len(),
        }
    }

    /// Never true.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Volume of zone `k`, m³.
    #[must_use]
    pub fn volume(&self, k: usize) -> f64 {
        match self {
            Self::Grid(g) => g.zone_volume(),
            Self::Rings(r) => r.volume(k),
        }
    }

    /// What grains are here.
    #[must_use]
    pub fn body(&self) -> Body {
        match self {
            Self::Grid(g) => g.body(),
            Self::Rings(_) => Body::Sphere,
        }
    }

    /// The zone that holds the point `at`.
    #[must_use]
    pub fn find(&self, at: Vec3) -> usize {
        match self {
            Self::Grid(g) => g.find(at),
            Self::Rings(r) => r.find(at),
        }
    }

    /// Calls `f(zone, fraction)` for every zone that holds part of the grain at `centre` of radius `r` (m).
    pub fn spread(&self, centre: Vec3, r: f64, scratch: &mut Vec<f64>, f: impl FnMut(usize, f64)) {
        match self {
            Self::Grid(g) => g.spread(centre, r, scratch, f),
            Self::Rings(rings) => rings.spread(centre, r, scratch, f),
        }
    }

    /// Calls `f(zone, fraction)` for every zone through which the line from `a` to `a + b` runs.
    pub fn cut(&self, a: Vec3, b: Vec3, scratch: &mut Vec<f64>, mut f: impl FnMut(usize, f64)) {
        scratch.clear();
        scratch.extend([0.0, 1.0]);
        match self {
            Self::Grid(g) => g.directions.iter().for_each(|d| planes(d, a, b, scratch)),
            Self::Rings(r) => {
                planes(&r.height, a, b, scratch);
                circles(r, a, b, scratch);
            }
        }
        scratch.sort_by(f64::total_cmp);
        for t in scratch.windows(2) {
            if t[1] > t[0] {
                f(self.find(a + 0.5 * (t[0] + t[1]) * b), t[1] - t[0]);
            }
        }
    }

    /// Names of the coordinates of a zone.
    #[must_use]
    pub fn coordinates(&self) -> Vec<&'static str> {
        match self {
            Self::Grid(g) => g.directions.iter().map(|d| ["x", "y", "z"][d.axis]).collect(),
            Self::Rings(_) => vec!["r", "z"],
        }
    }

    /// Centre of zone `k` in those coordinates, m.
    #[must_use]
    pub fn centre(&self, k: usize) -> Vec<f64> {
        match self {
            Self::Grid(g) => g.place(k).into_iter().zip(&g.directions).map(|(i, d)| d.centre(i)).collect(),
            Self::Rings(r) => {
                vec![((k % r.count) as f64 + 0.5) * r.width, r.height.centre(k / r.count)]
            }
        }
    }
}

/// Fractions of the line from `a` along `b` at which it crosses faces of `d`.
fn planes(d: &Direction, a: Vec3, b: Vec3, cuts: &mut Vec<f64>) {
    let (x, dx) = (a[d.axis], b[d.axis]);
    if dx == 0.0 {
        return;
    }
    let zone = |x: f64| (x - d.origin) / d.width;
    let (lo, hi) = (zone(x).min(zone(x + dx)), zone(x).max(zone(x + dx)));
    let (mut first, mut last) = (lo.ceil() as i64, hi.floor() as i64);
    if !d.periodic {
        first = first.max(1);
        last = last.min(d.count as i64 - 1);
    }
    for k in first..=last {
        cuts.push(((d.origin + k as f64 * d.width - x) / dx).clamp(0.0, 1.0));
    }
}

/// Fractions at which the line crosses the rings' circles.
fn circles(r: &Rings, a: Vec3, b: Vec3, cuts: &mut Vec<f64>) {
    let (px, py) = (a.x - r.axis[0], a.y - r.axis[1]);
    let (qa, qb) = (b.x * b.x + b.y * b.y, px * b.x + py * b.y);
    if qa == 0.0 {
        return;
    }
    for k in 1..r.count {
        let c = k as f64 * r.width;
        let root = qb * qb - qa * (px * px + py * py - c * c);
        if root > 0.0 {
            cuts.extend(
                [(-qb - root.sqrt()) / qa, (-qb + root.sqrt()) / qa]
                    .into_iter()
                    .filter(|t| (0.0..1.0).contains(t)),
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use brazilnut_base::{Cell, Side, vec3};

    #[test]
    fn a_line_is_shared_out_by_length() {
        let cell = Cell { size: vec3(1.0, 1.0, 1.0), sides: [Side::Periodic, Side::Walls, Side::Walls] };
        let grid = Zones::Grid(Grid::new(
            &cell,
            vec![Direction::across(&cell, 0, 0.25), Direction::across(&cell, 2, 0.5)],
        ));
        let mut parts = vec![0.0; 8];
        // From x = 0.9 through the periodic side to 1.1, and from below the floor to above the middle.
        grid.cut(vec3(0.9, 0.5, -0.1), vec3(0.2, 0.0, 0.8), &mut vec![], |z, t| parts[z] += t);
        let expected = [0.25, 0.0, 0.0, 0.5, 0.25, 0.0, 0.0, 0.0];
        for (p, e) in parts.iter().zip(expected) {
            assert!((p - e).abs() < 1e-14, "{parts:?}");
        }
        let rings = Zones::Rings(Rings::new(&cell, [0.5, 0.5], 0.1, 1.0));
        let mut parts = vec![0.0; 5];
        rings.cut(vec3(0.25, 0.5, 0.5), vec3(0.5, 0.0, 0.0), &mut vec![], |z, t| parts[z] += t);
        for (p, e) in parts.iter().zip([0.4, 0.4, 0.2, 0.0, 0.0]) {
            assert!((p - e).abs() < 1e-14, "{parts:?}");
        }
    }
}

//! A box of its own: an opening, a column.

use super::ball;
use super::grid::Body;
use brazilnut_base::{Cell, Vec3};
use serde::{Deserialize, Serialize};

/// The points between two corners.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Region {
    /// Lower corner, m.
    pub low: Vec3,
    /// Upper corner, m.
    pub high: Vec3,
}

impl Region {
    /// The place `at` (m) and its images one period away along the periodic directions of `cell`: a box
    /// may hold a part of a grain that lies across a side, or reach across one itself.
    pub fn images(cell: &Cell, at: Vec3) -> impl Iterator<Item = Vec3> + use<> {
        let shift = |axis: usize| if cell.is_periodic(axis) { cell.size[axis] } else { 0.0 };
        let size = Vec3::new(shift(0), shift(1), shift(2));
        let places = |axis: usize| if size[axis] > 0.0 { -1..=1 } else { 0..=0 };
        let (x, y, z) = (places(0), places(1), places(2));
        x.flat_map(move |i| y.clone().map(move |j| (i, j)))
            .flat_map(move |(i, j)| {
                z.clone().map(move |k| Vec3::new(f64::from(i), f64::from(j), f64::from(k)))
            })
            .map(move |n| at + n * size)
    }

    /// Whether the point `at` lies inside.
    #[must_use]
    pub fn holds(&self, at: Vec3) -> bool {
        (0..3).all(|a| at[a] >= self.low[a] && at[a] < self.high[a])
    }

    /// Volume, m³.
    #[must_use]
    pub fn volume(&self) -> f64 {
        let d = self.high - self.low;
        d.x * d.y * d.z
    }

    /// Fraction of the grain at `centre` of radius `r` (m) inside.
    #[must_use]
    pub fn part(&self, body: Body, centre: Vec3, r: f64) -> f64 {
        let (low, high) = ((self.low - centre) / r, (self.high - centre) / r);
        let axes: [usize; 3] = match body {
            Body::Sphere => [0, 1, 2],
            Body::Disc(flat, _) => [flat, (flat + 1) % 3, (flat + 2) % 3],
        };
        let bounded = if matches!(body, Body::Sphere) { &axes[..] } else { &axes[1..] };
        if bounded.iter().any(|&a| low[a] >= 1.0 || high[a] <= -1.0) {
            return 0.0;
        }
        if bounded.iter().all(|&a| low[a] <= -1.0 && high[a] >= 1.0) {
            return 1.0;
        }
        let n = bounded.len();
        let mut total = 0.0;
        for corner in 0..1_u32 << n {
            let at = |k: usize| if corner >> k & 1 == 0 { low[bounded[k]] } else { high[bounded[k]] };
            let beyond = if n == 3 {
                ball::beyond_corner(at(0), at(1), at(2)) / ball::BALL
            } else {
                ball::disc_beyond_corner(at(0), at(1)) / ball::DISC
            };
            total += if corner.count_ones() % 2 == 0 { beyond } else { -beyond };
        }
        total.max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use brazilnut_base::vec3;

    #[test]
    fn halves_and_quarters() {
        let r = Region { low: vec3(0.0, 0.0, 0.0), high: vec3(1.0, 1.0, 1.0) };
        assert_eq!(r.part(Body::Sphere, vec3(0.5, 0.5, 0.5), 0.1), 1.0);
        assert!((r.part(Body::Sphere, vec3(0.0, 0.5, 0.5), 0.1) - 0.5).abs() < 1e-15);
        assert!((r.part(Body::Sphere, vec3(0.0, 1.0, 1.0), 0.1) - 0.125).abs() < 1e-15);
        assert_eq!(r.part(Body::Sphere, vec3(0.5, 0.5, 1.2), 0.1), 0.0);
        assert!((r.part(Body::Disc(1, 0.1), vec3(0.0, 9.0, 1.0), 0.1) - 0.25).abs() < 1e-15);
        assert!(r.holds(vec3(0.5, 0.5, 0.0)) && !r.holds(vec3(0.5, 0.5, 1.0)) && r.volume() == 1.0);
    }
}

//! Slabs, columns and boxes: a regular grid in one, two or three directions.

use super::ball;
use brazilnut_base::{Cell, Vec3};
use serde::{Deserialize, Serialize};

/// What a grain fills.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Body {
    /// A sphere.
    Sphere,
    /// A disc across the flat direction (index) that spans its depth (m): a
    /// two-dimensional case, where solids fractions are area fractions.
    Disc(usize, f64),
}

impl Body {
    /// What grains are in this cell.
    #[must_use]
    pub fn of(cell: &Cell) -> Self {
        cell.flat_axis().map_or(Self::Sphere, |k| Self::Disc(k, cell.size[k]))
    }

    /// Volume of a grain of radius `r` (m), m³.
    #[must_use]
    pub fn volume(self, r: f64) -> f64 {
        match self {
            Self::Sphere => ball::BALL * r * r * r,
            Self::Disc(_, depth) => ball::DISC * r * r * depth,
        }
    }
}

/// One direction of a grid.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Direction {
    /// 0, 1, 2 for x, y, z.
    pub axis: usize,
    /// Lower end, m.
    pub origin: f64,
    /// Width of a zone, m.
    pub width: f64,
    /// Number of zones.
    pub count: usize,
    /// True if the ends meet; otherwise the outermost zones also take what lies beyond them.
    pub periodic: bool,
}

impl Direction {
    /// The whole cell along `axis`, in zones as near to `width` as divides it evenly.
    #[must_use]
    pub fn across(cell: &Cell, axis: usize, width: f64) -> Self {
        let count = ((cell.size[axis] / width).round() as usize).max(1);
        let width = cell.size[axis] / count as f64;
        Self { axis, origin: 0.0, width, count, periodic: cell.is_periodic(axis) }
    }

    /// Centre of zone `k`, m.
    #[must_use]
    pub fn centre(&self, k: usize) -> f64 {
        self.origin + (k as f64 + 0.5) * self.width
    }

    /// The zone of the coordinate `x`.
    #[must_use]
    pub fn find(&self, x: f64) -> usize {
        let k = ((x - self.origin) / self.width).floor();
        if self.periodic {
            k.rem_euclid(self.count as f64) as usize
        } else {
            k.clamp(0.0, self.count as f64 - 1.0) as usize
        }
    }

    /// First and last zone that a grain at `x` of radius `r` may touch; unwrapped if periodic.
    fn span(&self, x: f64, r: f64) -> (i64, i64) {
        if self.count == 1 {
            return (0, 0);
        }
        let lo = ((x - r - self.origin) / self.width).floor() as i64;
        let hi = ((x + r - self.origin) / self.width).floor() as i64;
        let last = self.count as i64 - 1;
        if self.periodic { (lo, hi) } else { (lo.clamp(0, last), hi.clamp(0, last)) }
    }

    /// The lower face of zone `k` seen from a grain at `x`, in its radii.
    fn face(&self, k: i64, x: f64, r: f64) -> f64 {
        let open = !self.periodic || self.count == 1;
        if open && k <= 0 {
            f64::NEG_INFINITY
        } else if open && k >= self.count as i64 {
            f64::INFINITY
        } else {
            (self.origin + k as f64 * self.width - x) / r
        }
    }

    fn index(&self, k: i64) -> usize {
        k.rem_euclid(self.count as i64) as usize
    }

    /// Calls `each` with every zone that `low..high` (m) meets inside the ends, and the part of the zone that it covers.
    fn covered(&self, low: f64, high: f64, mut each: impl FnMut(usize, f64)) {
        let (a, b) = ((low - self.origin) / self.width, (high - self.origin) / self.width);
        for k in a.floor() as i64..b.ceil() as i64 {
            let part = b.min(k as f64 + 1.0) - a.max(k as f64);
            if part > NOTHING && (self.periodic || (0..self.count as i64).contains(&k)) {
                each(self.index(k), part);
            }
        }
    }
}

/// A regular grid of zones in one, two or three directions; the first runs fastest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Grid {
    /// Its directions.
    pub directions: Vec<Direction>,
    body: Body,
    zone_volume: f64,
}

/// Parts below this are rounding noise of the formulas, and would give zones
/// that hold nothing a mean velocity.
pub(crate) const NOTHING: f64 = 1e-13;

impl Grid {
    /// A grid over `directions`; zones span the cell in the other directions.
    #[must_use]
    pub fn new(cell: &Cell, directions: Vec<Direction>) -> Self {
        let gridded = |axis: usize| directions.iter().find(|d| d.axis == axis);
        let zone_volume = (0..3).map(|a| gridded(a).map_or(cell.size[a], |d| d.width)).product();
        Self { directions, body: Body::of(cell), zone_volume }
    }

    /// Calls `each` with every zone that the box `low..high` (m) meets, and the part of the zone that it covers in the
    /// grid's first two directions, which must be all it has.
    pub fn spread_box(&self, low: Vec3, high: Vec3, mut each: impl FnMut(usize, f64)) {
        let [first, second] = &self.directions[..] else { unreachable!("a grid in a plane") };
        second.covered(low[second.axis], high[second.axis], |j, q| {
            first.covered(low[first.axis], high[first.axis], |i, p| each(i + first.count * j, p * q));
        });
    }

    /// Number of zones.
    #[must_use]
    pub fn len(&self) -> usize {
        self.directions.iter().fold(1, |n, d| n.saturating_mul(d.count))
    }

    /// Never true: every direction has a zone.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Volume of a zone, m³.
    #[must_use]
    pub fn zone_volume(&self) -> f64 {
        self.zone_volume
    }

    /// What grains are here.
    #[must_use]
    pub fn body(&self) -> Body {
        self.body
    }

    /// Position of zone `k` in each direction.
    #[must_use]
    pub fn place(&self, mut k: usize) -> Vec<usize> {
        self.directions
            .iter()
            .map(|d| {
                let i = k % d.count;
                k /= d.count;
                i
            })
            .collect()
    }

    /// The zone that holds the point `at`.
    #[must_use]
    pub fn find(&self, at: Vec3) -> usize {
        self.directions.iter().rev().fold(0, |k, d| k * d.count + d.find(at[d.axis]))
    }

    /// Calls `f(zone, fraction)` for every zone that holds part of the grain
    /// at `centre` of radius `r` (m); the fractions sum to one to rounding.
    /// `scratch` only spares allocations.
    pub fn spread(&self, centre: Vec3, r: f64, scratch: &mut Vec<f64>, mut f: impl FnMut(usize, f64)) {
        match (self.directions.as_slice(), self.body) {
            ([a], Body::Sphere) => {
                one(a, centre, r, scratch, ball::beyond_plane, ball::BALL, &mut f);
            }
            ([a], Body::Disc(..)) => {
                one(a, centre, r, scratch, ball::disc_beyond_line, ball::DISC, &mut f);
            }
            ([a, b], Body::Sphere) => {
                two(a, b, centre, r, scratch, ball::beyond_edge, ball::BALL, &mut f);
            }
            ([a, b], Body::Disc(..)) => {
                two(a, b, centre, r, scratch, ball::disc_beyond_corner, ball::DISC, &mut f);
            }
            ([a, b, c], _) => three(a, b, c, centre, r, scratch, &mut f),
            _ => f(0, 1.0),
        }
    }
}

fn one(
    a: &Direction,
    p: Vec3,
    r: f64,
    faces: &mut Vec<f64>,
    beyond: impl Fn(f64) -> f64,
    whole: f64,
    f: &mut impl FnMut(usize, f64),
) {
    let (lo, hi) = a.span(p[a.axis], r);
    if lo == hi {
        return f(a.index(lo), 1.0);
    }
    faces.clear();
    faces.extend((lo..=hi + 1).map(|k| beyond(a.face(k, p[a.axis], r)) / whole));
    for k in lo..=hi {
        let part = faces[(k - lo) as usize] - faces[(k - lo) as usize + 1];
        if part > NOTHING {
            f(a.index(k), part);
        }
    }
}

fn two(
    a: &Direction,
    b: &Direction,
    p: Vec3,
    r: f64,
    corners: &mut Vec<f64>,
    beyond: impl Fn(f64, f64) -> f64,
    whole: f64,
    f: &mut impl FnMut(usize, f64),
) {
    let ((alo, ahi), (blo, bhi)) = (a.span(p[a.axis], r), b.span(p[b.axis], r));
    if alo == ahi && blo == bhi {
        return f(a.index(alo) + a.count * b.index(blo), 1.0);
    }
    corners.clear();
    for j in blo..=bhi + 1 {
        for i in alo..=ahi + 1 {
            corners.push(beyond(a.face(i, p[a.axis], r), b.face(j, p[b.axis], r)) / whole);
        }
    }
    let n = (ahi - alo + 2) as usize;
    for j in blo..=bhi {
        for i in alo..=ahi {
            let k = (i - alo) as usize + n * (j - blo) as usize;
            let part = corners[k] - corners[k + 1] - corners[k + n] + corners[k + n + 1];
            if part > NOTHING {
                f(a.index(i) + a.count * b.index(j), part);
            }
        }
    }
}

fn three(
    a: &Direction,
    b: &Direction,
    c: &Direction,
    p: Vec3,
    r: f64,
    corners: &mut Vec<f64>,
    f: &mut impl FnMut(usize, f64),
) {
    let ((alo, ahi), (blo, bhi), (clo, chi)) =
        (a.span(p[a.axis], r), b.span(p[b.axis], r), c.span(p[c.axis], r));
    let zone = |i, j, k| a.index(i) + a.count * (b.index(j) + b.count * c.index(k));
    if alo == ahi && blo == bhi && clo == chi {
        return f(zone(alo, blo, clo), 1.0);
    }
    corners.clear();
    for k in clo..=chi + 1 {
        for j in blo..=bhi + 1 {
            for i in alo..=ahi + 1 {
                let v = ball::beyond_corner(
                    a.face(i, p[a.axis], r),
                    b.face(j, p[b.axis], r),
                    c.face(k, p[c.axis], r),
                );
                corners.push(v / ball::BALL);
            }
        }
    }
    let n = (ahi - alo + 2) as usize;
    let m = n * (bhi - blo + 2) as usize;
    for k in clo..=chi {
        for j in blo..=bhi {
            for i in alo..=ahi {
                let q = (i - alo) as usize + n * (j - blo) as usize + m * (k - clo) as usize;
                let layer = |q: usize| corners[q] - corners[q + 1] - corners[q + n] + corners[q + n + 1];
                let part = layer(q) - layer(q + m);
                if part > NOTHING {
                    f(zone(i, j, k), part);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use brazilnut_base::{Side, random, vec3};
    use rand::RngExt;

    fn cell() -> Cell {
        Cell { size: vec3(1.0, 0.8, 1.2), sides: [Side::Periodic, Side::Walls, Side::Walls] }
    }

    fn grids() -> Vec<Grid> {
        let c = cell();
        let d = |axis, width| Direction::across(&c, axis, width);
        vec![
            Grid::new(&c, vec![d(2, 0.1)]),
            Grid::new(&c, vec![d(0, 0.07)]),
            Grid::new(&c, vec![d(0, 0.09), d(2, 0.3)]),
            Grid::new(&c, vec![d(0, 0.2), d(1, 0.13), d(2, 0.05)]),
        ]
    }

    #[test]
    fn a_box_covers_parts_that_add_up_to_it() {
        let cell = Cell { size: Vec3::new(2.0, 1.0, 3.0), sides: [Side::Periodic, Side::Walls, Side::Walls] };
        let grid = Grid::new(&cell, vec![Direction::across(&cell, 0, 0.5), Direction::across(&cell, 2, 0.6)]);
        let mut parts = vec![0.0; grid.len()];
        // From 1.7 around the end to 2.3, which is 0.3; 0.5 to 1.3 upwards: zones of 0.6.
        grid.spread_box(Vec3::new(1.7, 0.0, 0.5), Vec3::new(2.3, 1.0, 1.3), |zone, part| parts[zone] += part);
        let sum: f64 = parts.iter().sum();
        assert!((sum - 0.6 * 0.8 / (0.5 * 0.6)).abs() < 1e-12, "{parts:?}");
        assert!((parts[4] - 0.6).abs() < 1e-12 && (parts[7] - 0.6).abs() < 1e-12, "{parts:?}");
        assert!((parts[0] - 0.6 * 0.1 / 0.6).abs() < 1e-12 && parts[5] == 0.0, "{parts:?}");
    }

    #[test]
    fn mass_and_momentum_of_the_zones_are_those_of_the_grains() {
        let mut rng = random::stream(1, "zones", 0);
        for grid in grids() {
            let mut scratch = vec![];
            let (mut mass, mut momentum) = (vec![0.0; grid.len()], vec![Vec3::ZERO; grid.len()]);
            let (mut m0, mut p0) = (0.0, Vec3::ZERO);
            for _ in 0..300 {
                let at = vec3(rng.random(), 0.8 * rng.random::<f64>(), 1.2 * rng.random::<f64>());
                let (r, v) =
                    (0.02 + 0.1 * rng.random::<f64>(), vec3(rng.random(), rng.random(), rng.random()));
                let m = r * r * r;
                m0 += m;
                p0 += m * v;
                grid.spread(at, r, &mut scratch, |zone, part| {
                    mass[zone] += m * part;
                    momentum[zone] += m * part * v;
                });
            }
            let m1: f64 = mass.iter().sum();
            let p1: Vec3 = momentum.iter().sum();
            // 300 grains in up to 80 zones each: rounding of some 1e4 terms of 1e-16.
            assert!((m1 / m0 - 1.0).abs() < 1e-12, "{m1} {m0}");
            assert!((p1 - p0).length() / p0.length() < 1e-12);
        }
    }

    #[test]
    fn part_of_a_sphere_in_boxes_agrees_with_counting_points() {
        let grid = &grids()[3];
        let (at, r) = (vec3(0.98, 0.11, 0.5), 0.12);
        let mut counted = vec![0.0; grid.len()];
        let n = 120;
        let mut inside = 0.0;
        for i in 0..n * n * n {
            let q = vec3(f64::from(i % n), f64::from(i / n % n), f64::from(i / n / n));
            let s = (q + 0.5) * (2.0 / f64::from(n)) - 1.0;
            if s.length_squared() < 1.0 {
                inside += 1.0;
                counted[grid.find(at + r * s)] += 1.0;
            }
        }
        let mut exact = vec![0.0; grid.len()];
        grid.spread(at, r, &mut vec![], |zone, part| exact[zone] += part);
        for (c, e) in counted.iter().zip(&exact) {
            // Points miscount a surface layer of half a spacing: 1/n of the section, a few parts in a thousand.
            assert!((c / inside - e).abs() < 5e-3, "{} {e}", c / inside);
        }
    }

    #[test]
    fn discs_in_a_flat_cell() {
        let c = Cell { size: vec3(1.0, 0.1, 1.0), sides: [Side::Walls, Side::Flat, Side::Walls] };
        let grid = Grid::new(&c, vec![Direction::across(&c, 0, 0.5), Direction::across(&c, 2, 0.5)]);
        let mut parts = vec![];
        grid.spread(vec3(0.5, 0.05, 0.5), 0.2, &mut vec![], |z, p| parts.push((z, p)));
        assert_eq!(parts.len(), 4);
        assert!(parts.iter().all(|(_, p)| (p - 0.25).abs() < 1e-15));
        assert!((grid.body().volume(0.2) - std::f64::consts::PI * 0.04 * 0.1).abs() < 1e-16);
    }
}

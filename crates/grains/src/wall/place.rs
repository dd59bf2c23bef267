//! Where the walls are now, and where a grain is nearest to them.

use super::{Arrangement, WallShape, WallSpec};
use brazilnut_base::{Cell, Vec3};
use std::borrow::Cow;

/// The walls at one instant.
#[derive(Clone, Debug)]
pub struct Walls {
    cell: Cell,
    specs: Vec<WallSpec>,
    displacement: Vec<Vec3>,
    velocity: Vec<Vec3>,
    /// Time to which they were moved last, s.
    time: Option<f64>,
}

/// The point of a wall nearest to a grain's centre, seen from there.
#[derive(Clone, Copy, Debug)]
pub struct Near {
    /// Unit vector from the wall to the centre.
    pub normal: Vec3,
    /// Distance of the centre from the surface, negative inside, m.
    pub distance: f64,
    /// 1/radius of the wall's surface there, 1/m.
    pub curvature: f64,
}

impl Near {
    /// No contact there.
    const NOWHERE: Self = Self { normal: Vec3::Z, distance: f64::INFINITY, curvature: 0.0 };
}

impl Walls {
    /// The walls of a case, at rest.
    #[must_use]
    pub fn new(cell: Cell, specs: &[WallSpec]) -> Self {
        let still = vec![Vec3::ZERO; specs.len()];
        Self { cell, specs: specs.to_vec(), displacement: still.clone(), velocity: still, time: None }
    }

    /// Number of walls.
    #[must_use]
    pub fn len(&self) -> usize {
        self.specs.len()
    }

    /// True if there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.specs.is_empty()
    }

    /// Moves the walls to where they are at `time` (s).
    pub fn move_to(&mut self, time: f64) {
        if self.time == Some(time) {
            return;
        }
        self.time = Some(time);
        for k in 0..self.specs.len() {
            let m = self.specs[k].motion.at(time);
            self.displacement[k] = m.displacement;
            self.velocity[k] = m.velocity;
        }
    }

    /// The walls where they are at `time` (s): themselves if they were moved there last.
    #[must_use]
    pub fn at(&self, time: f64) -> Cow<'_, Self> {
        if self.time == Some(time) {
            return Cow::Borrowed(self);
        }
        let mut moved = self.clone();
        moved.move_to(time);
        Cow::Owned(moved)
    }

    /// Velocity of wall `k`, m/s.
    #[inline]
    #[must_use]
    pub fn velocity(&self, k: usize) -> Vec3 {
        self.velocity[k]
    }

    /// Displacement of wall `k` from where it stands at rest, m.
    #[must_use]
    pub fn displacement(&self, k: usize) -> Vec3 {
        self.displacement[k]
    }

    /// Material of wall `k`.
    #[must_use]
    pub fn material(&self, k: usize) -> u16 {
        self.specs[k].material
    }

    /// The point of feature `feature` of wall `k` nearest to `x`.
    #[inline]
    #[must_use]
    pub fn nearest(&self, k: usize, feature: u32, x: Vec3) -> Near {
        let moved = self.displacement[k];
        match self.specs[k].shape {
            WallShape::Plane { point, normal } => {
                Near { normal, distance: (x - point - moved).dot(normal), curvature: 0.0 }
            }
            WallShape::Box { .. } => self.nearest_of_box(k, x),
            WallShape::Bumps { axis, at, radius, spacing, arrangement } => {
                let centre = moved + Lattice::new(&self.cell, axis, at, spacing, arrangement).site(feature);
                let d = self.in_plane(self.cell.nearest(x - centre));
                let length = d.length();
                Near { normal: d / length, distance: length - radius, curvature: 1.0 / radius }
            }
        }
    }

    /// Distance from box `k`; nothing where a neighbouring box covers that point, so that
    /// boxes side by side have no seams.
    fn nearest_of_box(&self, k: usize, x: Vec3) -> Near {
        let Some((point, near)) = self.box_point(k, x) else { return Near::NOWHERE };
        // A point on a shared face lies in both up to rounding.
        let slack = Vec3::splat(1e-9 * self.cell.size.max_element());
        for other in (0..self.specs.len()).filter(|&o| o != k) {
            let WallShape::Box { low, high } = self.specs[other].shape else { continue };
            let moved = self.displacement[other];
            let covers =
                (low + moved - slack).cmple(point).all() && (high + moved + slack).cmpge(point).all();
            if !covers {
                continue;
            }
            if let Some((_, rival)) = self.box_point(other, x) {
                let tie = (rival.distance - near.distance).abs() <= slack.x;
                if (tie && other < k) || (!tie && rival.distance < near.distance) {
                    return Near::NOWHERE;
                }
            }
        }
        near
    }

    /// The surface point of box `k` nearest to `x`, and what it means for a grain there.
    fn box_point(&self, k: usize, x: Vec3) -> Option<(Vec3, Near)> {
        let WallShape::Box { low, high } = self.specs[k].shape else { return None };
        let (low, high) = (low + self.displacement[k], high + self.displacement[k]);
        // The image of the grain nearest to the box.
        let middle = 0.5 * (low + high);
        let shift = middle + self.cell.nearest(x - middle) - x;
        let x = self.flattened(x + shift, middle);
        let point = x.clamp(low, high);
        let d = x - point;
        let length = d.length();
        let near = if length > 0.0 {
            Near { normal: d / length, distance: length, curvature: 0.0 }
        } else {
            inside(x, low, high, self.cell.flat_axis())
        };
        Some((point, near))
    }

    /// `d` without its component along the flat direction.
    fn in_plane(&self, mut d: Vec3) -> Vec3 {
        if let Some(axis) = self.cell.flat_axis() {
            d[axis] = 0.0;
        }
        d
    }

    /// `x` moved along the flat direction to where `to` is.
    fn flattened(&self, mut x: Vec3, to: Vec3) -> Vec3 {
        if let Some(axis) = self.cell.flat_axis() {
            x[axis] = to[axis];
        }
        x
    }

    /// Calls `found` for every feature of every wall whose surface may lie within `reach` (m) of `x`.
    pub fn candidates(&self, x: Vec3, reach: f64, mut found: impl FnMut(u16, u32)) {
        for k in 0..self.specs.len() {
            match self.specs[k].shape {
                WallShape::Plane { .. } => {
                    if self.nearest(k, 0, x).distance <= reach {
                        found(k as u16, 0);
                    }
                }
                WallShape::Box { .. } => {
                    // Not `nearest`: what a neighbour covers now it may not cover later.
                    if self.box_point(k, x).is_some_and(|(_, near)| near.distance <= reach) {
                        found(k as u16, 0);
                    }
                }
                WallShape::Bumps { axis, at, radius, spacing, arrangement } => {
                    let lattice = Lattice::new(&self.cell, axis, at, spacing, arrangement);
                    let origin = x - self.displacement[k];
                    if (origin[axis] - at).abs() > reach + radius {
                        continue;
                    }
                    lattice.around(origin, reach + radius, |site| {
                        if self.nearest(k, site, x).distance <= reach {
                            found(k as u16, site);
                        }
                    });
                }
            }
        }
    }
}

/// A centre inside a box leaves through the nearest face.
fn inside(x: Vec3, low: Vec3, high: Vec3, flat: Option<usize>) -> Near {
    let mut best = Near { normal: Vec3::Z, distance: f64::NEG_INFINITY, curvature: 0.0 };
    for axis in (0..3).filter(|&a| Some(a) != flat) {
        for (depth, sign) in [(x[axis] - low[axis], -1.0), (high[axis] - x[axis], 1.0)] {
            if -depth > best.distance {
                let mut normal = Vec3::ZERO;
                normal[axis] = sign;
                best = Near { normal, distance: -depth, curvature: 0.0 };
            }
        }
    }
    best
}

/// The sites of a bumpy plane.
struct Lattice {
    axes: [usize; 3],
    at: f64,
    pitch: [f64; 2],
    count: [i64; 2],
    periodic: [bool; 2],
    flat: [bool; 2],
    staggered: bool,
}

impl Lattice {
    fn new(cell: &Cell, axis: usize, at: f64, spacing: f64, arrangement: Arrangement) -> Self {
        let [a, b] = [(axis + 1) % 3, (axis + 2) % 3];
        let flat = [cell.flat_axis() == Some(a), cell.flat_axis() == Some(b)];
        let staggered = arrangement == Arrangement::Triangular && !flat[0] && !flat[1];
        let rows = if staggered { spacing * 0.75_f64.sqrt() } else { spacing };
        let periodic = [cell.is_periodic(a), cell.is_periodic(b)];
        let mut count = [0; 2];
        for (k, (axis, wanted)) in [(a, spacing), (b, rows)].into_iter().enumerate() {
            count[k] = if flat[k] { 1 } else { ((cell.size[axis] / wanted).round() as i64).max(1) };
        }
        if staggered && periodic[1] && count[1] % 2 == 1 {
            count[1] += 1;
        }
        let pitch = [cell.size[a] / count[0] as f64, cell.size[b] / count[1] as f64];
        Self { axes: [axis, a, b], at, pitch, count, periodic, flat, staggered }
    }

    /// Sites per row: a staggered row between walls has one more, so that both ends are alike.
    fn stride(&self) -> i64 {
        self.count[0] + 1
    }

    /// Centre of site `index`, m.
    fn site(&self, index: u32) -> Vec3 {
        let (m, n) = (i64::from(index) % self.stride(), i64::from(index) / self.stride());
        let offset = if self.staggered && n % 2 == 1 { 0.0 } else { 0.5 };
        let mut r = Vec3::ZERO;
        r[self.axes[0]] = self.at;
        r[self.axes[1]] = (m as f64 + offset) * self.pitch[0];
        r[self.axes[2]] = (n as f64 + 0.5) * self.pitch[1];
        r
    }

    /// Calls `found` for the sites whose coordinates in the plane may lie within `reach` of those of `x`.
    fn around(&self, x: Vec3, reach: f64, mut found: impl FnMut(u32)) {
        let range = |k: usize| {
            let c = x[self.axes[1 + k]];
            let most = self.count[k] + if self.periodic[k] { 0 } else { 1 };
            let low = ((c - reach) / self.pitch[k]).floor() as i64 - 1;
            let high = ((c + reach) / self.pitch[k]).ceil() as i64 + 1;
            if self.flat[k] {
                0..1
            } else if self.periodic[k] {
                if high - low >= most { 0..most } else { low..high }
            } else {
                low.max(0)..high.min(most)
            }
        };
        for n in range(1) {
            let n = if self.periodic[1] { n.rem_euclid(self.count[1]) } else { n };
            if n >= self.count[1] {
                continue;
            }
            for m in range(0) {
                let m = if self.periodic[0] { m.rem_euclid(self.count[0]) } else { m };
                let extra = self.staggered && n % 2 == 1 && !self.periodic[0];
                if m < self.count[0] + i64::from(extra) {
                    found((m + n * self.stride()) as u32);
                }
            }
        }
    }
}

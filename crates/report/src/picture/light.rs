//! What keeps light away: the shadow of the lamp, and the sky blocked by neighbours.

use super::Sphere;
use brazilnut_base::{Vec3, vec3};
use rayon::prelude::*;

/// Depths seen from the lamp on a square map.
pub(crate) struct Shadows {
    axes: [Vec3; 3],
    low: [f64; 2],
    per_metre: f64,
    side: usize,
    depth: Vec<f32>,
    taps: [[f64; 2]; TAPS],
}

/// Places on the disc from which a soft lamp is seen.
const TAPS: usize = 16;

impl Shadows {
    /// The map of `spheres` under light that comes from `towards`.
    pub fn new(spheres: &[Sphere], towards: Vec3) -> Self {
        let w = -towards.normalize();
        let u = w.any_orthonormal_vector();
        let axes = [u, w.cross(u), w];
        let flat = |p: Vec3| [p.dot(axes[0]), p.dot(axes[1])];
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for s in spheres {
            let c = flat(s.centre);
            for i in 0..2 {
                (low[i], high[i]) = (low[i].min(c[i] - s.radius), high[i].max(c[i] + s.radius));
            }
        }
        let span = (high[0] - low[0]).max(high[1] - low[1]).max(1e-30);
        let mut radii: Vec<f64> = spheres.iter().map(|s| s.radius).collect();
        radii.sort_by(f64::total_cmp);
        let typical = radii.get(radii.len() / 2).copied().unwrap_or(span);
        // A dozen texels across a typical grain, within bounds.
        let side =
            if spheres.is_empty() { 1 } else { ((12.0 * span / (2.0 * typical)) as usize).clamp(256, 1536) };
        // One empty texel all round.
        let per_metre = (side.max(4) - 3) as f64 / span;
        low = low.map(|v| v - 1.5 / per_metre);
        let blur = 0.45 * typical * per_metre;
        let mut map = Self { axes, low, per_metre, side, depth: vec![], taps: spiral(blur) };
        map.depth = map.draw(spheres);
        map
    }

    fn draw(&self, spheres: &[Sphere]) -> Vec<f32> {
        let side = self.side;
        let mut depth = vec![f32::INFINITY; side * side];
        let rows = 32;
        depth.par_chunks_mut(side * rows).enumerate().for_each(|(band, out)| {
            let (first, last) = (band * rows, band * rows + out.len() / side);
            for s in spheres {
                let ([x, y], r) = (self.texel(s.centre), s.radius * self.per_metre);
                let clamp = |v: f64, a: usize, b: usize| v.clamp(a as f64, b as f64) as usize;
                for j in clamp((y - r).floor(), first, last)..clamp((y + r).ceil(), first, last) {
                    for i in clamp((x - r).floor(), 0, side)..clamp((x + r).ceil(), 0, side) {
                        let (dx, dy) = (i as f64 + 0.5 - x, j as f64 + 0.5 - y);
                        let under = r * r - dx * dx - dy * dy;
                        if under > 0.0 {
                            let z = (s.centre.dot(self.axes[2]) - under.sqrt() / self.per_metre) as f32;
                            let k = (j - first) * side + i;
                            out[k] = out[k].min(z);
                        }
                    }
                }
            }
        });
        depth
    }

    fn texel(&self, p: Vec3) -> [f64; 2] {
        [
            (p.dot(self.axes[0]) - self.low[0]) * self.per_metre,
            (p.dot(self.axes[1]) - self.low[1]) * self.per_metre,
        ]
    }

    /// Share of the lamp's light that reaches `p`; `slack` (m) keeps a surface from shading itself.
    pub fn lit(&self, p: Vec3, slack: f64) -> f64 {
        let [x, y] = self.texel(p);
        let depth = (p.dot(self.axes[2]) - slack) as f32;
        let open = self.taps.iter().filter(|[u, v]| {
            // Negative places and NaN become 0 or lie outside: the map's rim casts no shadow.
            let (i, j) = ((x + u) as usize, (y + v) as usize);
            i >= self.side || j >= self.side || self.depth[j * self.side + i] >= depth
        });
        open.count() as f64 / TAPS as f64
    }
}

/// Places that cover a disc of this radius evenly: a spiral turning by the golden angle.
fn spiral(radius: f64) -> [[f64; 2]; TAPS] {
    const GOLDEN: f64 = 2.399_963_229_728_653;
    std::array::from_fn(|k| {
        let (r, a) = (radius * ((k as f64 + 0.5) / TAPS as f64).sqrt(), GOLDEN * k as f64);
        [r * a.cos(), r * a.sin()]
    })
}

/// Spheres by place, to ask which block the sky at a point.
pub(crate) struct Sky {
    low: Vec3,
    per_metre: f64,
    shape: [usize; 3],
    starts: Vec<u32>,
    entries: Vec<u32>,
}

/// A sphere blocks the sky up to this many of its radii from its centre.
const REACH: f64 = 2.6;

impl Sky {
    pub fn new(spheres: &[Sphere]) -> Self {
        let (mut low, mut high, mut mean) = (Vec3::INFINITY, Vec3::NEG_INFINITY, 0.0);
        for s in spheres {
            low = low.min(s.centre - REACH * s.radius);
            high = high.max(s.centre + REACH * s.radius);
            mean += s.radius / spheres.len() as f64;
        }
        if spheres.is_empty() {
            (low, high, mean) = (Vec3::ZERO, Vec3::ONE, 1.0);
        }
        // Cells of a grain's diameter, but never more of them than a small map.
        let mut edge = 2.0 * mean;
        while ((high - low) / edge + 1.0).floor().element_product() > 2e6 {
            edge *= 1.3;
        }
        let shape = ((high - low) / edge).to_array().map(|n| n as usize + 1);
        let mut sky = Self { low, per_metre: 1.0 / edge, shape, starts: vec![], entries: vec![] };
        let mut counts = vec![0_u32; shape.iter().product::<usize>() + 1];
        spheres.iter().for_each(|s| sky.cells_of(s).for_each(|c| counts[c + 1] += 1));
        for c in 1..counts.len() {
            counts[c] += counts[c - 1];
        }
        sky.entries = vec![0; counts[counts.len() - 1] as usize];
        let mut next = counts.clone();
        for (k, s) in spheres.iter().enumerate() {
            for c in sky.cells_of(s) {
                sky.entries[next[c] as usize] = k as u32;
                next[c] += 1;
            }
        }
        sky.starts = counts;
        sky
    }

    fn cell(&self, p: Vec3) -> [usize; 3] {
        let c = (p - self.low) * self.per_metre;
        std::array::from_fn(|i| (c[i].max(0.0) as usize).min(self.shape[i] - 1))
    }

    fn cells_of(&self, s: &Sphere) -> impl Iterator<Item = usize> + use<> {
        let (a, b) = (self.cell(s.centre - REACH * s.radius), self.cell(s.centre + REACH * s.radius));
        let shape = self.shape;
        (a[2]..=b[2]).flat_map(move |k| {
            (a[1]..=b[1]).flat_map(move |j| (a[0]..=b[0]).map(move |i| (k * shape[1] + j) * shape[0] + i))
        })
    }

    /// Share of the sky over the surface at `p` with `normal` that `spheres` leave open.
    ///
    /// A sphere of radius r at distance d in direction w blocks (n·w) r²/d² of a hemisphere
    /// weighted by the cosine; blocks are multiplied as if they were independent.
    pub fn open(&self, spheres: &[Sphere], p: Vec3, normal: Vec3, own: u32) -> f64 {
        let [i, j, k] = self.cell(p);
        let c = (k * self.shape[1] + j) * self.shape[0] + i;
        let mut open = 1.0;
        for &id in &self.entries[self.starts[c] as usize..self.starts[c + 1] as usize] {
            let s = &spheres[id as usize];
            let w = s.centre - p;
            let (d2, r2) = (w.length_squared(), s.radius * s.radius);
            let far = d2 / (REACH * REACH * r2);
            let facing = w.dot(normal);
            if id == own || far >= 1.0 || facing <= 0.0 {
                continue;
            }
            let blocked = facing / d2.sqrt() * (r2 / d2.max(r2));
            // Fades to nothing at its reach, so that no edge shows.
            open *= 1.0 - blocked * (1.0 - far) * (1.0 - far);
        }
        open
    }
}

/// The direction of the lamp for a view along `forward` with `right`: over the left shoulder.
pub(crate) fn lamp(right: Vec3, forward: Vec3) -> Vec3 {
    let flat = vec3(forward.x, forward.y, 0.0).normalize_or(Vec3::Y);
    (-0.55 * right - 0.62 * flat + 1.05 * Vec3::Z).normalize()
}

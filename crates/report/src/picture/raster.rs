//! Which sphere each sample sees.

use super::Sphere;
use super::camera::Lens;

/// Nothing there.
pub(crate) const NOTHING: u32 = u32::MAX;

/// Where a sphere falls on the picture, in samples, with room to spare.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Disc {
    sphere: u32,
    depth: f64,
    low: [f64; 2],
    high: [f64; 2],
}

/// The discs of all spheres, nearest first.
pub(crate) fn discs(spheres: &[Sphere], lens: &Lens) -> Vec<Disc> {
    let mut discs: Vec<Disc> = spheres
        .iter()
        .enumerate()
        .map(|(k, s)| {
            let [x, y, depth] = lens.project(s.centre);
            // Perspective stretches discs outward from the middle: a tenth covers the gentle angles allowed.
            let r = 1.0 + 1.1 * s.radius * lens.zoom * lens.magnification(depth - s.radius);
            Disc { sphere: k as u32, depth: depth - s.radius, low: [x - r, y - r], high: [x + r, y + r] }
        })
        .collect();
    discs.sort_by(|a, b| a.depth.total_cmp(&b.depth).then(a.sphere.cmp(&b.sphere)));
    discs
}

/// A band of rows of samples.
pub(crate) struct Band {
    /// Samples in a row.
    pub width: usize,
    /// Number of the first row in the whole picture.
    pub first: usize,
    /// Rows.
    pub rows: usize,
    /// Sphere seen by each sample, or [`NOTHING`].
    pub sphere: Vec<u32>,
    /// Depth of what it sees, m; infinite if nothing.
    pub depth: Vec<f32>,
}

impl Band {
    pub fn new(width: usize, first: usize, rows: usize) -> Self {
        let n = width * rows;
        Self { width, first, rows, sphere: vec![NOTHING; n], depth: vec![f32::INFINITY; n] }
    }

    /// Finds the nearest sphere of every sample.
    pub fn draw(&mut self, discs: &[Disc], spheres: &[Sphere], lens: &Lens) {
        let range = |low: f64, high: f64, from: usize, to: usize| {
            let clamp = |v: f64| v.clamp(from as f64, to as f64) as usize;
            clamp(low.floor())..clamp(high.ceil())
        };
        for disc in discs {
            let s = &spheres[disc.sphere as usize];
            let c = lens.view(s.centre);
            let rows = range(disc.low[1], disc.high[1], self.first, self.first + self.rows);
            let columns = range(disc.low[0], disc.high[0], 0, self.width);
            for row in rows {
                for column in columns.clone() {
                    let k = (row - self.first) * self.width + column;
                    if f64::from(self.depth[k]) < disc.depth {
                        continue;
                    }
                    let (o, d) = lens.ray(column as f64 + 0.5, row as f64 + 0.5);
                    // |o + z d - c|² = r²
                    let q = o - c;
                    let (a, b) = (d.length_squared(), d.dot(q));
                    let under = b * b - a * (q.length_squared() - s.radius * s.radius);
                    if under >= 0.0 {
                        let z = ((-b - under.sqrt()) / a) as f32;
                        if z < self.depth[k] {
                            (self.depth[k], self.sphere[k]) = (z, disc.sphere);
                        }
                    }
                }
            }
        }
    }
}

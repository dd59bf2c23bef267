//! How bright each sample is.

use super::camera::Lens;
use super::light::{Shadows, Sky, lamp};
use super::raster::{Band, NOTHING};
use super::{Scene, Sphere};
use crate::colour::{Rgb, to_linear};
use brazilnut_base::Vec3;

/// Everything that light depends on.
pub(crate) struct Stage<'a> {
    spheres: &'a [Sphere],
    albedo: Vec<Rgb>,
    lens: &'a Lens,
    lamp: Vec3,
    shadows: Shadows,
    sky: Sky,
    floor: Option<f64>,
    fluid: Option<(Vec3, Vec3)>,
    middle: Vec3,
    reach: f64,
    depth: [f64; 2],
}

impl<'a> Stage<'a> {
    pub fn new(scene: &Scene, spheres: &'a [Sphere], lens: &'a Lens, (low, high): (Vec3, Vec3)) -> Self {
        let lamp = lamp(lens.unturn(Vec3::X), lens.unturn(Vec3::Z));
        let half = 0.5 * (high - low).length();
        Self {
            spheres,
            albedo: spheres.iter().map(|s| s.colour.map(to_linear)).collect(),
            lens,
            lamp,
            shadows: Shadows::new(spheres, lamp),
            sky: Sky::new(spheres),
            floor: scene.cell.map(|c| c.0.z),
            fluid: scene.fluid,
            middle: 0.5 * (low + high),
            reach: half,
            depth: [-half, half],
        }
    }

    /// Light of every sample of a band; `n` samples by `n` make a pixel.
    pub fn light(&self, band: &Band, n: usize) -> Vec<Rgb> {
        let mut out = vec![[0.0; 3]; band.sphere.len()];
        for corner_row in (0..band.rows).step_by(n) {
            for corner in (0..band.width).step_by(n) {
                // The open sky varies slowly: samples of a pixel that see one grain share it.
                let (mut seen, mut open) = (NOTHING, 1.0);
                for (row, column) in (0..n * n).map(|k| (corner_row + k / n, corner + k % n)) {
                    let k = row * band.width + column;
                    let (o, d) = self.lens.ray(column as f64 + 0.5, (band.first + row) as f64 + 0.5);
                    let id = band.sphere[k];
                    let depth = f64::from(band.depth[k]);
                    let light = if id == NOTHING {
                        self.ground(o, d, (band.first + row) as f64)
                    } else {
                        let s = &self.spheres[id as usize];
                        let p = self.lens.world(o + depth * d);
                        let normal = (p - s.centre).normalize_or(Vec3::Z);
                        if id != seen {
                            (seen, open) = (id, self.sky.open(self.spheres, p, normal, id));
                        }
                        self.grain(id, p, normal, self.lens.unturn(d).normalize(), depth, open)
                    };
                    out[k] = self.through_fluid(light, o, d, depth);
                }
            }
        }
        out
    }

    /// What is left of `light` after its way through the fluid, up to `depth`.
    fn through_fluid(&self, light: Rgb, o: Vec3, d: Vec3, depth: f64) -> Rgb {
        let Some((low, high)) = self.fluid else { return light };
        let (from, along) = (self.lens.world(o), self.lens.unturn(d));
        let (a, b) = ((low - from) / along, (high - from) / along);
        let (enter, leave) = (a.min(b).max_element(), a.max(b).min_element().min(depth));
        // A line of sight within a face gives NaN, which `max` drops.
        let way = (leave - enter).max(0.0) * d.length() / self.reach;
        // Water takes red first; the little that it scatters is pale blue.
        const TAKEN: Rgb = [0.17, 0.055, 0.025];
        std::array::from_fn(|i| light[i] * (-TAKEN[i] * way).exp())
    }

    /// Light from the grain `id` at its surface point `p`.
    fn grain(&self, id: u32, p: Vec3, normal: Vec3, sight: Vec3, depth: f64, open: f64) -> Rgb {
        let s = &self.spheres[id as usize];
        let lit = self.shadows.lit(p + 0.03 * s.radius * normal, 0.06 * s.radius);
        let key = normal.dot(self.lamp).max(0.0) * lit;
        let fill = normal.dot(-sight).max(0.0) * open;
        // The sky is bright above and dim near the floor.
        let sky = (0.62 + 0.38 * normal.z) * open * open;
        let half = (self.lamp - sight).normalize_or(Vec3::Z);
        let shine = 0.22 * lit * normal.dot(half).max(0.0).powi(48);
        let bright = 0.78 * key + 0.40 * sky + 0.13 * fill;
        let haze = 0.16 * ((depth - self.depth[0]) / (self.depth[1] - self.depth[0])).clamp(0.0, 1.0);
        let albedo = &self.albedo[id as usize];
        std::array::from_fn(|i| {
            let c = albedo[i] * bright * 1.12 + shine;
            soften(c) * (1.0 - haze) + 0.86 * haze
        })
    }

    /// Light from where no grain is: paper, with the shadow of the bed where the floor is seen.
    fn ground(&self, o: Vec3, d: Vec3, row: f64) -> Rgb {
        let paper = paper(row / self.lens.height);
        let Some(height) = self.floor else { return paper };
        let up = self.lens.vertical();
        // Height of the line of sight against depth z: h(z) = h₀ + z (up·d).
        let (h0, slope) = (self.lens.target_height() + up.dot(o), up.dot(d));
        if slope >= -1e-6 {
            return paper;
        }
        let p = self.lens.world(o + (height - h0) / slope * d);
        let away = (p - self.middle).truncate().length() / self.reach;
        let fade = (1.0 - (away - 1.0) / 1.2).clamp(0.0, 1.0);
        if fade <= 0.0 {
            return paper;
        }
        let lit = self.shadows.lit(p, 1e-3 * self.reach);
        let open = self.sky.open(self.spheres, p, Vec3::Z, NOTHING);
        let dark = fade * (1.0 - (0.52 + 0.48 * lit) * (0.35 + 0.65 * open));
        [paper[0] * (1.0 - dark), paper[1] * (1.0 - 0.985 * dark), paper[2] * (1.0 - 0.96 * dark)]
    }
}

/// The paper behind the bed: almost white, a little darker towards the bottom.
fn paper(t: f64) -> Rgb {
    let shade = 0.03 * t.clamp(0.0, 1.0);
    [0.965 - shade, 0.972 - shade, 0.985 - shade]
}

/// Bends light above one half towards one instead of cutting it off.
fn soften(c: f64) -> f64 {
    if c < 0.5 { c } else { 1.0 - 0.5 * (-(c - 0.5) / 0.5).exp() }
}

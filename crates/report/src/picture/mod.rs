//! Pictures of grains: spheres with soft light, contact shadows and the outline
//! of their cell, drawn on the processor without any graphics library.
//!
//! A sample of the picture finds the nearest sphere along its line of sight
//! (exactly, not by polygons), is lit by one lamp with soft shadows and by a sky
//! that neighbouring grains block, and is averaged with its neighbours in light,
//! not in display values. The same scene gives the same bytes for any number of threads.

mod camera;
mod light;
mod overlay;
mod palette;
mod raster;
mod shade;

pub use camera::Camera;
pub use palette::{AMBER, STEEL, TEAL, by_layer, by_value, species};

use crate::colour::{self, Rgb};
use brazilnut_base::{Cell, Vec3};
use rayon::prelude::*;

/// A grain as the picture sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Centre, m.
    pub centre: Vec3,
    /// Radius, m.
    pub radius: f64,
    /// Colour under white light.
    pub colour: Rgb,
}

/// An arrow in space, drawn over the grains.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arrow {
    /// Where it starts, m.
    pub from: Vec3,
    /// Where it points, m.
    pub to: Vec3,
    /// Its colour.
    pub colour: Rgb,
}

/// What is drawn.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// The grains.
    pub spheres: Vec<Sphere>,
    /// Arrows over them.
    pub arrows: Vec<Arrow>,
    /// Opposite corners of the cell whose edges are drawn, m; its bottom is the floor.
    pub cell: Option<(Vec3, Vec3)>,
    /// The cell goes on above what is shown: no edges are drawn round its top.
    pub open_top: bool,
    /// Opposite corners of the space filled with liquid, m: it is tinted.
    pub fluid: Option<(Vec3, Vec3)>,
    /// Opposite corners of what must be in view, m; all of the above if absent.
    /// Pictures of one bed at several times should share it.
    pub view: Option<(Vec3, Vec3)>,
}

/// Size and quality of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Format {
    /// Width, px.
    pub width: usize,
    /// Height, px.
    pub height: usize,
    /// Samples per pixel along each direction: 2 is smooth, 3 is for a title page.
    pub samples: usize,
}

impl Default for Format {
    fn default() -> Self {
        Self { width: 900, height: 700, samples: 2 }
    }
}

impl Format {
    /// As high as the scene needs at this width, within reason.
    #[must_use]
    pub fn fitting(scene: &Scene, camera: &Camera, width: usize) -> Self {
        // The margins are 4.5 % of the shorter side at each end.
        let aspect = camera.aspect(scene.bounds());
        let height = width as f64 * (0.91 * aspect + 0.09 * aspect.min(1.0)).clamp(0.4, 1.4);
        Self { width, height: height.round() as usize, ..Self::default() }
    }
}

impl Scene {
    /// A bed in its cell, shown up to the height `top` (m) or the lid; `wet` fills the cell with liquid.
    /// Pictures of one bed at several times should share `top`.
    #[must_use]
    pub fn of_bed(cell: &Cell, spheres: Vec<Sphere>, top: f64, wet: bool) -> Self {
        let (mut low, mut high) = (Vec3::ZERO, cell.size.with_z(top.min(cell.size.z)));
        if let Some(axis) = cell.flat_axis() {
            // A plane case has grains on one plane: its cell is as deep as they are.
            let ends = spheres.iter().map(|s| (s.centre[axis] - s.radius, s.centre[axis] + s.radius));
            let (a, b) = ends.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), e| (a.min(e.0), b.max(e.1)));
            if a < b {
                (low[axis], high[axis]) = (a, b);
            }
        }
        let bounds = Some((low, high));
        let fluid = bounds.filter(|_| wet);
        Self { spheres, arrows: vec![], cell: bounds, open_top: top < cell.size.z, fluid, view: bounds }
    }

    /// What must be in view.
    fn bounds(&self) -> (Vec3, Vec3) {
        if let Some(view) = self.view {
            return view;
        }
        let start = self.cell.unwrap_or((Vec3::INFINITY, Vec3::NEG_INFINITY));
        let (low, high) = self
            .spheres
            .iter()
            .fold(start, |(low, high), s| (low.min(s.centre - s.radius), high.max(s.centre + s.radius)));
        if low.cmple(high).all() { (low, high) } else { (Vec3::ZERO, Vec3::ONE) }
    }
}

/// Draws `scene` as a PNG.
#[must_use]
pub fn render(scene: &Scene, camera: &Camera, format: Format) -> Vec<u8> {
    let format = Format {
        width: format.width.max(1),
        height: format.height.max(1),
        samples: format.samples.clamp(1, 4),
    };
    let n = format.samples;
    let bounds = scene.bounds();
    let lens = camera.aim(bounds, format.width * n, format.height * n);
    let drawable = |s: &&Sphere| s.centre.is_finite() && s.radius.is_finite() && s.radius > 0.0;
    let spheres: Vec<Sphere> = scene.spheres.iter().filter(drawable).copied().collect();
    let stage = shade::Stage::new(scene, &spheres, &lens, bounds);
    let discs = raster::discs(&spheres, &lens);

    // Bands of whole pixel rows, small enough to share out evenly.
    let rows = 16;
    let mut pixels = vec![0_u8; 3 * format.width * format.height];
    pixels.par_chunks_mut(3 * format.width * rows).enumerate().for_each(|(band, out)| {
        let first = band * rows * n;
        let mut samples = raster::Band::new(format.width * n, first, out.len() / (3 * format.width) * n);
        samples.draw(&discs, &spheres, &lens);
        let mut light = stage.light(&samples, n);
        overlay::draw(scene, &lens, &samples, &mut light);
        develop(&light, format.width, n, out);
    });
    crate::png::rgb(format.width, format.height, &pixels)
}

/// Averages samples to pixels and turns light into display values.
fn develop(light: &[Rgb], width: usize, n: usize, out: &mut [u8]) {
    for (k, pixel) in out.chunks_exact_mut(3).enumerate() {
        let (row, column) = (k / width, k % width);
        let mut sum = [0.0; 3];
        for j in 0..n {
            let start = (row * n + j) * width * n + column * n;
            light[start..start + n].iter().for_each(|c| (0..3).for_each(|i| sum[i] += c[i]));
        }
        let mean = sum.map(|c| colour::from_linear((c / (n * n) as f64).clamp(0.0, 1.0)));
        pixel.copy_from_slice(&colour::to_bytes(mean));
    }
}

#[cfg(test)]
mod tests;

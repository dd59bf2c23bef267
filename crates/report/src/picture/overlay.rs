//! Edges of the cell and arrows: lines of constant width over the grains.

use super::Scene;
use super::camera::Lens;
use super::raster::Band;
use crate::colour::{Rgb, to_linear};
use brazilnut_base::{Vec3, vec3};

const INK: Rgb = [0.16, 0.19, 0.23];

/// Draws the outline of the cell and all arrows on the light of a band.
pub(crate) fn draw(scene: &Scene, lens: &Lens, band: &Band, light: &mut [Rgb]) {
    let scale = (band.width as f64 / 1800.0).max(0.4);
    if let Some((low, high)) = scene.cell {
        let lid = |a: Vec3, b: Vec3| scene.open_top && a.z == high.z && b.z == high.z;
        for (a, b) in edges(low, high).filter(|(a, b)| !lid(*a, *b)) {
            let line =
                Line { a: lens.project(a), b: lens.project(b), half: 1.15 * scale, front: 0.85, behind: 0.0 };
            line.draw(band, light, INK.map(to_linear));
        }
    }
    for arrow in &scene.arrows {
        let (a, b) = (lens.project(arrow.from), lens.project(arrow.to));
        let length = (b[0] - a[0]).hypot(b[1] - a[1]);
        if length < 1.0 || !length.is_finite() {
            continue;
        }
        // A pale rim first, so that the arrow stands out from grains of any colour.
        for (rim, colour) in [(1.6 * scale, [1.0; 3]), (0.0, arrow.colour)] {
            pointed(a, b, length, 2.4 * scale, rim, band, light, colour.map(to_linear));
        }
    }
}

/// The twelve edges of a box.
fn edges(low: Vec3, high: Vec3) -> impl Iterator<Item = (Vec3, Vec3)> {
    let corner = move |k: usize| {
        vec3(
            if k & 1 == 0 { low.x } else { high.x },
            if k & 2 == 0 { low.y } else { high.y },
            if k & 4 == 0 { low.z } else { high.z },
        )
    };
    (0..8_usize).flat_map(move |k| {
        [1, 2, 4].into_iter().filter(move |bit| k & bit == 0).map(move |bit| (corner(k), corner(k | bit)))
    })
}

/// A straight line on the picture, with depth.
struct Line {
    a: [f64; 3],
    b: [f64; 3],
    half: f64,
    front: f64,
    behind: f64,
}

impl Line {
    fn draw(&self, band: &Band, light: &mut [Rgb], colour: Rgb) {
        let (ux, uy) = (self.b[0] - self.a[0], self.b[1] - self.a[1]);
        let length2 = (ux * ux + uy * uy).max(1e-12);
        let reach = self.half + 1.0;
        cover(band, light, colour, [self.a, self.b], reach, |x, y, depth| {
            let t = (((x - self.a[0]) * ux + (y - self.a[1]) * uy) / length2).clamp(0.0, 1.0);
            let off = (x - self.a[0] - t * ux).hypot(y - self.a[1] - t * uy);
            let own = self.a[2] + t * (self.b[2] - self.a[2]);
            let strength = if own <= depth { self.front } else { self.behind };
            strength * (self.half + 0.5 - off).clamp(0.0, 1.0)
        });
    }
}

/// An arrow from `a` to `b` with a head, widened by `rim`.
fn pointed(
    a: [f64; 3],
    b: [f64; 3],
    length: f64,
    half: f64,
    rim: f64,
    band: &Band,
    light: &mut [Rgb],
    colour: Rgb,
) {
    let (ux, uy) = ((b[0] - a[0]) / length, (b[1] - a[1]) / length);
    let head = (5.5 * half).min(0.5 * length);
    let width = 0.45 * head;
    let shaft = half.min(0.45 * width);
    cover(band, light, colour, [a, b], width + rim + 1.0, |x, y, _| {
        let (along, across) = ((x - a[0]) * ux + (y - a[1]) * uy, ((y - a[1]) * ux - (x - a[0]) * uy).abs());
        let outside_shaft = (across - shaft).max(-along).max(along - (length - 0.5 * head));
        // Distance to the slanted side of the head; its sine and cosine follow from its shape.
        let (s, c) = (width / head.hypot(width), head / head.hypot(width));
        let outside_head = (across * c + (along - length) * s).max(length - head - along);
        (rim + 0.5 - outside_shaft.min(outside_head)).clamp(0.0, 1.0)
    });
}

/// Blends `colour` over all samples near the segment by `strength(x, y, depth of what is seen)`.
fn cover(
    band: &Band,
    light: &mut [Rgb],
    colour: Rgb,
    ends: [[f64; 3]; 2],
    reach: f64,
    strength: impl Fn(f64, f64, f64) -> f64,
) {
    let clamp = |v: f64, a: usize, b: usize| v.clamp(a as f64, b as f64) as usize;
    let bounds = |i: usize, a: usize, b: usize| {
        let (low, high) = (ends[0][i].min(ends[1][i]) - reach, ends[0][i].max(ends[1][i]) + reach);
        clamp(low.floor(), a, b)..clamp(high.ceil(), a, b)
    };
    for row in bounds(1, band.first, band.first + band.rows) {
        for column in bounds(0, 0, band.width) {
            let k = (row - band.first) * band.width + column;
            let f = strength(column as f64 + 0.5, row as f64 + 0.5, f64::from(band.depth[k]));
            if f > 0.0 {
                (0..3).for_each(|i| light[k][i] += f * (colour[i] - light[k][i]));
            }
        }
    }
}

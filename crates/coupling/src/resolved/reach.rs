//! How the tracers of one part reach the faces around them.
//!
//! Away from the ends of the line axis the weights of a point lie in rows of
//! memory. The tracers of a lattice, moreover, all lie alike in their cells:
//! the weights of the centre are those of every tracer, and a run of
//! neighbours shares the rows of faces that it reads and writes.

use super::schedule::Window;
use super::tracers::{Batch, LANES, Part, Wide};
use crate::transfer::{Kernel, Seat, Stagger};
use brazilnut_base::{Vec3, vec3};
use brazilnut_fluid::Faces;

/// The way to the faces.
pub(super) struct Reach<'a, K, const W: usize> {
    stagger: &'a Stagger,
    kernel: K,
    centre: Vec3,
    low: Vec3,
    high: Vec3,
    way: Way<W>,
}

enum Way<const W: usize> {
    /// Runs of a lattice with the weights of the centre.
    Runs(Seat<W>),
    /// Each tracer has weights of its own, in rows.
    Rows,
    /// Some weights meet an end of the line axis.
    Tables,
}

/// Evaluates an expression with `L` the number of faces in a row that `len` tracers share, rounded up to even.
macro_rules! with_row {
    ($len:expr, $w:expr, $l:ident => $body:expr) => {
        match ($len + $w) / 2 {
            ..=1 => {
                const $l: usize = 2;
                $body
            }
            2 => {
                const $l: usize = 4;
                $body
            }
            3 => {
                const $l: usize = 6;
                $body
            }
            4 => {
                const $l: usize = 8;
                $body
            }
            _ => {
                const $l: usize = 10;
                $body
            }
        }
    };
}

impl<'a, K: Kernel<W>, const W: usize> Reach<'a, K, W> {
    /// For a part of a template of the given scale around `centre` (m).
    #[inline(always)]
    pub fn new(
        stagger: &'a Stagger,
        kernel: K,
        centre: Vec3,
        scale: f64,
        lattice: bool,
        part: &Part,
    ) -> Self {
        let (low, high) = (centre + scale * part.low, centre + scale * part.high);
        let way = if !stagger.is_free::<W>(low, high) {
            Way::Tables
        } else if lattice {
            Way::Runs(stagger.seat(kernel, centre))
        } else {
            Way::Rows
        };
        Self { stagger, kernel, centre, low, high, way }
    }

    /// Brings the faces that the part reads into the cache.
    #[inline(always)]
    pub fn fetch(&self, field: &Faces) {
        for c in self.components() {
            self.stagger.fetch(self.low, self.high, field.component(c), 0);
        }
    }

    /// Brings the faces that the part writes into the cache.
    #[inline(always)]
    pub fn fetch_window(&self, window: &Window<'_>) {
        for c in self.components() {
            self.stagger.fetch(self.low, self.high, window.components[c], window.start);
        }
    }

    /// `field` at the tracers of `batch`.
    #[inline(always)]
    pub fn read(&self, batch: &Batch, arms: &Wide, field: &Faces) -> Wide {
        let mut out = [[0.0; LANES]; 3];
        match &self.way {
            Way::Runs(seat) => {
                for c in self.components() {
                    let (stencil, field) = (self.stagger.stencil(seat, c, batch.at), field.component(c));
                    with_row!(batch.len, W, L => copy(&stencil.gather::<L>(field), &mut out[c]));
                }
            }
            Way::Rows => {
                for t in 0..batch.len {
                    let seat = self.stagger.seat(self.kernel, self.at(arms, t));
                    for c in self.components() {
                        let stencil = self.stagger.stencil(&seat, c, [0; 3]);
                        out[c][t] = stencil.gather::<W>(field.component(c))[0];
                    }
                }
            }
            Way::Tables => {
                for t in 0..batch.len {
                    let v =
                        self.stagger.interpolate(&self.stagger.seat(self.kernel, self.at(arms, t)), field);
                    for c in 0..3 {
                        out[c][t] = v[c];
                    }
                }
            }
        }
        out
    }

    /// Adds `amounts`, zero beyond the tracers of `batch`, around them.
    #[inline(always)]
    pub fn write(&self, batch: &Batch, arms: &Wide, amounts: &Wide, window: &mut Window<'_>) {
        let start = window.start;
        match &self.way {
            Way::Runs(seat) => {
                for c in self.components() {
                    let stencil = self.stagger.stencil(seat, c, batch.at);
                    let field = &mut *window.components[c];
                    with_row!(batch.len, W, L => {
                        let mut row = [0.0; L];
                        copy(&amounts[c], &mut row);
                        stencil.scatter::<L>(&row, field, start);
                    });
                }
            }
            Way::Rows => {
                for t in 0..batch.len {
                    let seat = self.stagger.seat(self.kernel, self.at(arms, t));
                    for c in self.components() {
                        let stencil = self.stagger.stencil(&seat, c, [0; 3]);
                        let mut row = [0.0; W];
                        row[0] = amounts[c][t];
                        stencil.scatter::<W>(&row, window.components[c], start);
                    }
                }
            }
            Way::Tables => {
                for t in 0..batch.len {
                    let seat = self.stagger.seat(self.kernel, self.at(arms, t));
                    for c in self.components() {
                        self.stagger.scatter(&seat, c, amounts[c][t], window.components[c], start);
                    }
                }
            }
        }
    }

    #[inline(always)]
    fn at(&self, arms: &Wide, t: usize) -> Vec3 {
        self.centre + vec3(arms[0][t], arms[1][t], arms[2][t])
    }

    #[inline(always)]
    fn components(&self) -> impl Iterator<Item = usize> {
        (0..3).filter(|c| !self.stagger.is_flat(*c))
    }
}

/// As much of `from` as both hold.
#[inline(always)]
fn copy(from: &[f64], to: &mut [f64]) {
    let n = from.len().min(to.len());
    to[..n].copy_from_slice(&from[..n]);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::Body;
    use crate::resolved::tracers::{Layout, Templates};
    use crate::transfer::{Roma, Trilinear};
    use brazilnut_base::Side;
    use brazilnut_fluid::Grid;

    /// Straight rows are a faster way to the same sums.
    fn all_ways_lead_to_the_same_faces<const W: usize>(kernel: impl Kernel<W>, grid: &Grid, body: Body) {
        let stagger = Stagger::new(grid, 12);
        let mut field = Faces::new(grid);
        for c in 0..3 {
            for (k, v) in field.component_mut(c).iter_mut().enumerate() {
                *v = ((k * 7919 + c) % 101) as f64 - 50.0;
            }
        }
        let middle = 0.5 * grid.size() + vec3(0.137, 0.249, -0.411);
        let line = grid.memory_order()[0];
        for layout in Layout::ALL {
            for radius in [2.0, 3.0, 5.3] {
                let templates = Templates::new(grid, body, &[radius], layout, 0.4);
                let (template, scale) = templates.fit(0);
                // In the middle, and with sides or images within reach.
                let mut corner = vec3(0.3, 0.4, 0.2) + radius;
                corner[line] = middle[line];
                for (centre, part) in
                    [middle, corner].into_iter().flat_map(|x| template.parts.iter().map(move |p| (x, p)))
                {
                    let quick = Reach::new(&stagger, kernel, centre, scale, template.lattice, part);
                    let plain = Reach {
                        way: Way::Tables,
                        ..Reach::new(&stagger, kernel, centre, scale, false, part)
                    };
                    assert!(
                        !matches!(quick.way, Way::Tables),
                        "the body lies away from the ends of the line axis"
                    );
                    let (mut a, mut b) = (Faces::new(grid), Faces::new(grid));
                    for batch in &template.batches[part.batches[0]..part.batches[1]] {
                        let arms = batch.arm.map(|x| x.map(|x| scale * x));
                        let (v, w) = (quick.read(batch, &arms, &field), plain.read(batch, &arms, &field));
                        for c in 0..3 {
                            for t in 0..batch.len {
                                // Rounding of 27 products of order 50.
                                assert!((v[c][t] - w[c][t]).abs() < 1e-11, "{layout:?} {radius}");
                            }
                        }
                        let amounts = w.map(|w| std::array::from_fn(|t| batch.mask[t] * w[t]));
                        for (reach, field) in [(&quick, &mut a), (&plain, &mut b)] {
                            let Faces { x, y, z } = field;
                            let components = [&mut x.values[..], &mut y.values[..], &mut z.values[..]];
                            reach.write(batch, &arms, &amounts, &mut Window { start: 0, components });
                        }
                    }
                    for c in 0..3 {
                        for (a, b) in a.component(c).iter().zip(b.component(c)) {
                            // Rounding of some ten contributions of order 50.
                            assert!((a - b).abs() < 1e-10, "{layout:?} {radius}");
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn spheres() {
        let grid = Grid::new([20, 18, 22], [1.0; 3], [Side::Walls, Side::Periodic, Side::Walls]);
        all_ways_lead_to_the_same_faces(Trilinear, &grid, Body::Sphere);
        all_ways_lead_to_the_same_faces(Roma, &grid, Body::Sphere);
    }

    #[test]
    fn cylinders() {
        let grid = Grid::new([20, 1, 22], [1.0; 3], [Side::Periodic, Side::Flat, Side::Walls]);
        let body = Body::Cylinder { length: 1.0 };
        all_ways_lead_to_the_same_faces(Trilinear, &grid, body);
        all_ways_lead_to_the_same_faces(Roma, &grid, body);
    }
}

//! The prediction: velocity at the end of the step without the new pressure.
//!
//! ```text
//! first order:  v* = v + dt R_n                                           (Clément 2.33)
//! second order: v* = v + dt [(1 + w) R_n - w R_{n-1}] - dt grad p_n,  w = dt / (2 dt_{n-1})
//! ```

use super::advection::{Central, Factors, Flux, Koren, Still};
use super::rates::row_rates;
use crate::lanes::{Kernel, Lanes, Path, dispatch};
use crate::parallel::Scratch;
use crate::shape::Shape;
use crate::spec::Advection;
use rayon::prelude::*;

/// Blocks of planes that a sweep is cut into.
const BLOCKS: usize = 32;

/// What a prediction needs to know besides the fields.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Recipe {
    pub advection: Advection,
    /// 1 / (4 h) and nu / h² of each level.
    pub factors: [Factors; 3],
    /// Uniform acceleration of each level's component, m/s².
    pub body: [f64; 3],
    /// Weights of the new rate and of the remembered one, s.
    pub weights: [f64; 2],
    /// dt / (rho h) of each level for the known pressure, zero where it plays no part.
    pub pressure: [f64; 3],
    /// Length of the step if diffusion is kept apart from the extrapolated rates, s; else zero.
    pub apart: f64,
    /// The open end of level 0 whose last face is predicted too.
    pub open_end: bool,
}

/// The fields of one block of planes.
#[derive(Default)]
struct Block<'a> {
    star: [&'a mut [f64]; 3],
    past: [&'a mut [f64]; 3],
}

/// Writes v* to `star` and, if there is one, the new rate to `past`.
pub(crate) fn predict(
    path: Path,
    parallel: bool,
    shape: &Shape,
    recipe: &Recipe,
    v: [&[f64]; 3],
    p: &[f64],
    star: [&mut [f64]; 3],
    past: Option<[&mut [f64]; 3]>,
) {
    let per_block = shape.n[2].div_ceil(BLOCKS);
    let mut blocks: [Block<'_>; BLOCKS] = Default::default();
    for (c, field) in star.into_iter().enumerate() {
        let chunks = field[shape.interior()].chunks_mut(per_block * shape.plane);
        chunks.zip(&mut blocks).for_each(|(chunk, block)| block.star[c] = chunk);
    }
    for (c, field) in past.into_iter().flatten().enumerate() {
        let chunks = field[shape.interior()].chunks_mut(per_block * shape.plane);
        chunks.zip(&mut blocks).for_each(|(chunk, block)| block.past[c] = chunk);
    }
    let count = shape.n[2].div_ceil(per_block);
    let work = |(b, block): (usize, &mut Block<'_>)| {
        dispatch(path, Predict { shape, recipe, v, p, block, first: b * per_block });
    };
    if parallel {
        blocks[..count].par_iter_mut().enumerate().for_each(work);
    } else {
        blocks[..count].iter_mut().enumerate().for_each(work);
    }
}

struct Predict<'a, 'b> {
    shape: &'a Shape,
    recipe: &'a Recipe,
    v: [&'a [f64]; 3],
    p: &'a [f64],
    block: &'a mut Block<'b>,
    first: usize,
}

impl Kernel for Predict<'_, '_> {
    #[inline(always)]
    fn run<const W: usize, const F: bool>(self, l: Lanes<W, F>) {
        match self.recipe.advection {
            Advection::Central => self.sweep(l, Central),
            Advection::Koren => self.sweep(l, Koren),
            Advection::None => self.sweep(l, Still),
        }
    }
}

impl Predict<'_, '_> {
    #[inline(always)]
    fn sweep<const W: usize, const F: bool>(mut self, l: Lanes<W, F>, flux: impl Flux) {
        let (shape, n) = (self.shape, self.shape.n);
        let base = (shape.ghosts(2) + self.first) * shape.plane;
        let planes = self.block.star[0].len() / shape.plane;
        let mut scratch = Scratch::take(n[0]);
        for k in self.first..self.first + planes {
            for j in 0..n[1] {
                let p = shape.row(j, k);
                for c in 0..3 {
                    if shape.stride[c] == 0 {
                        continue;
                    }
                    let out = p - base;
                    if shape.walled(c) && [1, j, k][c] == 0 {
                        self.block.star[c][out..out + n[0]].fill(0.0);
                        continue;
                    }
                    self.row(l, flux, c, p, out, scratch.as_mut());
                }
                if self.recipe.open_end {
                    self.row(l, Central, 0, p + n[0], p + n[0] - base, &mut [0.0]);
                }
            }
        }
    }

    /// The points of component `c` from place `p` on, as many as `rate` is long.
    #[inline(always)]
    fn row<const W: usize, const F: bool>(
        &mut self,
        l: Lanes<W, F>,
        flux: impl Flux,
        c: usize,
        p: usize,
        out: usize,
        rate: &mut [f64],
    ) {
        let (shape, recipe, n) = (self.shape, self.recipe, rate.len());
        let kept = if recipe.apart > 0.0 { &advection_only(&recipe.factors) } else { &recipe.factors };
        row_rates(l, flux, self.v, shape, c, p, kept, recipe.body[c], rate);
        let [a, b] = recipe.weights;
        let v = &self.v[c][p..p + n];
        let star = &mut self.block.star[c][out..out + n];
        if self.block.past[c].is_empty() {
            for i in 0..n {
                star[i] = l.madd(a, rate[i], v[i]);
            }
        } else {
            let past = &mut self.block.past[c][out..out + n];
            let (ahead, behind) = (&self.p[p..p + n], &self.p[p - shape.stride[c]..][..n]);
            let q = recipe.pressure[c];
            for i in 0..n {
                let pushed = l.madd(-q, ahead[i] - behind[i], v[i]);
                star[i] = l.madd(a, rate[i], l.madd(-b, past[i], pushed));
                past[i] = rate[i];
            }
        }
        if recipe.apart > 0.0 {
            row_rates(l, Still, self.v, shape, c, p, &recipe.factors, 0.0, rate);
            for i in 0..n {
                star[i] = l.madd(recipe.apart, rate[i], star[i]);
            }
        }
    }
}

/// The factors without viscosity.
fn advection_only(factors: &[Factors; 3]) -> [Factors; 3] {
    factors.map(|f| Factors { diffusion: 0.0, ..f })
}

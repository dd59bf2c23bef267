//! Real transforms along one direction of a block of rows: cosine where there
//! are walls, Fourier where it is periodic. They diagonalise the second
//! difference with zero slope half a cell beyond both ends, or with period n.
//!
//! Two lines ride in one complex transform of the same length: with Z the
//! transform of a + i b, the spectra follow from Z_k and Z_{n-k} (Makhoul 1980).
//!
//! ```text
//! cosine:  X_k = sum_i x_i cos(pi k (i + 1/2) / n)
//! Fourier: X_k = Re, X_{n-k} = -Im of sum_i x_i exp(-2 pi i k i / n)
//! ```

use super::fft::{Plan, Stage, with_radix};
use super::panel::{JoinSpectra, Load, Panel, PartSpectra, Store};
use super::poisson::Direction;
use super::rows::Rows;
use crate::lanes::{Path, dispatch};
use crate::parallel::Scratch;
use std::f64::consts::PI;

/// Which transform a direction takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// Walls at both ends.
    Cosine,
    /// Periodic.
    Fourier,
}

/// A transform of lines of one length, many lines at once.
///
/// The first stage of the complex transform reads from memory and the last writes to it, joined with the sums
/// that lead from the spectrum of two lines to each: other passes over the panel of lines at hand would cost as
/// much as its stages.
#[derive(Clone, Debug)]
pub(crate) struct Transform {
    /// Points of a line.
    pub length: usize,
    /// Ends with a stage whose butterflies are taken in pairs.
    forward: Plan,
    /// Starts with such a stage.
    inverse: Plan,
    /// Which point of the line stands at each place of the complex input of the forward transform.
    pub source: Vec<usize>,
    /// Which point of the line the inverse leaves at each place.
    pub point: Vec<usize>,
    /// The first butterflies of the inverse in pairs: the least number in the first, its place, and that of the other.
    pub pairs: Vec<[usize; 3]>,
    /// cos and sin of the half-sample shift of number k, 0 <= k <= n / 2.
    pub shift: Vec<[f64; 2]>,
}

/// Eigenvalue of the second difference for number `k` of `n`, in units of 1/h².
#[must_use]
pub fn eigenvalue(family: Family, k: usize, n: usize) -> f64 {
    let half_angle = match family {
        Family::Cosine => PI * k as f64 / (2 * n) as f64,
        Family::Fourier => PI * k as f64 / n as f64,
    };
    -4.0 * half_angle.sin().powi(2)
}

impl Transform {
    /// The transform of `length` points, all of whose prime factors are small.
    pub fn new(family: Family, length: usize) -> Self {
        let (forward, inverse) = (Plan::new(length, false), Plan::new(length, true));
        let reorder = |i: usize| match family {
            Family::Fourier => i,
            Family::Cosine if 2 * i < length => 2 * i,
            Family::Cosine => 2 * (length - i) - 1,
        };
        let source = forward.source.iter().map(|&i| reorder(i)).collect();
        let point = (0..length).map(reorder).collect();
        // A butterfly holds every `apart`th number from its least one on; n - k is in the one from `apart - k` on.
        let radix = inverse.stages[0].radix;
        let apart = length / radix;
        let mut place = vec![0; apart];
        for (block, at) in inverse.source.chunks_exact(radix).enumerate() {
            place[at[0]] = block * radix;
        }
        let pairs = (0..=apart / 2).map(|k| [k, place[k], place[(apart - k) % apart]]).collect();
        let shift = (0..=length / 2)
            .map(|k| match family {
                Family::Fourier => [1.0, 0.0],
                Family::Cosine => {
                    let (s, c) = (PI * k as f64 / (2 * length) as f64).sin_cos();
                    [c, s]
                }
            })
            .collect();
        Self { length, forward, inverse, source, point, pairs, shift }
    }

    /// Transforms the first `width` columns, a multiple of eight, in place; the inverse leaves `length` times
    /// what the forward transform was given.
    ///
    /// Each stage is entered through [`dispatch`], so that it is compiled as a function of its own.
    pub fn run(&self, path: Path, rows: &mut Rows<'_>, width: usize, direction: Direction) {
        let panel = 2 * path.lanes();
        let mut scratch = Scratch::take(panel * self.length);
        for column in (0..width).step_by(panel) {
            let z = scratch.as_mut();
            match (direction, column + panel > width) {
                (Direction::Forward, false) => self.forward::<false>(path, rows, column, z),
                (Direction::Forward, true) => self.forward::<true>(path, rows, column, z),
                (Direction::Inverse, false) => self.inverse::<false>(path, rows, column, z),
                (Direction::Inverse, true) => self.inverse::<true>(path, rows, column, z),
            }
        }
    }

    fn forward<const HALF: bool>(&self, path: Path, rows: &mut Rows<'_>, column: usize, z: &mut [f64]) {
        let [first, middle @ .., last] = &self.forward.stages[..] else { return };
        let load = self.panel(first, rows, column, z);
        with_radix!(first.radix, [1 2 3 4 5 8], R => dispatch(path, Load::<R, HALF>(load)));
        middle.iter().for_each(|s| s.run(path, z));
        let part = self.panel(last, rows, column, z);
        with_radix!(last.radix, [1 2 3 4 5], R => dispatch(path, PartSpectra::<R, HALF>(part)));
    }

    fn inverse<const HALF: bool>(&self, path: Path, rows: &mut Rows<'_>, column: usize, z: &mut [f64]) {
        let [first, middle @ .., last] = &self.inverse.stages[..] else { return };
        let join = self.panel(first, rows, column, z);
        with_radix!(first.radix, [1 2 3 4 5], R => dispatch(path, JoinSpectra::<R, HALF>(join)));
        middle.iter().for_each(|s| s.run(path, z));
        let store = self.panel(last, rows, column, z);
        with_radix!(last.radix, [1 2 3 4 5 8], R => dispatch(path, Store::<R, HALF>(store)));
    }

    fn panel<'a, 'b>(
        &'a self,
        stage: &'a Stage,
        rows: &'a mut Rows<'b>,
        column: usize,
        z: &'a mut [f64],
    ) -> Panel<'a, 'b> {
        Panel { transform: self, stage, rows, column, z }
    }
}

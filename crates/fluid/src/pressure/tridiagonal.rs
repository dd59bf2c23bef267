//! The direction without a transform: many tridiagonal systems of constant
//! coefficients, lanes across systems.
//!
//! ```text
//! b x_i - x_{i-1} - x_{i+1} = g_i,   b >= 2
//! ```
//!
//! by elimination (Thomas), or, where the direction is periodic, by the two
//! one-sided recurrences with `r + 1/r = b` that the system factors into.

use super::rows::Rows;
use crate::lanes::Lanes;

/// What the end of a line adds to its diagonal element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum End {
    /// No slope at the wall, half a cell from the last centre: -1.
    Slope,
    /// Zero at the wall, half a cell from the last centre: +1.
    Value,
    /// Zero one spacing beyond the last point: 0.
    Fixed,
    /// The line closes on itself.
    Periodic,
}

impl End {
    pub fn diagonal(self) -> f64 {
        match self {
            Self::Slope => -1.0,
            Self::Value => 1.0,
            Self::Fixed | Self::Periodic => 0.0,
        }
    }
}

/// Lines of `n` points between two ends.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lines {
    pub n: usize,
    pub ends: [End; 2],
}

/// Elements after which the elimination of a diagonal `b` no longer changes
/// beyond rounding: its factors approach r, with r + 1/r = b, as r^(2 i).
fn settled_after(b: f64) -> usize {
    let r = decay(b);
    if r > 0.999_999 {
        usize::MAX
    } else {
        (54.0 * -std::f64::consts::LN_2 / (2.0 * r.ln())).ceil() as usize + 2
    }
}

/// The root r <= 1 of r + 1/r = b.
pub(crate) fn decay(b: f64) -> f64 {
    2.0 / (b + ((b - 2.0) * (b + 2.0)).max(0.0).sqrt())
}

impl Lines {
    /// Scratch numbers that [`Self::solve`] needs for so many lines at once.
    pub fn scratch(&self, lines: usize) -> usize {
        2 * self.n.next_multiple_of(8) * lines
    }

    /// Solves the rows `first..first + G W` of `rows` in place, for right sides
    /// scaled by `scale` and one diagonal each.
    ///
    /// A recurrence waits for its own last number: with two groups of lanes one works while the other waits.
    #[inline(always)]
    pub fn solve<const G: usize, const W: usize, const F: bool>(
        &self,
        l: Lanes<W, F>,
        rows: &mut Rows<'_>,
        first: usize,
        diagonal: [[f64; W]; G],
        scale: f64,
        scratch: &mut [f64],
    ) {
        let padded = self.n.next_multiple_of(8);
        let (g, c) = scratch.split_at_mut(padded * G * W);
        let g = g.as_chunks_mut::<W>().0.as_chunks_mut::<G>().0;
        let c = c.as_chunks_mut::<W>().0.as_chunks_mut::<G>().0;
        for i in (0..self.n).step_by(W) {
            for group in 0..G {
                let block = l.gather(rows, first + group * W, i);
                for (column, g) in block.into_iter().zip(&mut g[i..i + W]) {
                    g[group] = column;
                }
            }
        }
        let whole = self.n / W * W;
        let (used, c) = (&mut g[..self.n], &mut c[..self.n]);
        if self.ends[0] == End::Periodic {
            self.cyclic(l, used, diagonal, scale);
        } else {
            self.eliminate(l, used, c, diagonal, scale);
        }
        for i in (0..whole).step_by(W) {
            for group in 0..G {
                let mut block = [[0.0; W]; W];
                for (column, g) in block.iter_mut().zip(&g[i..i + W]) {
                    *column = g[group];
                }
                l.scatter(rows, first + group * W, i, block);
            }
        }
        // The last block reaches into the padding of the row, which carries no meaning.
        for line in 0..G * W {
            let row = &mut rows.row_mut(first + line)[whole..self.n];
            for (x, g) in row.iter_mut().zip(&g[whole..self.n]) {
                *x = g[line / W][line % W];
            }
        }
    }

    #[inline(always)]
    fn eliminate<const G: usize, const W: usize, const F: bool>(
        &self,
        l: Lanes<W, F>,
        g: &mut [[[f64; W]; G]],
        c: &mut [[[f64; W]; G]],
        b: [[f64; W]; G],
        scale: f64,
    ) {
        let n = self.n;
        let smallest = b.as_flattened().iter().copied().fold(f64::INFINITY, f64::min);
        let settle = settled_after(smallest).min(n.saturating_sub(1)).max(1);
        let [low, high] = self.ends.map(End::diagonal);
        if n == 1 {
            for (g, b) in g[0].as_flattened_mut().iter_mut().zip(b.as_flattened()) {
                let d = b + low + high;
                *g *= if d == 0.0 { 0.0 } else { scale / d };
            }
            return;
        }
        let s = [scale; W];
        let one = [1.0; W];
        let (mut factor, mut y) = ([[0.0; W]; G], [[0.0; W]; G]);
        for k in 0..G {
            factor[k] = l.div(one, l.add(b[k], [low; W]));
            y[k] = l.mul(l.mul(g[0][k], s), factor[k]);
        }
        (g[0], c[0]) = (y, factor);
        for i in 1..settle {
            for k in 0..G {
                factor[k] = l.div(one, l.sub(b[k], factor[k]));
                y[k] = l.mul(l.vmadd(g[i][k], s, y[k]), factor[k]);
            }
            (g[i], c[i]) = (y, factor);
        }
        let mut scaled = factor;
        for k in 0..G {
            scaled[k] = l.mul(factor[k], s);
        }
        for g in &mut g[settle..n - 1] {
            for k in 0..G {
                y[k] = l.vmadd(factor[k], y[k], l.mul(g[k], scaled[k]));
            }
            *g = y;
        }
        if n > 1 {
            for k in 0..G {
                // A singular system (b = 2, no slope at both ends) gets zero at its last point.
                let mut last = [0.0; W];
                for lane in 0..W {
                    let d = b[k][lane] + high - factor[k][lane];
                    last[lane] = if d == 0.0 { 0.0 } else { 1.0 / d };
                }
                y[k] = l.mul(l.vmadd(g[n - 1][k], s, y[k]), last);
            }
            g[n - 1] = y;
        }
        for g in g[settle..n - 1].iter_mut().rev() {
            for k in 0..G {
                y[k] = l.vmadd(factor[k], y[k], g[k]);
            }
            *g = y;
        }
        for (g, c) in g[..settle.min(n - 1)].iter_mut().zip(&*c).rev() {
            for k in 0..G {
                y[k] = l.vmadd(c[k], y[k], g[k]);
            }
            *g = y;
        }
    }

    #[inline(always)]
    fn cyclic<const G: usize, const W: usize, const F: bool>(
        &self,
        l: Lanes<W, F>,
        g: &mut [[[f64; W]; G]],
        b: [[f64; W]; G],
        scale: f64,
    ) {
        let n = self.n;
        let (mut r, mut closing, mut scaled) = ([[0.0; W]; G], [[0.0; W]; G], [[0.0; W]; G]);
        for k in 0..G {
            for lane in 0..W {
                r[k][lane] = decay(b[k][lane]);
                // 1 / (1 - r^n); the singular system has no closed solution and is done apart.
                let gap = 1.0 - r[k][lane].powi(n as i32);
                closing[k][lane] = if gap == 0.0 { 0.0 } else { 1.0 / gap };
            }
            scaled[k] = l.mul(r[k], [scale; W]);
        }
        let mut y = [[0.0; W]; G];
        for g in g.iter() {
            for k in 0..G {
                y[k] = l.vmadd(r[k], y[k], g[k]);
            }
        }
        for k in 0..G {
            y[k] = l.mul(y[k], closing[k]);
        }
        for g in g.iter_mut() {
            for k in 0..G {
                y[k] = l.vmadd(r[k], y[k], g[k]);
            }
            *g = y;
        }
        let mut x = [[0.0; W]; G];
        for g in g.iter().rev() {
            for k in 0..G {
                x[k] = l.vmadd(r[k], x[k], l.mul(scaled[k], g[k]));
            }
        }
        for k in 0..G {
            x[k] = l.mul(x[k], closing[k]);
        }
        for g in g.iter_mut().rev() {
            for k in 0..G {
                x[k] = l.vmadd(r[k], x[k], l.mul(scaled[k], g[k]));
            }
            *g = x;
        }
    }
}

/// Solves the singular periodic system `2 x_i - x_{i-1} - x_{i+1} = g_i` for g
/// without mean, in place, with a mean of zero.
pub(crate) fn solve_closed_singular(g: &mut [f64]) {
    let n = g.len();
    remove_mean(g);
    // q_i = x_i - x_{i-1} falls by g_i at each point; x then sums q, whose own mean must vanish.
    let mut q = 0.0;
    for g in g.iter_mut() {
        let next = q - *g;
        *g = q;
        q = next;
    }
    remove_mean(g);
    let mut x = 0.0;
    for g in g.iter_mut() {
        x += *g;
        *g = x;
    }
    debug_assert_eq!(n, g.len());
    remove_mean(g);
}

/// Subtracts the mean.
pub(crate) fn remove_mean(x: &mut [f64]) {
    let mean = brazilnut_base::parallel::sum(x.iter().copied()) / x.len() as f64;
    for x in x {
        *x -= mean;
    }
}

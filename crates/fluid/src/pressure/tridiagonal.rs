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
    /// Scratch numbers that [`Self::solve`] needs with `W` lanes.
    pub fn scratch(&self, lanes: usize) -> usize {
        2 * self.n.next_multiple_of(8) * lanes
    }

    /// Solves the rows `first..first + W` of `rows` in place, for right sides
    /// scaled by `scale` and one diagonal each.
    #[inline(always)]
    pub fn solve<const W: usize, const F: bool>(
        &self,
        l: Lanes<W, F>,
        rows: &mut impl Rows,
        first: usize,
        diagonal: [f64; W],
        scale: f64,
        scratch: &mut [f64],
    ) {
        let padded = self.n.next_multiple_of(8);
        let (g, c) = scratch.split_at_mut(padded * W);
        let mut i = 0;
        while i < self.n {
            l.gather(rows, first, i, &mut g[i * W..(i + W) * W]);
            i += W;
        }
        let (g, c) = (&mut g.as_chunks_mut::<W>().0[..self.n], &mut c.as_chunks_mut::<W>().0[..self.n]);
        if self.ends[0] == End::Periodic {
            self.cyclic(l, g, diagonal, scale);
        } else {
            self.eliminate(l, g, c, diagonal, scale);
        }
        let g = g.as_flattened();
        // The last block reaches into the padding of the row, which carries no meaning.
        let (whole, rest) = (self.n / W * W, self.n % W);
        let mut i = 0;
        while i < whole {
            l.scatter(rows, first, i, &g[i * W..(i + W) * W]);
            i += W;
        }
        for lane in 0..W {
            let row = &mut rows.row_mut(first + lane)[whole..whole + rest];
            for (i, x) in row.iter_mut().enumerate() {
                *x = g[(whole + i) * W + lane];
            }
        }
    }

    #[inline(always)]
    fn eliminate<const W: usize, const F: bool>(
        &self,
        l: Lanes<W, F>,
        g: &mut [[f64; W]],
        c: &mut [[f64; W]],
        b: [f64; W],
        scale: f64,
    ) {
        let n = self.n;
        let smallest = b.iter().copied().fold(f64::INFINITY, f64::min);
        let settle = settled_after(smallest).min(n - 1).max(1);
        let [low, high] = self.ends.map(End::diagonal);
        let s = [scale; W];
        let one = [1.0; W];
        let mut factor = l.div(one, l.add(b, [low; W]));
        let mut y = l.mul(l.mul(g[0], s), factor);
        (g[0], c[0]) = (y, factor);
        for i in 1..settle {
            factor = l.div(one, l.sub(b, factor));
            y = l.mul(l.vmadd(g[i], s, y), factor);
            (g[i], c[i]) = (y, factor);
        }
        let scaled = l.mul(factor, s);
        for g in &mut g[settle..n - 1] {
            y = l.vmadd(factor, y, l.mul(*g, scaled));
            *g = y;
        }
        // A singular system (b = 2, no slope at both ends) gets zero at its last point.
        let last: [f64; W] = std::array::from_fn(|lane| {
            let d = b[lane] + high - factor[lane];
            if d == 0.0 { 0.0 } else { 1.0 / d }
        });
        if n > 1 {
            y = l.mul(l.vmadd(g[n - 1], s, y), last);
            g[n - 1] = y;
        }
        for g in g[settle..n - 1].iter_mut().rev() {
            y = l.vmadd(factor, y, *g);
            *g = y;
        }
        for (g, c) in g[..settle.min(n - 1)].iter_mut().zip(&*c).rev() {
            y = l.vmadd(*c, y, *g);
            *g = y;
        }
    }

    #[inline(always)]
    fn cyclic<const W: usize, const F: bool>(
        &self,
        l: Lanes<W, F>,
        g: &mut [[f64; W]],
        b: [f64; W],
        scale: f64,
    ) {
        let n = self.n;
        let r: [f64; W] = std::array::from_fn(|lane| decay(b[lane]));
        // 1 / (1 - r^n); the singular system has no closed solution and is done apart.
        let closing: [f64; W] = std::array::from_fn(|lane| {
            let gap = 1.0 - r[lane].powi(n as i32);
            if gap == 0.0 { 0.0 } else { 1.0 / gap }
        });
        let mut y = [0.0; W];
        for g in g.iter() {
            y = l.vmadd(r, y, *g);
        }
        y = l.mul(y, closing);
        for g in g.iter_mut() {
            y = l.vmadd(r, y, *g);
            *g = y;
        }
        let scaled = l.mul(r, [scale; W]);
        let mut x = [0.0; W];
        for g in g.iter().rev() {
            x = l.vmadd(r, x, l.mul(scaled, *g));
        }
        x = l.mul(x, closing);
        for g in g.iter_mut().rev() {
            x = l.vmadd(r, x, l.mul(scaled, *g));
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

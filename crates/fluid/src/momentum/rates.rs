//! The rate of change of one velocity component along one row.

use super::advection::{Carrier, Factors, Flux, Line};
use crate::lanes::Lanes;
use crate::shape::Shape;

/// The neighbours of a row along one direction, and what carries it there.
struct Stencil<'a> {
    far_behind: &'a [f64],
    behind: &'a [f64],
    ahead: &'a [f64],
    far_ahead: &'a [f64],
    /// The two carriers whose sum acts at the face behind, and the two ahead.
    carry: [&'a [f64]; 4],
    factors: Factors,
}

impl<'a> Stencil<'a> {
    /// For component `c` at `n` points from `p` on, along level `d`.
    #[inline(always)]
    fn new(
        v: [&'a [f64]; 3],
        c: usize,
        d: usize,
        p: usize,
        n: usize,
        s: [usize; 3],
        factors: Factors,
    ) -> Self {
        let own = |q: usize| &v[c][q..q + n];
        // The control volume of a face is half of the cell behind it and half of its own.
        let carry = if c == d {
            [own(p - s[d]), own(p), own(p), own(p + s[d])]
        } else {
            let other = |q: usize| &v[d][q..q + n];
            [other(p - s[c]), other(p), other(p + s[d] - s[c]), other(p + s[d])]
        };
        Self {
            far_behind: own(p - 2 * s[d]),
            behind: own(p - s[d]),
            ahead: own(p + s[d]),
            far_ahead: own(p + 2 * s[d]),
            carry,
            factors,
        }
    }

    #[inline(always)]
    fn rate<const W: usize, const F: bool>(
        &self,
        l: Lanes<W, F>,
        flux: impl Flux,
        here: f64,
        i: usize,
    ) -> f64 {
        let line = Line {
            far_behind: self.far_behind[i],
            behind: self.behind[i],
            here,
            ahead: self.ahead[i],
            far_ahead: self.far_ahead[i],
        };
        let [a, b, c, d] = self.carry;
        let carrier = Carrier { behind: a[i] + b[i], ahead: c[i] + d[i] };
        flux.rate(l, line, carrier, self.factors)
    }
}

/// Writes to `out` the rates of component `c` (a level) at its points from place `p` on.
#[inline(always)]
pub(crate) fn row_rates<const W: usize, const F: bool>(
    l: Lanes<W, F>,
    flux: impl Flux,
    v: [&[f64]; 3],
    shape: &Shape,
    c: usize,
    p: usize,
    factors: &[Factors; 3],
    body: f64,
    out: &mut [f64],
) {
    let (n, s) = (out.len(), shape.stride);
    let here = &v[c][p..p + n];
    let x = Stencil::new(v, c, 0, p, n, s, factors[0]);
    let z = Stencil::new(v, c, 2, p, n, s, factors[2]);
    if s[1] == 0 {
        for i in 0..n {
            out[i] = body + x.rate(l, flux, here[i], i) + z.rate(l, flux, here[i], i);
        }
    } else {
        let y = Stencil::new(v, c, 1, p, n, s, factors[1]);
        for i in 0..n {
            let plane = x.rate(l, flux, here[i], i) + y.rate(l, flux, here[i], i);
            out[i] = body + plane + z.rate(l, flux, here[i], i);
        }
    }
}

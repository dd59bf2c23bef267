//! The first and the last stage of a transform of many lines, joined with what
//! reads the lines from memory and writes them back.
//!
//! `HALF` panels, `W` columns wide instead of `2 W`, have zeros for the other half. It is a constant: a condition
//! would send every vector through the stack.

use super::fft::{Complex, Stage, parts, zero};
use super::rows::Rows;
use super::transform::Transform;
use crate::lanes::{Kernel, Lanes, prefetch};

/// `2 W` columns of rows, the first half real and the other imaginary parts of complex lines.
pub(crate) struct Panel<'a, 'b> {
    pub transform: &'a Transform,
    pub stage: &'a Stage,
    pub rows: &'a mut Rows<'b>,
    pub column: usize,
    /// One complex number for every row.
    pub z: &'a mut [f64],
}

/// The numbers of all lanes as complex ones.
#[inline(always)]
pub(crate) fn complex<const W: usize>(z: &mut [f64]) -> &mut [Complex<W>] {
    z.as_chunks_mut::<W>().0.as_chunks_mut::<2>().0
}

impl Panel<'_, '_> {
    #[inline(always)]
    fn get<const HALF: bool, const W: usize, const F: bool>(&self, l: Lanes<W, F>, r: usize) -> Complex<W> {
        let row = &self.rows.row(r)[self.column..];
        [l.load(row), if HALF { [0.0; W] } else { l.load(&row[W..]) }]
    }

    #[inline(always)]
    fn put<const HALF: bool, const W: usize, const F: bool>(
        &mut self,
        l: Lanes<W, F>,
        r: usize,
        x: Complex<W>,
    ) {
        let row = &mut self.rows.row_mut(r)[self.column..];
        l.store(row, x[0]);
        if !HALF {
            l.store(&mut row[W..], x[1]);
        }
    }

    /// Asks for cache line `line` of what will be needed after these columns of row `r`: a step from row to row
    /// is too long for a processor to guess it. One line where numbers are read and the other where they are
    /// written or read again: in one burst they would wait for each other.
    #[inline(always)]
    fn ask<const W: usize>(&self, r: usize, line: usize) {
        if 8 * line < 2 * W {
            let next = self.column + self.rows.ahead() + 8 * line;
            prefetch(self.rows.row(r).as_ptr().wrapping_add(next));
        }
    }

    /// Writes the spectra at k and n - k of both lines, of which `p` = Z_k and `q` = Z_{n-k}; 0 < k <= n/2.
    #[inline(always)]
    fn put_pair<const HALF: bool, const W: usize, const F: bool>(
        &mut self,
        l: Lanes<W, F>,
        k: usize,
        p: Complex<W>,
        q: Complex<W>,
    ) {
        let [c, s] = self.transform.shift[k];
        let far = self.transform.length - k;
        if self.rows.in_one_plane() {
            self.ask::<W>(k, 1);
            self.ask::<W>(far, 1);
        }
        // Each of the two spectra at k, doubled: its real part, minus its imaginary part.
        let (re_a, im_a) = (l.add(p[0], q[0]), l.sub(q[1], p[1]));
        let (re_b, im_b) = (l.add(p[1], q[1]), l.sub(p[0], q[0]));
        let (c, s) = ([0.5 * c; W], [0.5 * s; W]);
        let x = [l.vmsub(c, re_a, l.mul(s, im_a)), l.vmsub(c, re_b, l.mul(s, im_b))];
        self.put::<HALF, W, F>(l, k, x);
        if k < far {
            let y = [l.vmadd(s, re_a, l.mul(c, im_a)), l.vmadd(s, re_b, l.mul(c, im_b))];
            self.put::<HALF, W, F>(l, far, y);
        }
    }

    /// Undoes [`Self::put_pair`], with real and imaginary parts exchanged: a forward transform then inverts.
    #[inline(always)]
    fn get_pair<const HALF: bool, const W: usize, const F: bool>(
        &self,
        l: Lanes<W, F>,
        k: usize,
    ) -> (Complex<W>, Complex<W>) {
        let [c, s] = self.transform.shift[k];
        let far = self.transform.length - k;
        let line = usize::from(!self.rows.in_one_plane());
        self.ask::<W>(k, line);
        self.ask::<W>(far, line);
        let [a, b] = self.get::<HALF, W, F>(l, k);
        if k == far {
            let x = [c + s; W];
            let own = [l.mul(x, b), l.mul(x, a)];
            return (own, own);
        }
        let [a_far, b_far] = self.get::<HALF, W, F>(l, far);
        let (c, s) = ([c; W], [s; W]);
        let (re_a, im_a) = (l.vmadd(c, a, l.mul(s, a_far)), l.vmsub(c, a_far, l.mul(s, a)));
        let (re_b, im_b) = (l.vmadd(c, b, l.mul(s, b_far)), l.vmsub(c, b_far, l.mul(s, b)));
        ([l.sub(re_b, im_a), l.add(re_a, im_b)], [l.add(re_b, im_a), l.sub(re_a, im_b)])
    }
}

/// The first stage of a forward transform, from memory.
pub(crate) struct Load<'a, 'b, const R: usize, const HALF: bool>(pub Panel<'a, 'b>);

impl<const R: usize, const HALF: bool> Kernel for Load<'_, '_, R, HALF> {
    #[inline(always)]
    fn run<const W: usize, const F: bool>(mut self, l: Lanes<W, F>) {
        let z = std::mem::take(&mut self.0.z);
        let from = self.0.transform.source.as_chunks::<R>().0;
        for (z, from) in complex::<W>(z).as_chunks_mut::<R>().0.iter_mut().zip(from) {
            let mut x = [zero(); R];
            for q in 0..R {
                self.0.ask::<W>(from[q], 0);
                x[q] = self.0.get::<HALF, W, F>(l, from[q]);
            }
            *z = self.0.stage.plain_butterfly(l, x);
        }
    }
}

/// The last stage of a forward transform, parted into the spectra of both lines, to memory.
///
/// The numbers k and n - k belong together; those of the butterflies at j and `part - j` do so among themselves.
pub(crate) struct PartSpectra<'a, 'b, const R: usize, const HALF: bool>(pub Panel<'a, 'b>);

impl<const R: usize, const HALF: bool> Kernel for PartSpectra<'_, '_, R, HALF> {
    #[inline(always)]
    fn run<const W: usize, const F: bool>(mut self, l: Lanes<W, F>) {
        let Panel { stage, ref mut z, .. } = self.0;
        let part = stage.part;
        let legs = parts::<R, _>(complex::<W>(std::mem::take(z)), part);
        let own = stage.at(l, &legs, 0);
        self.0.put::<HALF, W, F>(l, 0, own[0]);
        for q in 1..=R / 2 {
            self.0.put_pair::<HALF, W, F>(l, q * part, own[q], own[R - q]);
        }
        for j in 1..part.div_ceil(2) {
            let (near, far) = (stage.at(l, &legs, j), stage.at(l, &legs, part - j));
            for q in 0..R.div_ceil(2) {
                self.0.put_pair::<HALF, W, F>(l, j + q * part, near[q], far[R - 1 - q]);
            }
            for q in 0..R / 2 {
                self.0.put_pair::<HALF, W, F>(l, part - j + q * part, far[q], near[R - 1 - q]);
            }
        }
        if part.is_multiple_of(2) {
            let own = stage.at(l, &legs, part / 2);
            for q in 0..R.div_ceil(2) {
                self.0.put_pair::<HALF, W, F>(l, part / 2 + q * part, own[q], own[R - 1 - q]);
            }
        }
    }
}

/// The first stage of an inverse transform: the spectra of two lines from memory, joined into one.
pub(crate) struct JoinSpectra<'a, 'b, const R: usize, const HALF: bool>(pub Panel<'a, 'b>);

impl<const R: usize, const HALF: bool> Kernel for JoinSpectra<'_, '_, R, HALF> {
    #[inline(always)]
    fn run<const W: usize, const F: bool>(mut self, l: Lanes<W, F>) {
        let z = complex::<W>(std::mem::take(&mut self.0.z));
        let Panel { transform, stage, .. } = self.0;
        let apart = transform.length / R;
        for &[k, at, other] in &transform.pairs {
            let mut near = [zero(); R];
            if k == 0 {
                let [re, im] = self.0.get::<HALF, W, F>(l, 0);
                near[0] = [im, re];
                for q in 1..=R / 2 {
                    (near[q], near[R - q]) = self.0.get_pair::<HALF, W, F>(l, q * apart);
                }
            } else if at == other {
                for q in 0..R.div_ceil(2) {
                    (near[q], near[R - 1 - q]) = self.0.get_pair::<HALF, W, F>(l, k + q * apart);
                }
            } else {
                let mut far = [zero(); R];
                for q in 0..R.div_ceil(2) {
                    (near[q], far[R - 1 - q]) = self.0.get_pair::<HALF, W, F>(l, k + q * apart);
                }
                for q in 0..R / 2 {
                    (far[q], near[R - 1 - q]) = self.0.get_pair::<HALF, W, F>(l, apart - k + q * apart);
                }
                z[other..other + R].copy_from_slice(&stage.plain_butterfly(l, far));
            }
            z[at..at + R].copy_from_slice(&stage.plain_butterfly(l, near));
        }
    }
}

/// The last stage of an inverse transform, to memory.
pub(crate) struct Store<'a, 'b, const R: usize, const HALF: bool>(pub Panel<'a, 'b>);

impl<const R: usize, const HALF: bool> Kernel for Store<'_, '_, R, HALF> {
    #[inline(always)]
    fn run<const W: usize, const F: bool>(mut self, l: Lanes<W, F>) {
        let Panel { transform, stage, ref mut z, .. } = self.0;
        let legs = parts::<R, _>(complex::<W>(std::mem::take(z)), stage.part);
        for j in 0..stage.part {
            let x = stage.at(l, &legs, j);
            for q in 0..R {
                let ([im, re], r) = (x[q], transform.point[j + q * stage.part]);
                self.0.put::<HALF, W, F>(l, r, [re, im]);
                if self.0.rows.in_one_plane() {
                    self.0.ask::<W>(r, 1);
                }
            }
        }
    }
}

//! Where the weights of a point go.

use super::kernel::Kernel;
use brazilnut_base::{Side, Vec3};
use brazilnut_fluid::{Faces, Grid};

/// The staggered grid as points see it.
///
/// Tables give the place in memory of every grid index, also of indices
/// beyond the sides: wrapped where periodic, moved to the nearest free value
/// where there is a wall.
#[derive(Clone, Debug)]
pub struct Stagger {
    axes: [Axis; 3],
    /// Axes from contiguous to slowest in memory.
    order: [usize; 3],
    /// Place of (0, 0, 0).
    origin: usize,
    cells: [f64; 3],
    per_spacing: Vec3,
}

/// Tables of one axis.
#[derive(Clone, Debug)]
struct Axis {
    flat: bool,
    pad: isize,
    /// Offset in memory by index + `pad`, for values at cell centres and on faces.
    centre: Vec<usize>,
    face: Vec<usize>,
}

/// Where the weights of one component go around points away from the ends of the line axis: rows of memory.
#[derive(Clone, Copy, Debug)]
pub struct Stencil<const W: usize> {
    /// Place of the first weight of each row.
    rows: [[usize; W]; W],
    /// Weight of each row: of the slow and the middle axis together.
    across: [[f64; W]; W],
    /// Weights along a row.
    along: [f64; W],
}

/// Base indices and weights of one point: for each axis at cell centres (0) and on faces (1).
#[derive(Clone, Copy, Debug)]
pub struct Seat<const W: usize> {
    /// Index of the first point.
    pub first: [[isize; 2]; 3],
    /// Weights from the first point on.
    pub weights: [[[f64; W]; 2]; 3],
}

impl Stagger {
    /// Tables for points whose indices reach at most `pad` beyond the ends.
    #[must_use]
    pub fn new(grid: &Grid, pad: usize) -> Self {
        let layout = grid.layout();
        let axes = [0, 1, 2].map(|a| {
            let (n, stride) = (grid.cells[a] as isize, layout.stride[a]);
            let pad = pad as isize;
            let place = |i: isize, low: isize| match grid.sides[a] {
                Side::Periodic => i.rem_euclid(n) as usize * stride,
                Side::Walls => i.clamp(low, (n - 1).max(low)) as usize * stride,
                Side::Flat => 0,
            };
            Axis {
                flat: grid.sides[a] == Side::Flat,
                pad,
                centre: (-pad..n + pad).map(|i| place(i, 0)).collect(),
                face: (-pad..n + pad).map(|i| place(i, 1)).collect(),
            }
        });
        let per_spacing = Vec3::from_array(grid.spacing.map(f64::recip));
        Self {
            axes,
            order: grid.memory_order(),
            origin: layout.origin,
            cells: grid.cells.map(|n| n as f64),
            per_spacing,
        }
    }

    /// True where `axis` is flat: there is no component and no weight along it.
    #[inline]
    #[must_use]
    pub fn is_flat(&self, axis: usize) -> bool {
        self.axes[axis].flat
    }

    /// Indices and weights of the point `x` (m).
    #[inline]
    #[must_use]
    pub fn seat<const W: usize>(&self, kernel: impl Kernel<W>, x: Vec3) -> Seat<W> {
        let s = x * self.per_spacing;
        let mut seat = Seat { first: [[0; 2]; 3], weights: [[[0.0; W]; 2]; 3] };
        for a in 0..3 {
            for (kind, shift) in [(0, 0.5), (1, 0.0)] {
                if self.axes[a].flat {
                    seat.weights[a][kind][0] = 1.0;
                    continue;
                }
                let (first, weights) = kernel.weights(s[a] - shift);
                let low = -self.axes[a].pad;
                let high = self.axes[a].centre.len() as isize + low - W as isize;
                // A point that is lost (not finite, or far outside) must not fault here: `health` reports it.
                seat.first[a][kind] = (first as isize).clamp(low, high);
                seat.weights[a][kind] = weights;
            }
        }
        seat
    }

    /// Number of points along `axis` that carry weight.
    #[inline]
    fn width<const W: usize>(&self, axis: usize) -> usize {
        if self.axes[axis].flat { 1 } else { W }
    }

    /// Calls `f(place, weight)` for every face of `component` around a point.
    #[inline(always)]
    pub fn each<const W: usize>(&self, seat: &Seat<W>, component: usize, mut f: impl FnMut(usize, f64)) {
        let [line, middle, slow] = self.order;
        let kind = |a: usize| usize::from(a == component);
        let table = |a: usize| {
            let axis = &self.axes[a];
            let t = if a == component { &axis.face } else { &axis.centre };
            let first = (seat.first[a][kind(a)] + axis.pad) as usize;
            &t[first..first + self.width::<W>(a)]
        };
        let weights = |a: usize| &seat.weights[a][kind(a)];
        let (along, w_line) = (table(line), weights(line));
        for (plane, w_slow) in table(slow).iter().zip(weights(slow)) {
            for (row, w_middle) in table(middle).iter().zip(weights(middle)) {
                let w = w_slow * w_middle;
                for (place, w_line) in along.iter().zip(w_line) {
                    f(self.origin + plane + row + place, w * w_line);
                }
            }
        }
    }

    /// Value of one component of `field` at a point.
    #[inline(always)]
    #[must_use]
    pub fn gather<const W: usize>(&self, seat: &Seat<W>, component: usize, field: &[f64]) -> f64 {
        let mut sum = 0.0;
        self.each(seat, component, |place, w| sum += w * field[place]);
        sum
    }

    /// Adds `amount` to one component of `field` around a point; `field` begins at place `start` of the whole.
    #[inline(always)]
    pub fn scatter<const W: usize>(
        &self,
        seat: &Seat<W>,
        component: usize,
        amount: f64,
        field: &mut [f64],
        start: usize,
    ) {
        self.each(seat, component, |place, w| field[place - start] += w * amount);
    }

    /// `field` at a point; zero along a flat axis.
    #[inline(always)]
    #[must_use]
    pub fn interpolate<const W: usize>(&self, seat: &Seat<W>, field: &Faces) -> Vec3 {
        let mut v = Vec3::ZERO;
        for c in 0..3 {
            if !self.axes[c].flat {
                v[c] = self.gather(seat, c, field.component(c));
            }
        }
        v
    }

    /// Adds `amount` around a point: the transpose of [`Self::interpolate`].
    #[inline(always)]
    pub fn spread<const W: usize>(&self, seat: &Seat<W>, amount: Vec3, field: &mut Faces) {
        for c in 0..3 {
            if !self.axes[c].flat {
                self.scatter(seat, c, amount[c], field.component_mut(c), 0);
            }
        }
    }

    /// True if no weight of points between `low` and `high` (m) meets an end of the line axis:
    /// [`Self::stencil`] holds there.
    #[inline]
    #[must_use]
    pub fn is_free<const W: usize>(&self, low: Vec3, high: Vec3) -> bool {
        // A kernel reaches half its width; rounding must not reach further.
        let margin = 0.5 * W as f64 + 1e-6;
        let line = self.order[0];
        let per_spacing = self.per_spacing[line];
        low[line] * per_spacing >= margin && high[line] * per_spacing <= self.cells[line] - margin
    }

    /// Reads every cache line that points between `low` and `high` (m) share weights with: the loads do not wait for
    /// each other, as those of the sums do, and these then find their values near.
    ///
    /// `field` is one component and begins at place `start` of the whole.
    #[inline(always)]
    pub fn fetch(&self, low: Vec3, high: Vec3, field: &[f64], start: usize) {
        const LINE: usize = 8;
        let range = |a: usize| {
            let axis = &self.axes[a];
            if axis.flat {
                return (0, 0);
            }
            let last = axis.centre.len() as isize - 1;
            let index = |x: f64, beyond: isize| {
                ((x * self.per_spacing[a]) as isize + axis.pad + beyond).clamp(0, last)
            };
            (index(low[a], -1) as usize, index(high[a], 1) as usize)
        };
        let [line, middle, slow] = self.order;
        let [i, j, k] = [range(line), range(middle), range(slow)];
        let from = (self.origin + i.0).wrapping_sub(self.axes[line].pad as usize).wrapping_sub(start);
        let mut sum = 0.0;
        for plane in &self.axes[slow].centre[k.0..=k.1] {
            for row in &self.axes[middle].centre[j.0..=j.1] {
                let first = from.wrapping_add(plane + row);
                for n in (0..i.1 - i.0 + LINE).step_by(LINE) {
                    sum += field.get(first.wrapping_add(n)).unwrap_or(&0.0);
                }
            }
        }
        let _ = std::hint::black_box(sum);
    }

    /// The weights of `component` around a point, or `at` spacings along line, middle and slow axis from it,
    /// away from the ends of the line axis.
    #[inline(always)]
    #[must_use]
    pub fn stencil<const W: usize>(&self, seat: &Seat<W>, component: usize, at: [i16; 3]) -> Stencil<W> {
        let [line, middle, slow] = self.order;
        let kind = |a: usize| usize::from(a == component);
        let table = |a: usize, at: i16| -> [usize; W] {
            let axis = &self.axes[a];
            if axis.flat {
                return [0; W];
            }
            let t = if a == component { &axis.face } else { &axis.centre };
            // A point that is lost must not fault here.
            let first = (seat.first[a][kind(a)] + at as isize + axis.pad).max(0) as usize;
            let first = first.min(t.len() - W);
            let mut places = [0; W];
            places.copy_from_slice(&t[first..first + W]);
            places
        };
        let weights = |a: usize| &seat.weights[a][kind(a)];
        let start = self.origin as isize + seat.first[line][kind(line)] + at[0] as isize;
        let (middle_places, slow_places) = (table(middle, at[1]), table(slow, at[2]));
        let (m, s) = (weights(middle), weights(slow));
        let mut stencil = Stencil { rows: [[0; W]; W], across: [[0.0; W]; W], along: *weights(line) };
        for k in 0..W {
            for j in 0..W {
                stencil.rows[k][j] = start.max(0) as usize + middle_places[j] + slow_places[k];
                stencil.across[k][j] = s[k] * m[j];
            }
        }
        stencil
    }
}

/// Room for the longest row of a [`Stencil`] and a kernel.
const LONGEST: usize = 16;

impl<const W: usize> Stencil<W> {
    /// Values at `L + 1 - W` points one spacing apart along the line axis, the point of the stencil first; what
    /// stands behind them means nothing.
    #[inline(always)]
    #[must_use]
    pub fn gather<const L: usize>(&self, field: &[f64]) -> [f64; L] {
        let mut sum = [0.0; L];
        for (rows, across) in self.rows.iter().zip(&self.across) {
            for (place, w) in rows.iter().zip(across) {
                let row = &field[*place..*place + L];
                for l in 0..L {
                    sum[l] += w * row[l];
                }
            }
        }
        let mut beyond = [0.0; LONGEST];
        beyond[..L].copy_from_slice(&sum);
        let mut out = [0.0; L];
        for (k, w) in self.along.iter().enumerate() {
            for t in 0..L {
                out[t] += w * beyond[t + k];
            }
        }
        out
    }

    /// The transpose of [`Self::gather`]: adds `amounts`, of which the last `W - 1` are zero; `field` begins at place
    /// `start` of the whole.
    #[inline(always)]
    pub fn scatter<const L: usize>(&self, amounts: &[f64; L], field: &mut [f64], start: usize) {
        let mut before = [0.0; LONGEST];
        before[W - 1..W - 1 + L].copy_from_slice(amounts);
        let mut sum = [0.0; L];
        for (k, w) in self.along.iter().enumerate() {
            for t in 0..L {
                sum[t] += w * before[t + W - 1 - k];
            }
        }
        for (rows, across) in self.rows.iter().zip(&self.across) {
            for (place, w) in rows.iter().zip(across) {
                let row = &mut field[place - start..place - start + L];
                for l in 0..L {
                    row[l] += w * sum[l];
                }
            }
        }
    }
}

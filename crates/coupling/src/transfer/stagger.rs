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
        Self { axes, order: grid.memory_order(), origin: layout.origin, per_spacing }
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
}

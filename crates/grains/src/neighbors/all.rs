//! Every pair of a few bodies, tested several at a time.

use crate::contact::real::{Mask, Real};
use crate::lanes::Wide;
use crate::packed::Row;
use crate::state::BATCH;
use brazilnut_base::Cell;

/// Positions and radii of some rows, column by column, with room for a batch behind the last.
#[derive(Clone, Debug, Default)]
pub struct Columns {
    columns: [Vec<f64>; 4],
    len: usize,
}

impl Columns {
    /// Takes up `rows`.
    pub fn fill(&mut self, rows: &[Row]) {
        self.len = rows.len();
        for (k, column) in self.columns.iter_mut().enumerate() {
            column.clear();
            column.extend(rows.iter().map(|r| r.0[k]));
            column.resize(rows.len() + BATCH, f64::INFINITY);
        }
    }

    /// Calls `found` with every pair whose nearest images come within the sum of their radii and `skin` (m),
    /// and maybe some that miss it by rounding. Positions must lie inside the cell along its periodic directions.
    #[inline(always)]
    pub fn pairs<R: Wide>(&self, cell: &Cell, skin: f64, mut found: impl FnMut(usize, usize)) {
        let period = |a: usize| if cell.is_periodic(a) { cell.size[a] } else { f64::INFINITY };
        let (px, py, pz) = (R::splat(period(0)), R::splat(period(1)), R::splat(period(2)));
        let [x, y, z, r] = &self.columns;
        for i in 0..self.len {
            let (xi, yi, zi, reach) = (R::splat(x[i]), R::splat(y[i]), R::splat(z[i]), R::splat(r[i] + skin));
            let mut j = i + 1;
            while j < self.len {
                let (dx, dy, dz) = (
                    nearest(xi, R::load(&x[j..]), px),
                    nearest(yi, R::load(&y[j..]), py),
                    nearest(zi, R::load(&z[j..]), pz),
                );
                let reach = reach + R::load(&r[j..]);
                let mut near = (dx * dx + dy * dy + dz * dz).le(reach * reach).bits();
                while near != 0 {
                    let other = j + near.trailing_zeros() as usize;
                    near &= near - 1;
                    if other < self.len {
                        found(i, other);
                    }
                }
                j += R::WIDTH;
            }
        }
    }
}

/// Distance of the nearest images.
#[inline(always)]
fn nearest<R: Real>(a: R, b: R, period: R) -> R {
    let d = (a - b).abs();
    d.min(period - d)
}

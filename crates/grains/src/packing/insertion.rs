//! Random insertion: anywhere in the cell, or as a column that rains down.

use super::draft::Draft;
use super::{Filling, PackingError, Region};
use crate::Grains;
use brazilnut_base::random::stream;
use brazilnut_base::{Side, Vec3};
use rand::{Rng, RngExt};

/// Tries per grain before a cell counts as full. Random insertion slows down as it fills: at solids
/// fraction 0.35 one try in about 3000 succeeds.
const TRIES: usize = 20_000;

/// Tries per window of a raining column: a few suffice at its low solids fraction, and it may rise instead.
const WINDOW_TRIES: usize = 100;

/// Solids fraction of a raining column: below, it grows tall without need; above, insertion gets slow.
const LOOSE: [f64; 2] = [0.15, 0.33];

/// Random places without overlap, large grains first.
pub(super) fn random(filling: &Filling) -> Result<Grains, PackingError> {
    let mut draft = Draft::new(filling)?;
    let mut order = draft.open.clone();
    order.sort_by(|&a, &b| draft.grains.radius[b].total_cmp(&draft.grains.radius[a]).then(a.cmp(&b)));
    for (done, &k) in order.iter().enumerate() {
        let bounds = draft.bounds(k)?;
        let Some(x) = try_inside(&draft, k, &bounds, TRIES) else {
            return Err(draft.does_not_fit(
                "random",
                &order[done..],
                "random insertion jams near solids fraction 0.38 (0.54 in a flat cell): use `expansion` or `lattice`, a larger cell or fewer grains",
            ));
        };
        draft.place(k, x);
    }
    Ok(draft.grains)
}

/// A loose random column from the floor up, every grain falling at `speed` (m/s).
pub(super) fn rain(filling: &Filling, speed: f64, mixed: bool) -> Result<Grains, PackingError> {
    let mut draft = Draft::new(filling)?;
    let order = draft.order(mixed);
    let needed = draft.occupied(order.iter().copied()) / draft.space();
    let loose = (1.1 * needed).clamp(LOOSE[0], LOOSE[1]);
    let area = draft.space() / (filling.room.high.z - filling.room.low.z);
    let widest = order.iter().map(|&k| draft.grains.radius[k]).fold(0.0, f64::max);
    let mut volume = 0.0;
    for (done, &k) in order.iter().enumerate() {
        let full = draft.bounds(k)?;
        let mut bottom = full.low.z + volume / (loose * area);
        // The window rises where it is full, up to the lid.
        let x = loop {
            let mut window = full;
            window.low.z = bottom.min(full.high.z);
            window.high.z = (bottom + 4.0 * widest).min(full.high.z);
            if let Some(x) = try_inside(&draft, k, &window, WINDOW_TRIES) {
                break Some(x);
            }
            if window.high.z >= full.high.z {
                break try_inside(&draft, k, &full, TRIES);
            }
            bottom += widest;
        };
        let Some(x) = x else {
            return Err(draft.does_not_fit(
                "rain",
                &order[done..],
                "a raining column needs a cell about twice as high as the settled bed: raise it, or use `expansion`",
            ));
        };
        draft.place(k, x);
        draft.grains.velocity[k] -= Vec3::Z * speed;
        volume += draft.occupied([k]);
    }
    Ok(draft.grains)
}

/// A free place for grain `k` inside `bounds`, if one is found.
fn try_inside(draft: &Draft<'_>, k: usize, bounds: &Region, tries: usize) -> Option<Vec3> {
    let mut random = stream(draft.filling.seed, "placement", k as u64);
    (0..tries)
        .map(|_| point(&mut random, draft.filling, bounds))
        .find(|&x| draft.is_free(x, draft.grains.radius[k]))
}

/// A point of `bounds`, evenly distributed.
pub(super) fn point(random: &mut impl Rng, filling: &Filling, bounds: &Region) -> Vec3 {
    let mut x = bounds.low;
    for axis in 0..3 {
        if filling.cell.sides[axis] != Side::Flat {
            x[axis] += (bounds.high[axis] - bounds.low[axis]) * random.random::<f64>();
        }
    }
    x
}

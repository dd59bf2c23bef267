//! A simple cubic lattice, filled from the floor, each site shaken a little.

use super::draft::{Draft, ROUNDING, middle};
use super::{Filling, PackingError};
use crate::Grains;
use brazilnut_base::random::stream;
use brazilnut_base::{Side, Vec3, vec3};
use rand::RngExt;
use std::collections::BTreeSet;

/// Sites `(1 + gap)` largest diameters apart, each moved by up to `jitter` of the free gap.
///
/// With `jitter` up to 1 no two grains can overlap.
pub(super) fn lattice(filling: &Filling, gap: f64, jitter: f64, mixed: bool) -> Result<Grains, PackingError> {
    let mut draft = Draft::new(filling)?;
    let order = draft.order(mixed);
    let widest = 2.0 * order.iter().map(|&k| draft.grains.radius[k]).fold(0.0, f64::max);
    let (count, pitch) = sites(filling, widest, gap);
    let room = ((pitch - Vec3::splat(widest)) * 0.5 * jitter).max(Vec3::ZERO);
    let total: usize = count.iter().product();
    // Few of the sites of a wide cell are taken: they are listed, not all marked.
    let mut taken = BTreeSet::new();
    // A site that an obstacle or the bounds deny to one grain of a species stays denied to that species.
    let mut next = vec![0; filling.species.len()];
    for (done, &k) in order.iter().enumerate() {
        let bounds = draft.bounds(k)?;
        let r = draft.grains.radius[k];
        let slack = Vec3::splat(ROUNDING * r);
        let mut random = stream(filling.seed, "jitter", k as u64);
        let shift = vec3(random.random(), random.random(), random.random()) * 2.0 - Vec3::ONE;
        let cursor = &mut next[usize::from(draft.grains.species[k])];
        let found = (*cursor..total).filter(|n| !taken.contains(n)).find_map(|n| {
            let i = vec3(
                (n % count[0]) as f64,
                (n / count[0] % count[1]) as f64,
                (n / count[0] / count[1]) as f64,
            );
            let x = middle(filling, filling.room.low * walled(filling) + pitch * (i + 0.5) + room * shift);
            let inside = x.cmpge(bounds.low - slack).all() && x.cmple(bounds.high + slack).all();
            (inside && draft.is_free(x, r)).then_some((n, x))
        });
        let Some((n, x)) = found else {
            return Err(draft.does_not_fit(
                "lattice",
                &order[done..],
                "a cubic lattice holds solids fraction 0.52 of its largest grain at best: lower `gap`, use `expansion`, a larger cell or fewer grains",
            ));
        };
        *cursor = n + 1;
        let _ = taken.insert(n);
        draft.place(k, x);
    }
    Ok(draft.grains)
}

/// One in walled directions, zero elsewhere.
fn walled(filling: &Filling) -> Vec3 {
    Vec3::from_array(filling.cell.sides.map(|s| if s == Side::Walls { 1.0 } else { 0.0 }))
}

/// Most sites along an axis: far more than grains, and their product can be counted.
const MOST_SITES: usize = 1 << 20;

/// Numbers of sites and their pitch: stretched to fill the width, tight along z.
fn sites(filling: &Filling, widest: f64, gap: f64) -> ([usize; 3], Vec3) {
    let (mut count, mut pitch) = ([1; 3], filling.cell.size);
    for axis in 0..3 {
        let width = match filling.cell.sides[axis] {
            Side::Walls => filling.room.high[axis] - filling.room.low[axis],
            Side::Periodic => filling.cell.size[axis],
            Side::Flat => continue,
        };
        // A cell just as wide as a whole number of grains must hold that number despite rounding.
        let wanted = widest * (1.0 + gap);
        count[axis] = ((width / wanted + 1e-9).floor() as usize).clamp(1, MOST_SITES);
        let fitted = width / count[axis] as f64;
        pitch[axis] = if axis == 2 && count[axis] > 1 { wanted } else { fitted };
    }
    (count, pitch)
}

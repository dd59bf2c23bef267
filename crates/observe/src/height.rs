//! How high the bed stands.

use crate::observer::Selection;
use crate::view::View;
use crate::zones::{Direction, Grid};

/// The value below which lies the fraction `part` of the weight; linear between
/// the middles of neighbouring weights. NaN if there is nothing.
///
/// `pairs` are (value, weight); they are sorted here.
#[must_use]
pub fn quantile(pairs: &mut [(f64, f64)], part: f64) -> f64 {
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    let total: f64 = pairs.iter().map(|p| p.1).sum();
    let goal = part * total;
    let (mut below, mut last) = (0.0, None::<(f64, f64)>);
    for &(x, w) in pairs.iter() {
        let middle = below + 0.5 * w;
        if middle >= goal {
            return last.map_or(x, |(x0, m0)| x0 + (x - x0) * (goal - m0) / (middle - m0));
        }
        last = Some((x, middle));
        below += w;
    }
    last.map_or(f64::NAN, |l| l.0)
}

fn edge_quantile(view: &View, of: Selection, part: f64, side: f64) -> f64 {
    let g = view.grains;
    let mut pairs: Vec<_> = (0..g.len())
        .filter(|&k| of.takes(g, k))
        .map(|k| (g.position[k].z + side * g.radius[k], g.mass[k]))
        .collect();
    quantile(&mut pairs, part) - view.floor_height()
}

/// Height above the floor below which lie the tops of the fraction `part` of the mass, m.
#[must_use]
pub fn lid(view: &View, of: Selection, part: f64) -> f64 {
    edge_quantile(view, of, part, 1.0)
}

/// Height above the floor below which lie the lower edges of the fraction `part` of the mass, m.
#[must_use]
pub fn lower_edge(view: &View, of: Selection, part: f64) -> f64 {
    edge_quantile(view, of, part, -1.0)
}

/// Slabs beyond which grains are on their way out: a guard will stop such a run, if it is given the time.
const MOST: f64 = 1e6;

/// Solids fractions of slabs of thickness `layer` (m) from the floor up to above the highest grain; none if it is a
/// million slabs away.
#[must_use]
pub fn slabs(view: &View, of: Selection, layer: f64) -> Vec<f64> {
    let g = view.grains;
    let floor = view.floor_height();
    let top =
        (0..g.len()).filter(|&k| of.takes(g, k)).map(|k| g.position[k].z + g.radius[k]).fold(floor, f64::max);
    let layers = ((top - floor) / layer).floor();
    if layers > MOST {
        return vec![];
    }
    let count = layers as usize + 2;
    let d = Direction { axis: 2, origin: floor, width: layer, count, periodic: false };
    let grid = Grid::new(view.cell, vec![d]);
    let mut nu = vec![0.0; count];
    let mut scratch = vec![];
    for k in (0..g.len()).filter(|&k| of.takes(g, k)) {
        let v = grid.body().volume(g.radius[k]) / grid.zone_volume();
        grid.spread(g.position[k], g.radius[k], &mut scratch, |zone, part| nu[zone] += v * part);
    }
    nu
}

/// The highest place where the solids fraction of slabs crosses `threshold`, above the floor, m.
#[must_use]
pub fn by_solids_fraction(view: &View, of: Selection, threshold: f64, layer: f64) -> f64 {
    crossing(&slabs(view, of, layer), threshold, layer)
}

/// Highest crossing of `threshold` in values at the centres of layers, linear in between; 0 if all lie below.
///
/// For a bed that ends sharply this is its top: a slab filled by half stands half way.
fn crossing(nu: &[f64], threshold: f64, layer: f64) -> f64 {
    let Some(k) = nu.iter().rposition(|&x| x >= threshold) else { return 0.0 };
    let above = nu.get(k + 1).copied().unwrap_or(0.0);
    layer * (k as f64 + 0.5 + (nu[k] - threshold) / (nu[k] - above))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthetic::Stage;
    use brazilnut_base::{Vec3, vec3};

    #[test]
    fn quantile_of_equal_weights() {
        let mut p: Vec<_> = (1..=100).rev().map(|k| (f64::from(k), 2.0)).collect();
        assert!((quantile(&mut p, 0.5) - 50.5).abs() < 1e-12);
        assert!((quantile(&mut p, 0.95) - 95.5).abs() < 1e-12);
        assert_eq!(quantile(&mut p, 0.0), 1.0);
        assert!(quantile(&mut [], 0.5).is_nan());
    }

    #[test]
    fn a_grain_that_was_thrown_out_of_sight_costs_no_memory() {
        let mut stage = Stage::new(Vec3::ONE, "walls");
        stage.add(vec3(0.5, 0.5, 0.1), 0.05);
        assert!(by_solids_fraction(&stage.view(), Selection::All, 1e-6, 0.1) > 0.0);
        for far in [1e15, f64::INFINITY] {
            stage.grains.position[0].z = far;
            assert_eq!(by_solids_fraction(&stage.view(), Selection::All, 1e-6, 0.1), 0.0);
        }
    }

    #[test]
    fn a_sharp_top_is_found_at_half_the_bulk_value() {
        // Bulk 0.6, ends on a slab boundary or half way through a slab.
        assert!((crossing(&[0.6, 0.6, 0.0], 0.3, 1.0) - 2.0).abs() < 1e-12);
        assert!((crossing(&[0.6, 0.6, 0.3, 0.0], 0.3, 1.0) - 2.5).abs() < 1e-12);
        assert_eq!(crossing(&[0.1], 0.3, 1.0), 0.0);
    }
}

//! Pairs of near points.

use brazilnut_base::{Cell, Vec3};

/// Calls `f` with the distance of every pair of `points` nearer than `reach`, each pair once.
///
/// Points are sorted into boxes no smaller than `reach`, so that the cost is
/// linear in their number; `low` and `high` bound them.
pub fn near(points: &[Vec3], cell: &Cell, low: Vec3, high: Vec3, reach: f64, mut f: impl FnMut(f64)) {
    let size = high - low;
    // With fewer than three boxes a neighbour would be met twice across periodic sides: then one box does.
    let count = [0, 1, 2].map(|a| {
        let n = (size[a] / reach).floor();
        if n >= 3.0 { n.min(1e3) as i64 } else { 1 }
    });
    let place = |r: Vec3| {
        [0, 1, 2].map(|a| (((r[a] - low[a]) / size[a] * count[a] as f64) as i64).clamp(0, count[a] - 1))
    };
    let index = |b: [i64; 3]| (b[0] + count[0] * (b[1] + count[1] * b[2])) as usize;
    let mut head = vec![usize::MAX; (count[0] * count[1] * count[2]) as usize];
    let mut next = vec![usize::MAX; points.len()];
    for (k, &r) in points.iter().enumerate() {
        let b = index(place(r));
        next[k] = head[b];
        head[b] = k;
        // Earlier points of this and the neighbouring boxes.
        let at = place(r);
        let span = |a: usize| if count[a] == 1 { 0..=0 } else { -1..=1 };
        for dz in span(2) {
            for dy in span(1) {
                for dx in span(0) {
                    let Some(b) = neighbour(cell, at, [dx, dy, dz], count) else { continue };
                    let mut j = head[index(b)];
                    while j != usize::MAX {
                        if j < k {
                            let d = cell.nearest(points[j] - r).length_squared();
                            if d < reach * reach {
                                f(d.sqrt());
                            }
                        }
                        j = next[j];
                    }
                }
            }
        }
    }
}

fn neighbour(cell: &Cell, at: [i64; 3], step: [i64; 3], count: [i64; 3]) -> Option<[i64; 3]> {
    let mut b = [0; 3];
    for a in 0..3 {
        b[a] = at[a] + step[a];
        if cell.is_periodic(a) {
            b[a] = b[a].rem_euclid(count[a]);
        } else if b[a] < 0 || b[a] >= count[a] {
            return None;
        }
    }
    Some(b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthetic::Stage;
    use brazilnut_base::vec3;

    #[test]
    fn finds_the_pairs_that_a_double_loop_finds() {
        for (sides, reach) in [("walls", 0.1), ("periodic", 0.1), ("periodic", 0.21), ("periodic", 0.4)] {
            let mut stage = Stage::new(vec3(0.8, 0.5, 1.0), sides);
            stage.scatter(300, 0.01, 11);
            let r = &stage.grains.position;
            let mut direct = vec![];
            for i in 0..r.len() {
                for j in 0..i {
                    let d = stage.cell.nearest(r[j] - r[i]).length();
                    if d < reach {
                        direct.push(d);
                    }
                }
            }
            let mut found = vec![];
            near(r, &stage.cell, Vec3::ZERO, stage.cell.size, reach, |d| found.push(d));
            direct.sort_by(f64::total_cmp);
            found.sort_by(f64::total_cmp);
            assert_eq!(direct.len(), found.len(), "{sides} {reach}");
            assert!(direct.iter().zip(&found).all(|(a, b)| (a - b).abs() < 1e-15));
        }
    }
}

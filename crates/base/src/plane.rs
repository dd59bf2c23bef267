//! Numbers on a regular grid in a plane: their extrema and contours.

use serde::{Deserialize, Serialize};

/// Numbers at the corners of the cells of a plane; the first corner is the origin.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlaneField {
    /// Axes (0 x, 1 y, 2 z) of columns and rows.
    pub axes: [usize; 2],
    /// Corners along them.
    pub shape: [usize; 2],
    /// Distance between corners, m.
    pub spacing: [f64; 2],
    /// Row by row.
    pub values: Vec<f64>,
}

/// A local extremum: its value, and its place along both axes (m).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extremum {
    /// The value between the corners.
    pub value: f64,
    /// m
    pub at: [f64; 2],
}

/// No link.
const NONE: usize = usize::MAX;

impl PlaneField {
    /// The value at column `i` and row `j`.
    #[must_use]
    pub fn at(&self, i: usize, j: usize) -> f64 {
        self.values[i + j * self.shape[0]]
    }

    /// The value at a place (m), between corners linearly along both axes.
    #[must_use]
    pub fn interpolate(&self, place: [f64; 2]) -> f64 {
        let [(i, s), (j, t)] = [0, 1].map(|a| {
            let x = (place[a] / self.spacing[a]).clamp(0.0, (self.shape[a] - 1) as f64);
            let low = (x.floor() as usize).min(self.shape[a].saturating_sub(2));
            (low, x - low as f64)
        });
        let row = |j: usize| (1.0 - s) * self.at(i, j) + s * self.at(i + 1, j);
        (1.0 - t) * row(j) + t * row(j + 1)
    }

    /// All maxima (`sign` 1) or minima (-1) among the inner corners, the
    /// extreme one first, from a parabola through each and its neighbours.
    #[must_use]
    pub fn extrema(&self, sign: f64) -> Vec<Extremum> {
        let [m, n] = self.shape;
        let mut found = vec![];
        for j in 1..n.saturating_sub(1) {
            for i in 1..m.saturating_sub(1) {
                if self.is_extreme(i, j, sign) {
                    found.push(self.parabola(i, j));
                }
            }
        }
        found.sort_by(|a, b| (sign * b.value).total_cmp(&(sign * a.value)));
        found
    }

    /// Above all eight neighbours; of equals the first counts.
    fn is_extreme(&self, i: usize, j: usize, sign: f64) -> bool {
        let here = sign * self.at(i, j);
        let before = [(i - 1, j - 1), (i, j - 1), (i + 1, j - 1), (i - 1, j)];
        let after = [(i + 1, j), (i - 1, j + 1), (i, j + 1), (i + 1, j + 1)];
        before.iter().all(|&(a, b)| here > sign * self.at(a, b))
            && after.iter().all(|&(a, b)| here >= sign * self.at(a, b))
    }

    fn parabola(&self, i: usize, j: usize) -> Extremum {
        let here = self.at(i, j);
        let vertex = |behind: f64, ahead: f64| {
            let (slope, curve) = (0.5 * (ahead - behind), ahead - 2.0 * here + behind);
            if curve == 0.0 { (0.0, 0.0) } else { (-slope / curve, -0.5 * slope * slope / curve) }
        };
        let (x, rise) = vertex(self.at(i - 1, j), self.at(i + 1, j));
        let (y, more) = vertex(self.at(i, j - 1), self.at(i, j + 1));
        Extremum {
            value: here + rise + more,
            at: [(i as f64 + x) * self.spacing[0], (j as f64 + y) * self.spacing[1]],
        }
    }

    /// The lines (m) along which the value is `level`, by marching squares.
    #[must_use]
    pub fn contour(&self, level: f64) -> Vec<Vec<[f64; 2]>> {
        let mut links = self.links(level);
        let mut lines = vec![];
        // Lines that end at the rim first; what is left closes on itself.
        for open in [true, false] {
            for edge in 0..links.len() {
                let ends = links[edge].iter().filter(|&&l| l != NONE).count();
                if ends == 1 || (!open && ends == 2) {
                    lines.push(self.follow(&mut links, edge, level));
                }
            }
        }
        lines
    }

    /// For every edge between two corners that the contour crosses, the next
    /// edges along it. Edge `e` leaves corner `e / 2` along axis `e % 2`.
    fn links(&self, level: f64) -> Vec<[usize; 2]> {
        let [m, n] = self.shape;
        let mut links = vec![[NONE; 2]; 2 * m * n];
        let above = |i: usize, j: usize| self.at(i, j) >= level;
        for j in 0..n.saturating_sub(1) {
            for i in 0..m.saturating_sub(1) {
                let corner = |i: usize, j: usize| i + j * m;
                let corners = [above(i, j), above(i + 1, j), above(i + 1, j + 1), above(i, j + 1)];
                let edges =
                    [2 * corner(i, j), 2 * corner(i + 1, j) + 1, 2 * corner(i, j + 1), 2 * corner(i, j) + 1];
                let crossed = [0, 1, 2, 3].map(|k| corners[k] != corners[(k + 1) % 4]);
                let mut join = |a: usize, b: usize| {
                    for (from, to) in [(edges[a], edges[b]), (edges[b], edges[a])] {
                        let free = usize::from(links[from][0] != NONE);
                        links[from][free] = to;
                    }
                };
                match crossed {
                    [true, true, true, true] => {
                        // A saddle: the centre tells which corners hang together.
                        let sum: f64 = [(i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1)]
                            .iter()
                            .map(|&(a, b)| self.at(a, b))
                            .sum();
                        if (0.25 * sum >= level) == corners[0] {
                            join(0, 1);
                            join(2, 3);
                        } else {
                            join(3, 0);
                            join(1, 2);
                        }
                    }
                    _ => {
                        let mut pair = (0..4).filter(|&k| crossed[k]);
                        if let (Some(a), Some(b)) = (pair.next(), pair.next()) {
                            join(a, b);
                        }
                    }
                }
            }
        }
        links
    }

    /// Takes the line through `edge` out of the links.
    fn follow(&self, links: &mut [[usize; 2]], edge: usize, level: f64) -> Vec<[f64; 2]> {
        let mut line = vec![self.crossing(edge, level)];
        let mut here = edge;
        while let Some(&next) = links[here].iter().find(|&&l| l != NONE) {
            for (a, b) in [(here, next), (next, here)] {
                if let Some(l) = links[a].iter_mut().find(|l| **l == b) {
                    *l = NONE;
                }
            }
            line.push(self.crossing(next, level));
            here = next;
        }
        line
    }

    /// Where the contour crosses an edge, m.
    fn crossing(&self, edge: usize, level: f64) -> [f64; 2] {
        let (corner, axis) = (edge / 2, edge % 2);
        let (i, j) = (corner % self.shape[0], corner / self.shape[0]);
        let mut place = [i as f64, j as f64];
        let (a, b) = (self.at(i, j), if axis == 0 { self.at(i + 1, j) } else { self.at(i, j + 1) });
        place[axis] += (level - a) / (b - a);
        [place[0] * self.spacing[0], place[1] * self.spacing[1]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn field(f: impl Fn(f64, f64) -> f64) -> PlaneField {
        let (shape, spacing) = ([41, 31], [0.05, 0.1]);
        let values = (0..shape[0] * shape[1])
            .map(|c| f((c % shape[0]) as f64 * spacing[0], (c / shape[0]) as f64 * spacing[1]))
            .collect();
        PlaneField { axes: [0, 2], shape, spacing, values }
    }

    #[test]
    fn a_paraboloid_has_one_extremum_between_the_corners() {
        let p = field(|x, y| 3.0 - (x - 0.71).powi(2) - 2.0 * (y - 1.43).powi(2));
        let top = p.extrema(1.0);
        assert_eq!(top.len(), 1);
        // A parabola through a parabola: exact to rounding.
        assert!((top[0].value - 3.0).abs() < 1e-13, "{top:?}");
        assert!((top[0].at[0] - 0.71).abs() < 1e-13 && (top[0].at[1] - 1.43).abs() < 1e-13, "{top:?}");
        assert!(p.extrema(-1.0).is_empty());
        // Linear along x and y between corners: off by at most h²/4 + 2 l²/4.
        assert!((p.interpolate([0.71, 1.43]) - 3.0).abs() < 0.25 * 0.05 * 0.05 + 0.5 * 0.1 * 0.1);
    }

    #[test]
    fn equal_heights_count_once() {
        let p = field(|x, y| -((x - 0.725).abs().max(0.05)) - (y - 1.0).abs());
        assert_eq!(p.extrema(1.0).len(), 1);
    }

    #[test]
    fn a_contour_closes_around_a_hill_and_ends_at_the_rim() {
        let hill = field(|x, y| (x - 1.0).powi(2) + (y - 1.5).powi(2));
        let lines = hill.contour(0.49);
        assert_eq!(lines.len(), 1);
        let line = &lines[0];
        assert_eq!(line.first(), line.last());
        for [x, y] in line {
            let r = (x - 1.0).hypot(y - 1.5);
            // Linear between corners of r²: off by l²/4, and that over 2 r in r.
            assert!((r - 0.7).abs() < 0.1 * 0.1 / 4.0 / 1.4 + 1e-4, "{r}");
        }
        let slope = field(|x, y| x + y);
        let lines = slope.contour(1.01);
        assert_eq!(lines.len(), 1);
        assert!(lines[0].iter().all(|[x, y]| (x + y - 1.01).abs() < 1e-12));
        let mut ends = [lines[0][0], lines[0][lines[0].len() - 1]];
        ends.sort_by(|a, b| a[0].total_cmp(&b[0]));
        assert!(ends[0][0].abs() < 1e-12 && ends[1][1].abs() < 1e-12, "{ends:?}");
        assert!(slope.contour(99.0).is_empty());
    }

    #[test]
    fn a_saddle_is_cut_in_two() {
        let saddle = field(|x, y| (x - 1.025) * (y - 1.55));
        assert_eq!(saddle.contour(1e-9).len(), 2);
        assert_eq!(saddle.contour(-1e-9).len(), 2);
    }
}

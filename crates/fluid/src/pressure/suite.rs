//! What every direct solver must satisfy, for all sides it claims.

use super::{Poisson, Transforms};
use crate::grid::Grid;

use crate::spec::Instructions;
use brazilnut_base::Side;

/// A right side without mean, of order one.
fn noise(n: usize) -> Vec<f64> {
    let mut x = 0.123_f64;
    let mut f: Vec<f64> = (0..n)
        .map(|_| {
            x = 3.99 * x * (1.0 - x);
            x - 0.5
        })
        .collect();
    super::tridiagonal::remove_mean(&mut f);
    f
}

/// max |laplacian p - f| and the mean of p.
fn residual(grid: &Grid, open: [bool; 2], path: Instructions, transforms: Transforms) -> (f64, f64) {
    let poisson = Poisson::new(grid, open, path, transforms);
    let order = grid.memory_order();
    let n = order.map(|a| grid.cells[a]);
    let h = order.map(|a| grid.spacing[a]);
    let side = order.map(|a| grid.sides[a]);
    let f = noise(grid.count());
    let mut data = vec![0.0; poisson.len()];
    let at = |i: usize, j: usize, k: usize| i + n[0] * (j + n[1] * k);
    for k in 0..n[2] {
        for j in 0..n[1] {
            let row = poisson.row(j, k);
            data[row..row + n[0]].copy_from_slice(&f[at(0, j, k)..at(0, j, k) + n[0]]);
        }
    }
    poisson.solve(&mut data);
    let p = |c: [usize; 3]| data[poisson.row(c[1], c[2]) + c[0]];
    let (mut worst, mut mean) = (0.0_f64, 0.0);
    for k in 0..n[2] {
        for j in 0..n[1] {
            for i in 0..n[0] {
                let c = [i, j, k];
                mean += p(c) / grid.count() as f64;
                let mut laplacian = 0.0;
                for level in 0..3 {
                    for up in [false, true] {
                        let mut d = c;
                        let edge = if up { c[level] + 1 == n[level] } else { c[level] == 0 };
                        let beyond = if !edge {
                            d[level] = if up { d[level] + 1 } else { d[level] - 1 };
                            p(d)
                        } else if side[level] == Side::Periodic {
                            d[level] = if up { 0 } else { n[level] - 1 };
                            p(d)
                        } else if level == 0 && open[usize::from(up)] {
                            -p(c)
                        } else {
                            p(c)
                        };
                        laplacian += (beyond - p(c)) / (h[level] * h[level]);
                    }
                }
                worst = worst.max((laplacian - f[at(i, j, k)]).abs());
            }
        }
    }
    (worst, mean)
}

#[test]
fn solves_every_mix_of_sides_to_rounding() {
    use Side::{Flat, Periodic, Walls};
    for path in [Instructions::Best, Instructions::Portable] {
        for transforms in [Transforms::Best, Transforms::Library] {
            for a in [Walls, Periodic] {
                for b in [Walls, Periodic, Flat] {
                    for c in [Walls, Periodic] {
                        for cells in [[10, 9, 14], [17, 12, 5], [24, 16, 33], [5, 2, 3], [9, 7, 2]] {
                            let n = [cells[0], if b == Flat { 1 } else { cells[1] }, cells[2]];
                            let grid = Grid::new(n, [0.5, 0.7, 0.4], [a, b, c]);
                            let (worst, mean) = residual(&grid, [false; 2], path, transforms);
                            // Rounding: values of p reach about 10, second differences of them 4 p / h^2.
                            assert!(worst < 2e-13, "{grid:?} {path:?} {transforms:?}: {worst}");
                            assert!(mean.abs() < 1e-13, "{mean}");
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn open_ends_are_held_at_zero() {
    let sides = [Side::Walls, Side::Periodic, Side::Walls];
    let grid = Grid::new([8, 10, 13], [1.0, 1.1, 0.9], sides).with_line_axis(2);
    for open in [[true, false], [false, true], [true, true]] {
        let (worst, _) = residual(&grid, open, Instructions::Best, Transforms::Best);
        assert!(worst < 1e-13, "{worst}");
    }
}

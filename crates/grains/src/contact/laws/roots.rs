//! Roots that no instruction has, from square roots, products and quotients alone: the same bits on every machine.

use crate::contact::real::Real;

/// x^(1/3) for 1e-18 < x < 1e18, to rounding.
///
/// x^(5/16) by square roots is off by x^(1/48); each step of Halley's cubes what is left of the error.
#[inline(always)]
pub(super) fn cube_root<R: Real>(x: R) -> R {
    let quarter = x.sqrt().sqrt();
    let mut y = quarter * quarter.sqrt().sqrt();
    for _ in 0..4 {
        let y3 = y * y * y;
        y = y * ((y3 + x + x) / (y3 + y3 + x));
    }
    y
}

/// x^(1/5) for 1e-30 < x < 1e30, to rounding; started from x^(3/16).
#[inline(always)]
pub(super) fn fifth_root<R: Real>(x: R) -> R {
    let eighth = x.sqrt().sqrt().sqrt();
    let mut y = eighth * eighth.sqrt();
    let (two, three) = (R::splat(2.0), R::splat(3.0));
    for _ in 0..5 {
        let y2 = y * y;
        let y5 = y2 * y2 * y;
        y = y * ((two * y5 + three * x) / (three * y5 + two * x));
    }
    y
}

#[cfg(test)]
mod tests {
    #[test]
    fn roots_invert_powers() {
        for e in -36..=36 {
            let y = 10f64.powf(f64::from(e) / 6.0);
            // Rounding of the power and of the last step, a few units of 1.1e-16 each.
            let third = super::cube_root(y * y * y) / y - 1.0;
            assert!(third.abs() < 2e-15, "y {y:e}: {third:e}");
            let fifth = super::fifth_root(y * y * y * y * y) / y - 1.0;
            assert!(fifth.abs() < 2e-15, "y {y:e}: {fifth:e}");
        }
    }
}

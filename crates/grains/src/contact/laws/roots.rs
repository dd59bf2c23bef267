//! Roots that no instruction has, from square roots, products and quotients alone: the same bits on every machine.

use crate::contact::real::Real;

/// x^(1/3) for 1e-6 <= x <= 1, to rounding.
///
/// x^(-1/3) from a quadratic in s = x^(1/8) that is within 1 % of s^(1/3), over s³; each step takes the
/// series of (1 - h)^(-1/3), h = 1 - x y³, to h³, and leaves 0.14 h⁴.
#[inline(always)]
pub(super) fn cube_root<R: Real>(x: R) -> R {
    let c = R::splat;
    let s = x.sqrt().sqrt().sqrt();
    let mut y = (c(0.408) + s * (c(0.965) - s * c(0.382))) / (s * s * s);
    for _ in 0..2 {
        let h = c(1.0) - x * y * y * y;
        y = y + y * h * (c(1.0 / 3.0) + h * (c(2.0 / 9.0) + h * c(14.0 / 81.0)));
    }
    x * y * y
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
            if (-12..=0).contains(&e) {
                let third = super::cube_root((y * y * y).clamp(1e-6, 1.0)) / y - 1.0;
                assert!(third.abs() < 2e-15, "y {y:e}: {third:e}");
            }
            let fifth = super::fifth_root(y * y * y * y * y) / y - 1.0;
            assert!(fifth.abs() < 2e-15, "y {y:e}: {fifth:e}");
        }
    }
}

//! How much of a sphere or disc lies beyond planes at right angles.
//!
//! All lengths in radii: the ball is x² + y² + z² < 1. Each function holds for
//! any real arguments, infinities included. By inclusion and exclusion over
//! corners they give the exact part of a sphere inside any axis-aligned box,
//! and sums over a partition of space are exact to rounding.

use std::f64::consts::{FRAC_PI_2, PI};

/// Volume of the unit ball.
pub const BALL: f64 = 4.0 * PI / 3.0;
/// Area of the unit disc.
pub const DISC: f64 = PI;

/// Volume of the ball where x > a: the spherical segment (Lan 3.1),
/// V = (pi/3) (1 - a)² (2 + a).
#[must_use]
pub fn beyond_plane(a: f64) -> f64 {
    let a = a.clamp(-1.0, 1.0);
    PI / 3.0 * (1.0 - a) * (1.0 - a) * (2.0 + a)
}

/// Volume of the ball where x > a and y > b.
///
/// For a, b >= 0 the divergence theorem from the centre gives
/// V = (S - a A_a - b A_b)/3 with A the plane faces (circular segments) and
/// S = 2 pi - a phi_a - b phi_b - 2 psi the spherical face by Gauss-Bonnet;
/// phi is the angle of the arc in its plane, psi = arccos(-a b/(rho_a rho_b))
/// the turn at the two corners, rho_a = sqrt(1 - a²). Negative arguments are reflected.
#[must_use]
pub fn beyond_edge(a: f64, b: f64) -> f64 {
    if a < 0.0 {
        return beyond_plane(b) - if a <= -1.0 { 0.0 } else { beyond_edge(-a, b) };
    }
    if b < 0.0 {
        return beyond_plane(a) - if b <= -1.0 { 0.0 } else { beyond_edge(a, -b) };
    }
    if a * a + b * b >= 1.0 {
        return 0.0;
    }
    let (rho_a, rho_b) = ((1.0 - a * a).sqrt(), (1.0 - b * b).sqrt());
    let (phi_a, phi_b) = (2.0 * arccos(b / rho_a), 2.0 * arccos(a / rho_b));
    let psi = arccos(-a * b / (rho_a * rho_b));
    let sphere = 2.0 * PI - a * phi_a - b * phi_b - 2.0 * psi;
    (sphere - a * segment(rho_a, b) - b * segment(rho_b, a)) / 3.0
}

/// Volume of the ball where x > a, y > b and z > c.
///
/// As [`beyond_edge`], with three faces and three corners:
/// S = 2 pi - sum(a phi_a) - sum(psi_ab), V = (S - sum(a A_a))/3.
#[must_use]
pub fn beyond_corner(a: f64, b: f64, c: f64) -> f64 {
    if a < 0.0 {
        return beyond_edge(b, c) - if a <= -1.0 { 0.0 } else { beyond_corner(-a, b, c) };
    }
    if b < 0.0 {
        return beyond_edge(a, c) - if b <= -1.0 { 0.0 } else { beyond_corner(a, -b, c) };
    }
    if c < 0.0 {
        return beyond_edge(a, b) - if c <= -1.0 { 0.0 } else { beyond_corner(a, b, -c) };
    }
    if a * a + b * b + c * c >= 1.0 {
        return 0.0;
    }
    let rho = [a, b, c].map(|x| (1.0 - x * x).sqrt());
    let face = |own: f64, rho: f64, s: f64, t: f64| {
        let phi = arccos(s / rho) - (t / rho).clamp(-1.0, 1.0).asin();
        own * (phi + quadrant(rho, s, t))
    };
    let turn = |s: f64, t: f64, r: f64| arccos(-s * t / r);
    let turns = turn(a, b, rho[0] * rho[1]) + turn(b, c, rho[1] * rho[2]) + turn(c, a, rho[2] * rho[0]);
    let faces = face(a, rho[0], b, c) + face(b, rho[1], c, a) + face(c, rho[2], a, b);
    (2.0 * PI - turns - faces) / 3.0
}

/// Area of the unit disc where x > a.
#[must_use]
pub fn disc_beyond_line(a: f64) -> f64 {
    segment(1.0, a.clamp(-1.0, 1.0))
}

/// Area of the unit disc where x > a and y > b.
#[must_use]
pub fn disc_beyond_corner(a: f64, b: f64) -> f64 {
    if a < 0.0 {
        return disc_beyond_line(b) - if a <= -1.0 { 0.0 } else { disc_beyond_corner(-a, b) };
    }
    if b < 0.0 {
        return disc_beyond_line(a) - if b <= -1.0 { 0.0 } else { disc_beyond_corner(a, -b) };
    }
    if a * a + b * b < 1.0 { quadrant(1.0, a, b) } else { 0.0 }
}

/// Circular segment: area of a disc of radius `rho` beyond the distance `s`, |s| <= rho.
fn segment(rho: f64, s: f64) -> f64 {
    rho * rho * arccos(s / rho) - s * (rho * rho - s * s).max(0.0).sqrt()
}

/// Area of a disc of radius `rho` where x > s and y > t, for s, t >= 0 and s² + t² < rho².
fn quadrant(rho: f64, s: f64, t: f64) -> f64 {
    let phi = arccos(s / rho) - (t / rho).clamp(-1.0, 1.0).asin();
    let (ls, lt) = ((rho * rho - s * s).max(0.0).sqrt() - t, (rho * rho - t * t).max(0.0).sqrt() - s);
    0.5 * (rho * rho * phi - s * ls - t * lt)
}

/// Arc cosine of a quotient that rounding may carry past one.
fn arccos(x: f64) -> f64 {
    if x == 0.0 { FRAC_PI_2 } else { x.clamp(-1.0, 1.0).acos() }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Area of the disc of radius `rho` beyond x = a, by the midpoint rule in no formula of this file.
    fn by_slices(a: f64, b: f64, c: f64) -> f64 {
        let n = 4000;
        let h = 2.0 / f64::from(n);
        let mut v = 0.0;
        for i in 0..n {
            let x = -1.0 + h * (f64::from(i) + 0.5);
            if x < a {
                continue;
            }
            // Midpoints in the angle of y keep the square-root ends smooth.
            let r = (1.0 - x * x).sqrt();
            let m = 400;
            for k in 0..m {
                let t = PI * (f64::from(k) + 0.5) / f64::from(m);
                let y = -r * t.cos();
                if y > b {
                    let z = (r * r - y * y).max(0.0).sqrt();
                    v += h * PI / f64::from(m) * r * t.sin() * (z - c.max(-z)).max(0.0);
                }
            }
        }
        v
    }

    #[test]
    fn symmetric_parts() {
        assert!((beyond_plane(0.0) - BALL / 2.0).abs() < 1e-15);
        assert!((beyond_edge(0.0, 0.0) - BALL / 4.0).abs() < 1e-15);
        assert!((beyond_corner(0.0, 0.0, 0.0) - BALL / 8.0).abs() < 1e-15);
        assert!((disc_beyond_corner(0.0, 0.0) - DISC / 4.0).abs() < 1e-15);
        assert_eq!(beyond_corner(f64::NEG_INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY), BALL);
        assert_eq!(beyond_corner(f64::INFINITY, -0.2, 0.1), 0.0);
    }

    #[test]
    fn agrees_with_slices() {
        for (a, b, c) in
            [(0.1, 0.2, 0.3), (-0.3, 0.5, 0.1), (-0.4, -0.2, -0.6), (0.55, 0.55, 0.55), (0.7, 0.1, -0.9)]
        {
            let exact = beyond_corner(a, b, c);
            // The slices cut the planes x = a and y = b half way through a cell: error of order h.
            assert!((exact - by_slices(a, b, c)).abs() < 4e-3, "{a} {b} {c}: {exact}");
        }
    }

    #[test]
    fn derivative_of_a_corner_is_its_face() {
        // d/dc of the corner's volume is minus the area of the face z = c, and
        // d/db of that area minus the length of an edge: no slices, so close.
        let (a, b, c, h) = (0.21, -0.33, 0.4, 1e-5);
        let dv = (beyond_corner(a, b, c + h) - beyond_corner(a, b, c - h)) / (2.0 * h);
        let rho = (1.0_f64 - c * c).sqrt();
        let face = rho * rho * disc_beyond_corner(a / rho, b / rho);
        // Central difference: rounding 1e-16/h plus h².
        assert!((dv + face).abs() < 1e-9, "{dv} {face}");
    }

    #[test]
    fn boxes_of_a_partition_add_up_to_the_ball() {
        let nodes = [f64::NEG_INFINITY, -0.71, -0.2, 0.05, 0.4, 0.93, f64::INFINITY];
        let mut total = 0.0;
        for i in 0..6 {
            for j in 0..6 {
                for k in 0..6 {
                    for s in 0..8 {
                        let at = |n: usize, bit: usize| nodes[n + (s >> bit & 1)];
                        let sign = if (s as u32).count_ones().is_multiple_of(2) { 1.0 } else { -1.0 };
                        total += sign * beyond_corner(at(i, 0), at(j, 1), at(k, 2));
                    }
                }
            }
        }
        assert!((total - BALL).abs() < 1e-13);
    }
}

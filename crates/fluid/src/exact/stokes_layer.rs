//! Flow over a plate that oscillates in its own plane (Stokes' second problem),
//! with a second plate at rest at distance H.

use std::f64::consts::TAU;

/// Velocity at height `y` over a plate with velocity `speed cos(2 pi f t)`, once transients have gone, m/s:
/// `u = Re[U exp(i w t) sinh(m (H - y)) / sinh(m H)]`, `m = (1 + i) sqrt(w / 2 nu)`.
#[must_use]
pub fn velocity(speed: f64, frequency: f64, nu: f64, height: f64, y: f64, t: f64) -> f64 {
    let w = TAU * frequency;
    let m = (w / (2.0 * nu)).sqrt();
    // sinh of a (1 + i): real and imaginary part.
    let sinh = |a: f64| [a.sinh() * a.cos(), a.cosh() * a.sin()];
    let [p, q] = sinh(m * (height - y));
    let [r, s] = sinh(m * height);
    let norm = r * r + s * s;
    let ratio = [(p * r + q * s) / norm, (q * r - p * s) / norm];
    let (sin, cos) = (w * t).sin_cos();
    speed * (ratio[0] * cos - ratio[1] * sin)
}

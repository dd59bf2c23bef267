//! A flow in a square box of side 1 m with sticking walls, kept going by a
//! made-up force:
//!
//! ```text
//! u =  pi sin²(pi x) sin(2 pi y) cos(w t)
//! v = -pi sin(2 pi x) sin²(pi y) cos(w t)
//! P/rho = cos(pi x) sin(pi y) cos(w t)
//! ```
//!
//! Divergence and wall velocities vanish; the pressure has a slope at the walls.

use std::f64::consts::PI;

/// The flow for one viscosity and frequency.
#[derive(Clone, Copy, Debug)]
pub struct Manufactured {
    /// nu, m²/s
    pub viscosity: f64,
    /// w, 1/s
    pub rate: f64,
}

impl Manufactured {
    /// (u, v) at (x, y) and time `t`, m/s.
    #[must_use]
    pub fn velocity(&self, x: f64, y: f64, t: f64) -> [f64; 2] {
        let g = (self.rate * t).cos();
        [
            PI * (PI * x).sin().powi(2) * (2.0 * PI * y).sin() * g,
            -PI * (2.0 * PI * x).sin() * (PI * y).sin().powi(2) * g,
        ]
    }

    /// P / rho at (x, y) and time `t`, m²/s².
    #[must_use]
    pub fn pressure(&self, x: f64, y: f64, t: f64) -> f64 {
        (PI * x).cos() * (PI * y).sin() * (self.rate * t).cos()
    }

    /// The force per mass that keeps it going: `dv/dt + (v . grad) v + grad P / rho - nu laplacian v`, m/s².
    #[must_use]
    pub fn force(&self, x: f64, y: f64, t: f64) -> [f64; 2] {
        let (g, dg) = ((self.rate * t).cos(), -self.rate * (self.rate * t).sin());
        let (sx, sy) = ((PI * x).sin().powi(2), (PI * y).sin().powi(2));
        let (s2x, c2x) = (2.0 * PI * x).sin_cos();
        let (s2y, c2y) = (2.0 * PI * y).sin_cos();
        let [u, v] = self.velocity(x, y, t);
        let (p2, p3) = (PI * PI, PI.powi(3));
        // First derivatives; d sin²(pi x)/dx = pi sin(2 pi x).
        let (ux, uy) = (p2 * s2x * s2y * g, 2.0 * p2 * sx * c2y * g);
        let (vx, vy) = (-2.0 * p2 * c2x * sy * g, -p2 * s2x * s2y * g);
        let u_laplacian = (2.0 * p3 * c2x * s2y - 4.0 * p3 * sx * s2y) * g;
        let v_laplacian = (4.0 * p3 * s2x * sy - 2.0 * p3 * s2x * c2y) * g;
        let (px, py) = (-PI * (PI * x).sin() * (PI * y).sin() * g, PI * (PI * x).cos() * (PI * y).cos() * g);
        [
            PI * sx * s2y * dg + u * ux + v * uy + px - self.viscosity * u_laplacian,
            -PI * s2x * sy * dg + u * vx + v * vy + py - self.viscosity * v_laplacian,
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn force_agrees_with_differences() {
        let m = Manufactured { viscosity: 0.3, rate: 2.0 };
        let (x, y, t, h) = (0.31, 0.77, 0.4, 1e-4);
        let d = |f: &dyn Fn(f64) -> f64| (f(h) - f(-h)) / (2.0 * h);
        for c in 0..2 {
            let at = |x: f64, y: f64, t: f64| m.velocity(x, y, t)[c];
            let laplacian = (at(x + h, y, t) + at(x - h, y, t) + at(x, y + h, t) + at(x, y - h, t)
                - 4.0 * at(x, y, t))
                / (h * h);
            let [u, v] = m.velocity(x, y, t);
            let (vx, vy) = (d(&|e| at(x + e, y, t)), d(&|e| at(x, y + e, t)));
            let grad = if c == 0 { d(&|e| m.pressure(x + e, y, t)) } else { d(&|e| m.pressure(x, y + e, t)) };
            let force = d(&|e| at(x, y, t + e)) + u * vx + v * vy + grad - m.viscosity * laplacian;
            // Differences of step 1e-4: truncation 1e-8 times fourth derivatives of order 1e3, rounding 1e-8.
            assert!((force - m.force(x, y, t)[c]).abs() < 1e-4, "{c}: {force} {}", m.force(x, y, t)[c]);
        }
    }
}

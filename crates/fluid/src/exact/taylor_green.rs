//! The decaying Taylor-Green vortex in a periodic plane.
//!
//! ```text
//! u =  U sin(k x) cos(k y) exp(-2 nu k² t)
//! v = -U cos(k x) sin(k y) exp(-2 nu k² t)
//! P =  rho U² / 4 [cos(2 k x) + cos(2 k y)] exp(-4 nu k² t)
//! ```
//!
//! Taylor & Green 1937 in two dimensions; an exact solution at any Reynolds number.

/// Amplitude (m/s), wavenumber (1/m), kinematic viscosity (m²/s), density (kg/m³).
#[derive(Clone, Copy, Debug)]
pub struct TaylorGreen {
    /// U
    pub speed: f64,
    /// k
    pub wavenumber: f64,
    /// nu
    pub viscosity: f64,
    /// rho
    pub density: f64,
}

impl TaylorGreen {
    fn decay(&self, t: f64) -> f64 {
        (-2.0 * self.viscosity * self.wavenumber.powi(2) * t).exp()
    }

    /// (u, v) at (x, y) and time `t`, m/s.
    #[must_use]
    pub fn velocity(&self, x: f64, y: f64, t: f64) -> [f64; 2] {
        let ((sx, cx), (sy, cy)) = ((self.wavenumber * x).sin_cos(), (self.wavenumber * y).sin_cos());
        let a = self.speed * self.decay(t);
        [a * sx * cy, -a * cx * sy]
    }

    /// P at (x, y) and time `t`, Pa.
    #[must_use]
    pub fn pressure(&self, x: f64, y: f64, t: f64) -> f64 {
        let k = 2.0 * self.wavenumber;
        0.25 * self.density * (self.speed * self.decay(t)).powi(2) * ((k * x).cos() + (k * y).cos())
    }
}

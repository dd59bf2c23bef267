//! Advection and diffusion of one velocity component along one direction, at a point.
//!
//! Both appear as differences of the component, so that a uniform flow is
//! carried exactly and the form is the advective one, `(v . grad) v`, also
//! where the porosity makes `div v` non-zero; where `div v = 0` it equals the
//! divergence form to rounding (Morinishi et al. 1998).

use crate::lanes::Lanes;

/// A component at five points in line: two behind, here, two ahead.
#[derive(Clone, Copy)]
pub(crate) struct Line {
    pub far_behind: f64,
    pub behind: f64,
    pub here: f64,
    pub ahead: f64,
    pub far_ahead: f64,
}

/// Speeds that carry the component through the two faces of its control
/// volume, each as the sum of the two values that it is the mean of, m/s.
#[derive(Clone, Copy)]
pub(crate) struct Carrier {
    pub behind: f64,
    pub ahead: f64,
}

/// Factors of one direction.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Factors {
    /// 1 / (4 h), 1/m
    pub advection: f64,
    /// nu / h², 1/s
    pub diffusion: f64,
}

/// A discretisation of `-u_d dv/dx_d + nu d²v/dx_d²`.
pub(crate) trait Flux: Copy + Sync {
    /// Rate of change, m/s².
    fn rate<const W: usize, const F: bool>(self, l: Lanes<W, F>, v: Line, u: Carrier, f: Factors) -> f64;
}

/// Central differences.
///
/// `-[u_+ (v_+ - v) + u_- (v - v_-)] / (2 h) + nu (v_+ - 2 v + v_-) / h²`
///
/// Kinetic energy changes by viscosity alone where `div u = 0` (Harlow & Welch 1965).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Central;

impl Flux for Central {
    #[inline(always)]
    fn rate<const W: usize, const F: bool>(self, l: Lanes<W, F>, v: Line, u: Carrier, f: Factors) -> f64 {
        let (plus, minus) = (v.ahead - v.here, v.here - v.behind);
        let a = l.madd(-f.advection, u.ahead, f.diffusion);
        let b = l.madd(f.advection, u.behind, f.diffusion);
        l.madd(plus, a, -(minus * b))
    }
}

/// Third-order upwind-biased interpolation with Koren's limiter (Koren 1993).
///
/// `v_face = v_C + L(v_C - v_U, v_D - v_C) / 2` with U, C, D the two points
/// upstream and the one downstream of the face.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Koren;

/// `a psi(b / a)` with `psi(r) = max(0, min(2 r, (1 + 2 r) / 3, 2))`.
#[inline(always)]
fn limited(a: f64, b: f64) -> f64 {
    let (x, y) = (a.abs(), b.abs());
    let least = (2.0 * y).min((x + 2.0 * y) * (1.0 / 3.0)).min(2.0 * x);
    if a * b > 0.0 { least.copysign(a) } else { 0.0 }
}

impl Flux for Koren {
    #[inline(always)]
    fn rate<const W: usize, const F: bool>(self, l: Lanes<W, F>, v: Line, u: Carrier, f: Factors) -> f64 {
        let (plus, minus) = (v.ahead - v.here, v.here - v.behind);
        let (far_plus, far_minus) = (v.far_ahead - v.ahead, v.behind - v.far_behind);
        // Twice the face value less the value here, for flow ahead and for flow back.
        let ahead = if u.ahead > 0.0 { limited(minus, plus) } else { 2.0 * plus - limited(far_plus, plus) };
        let behind =
            if u.behind > 0.0 { limited(far_minus, minus) - 2.0 * minus } else { -limited(plus, minus) };
        let carried = l.madd(u.ahead, ahead, -(u.behind * behind));
        l.madd(-f.advection, carried, f.diffusion * (plus - minus))
    }
}

/// Diffusion alone.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Still;

impl Flux for Still {
    #[inline(always)]
    fn rate<const W: usize, const F: bool>(self, _: Lanes<W, F>, v: Line, _: Carrier, f: Factors) -> f64 {
        f.diffusion * ((v.ahead - v.here) - (v.here - v.behind))
    }
}

#[cfg(test)]
mod tests {
    use super::limited;

    #[test]
    fn limiter_is_third_order_where_smooth_and_flat_at_extrema() {
        assert!((limited(1.0, 1.1) - (1.0 + 2.2) / 3.0).abs() < 1e-15);
        assert_eq!(limited(1.0, -0.1), 0.0);
        assert_eq!(limited(0.1, 1.0), 0.2);
        assert_eq!(limited(1.0, 0.1), 0.2);
        assert_eq!(limited(-1.0, -0.1), -0.2);
    }
}

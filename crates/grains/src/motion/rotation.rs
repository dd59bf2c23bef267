//! Orientations.

use super::quad::Quad;

/// Turns the orientation `q` (x y z w) by twice the small rotation vector `half` (rad):
/// q <- (half, 1) q, brought back to unit length. Third order in the angle.
#[inline(always)]
pub fn turn<Q: Quad>(q: &mut [f64; 4], half: Q) {
    let ([x, y, z, w], [a, b, c, _]) = (*q, half.lanes());
    let new = Q::of(*q) + Q::of([w, -z, y, -x]) * a + Q::of([z, w, -x, -y]) * b + Q::of([-y, x, w, -z]) * c;
    // One Newton step of 1/sqrt for the length of the product, which is that of the factors: their squares are
    // there before it.
    let [x, y, z, _] = (Q::of(*q) * Q::of(*q) + half * half).lanes();
    (new * (1.5 - 0.5 * ((x + y) + (z + w * w)))).store(q, 0);
}

#[cfg(test)]
mod tests {
    use super::super::quad::Array;
    use super::*;
    use brazilnut_base::Quat;

    #[test]
    fn many_small_turns_make_a_large_one() {
        let mut q = Quat::IDENTITY.to_array();
        let n = 10_000;
        for _ in 0..n {
            turn(&mut q, Array::of([0.0, 0.0, 0.5 / f64::from(n), 0.0]));
        }
        let q = Quat::from_array(q);
        // Each turn is atan(a/2)*2 = a - a³/12: relative 1e-9 at a = 1e-4.
        assert!(q.angle_between(Quat::from_rotation_z(1.0)) < 1e-7);
        assert!((q.length() - 1.0).abs() < 1e-12);
    }
}

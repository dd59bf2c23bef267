//! Orientations.

use brazilnut_base::{Quat, Vec3};

/// Turns the orientation `q` by the small rotation vector `angle` (rad):
/// q <- (1, angle/2) q, brought back to unit length. Third order in the angle.
#[inline(always)]
pub fn turn(q: &mut [f64; 4], angle: Vec3) {
    let old = Quat::from_array(*q);
    let half = 0.5 * angle;
    let new = Quat::from_xyzw(half.x, half.y, half.z, 1.0) * old;
    // One Newton step of 1/sqrt: the length is 1 up to the square of the angle.
    let scale = 1.5 - 0.5 * new.length_squared();
    *q = (new * scale).to_array();
}

#[cfg(test)]
mod tests {
    use super::*;
    use brazilnut_base::vec3;

    #[test]
    fn many_small_turns_make_a_large_one() {
        let mut q = Quat::IDENTITY.to_array();
        let n = 10_000;
        for _ in 0..n {
            turn(&mut q, vec3(0.0, 0.0, 1.0 / f64::from(n)));
        }
        let q = Quat::from_array(q);
        // Each turn is atan(a/2)*2 = a - a³/12: relative 1e-9 at a = 1e-4.
        assert!(q.angle_between(Quat::from_rotation_z(1.0)) < 1e-7);
        assert!((q.length() - 1.0).abs() < 1e-12);
    }
}

//! How the engine keeps its grains: rows of one cache line in sorted order.

use crate::contact::V3;
use crate::contact::real::Real;
use serde::{Deserialize, Serialize};

/// Position (m), radius (m), velocity at the time of the position (m/s), 1/mass (1/kg).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[repr(C, align(64))]
pub struct Row(pub [f64; 8]);

/// Radius times angular velocity (m/s) at the time of the position, 1/radius (1/m).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[repr(C, align(32))]
pub struct Spin(pub [f64; 4]);

/// Half-step velocity (m/s), mass (kg), half-step angular velocity (rad/s), radius over inertia (1/(kg m)).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[repr(C, align(64))]
pub struct Half(pub [f64; 8]);

/// Force (N) and the sum of lever ratio times normal x force (N), whose product with -radius is the torque.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C, align(64))]
pub struct Force(pub [f64; 8]);

/// Couple of rolling friction, N m.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C, align(32))]
pub struct Couple(pub [f64; 4]);

/// Who a row is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Tag {
    /// Identity.
    pub id: u32,
    /// Species.
    pub species: u16,
    /// Material.
    pub material: u16,
}

/// What the force loop never needs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Rest {
    /// Orientation, x y z w.
    pub orientation: [f64; 4],
    /// Moment of inertia, kg m².
    pub inertia: f64,
    /// Periodic cells crossed.
    pub image: [i32; 3],
}

/// Rows behind the last grain: two bodies that touch nothing, to fill up a batch.
pub const DUMMIES: usize = 2;

impl Row {
    /// The dummy `k`, so far away that no length of a real cell compares.
    #[must_use]
    pub fn dummy(k: usize) -> Self {
        let far = if k == 0 { 1e30 } else { -1e30 };
        Self([far, far, far, 0.0, 0.0, 0.0, 0.0, 1.0])
    }

    /// Position, m.
    #[inline(always)]
    #[must_use]
    pub fn position(&self) -> brazilnut_base::Vec3 {
        brazilnut_base::vec3(self.0[0], self.0[1], self.0[2])
    }

    /// Velocity, m/s.
    #[inline(always)]
    #[must_use]
    pub fn velocity(&self) -> brazilnut_base::Vec3 {
        brazilnut_base::vec3(self.0[4], self.0[5], self.0[6])
    }

    /// Radius, m.
    #[inline(always)]
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.0[3]
    }
}

/// Bits of a list entry's second index that hold the row; the rest is the image.
pub const INDEX_BITS: u32 = 27;
/// Mask of those bits.
pub const INDEX: u32 = (1 << INDEX_BITS) - 1;

/// Packs which periodic image of the second body is meant, -1, 0 or 1 per axis; 0 for the body itself.
#[inline(always)]
#[must_use]
pub fn image_code(s: [i32; 3]) -> u32 {
    let c = (s[0] + 1) * 9 + (s[1] + 1) * 3 + (s[2] + 1);
    ((c + 14) % 27) as u32
}

/// The image that `image_code` packed.
#[inline(always)]
#[must_use]
pub fn image_of(code: u32) -> [i32; 3] {
    let c = (code as i32 + 13) % 27;
    [c / 9 - 1, c / 3 % 3 - 1, c % 3 - 1]
}

/// Shift to each periodic image, by its code, m.
#[derive(Clone, Debug)]
pub struct Shifts([[f64; 3]; 1 << (u32::BITS - INDEX_BITS)]);

impl Shifts {
    /// Those of a cell of this size.
    #[must_use]
    pub fn new(size: brazilnut_base::Vec3) -> Self {
        let mut all = Self([[0.0; 3]; 32]);
        for code in 0..27 {
            let s = image_of(code);
            all.0[code as usize] = std::array::from_fn(|a| f64::from(s[a]) * size[a]);
        }
        all
    }

    /// Those of the second bodies of some list entries.
    #[inline(always)]
    pub fn of<R: Real>(&self, coded: &[u32]) -> V3<R> {
        let shift = |axis: usize| R::from_lanes(|k| self.0[(coded[k] >> INDEX_BITS) as usize][axis]);
        V3::new(shift(0), shift(1), shift(2))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn images_survive_packing() {
        assert_eq!(image_code([0, 0, 0]), 0);
        for c in 0..27 {
            assert_eq!(image_code(image_of(c)), c);
        }
    }

    #[test]
    fn rows_fill_cache_lines() {
        assert_eq!(size_of::<Row>(), 64);
        assert_eq!(size_of::<Spin>(), 32);
        assert_eq!(size_of::<Half>(), 64);
    }
}

//! Walls: bodies of infinite mass that move as prescribed.

mod place;

pub use place::{Near, Walls};

use brazilnut_base::Vec3;
use brazilnut_base::motion::Motion;
use serde::{Deserialize, Serialize};

/// One wall.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WallSpec {
    /// Name in the case and in the tables.
    pub name: String,
    /// Surface, where it stands when its displacement is zero.
    pub shape: WallShape,
    /// Index of the material.
    pub material: u16,
    /// Its own motion in the frame of the cell.
    pub motion: Motion,
}

/// Surface of a wall.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum WallShape {
    /// An unbounded plane; grains are on the side that `normal` points to.
    Plane {
        /// A point of the plane, m.
        point: Vec3,
        /// Unit vector towards the grains.
        normal: Vec3,
    },
    /// A solid box with axis-parallel faces inside the cell. Boxes that touch form one body.
    Box {
        /// Lower corner, m.
        low: Vec3,
        /// Upper corner, m.
        high: Vec3,
    },
    /// Spheres side by side with their centres in a plane (Lan 2.6.3); add the plane itself as a wall if
    /// grains can pass between them.
    Bumps {
        /// Axis perpendicular to the plane: 0, 1 or 2.
        axis: usize,
        /// Coordinate of the plane along that axis, m.
        at: f64,
        /// Radius of the spheres, m.
        radius: f64,
        /// Distance of neighbours, m (rounded to a whole number of periods per cell).
        spacing: f64,
        /// How they are arranged.
        arrangement: Arrangement,
    },
}

/// Arrangement of bumps.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Arrangement {
    /// Four neighbours.
    Square,
    /// Six neighbours.
    Triangular,
}

/// What the grains did to one wall in the last step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct WallLoad {
    /// Force on the wall, N.
    pub force: Vec3,
    /// Number of touching grains.
    pub contacts: u32,
}

//! What the fluid meets at the sides of the box.

use brazilnut_base::Vec3;
use brazilnut_base::menu::Entry;
use brazilnut_base::motion::Motion;
use serde::{Deserialize, Serialize};

/// One side of the box in a walled direction.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Boundary {
    /// A wall at rest to which the fluid sticks.
    NoSlip,
    /// A wall that the fluid slides along without friction; also a plane of symmetry.
    FreeSlip,
    /// A wall to which the fluid sticks and which moves in its own plane.
    MovingLid {
        /// Steady velocity, m/s; the part normal to the wall is ignored.
        velocity: Vec3,
        /// Oscillation on top of it.
        motion: Motion,
    },
    /// Fluid enters (or, with a negative speed, is drawn off) with a given profile.
    Inflow {
        /// Normal velocity into the box over the side.
        profile: Profile,
    },
    /// Fluid leaves or enters against a given pressure.
    Outflow {
        /// Reduced pressure at the side, Pa.
        pressure: f64,
    },
}

/// Normal velocity over an inflow side.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Profile {
    /// The same speed everywhere, m/s.
    Uniform(f64),
    /// Laminar flow between the walls that bound the side, of this mean speed, m/s:
    /// a parabola in each walled direction across.
    Parabolic(f64),
}

impl Boundary {
    /// A lid of steady `velocity`, m/s.
    #[must_use]
    pub fn lid(velocity: Vec3) -> Self {
        Self::MovingLid { velocity, motion: Motion::default() }
    }

    /// True if fluid passes.
    #[must_use]
    pub fn is_open(&self) -> bool {
        matches!(self, Self::Inflow { .. } | Self::Outflow { .. })
    }
}

/// What a case may name for a side.
pub const BOUNDARIES: &[Entry] = &[
    Entry {
        name: "no-slip",
        summary: "A wall at rest to which the fluid sticks.",
        formula: "v = 0",
        source: "Clément 2009, 2.2.2",
    },
    Entry {
        name: "free-slip",
        summary: "A wall without friction; also a plane of symmetry.",
        formula: "v_n = 0, d v_t / dn = 0",
        source: "Clément 2009, 2.2.2",
    },
    Entry {
        name: "moving-lid",
        summary: "A sticking wall that moves in its own plane.",
        formula: "v_n = 0, v_t = U",
        source: "Clément 2009, 2.2.3 (with no-slip, which the drive needs)",
    },
    Entry {
        name: "inflow",
        summary: "Fluid enters with a prescribed profile of normal velocity.",
        formula: "v_n = U(r), v_t = 0",
        source: "",
    },
    Entry {
        name: "outflow",
        summary: "Fluid leaves against a prescribed pressure.",
        formula: "P = P_out, d v / dn = 0",
        source: "",
    },
];

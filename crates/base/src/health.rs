//! The address of a blow-up.

use crate::Tick;
use std::fmt;

/// The physics left the region in which the model means anything.
#[derive(Clone, Debug, PartialEq)]
pub struct Blowup {
    /// The step in which it was noticed.
    pub tick: Tick,
    /// Which quantity broke, with its value and limit, e.g. `overlap 0.31 of the radius (limit 0.2)`.
    pub quantity: String,
    /// Where: `grain 17 at (…) m`, `fluid cell (3, 0, 9)`.
    pub place: String,
    /// What the user can do about it.
    pub remedy: String,
}

impl fmt::Display for Blowup {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "the run blew up in step {} at t = {:.6e} s: {}, {}\n  remedy: {}",
            self.tick.index, self.tick.time, self.quantity, self.place, self.remedy
        )
    }
}

impl std::error::Error for Blowup {}

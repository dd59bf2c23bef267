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
        // Before time 0 the bed settles; that time has no other meaning.
        if self.tick.time < 0.0 {
            write!(f, "the run blew up while settling, in step {}", self.tick.index)?;
        } else {
            write!(f, "the run blew up in step {} at t = {:.6e} s", self.tick.index, self.tick.time)?;
        }
        write!(f, ": {}, {}\n  remedy: {}", self.quantity, self.place, self.remedy)
    }
}

impl std::error::Error for Blowup {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settling_has_steps_but_no_time() {
        let text = |time: f64| {
            let tick = Tick { index: 40, time, dt: 1e-5 };
            Blowup { tick, quantity: "overlap".into(), place: "grain 3".into(), remedy: "r".into() }
                .to_string()
        };
        assert!(text(-1.0).starts_with("the run blew up while settling, in step 40: overlap, grain 3\n"));
        assert!(text(4e-4).starts_with("the run blew up in step 40 at t = 4.000000e-4 s: overlap"));
    }
}

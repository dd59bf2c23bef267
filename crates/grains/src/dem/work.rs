//! Work space of one block.

use crate::contact::sweep::Tally;
use crate::motion::Passed;
use crate::neighbors::all::Columns;
use crate::neighbors::inner::Spare;
use crate::packed::{Couple, Force};
use crate::wall::WallLoad;

/// What a block sums up in a step.
pub struct Work {
    /// Forces on the block's rows, then those of the block's grains on the big bodies.
    pub forces: Vec<Force>,
    /// How many of them are the block's own.
    own: usize,
    /// Rolling couples, likewise, if any law rolls.
    pub couples: Vec<Couple>,
    /// Loads on walls.
    pub loads: Vec<WallLoad>,
    /// Sums over contacts counted here.
    pub tally: Tally,
    /// Sums over contacts counted elsewhere.
    pub discard: Tally,
    /// What the pass over the grains found.
    pub passed: Passed,
    /// Buffers of pruning.
    pub spare: Spare,
    /// Buffers of the search among few.
    pub columns: Columns,
}

impl Default for Work {
    fn default() -> Self {
        Self {
            forces: vec![],
            own: 0,
            couples: vec![],
            loads: vec![],
            tally: Tally::default(),
            discard: Tally::default(),
            passed: Passed::nothing(),
            spare: Spare::default(),
            columns: Columns::default(),
        }
    }
}

impl Work {
    /// Zero forces for `own` rows, `big` bodies and `walls` walls. The motion leaves zeros on the block's own rows.
    pub fn clear(&mut self, own: usize, big: usize, walls: usize, rolls: bool) {
        if (self.own, self.forces.len()) == (own, own + big) {
            self.forces[own..].fill(Force::default());
        } else {
            self.own = own;
            zero(&mut self.forces, own + big);
        }
        zero(&mut self.couples, if rolls { own + big } else { 0 });
        zero(&mut self.loads, walls);
        self.tally = Tally::default();
        self.discard = Tally::default();
        self.passed = Passed::nothing();
    }
}

fn zero<T: Clone + Default>(v: &mut Vec<T>, len: usize) {
    v.clear();
    v.resize(len, T::default());
}

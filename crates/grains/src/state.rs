//! Everything that a run must save to go on bit for bit.

use crate::neighbors::Skins;
use crate::packed::{Half, Rest, Row, Spin, Tag};
use brazilnut_base::Vec3;
use serde::{Deserialize, Serialize};

/// The engine's state between two steps: grains in sorted order, contact
/// memory, neighbour lists with their displacement bounds, energy sums.
///
/// Positions and predicted velocities belong to the time `time`; half-step
/// velocities lie half a step before it. The forces at `time` are evaluated
/// by the next step.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DemState {
    /// Time of the positions, s.
    pub(crate) time: f64,
    /// Half-step velocities are still those of `time` itself.
    pub(crate) fresh: bool,
    /// Rows of all grains, then the dummies.
    pub(crate) rows: Vec<Row>,
    /// Spins, likewise.
    pub(crate) spins: Vec<Spin>,
    /// Half-step velocities.
    pub(crate) halves: Vec<Half>,
    /// Predicted higher derivatives, if the integrator keeps any.
    pub(crate) higher: Vec<[f64; 12]>,
    /// Who each row is.
    pub(crate) tags: Vec<Tag>,
    /// Orientation, inertia, image.
    pub(crate) rest: Vec<Rest>,
    /// Rows from here on are big bodies, held apart from the cells.
    pub(crate) small: usize,
    /// Lists of each block of rows; the last block holds the big bodies.
    pub(crate) blocks: Vec<Lists>,
    /// How far grains may have moved since the lists were made.
    pub(crate) drift: Drift,
    /// Energy sums.
    pub(crate) sums: Sums,
    /// Load on each wall in the last step.
    pub(crate) loads: Vec<crate::wall::WallLoad>,
    /// Displacement of each wall when the outer and the inner lists were made, m.
    pub(crate) wall_marks: [Vec<Vec3>; 2],
    /// Skins of the lists.
    pub(crate) skins: Skins,
    /// Least radius of all, greatest of the small grains, m.
    pub(crate) radii: [f64; 2],
    /// Largest overlap in the last step, m.
    pub(crate) overlap: f64,
    /// Touching pairs and wall contacts in the last step.
    pub(crate) contacts: u64,
    /// Contacts that have begun since the start.
    pub(crate) collisions: Collisions,
    /// Lowest and highest coordinates of centres.
    pub(crate) extent: [Vec3; 2],
    /// Work done on lists so far.
    pub(crate) counts: Counts,
    /// Steps taken when the outer lists were made.
    pub(crate) built: u64,
}

/// What can be said about displacements since a list was made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Drift {
    /// Sum over steps of the least displacement of any grain, per axis, since the outer list.
    pub low: Vec3,
    /// Sum of the greatest.
    pub high: Vec3,
    /// As `low`, since the inner list.
    pub inner_low: Vec3,
    /// As `high`, since the inner list.
    pub inner_high: Vec3,
}

impl Drift {
    /// Adds a step in which displacements lay between `low` and `high` (m).
    pub fn step(&mut self, low: Vec3, high: Vec3) {
        self.low += low;
        self.high += high;
        self.inner_low += low;
        self.inner_high += high;
    }
}

/// Work on lists.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Counts {
    /// Steps taken.
    pub steps: u64,
    /// Outer lists made.
    pub builds: u64,
    /// Inner lists made.
    pub prunes: u64,
}

/// Numbers of contacts that have begun: of bodies that touch in a step and did not in the one before.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Collisions {
    /// Between two grains.
    pub grains: u64,
    /// Between a grain and a wall.
    pub walls: u64,
}

/// Running energy sums, J.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Sums {
    /// Energy at the start and put in by hand.
    pub initial: f64,
    /// Work of gravity.
    pub gravity: f64,
    /// Work of the frame.
    pub frame: f64,
    /// Work of the fluid.
    pub fluid: f64,
    /// Work of walls.
    pub walls: f64,
    /// Losses by kind (index 0, the stored energy, is unused).
    pub lost: [f64; crate::contact::energy::KINDS],
}

/// Neighbour lists of one block of rows.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Lists {
    /// First row.
    pub start: usize,
    /// Row after the last.
    pub end: usize,
    /// Both bodies in this block.
    pub inside: Pairs,
    /// First body in this block, second in another; counted here.
    pub first: Pairs,
    /// Second body in this block, first in another; counted there.
    pub second: Pairs,
    /// First body in this block, second a big body.
    pub big: Pairs,
    /// Walls.
    pub walls: WallPairs,
}

/// Candidate pairs and, among them, those that may touch before the next pruning.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Pairs {
    /// Outer list: first bodies.
    pub outer_i: Vec<u32>,
    /// Outer list: second bodies with image.
    pub outer_j: Vec<u32>,
    /// Inner list, filled up to a whole batch with dummies.
    pub i: Vec<u32>,
    /// Second bodies with image.
    pub j: Vec<u32>,
    /// Place in the outer list.
    pub from: Vec<u32>,
    /// Pair class.
    pub class: Vec<u8>,
    /// Number of real pairs in the inner list.
    pub len: usize,
    /// Contact memory: by batch of eight, then slot.
    pub memory: Vec<Line>,
    /// Who touched when last swept: a byte per batch, a bit per pair.
    pub touched: Vec<u8>,
}

/// Candidate wall contacts, as [`Pairs`].
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct WallPairs {
    /// Outer list: row, wall, feature of the wall.
    pub outer: Vec<(u32, u16, u32)>,
    /// Inner list.
    pub inner: Vec<(u32, u16, u32)>,
    /// Place in the outer list.
    pub from: Vec<u32>,
    /// Pair class.
    pub class: Vec<u8>,
    /// Contact memory, as in [`Pairs`].
    pub memory: Vec<Line>,
    /// Who touched when last swept, as in [`Pairs`].
    pub touched: Vec<u8>,
}

/// Batches are padded to this many lanes.
pub const BATCH: usize = 8;

/// One number that each contact of a batch remembers: a cache line, which a sweep reads and writes whole.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[repr(C, align(64))]
pub struct Line(pub [f64; BATCH]);

/// Line and lane of slot `s` of contact `p` in a memory array.
#[inline(always)]
#[must_use]
pub fn memory_place(p: usize, s: usize, slots: usize) -> (usize, usize) {
    (p / BATCH * slots + s, p % BATCH)
}

/// What contact `p` remembers in slot `s`.
#[must_use]
pub fn remembered(memory: &[Line], p: usize, s: usize, slots: usize) -> f64 {
    let (line, lane) = memory_place(p, s, slots);
    memory[line].0[lane]
}

/// Lets contact `p` remember `x` in slot `s`.
pub fn note(memory: &mut [Line], p: usize, s: usize, slots: usize, x: f64) {
    let (line, lane) = memory_place(p, s, slots);
    memory[line].0[lane] = x;
}

/// Whether contact `p` touched when last swept.
#[must_use]
pub fn has_touched(touched: &[u8], p: usize) -> bool {
    touched[p / BATCH] >> (p % BATCH) & 1 == 1
}

/// Notes that contact `p` touched when last swept.
pub fn note_touched(touched: &mut [u8], p: usize) {
    touched[p / BATCH] |= 1 << (p % BATCH);
}

impl DemState {
    /// Number of grains.
    #[must_use]
    pub fn len(&self) -> usize {
        self.tags.len()
    }

    /// True if there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.tags.is_empty()
    }

    /// Time of the positions, s.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Number of touching pairs and wall contacts in the last step.
    #[must_use]
    pub fn contact_count(&self) -> u64 {
        self.contacts
    }

    /// Contacts that have begun since the start.
    #[must_use]
    pub fn collisions(&self) -> Collisions {
        self.collisions
    }

    /// Work done on neighbour lists so far.
    #[must_use]
    pub fn counts(&self) -> Counts {
        self.counts
    }
}

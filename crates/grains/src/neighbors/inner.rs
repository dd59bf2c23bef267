//! The inner list: the pairs of the outer one within a very small skin, with their memory.

use super::handover::Handover;
use crate::contact::Mask;
use crate::contact::V3;
use crate::lanes::Wide;
use crate::packed::{DUMMIES, INDEX, INDEX_BITS, Row, Shifts, Tag, image_of};
use crate::state::{BATCH, Pairs, has_touched, memory_place, note_touched};

/// Where the memory of a pair comes from.
#[derive(Clone, Copy)]
pub enum Memory<'a> {
    /// From the inner list that this one replaces; the outer list is the same.
    Kept,
    /// From the contacts handed over from before the outer list was made.
    Handed(&'a Handover),
}

/// What pruning needs to see.
#[derive(Clone, Copy)]
pub struct Prune<'a> {
    /// Shifts to periodic images.
    pub shifts: &'a Shifts,
    /// All rows.
    pub rows: &'a [Row],
    /// Who they are.
    pub tags: &'a [Tag],
    /// Images, for finding handed memory.
    pub rest: &'a [crate::packed::Rest],
    /// Skin of the inner list, m.
    pub skin: f64,
    /// Numbers per contact.
    pub slots: usize,
    /// Number of materials.
    pub materials: usize,
    /// Source of memory.
    pub memory: Memory<'a>,
}

/// The list being replaced.
#[derive(Clone, Debug, Default)]
pub struct Spare {
    from: Vec<u32>,
    memory: Vec<f64>,
    touched: Vec<u8>,
}

impl Spare {
    /// Takes a list's places, memory and touches and leaves its own buffers.
    pub fn swap(&mut self, from: &mut Vec<u32>, memory: &mut Vec<f64>, touched: &mut Vec<u8>) {
        std::mem::swap(from, &mut self.from);
        std::mem::swap(memory, &mut self.memory);
        std::mem::swap(touched, &mut self.touched);
    }

    /// Place in the outer list of old entry `q`.
    #[must_use]
    pub fn from(&self, q: usize) -> u32 {
        self.from[q]
    }

    /// Whether old entry `q` touched.
    #[must_use]
    pub fn touched(&self, q: usize) -> bool {
        has_touched(&self.touched, q)
    }

    /// Old memory.
    #[must_use]
    pub fn memory(&self, place: usize) -> f64 {
        self.memory[place]
    }
}

impl Prune<'_> {
    /// Makes the inner list of `pairs` anew.
    #[inline(always)]
    pub fn run<R: Wide>(&self, pairs: &mut Pairs, spare: &mut Spare) {
        spare.swap(&mut pairs.from, &mut pairs.memory, &mut pairs.touched);
        let old = if matches!(self.memory, Memory::Kept) { pairs.len } else { 0 };
        pairs.i.clear();
        pairs.j.clear();
        pairs.from.clear();
        let skin = R::splat(self.skin);
        let mut indices = [0u32; BATCH];
        for base in (0..pairs.outer_i.len()).step_by(R::WIDTH) {
            let i = &pairs.outer_i[base..base + R::WIDTH];
            let coded = &pairs.outer_j[base..base + R::WIDTH];
            let mut images = 0;
            for k in 0..R::WIDTH {
                images |= coded[k];
                indices[k] = coded[k] & INDEX;
            }
            let row = R::relative(self.rows, i, &indices[..R::WIDTH]);
            let mut d = V3::new(row[0], row[1], row[2]);
            if images >> INDEX_BITS != 0 {
                d = d - self.shifts.of(coded);
            }
            let reach = row[3] + skin;
            let mut near = d.dot(d).lt(reach * reach).bits();
            while near != 0 {
                let k = near.trailing_zeros() as usize;
                near &= near - 1;
                pairs.i.push(i[k]);
                pairs.j.push(coded[k]);
                pairs.from.push((base + k) as u32);
            }
        }
        pairs.len = pairs.i.len();
        let grains = (self.rows.len() - DUMMIES) as u32;
        while !pairs.i.len().is_multiple_of(BATCH) {
            pairs.i.push(grains);
            pairs.j.push(grains + 1);
        }
        self.classify(pairs);
        self.carry(pairs, spare, old);
    }

    fn classify(&self, pairs: &mut Pairs) {
        pairs.class.clear();
        if self.materials < 2 {
            return;
        }
        for p in 0..pairs.len {
            let (a, b) = (pairs.i[p] as usize, (pairs.j[p] & INDEX) as usize);
            let class =
                usize::from(self.tags[a].material) * self.materials + usize::from(self.tags[b].material);
            pairs.class.push(class as u8);
        }
        pairs.class.resize(pairs.i.len(), 0);
    }

    fn carry(&self, pairs: &mut Pairs, spare: &Spare, old: usize) {
        pairs.memory.clear();
        pairs.memory.resize(pairs.i.len() * self.slots, 0.0);
        pairs.touched.clear();
        pairs.touched.resize(pairs.i.len() / BATCH, 0);
        match self.memory {
            Memory::Kept => {
                let mut q = 0;
                for p in 0..pairs.len {
                    while q < old && spare.from[q] < pairs.from[p] {
                        q += 1;
                    }
                    if q < old && spare.from[q] == pairs.from[p] && spare.touched(q) {
                        note_touched(&mut pairs.touched, p);
                        for s in 0..self.slots {
                            pairs.memory[memory_place(p, s, self.slots)] =
                                spare.memory[memory_place(q, s, self.slots)];
                        }
                    }
                }
            }
            Memory::Handed(handover) => {
                for p in 0..pairs.len {
                    let (i, j) = (pairs.i[p] as usize, (pairs.j[p] & INDEX) as usize);
                    let image = image_of(pairs.j[p] >> INDEX_BITS);
                    let touched = handover.recall(self.tags, self.rest, (i, j, image), |s, x| {
                        pairs.memory[memory_place(p, s, self.slots)] = x;
                    });
                    if touched {
                        note_touched(&mut pairs.touched, p);
                    }
                }
            }
        }
    }
}

//! The inner list: the pairs of the outer one within a very small skin, with their memory.

use super::handover::Handover;
use super::room::{hold, settle};
use crate::contact::Mask;
use crate::contact::V3;
use crate::lanes::Wide;
use crate::packed::{DUMMIES, INDEX, INDEX_BITS, Row, Shifts, Tag, image_of};
use crate::state::{BATCH, Line, Pairs, has_touched, note, note_touched, remembered};

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

/// Of the entries that are replaced: places in the outer list, and who touched.
#[derive(Clone, Debug, Default)]
pub struct Spare {
    from: Vec<u32>,
    touched: Vec<u8>,
}

impl Spare {
    /// Takes a list's places and touches and leaves it empty. Copied, not swapped: a short list would go on with the
    /// room of a long one.
    pub fn take(&mut self, from: &mut Vec<u32>, touched: &mut Vec<u8>) {
        hold(&mut self.from, from.len());
        self.from.clear();
        self.from.append(from);
        hold(&mut self.touched, touched.len());
        self.touched.clear();
        self.touched.append(touched);
    }

    /// Moves what entries remember from their old places among the first `old` to those of `new`; zero where an
    /// entry is new. Both lists are sorted by their place in the outer one. `touched` has a bit for each.
    pub fn carry(&self, old: usize, new: &[u32], memory: &mut Vec<Line>, touched: &mut [u8], slots: usize) {
        let old = &self.from[..old];
        let padded = touched.len() * BATCH;
        // To the front first, in order, so that nothing is written over before it is read, then apart from the back.
        let mut kept = 0;
        let mut p = 0;
        for (q, place) in old.iter().enumerate() {
            while p < new.len() && new[p] < *place {
                p += 1;
            }
            if p < new.len() && new[p] == *place {
                shift(memory, q, kept, slots);
                kept += 1;
            }
        }
        hold(memory, touched.len() * slots);
        memory.resize(touched.len() * slots, Line::default());
        for p in new.len()..padded {
            clear(memory, p, slots);
        }
        let mut q = old.len();
        for p in (0..new.len()).rev() {
            while q > 0 && old[q - 1] > new[p] {
                q -= 1;
            }
            if q > 0 && old[q - 1] == new[p] {
                kept -= 1;
                shift(memory, kept, p, slots);
                if has_touched(&self.touched, q - 1) {
                    note_touched(touched, p);
                }
            } else {
                clear(memory, p, slots);
            }
        }
    }
}

fn shift(memory: &mut [Line], from: usize, to: usize, slots: usize) {
    for s in 0..slots {
        note(memory, to, s, slots, remembered(memory, from, s, slots));
    }
}

fn clear(memory: &mut [Line], p: usize, slots: usize) {
    for s in 0..slots {
        note(memory, p, s, slots, 0.0);
    }
}

impl Prune<'_> {
    /// Makes the inner list of `pairs` anew.
    #[inline(always)]
    pub fn run<R: Wide>(&self, pairs: &mut Pairs, spare: &mut Spare) {
        spare.take(&mut pairs.from, &mut pairs.touched);
        let old = if matches!(self.memory, Memory::Kept) { pairs.len } else { 0 };
        pairs.i.clear();
        pairs.j.clear();
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
        for list in [&mut pairs.i, &mut pairs.j, &mut pairs.from] {
            settle(list);
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
        let slots = self.slots;
        pairs.touched.resize(pairs.i.len() / BATCH, 0);
        match self.memory {
            Memory::Kept => spare.carry(old, &pairs.from, &mut pairs.memory, &mut pairs.touched, slots),
            Memory::Handed(handover) => {
                pairs.memory.clear();
                hold(&mut pairs.memory, pairs.touched.len() * slots);
                pairs.memory.resize(pairs.touched.len() * slots, Line::default());
                for p in 0..pairs.len {
                    let (i, j) = (pairs.i[p] as usize, (pairs.j[p] & INDEX) as usize);
                    let image = image_of(pairs.j[p] >> INDEX_BITS);
                    let touched = handover.recall(self.tags, self.rest, (i, j, image), |s, x| {
                        note(&mut pairs.memory, p, s, slots, x);
                    });
                    if touched {
                        note_touched(&mut pairs.touched, p);
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn memory_follows_its_entries() {
        let slots = 2;
        let mark = |place: u32, s: usize| f64::from(place) + 0.5 * s as f64;
        // Shrinking, growing, unchanged, nothing in common, from and to nothing.
        let all: Vec<u32> = (0..40).collect();
        let some = |step: usize| all.iter().copied().skip(step / 2).step_by(step).collect::<Vec<u32>>();
        let lists = [all.clone(), some(2), some(3), vec![], some(5), some(7), all[8..16].to_vec()];
        for old in &lists {
            for new in &lists {
                let room = old.len().next_multiple_of(BATCH);
                let mut memory = vec![Line::default(); room / BATCH * slots];
                for (p, &place) in old.iter().enumerate() {
                    for s in 0..slots {
                        note(&mut memory, p, s, slots, mark(place + 1, s));
                    }
                }
                let mut spare = Spare { from: old.clone(), touched: vec![0; room / BATCH] };
                (0..old.len()).filter(|p| p % 3 == 0).for_each(|p| note_touched(&mut spare.touched, p));
                let padded = new.len().next_multiple_of(BATCH);
                let mut touched = vec![0; padded / BATCH];
                spare.carry(old.len(), new, &mut memory, &mut touched, slots);
                assert_eq!(memory.len(), padded / BATCH * slots);
                for p in 0..padded {
                    let known = new.get(p).filter(|place| old.contains(place));
                    let before = known.and_then(|place| old.iter().position(|o| o == place));
                    assert_eq!(has_touched(&touched, p), before.is_some_and(|q| q % 3 == 0));
                    for s in 0..slots {
                        let wanted = known.map_or(0.0, |place| mark(place + 1, s));
                        assert_eq!(remembered(&memory, p, s, slots), wanted, "{old:?} to {new:?}");
                    }
                }
            }
        }
    }
}

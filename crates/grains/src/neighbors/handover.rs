//! Touching contacts and their memory on their way from one outer list to the next.
//!
//! A contact is known by the identities of its bodies, lower one first, and by
//! which of their periodic images touch; sorting and wrapping change neither.

use crate::packed::{INDEX, INDEX_BITS, Rest, Tag, image_of};
use crate::state::{Pairs, WallPairs, has_touched, memory_place};

/// The contacts that touched when last swept: none of the others remembers anything.
#[derive(Clone, Debug, Default)]
pub struct Handover {
    slots: usize,
    /// Slots that change sign when the bodies swap.
    odd: u32,
    keys: Vec<Key>,
    values: Vec<f64>,
    /// Records of each lower identity: places in `sorted`.
    start: Vec<u32>,
    sorted: Vec<u32>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Key {
    low: u32,
    /// Higher identity; for a wall, its number counted down from the top.
    high: u32,
    /// Image, or feature of the wall.
    which: u32,
}

impl Handover {
    /// Forgets all and expects contacts of `slots` numbers.
    pub fn clear(&mut self, slots: usize, odd: u32) {
        self.slots = slots;
        self.odd = odd;
        self.keys.clear();
        self.values.clear();
    }

    /// Takes up the contacts of a list.
    pub fn take(&mut self, pairs: &Pairs, tags: &[Tag], rest: &[Rest]) {
        for p in (0..pairs.len).filter(|&p| has_touched(&pairs.touched, p)) {
            let (i, j) = (pairs.i[p] as usize, (pairs.j[p] & INDEX) as usize);
            let image = image_of(pairs.j[p] >> INDEX_BITS);
            let (key, swapped) = key(tags, rest, (i, j, image));
            self.push(key, swapped, &pairs.memory, p);
        }
    }

    /// Takes up the contacts with walls.
    pub fn take_walls(&mut self, walls: &WallPairs, tags: &[Tag]) {
        for (p, &(row, wall, feature)) in walls.inner.iter().enumerate() {
            if has_touched(&walls.touched, p) {
                self.push(wall_key(tags[row as usize].id, wall, feature), false, &walls.memory, p);
            }
        }
    }

    fn push(&mut self, key: Key, swapped: bool, memory: &[f64], p: usize) {
        self.keys.push(key);
        for s in 0..self.slots {
            let x = memory[memory_place(p, s, self.slots)];
            self.values.push(if swapped && self.odd >> s & 1 == 1 { -x } else { x });
        }
    }

    /// Sorts what was taken up, for `grains` identities.
    pub fn index(&mut self, grains: usize) {
        self.start.clear();
        self.start.resize(grains + 1, 0);
        for k in &self.keys {
            self.start[k.low as usize + 1] += 1;
        }
        for id in 0..grains {
            self.start[id + 1] += self.start[id];
        }
        self.sorted.clear();
        self.sorted.resize(self.keys.len(), 0);
        for (record, k) in self.keys.iter().enumerate() {
            let place = &mut self.start[k.low as usize];
            self.sorted[*place as usize] = record as u32;
            *place += 1;
        }
        self.start.copy_within(0..grains, 1);
        self.start[0] = 0;
    }

    /// Whether rows `i` and `j` (in image) touched; gives what their contact remembers to `set`, slot by slot.
    pub fn recall(
        &self,
        tags: &[Tag],
        rest: &[Rest],
        contact: (usize, usize, [i32; 3]),
        set: impl FnMut(usize, f64),
    ) -> bool {
        let (key, swapped) = key(tags, rest, contact);
        self.find(key, swapped, set)
    }

    /// The same for a contact with a wall.
    pub fn recall_wall(&self, id: u32, wall: u16, feature: u32, set: impl FnMut(usize, f64)) -> bool {
        self.find(wall_key(id, wall, feature), false, set)
    }

    fn find(&self, key: Key, swapped: bool, mut set: impl FnMut(usize, f64)) -> bool {
        let range = self.start[key.low as usize] as usize..self.start[key.low as usize + 1] as usize;
        for &record in &self.sorted[range] {
            if self.keys[record as usize] == key {
                for s in 0..self.slots {
                    let x = self.values[record as usize * self.slots + s];
                    set(s, if swapped && self.odd >> s & 1 == 1 { -x } else { x });
                }
                return true;
            }
        }
        false
    }
}

fn wall_key(id: u32, wall: u16, feature: u32) -> Key {
    Key { low: id, high: u32::MAX - u32::from(wall), which: feature }
}

/// The key of a pair, and whether its first body has the higher identity.
fn key(tags: &[Tag], rest: &[Rest], (i, j, image): (usize, usize, [i32; 3])) -> (Key, bool) {
    let (a, b) = (tags[i].id, tags[j].id);
    let swapped = a > b;
    let mut which = 0;
    for axis in 0..3 {
        // Invariant under wrapping; eight bits tell images apart that lie together.
        let n = image[axis].wrapping_add(rest[i].image[axis]).wrapping_sub(rest[j].image[axis]);
        let n = if swapped { n.wrapping_neg() } else { n };
        which = which << 8 | u32::from(n as u8);
    }
    (Key { low: a.min(b), high: a.max(b), which }, swapped)
}

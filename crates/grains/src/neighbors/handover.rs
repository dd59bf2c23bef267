//! Touching contacts and their memory on their way from one outer list to the next.
//!
//! A contact is known by the identities of its bodies, lower one first, and by
//! which of their periodic images touch; sorting and wrapping change neither.

use super::room::hold;
use crate::packed::{INDEX, INDEX_BITS, Rest, Tag, image_of};
use crate::state::{Line, Lists, has_touched, remembered};

/// The contacts that touched when last swept.
#[derive(Clone, Debug, Default)]
pub struct Handover {
    slots: usize,
    /// Slots that change sign when the bodies swap.
    odd: u32,
    /// Records of each lower identity: places in `others` and `values`.
    start: Vec<u32>,
    others: Vec<Other>,
    values: Vec<f64>,
}

/// What tells a contact from others of the same lower identity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Other {
    /// Higher identity; for a wall, its number counted down from the top.
    high: u32,
    /// Image, or feature of the wall.
    which: u32,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Key {
    low: u32,
    other: Other,
}

impl Handover {
    /// Forgets all and takes up the contacts of `lists`, which remember `slots` numbers each.
    ///
    /// Twice over the lists: they are counted, so that each then goes to its place.
    pub fn collect(&mut self, slots: usize, odd: u32, lists: &[Lists], tags: &[Tag], rest: &[Rest]) {
        (self.slots, self.odd) = (slots, odd);
        self.start.clear();
        self.start.resize(tags.len() + 1, 0);
        each(lists, tags, rest, |key, _, _, _| self.start[key.low as usize + 1] += 1);
        for id in 0..tags.len() {
            self.start[id + 1] += self.start[id];
        }
        let count = self.start[tags.len()] as usize;
        hold(&mut self.others, count);
        hold(&mut self.values, count * slots);
        self.others.clear();
        self.others.resize(count, Other::default());
        self.values.clear();
        self.values.resize(count * slots, 0.0);
        each(lists, tags, rest, |key, swapped, memory, p| {
            let place = self.start[key.low as usize] as usize;
            self.start[key.low as usize] += 1;
            self.others[place] = key.other;
            for (s, value) in self.values[place * slots..][..slots].iter_mut().enumerate() {
                let x = remembered(memory, p, s, slots);
                *value = if swapped && odd >> s & 1 == 1 { -x } else { x };
            }
        });
        self.start.copy_within(0..tags.len(), 1);
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
        for record in range {
            if self.others[record] == key.other {
                for s in 0..self.slots {
                    let x = self.values[record * self.slots + s];
                    set(s, if swapped && self.odd >> s & 1 == 1 { -x } else { x });
                }
                return true;
            }
        }
        false
    }
}

/// Calls `found` with the key, whether its bodies are swapped, and memory and place of every contact that touched
/// when last swept: none of the others remembers anything. A pair of two blocks is taken from its first.
fn each(lists: &[Lists], tags: &[Tag], rest: &[Rest], mut found: impl FnMut(Key, bool, &[Line], usize)) {
    for list in lists {
        for pairs in [&list.inside, &list.first, &list.big] {
            for p in (0..pairs.len).filter(|&p| has_touched(&pairs.touched, p)) {
                let (i, j) = (pairs.i[p] as usize, (pairs.j[p] & INDEX) as usize);
                let (key, swapped) = key(tags, rest, (i, j, image_of(pairs.j[p] >> INDEX_BITS)));
                found(key, swapped, &pairs.memory, p);
            }
        }
        let walls = &list.walls;
        for (p, &(row, wall, feature)) in walls.inner.iter().enumerate() {
            if has_touched(&walls.touched, p) {
                found(wall_key(tags[row as usize].id, wall, feature), false, &walls.memory, p);
            }
        }
    }
}

fn wall_key(id: u32, wall: u16, feature: u32) -> Key {
    Key { low: id, other: Other { high: u32::MAX - u32::from(wall), which: feature } }
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
    (Key { low: a.min(b), other: Other { high: a.max(b), which } }, swapped)
}

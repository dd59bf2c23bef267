//! Candidate contacts with walls, on the same two levels as pairs.

use super::inner::{Memory, Prune, Spare};
use crate::packed::Row;
use crate::state::{BATCH, Line, WallPairs, note, note_touched};
use crate::wall::Walls;

impl WallPairs {
    /// Finds the walls within `skin` (m) of rows `start..end`.
    pub fn find(&mut self, rows: &[Row], (start, end): (usize, usize), walls: &Walls, skin: f64) {
        self.outer.clear();
        for row in start..end {
            let g = &rows[row];
            walls.candidates(g.position(), g.radius() + skin, |wall, feature| {
                self.outer.push((row as u32, wall, feature));
            });
        }
        self.outer.sort_unstable_by_key(|&(row, wall, feature)| (wall, row, feature));
    }
}

impl Prune<'_> {
    /// Makes the inner list of wall contacts anew.
    pub fn walls(&self, list: &mut WallPairs, walls: &Walls, spare: &mut Spare) {
        let old = if matches!(self.memory, Memory::Kept) { list.inner.len() } else { 0 };
        spare.take(&mut list.from, &mut list.touched);
        list.inner.clear();
        list.class.clear();
        for (k, &(row, wall, feature)) in list.outer.iter().enumerate() {
            let g = &self.rows[row as usize];
            let near = walls.nearest(usize::from(wall), feature, g.position());
            // A point that a neighbouring box covers is no candidate now, but may be one step later.
            if near.distance <= g.radius() + self.skin || near.distance == f64::INFINITY {
                list.inner.push((row, wall, feature));
                list.from.push(k as u32);
                if self.materials > 1 {
                    let mine = usize::from(self.tags[row as usize].material);
                    let class = mine * self.materials + usize::from(walls.material(usize::from(wall)));
                    list.class.push(class as u8);
                }
            }
        }
        self.carry_walls(list, spare, old);
    }

    fn carry_walls(&self, list: &mut WallPairs, spare: &Spare, old: usize) {
        let (slots, batches) = (self.slots, list.inner.len().div_ceil(BATCH));
        list.touched.resize(batches, 0);
        match self.memory {
            Memory::Kept => spare.carry(old, &list.from, &mut list.memory, &mut list.touched, slots),
            Memory::Handed(handover) => {
                list.memory.clear();
                list.memory.resize(batches * slots, Line::default());
                for (p, &(row, wall, feature)) in list.inner.iter().enumerate() {
                    let touched = handover.recall_wall(self.tags[row as usize].id, wall, feature, |s, x| {
                        note(&mut list.memory, p, s, slots, x);
                    });
                    if touched {
                        note_touched(&mut list.touched, p);
                    }
                }
            }
        }
    }
}

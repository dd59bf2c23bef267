//! The outer list: every pair within a wide skin.

use super::all::Columns;
use super::grid::{FORWARD, Grid};
use super::room::settle;
use crate::lanes::Wide;
use crate::packed::{DUMMIES, INDEX_BITS, Row, image_code};
use crate::state::{BATCH, Lists, Pairs};
use brazilnut_base::{Cell, Vec3};

/// What the search for one block needs to see.
#[derive(Clone, Copy)]
pub struct Scene<'a> {
    /// The cell.
    pub cell: &'a Cell,
    /// All rows.
    pub rows: &'a [Row],
    /// Rows from here on are big bodies.
    pub small: usize,
    /// Skin of the outer list, m.
    pub skin: f64,
}

impl Scene<'_> {
    /// Number of rows that are grains.
    fn grains(&self) -> usize {
        self.rows.len() - DUMMIES
    }

    /// Shift to image `s`, m.
    fn shift(&self, s: [i32; 3]) -> Vec3 {
        self.cell.size * Vec3::new(f64::from(s[0]), f64::from(s[1]), f64::from(s[2]))
    }

    /// Whether the image of `j` shifted by `shift` is within reach of `i`.
    #[inline]
    fn near(&self, i: usize, j: usize, shift: Vec3) -> bool {
        let (a, b) = (&self.rows[i], &self.rows[j]);
        let reach = a.radius() + b.radius() + self.skin;
        (a.position() - b.position() - shift).length_squared() < reach * reach
    }

    /// Calls `found` with every image of `j` within reach of `i`: more than one in a narrow cell.
    fn images(&self, i: usize, j: usize, mut found: impl FnMut(u32)) {
        let (a, b) = (&self.rows[i], &self.rows[j]);
        let d = a.position() - b.position();
        let reach = a.radius() + b.radius() + self.skin;
        let range = |axis: usize| {
            let l = self.cell.size[axis];
            if self.cell.is_periodic(axis) {
                // Nearest images only where they can be near enough.
                let low = if d[axis] + l < reach { -1 } else { 0 };
                let high = if d[axis] - l > -reach { 1 } else { 0 };
                low..=high
            } else {
                0..=0
            }
        };
        for sx in range(0) {
            for sy in range(1) {
                for sz in range(2) {
                    let s = [sx, sy, sz];
                    if self.near(i, j, self.shift(s)) {
                        found(image_code(s));
                    }
                }
            }
        }
    }
}

impl Pairs {
    fn clear_outer(&mut self) {
        self.outer_i.clear();
        self.outer_j.clear();
    }

    #[inline]
    fn push(&mut self, i: usize, j: usize, code: u32) {
        self.outer_i.push(i as u32);
        self.outer_j.push(j as u32 | code << INDEX_BITS);
    }

    /// Fills up the last batch with pairs that never touch.
    fn pad(&mut self, grains: usize) {
        while !self.outer_i.len().is_multiple_of(BATCH) {
            self.push(grains, grains + 1, 0);
        }
        settle(&mut self.outer_i);
        settle(&mut self.outer_j);
    }
}

impl Lists {
    fn owns(&self, row: usize) -> bool {
        (self.start..self.end).contains(&row)
    }

    /// Finds the pairs of this block of small grains through `grid`.
    pub fn find(&mut self, scene: &Scene<'_>, grid: &Grid) {
        self.clear();
        for row in self.start..self.end {
            let c = grid.place(&scene.rows[row]);
            let own = grid.number(c);
            for other in row + 1..grid.start[own + 1] as usize {
                self.forward(scene, row, other, [0; 3]);
            }
            for other in grid.start[own] as usize..row.min(self.start) {
                self.backward(scene, row, other, [0; 3]);
            }
            for offset in FORWARD {
                if let Some((cell, s)) = grid.neighbour(c, offset) {
                    for other in grid.start[cell] as usize..grid.start[cell + 1] as usize {
                        self.forward(scene, row, other, s);
                    }
                }
                if let Some((cell, s)) = grid.neighbour(c, offset.map(|o| -o)) {
                    let (from, to) = (grid.start[cell] as usize, grid.start[cell + 1] as usize);
                    if from >= self.start && to <= self.end {
                        continue;
                    }
                    for other in from..to {
                        self.backward(scene, row, other, s);
                    }
                }
            }
        }
        self.find_big(scene);
        self.pad(scene.grains());
    }

    /// Finds all pairs of rows `start..end`, which are all rows of their kind, by testing each.
    #[inline(always)]
    pub fn find_all<R: Wide>(&mut self, scene: &Scene<'_>, columns: &mut Columns) {
        self.clear();
        let first = self.start;
        columns.fill(&scene.rows[first..self.end]);
        columns.pairs::<R>(scene.cell, scene.skin, |i, j| {
            let (i, j) = (first + i, first + j);
            scene.images(i, j, |code| self.inside.push(i, j, code));
        });
        if self.start < scene.small {
            self.find_big(scene);
        }
        self.pad(scene.grains());
    }

    fn clear(&mut self) {
        for pairs in [&mut self.inside, &mut self.first, &mut self.second, &mut self.big] {
            pairs.clear_outer();
        }
    }

    fn pad(&mut self, grains: usize) {
        for pairs in [&mut self.inside, &mut self.first, &mut self.second, &mut self.big] {
            pairs.pad(grains);
        }
    }

    /// `other`, shifted by image `s`, seen from its first body `row` of this block.
    #[inline]
    fn forward(&mut self, scene: &Scene<'_>, row: usize, other: usize, s: [i32; 3]) {
        if other != row && scene.near(row, other, scene.shift(s)) {
            let list = if self.owns(other) { &mut self.inside } else { &mut self.first };
            list.push(row, other, image_code(s));
        }
    }

    /// The same pair, seen from its second body `row` of this block when the first is elsewhere.
    #[inline]
    fn backward(&mut self, scene: &Scene<'_>, row: usize, other: usize, s: [i32; 3]) {
        let s = s.map(|k| -k);
        if !self.owns(other) && scene.near(other, row, scene.shift(s)) {
            self.second.push(other, row, image_code(s));
        }
    }

    /// Big bodies are few: each grain is tested against each.
    fn find_big(&mut self, scene: &Scene<'_>) {
        for body in scene.small..scene.grains() {
            for row in self.start..self.end {
                scene.images(row, body, |code| self.big.push(row, body, code));
            }
        }
    }
}

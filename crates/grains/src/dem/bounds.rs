//! When lists are made anew.

use super::work::Work;
use super::{Dem, Scratch};
use crate::lanes::{Job, Wide};
use crate::neighbors::inner::{Memory, Prune};
use crate::neighbors::outer::Scene;
use crate::state::{DemState, Drift, Lists};
use crate::wall::Walls;
use brazilnut_base::Vec3;
use rayon::prelude::*;

/// A skin is used up a little early, so that rounding in the sums of displacements cannot matter.
const MARGIN: f64 = 1.0 - 1e-9;
/// Steps that an outer list should last where grains are fast: making one costs as much as some ten steps.
const OUTER_LASTS: f64 = 70.0;
/// Greatest outer skin over that of slow grains: beyond, pruning costs what is saved.
const MOST_OUTER: f64 = 3.0;
/// Steps that an inner list should last: pruning costs about a tenth of the steps between.
const INNER_LASTS: f64 = 6.0;
/// Least inner skin over the largest diameter: a smaller one saves no pairs in a bed at rest.
const LEAST_INNER: f64 = 0.003;
/// Greatest inner skin over the outer one.
const MOST_INNER: f64 = 0.4;

impl Dem {
    /// Makes the lists anew if any body may have moved further than a skin since.
    pub(super) fn refresh_lists(&mut self, state: &mut DemState) {
        let d = &state.drift;
        let [outer, inner] = &state.wall_marks;
        let skins = state.skins;
        if approach(d.low, d.high, outer, &self.walls) >= skins.outer * MARGIN {
            self.rebuild(state);
        } else if approach(d.inner_low, d.inner_high, inner, &self.walls) >= skins.inner * MARGIN {
            self.prune(state, false);
        }
    }

    /// The skins that will last some steps if grains go on as since the last outer list.
    fn tune(&self, state: &mut DemState) {
        let steps = state.counts.steps - state.built;
        state.built = state.counts.steps;
        if steps == 0 {
            return;
        }
        let moved = approach(state.drift.low, state.drift.high, &state.wall_marks[0], &self.walls);
        let (search, skins) = (&self.spec.search, &mut state.skins);
        let speed = moved / steps as f64;
        if search.skin.is_none() {
            skins.outer = (OUTER_LASTS * speed).max(skins.slow).min(MOST_OUTER * skins.slow);
        }
        if search.inner_skin.is_none() {
            let least = LEAST_INNER * 2.0 * state.radii[1];
            skins.inner = (INNER_LASTS * speed).max(least).min(MOST_INNER * skins.outer);
        }
    }

    /// Outer lists from the present positions; sorts and wraps the grains.
    pub(super) fn rebuild(&mut self, state: &mut DemState) {
        self.tune(state);
        self.collect(state);
        wrap(state, &self.spec.cell);
        let all_pairs = state.small < self.spec.search.all_pairs_below;
        let scratch = &mut self.scratch;
        if !all_pairs {
            let reach = 2.0 * state.radii[1] + state.skins.outer;
            scratch.grid.lay(&self.spec.cell, state.extent, reach, state.small);
            scratch.order.sort(state, &mut scratch.grid);
        }
        let parallel = self.parallel(state);
        self.scratch.work.resize_with(state.blocks.len(), Work::default);
        let Scratch { work, grid, .. } = &mut self.scratch;
        let scene =
            Scene { cell: &self.spec.cell, rows: &state.rows, small: state.small, skin: state.skins.outer };
        let level = self.spec.search.sweep.level();
        let find = |(lists, work): (&mut Lists, &mut Work)| {
            if all_pairs || lists.start >= state.small {
                level.run(Few { scene: &scene, lists, work });
            } else {
                lists.find(&scene, grid);
            }
            lists.walls.find(&state.rows, (lists.start, lists.end), &self.walls, state.skins.outer);
        };
        if parallel {
            state.blocks.par_iter_mut().zip(work.par_iter_mut()).for_each(find);
        } else {
            state.blocks.iter_mut().zip(work.iter_mut()).for_each(find);
        }
        state.drift = Drift::default();
        mark(&mut state.wall_marks[0], &self.walls);
        state.counts.builds += 1;
        self.prune(state, true);
    }

    /// Inner lists from the outer ones; `handed` if the outer ones are new.
    fn prune(&mut self, state: &mut DemState, handed: bool) {
        let parallel = self.parallel(state);
        self.scratch.work.resize_with(state.blocks.len(), Work::default);
        let Scratch { work, handover, .. } = &mut self.scratch;
        let prune = Prune {
            shifts: &self.shifts,
            rows: &state.rows,
            tags: &state.tags,
            rest: &state.rest,
            skin: state.skins.inner,
            slots: self.law.slots(),
            materials: self.spec.materials.len(),
            memory: if handed { Memory::Handed(handover) } else { Memory::Kept },
        };
        let level = self.spec.search.sweep.level();
        let one = |(lists, work): (&mut Lists, &mut Work)| {
            level.run(Inner { prune: &prune, lists, work });
            prune.walls(&mut lists.walls, &self.walls, &mut work.spare);
        };
        if parallel {
            state.blocks.par_iter_mut().zip(work.par_iter_mut()).for_each(one);
        } else {
            state.blocks.iter_mut().zip(work.iter_mut()).for_each(one);
        }
        (state.drift.inner_low, state.drift.inner_high) = (Vec3::ZERO, Vec3::ZERO);
        mark(&mut state.wall_marks[1], &self.walls);
        state.counts.prunes += 1;
    }

    /// Takes up all touching contacts and what they remember.
    fn collect(&mut self, state: &DemState) {
        let slots = self.law.slots();
        self.scratch.handover.collect(slots, self.law.odd(), &state.blocks, &state.tags, &state.rest);
    }
}

/// Search among few bodies for whatever lanes the machine has.
struct Few<'a> {
    scene: &'a Scene<'a>,
    lists: &'a mut Lists,
    work: &'a mut Work,
}

impl Job for Few<'_> {
    type Output = ();

    #[inline(always)]
    fn run<R: Wide>(self) {
        self.lists.find_all::<R>(self.scene, &mut self.work.columns);
    }
}

/// Pruning of one block for whatever lanes the machine has.
struct Inner<'a> {
    prune: &'a Prune<'a>,
    lists: &'a mut Lists,
    work: &'a mut Work,
}

impl Job for Inner<'_> {
    type Output = ();

    #[inline(always)]
    fn run<R: Wide>(self) {
        let Lists { inside, first, second, big, .. } = self.lists;
        for pairs in [inside, first, second, big] {
            self.prune.run::<R>(pairs, &mut self.work.spare);
        }
    }
}

/// By how much two grains, or a grain and a wall, may have come nearer, m, if every grain's displacement
/// lies between `low` and `high` and the walls were at `marks`.
fn approach(low: Vec3, high: Vec3, marks: &[Vec3], walls: &Walls) -> f64 {
    marks.iter().enumerate().fold((high - low).length(), |most, (k, &mark)| {
        let wall = walls.displacement(k) - mark;
        most.max((high - wall).abs().max((low - wall).abs()).length())
    })
}

fn mark(marks: &mut Vec<Vec3>, walls: &Walls) {
    marks.clear();
    marks.extend((0..walls.len()).map(|k| walls.displacement(k)));
}

fn wrap(state: &mut DemState, cell: &brazilnut_base::Cell) {
    for (row, rest) in state.rows.iter_mut().zip(&mut state.rest) {
        let (r, crossed) = cell.wrap(row.position());
        row.0[..3].copy_from_slice(&r.to_array());
        for axis in 0..3 {
            rest.image[axis] += crossed[axis];
        }
    }
}

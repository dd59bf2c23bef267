//! One step.

use super::Dem;
use super::block::{Block, Course, Own};
use super::work::Work;
use crate::field::Field;
use crate::motion::{Gear, Kick, Pace, Passed, PositionVerlet, Scheme, VelocityVerlet};
use crate::spec::Integrator;
use crate::state::DemState;
use crate::wall::WallLoad;
use brazilnut_base::Tick;

impl Dem {
    /// Takes the step `tick`: forces at its start, motion to its end.
    pub fn advance<F: Field>(&mut self, state: &mut DemState, tick: Tick, field: &F) {
        self.walls.move_to(tick.time);
        self.refresh_lists(state);
        let pace = self.pace(state, tick);
        match self.spec.integrator {
            Integrator::VelocityVerlet => self.sweep_and_move::<VelocityVerlet, F>(state, &pace, field),
            Integrator::PositionVerlet => self.sweep_and_move::<PositionVerlet, F>(state, &pace, field),
            Integrator::Gear => self.sweep_and_move::<Gear, F>(state, &pace, field),
        }
        self.sum_up(state);
        state.fresh = false;
        state.time = tick.end();
        self.walls.move_to(state.time);
        self.refresh_lists(state);
    }

    fn pace(&self, state: &DemState, tick: Tick) -> Pace {
        let length = if state.fresh { 0.5 * tick.dt } else { tick.dt };
        Pace {
            tick,
            kick: Kick { length, first: state.fresh },
            free: self.free,
            turns: self.turns,
            rotation: self.spec.rotation,
        }
    }

    /// Forces, then motion, block by block; no block reads what another writes.
    /// The big bodies' forces come last, with what the blocks found for them.
    fn sweep_and_move<S: Scheme, F: Field>(&mut self, state: &mut DemState, pace: &Pace, field: &F) {
        let parallel = self.parallel(state);
        let work = &mut self.scratch.work;
        work.resize_with(state.blocks.len(), Work::default);
        let block = Block {
            rows: &state.rows,
            spins: &state.spins,
            small: state.small,
            grains: state.tags.len(),
            law: &*self.law,
            walls: &self.walls,
            shifts: &self.shifts,
            dt: pace.tick.dt,
        };
        let last = state.blocks.len() - 1;
        let (lists, lists_big) = state.blocks.split_at_mut(last);
        let (work_small, work_big) = work.split_at_mut(last);
        block.each(lists, work_small, parallel);
        block.big(&mut lists_big[0], &mut work_big[0], work_small);

        let course = Course { tags: &state.tags, level: self.spec.search.sweep.level(), pace, field };
        let own = Own {
            rows: &mut state.rows,
            spins: &mut state.spins,
            halves: &mut state.halves,
            rest: &mut state.rest,
            higher: &mut state.higher,
        };
        course.each::<S>(&state.blocks, work, own, parallel);
    }

    /// Adds what the blocks found, in their order.
    fn sum_up(&mut self, state: &mut DemState) {
        let mut passed = Passed::nothing();
        let sums = &mut state.sums;
        state.overlap = 0.0;
        state.contacts = 0;
        state.loads.fill(WallLoad::default());
        for work in &self.scratch.work {
            passed.join(&work.passed);
            for k in 0..sums.lost.len() {
                sums.lost[k] += work.tally.total(k);
            }
            sums.walls += work.tally.wall_work.iter().sum::<f64>();
            state.overlap = work.tally.overlap.iter().fold(state.overlap, |a, &b| a.max(b));
            state.contacts += work.tally.contacts;
            // The first sweep meets the contacts that are there at the start: they do not begin.
            if state.counts.steps > 0 {
                state.collisions.grains += work.tally.begun[0];
                state.collisions.walls += work.tally.begun[1];
            }
            for (sum, load) in state.loads.iter_mut().zip(&work.loads) {
                sum.force += load.force;
                sum.contacts += load.contacts;
            }
        }
        sums.gravity += passed.work[0];
        sums.frame += passed.work[1];
        sums.fluid += passed.work[2];
        state.extent = passed.extent;
        state.drift.step(passed.moved[0], passed.moved[1]);
        state.counts.steps += 1;
    }

    /// Whether there is enough work for more than one thread.
    pub(super) fn parallel(&self, state: &DemState) -> bool {
        state.blocks.len() > 2 && rayon::current_num_threads() > 1
    }
}

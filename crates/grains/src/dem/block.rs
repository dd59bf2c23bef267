//! What happens to one block of grains in a step.

use super::work::Work;
use crate::contact::ContactSweep;
use crate::contact::sweep::PairJob;
use crate::contact::wall_sweep::WallJob;
use crate::field::Field;
use crate::lanes::{Adds, Job, Level, Wide};
use crate::motion::{self, Movers, Pace, Scheme};
use crate::packed::{Half, Rest, Row, Shifts, Spin, Tag};
use crate::state::{DemState, Lists, Pairs};
use crate::wall::Walls;
use rayon::prelude::*;
use std::marker::PhantomData;

/// What all blocks share while forces are found.
pub struct Block<'a> {
    /// All rows.
    pub rows: &'a [Row],
    /// All spins.
    pub spins: &'a [Spin],
    /// Rows from here on are big bodies.
    pub small: usize,
    /// Number of grains.
    pub grains: usize,
    /// The contact law.
    pub law: &'a dyn ContactSweep,
    /// The walls at the start of the step.
    pub walls: &'a Walls,
    /// Shifts to periodic images.
    pub shifts: &'a Shifts,
    /// Length of the step, s.
    pub dt: f64,
}

impl Block<'_> {
    /// Finds the forces of every block of `lists`.
    pub fn each(&self, lists: &mut [Lists], work: &mut [Work], parallel: bool) {
        let one = |(lists, work): (&mut Lists, &mut Work)| {
            self.clear(lists, work);
            self.contacts(lists, work);
        };
        if parallel {
            lists.par_iter_mut().zip(work).for_each(one);
        } else {
            lists.iter_mut().zip(work).for_each(one);
        }
    }

    /// Finds those on the big bodies after the others have left their forces in `small`.
    pub fn big(&self, lists: &mut Lists, work: &mut Work, small: &[Work]) {
        self.clear(lists, work);
        let big = lists.end - lists.start;
        for other in small {
            let from = other.forces.len() - big;
            for (sum, f) in work.forces.iter_mut().zip(&other.forces[from..]) {
                for k in 0..8 {
                    sum.0[k] += f.0[k];
                }
            }
            let from = other.couples.len().saturating_sub(big);
            for (sum, c) in work.couples.iter_mut().zip(&other.couples[from..]) {
                for k in 0..4 {
                    sum.0[k] += c.0[k];
                }
            }
        }
        self.contacts(lists, work);
    }

    fn clear(&self, lists: &Lists, work: &mut Work) {
        let own = lists.end - lists.start;
        let big = if lists.start < self.small { self.grains - self.small } else { 0 };
        work.clear(own, big, self.walls.len(), self.law.rolls());
    }

    /// All contacts of the block.
    fn contacts(&self, lists: &mut Lists, work: &mut Work) {
        let own = (lists.start, lists.start);
        // The big bodies' forces lie behind those of the block's own rows.
        let with_big = (lists.start, self.small.wrapping_sub(lists.end - lists.start));
        self.pairs(&mut lists.inside, work, own, Adds::Both);
        self.pairs(&mut lists.first, work, own, Adds::First);
        self.pairs(&mut lists.second, work, own, Adds::Second);
        self.pairs(&mut lists.big, work, with_big, Adds::Both);
        self.law.walls(
            WallJob {
                rows: self.rows,
                spins: self.spins,
                touching: &lists.walls.inner,
                class: &lists.walls.class,
                memory: &mut lists.walls.memory,
                touched: &mut lists.walls.touched,
                forces: &mut work.forces,
                couples: &mut work.couples,
                base: lists.start,
                walls: self.walls,
                loads: &mut work.loads,
                dt: self.dt,
            },
            &mut work.tally,
        );
    }

    fn pairs(&self, pairs: &mut Pairs, work: &mut Work, base: (usize, usize), adds: Adds) {
        let counted = if adds == Adds::Second { &mut work.discard } else { &mut work.tally };
        self.law.pairs(
            PairJob {
                rows: self.rows,
                spins: self.spins,
                i: &pairs.i,
                j: &pairs.j,
                class: &pairs.class,
                len: pairs.len,
                memory: &mut pairs.memory,
                touched: &mut pairs.touched,
                forces: &mut work.forces,
                couples: &mut work.couples,
                base,
                adds,
                shifts: self.shifts,
                dt: self.dt,
            },
            counted,
        );
    }
}

/// What all blocks share while grains move.
pub struct Course<'a, F> {
    /// Who the grains are.
    pub tags: &'a [Tag],
    /// Instructions for the formulae, which are four lanes wide already.
    pub level: Level,
    /// The step.
    pub pace: &'a Pace,
    /// What acts from outside.
    pub field: &'a F,
}

/// What a block alone writes.
pub struct Own<'a> {
    /// Rows.
    pub rows: &'a mut [Row],
    /// Spins.
    pub spins: &'a mut [Spin],
    /// Half-step velocities.
    pub halves: &'a mut [Half],
    /// Orientations.
    pub rest: &'a mut [Rest],
    /// Higher derivatives, maybe none.
    pub higher: &'a mut [[f64; 12]],
}

impl<'a> Own<'a> {
    /// The first `at` grains, and the others.
    fn split(self, at: usize) -> (Self, Self) {
        let (rows, rows_2) = self.rows.split_at_mut(at);
        let (spins, spins_2) = self.spins.split_at_mut(at);
        let (halves, halves_2) = self.halves.split_at_mut(at);
        let (rest, rest_2) = self.rest.split_at_mut(at);
        let (higher, higher_2) = self.higher.split_at_mut(at.min(self.higher.len()));
        (
            Self { rows, spins, halves, rest, higher },
            Self { rows: rows_2, spins: spins_2, halves: halves_2, rest: rest_2, higher: higher_2 },
        )
    }
}

impl<F: Field> Course<'_, F> {
    /// Moves the grains of every block of `lists`, in halves on two threads if `parallel`.
    pub fn each<S: Scheme>(&self, lists: &[Lists], work: &mut [Work], own: Own<'_>, parallel: bool) {
        match lists {
            [] => {}
            [only] => self.level.run(Motion::<S, F> {
                course: self,
                work: &mut work[0],
                tags: &self.tags[only.start..only.end],
                own,
                scheme: PhantomData,
            }),
            _ => {
                let middle = lists.len() / 2;
                let at = lists[middle].start - lists[0].start;
                let (lists, lists_2) = lists.split_at(middle);
                let (work, work_2) = work.split_at_mut(middle);
                let (own, own_2) = own.split(at);
                if parallel {
                    rayon::join(
                        || self.each::<S>(lists, work, own, true),
                        || self.each::<S>(lists_2, work_2, own_2, true),
                    );
                } else {
                    self.each::<S>(lists, work, own, false);
                    self.each::<S>(lists_2, work_2, own_2, false);
                }
            }
        }
    }
}

/// The motion of one block.
struct Motion<'a, S, F> {
    course: &'a Course<'a, F>,
    work: &'a mut Work,
    tags: &'a [Tag],
    own: Own<'a>,
    scheme: PhantomData<S>,
}

impl<S: Scheme, F: Field> Job for Motion<'_, S, F> {
    type Output = ();

    #[inline(always)]
    fn run<R: Wide>(self) {
        let Own { rows, spins, halves, rest, higher } = self.own;
        let n = self.tags.len();
        let mut movers = Movers {
            rows: &mut rows[..n],
            spins: &mut spins[..n],
            halves: &mut halves[..n],
            higher,
            rest: &mut rest[..n],
            tags: self.tags,
            forces: &mut self.work.forces[..n],
            couples: &self.work.couples,
        };
        self.work.passed = motion::advance::<S, F, R::Quad>(&mut movers, self.course.pace, self.course.field);
    }
}

impl DemState {
    /// Load on each wall in the last step.
    #[must_use]
    pub fn wall_loads(&self) -> &[crate::wall::WallLoad] {
        &self.loads
    }
}

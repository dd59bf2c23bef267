//! The only loop over contacts of pairs, generic in the law and the lane type.

use super::law::{MAX_SLOTS, Touch};
use super::pair::{Answer, Law, energy};
use super::real::{Mask, Real, V3};
use crate::lanes::{Adds, Wide};
use crate::packed::{Couple, Force, INDEX, INDEX_BITS, Row, Shifts, Spin};
use crate::state::{BATCH, Line, memory_place};

/// One list of pairs to evaluate.
pub struct PairJob<'a> {
    /// All rows.
    pub rows: &'a [Row],
    /// All spins.
    pub spins: &'a [Spin],
    /// First bodies, whole batches.
    pub i: &'a [u32],
    /// Second bodies with image.
    pub j: &'a [u32],
    /// Pair class, empty if there is only one.
    pub class: &'a [u8],
    /// Number of real pairs.
    pub len: usize,
    /// Contact memory.
    pub memory: &'a mut [Line],
    /// Who touched when last swept, a bit each.
    pub touched: &'a mut [u8],
    /// Where forces are added.
    pub forces: &'a mut [Force],
    /// Where rolling couples are added, empty unless a law rolls.
    pub couples: &'a mut [Couple],
    /// Rows that belong to the first entry of `forces`, for first and second bodies.
    pub base: (usize, usize),
    /// Who gets the force.
    pub adds: Adds,
    /// Shifts to periodic images.
    pub shifts: &'a Shifts,
    /// Length of the step, s.
    pub dt: f64,
}

/// What a sweep counts, lane by lane so that every lane type sums in the same order.
#[derive(Clone, Debug, Default)]
#[repr(C, align(64))]
pub struct Tally {
    /// Energies by kind, J.
    pub energy: [[f64; BATCH]; energy::KINDS],
    /// Work of walls, J.
    pub wall_work: [f64; BATCH],
    /// Largest overlap, m.
    pub overlap: [f64; BATCH],
    /// Touching contacts.
    pub contacts: u64,
    /// Contacts of pairs that begin, and of grains with walls.
    pub begun: [u64; 2],
}

impl Tally {
    /// Sum of kind `k`, J.
    #[must_use]
    pub fn total(&self, k: usize) -> f64 {
        self.energy[k].iter().sum()
    }
}

/// Adds `x` to the lanes of `sums` that batch place `at` stands for.
#[inline(always)]
pub(super) fn tally<R: Wide>(sums: &mut [f64; BATCH], at: usize, x: R) {
    let place = &mut sums[at % BATCH..];
    (R::load(place) + x).store(place);
}

/// Reads the memory of the contacts from `p` on.
#[inline(always)]
pub(super) fn recall<R: Wide>(memory: &[Line], p: usize, slots: usize) -> [R; MAX_SLOTS] {
    let mut m = [R::zero(); MAX_SLOTS];
    for s in 0..slots {
        let (line, lane) = memory_place(p, s, slots);
        m[s] = R::load(&memory[line].0[lane..]);
    }
    m
}

/// Writes it back.
#[inline(always)]
pub(super) fn remember<R: Wide>(m: &[R; MAX_SLOTS], memory: &mut [Line], p: usize, slots: usize) {
    for s in 0..slots {
        let (line, lane) = memory_place(p, s, slots);
        m[s].store(&mut memory[line].0[lane..]);
    }
}

/// Notes who of the contacts from `p` on touches now, and returns how many of them did not when last swept.
#[inline(always)]
pub(super) fn begins<R: Real>(touched: &mut [u8], p: usize, touching: R::Mask) -> u64 {
    let place = &mut touched[p / BATCH];
    let all = (u8::MAX >> (BATCH - R::WIDTH)) << (p % BATCH);
    let now = touching.bits() << (p % BATCH);
    let begun = now & !*place;
    *place = *place & !all | now;
    u64::from(begun.count_ones())
}

/// Counts the losses of contacts: what `answer` lost where they touch, and elsewhere what the springs still held when
/// they remembered `old`, of which `new` keeps nothing.
#[inline(always)]
pub(super) fn account<L: Law, R: Wide>(
    law: &L::Lanes<R>,
    answer: &Answer<R>,
    old: &[R; MAX_SLOTS],
    new: &mut [R; MAX_SLOTS],
    touching: R::Mask,
    counted: &mut Tally,
    p: usize,
) {
    for k in (0..energy::KINDS).filter(|k| L::LOSSES >> k & 1 == 1) {
        let elsewhere = if k == energy::LATCHED { L::released(law, old) } else { R::zero() };
        tally(&mut counted.energy[k], p, R::pick(touching, answer.energy[k], elsewhere));
    }
    for s in 0..L::SLOTS {
        new[s] = new[s].keep(touching);
    }
}

/// Pairs between asking for a row and reading it: a memory access, in time that batches take.
const AHEAD: usize = 32;

/// Grains above which the forces of a block are no longer near when their turn comes; below, asking for them costs
/// more than it saves.
const FAR: usize = 50_000;

/// Evaluates every pair of `job` and adds its forces.
#[inline(always)]
pub fn sweep<L: Law, R: Wide, const SPINS: bool>(table: &[L], job: &mut PairJob<'_>, counted: &mut Tally) {
    let uniform = L::lanes::<R>(table, |_| 0);
    let mut indices = [0u32; BATCH];
    let far = job.rows.len() > FAR;
    let mut p = 0;
    while p < job.len {
        let q = p + R::WIDTH;
        let (i, coded) = (&job.i[p..q], &job.j[p..q]);
        let law = if job.class.is_empty() {
            uniform
        } else {
            let class = &job.class[p..q];
            L::lanes::<R>(table, |k| usize::from(class[k]))
        };
        let mut images = 0;
        for k in 0..R::WIDTH {
            images |= coded[k];
            indices[k] = coded[k] & INDEX;
        }
        let j = &indices[..R::WIDTH];

        if let Some(coming) = job.j.get(p + AHEAD..q + AHEAD) {
            let mut later = [0u32; BATCH];
            for k in 0..R::WIDTH {
                later[k] = coming[k] & INDEX;
            }
            let forces = far.then_some((&*job.forces, job.base.1));
            R::announce::<SPINS>(job.rows, job.spins, forces, &later[..R::WIDTH]);
        }
        let row = R::relative(job.rows, i, j);
        let mut d = V3::new(row[0], row[1], row[2]);
        if images >> INDEX_BITS != 0 {
            d = d - job.shifts.of(coded);
        }
        let reach = row[3];
        let square = d.dot(d);
        let touching = square.lt(reach * reach);
        let bits = touching.bits();
        counted.begun[0] += begins::<R>(job.touched, p, touching);
        if bits == 0 {
            if L::SLOTS > 0 {
                let old = recall::<R>(job.memory, p, L::SLOTS);
                tally(&mut counted.energy[energy::LATCHED], p, L::released(&law, &old));
                remember(&[R::zero(); MAX_SLOTS], job.memory, p, L::SLOTS);
            }
            p = q;
            continue;
        }

        let distance = square.sqrt();
        let spins = if SPINS || L::RADIUS { R::spin_sum(job.spins, i, j) } else { [R::zero(); 4] };
        // Two divisions, neither of which waits for the root.
        let n = d * (distance * (R::splat(1.0) / square));
        let [per_reach, mass, radius] = if L::RADIUS {
            inverse([reach, row[7], spins[3]])
        } else {
            let [a, b] = inverse([reach, row[7]]);
            [a, b, R::zero()]
        };
        let v = V3::new(row[4], row[5], row[6]);
        let closing = v.dot(n);
        let lever = distance * per_reach;
        let slip = if SPINS {
            v - n * closing - V3::new(spins[0], spins[1], spins[2]).cross(n) * lever
        } else {
            v - n * closing
        };
        let roll = if SPINS && L::ROLLS {
            let w = R::spin_difference(job.spins, i, j);
            V3::new(w[0], w[1], w[2])
        } else {
            V3::zero()
        };
        let touch = Touch {
            overlap: (reach - distance).max(R::zero()),
            normal: n,
            approach: -closing,
            slip,
            roll,
            mass,
            radius,
            dt: R::splat(job.dt),
        };

        let old = recall::<R>(job.memory, p, L::SLOTS);
        let mut new = old;
        let answer = L::act(&law, &touch, &mut new);
        account::<L, R>(&law, &answer, &old, &mut new, touching, counted, p);
        remember(&new, job.memory, p, L::SLOTS);
        let largest = &mut counted.overlap[p % BATCH..];
        R::load(largest).max(touch.overlap).store(largest);
        counted.contacts += u64::from(bits.count_ones());

        let f = answer.force.keep(touching);
        let t = if SPINS { (n.cross(answer.tangential) * lever).keep(touching) } else { V3::zero() };
        let count = R::WIDTH.min(job.len - p);
        R::scatter::<SPINS>(
            &[f.x, f.y, f.z, t.x, t.y, t.z],
            job.forces,
            job.base,
            i,
            j,
            count,
            job.adds.sides(),
        );
        if SPINS && L::ROLLS {
            let c = answer.couple.keep(touching);
            R::scatter_couple(&[c.x, c.y, c.z], job.couples, job.base, i, j, count, job.adds.sides());
        }
        p = q;
    }
}

/// The inverse of each of `x` at the price of one division.
#[inline(always)]
fn inverse<R: Real, const N: usize>(x: [R; N]) -> [R; N] {
    // Products of all before, then of all behind.
    let mut result = x;
    let mut product = x[0];
    for k in 1..N {
        result[k] = product;
        product = product * x[k];
    }
    let mut rest = R::splat(1.0) / product;
    for k in (1..N).rev() {
        result[k] = result[k] * rest;
        rest = rest * x[k];
    }
    result[0] = rest;
    result
}

//! From forces to motion: one pass over the grains of a block.

mod gear;
mod rotation;
mod scheme;
mod verlet;

pub use gear::Gear;
pub use scheme::{Kick, Moved, Scheme};
pub use verlet::{PositionVerlet, VelocityVerlet};

use crate::field::{Field, GrainAt, Push};
use crate::packed::{Couple, Force, Half, Rest, Row, Spin, Tag};
use brazilnut_base::{Tick, Vec3, vec3};

/// What is the same for all grains of a step.
#[derive(Clone, Copy, Debug)]
pub struct Pace {
    /// The step.
    pub tick: Tick,
    /// How far half-step velocities are kicked: half a step in the first.
    pub kick: Kick,
    /// 1 per axis, 0 along the flat direction.
    pub free: Vec3,
    /// 1 per axis about which grains may turn.
    pub turns: Vec3,
    /// Grains rotate.
    pub rotation: bool,
}

/// The rows of one block, in and out.
pub struct Movers<'a> {
    /// Rows at the start of the step.
    pub rows: &'a [Row],
    /// Rows at its end.
    pub next_rows: &'a mut [Row],
    /// Spins at the start.
    pub spins: &'a [Spin],
    /// Spins at the end.
    pub next_spins: &'a mut [Spin],
    /// Half-step velocities.
    pub halves: &'a mut [Half],
    /// Higher derivatives, empty for schemes without.
    pub higher: &'a mut [[f64; 12]],
    /// Orientations.
    pub rest: &'a mut [Rest],
    /// Who they are.
    pub tags: &'a [Tag],
    /// Contact forces.
    pub forces: &'a [Force],
    /// Rolling couples, empty if there are none.
    pub couples: &'a [Couple],
}

/// What a pass over a block found.
#[derive(Clone, Copy, Debug)]
pub struct Passed {
    /// Work of gravity, frame, fluid in this step, J.
    pub work: [f64; 3],
    /// Least and greatest displacement, m.
    pub moved: [Vec3; 2],
    /// Lowest and highest coordinates reached, m.
    pub extent: [Vec3; 2],
}

impl Passed {
    /// Nothing passed yet.
    #[must_use]
    pub fn nothing() -> Self {
        let (low, high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        Self { work: [0.0; 3], moved: [low, high], extent: [low, high] }
    }

    /// Adds what another block found.
    pub fn join(&mut self, other: &Self) {
        for k in 0..3 {
            self.work[k] += other.work[k];
        }
        self.moved = [self.moved[0].min(other.moved[0]), self.moved[1].max(other.moved[1])];
        self.extent = [self.extent[0].min(other.extent[0]), self.extent[1].max(other.extent[1])];
    }
}

/// Moves every grain of the block by one step.
pub fn advance<S: Scheme, F: Field>(m: &mut Movers<'_>, pace: &Pace, field: &F) -> Passed {
    let mut passed = Passed::nothing();
    for g in 0..m.rows.len() {
        let row = &m.rows[g].0;
        let spin = &m.spins[g].0;
        let half = &mut m.halves[g].0;
        let here = grain_at(row, spin, half, m.tags[g]);
        let push = field.push(&pace.tick, &here);
        let contact = vec3(m.forces[g].0[0], m.forces[g].0[1], m.forces[g].0[2]);
        let force = contact + push.gravity + push.frame + push.fluid;
        let mut none = [0.0; 12];
        let higher = if S::HIGHER { &mut m.higher[g] } else { &mut none };

        let moved =
            S::translate(here.position, here.velocity, half, higher, force * row[7] * pace.free, pace);
        let next = &mut m.next_rows[g].0;
        next[..3].copy_from_slice(&moved.position.to_array());
        next[3] = row[3];
        next[4..7].copy_from_slice(&moved.velocity.to_array());
        next[7] = row[7];

        let mut turned = Vec3::ZERO;
        if pace.rotation {
            let lever = vec3(m.forces[g].0[4], m.forces[g].0[5], m.forces[g].0[6]);
            let couple = m.couples.get(g).map_or(Vec3::ZERO, |c| vec3(c.0[0], c.0[1], c.0[2]));
            // half[7] is r/I and spin[3] is 1/r: torque over inertia.
            let response = half[7];
            let alpha = ((couple + push.torque) * spin[3] - lever) * response * pace.turns;
            let (mid, omega) = S::rotate(here.angular_velocity, half, higher, alpha, pace);
            turned = mid;
            m.next_spins[g].0 = [row[3] * omega.x, row[3] * omega.y, row[3] * omega.z, spin[3]];
            let step = vec3(half[4], half[5], half[6]) * pace.tick.dt;
            rotation::turn(&mut m.rest[g].orientation, step);
        } else {
            m.next_spins[g].0 = *spin;
        }
        note(&mut passed, pace, &push, &moved, turned);
    }
    passed
}

/// The grain as the field sees it.
#[inline(always)]
fn grain_at(row: &[f64; 8], spin: &[f64; 4], half: &[f64; 8], tag: Tag) -> GrainAt {
    GrainAt {
        id: tag.id as usize,
        species: tag.species,
        radius: row[3],
        mass: half[3],
        position: vec3(row[0], row[1], row[2]),
        velocity: vec3(row[4], row[5], row[6]),
        angular_velocity: vec3(spin[0], spin[1], spin[2]) * spin[3],
    }
}

#[inline(always)]
fn note(passed: &mut Passed, pace: &Pace, push: &Push, moved: &Moved, turned: Vec3) {
    let path = moved.middle * pace.kick.length;
    passed.work[0] += push.gravity.dot(path);
    passed.work[1] += push.frame.dot(path);
    passed.work[2] += push.fluid.dot(path) + push.torque.dot(turned) * pace.kick.length;
    passed.moved = [passed.moved[0].min(moved.step), passed.moved[1].max(moved.step)];
    passed.extent = [passed.extent[0].min(moved.position), passed.extent[1].max(moved.position)];
}

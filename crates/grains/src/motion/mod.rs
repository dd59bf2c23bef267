//! From forces to motion: one pass over the grains of a block.

mod gear;
mod quad;
mod rotation;
mod scheme;
mod verlet;

pub use gear::Gear;
pub use quad::{Array, Quad};
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

/// The grains of one block.
pub struct Movers<'a> {
    /// Rows.
    pub rows: &'a mut [Row],
    /// Spins.
    pub spins: &'a mut [Spin],
    /// Half-step velocities.
    pub halves: &'a mut [Half],
    /// Higher derivatives, empty for schemes without.
    pub higher: &'a mut [[f64; 12]],
    /// Orientations.
    pub rest: &'a mut [Rest],
    /// Who they are.
    pub tags: &'a [Tag],
    /// Contact forces; zero afterwards.
    pub forces: &'a mut [Force],
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

/// [`Passed`] while the pass runs, component by component.
struct Sums<Q> {
    work: [Q; 3],
    moved: [Q; 2],
    extent: [Q; 2],
}

impl<Q: Quad> Sums<Q> {
    fn nothing() -> Self {
        let ends = [Q::splat(f64::INFINITY), Q::splat(f64::NEG_INFINITY)];
        Self { work: [Q::splat(0.0); 3], moved: ends, extent: ends }
    }

    /// Takes note of a grain that `push` moved as `moved` says, turning at `turned` (rad/s) meanwhile.
    #[inline(always)]
    fn note(&mut self, pace: &Pace, push: &Push, moved: &Moved<Q>, turned: Q) {
        let length = pace.kick.length;
        let path = moved.middle * length;
        self.work[0] = self.work[0] + Q::from(push.gravity) * path;
        self.work[1] = self.work[1] + Q::from(push.frame) * path;
        let torque = Q::from(push.torque) * (turned * length);
        self.work[2] = self.work[2] + (Q::from(push.fluid) * path + torque);
        self.moved = [self.moved[0].min(moved.step), self.moved[1].max(moved.step)];
        self.extent = [self.extent[0].min(moved.position), self.extent[1].max(moved.position)];
    }

    fn passed(&self) -> Passed {
        let sum = |w: Q| {
            let [x, y, z, _] = w.lanes();
            x + y + z
        };
        Passed {
            work: self.work.map(sum),
            moved: self.moved.map(Q::vector),
            extent: self.extent.map(Q::vector),
        }
    }
}

/// Grains that are moved before they are turned: the processor works on several at once where each takes few
/// instructions.
const CHUNK: usize = 16;

/// Moves every grain of the block by one step.
#[inline(always)]
pub fn advance<S: Scheme, F: Field, Q: Quad>(m: &mut Movers<'_>, pace: &Pace, field: &F) -> Passed {
    let mut sums = Sums::<Q>::nothing();
    let (free, turns) = (Q::from(pace.free), Q::from(pace.turns));
    let mut g = 0;
    while g < m.rows.len() {
        let chunk = g..m.rows.len().min(g + CHUNK);
        g = chunk.end;
        for g in chunk.clone() {
            let (row, spin, forces) = (&mut m.rows[g].0, &mut m.spins[g].0, &mut m.forces[g].0);
            let (contact, lever) = (Q::load(forces, 0), Q::load(forces, 4));
            *forces = [0.0; 8];
            let half = &mut m.halves[g].0;
            let push = field.push(&pace.tick, &grain_at(row, spin, half, m.tags[g]));
            let outside = Q::from(push.gravity) + Q::from(push.frame) + Q::from(push.fluid);
            let mut none = [0.0; 12];
            let higher = if S::HIGHER { &mut m.higher[g] } else { &mut none };

            let acceleration = (contact + outside) * row[7] * free;
            let (position, velocity) = (Q::load(row, 0), Q::load(row, 4));
            let moved = S::translate(position, velocity, half, higher, acceleration, pace);
            moved.position.with(row[3]).store(row, 0);
            moved.velocity.with(row[7]).store(row, 4);

            let mut turned = Q::splat(0.0);
            if pace.rotation {
                let couple = m.couples.get(g).map_or(Q::splat(0.0), |c| Q::of(c.0));
                // half[7] is r/I and spin[3] is 1/r: torque over inertia.
                let torque = (couple + Q::from(push.torque)) * spin[3] - lever;
                let alpha = torque * half[7] * turns;
                let omega = Q::load(spin, 0) * spin[3];
                let (mid, omega) = S::rotate(omega, half, higher, alpha, pace);
                turned = mid;
                (omega * row[3]).with(spin[3]).store(spin, 0);
            }
            sums.note(pace, &push, &moved, turned);
        }
        if pace.rotation {
            for g in chunk {
                rotation::turn(&mut m.rest[g].orientation, Q::load(&m.halves[g].0, 4) * (0.5 * pace.tick.dt));
            }
        }
    }
    sums.passed()
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

//! What others may ask of the state.

use super::Dem;
use crate::contact::law::MAX_SLOTS;
use crate::contact::{Answer, Touch, V3, energy};
use crate::ledger::Ledger;
use crate::packed::{INDEX, INDEX_BITS, image_of};
use crate::state::{DemState, Line, Pairs, remembered};
use crate::wall::Walls;
use brazilnut_base::{Vec3, vec3};

/// The other body of a contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Partner {
    /// A grain, by identity.
    Grain(usize),
    /// A wall, by number.
    Wall(usize),
}

/// One touching contact at the time of the state.
#[derive(Clone, Copy, Debug)]
pub struct ContactView {
    /// Identity of the first body.
    pub first: usize,
    /// The second body.
    pub second: Partner,
    /// Overlap, m.
    pub overlap: f64,
    /// Overlap over the smaller radius.
    pub relative_overlap: f64,
    /// Unit vector from the second body to the first.
    pub normal: Vec3,
    /// Place of the contact, m.
    pub point: Vec3,
    /// Force on the first body, N.
    pub force: Vec3,
    /// Its part in the tangent plane, N.
    pub tangential: Vec3,
    /// Energy stored in its springs, J.
    pub stored: f64,
}

impl Dem {
    /// Calls `see` with every touching contact, each pair once. Lists and memory stay as they are.
    pub fn contacts(&self, state: &DemState, mut see: impl FnMut(&ContactView)) {
        let walls = self.walls.at(state.time);
        for lists in &state.blocks {
            for pairs in [&lists.inside, &lists.first, &lists.big] {
                for p in 0..pairs.len {
                    self.pair(state, pairs, p, &mut see);
                }
            }
            for p in 0..lists.walls.inner.len() {
                self.wall(state, &walls, &lists.walls, p, &mut see);
            }
        }
    }

    fn pair(&self, state: &DemState, pairs: &Pairs, p: usize, see: &mut impl FnMut(&ContactView)) {
        let (i, j) = (pairs.i[p] as usize, (pairs.j[p] & INDEX) as usize);
        let s = image_of(pairs.j[p] >> INDEX_BITS);
        let shift = self.spec.cell.size * Vec3::new(f64::from(s[0]), f64::from(s[1]), f64::from(s[2]));
        let (a, b) = (&state.rows[i], &state.rows[j]);
        let d = a.position() - b.position() - shift;
        let distance = d.length();
        let reach = a.radius() + b.radius();
        if distance >= reach {
            return;
        }
        let n = d / distance;
        let (sa, sb) = (&state.spins[i].0, &state.spins[j].0);
        let surface = vec3(sa[0] + sb[0], sa[1] + sb[1], sa[2] + sb[2]);
        let roll = vec3(sa[0], sa[1], sa[2]) * sa[3] - vec3(sb[0], sb[1], sb[2]) * sb[3];
        let touch =
            self.touch(n, reach - distance, a.velocity() - b.velocity(), (surface, distance / reach), roll);
        let touch = Touch { mass: 1.0 / (a.0[7] + b.0[7]), radius: 1.0 / (sa[3] + sb[3]), ..touch };
        let answer = self.ask(&pairs.class, &pairs.memory, p, &touch);
        see(&ContactView {
            first: state.tags[i].id as usize,
            second: Partner::Grain(state.tags[j].id as usize),
            relative_overlap: touch.overlap / a.radius().min(b.radius()),
            point: a.position() - n * (a.radius() * distance / reach),
            ..view(&touch, &answer)
        });
    }

    fn wall(
        &self,
        state: &DemState,
        walls: &Walls,
        list: &crate::state::WallPairs,
        p: usize,
        see: &mut impl FnMut(&ContactView),
    ) {
        let (row, wall, feature) = list.inner[p];
        let (g, s) = (&state.rows[row as usize], &state.spins[row as usize].0);
        let near = walls.nearest(usize::from(wall), feature, g.position());
        let radius = g.radius();
        if near.distance >= radius {
            return;
        }
        let surface = vec3(s[0], s[1], s[2]);
        let v = g.velocity() - walls.velocity(usize::from(wall));
        let lever = near.distance / radius;
        let touch = self.touch(near.normal, radius - near.distance, v, (surface, lever), surface * s[3]);
        let touch = Touch { mass: 1.0 / g.0[7], radius: 1.0 / (s[3] + near.curvature), ..touch };
        let answer = self.ask(&list.class, &list.memory, p, &touch);
        see(&ContactView {
            first: state.tags[row as usize].id as usize,
            second: Partner::Wall(usize::from(wall)),
            relative_overlap: touch.overlap / radius,
            point: g.position() - near.normal * near.distance,
            ..view(&touch, &answer)
        });
    }

    fn touch(&self, n: Vec3, overlap: f64, v: Vec3, (surface, lever): (Vec3, f64), roll: Vec3) -> Touch<f64> {
        let closing = v.dot(n);
        let spin = if self.spec.rotation { surface.cross(n) * lever } else { Vec3::ZERO };
        Touch {
            overlap,
            normal: lanes(n),
            approach: -closing,
            slip: lanes(v - n * closing - spin),
            roll: lanes(if self.spec.rotation { roll } else { Vec3::ZERO }),
            mass: 0.0,
            radius: 0.0,
            dt: self.spec.dt,
        }
    }

    fn ask(&self, class: &[u8], memory: &[Line], p: usize, touch: &Touch<f64>) -> Answer<f64> {
        let slots = self.law.slots();
        let mut m = [0.0; MAX_SLOTS];
        for s in 0..slots {
            m[s] = remembered(memory, p, s, slots);
        }
        self.law.single(class.get(p).map_or(0, |&c| usize::from(c)), touch, &mut m)
    }

    /// Energies now and since the start.
    #[must_use]
    pub fn ledger(&self, state: &DemState) -> Ledger {
        let (translation, rotation) = self.kinetic_parts(state);
        let mut elastic = 0.0;
        self.contacts(state, |c| elastic += c.stored);
        let s = &state.sums;
        Ledger {
            initial: s.initial,
            gravity: s.gravity,
            frame: s.frame,
            walls: s.walls,
            fluid: s.fluid,
            translation,
            rotation,
            elastic,
            damping: s.lost[energy::DAMPED],
            sliding: s.lost[energy::SLID],
            tangential_damping: s.lost[energy::TANGENTIAL],
            rolling: s.lost[energy::ROLLED],
            hysteresis: s.lost[energy::LATCHED],
        }
    }

    pub(super) fn kinetic(&self, state: &DemState) -> f64 {
        let (translation, rotation) = self.kinetic_parts(state);
        translation + rotation
    }

    fn kinetic_parts(&self, state: &DemState) -> (f64, f64) {
        let (mut translation, mut rotation) = (0.0, 0.0);
        for k in 0..state.len() {
            translation += 0.5 * state.halves[k].0[3] * state.rows[k].velocity().length_squared();
            let s = &state.spins[k].0;
            rotation += 0.5 * state.rest[k].inertia * (vec3(s[0], s[1], s[2]) * s[3]).length_squared();
        }
        (translation, rotation)
    }
}

fn lanes(v: Vec3) -> V3<f64> {
    V3::new(v.x, v.y, v.z)
}

fn vector(v: V3<f64>) -> Vec3 {
    vec3(v.x, v.y, v.z)
}

fn view(touch: &Touch<f64>, answer: &Answer<f64>) -> ContactView {
    ContactView {
        first: 0,
        second: Partner::Wall(0),
        overlap: touch.overlap,
        relative_overlap: 0.0,
        normal: vector(touch.normal),
        point: Vec3::ZERO,
        force: vector(answer.force),
        tangential: vector(answer.tangential),
        stored: answer.energy[energy::STORED],
    }
}

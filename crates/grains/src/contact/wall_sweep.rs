//! The only loop over contacts with walls: geometry one by one, the law by lanes.

use super::law::Touch;
use super::pair::Law;
use super::real::{Mask, V3};
use super::sweep::{Tally, account, begins, recall, remember, tally};
use crate::lanes::Wide;
use crate::packed::{Couple, Force, Row, Spin};
use crate::state::{BATCH, Line};
use crate::wall::{WallLoad, Walls};
use brazilnut_base::vec3;

/// One list of wall contacts to evaluate.
pub struct WallJob<'a> {
    /// All rows.
    pub rows: &'a [Row],
    /// All spins.
    pub spins: &'a [Spin],
    /// Row, wall, feature.
    pub touching: &'a [(u32, u16, u32)],
    /// Pair class, empty if there is only one.
    pub class: &'a [u8],
    /// Contact memory.
    pub memory: &'a mut [Line],
    /// Who touched when last swept, a bit each.
    pub touched: &'a mut [u8],
    /// Where forces are added.
    pub forces: &'a mut [Force],
    /// Where rolling couples are added.
    pub couples: &'a mut [Couple],
    /// Row of the first entry of `forces`.
    pub base: usize,
    /// The walls where they are now.
    pub walls: &'a Walls,
    /// Where the loads on walls are added.
    pub loads: &'a mut [WallLoad],
    /// Length of the step, s.
    pub dt: f64,
}

/// Columns of a batch of wall contacts.
#[derive(Default)]
struct Columns {
    normal: [[f64; BATCH]; 3],
    distance: [f64; BATCH],
    curvature: [f64; BATCH],
    velocity: [[f64; BATCH]; 3],
    wall_velocity: [[f64; BATCH]; 3],
    surface: [[f64; BATCH]; 3],
    angular: [[f64; BATCH]; 3],
    radius: [f64; BATCH],
    inverse_mass: [f64; BATCH],
}

/// Evaluates every wall contact of `job` and adds its forces.
#[inline(always)]
pub fn sweep_walls<L: Law, R: Wide, const SPINS: bool>(
    table: &[L],
    job: &mut WallJob<'_>,
    counted: &mut Tally,
) {
    let mut batch = 0;
    while batch < job.touching.len() {
        let count = BATCH.min(job.touching.len() - batch);
        let columns = geometry(job, batch, count);
        for lane in (0..count).step_by(R::WIDTH) {
            contact::<L, R, SPINS>(table, job, counted, &columns, batch + lane, lane);
        }
        batch += BATCH;
    }
}

/// Where and how fast the grains of one batch approach their walls. Lanes
/// beyond `count` stay far from any wall.
#[inline(always)]
fn geometry(job: &WallJob<'_>, batch: usize, count: usize) -> Columns {
    let mut c = Columns { distance: [1.0; BATCH], inverse_mass: [1.0; BATCH], ..Columns::default() };
    c.normal[2] = [1.0; BATCH];
    for k in 0..count {
        let (row, wall, feature) = job.touching[batch + k];
        let (g, s) = (&job.rows[row as usize], &job.spins[row as usize].0);
        let near = job.walls.nearest(usize::from(wall), feature, g.position());
        let v = job.walls.velocity(usize::from(wall));
        c.distance[k] = near.distance;
        c.curvature[k] = near.curvature;
        c.radius[k] = g.0[3];
        c.inverse_mass[k] = g.0[7];
        for a in 0..3 {
            c.normal[a][k] = near.normal[a];
            c.velocity[a][k] = g.0[4 + a];
            c.wall_velocity[a][k] = v[a];
            c.surface[a][k] = s[a];
            c.angular[a][k] = s[a] * s[3];
        }
    }
    c
}

#[inline(always)]
fn vector<R: Wide>(c: &[[f64; BATCH]; 3], lane: usize) -> V3<R> {
    V3::new(R::load(&c[0][lane..]), R::load(&c[1][lane..]), R::load(&c[2][lane..]))
}

#[inline(always)]
fn contact<L: Law, R: Wide, const SPINS: bool>(
    table: &[L],
    job: &mut WallJob<'_>,
    counted: &mut Tally,
    c: &Columns,
    p: usize,
    lane: usize,
) {
    let count = R::WIDTH.min(job.touching.len() - p);
    let class = job.class;
    let law =
        L::lanes::<R>(table, |k| if class.is_empty() || k >= count { 0 } else { usize::from(class[p + k]) });
    let radius = R::load(&c.radius[lane..]);
    let distance = R::load(&c.distance[lane..]);
    let touching = distance.lt(radius);
    counted.begun[1] += begins::<R>(job.touched, p, touching);
    if L::SLOTS == 0 && !touching.any() {
        return;
    }
    let n = vector::<R>(&c.normal, lane);
    let wall_velocity = vector::<R>(&c.wall_velocity, lane);
    let v = vector::<R>(&c.velocity, lane) - wall_velocity;
    let closing = v.dot(n);
    let lever = distance / radius;
    let slip = if SPINS {
        v - n * closing - vector::<R>(&c.surface, lane).cross(n) * lever
    } else {
        v - n * closing
    };
    let touch = Touch {
        overlap: (radius - distance).max(R::zero()),
        normal: n,
        approach: -closing,
        slip,
        roll: if SPINS && L::ROLLS { vector(&c.angular, lane) } else { V3::zero() },
        mass: R::splat(1.0) / R::load(&c.inverse_mass[lane..]),
        radius: radius / (R::splat(1.0) + radius * R::load(&c.curvature[lane..])),
        dt: R::splat(job.dt),
    };

    let old = recall::<R>(job.memory, p, L::SLOTS);
    let mut new = old;
    let answer = L::act(&law, &touch, &mut new);
    account::<L, R>(&law, &answer, &old, &mut new, touching, counted, p);
    remember(&new, job.memory, p, L::SLOTS);
    let f = answer.force.keep(touching);
    tally(&mut counted.wall_work, p, f.dot(wall_velocity) * touch.dt);
    let largest = &mut counted.overlap[p % BATCH..];
    R::load(largest).max(touch.overlap).store(largest);
    let bits = touching.bits();
    counted.contacts += u64::from(bits.count_ones());

    let t = if SPINS { n.cross(answer.tangential) * lever } else { V3::zero() };
    for k in (0..count).filter(|k| bits >> k & 1 == 1) {
        let (row, wall, _) = job.touching[p + k];
        let at = row as usize - job.base;
        let force = vec3(f.x.lane(k), f.y.lane(k), f.z.lane(k));
        let sum = &mut job.forces[at].0;
        for a in 0..3 {
            sum[a] += force[a];
        }
        if SPINS {
            for (a, t) in [t.x, t.y, t.z].into_iter().enumerate() {
                sum[4 + a] += t.lane(k);
            }
        }
        if SPINS && L::ROLLS {
            let couple = [answer.couple.x, answer.couple.y, answer.couple.z];
            for (a, m) in couple.into_iter().enumerate() {
                job.couples[at].0[a] += m.lane(k);
            }
        }
        let load = &mut job.loads[usize::from(wall)];
        load.force -= force;
        load.contacts += 1;
    }
}

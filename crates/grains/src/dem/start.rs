//! Into the engine and out of it.

use super::Dem;
use crate::grains::Grains;
use crate::motion::{Gear, PositionVerlet, Scheme, VelocityVerlet};
use crate::neighbors::Skins;
use crate::packed::{DUMMIES, Half, INDEX, Rest, Row, Spin, Tag};
use crate::spec::{DemSpec, Integrator, SpecError};
use crate::state::{Collisions, Counts, DemState, Drift, Lists, Sums};
use crate::wall::{WallLoad, WallShape};
use brazilnut_base::{Quat, Vec3, vec3};

/// More materials than this have no room in a pair class.
const MOST_MATERIALS: usize = 16;
/// Outer skin of slow grains over mean diameter: a rebuild every few hundred steps of a shaken bed.
const OUTER_SKIN: f64 = 0.15;
/// First inner skin over mean diameter, before anything has moved.
const INNER_SKIN: f64 = 0.006;
/// At most this many grains are treated as big bodies.
const MOST_BIG: usize = 64;
/// A big body is this many times larger than the largest of the rest.
const BIG: f64 = 1.5;

/// Refuses what cannot work whatever the grains.
pub(super) fn check(spec: &DemSpec) -> Result<(), SpecError> {
    let wrong = |what: &str, why: String| Err(SpecError::new(what, why));
    let n = spec.materials.len();
    if n == 0 || n > MOST_MATERIALS {
        return wrong("materials", format!("{n} materials; between 1 and {MOST_MATERIALS} are possible"));
    }
    if spec.contact.pairs.materials() != n {
        return wrong(
            "contact pairs",
            format!("made for {} materials, not {n}", spec.contact.pairs.materials()),
        );
    }
    if !(spec.dt > 0.0 && spec.dt.is_finite()) {
        return wrong("time step", format!("{} s is no length of a step", spec.dt));
    }
    if spec.search.block == 0 {
        return wrong("block", "a block needs at least one grain".into());
    }
    for wall in &spec.walls {
        if usize::from(wall.material) >= n {
            return wrong(&wall.name, format!("material {} does not exist", wall.material));
        }
        let fits = match wall.shape {
            WallShape::Plane { normal, .. } => (normal.length() - 1.0).abs() < 1e-9,
            WallShape::Box { low, high } => low.cmple(high).all(),
            WallShape::Bumps { axis, radius, spacing, .. } => axis < 3 && radius > 0.0 && spacing > 0.0,
        };
        if !fits {
            return wrong(&wall.name, "its shape is not a proper one".into());
        }
    }
    Ok(())
}

impl Dem {
    /// The state in which `grains` are at time zero, without contact memory.
    pub fn start(&mut self, grains: &Grains) -> Result<DemState, SpecError> {
        self.check_grains(grains)?;
        let n = grains.len();
        let (order, small) = big_last(&grains.radius, self.spec.search.all_pairs_below);
        let free = self.free;
        let mut state = DemState {
            time: 0.0,
            fresh: true,
            rows: Vec::with_capacity(n + DUMMIES),
            spins: Vec::with_capacity(n + DUMMIES),
            halves: Vec::with_capacity(n),
            higher: vec![[0.0; 12]; if self.spec.integrator == Integrator::Gear { n } else { 0 }],
            tags: Vec::with_capacity(n),
            rest: Vec::with_capacity(n),
            small,
            blocks: blocks(small, n, &self.spec),
            drift: Drift::default(),
            sums: Sums::default(),
            loads: vec![WallLoad::default(); self.walls.len()],
            wall_marks: [vec![], vec![]],
            skins: self.skins(grains),
            radii: [least(&grains.radius), order[..small].iter().fold(0.0, |a, &k| grains.radius[k].max(a))],
            overlap: 0.0,
            contacts: 0,
            collisions: Collisions::default(),
            extent: extent(&grains.position),
            counts: Counts::default(),
            built: 0,
        };
        for k in order {
            let (r, m, i) = (grains.radius[k], grains.mass[k], grains.inertia[k]);
            let x = grains.position[k];
            let v = grains.velocity[k] * free;
            let w = grains.angular_velocity[k] * self.turns;
            let h = self.half_of(v);
            state.rows.push(Row([x.x, x.y, x.z, r, v.x, v.y, v.z, 1.0 / m]));
            state.spins.push(Spin([r * w.x, r * w.y, r * w.z, 1.0 / r]));
            state.halves.push(Half([h.x, h.y, h.z, m, w.x, w.y, w.z, r / i]));
            state.tags.push(Tag { id: k as u32, species: grains.species[k], material: grains.material[k] });
            let orientation = grains.orientation[k].to_array();
            state.rest.push(Rest { orientation, inertia: i, image: grains.image[k] });
        }
        for k in 0..DUMMIES {
            state.rows.push(Row::dummy(k));
            state.spins.push(Spin([0.0, 0.0, 0.0, 1.0]));
        }
        self.walls.move_to(0.0);
        self.rebuild(&mut state);
        state.sums.initial = {
            let l = self.ledger(&state);
            l.translation + l.rotation + l.elastic
        };
        Ok(state)
    }

    fn half_of(&self, v: Vec3) -> Vec3 {
        match self.spec.integrator {
            Integrator::VelocityVerlet => VelocityVerlet::half_of(v, self.spec.dt),
            Integrator::PositionVerlet => PositionVerlet::half_of(v, self.spec.dt),
            Integrator::Gear => Gear::half_of(v, self.spec.dt),
        }
    }

    fn check_grains(&self, grains: &Grains) -> Result<(), SpecError> {
        if grains.len() + DUMMIES > INDEX as usize {
            return Err(SpecError::new("grains", "too many for this engine"));
        }
        let cell = &self.spec.cell;
        for k in 0..grains.len() {
            let wrong = |why: String| Err(SpecError::new(format!("grain {k}"), why));
            let (r, m, i) = (grains.radius[k], grains.mass[k], grains.inertia[k]);
            if !(r > 0.0 && m > 0.0 && i > 0.0 && (r * m * i).is_finite()) {
                return wrong(format!("radius {r} m, mass {m} kg, inertia {i} kg m²: all must be positive"));
            }
            if !(grains.position[k].is_finite() && grains.velocity[k].is_finite()) {
                return wrong("its position or velocity is not finite".into());
            }
            if usize::from(grains.material[k]) >= self.spec.materials.len() {
                return wrong(format!("material {} does not exist", grains.material[k]));
            }
            for axis in 0..3 {
                // A relative slack for sizes that were computed from each other.
                if cell.is_periodic(axis) && 2.0 * r > cell.size[axis] * (1.0 + 1e-12) {
                    return wrong(format!("its diameter {} m exceeds the periodic cell", 2.0 * r));
                }
            }
        }
        Ok(())
    }

    fn skins(&self, grains: &Grains) -> Skins {
        let mean = 2.0 * grains.radius.iter().sum::<f64>() / grains.len().max(1) as f64;
        let search = &self.spec.search;
        let outer = search.skin.unwrap_or(OUTER_SKIN * mean);
        Skins { slow: outer, outer, inner: search.inner_skin.unwrap_or(INNER_SKIN * mean).min(outer) }
    }

    /// Fills `grains`, in the order of identities, with the present state.
    pub fn export(&self, state: &DemState, grains: &mut Grains) {
        let n = state.len();
        grains.resize(n);
        for k in 0..n {
            let id = state.tags[k].id as usize;
            let (row, spin, rest) = (&state.rows[k], &state.spins[k].0, &state.rest[k]);
            let (position, crossed) = self.spec.cell.wrap(row.position());
            grains.species[id] = state.tags[k].species;
            grains.material[id] = state.tags[k].material;
            grains.radius[id] = row.radius();
            grains.mass[id] = state.halves[k].0[3];
            grains.inertia[id] = rest.inertia;
            grains.position[id] = position;
            grains.velocity[id] = row.velocity();
            grains.orientation[id] = Quat::from_array(rest.orientation);
            grains.angular_velocity[id] = vec3(spin[0], spin[1], spin[2]) * spin[3];
            grains.image[id] = std::array::from_fn(|a| rest.image[a] + crossed[a]);
        }
    }

    /// Adds `dv` (m/s) to every velocity: a change of frame. The ledger books it as put in by hand.
    pub fn boost(&self, state: &mut DemState, dv: Vec3) {
        let dv = dv * self.free;
        let before = self.kinetic(state);
        let dh = self.half_of(dv);
        for (row, half) in state.rows.iter_mut().zip(&mut state.halves) {
            for a in 0..3 {
                row.0[4 + a] += dv[a];
                half.0[a] += dh[a];
            }
        }
        state.sums.initial += self.kinetic(state) - before;
    }

    /// Stops every grain. The ledger books it as taken out by hand.
    pub fn still(&self, state: &mut DemState) {
        state.sums.initial -= self.kinetic(state);
        for row in &mut state.rows {
            row.0[4..7].fill(0.0);
        }
        for spin in &mut state.spins {
            spin.0[..3].fill(0.0);
        }
        self.retime(state);
    }

    /// Prepares `state` for steps of this engine's length after those of another:
    /// half-step velocities start again from full-step ones.
    pub fn retime(&self, state: &mut DemState) {
        for (k, half) in state.halves.iter_mut().enumerate() {
            let spin = &state.spins[k].0;
            let h = self.half_of(state.rows[k].velocity());
            let w = vec3(spin[0], spin[1], spin[2]) * spin[3];
            half.0[..3].copy_from_slice(&h.to_array());
            half.0[4..7].copy_from_slice(&w.to_array());
        }
        let gear = self.spec.integrator == Integrator::Gear;
        state.higher.clear();
        state.higher.resize(if gear { state.tags.len() } else { 0 }, [0.0; 12]);
        state.fresh = true;
    }
}

/// Identities with the big bodies last, and how many are small.
fn big_last(radius: &[f64], all_pairs_below: usize) -> (Vec<usize>, usize) {
    let n = radius.len();
    let most = MOST_BIG.min(n / 50);
    if n < all_pairs_below || most == 0 {
        return ((0..n).collect(), n);
    }
    let mut sorted = radius.to_vec();
    sorted.sort_by(|a, b| b.total_cmp(a));
    let limit = BIG * sorted[most];
    let (mut small, big): (Vec<usize>, Vec<usize>) = (0..n).partition(|&k| radius[k] <= limit);
    let count = small.len();
    small.extend(big);
    (small, count)
}

/// The cut into blocks: by number alone, so that it is the same on every machine.
fn blocks(small: usize, n: usize, spec: &DemSpec) -> Vec<Lists> {
    let count = if small < spec.search.all_pairs_below { 1 } else { small.div_ceil(spec.search.block) };
    let range = |start, end| Lists { start, end, ..Lists::default() };
    let mut blocks: Vec<Lists> =
        brazilnut_base::parallel::cut(small, count).map(|r| range(r.start, r.end)).collect();
    blocks.push(range(small, n));
    blocks
}

fn least(radius: &[f64]) -> f64 {
    radius.iter().fold(f64::INFINITY, |a, &r| a.min(r))
}

fn extent(position: &[Vec3]) -> [Vec3; 2] {
    position.iter().fold([Vec3::INFINITY, Vec3::NEG_INFINITY], |[a, b], &x| [a.min(x), b.max(x)])
}

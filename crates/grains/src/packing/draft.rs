//! A filling half placed: sizes drawn, grains placed by hand set, the rest open.

use super::occupancy::Occupancy;
use super::{Filling, PackingError, Region, occupied};
use crate::Grains;
use brazilnut_base::random::stream;
use brazilnut_base::{Side, Vec3};
use rand::RngExt;

/// Overlap over radius that counts as touching: a lattice of touching grains has rounding on both sides of it.
pub(super) const ROUNDING: f64 = 1e-9;

/// Grains with their sizes, some of them without a place yet.
pub(super) struct Draft<'a> {
    pub(super) filling: &'a Filling,
    pub(super) grains: Grains,
    /// Identities that still need a place.
    pub(super) open: Vec<usize>,
    pub(super) placed: Occupancy,
}

impl<'a> Draft<'a> {
    /// Draws all sizes and places what is placed by hand.
    pub(super) fn new(filling: &'a Filling) -> Result<Self, PackingError> {
        let mut grains = Grains::default();
        let mut open = vec![];
        for (s, species) in filling.species.iter().enumerate() {
            species.sizes.check()?;
            for number in 0..species.count.max(species.at.len()) {
                let k = grains.len();
                let r = 0.5 * species.sizes.draw(filling.seed, k);
                let x = species.at.get(number).copied();
                if x.is_none() {
                    open.push(k);
                }
                push(&mut grains, filling, s, r, x.unwrap_or(Vec3::ZERO), species.velocity);
            }
        }
        let placed = Occupancy::new(&filling.cell, &grains.radius);
        let mut draft = Self { filling, grains, open, placed };
        draft.set_by_hand()?;
        for &k in &draft.open {
            let _ = draft.bounds(k)?;
        }
        Ok(draft)
    }

    fn set_by_hand(&mut self) -> Result<(), PackingError> {
        let mut k = 0;
        for species in &self.filling.species {
            for (i, &x) in species.at.iter().enumerate() {
                let x = middle(self.filling, x);
                check_inside(self.filling, &species.name, i + 1, x, self.grains.radius[k + i])?;
                let mut clash = None;
                let r = self.grains.radius[k + i];
                self.placed.near(x, r, |j| {
                    let gap = self.gap(j, x, r);
                    if gap < -ROUNDING * r {
                        clash = Some((j, -gap / r.min(self.grains.radius[j])));
                    }
                });
                if let Some((j, overlap)) = clash {
                    return Err(PackingError::Overlap { pair: [j, k + i], overlap });
                }
                self.place(k + i, x);
            }
            k += species.count.max(species.at.len());
        }
        Ok(())
    }

    /// Sets grain `k` at `x` for good.
    pub(super) fn place(&mut self, k: usize, x: Vec3) {
        let (x, _) = self.filling.cell.wrap(x);
        self.grains.position[k] = x;
        self.placed.insert(k, x, self.grains.radius[k]);
    }

    /// True if a sphere of radius `r` at `x` touches nothing placed and no inner wall.
    pub(super) fn is_free(&self, x: Vec3, r: f64) -> bool {
        let touching = -ROUNDING * r;
        let mut free = self.filling.solids.iter().all(|s| outside(s, x) - r >= touching);
        if free {
            self.placed.near(x, r, |j| free &= self.gap(j, x, r) >= touching);
        }
        free
    }

    /// Distance between the surfaces of grain `j` and a sphere of radius `r` at `x`, m.
    fn gap(&self, j: usize, x: Vec3, r: f64) -> f64 {
        self.filling.cell.nearest(x - self.grains.position[j]).length() - r - self.grains.radius[j]
    }

    /// The box in which the centre of grain `k` may lie.
    pub(super) fn bounds(&self, k: usize) -> Result<Region, PackingError> {
        let Filling { cell, room, species, .. } = self.filling;
        let species = &species[usize::from(self.grains.species[k])];
        let r = self.grains.radius[k];
        let (mut low, mut high) = (Vec3::ZERO, cell.size);
        for axis in 0..3 {
            if cell.sides[axis] == Side::Walls {
                (low[axis], high[axis]) = (room.low[axis] + r, room.high[axis] - r);
            }
            if let Some(region) = species.region {
                // A region as wide as a periodic cell is no bound.
                if region.low[axis] > 0.0 || region.high[axis] < cell.size[axis] {
                    low[axis] = low[axis].max(region.low[axis] + r);
                    high[axis] = high[axis].min(region.high[axis] - r);
                }
            }
            if cell.sides[axis] == Side::Flat {
                (low[axis], high[axis]) = (0.5 * cell.size[axis], 0.5 * cell.size[axis]);
            }
            if low[axis] > high[axis] {
                return Err(PackingError::TooLarge {
                    species: species.name.clone(),
                    diameter: 2.0 * r,
                    space: (high[axis] - low[axis] + 2.0 * r).max(0.0),
                    axis: ['x', 'y', 'z'][axis],
                });
            }
        }
        Ok(Region { low, high })
    }

    /// Space that the grains `which` take, m³.
    pub(super) fn occupied(&self, which: impl IntoIterator<Item = usize>) -> f64 {
        which.into_iter().map(|k| occupied(self.grains.radius[k], &self.filling.cell)).sum()
    }

    /// Volume open to grains: the union of the species' regions is approximated by the box around them, m³.
    pub(super) fn space(&self) -> f64 {
        let Filling { room, species, .. } = self.filling;
        let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        for s in species {
            let region = s.region.unwrap_or(*room);
            (low, high) = (low.min(region.low.max(room.low)), high.max(region.high.min(room.high)));
        }
        (high - low).max(Vec3::ZERO).element_product()
    }

    /// The error for not having placed all: `placed` of the open grains found a place.
    pub(super) fn does_not_fit(
        &self,
        method: &'static str,
        left: &[usize],
        remedy: &'static str,
    ) -> PackingError {
        let n = self.grains.len();
        let (all, space) = (self.occupied(0..n), self.space());
        PackingError::DoesNotFit {
            method,
            placed: n - left.len(),
            wanted: n,
            reached: (all - self.occupied(left.iter().copied())) / space,
            needed: all / space,
            remedy,
        }
    }

    /// The open identities in the order of placing: as they come, or shuffled.
    pub(super) fn order(&self, mixed: bool) -> Vec<usize> {
        let mut order = self.open.clone();
        if mixed {
            let mut random = stream(self.filling.seed, "order", 0);
            for i in (1..order.len()).rev() {
                order.swap(i, random.random_range(0..=i));
            }
        }
        order
    }
}

/// Adds a grain of species `s`.
pub(super) fn push(grains: &mut Grains, filling: &Filling, s: usize, r: f64, x: Vec3, v: Vec3) {
    let species = &filling.species[s];
    let mass = filling.shape.mass(r, species.density, &filling.cell);
    grains.push(s as u16, species.material, r, mass, filling.shape.inertia(r, mass), x);
    *grains.velocity.last_mut().expect("just pushed") = v;
}

/// `x` moved to the middle of the flat direction.
pub(super) fn middle(filling: &Filling, mut x: Vec3) -> Vec3 {
    if let Some(axis) = filling.cell.flat_axis() {
        x[axis] = 0.5 * filling.cell.size[axis];
    }
    x
}

/// Refuses a sphere that reaches beyond the room's walls or into an inner wall.
pub(super) fn check_inside(
    filling: &Filling,
    species: &str,
    number: usize,
    x: Vec3,
    r: f64,
) -> Result<(), PackingError> {
    let slack = ROUNDING * r;
    let walls = (0..3).all(|a| {
        filling.cell.sides[a] != Side::Walls
            || (x[a] - r >= filling.room.low[a] - slack && x[a] + r <= filling.room.high[a] + slack)
    });
    if walls && x.is_finite() && filling.solids.iter().all(|s| outside(s, x) >= r - slack) {
        return Ok(());
    }
    Err(PackingError::Outside { species: species.to_string(), number, at: x.to_array() })
}

/// Distance of `x` from a box, zero inside, m.
fn outside(solid: &Region, x: Vec3) -> f64 {
    (x - x.clamp(solid.low, solid.high)).length()
}

//! Where the grains are before the first step.
//!
//! Every way of placing is a pure function from a [`Filling`] and a seed to
//! [`Grains`]; each grain draws from streams of its own, so that one more
//! grain does not move the others' draws. Grains placed by hand are
//! obstacles for the rest.

mod draft;
mod error;
mod expansion;
mod file;
mod insertion;
mod lattice;
mod menu;
mod occupancy;
mod sizes;

pub use error::PackingError;
pub use file::{Listed, from_list, read_csv, read_extended_xyz};
pub use menu::{DIAMETER_KEYS, PLACEMENT_KEYS, PLACEMENTS, Placement};
pub use sizes::{Class, Sizes};

use crate::Grains;
use brazilnut_base::{Cell, Side, Vec3};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// Body that a grain stands for; both touch as circles do.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Shape {
    /// A sphere, also in a flat cell.
    Sphere,
    /// A disc as long as the flat cell is deep.
    Cylinder,
}

/// An axis-parallel box, m.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Region {
    /// Lower corner.
    pub low: Vec3,
    /// Upper corner.
    pub high: Vec3,
}

/// One kind of grain to be placed.
#[derive(Clone, Debug, PartialEq)]
pub struct Species {
    /// Name in the case.
    pub name: String,
    /// Index of the material.
    pub material: u16,
    /// Density, kg/m³.
    pub density: f64,
    /// Distribution of diameters.
    pub sizes: Sizes,
    /// Number of grains, those placed by hand included.
    pub count: usize,
    /// Centres of the first grains, placed by hand, m.
    pub at: Vec<Vec3>,
    /// Velocity of every grain, m/s.
    pub velocity: Vec3,
    /// Where the grains of this kind may be; anywhere if none.
    pub region: Option<Region>,
}

/// What is to be placed, and where.
#[derive(Clone, Debug, PartialEq)]
pub struct Filling {
    /// The cell.
    pub cell: Cell,
    /// The part of the cell that is free for grains (a bumpy floor takes some away).
    pub room: Region,
    /// Boxes that no grain may enter: inner walls.
    pub solids: Vec<Region>,
    /// Body of the grains.
    pub shape: Shape,
    /// The kinds, in the order of their identities.
    pub species: Vec<Species>,
    /// Seed of the run.
    pub seed: u64,
}

impl Filling {
    /// `species` anywhere in `cell`, as spheres.
    #[must_use]
    pub fn new(cell: Cell, species: Vec<Species>, seed: u64) -> Self {
        let room = Region { low: Vec3::ZERO, high: cell.size };
        Self { cell, room, solids: vec![], shape: Shape::Sphere, species, seed }
    }

    /// Number of grains.
    #[must_use]
    pub fn count(&self) -> usize {
        self.species.iter().map(|s| s.count).sum()
    }
}

impl Shape {
    /// Mass of a grain of radius `r` (m) in `cell`, kg.
    #[must_use]
    pub fn mass(self, r: f64, density: f64, cell: &Cell) -> f64 {
        match self {
            Self::Sphere => density * 4.0 / 3.0 * PI * r * r * r,
            Self::Cylinder => density * PI * r * r * depth(cell),
        }
    }

    /// Moment of inertia about the centre (about the axis of a cylinder), kg m².
    #[must_use]
    pub fn inertia(self, r: f64, mass: f64) -> f64 {
        match self {
            Self::Sphere => 0.4 * mass * r * r,
            Self::Cylinder => 0.5 * mass * r * r,
        }
    }
}

/// Extent along the flat direction; unit depth if there is none.
fn depth(cell: &Cell) -> f64 {
    cell.flat_axis().map_or(1.0, |axis| cell.size[axis])
}

/// Space that a grain of radius `r` takes: its volume, or its area times the depth in a flat cell, m³.
#[must_use]
pub fn occupied(r: f64, cell: &Cell) -> f64 {
    match cell.flat_axis() {
        None => 4.0 / 3.0 * PI * r * r * r,
        Some(_) => PI * r * r * depth(cell),
    }
}

/// Height of a bed: occupied volume (m³) over solids fraction times base area (m²), m.
///
/// A random bed settles near 0.6 in three dimensions and 0.82 in two.
#[must_use]
pub fn bed_height(occupied_volume: f64, solids_fraction: f64, base_area: f64) -> f64 {
    occupied_volume / (solids_fraction * base_area)
}

/// Solids fraction at which a random bed comes to rest in `cell`.
#[must_use]
pub fn settled_solids_fraction(cell: &Cell) -> f64 {
    if cell.sides.contains(&Side::Flat) { 0.82 } else { 0.6 }
}

/// Largest overlap of any two grains of `grains` over the smaller radius, and the pair; zero if none touch.
///
/// Linear in the number of grains: what `check` shows of a starting state.
#[must_use]
pub fn largest_overlap(cell: &Cell, grains: &Grains) -> (f64, Option<[usize; 2]>) {
    let mut placed = occupancy::Occupancy::new(cell, &grains.radius);
    let (mut worst, mut pair) = (0.0, None);
    for k in 0..grains.len() {
        let (r, x) = (grains.radius[k], grains.position[k]);
        placed.near(x, r, |j| {
            let d = cell.nearest(x - grains.position[j]).length();
            let overlap = (r + grains.radius[j] - d) / r.min(grains.radius[j]);
            if overlap > worst {
                (worst, pair) = (overlap, Some([j, k]));
            }
        });
        placed.insert(k, x, r);
    }
    (worst, pair)
}

#[cfg(test)]
mod tests {
    use super::*;
    use brazilnut_base::vec3;

    #[test]
    fn disc_of_a_flat_cell() {
        let cell = Cell { size: vec3(0.1, 0.002, 0.1), sides: [Side::Walls, Side::Flat, Side::Walls] };
        let m = Shape::Cylinder.mass(0.001, 1000.0, &cell);
        assert!((m - PI * 1e-6 * 0.002 * 1000.0).abs() < 1e-18);
        assert!((Shape::Cylinder.inertia(0.001, m) - 0.5 * m * 1e-6).abs() < 1e-24);
        assert!((Shape::Sphere.mass(0.001, 1000.0, &cell) - 4e-6 / 3.0 * PI).abs() < 1e-18);
    }

    #[test]
    fn bed_of_clement_chapter_4() {
        // 2500 spheres of 0.7 mm on 20 x 5 mm at porosity 0.45: 8.16 mm (the printed 8.74 mm is 7 % off).
        let cell = Cell { size: vec3(0.02, 0.005, 0.02), sides: [Side::Walls; 3] };
        let h = bed_height(2500.0 * occupied(0.35e-3, &cell), 0.55, cell.base_area());
        assert!((h - 8.16e-3).abs() < 0.01e-3, "{h}");
    }
}

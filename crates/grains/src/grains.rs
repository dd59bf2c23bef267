//! The grains as everybody outside this crate sees them.

use brazilnut_base::{Quat, Vec3};
use serde::{Deserialize, Serialize};

/// All grains in the order of their identity (`k`-th entry = identity `k`), SI, full-step values.
///
/// The engine keeps its own sorted, packed copy; this is filled from it when
/// an observer or a coupling is due.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Grains {
    /// Index of the species.
    pub species: Vec<u16>,
    /// Index of the material.
    pub material: Vec<u16>,
    /// Radius, m.
    pub radius: Vec<f64>,
    /// Mass, kg.
    pub mass: Vec<f64>,
    /// Moment of inertia about the centre, kg m².
    pub inertia: Vec<f64>,
    /// Centre, inside the cell, m.
    pub position: Vec<Vec3>,
    /// Velocity, m/s.
    pub velocity: Vec<Vec3>,
    /// Orientation.
    pub orientation: Vec<Quat>,
    /// Angular velocity, rad/s.
    pub angular_velocity: Vec<Vec3>,
    /// Periodic cells crossed since the start; `position + image * size` is the unwrapped path.
    pub image: Vec<[i32; 3]>,
}

impl Grains {
    /// Number of grains.
    #[must_use]
    pub fn len(&self) -> usize {
        self.position.len()
    }

    /// True if there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.position.is_empty()
    }

    /// Makes room for `n` grains, those added without mass or motion.
    pub fn resize(&mut self, n: usize) {
        self.species.resize(n, 0);
        self.material.resize(n, 0);
        self.radius.resize(n, 0.0);
        self.mass.resize(n, 0.0);
        self.inertia.resize(n, 0.0);
        self.position.resize(n, Vec3::ZERO);
        self.velocity.resize(n, Vec3::ZERO);
        self.orientation.resize(n, Quat::IDENTITY);
        self.angular_velocity.resize(n, Vec3::ZERO);
        self.image.resize(n, [0; 3]);
    }

    /// Adds a grain at rest.
    pub fn push(
        &mut self,
        species: u16,
        material: u16,
        radius: f64,
        mass: f64,
        inertia: f64,
        position: Vec3,
    ) {
        self.species.push(species);
        self.material.push(material);
        self.radius.push(radius);
        self.mass.push(mass);
        self.inertia.push(inertia);
        self.position.push(position);
        self.velocity.push(Vec3::ZERO);
        self.orientation.push(Quat::IDENTITY);
        self.angular_velocity.push(Vec3::ZERO);
        self.image.push([0; 3]);
    }

    /// The path of grain `k` without periodic jumps, m.
    #[must_use]
    pub fn unwrapped(&self, k: usize, cell_size: Vec3) -> Vec3 {
        let n = self.image[k];
        self.position[k] + cell_size * Vec3::new(f64::from(n[0]), f64::from(n[1]), f64::from(n[2]))
    }
}

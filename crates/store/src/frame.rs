//! What a picture of the grains holds, borrowed from whoever owns it.

use brazilnut_base::{Cell, Vec3};

/// Values of one named array.
#[derive(Clone, Copy, Debug)]
pub enum Data<'a> {
    /// One number each.
    Scalars(&'a [f64]),
    /// Three numbers each.
    Vectors(&'a [Vec3]),
    /// A whole number each.
    Integers(&'a [u64]),
}

impl Data<'_> {
    /// Number of entries.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::Scalars(a) => a.len(),
            Self::Vectors(a) => a.len(),
            Self::Integers(a) => a.len(),
        }
    }

    /// True if there is no entry.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// A named array with its unit.
#[derive(Clone, Copy, Debug)]
pub struct Array<'a> {
    /// Lower snake case, the field's standard term.
    pub name: &'a str,
    /// SI unit as text, `1` if dimensionless.
    pub unit: &'a str,
    /// One entry for each grain, cell or point.
    pub data: Data<'a>,
}

impl<'a> Array<'a> {
    /// One number for each grain, cell or point.
    #[must_use]
    pub fn scalars(name: &'a str, unit: &'a str, values: &'a [f64]) -> Self {
        Self { name, unit, data: Data::Scalars(values) }
    }

    /// One vector for each grain, cell or point.
    #[must_use]
    pub fn vectors(name: &'a str, unit: &'a str, values: &'a [Vec3]) -> Self {
        Self { name, unit, data: Data::Vectors(values) }
    }

    /// One whole number for each grain, cell or point.
    #[must_use]
    pub fn integers(name: &'a str, values: &'a [u64]) -> Self {
        Self { name, unit: "1", data: Data::Integers(values) }
    }
}

/// The grains at one time, in the frame of the cell.
#[derive(Clone, Copy, Debug)]
pub struct GrainFrame<'a> {
    /// Number of the step.
    pub step: u64,
    /// Time, s.
    pub time: f64,
    /// The cell that holds them.
    pub cell: &'a Cell,
    /// Names of the species, in the order of their numbers.
    pub species_names: &'a [String],
    /// Number of each grain: lasting, whatever the order in memory.
    pub id: &'a [u64],
    /// Index into `species_names` of each grain.
    pub species: &'a [u64],
    /// Centres, m.
    pub position: &'a [Vec3],
    /// Velocities, m/s.
    pub velocity: &'a [Vec3],
    /// Angular velocities, rad/s; empty if grains do not turn.
    pub angular_velocity: &'a [Vec3],
    /// Radii, m.
    pub radius: &'a [f64],
    /// Anything else, one entry for each grain.
    pub extra: &'a [Array<'a>],
}

impl GrainFrame<'_> {
    /// A sentence about the first array whose length is not the number of grains.
    pub(crate) fn check(&self) -> Result<(), String> {
        let n = self.position.len();
        let turning = if self.angular_velocity.is_empty() { n } else { self.angular_velocity.len() };
        let lengths = [
            ("id", self.id.len()),
            ("species", self.species.len()),
            ("velocity", self.velocity.len()),
            ("angular_velocity", turning),
            ("radius", self.radius.len()),
        ];
        let extra = self.extra.iter().map(|a| (a.name, a.data.len()));
        match lengths.into_iter().chain(extra).find(|(_, len)| *len != n) {
            Some((name, len)) => Err(format!("{name} has {len} entries for {n} grains")),
            None => Ok(()),
        }
    }
}

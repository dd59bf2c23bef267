//! What a user of the engine says: materials, contacts, walls, integrator.

use crate::contact::{NormalLaw, RollingLaw, TangentialLaw};
use crate::material::Material;
use crate::wall::WallSpec;
use brazilnut_base::Cell;
use brazilnut_base::menu::Entry;
use serde::{Deserialize, Serialize};
use std::fmt;

/// Everything that the engine needs to know besides the grains.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DemSpec {
    /// The cell.
    pub cell: Cell,
    /// Materials of grains and walls; grains and walls name them by index.
    pub materials: Vec<Material>,
    /// Laws and their numbers.
    pub contact: ContactSpec,
    /// All walls, those of the cell's sides included.
    pub walls: Vec<WallSpec>,
    /// How the equations of motion are stepped.
    pub integrator: Integrator,
    /// Grains rotate.
    pub rotation: bool,
    /// Length of a step, s.
    pub dt: f64,
    /// What counts as a blow-up.
    pub limits: Limits,
    /// How neighbours are found and contacts swept; no influence on the physics.
    pub search: Search,
}

/// Laws and their numbers for every pair of materials.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ContactSpec {
    /// Normal law.
    pub normal: NormalLaw,
    /// Tangential law.
    pub tangential: TangentialLaw,
    /// Rolling law.
    pub rolling: RollingLaw,
    /// Numbers for each pair of materials.
    pub pairs: PairTable,
}

/// Numbers for one pair of materials; each law takes those it needs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PairSpec {
    /// Normal stiffness, N/m (linear laws) or N/m^1.5 (Hertz laws); from the materials if absent and the law can.
    pub stiffness: Option<f64>,
    /// Restitution coefficient in the normal direction.
    pub restitution: f64,
    /// Impact speed at which `restitution` holds, for laws in which it varies, m/s.
    pub at_speed: Option<f64>,
    /// Sliding friction coefficient.
    pub friction: f64,
    /// Tangential over normal stiffness.
    pub tangential_ratio: Option<f64>,
    /// Tangential damping, kg/s.
    pub tangential_damping: Option<f64>,
    /// Rolling friction coefficient.
    pub rolling_friction: f64,
}

impl Default for PairSpec {
    fn default() -> Self {
        Self {
            stiffness: None,
            restitution: 0.9,
            at_speed: None,
            friction: 0.0,
            tangential_ratio: None,
            tangential_damping: None,
            rolling_friction: 0.0,
        }
    }
}

/// A symmetric table over pairs of materials.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PairTable {
    materials: usize,
    pairs: Vec<PairSpec>,
}

impl PairTable {
    /// The same numbers for all pairs of `materials` materials.
    #[must_use]
    pub fn uniform(materials: usize, pair: PairSpec) -> Self {
        Self { materials, pairs: vec![pair; materials * materials] }
    }

    /// Sets the pair of `a` and `b`.
    pub fn set(&mut self, a: usize, b: usize, pair: PairSpec) {
        self.pairs[a * self.materials + b] = pair.clone();
        self.pairs[b * self.materials + a] = pair;
    }

    /// The pair of `a` and `b`.
    #[must_use]
    pub fn get(&self, a: usize, b: usize) -> &PairSpec {
        &self.pairs[a * self.materials + b]
    }

    /// Number of materials.
    #[must_use]
    pub fn materials(&self) -> usize {
        self.materials
    }
}

/// How the equations of motion are stepped.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Integrator {
    /// Velocity Verlet.
    #[default]
    VelocityVerlet,
    /// Position Verlet (Clément eq. 2.11) with a velocity of second order instead of eq. 2.12.
    PositionVerlet,
    /// Gear's predictor-corrector (Clément eq. 2.13-2.15).
    Gear,
}

/// Integrators in the order of [`Integrator::ALL`].
pub const INTEGRATORS: &[Entry] = &[
    Entry {
        name: "velocity-verlet",
        summary: "Second order; contact forces see a velocity of second order.",
        formula: "v(t+dt/2) = v(t-dt/2) + a dt, r(t+dt) = r(t) + v(t+dt/2) dt",
        source: "",
    },
    Entry {
        name: "position-verlet",
        summary: "The Verlet equation between positions, velocity from three positions.",
        formula: "r(t+dt) = 2 r(t) - r(t-dt) + a dt²",
        source: "Clément eq. 2.11, 2.12 corrected",
    },
    Entry {
        name: "gear",
        summary: "Predictor-corrector with three derivatives of the position.",
        formula: "r_c = r_p + c_0 (a - a_p) dt²/2, ...",
        source: "Clément eq. 2.13-2.15",
    },
];

impl Integrator {
    /// All of them.
    pub const ALL: &[Self] = &[Self::VelocityVerlet, Self::PositionVerlet, Self::Gear];

    /// The integrator of that name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        INTEGRATORS.iter().position(|e| e.name == name).map(|k| Self::ALL[k])
    }
}

/// What counts as a blow-up.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Limits {
    /// Largest overlap over the radius of the smaller grain.
    pub overlap: f64,
}

impl Default for Limits {
    /// A fifth of the radius: soft-sphere contacts mean nothing beyond.
    fn default() -> Self {
        Self { overlap: 0.2 }
    }
}

/// How neighbours are found and contacts swept.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Search {
    /// Which code sweeps the contacts.
    pub sweep: Sweep,
    /// Skin of the outer list, m; from the grains' size if absent.
    pub skin: Option<f64>,
    /// Skin of the inner list, m; from the grains' size if absent.
    pub inner_skin: Option<f64>,
    /// Below this number of grains all pairs are tested and no thread pool is used.
    pub all_pairs_below: usize,
    /// Grains per block; the cut into blocks shapes the order of sums.
    pub block: usize,
}

impl Default for Search {
    fn default() -> Self {
        Self { sweep: Sweep::Fast, skin: None, inner_skin: None, all_pairs_below: 1000, block: 5000 }
    }
}

/// Which code sweeps the contacts; all give the same forces bit for bit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Sweep {
    /// Eight contacts at a time with the widest instructions of this machine.
    Fast,
    /// One contact at a time with what every machine has: the reference.
    Plain,
}

/// What is wrong with a [`DemSpec`], or with grains that do not fit it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SpecError {
    /// The key or quantity at fault.
    pub what: String,
    /// What is wrong with it, and what to do.
    pub why: String,
}

impl SpecError {
    /// A quantity that the chosen law needs is absent.
    #[must_use]
    pub fn missing(what: &str, why: &str) -> Self {
        Self { what: what.into(), why: why.into() }
    }

    /// A quantity is out of range.
    #[must_use]
    pub fn new(what: impl Into<String>, why: impl Into<String>) -> Self {
        Self { what: what.into(), why: why.into() }
    }
}

impl fmt::Display for SpecError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.what, self.why)
    }
}

impl std::error::Error for SpecError {}

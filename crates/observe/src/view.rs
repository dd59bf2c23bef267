//! What an observer may see: plain data, lent for one sample.

use brazilnut_base::motion::Moved;
use brazilnut_base::{Cell, PlaneField, Tick, Vec3};
use brazilnut_grains::{Collisions, Grains};

/// The state of a run at one step boundary, read-only.
///
/// Positions and velocities are those of the frame of `cell`; where the whole
/// cell is shaken that frame moves as `frame` says, and the floor stands still
/// in it.
#[derive(Clone, Copy)]
pub struct View<'a> {
    /// The step boundary.
    pub tick: Tick,
    /// Time in shake cycles (time times frequency); 0 where nothing shakes.
    pub cycle: f64,
    /// Shaking frequency, Hz, if anything shakes.
    pub frequency: Option<f64>,
    /// The cell.
    pub cell: &'a Cell,
    /// The grains.
    pub grains: &'a Grains,
    /// The touching pairs; empty unless some observer [`Needs`] them.
    pub contacts: &'a [ContactAt],
    /// The walls.
    pub walls: &'a [WallAt<'a>],
    /// The energy ledger: name and value in J, in the order of the case.
    pub ledger: &'a [(&'static str, f64)],
    /// Contacts begun since the start.
    pub collisions: Collisions,
    /// The fluid, if there is one.
    pub fluid: Option<FluidAt<'a>>,
    /// Motion of the cell's frame (zero unless the whole cell is shaken).
    pub frame: Moved,
    /// Motion of the floor in the cell's frame (zero unless the floor moves alone).
    pub floor: Moved,
    /// Acceleration of gravity, m/s².
    pub gravity: Vec3,
    /// Names of the species, by index.
    pub species: &'a [String],
}

/// One touching pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactAt {
    /// Identity of the grain.
    pub i: u32,
    /// What it touches.
    pub with: Partner,
    /// Overlap, m; greater than zero.
    pub overlap: f64,
    /// Force on grain `i`, N.
    pub force: Vec3,
    /// From the centre of `i` to the centre of the other grain (nearest image), or to the contact point on a wall, m.
    pub branch: Vec3,
}

/// The other side of a contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Partner {
    /// Identity of a grain.
    Grain(u32),
    /// Index into [`View::walls`].
    Wall(u32),
}

/// One wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallAt<'a> {
    /// Its name.
    pub name: &'a str,
    /// Force of the grains on it, N.
    pub force: Vec3,
    /// Its displacement from the place of the case, in the cell's frame, m.
    pub displacement: Vec3,
}

/// The fluid as observers see it.
#[derive(Clone, Copy)]
pub struct FluidAt<'a> {
    /// Density, kg/m³.
    pub density: f64,
    /// Dynamic viscosity, Pa s.
    pub viscosity: f64,
    /// The flow; absent where the fluid is at rest by decree (`simple-drag`).
    pub flow: Option<&'a dyn FlowView>,
    /// Force of the fluid on each grain without hydrostatic buoyancy, N, by identity; empty if unknown.
    pub drag: &'a [Vec3],
}

/// A flow on any grid. Points lie in the cell; velocities are those of its frame.
pub trait FlowView {
    /// Fluid velocity, m/s.
    fn velocity(&self, at: Vec3) -> Vec3;
    /// Pressure without the hydrostatic part `density * (gravity - frame acceleration) . r`, Pa, up to a constant.
    fn pressure(&self, at: Vec3) -> f64;
    /// Fluid fraction; 1 where the coupling resolves the grains.
    fn porosity(&self, at: Vec3) -> f64;
    /// True where the grid is finer than a grain and the flow fills the grains too.
    fn is_resolved(&self) -> bool;
    /// Number of grid cells along each axis.
    fn shape(&self) -> [usize; 3];
    /// Centre of a grid cell, m.
    fn centre(&self, cell: [usize; 3]) -> Vec3;
    /// Fluid velocity at the centre of a grid cell, m/s.
    fn cell_velocity(&self, cell: [usize; 3]) -> Vec3 {
        self.velocity(self.centre(cell))
    }
    /// Streamfunction at the corners of the grid cells, m²/s (Clément eq. 2.39), in a cell with a flat direction.
    fn streamfunction(&self) -> Option<PlaneField> {
        None
    }
    /// Vorticity at the corners of the grid cells, 1/s, in a cell with a flat direction.
    fn vorticity(&self) -> Option<PlaneField> {
        None
    }
    /// Energy and volume of the flow, after a step of `dt` (s).
    fn balance(&self, dt: f64) -> FlowBalance;
}

/// Energy and volume of a flow; what is not known is not a number.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FlowBalance {
    /// Kinetic energy, J.
    pub kinetic: f64,
    /// Power lost to viscosity, W.
    pub dissipation: f64,
    /// Power of moving walls, W.
    pub walls: f64,
    /// Power of the uniform acceleration, W.
    pub body: f64,
    /// Largest |div v|, 1/s.
    pub divergence: f64,
    /// Largest Courant number.
    pub courant: f64,
}

/// What must be prepared for an observer beside the grains.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Needs {
    /// The list of touching pairs.
    pub contacts: bool,
    /// The flow of the fluid.
    pub flow: bool,
}

impl Needs {
    /// What either needs.
    #[must_use]
    pub fn or(self, other: Self) -> Self {
        Self { contacts: self.contacts || other.contacts, flow: self.flow || other.flow }
    }
}

impl View<'_> {
    /// Phase of the shake, 0 to 1; 0 is the floor moving up at its fastest.
    #[must_use]
    pub fn phase(&self) -> f64 {
        self.cycle.rem_euclid(1.0)
    }

    /// Height of the floor in the cell's frame, m.
    #[must_use]
    pub fn floor_height(&self) -> f64 {
        self.floor.displacement.z
    }

    /// Path of grain `k` without periodic jumps, m.
    #[must_use]
    pub fn unwrapped(&self, k: usize) -> Vec3 {
        self.grains.unwrapped(k, self.cell.size)
    }
}

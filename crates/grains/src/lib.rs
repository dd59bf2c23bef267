//! Discrete elements: spheres that overlap a little and push each other apart.
//!
//! m dv/dt = sum of contact forces + forces from outside,
//! I dw/dt = sum of contact torques + torques from outside.

pub mod contact;
mod dem;
pub mod field;
pub mod grains;
mod lanes;
pub mod ledger;
pub mod material;
mod motion;
mod neighbors;
mod packed;
pub mod packing;
pub mod spec;
mod state;
pub mod wall;

pub use dem::{ContactView, Dem, Partner};
pub use field::{Field, GrainAt, Gravity, Push};
pub use grains::Grains;
pub use ledger::Ledger;
pub use material::Material;
pub use spec::{ContactSpec, DemSpec, Integrator, Limits, PairSpec, PairTable, Search, SpecError, Sweep};
pub use state::{Collisions, Counts, DemState};
pub use wall::{Arrangement, WallLoad, WallShape, WallSpec};

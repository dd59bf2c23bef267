//! What grains and fluid hand each other.
//!
//! The rungs that see both: `simple-drag` ([`one_way`]), `navier-stokes`
//! ([`averaged`]) and the three [`resolved`] ones. A step asks a
//! [`Coupling`] before, during and after the fluid's step, and then moves the
//! grains in the field that it gives.

pub mod averaged;
pub mod body;
pub mod coupling;
pub mod load;
pub mod measured;
pub mod menu;
pub mod one_way;
pub mod resolved;
pub mod sheet;
pub mod spec;
pub mod state;
pub mod step;
pub mod still;
pub mod transfer;
mod wide;

pub use body::Body;
pub use coupling::Coupling;
pub use load::{Held, Load};
pub use measured::Measured;
pub use one_way::SimpleDrag;
pub use spec::{CouplingSpec, Method, Resolved};
pub use state::CouplingState;
pub use still::Still;

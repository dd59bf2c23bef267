//! Contacts: laws, their menu, and the sweeps that evaluate them.

pub mod law;
pub mod laws;
pub mod menu;
pub mod real;

pub use law::{Normal, NormalForce, PairContext, Rolling, RollingCouple, Tangential, TangentialForce, Touch};
pub use menu::{NormalLaw, RollingLaw, TangentialLaw};
pub use real::{Mask, Real, V3};

//! Contacts: laws, their menu, and the sweeps that evaluate them.

pub mod dispatch;
pub mod law;
pub mod laws;
pub mod menu;
mod pair;
pub mod real;
#[cfg(test)]
mod suite;
pub mod sweep;
pub mod wall_sweep;

pub use dispatch::ContactSweep;
pub use law::{Normal, NormalForce, PairContext, Rolling, RollingCouple, Tangential, TangentialForce, Touch};
pub use menu::{NormalLaw, RollingLaw, TangentialLaw};
pub use pair::{Answer, Law, Pair, energy};
pub use real::{Mask, Real, V3};

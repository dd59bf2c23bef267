//! One file per law.

mod coulomb;
mod linear;
mod none;

pub use coulomb::Coulomb;
pub use linear::Linear;
pub use none::{Frictionless, NoRolling};

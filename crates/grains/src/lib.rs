//! Discrete elements.
pub mod grains;
pub use grains::Grains;

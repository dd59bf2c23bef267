//! The pressure equation.

pub(crate) mod fft;
pub(crate) mod library;
pub mod poisson;
pub(crate) mod rows;
#[cfg(test)]
mod suite;
pub(crate) mod transform;
pub(crate) mod tridiagonal;

pub use poisson::{Poisson, Transforms};

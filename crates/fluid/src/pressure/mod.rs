//! The pressure equation.

pub(crate) mod conjugate_gradient;
pub(crate) mod fft;
pub(crate) mod library;
pub mod poisson;
pub(crate) mod rows;
#[cfg(test)]
mod suite;
pub(crate) mod transform;
pub(crate) mod tridiagonal;

pub use conjugate_gradient::Convergence;
pub use poisson::{Poisson, Transforms};

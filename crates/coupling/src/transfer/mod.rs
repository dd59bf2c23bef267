//! Between points and the staggered grid: interpolation and its exact
//! transpose, spreading.
//!
//! A kernel is a partition of unity: the weights of a point sum to one, so
//! what a point gives is what the grid receives. Each velocity component has
//! its own weights, because it sits on its own faces (Clément 2.4.3). Periodic
//! sides wrap. Weight that would fall on a wall or beyond it goes to the
//! nearest free face: nothing is lost, and no grain feels a wall through the
//! kernel instead of through the fluid.

mod kernel;
mod stagger;
#[cfg(test)]
mod suite;

pub use kernel::{KERNELS, Kernel, KernelName, Roma, Trilinear};
pub use stagger::{Seat, Stagger, Stencil};

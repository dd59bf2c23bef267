//! Incompressible flow on a staggered grid (Clément 2009, 2.2).
//!
//! ```text
//! dv/dt + (v . grad) v = -grad P / rho + nu laplacian v + f     (2.24)
//! div v = 0                                                     (2.28)
//! ```
//!
//! A step predicts a velocity without (all of) the pressure, lets a coupling
//! change it, and projects it on the divergence-free ones by a Poisson
//! equation (2.33-2.35). Knows nothing of grains: a coupling speaks to it
//! through [`Medium`] and [`Predicted`].

pub mod boundary;
pub mod diagnose;
pub mod exact;
pub mod field;
pub mod flow;
pub(crate) mod general;
pub(crate) mod ghosts;
pub mod grid;
mod health;
pub(crate) mod inflow;
pub mod keys;
pub(crate) mod lanes;
pub mod limits;
pub mod medium;
pub(crate) mod momentum;
pub(crate) mod obstacles;
pub(crate) mod parallel;
pub mod pressure;
pub(crate) mod project;
pub(crate) mod shape;
pub mod solid;
pub mod solver;
pub mod spec;
pub(crate) mod step;

pub use boundary::{Boundary, Profile};
pub use field::{CellField, FaceField, Faces};
pub use flow::{Flow, Past};
pub use grid::{Grid, Layout};
pub use limits::step_limits;
pub use medium::{Medium, Mixture, Resistance};
pub use solid::Solid;
pub use solver::{Predicted, Solver};
pub use spec::{Advection, Diffusion, FluidSpec, Instructions, Scheme, SpecError};

//! The bed without grains: bed equations and the analytical models of a shaken bed.
//!
//! Each model has a specification in SI with `validate`, a `solve`, and a
//! result whose `report` gives figures and tables. All are deterministic and
//! single-threaded; a sweep runs many of them side by side.

pub mod bed_equation;
pub mod brazil_nut;
pub mod coupled_columns;
pub mod kinetic_theory;
pub mod ode;
pub mod plug;
pub mod shake;
pub mod system;

pub use system::{Refusals, Report, System};

//! From the text of a case to a checked, assembled simulation.
//!
//! [`source`] parses TOML and lays overrides on it, [`read`] turns it into
//! values by the key lists and collects every error, `check` asks whether the
//! whole makes sense, `build` assembles the parts.

pub mod analytic;
pub mod build;
pub mod case;
pub mod check;
mod clock;
pub mod contact;
mod coupling;
pub mod describe;
pub mod fluid;
pub mod issue;
pub mod keys;
pub mod models;
pub mod parts;
pub mod read;
pub mod resolved;
pub mod schema;
pub mod source;
mod walls;

pub use case::Case;
pub use issue::{Issue, Issues};

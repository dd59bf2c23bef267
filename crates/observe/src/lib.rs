//! Observers and estimators: what is measured in a shaken bed.
//!
//! An observer reads a [`View`] and nothing else, keeps plain accumulators of
//! fixed size (they are part of a checkpoint), and returns rows, tables and
//! figures. Estimators are pure functions in `stats`.

pub mod view;

pub use view::{Collisions, ContactAt, FlowView, FluidAt, Needs, Partner, View, WallAt};

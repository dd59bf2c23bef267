//! Observers and estimators: what is measured in a shaken bed.
//!
//! An observer reads a [`View`] and nothing else, keeps plain accumulators of
//! fixed size (they are part of a checkpoint), and returns rows, tables and
//! figures. [`Watch`] adds when it looks.

pub mod accumulate;
pub mod height;
mod nodes;
pub mod observer;
mod pairs;
pub mod phase;
pub mod series;
pub mod stats;
#[cfg(test)]
mod suite;
#[cfg(test)]
mod synthetic;
pub mod view;
pub mod watch;
pub mod zones;

pub use observer::menu::{MENU, Observer, keys};
pub use observer::{Observe, Sampling, Setting};
pub use view::{ContactAt, FlowBalance, FlowView, FluidAt, Needs, Partner, View, WallAt};
pub use watch::{COMMON, Watch};

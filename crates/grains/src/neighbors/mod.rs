//! Who may touch whom: an outer list with a wide skin, pruned to an inner one with a small skin.
//!
//! Both lists hold every pair that can touch before they are made anew: the
//! displacement since is bounded by the sum over steps of the spread of all
//! grains' displacements, axis by axis, so no speed can outrun it.

pub mod all;
pub mod grid;
pub mod handover;
pub mod inner;
pub mod order;
pub mod outer;
pub mod room;
pub mod walls;

use serde::{Deserialize, Serialize};

/// Skins of the lists, m.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Skins {
    /// Of the outer list where grains are slow.
    pub slow: f64,
    /// Of the outer list.
    pub outer: f64,
    /// Of the inner list.
    pub inner: f64,
}

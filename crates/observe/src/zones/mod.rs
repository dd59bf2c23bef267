//! Parts of the cell over which grains are averaged, each grain weighted by
//! the exact fraction of it inside (Lan 3.1, Fig. 3.1).

pub mod ball;
pub mod grid;

pub use grid::{Body, Direction, Grid};

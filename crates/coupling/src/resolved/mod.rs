//! A fluid resolved around every grain (Clément 2009, 2.5): the grid is finer than the grains.

pub mod forcing;
pub mod leak;
pub mod lubrication;
pub mod menu;
mod reach;
pub mod schedule;
pub mod springs;
pub mod sweep;
pub mod template;
pub mod tracers;
pub mod work;

pub use forcing::{Enclosed, Forcing};
pub use leak::Leak;
pub use springs::{Inertia, SpringBody, Springs, Strength};
pub use tracers::{LAYOUTS, Layout, Template, Templates};
pub use work::TracerWork;

/// Default depth of the outermost shell below the surface, in grid spacings: with it the drag of a dilute
/// array of spheres (solid fraction 0.064) is that of Zick & Homsy 1982 at viscous numbers nu dt/h² near 0.02.
pub const RETRACTION: f64 = 0.4;

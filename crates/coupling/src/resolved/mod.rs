//! A fluid resolved around every grain (Clément 2009, 2.5): the grid is finer than the grains.

pub mod forcing;
pub mod leak;
pub mod lubrication;
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

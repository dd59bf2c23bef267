//! Pictures of a bed, plots, and the report that holds them in one file.
//!
//! Everything is drawn here, without a display, a font file or a network.

pub mod colour;
pub mod html;
pub mod picture;
pub mod plot;
pub mod png;
pub mod sheet;
pub mod text;

pub use html::{Content, Image, Report};
pub use plot::{ColourScale, svg};
pub use sheet::Sheet;

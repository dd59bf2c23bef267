//! Figures as SVG: curves with errors, maps with arrows.
//!
//! Drawn by hand, not by a plotting library: maps here carry arrows with a key
//! and outlines on physical axes, and colours follow a dark page.

mod axis;
mod curves;
mod legend;
mod map;
mod paper;

use brazilnut_base::figure::{Body, Figure};

/// Width of a plot, px.
pub const WIDTH: f64 = 620.0;
/// Height of a plot of curves, px.
pub const HEIGHT: f64 = 390.0;

/// The figure as a self-contained SVG; the caption is left to the page around it.
#[must_use]
pub fn svg(figure: &Figure) -> String {
    match &figure.body {
        Body::Curves { x, y, curves } => curves::draw(&figure.title, x, y, curves),
        Body::Map { .. } => map::draw(figure),
    }
}

/// What the shades of a picture mean.
#[derive(Clone, Debug, PartialEq)]
pub struct ColourScale {
    /// What is shown.
    pub label: String,
    /// Its unit.
    pub unit: String,
    /// Value of the darkest shade.
    pub low: f64,
    /// Value of the lightest shade.
    pub high: f64,
}

/// The sequential colour scale as a bar to stand under a picture.
#[must_use]
pub fn scale_bar(scale: &ColourScale) -> String {
    map::scale_bar(scale)
}

#[cfg(test)]
mod tests;

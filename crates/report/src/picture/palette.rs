//! Colours of grains.

use crate::colour::{self, Rgb};

/// Warm and light: the first tone of layers.
pub const AMBER: Rgb = [0.91, 0.64, 0.24];
/// Cool and dark: the second tone of layers.
pub const TEAL: Rgb = [0.13, 0.43, 0.58];
/// Grey metal: an intruder.
pub const STEEL: Rgb = [0.62, 0.65, 0.70];

/// Colour by starting layer in two alternating tones: `height` (m) above the floor at the start,
/// layers `thickness` (m) thick (as in Clément 2009, Fig. 4.1).
#[must_use]
pub fn by_layer(height: f64, thickness: f64) -> Rgb {
    if (height / thickness).floor().rem_euclid(2.0) == 0.0 { TEAL } else { AMBER }
}

/// Colour by value on the sequential scale between `low` and `high`.
#[must_use]
pub fn by_value(value: f64, low: f64, high: f64) -> Rgb {
    colour::sequential(if high > low { (value - low) / (high - low) } else { 0.5 })
}

/// Colour of species number `k`.
#[must_use]
pub fn species(k: usize) -> Rgb {
    const TONES: [Rgb; 6] = [AMBER, TEAL, [0.74, 0.27, 0.22], STEEL, [0.35, 0.60, 0.38], [0.55, 0.38, 0.60]];
    TONES[k % TONES.len()]
}

//! Parts of a case as the physics crates want them.

use brazilnut_base::motion::{Harmonic, Motion};
use brazilnut_base::values::Values;
use brazilnut_base::{Cell, Side, Vec3};
use std::f64::consts::TAU;

/// Names of the six sides in the order x low, x high, y low, y high, z low, z high.
pub const SIDES: [&str; 6] = ["left", "right", "front", "back", "floor", "lid"];

/// The cell.
#[must_use]
pub fn cell(v: &Values) -> Option<Cell> {
    let c = v.table_opt("cell")?;
    let side = |name| match c.text(name) {
        "periodic" => Side::Periodic,
        "flat" => Side::Flat,
        _ => Side::Walls,
    };
    Some(Cell { size: c.vector_opt("size")?, sides: [side("x"), side("y"), side("z")] })
}

/// Gravity as a vector, m/s².
#[must_use]
pub fn gravity(v: &Values) -> Vec3 {
    Vec3::NEG_Z * v.number("gravity")
}

/// The motion of the shaker; at rest without a table `shaking`.
#[must_use]
pub fn shaking(v: &Values) -> Motion {
    let Some(s) = v.table_opt("shaking") else { return Motion::default() };
    let frequency = s.number("frequency");
    let w = TAU * frequency;
    let amplitude = s
        .number_opt("displacement_amplitude")
        .or_else(|| s.number_opt("peak_velocity").map(|u| u / w))
        .or_else(|| s.number_opt("gamma").map(|g| g * v.number("gravity") / (w * w)))
        .unwrap_or(0.0);
    let direction = s.vector_opt("direction").unwrap_or(Vec3::Z);
    let phase = s.vector_opt("phase").unwrap_or(Vec3::ZERO);
    let mut harmonics = vec![Harmonic { amplitude: direction * amplitude, frequency, phase }];
    for h in s.tables("harmonics") {
        harmonics.push(Harmonic {
            amplitude: direction * (amplitude * h.number("ratio")),
            frequency: frequency * h.integer("order") as f64,
            phase: phase + Vec3::splat(h.number("phase")),
        });
    }
    Motion { harmonics, ramp: s.number("ramp") }
}

/// Displacement amplitude (m) and frequency (Hz) of the fundamental, if anything shakes.
#[must_use]
pub fn fundamental(v: &Values) -> Option<(f64, f64)> {
    let _ = v.table_opt("shaking")?;
    let m = shaking(v);
    let h = m.harmonics.first()?;
    Some((h.amplitude.length(), h.frequency))
}

/// Material of each side, in the order of [`SIDES`].
#[must_use]
pub fn side_materials(v: &Values) -> [String; 6] {
    let walls = v.table_opt("walls");
    SIDES.map(|side| {
        let of_side = walls.and_then(|w| w.table_opt(side)).and_then(|t| t.text_opt("material"));
        let of_all = walls.and_then(|w| w.text_opt("material"));
        of_side.or(of_all).unwrap_or("wall").to_string()
    })
}

/// Names of all materials that walls and obstacles are made of, without repetition.
#[must_use]
pub fn wall_materials(v: &Values) -> Vec<String> {
    let mut names: Vec<String> = side_materials(v).into();
    names.extend(v.tables("obstacles").filter_map(|o| o.text_opt("material")).map(str::to_string));
    names.sort();
    names.dedup();
    names
}

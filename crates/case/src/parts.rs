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
    v.table_opt("shaking").map_or_else(Motion::default, |s| motion(s, v.number("gravity")))
}

/// Whether the shaker moves the floor alone.
#[must_use]
pub fn shakes_the_floor(v: &Values) -> bool {
    v.table_opt("shaking").is_some_and(|s| s.text_opt("of") == Some("floor"))
}

/// The motion that a table describes; `gravity` in m/s².
#[must_use]
pub fn motion(s: &Values, gravity: f64) -> Motion {
    let frequency = s.number("frequency");
    let w = TAU * frequency;
    let amplitude = s
        .number_opt("displacement_amplitude")
        .or_else(|| s.number_opt("peak_velocity").map(|u| u / w))
        .or_else(|| s.number_opt("gamma").map(|g| g * gravity / (w * w)))
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

/// The tables that say how single walls and obstacles move, with the keys that lead to them.
pub(crate) fn own_motions(v: &Values) -> Vec<(String, &Values)> {
    let side = |s: &&'static str| {
        let table = v.table_opt("walls")?.table_opt(s)?.table_opt("motion")?;
        Some((format!("walls.{s}.motion"), table))
    };
    let mut all: Vec<_> = SIDES.iter().filter_map(side).collect();
    for (k, o) in v.tables("obstacles").enumerate() {
        all.extend(o.table_opt("motion").map(|t| (format!("obstacles[{k}].motion"), t)));
    }
    all
}

/// Largest speed that the shaker or a single wall can reach, m/s.
#[must_use]
pub fn peak_speed(v: &Values) -> f64 {
    let own = own_motions(v).into_iter().map(|(_, m)| motion(m, v.number("gravity")).peak_speed());
    own.fold(0.0, f64::max) + shaking(v).peak_speed()
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

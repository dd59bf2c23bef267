//! What a case may say about the fluid's numerics and sides.

use crate::boundary::{BOUNDARIES, Boundary, Profile};
use crate::grid::Grid;
use crate::spec::{ADVECTIONS, Advection, DIFFUSIONS, Diffusion, FluidSpec, Instructions, SCHEMES, Scheme};
use brazilnut_base::keys::{Check, Key, Kind};
use brazilnut_base::menu::Entry;
use brazilnut_base::motion::{Harmonic, Motion};
use brazilnut_base::units::Dimension;
use brazilnut_base::values::Values;
use brazilnut_base::{Cell, Side, Vec3};

/// Keys of the numerics, in the table `[fluid]`.
pub const KEYS: &[Key] = &[
    Key::optional(
        "spacing",
        Kind::Quantity(Dimension::LENGTH),
        "Edge of a grid cell; the cell of the case is filled with the nearest whole number of them. Without it the rung chooses.",
    )
    .with(Check::Positive),
    Key::optional(
        "cells",
        Kind::List(&Kind::Integer),
        "Number of grid cells along x, y, z instead of a spacing; products of 2, 3, 5 and 7 are fastest.",
    )
    .with(Check::Positive),
    Key::default("scheme", Kind::Choice(SCHEMES), "\"second-order\"", "Time stepping."),
    Key::default("advection", Kind::Choice(ADVECTIONS), "\"central\"", "Advection."),
    Key::default("diffusion", Kind::Choice(DIFFUSIONS), "\"explicit\"", "Viscous diffusion."),
    Key::default(
        "courant_limit",
        Kind::Quantity(Dimension::NONE),
        "1.0",
        "The run stops where the fluid crosses more than this part of a cell in a step.",
    )
    .with(Check::Positive),
    Key::default(
        "steps",
        Kind::Word(&["fixed", "adaptive"]),
        "\"fixed\"",
        "Adaptive: each step of the case is cut into as many equal parts as the flow at hand needs; for a fluid alone.",
    ),
    Key::default(
        "instructions",
        Kind::Word(&["best", "portable"]),
        "\"best\"",
        "Vector instructions: the widest this processor has, or plain code that runs everywhere; results differ by rounding.",
    ),
];

/// Shapes of an inflow.
pub const PROFILES: &[Entry] = &[
    Entry { name: "uniform", summary: "The same speed everywhere.", formula: "v = V", source: "" },
    Entry {
        name: "parabolic",
        summary: "Laminar flow between the walls across, of the given mean speed.",
        formula: "v = 6 V s (1 - s) per walled direction",
        source: "",
    },
];

/// Keys of one side's table; a bare name stands for `kind`.
pub const SIDE_KEYS: &[Key] = &[
    Key::required("kind", Kind::Choice(BOUNDARIES), "What the fluid meets there."),
    Key::optional(
        "velocity",
        Kind::Vector(Dimension::VELOCITY),
        "Steady velocity of a moving lid; its part normal to the wall is ignored.",
    ),
    Key::optional(
        "amplitude",
        Kind::Vector(Dimension::LENGTH),
        "Displacement amplitude of an oscillating lid.",
    ),
    Key::optional("frequency", Kind::Quantity(Dimension::FREQUENCY), "Its frequency.").with(Check::Positive),
    Key::optional("speed", Kind::Quantity(Dimension::VELOCITY), "Mean speed of an inflow, into the box."),
    Key::default("profile", Kind::Choice(PROFILES), "\"uniform\"", "Its shape."),
    Key::default(
        "pressure",
        Kind::Quantity(Dimension::PRESSURE),
        "0.0",
        "Pressure held at an outflow, without the hydrostatic part.",
    ),
];

/// Reads checked numerics into `spec`.
pub fn read_numerics(values: &Values, spec: &mut FluidSpec) {
    spec.scheme =
        if values.text("scheme") == "first-order" { Scheme::FirstOrder } else { Scheme::SecondOrder };
    spec.advection = match values.text("advection") {
        "koren" => Advection::Koren,
        "none" => Advection::None,
        _ => Advection::Central,
    };
    spec.diffusion =
        if values.text("diffusion") == "implicit" { Diffusion::Implicit } else { Diffusion::Explicit };
    spec.courant_limit = values.number("courant_limit");
    spec.adaptive = values.text_opt("steps") == Some("adaptive");
    let portable = values.text_opt("instructions") == Some("portable");
    spec.instructions = if portable { Instructions::Portable } else { Instructions::Best };
}

/// The grid that checked numerics ask for in `cell`, or one of the rung's `spacing` (m).
#[must_use]
pub fn read_grid(values: &Values, cell: &Cell, spacing: f64) -> Grid {
    let counts: Vec<usize> = values
        .list("cells")
        .iter()
        .filter_map(|v| match v {
            brazilnut_base::values::Value::Integer(n) => usize::try_from(*n).ok(),
            _ => None,
        })
        .collect();
    let Ok(counts) = <[usize; 3]>::try_from(counts) else {
        return Grid::fill(cell, values.number_opt("spacing").unwrap_or(spacing));
    };
    let cells = [0, 1, 2].map(|a| if cell.sides[a] == Side::Flat { 1 } else { counts[a].max(1) });
    Grid::new(cells, [0, 1, 2].map(|a| cell.size[a] / cells[a] as f64), cell.sides)
}

/// One side from its checked table.
///
/// # Errors
/// Which key the kind of side needs and lacks.
pub fn read_side(values: &Values) -> Result<Boundary, String> {
    Ok(match values.text("kind") {
        "free-slip" => Boundary::FreeSlip,
        "moving-lid" => {
            let velocity = values.vector_opt("velocity");
            let amplitude = values.vector_opt("amplitude");
            if velocity.is_none() && amplitude.is_none() {
                return Err("a moving lid needs `velocity`, or `amplitude` and `frequency`".into());
            }
            let mut motion = Motion::default();
            if let Some(amplitude) = amplitude {
                let frequency =
                    values.number_opt("frequency").ok_or("an oscillating lid needs `frequency`")?;
                motion.harmonics.push(Harmonic { amplitude, frequency, phase: Vec3::ZERO });
            }
            Boundary::MovingLid { velocity: velocity.unwrap_or(Vec3::ZERO), motion }
        }
        "inflow" => {
            let speed = values.number_opt("speed").ok_or("an inflow needs `speed`")?;
            let parabolic = values.text("profile") == "parabolic";
            Boundary::Inflow {
                profile: if parabolic { Profile::Parabolic(speed) } else { Profile::Uniform(speed) },
            }
        }
        "outflow" => Boundary::Outflow { pressure: values.number("pressure") },
        _ => Boundary::NoSlip,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use brazilnut_base::values::Value;
    use brazilnut_base::vec3;

    fn table(entries: &[(&str, Value)]) -> Values {
        let mut values = Values::default();
        for (key, value) in entries {
            values.insert(key, value.clone(), None);
        }
        values
    }

    fn text(t: &str) -> Value {
        Value::Text(t.into())
    }

    #[test]
    fn every_side_on_the_menu_can_be_read() {
        for entry in BOUNDARIES {
            let full = table(&[
                ("kind", text(entry.name)),
                ("velocity", Value::Vector(vec3(1.0, 0.0, 0.0))),
                ("speed", Value::Number(2.0)),
                ("profile", text("parabolic")),
                ("pressure", Value::Number(3.0)),
            ]);
            let side = read_side(&full).unwrap();
            assert_eq!(side == Boundary::NoSlip, entry.name == "no-slip", "{}", entry.name);
        }
        assert!(read_side(&table(&[("kind", text("inflow"))])).unwrap_err().contains("speed"));
    }

    #[test]
    fn numerics_and_grid() {
        let values = table(&[
            ("scheme", text("first-order")),
            ("advection", text("koren")),
            ("diffusion", text("implicit")),
            ("courant_limit", Value::Number(0.5)),
            ("instructions", text("portable")),
            ("cells", Value::List(vec![Value::Integer(10), Value::Integer(7), Value::Integer(20)])),
        ]);
        let cell = Cell { size: vec3(1.0, 0.3, 2.0), sides: [Side::Walls, Side::Flat, Side::Walls] };
        let grid = read_grid(&values, &cell, 0.2);
        assert_eq!((grid.cells, grid.spacing), ([10, 1, 20], [0.1, 0.3, 0.1]));
        let mut spec = FluidSpec::new(grid, 1.0, 1.0);
        read_numerics(&values, &mut spec);
        assert_eq!((spec.scheme, spec.advection), (Scheme::FirstOrder, Advection::Koren));
        assert_eq!((spec.diffusion, spec.courant_limit), (Diffusion::Implicit, 0.5));
        assert_eq!(spec.instructions, Instructions::Portable);
        assert_eq!(read_grid(&table(&[]), &cell, 0.2).cells, [5, 1, 10]);
    }
}

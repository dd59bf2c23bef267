//! What a case may say in `[navier-stokes]`.

use super::{Averaged, Formulation};
use crate::body::Body;
use crate::transfer::{KERNELS, KernelName};
use brazilnut_base::keys::{Check, Key, Kind};
use brazilnut_base::menu::Entry;
use brazilnut_base::units::Dimension;
use brazilnut_base::values::Values;
use brazilnut_bed::bed_equation::{self, BedEquation};

/// What `formulation` may name.
pub const FORMULATIONS: &[Entry] = &[
    Entry {
        name: "a",
        summary: "Grains and fluid share the pressure gradient; equal and opposite.",
        formula: "F = V_p [-grad P + phi (-dP)_bed/(1 - phi)]",
        source: "Clément 2009, 2.4.5 made to conserve momentum; model A of Gidaspow 1994",
    },
    Entry {
        name: "printed",
        summary: "The drag of a steady flow, which holds the grains' share of the gradient; not equal and opposite.",
        formula: "F = V_p (-dP)_bed/(1 - phi)",
        source: "Clément eq. 2.76",
    },
];

/// Keys of `[navier-stokes]`.
pub const KEYS: &[Key] = &[
    Key::default(
        "bed_equation",
        Kind::Choice(bed_equation::menu::MENU),
        "\"ergun\"",
        "Pressure gradient of the bed.",
    ),
    Key::default("kernel", Kind::Choice(KERNELS), "\"trilinear\"", "How grains are mapped to the grid."),
    // The densest regular packing of equal spheres; a mapped value below it is noise of the kernel.
    Key::default(
        "porosity_floor",
        Kind::Quantity(Dimension::NONE),
        "0.26",
        "Least porosity that the bed equation and the balance of volume see.",
    )
    .with(Check::Inside(0.0, 1.0)),
    Key::default("formulation", Kind::Choice(FORMULATIONS), "\"a\"", "The force on a grain."),
];

impl Averaged {
    /// The rung from a table with [`KEYS`], for grains of mean `diameter` (m) per species.
    #[must_use]
    pub fn read(values: &Values, density: f64, viscosity: f64, diameter: Vec<f64>, body: Body) -> Self {
        Self {
            equation: BedEquation::from_name(values.text("bed_equation")).unwrap_or(BedEquation::Ergun),
            kernel: KernelName::from_name(values.text("kernel")).unwrap_or_default(),
            porosity_floor: values.number("porosity_floor"),
            formulation: match values.text("formulation") {
                "printed" => Formulation::Printed,
                _ => Formulation::A,
            },
            density,
            viscosity,
            diameter,
            body,
        }
    }
}

//! What grains are made of, and what follows for a contact: stiffness, damping and duration.
//!
//! Pure functions. For a wall the other body is infinitely heavy and flat:
//! pass `f64::INFINITY` as its mass and radius.

pub mod collision;
mod elastic;
mod latching;
mod linear;
mod stability;

pub use collision::{Collision, collide, viscous_damping, viscous_damping_number};
pub use elastic::{
    effective_modulus, effective_shear_modulus, energy_equivalent_stiffness, hertz_contact_time,
    hertz_overlap, hertz_stiffness, hertz_stiffness_for_overlap, mindlin_ratio, rayleigh_time,
};
pub use latching::{latching_contact_time, latching_step, latching_unloading_stiffness};
pub use linear::{
    damping_ratio, linear_contact_time, linear_damping, linear_overlap, linear_restitution,
    linear_stiffness_for_contact_time, stiffness_for_overlap,
};
pub use stability::{Across, RELAXED_PER_STEP, largest_stable_step, packed_step, stability_share};

use brazilnut_base::keys::{Check, Key, Kind};
use brazilnut_base::units::Dimension;
use brazilnut_base::values::Values;
use serde::{Deserialize, Serialize};

/// Largest overlap over diameter for which a soft contact still behaves as a hard one (Lan 4.1.3).
pub const OVERLAP_LIMIT: f64 = 0.01;

/// A solid that grains or walls are made of.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Material {
    /// Name in the case.
    pub name: String,
    /// Density, kg/m³.
    pub density: f64,
    /// Elastic constants; laws that take their stiffness from the material need them.
    pub elastic: Option<Elastic>,
}

/// Elastic constants of an isotropic solid.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Elastic {
    /// Young's modulus, Pa.
    pub youngs_modulus: f64,
    /// Poisson's ratio.
    pub poisson_ratio: f64,
}

impl Elastic {
    /// Shear modulus E/(2(1 + nu)), Pa.
    #[must_use]
    pub fn shear_modulus(&self) -> f64 {
        self.youngs_modulus / (2.0 * (1.0 + self.poisson_ratio))
    }
}

/// Keys of `[materials.NAME]`.
pub const MATERIAL_KEYS: &[Key] = &[
    Key::required("density", Kind::Quantity(Dimension::DENSITY), "Density of the solid.")
        .with(Check::Positive),
    Key::optional(
        "youngs_modulus",
        Kind::Quantity(Dimension::PRESSURE),
        "Young's modulus; needed by the Hertzian laws.",
    )
    .with(Check::Positive),
    // An incompressible solid (0.5) is as far as an isotropic one goes.
    Key::default("poisson_ratio", Kind::Quantity(Dimension::NONE), "0.25", "Poisson's ratio.")
        .with(Check::Between(0.0, 0.5)),
];

impl Material {
    /// The material `name` from a table with [`MATERIAL_KEYS`].
    #[must_use]
    pub fn read(name: &str, values: &Values) -> Self {
        let elastic = values
            .number_opt("youngs_modulus")
            .map(|e| Elastic { youngs_modulus: e, poisson_ratio: values.number("poisson_ratio") });
        Self { name: name.to_string(), density: values.number("density"), elastic }
    }
}

/// Mass that a contact accelerates: m1 m2/(m1 + m2), kg (Clément 2.21).
#[must_use]
pub fn effective_mass(m1: f64, m2: f64) -> f64 {
    harmonic(m1, m2)
}

/// Radius of the equivalent sphere on a plane: r1 r2/(r1 + r2), m (Clément 2.6).
#[must_use]
pub fn effective_radius(r1: f64, r2: f64) -> f64 {
    harmonic(r1, r2)
}

/// 1/(1/a + 1/b), finite also if one of the two is infinite.
fn harmonic(a: f64, b: f64) -> f64 {
    1.0 / (1.0 / a + 1.0 / b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wall_is_infinitely_heavy_and_flat() {
        assert_eq!(effective_mass(2.0, 2.0), 1.0);
        assert_eq!(effective_mass(2.0, f64::INFINITY), 2.0);
        assert_eq!(effective_radius(f64::INFINITY, 0.5), 0.5);
    }
}

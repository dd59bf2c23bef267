//! The laws that a case may name.

use brazilnut_base::menu::Entry;
use serde::{Deserialize, Serialize};

/// Normal laws.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum NormalLaw {
    /// [`super::laws::Linear`]
    Linear,
}

/// Tangential laws.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum TangentialLaw {
    /// [`super::laws::Frictionless`]
    None,
    /// [`super::laws::Coulomb`]
    Coulomb,
}

/// Rolling laws.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum RollingLaw {
    /// [`super::laws::NoRolling`]
    None,
}

/// Normal laws in the order of [`NormalLaw::ALL`].
pub const NORMAL: &[Entry] = &[Entry {
    name: "linear",
    summary: "Linear spring and dashpot; restitution independent of speed.",
    formula: "F = k delta + 2 zeta sqrt(k m) d(delta)/dt",
    source: "Clément eq. 2.1, 2.2, 2.23",
}];

/// Tangential laws in the order of [`TangentialLaw::ALL`].
pub const TANGENTIAL: &[Entry] = &[
    Entry { name: "none", summary: "Perfectly smooth.", formula: "", source: "" },
    Entry {
        name: "coulomb",
        summary: "Sliding friction without memory, viscous below the sliding limit.",
        formula: "F = -min(mu F_n, gamma_t |v|) v/|v|",
        source: "Clément eq. 2.3, corrected",
    },
];

/// Rolling laws in the order of [`RollingLaw::ALL`].
pub const ROLLING: &[Entry] =
    &[Entry { name: "none", summary: "Grains roll freely.", formula: "", source: "" }];

impl NormalLaw {
    /// All of them.
    pub const ALL: &[Self] = &[Self::Linear];
}

impl TangentialLaw {
    /// All of them.
    pub const ALL: &[Self] = &[Self::None, Self::Coulomb];
}

impl RollingLaw {
    /// All of them.
    pub const ALL: &[Self] = &[Self::None];
}

macro_rules! named {
    ($law:ty, $menu:expr) => {
        impl $law {
            /// The law of that name.
            #[must_use]
            pub fn named(name: &str) -> Option<Self> {
                $menu.iter().position(|e| e.name == name).map(|k| Self::ALL[k])
            }

            /// Its name in a case.
            #[must_use]
            pub fn name(self) -> &'static str {
                let k = Self::ALL.iter().position(|&l| l == self);
                k.map_or("", |k| $menu[k].name)
            }
        }
    };
}
named!(NormalLaw, NORMAL);
named!(TangentialLaw, TANGENTIAL);
named!(RollingLaw, ROLLING);

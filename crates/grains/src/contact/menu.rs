//! The laws that a case may name.

use brazilnut_base::menu::Entry;
use serde::{Deserialize, Serialize};

/// Normal laws.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum NormalLaw {
    /// [`super::laws::Linear`]
    Linear,
    /// [`super::laws::Hertz`]
    Hertz,
    /// [`super::laws::DampedHertz`]
    DampedHertz,
    /// [`super::laws::WaltonBraun`]
    WaltonBraun,
}

/// Tangential laws.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum TangentialLaw {
    /// [`super::laws::Frictionless`]
    None,
    /// [`super::laws::Coulomb`]
    Coulomb,
    /// [`super::laws::LinearSpring`]
    LinearSpring,
    /// [`super::laws::Mindlin`]
    Mindlin,
    /// [`super::laws::WaltonBraunFriction`]
    WaltonBraun,
}

/// Rolling laws.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum RollingLaw {
    /// [`super::laws::NoRolling`]
    None,
    /// [`super::laws::ConstantTorque`]
    ConstantTorque,
    /// [`super::laws::RollingSpring`]
    Spring,
}

/// Normal laws in the order of [`NormalLaw::ALL`].
pub const NORMAL: &[Entry] = &[
    Entry {
        name: "linear",
        summary: "Linear spring and dashpot; restitution independent of speed.",
        formula: "F = k delta + 2 zeta sqrt(k m) d(delta)/dt",
        source: "Clément eq. 2.1, 2.2, 2.23",
    },
    Entry {
        name: "hertz",
        summary: "Hertzian spring, elastic at restitution 1, else with a dashpot; restitution independent of speed.",
        formula: "F = k delta^(3/2) + sqrt(5) zeta sqrt(m k) delta^(1/4) d(delta)/dt, k = (4/3) E* sqrt(r)",
        source: "Clément eq. 2.4 (corrected) to 2.7; Tsuji et al. 1992; Antypov and Elliott 2011",
    },
    Entry {
        name: "damped-hertz",
        summary: "Hertzian spring and viscous dashpot of Kuwabara and Kono; restitution holds at one impact speed and falls with it.",
        formula: "F = k delta^(3/2) + c delta^(1/2) d(delta)/dt, c = beta(e) m^(2/5) k^(3/5) v^(-1/5)",
        source: "Clément eq. 2.4 (corrected), 2.8",
    },
    Entry {
        name: "walton-braun",
        summary: "Partially latching spring that unloads more steeply; restitution independent of speed.",
        formula: "F = min(K1 delta, K2 (delta - delta_0)), e = sqrt(K1/K2)",
        source: "Lan 2.4.1",
    },
];

/// Tangential laws in the order of [`TangentialLaw::ALL`].
pub const TANGENTIAL: &[Entry] = &[
    Entry { name: "none", summary: "Perfectly smooth.", formula: "", source: "" },
    Entry {
        name: "coulomb",
        summary: "Sliding friction without memory, viscous below the sliding limit.",
        formula: "F = -min(mu F_n, gamma_t |v|) v/|v|",
        source: "Clément eq. 2.3, corrected",
    },
    Entry {
        name: "linear-spring",
        summary: "Linear tangential spring and dashpot with memory, sliding at Coulomb's limit.",
        formula: "F = -k_t xi - gamma_t v, |F| <= mu F_n",
        source: "Cundall and Strack 1979",
    },
    Entry {
        name: "mindlin",
        summary: "Tangential spring of elastic spheres with memory, sliding at Coulomb's limit.",
        formula: "dF = -k_t dxi, k_t = 8 G* sqrt(r delta), |F| <= mu F_n; F falls with k_t on unloading",
        source: "Mindlin 1949; Thornton, Cummins and Cleary 2013",
    },
    Entry {
        name: "walton-braun",
        summary: "Incremental friction that softens towards the sliding limit, with a turning point.",
        formula: "K_t = K0 [1 - (T - T*)/(mu N - T*)]^(1/3) loading, K0 [1 - (T* - T)/(mu N + T*)]^(1/3) unloading",
        source: "Lan 2-4-13 to 2-4-21, corrected; Walton and Braun 1986",
    },
];

/// Rolling laws in the order of [`RollingLaw::ALL`].
pub const ROLLING: &[Entry] = &[
    Entry { name: "none", summary: "Grains roll freely.", formula: "", source: "" },
    Entry {
        name: "constant-torque",
        summary: "A couple of constant size against rolling.",
        formula: "M = -mu_r r F_n w/|w|",
        source: "Zhou et al. 1999, model A",
    },
    Entry {
        name: "spring",
        summary: "An elastic-plastic spring against rolling, which also holds at rest.",
        formula: "M = -k_r theta - c w, |M| <= mu_r r F_n, k_r = (9/4) mu_r^2 r^2 F_n/delta",
        source: "Ai et al. 2011, model C",
    },
];

impl NormalLaw {
    /// All of them.
    pub const ALL: &[Self] = &[Self::Linear, Self::Hertz, Self::DampedHertz, Self::WaltonBraun];
}

impl TangentialLaw {
    /// All of them.
    pub const ALL: &[Self] =
        &[Self::None, Self::Coulomb, Self::LinearSpring, Self::Mindlin, Self::WaltonBraun];
}

impl RollingLaw {
    /// All of them.
    pub const ALL: &[Self] = &[Self::None, Self::ConstantTorque, Self::Spring];
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

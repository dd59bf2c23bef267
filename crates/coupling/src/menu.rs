//! The rungs of the ladder that this crate holds, and their tables in a case.

use crate::{averaged, one_way, resolved};
use brazilnut_base::keys::Key;
use brazilnut_base::menu::Entry;

/// The rungs, from the shallowest to the deepest.
pub const MENU: &[Entry] = &[
    Entry {
        name: "dry",
        summary: "Grains without a fluid.",
        formula: "m du/dt = F_contacts + m g - m a",
        source: "Clément 2009, 2.1, 3.1",
    },
    Entry {
        name: "simple-drag",
        summary: "Grains in a fluid at rest: drag of a bed equation and buoyancy.",
        formula: "F = V_p (-dP)_bed/(1 - phi) - rho V_p (g - a)",
        source: "Clément eq. 2.54, 2.57, 3.3",
    },
    Entry {
        name: "navier-stokes",
        summary: "Grains in a fluid on a grid coarser than they are, both ways, by a bed equation.",
        formula: "F = V_p [-grad P + phi (-dP)_bed/(1 - phi)], div(phi v + (1 - phi) u) = 0",
        source: "Clément eq. 2.62, 2.63; 2.76 made equal and opposite",
    },
    Entry {
        name: "particle-template",
        summary: "A fluid resolved around every grain; covered points get the grain's velocity.",
        formula: "F = integral over V of -grad P + eta laplacian v",
        source: "Clément eq. 2.77-2.83",
    },
    Entry {
        name: "fluid-springs",
        summary: "A fluid resolved around every grain, tied to it by tracer springs.",
        formula: "M_t du/dt = F_contacts + (rho_g - rho) V g' + sum (k dt + 2 gamma)(v_f - v_t)",
        source: "Clément eq. 2.84-2.100; Hoefler & Schwarzer 2000",
    },
    Entry {
        name: "direct-forcing",
        summary: "A fluid resolved around every grain; the slip at tracers is removed several times.",
        formula: "M du/dt = F_contacts + (rho_g - rho) V g' - F_forcing + d/dt integral over V of rho v",
        source: "Uhlmann 2005; Breugem 2012; Kempe & Froehlich 2012",
    },
];

/// Keys of the table `[name]` of a rung.
#[must_use]
pub fn keys(name: &str) -> &'static [Key] {
    match name {
        "simple-drag" => one_way::KEYS,
        "navier-stokes" => averaged::KEYS,
        "particle-template" => resolved::menu::TEMPLATE_KEYS,
        "fluid-springs" => resolved::menu::SPRINGS_KEYS,
        "direct-forcing" => resolved::menu::FORCING_KEYS,
        _ => &[],
    }
}

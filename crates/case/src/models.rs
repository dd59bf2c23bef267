//! The ladder: what `model` may name.

use brazilnut_base::menu::Entry;

const fn rung(name: &'static str, summary: &'static str, source: &'static str) -> Entry {
    Entry { name, summary, formula: "", source }
}

/// The rungs, from the shallowest to the deepest.
pub const MENU: &[Entry] = &[
    rung(
        "kroll",
        "One porous plug in a massless fluid: an ordinary differential equation.",
        "Clément 2009, section 2.3",
    ),
    rung(
        "modified-kroll",
        "One porous plug in a dense, incompressible fluid.",
        "Clément 2009, section 2.3.1",
    ),
    rung("coupled-columns", "Two plugs joined by a channel.", "Clément 2009, section 5.7"),
    rung("brazil-nut-column", "A plug and an intruder.", "Clément 2009, section 6.5"),
    rung(
        "kinetic-theory",
        "Temperature and solids-fraction profiles over a vibrating floor.",
        "Lan 1994, section 4.1",
    ),
    rung("fluid", "A fluid alone on a staggered grid.", "Clément 2009, section 2.2"),
    rung("dry", "Grains without a fluid.", "Clément 2009, section 2.1; Lan 1994"),
    rung(
        "simple-drag",
        "Grains in a fluid at rest: drag of a bed equation and buoyancy.",
        "Clément 2009, section 2.4.1",
    ),
    rung(
        "navier-stokes",
        "Grains in a fluid on a grid coarser than they are, both ways.",
        "Clément 2009, section 2.4.2",
    ),
    rung(
        "particle-template",
        "A fluid resolved around every grain, velocity imposed inside.",
        "Clément 2009, section 2.5.1",
    ),
    rung(
        "fluid-springs",
        "A fluid resolved around every grain, tied to it by tracer springs.",
        "Clément 2009, section 2.5.2; Hoefler & Schwarzer 2000",
    ),
    rung(
        "direct-forcing",
        "A fluid resolved around every grain, slip removed by repeated forcing.",
        "Uhlmann 2005; Breugem 2012",
    ),
];

//! The keys of a case that belong to no single model, law or observer.

use brazilnut_base::keys::{Check, Key, Kind};
use brazilnut_base::menu::Entry;
use brazilnut_base::units::Dimension as D;
use brazilnut_coupling::resolved::menu as resolved;
use brazilnut_grains::material::MATERIAL_KEYS;
use brazilnut_grains::packing::{DIAMETER_KEYS, PLACEMENT_KEYS};
use std::sync::LazyLock;

const POSITIVE: Check = Check::Positive;
const NON_NEGATIVE: Check = Check::NonNegative;

const SIDES: &[&str] = &["walls", "periodic", "flat"];

/// `[cell]`
pub const CELL: &[Key] = &[
    Key::required("size", Kind::Vector(D::LENGTH), "Inner edge lengths along x, y, z.").with(POSITIVE),
    Key::default(
        "x",
        Kind::Word(SIDES),
        "\"walls\"",
        "What bounds the cell along x; `flat` makes the case two-dimensional.",
    ),
    Key::default("y", Kind::Word(SIDES), "\"walls\"", "What bounds the cell along y."),
    Key::default("z", Kind::Word(&["walls", "periodic"]), "\"walls\"", "What bounds the cell along z."),
];

/// One harmonic of `[shaking]`.
const HARMONIC: &[Key] = &[
    Key::required("order", Kind::Integer, "Multiple of the fundamental frequency.")
        .with(Check::Between(2.0, 64.0)),
    Key::required("ratio", Kind::Quantity(D::NONE), "Displacement amplitude over that of the fundamental."),
    Key::default("phase", Kind::Quantity(D::NONE), "0.0", "Phase angle (a bare number is in radians)."),
];

/// How something moves: the shaker, a single wall.
const MOTION: [Key; 8] = [
    Key::required("frequency", Kind::Quantity(D::FREQUENCY), "Shaking frequency.").with(POSITIVE),
    Key::optional(
        "gamma",
        Kind::Quantity(D::NONE),
        "Peak acceleration over gravity; one of three ways to say how hard.",
    )
    .with(NON_NEGATIVE),
    Key::optional(
        "displacement_amplitude",
        Kind::Quantity(D::LENGTH),
        "Displacement amplitude; one of three ways to say how hard.",
    )
    .with(NON_NEGATIVE),
    Key::optional(
        "peak_velocity",
        Kind::Quantity(D::VELOCITY),
        "Peak velocity; one of three ways to say how hard.",
    )
    .with(NON_NEGATIVE),
    Key::default(
        "direction",
        Kind::Vector(D::NONE),
        "[0.0, 0.0, 1.0]",
        "Amplitude along each axis, in units of the one given.",
    ),
    Key::default(
        "phase",
        Kind::Vector(D::NONE),
        "[0.0, 0.0, 0.0]",
        "Phase angle along each axis; at phase 0 the motion is upward at its fastest.",
    ),
    Key::default("ramp", Kind::Quantity(D::TIME), "0.0", "The amplitude grows smoothly over this time.")
        .with(NON_NEGATIVE),
    Key::optional("harmonics", Kind::Tables(HARMONIC), "Further harmonics of a periodic shake."),
];

/// `[shaking]`
pub const SHAKING: &[Key] = &{
    let of = Key::default(
        "of",
        Kind::Word(&["cell", "floor"]),
        "\"cell\"",
        "What moves: the whole cell (computed in its frame), or the floor alone in the laboratory frame.",
    );
    let mut keys = [of; 9];
    let mut k = 0;
    while k < MOTION.len() {
        keys[k + 1] = MOTION[k];
        k += 1;
    }
    keys
};

/// `[[grains]]`
pub const GRAINS: &[Key] = &[
    Key::required("name", Kind::Text, "Name of the species."),
    Key::required("material", Kind::Text, "Name of a material."),
    Key::optional("count", Kind::Integer, "Number of grains; 1 where `at` is given.")
        .with(Check::Between(0.0, 5e7)),
    Key::required(
        "diameter",
        Kind::Table { keys: DIAMETER_KEYS, shorthand: Some("mean") },
        "Diameter, or a size distribution.",
    ),
    Key::default(
        "shape",
        Kind::Word(&["sphere", "cylinder"]),
        "\"sphere\"",
        "Cylinders lie along the flat direction of a two-dimensional cell and fill its depth.",
    ),
    Key::optional("at", Kind::Vector(D::LENGTH), "Place of a single grain."),
    Key::optional(
        "from",
        Kind::Vector(D::LENGTH),
        "Lower corner of the box that they are placed in; the cell's if left out.",
    ),
    Key::optional("to", Kind::Vector(D::LENGTH), "Upper corner of that box; the cell's if left out."),
    Key::default("velocity", Kind::Vector(D::VELOCITY), "[0.0, 0.0, 0.0]", "Velocity at the start."),
];

/// Constants of a pair of materials, in `[contact]` for all pairs.
pub const CONSTANTS: [Key; 7] = [
    Key::optional(
        "stiffness",
        Kind::Quantity(D::STIFFNESS),
        "Normal stiffness of the linear laws (for the latching spring: of loading).",
    )
    .with(POSITIVE),
    Key::optional(
        "hertz_stiffness",
        Kind::Quantity(D::HERTZ_STIFFNESS),
        "Normal stiffness of the Hertz laws at the pair's own radius; from the materials by default.",
    )
    .with(POSITIVE),
    Key::optional(
        "tangential_ratio",
        Kind::Quantity(D::NONE),
        "Tangential over normal stiffness; 2/7 by default for linear laws.",
    )
    .with(POSITIVE),
    Key::optional(
        "restitution",
        Kind::Table { keys: RESTITUTION, shorthand: Some("value") },
        "Coefficient of normal restitution; the damping is solved for per pair.",
    ),
    Key::optional("friction", Kind::Quantity(D::NONE), "Coefficient of sliding friction.").with(NON_NEGATIVE),
    Key::optional("rolling_friction", Kind::Quantity(D::NONE), "Coefficient of rolling friction.")
        .with(NON_NEGATIVE),
    Key::optional(
        "tangential_damping",
        Kind::Quantity(D::DAMPING),
        "Tangential dashpot; of the regularised Coulomb law by default what stops the slip in a few steps.",
    )
    .with(NON_NEGATIVE),
];

const RESTITUTION: &[Key] = &[
    Key::required("value", Kind::Quantity(D::NONE), "Coefficient of restitution.")
        .with(Check::Between(0.01, 1.0)),
    Key::optional(
        "at_speed",
        Kind::Quantity(D::VELOCITY),
        "Relative impact speed at which it holds; needed by the damped Hertz law.",
    )
    .with(POSITIVE),
];

/// `[[contact.pairs]]`
const PAIR: &[Key] = &{
    let between = Key::required("between", Kind::List(&Kind::Text), "Two materials.");
    let mut keys = [between; 8];
    let mut k = 0;
    while k < 7 {
        keys[k + 1] = CONSTANTS[k];
        k += 1;
    }
    keys
};

/// `[contact]`
pub const CONTACT: &[Key] = &{
    let normal = Key::default(
        "normal",
        Kind::Choice(brazilnut_grains::contact::menu::NORMAL),
        "\"linear\"",
        "Normal law.",
    );
    let mut keys = [normal; 12];
    keys[1] = Key::default(
        "tangential",
        Kind::Choice(brazilnut_grains::contact::menu::TANGENTIAL),
        "\"coulomb\"",
        "Tangential law.",
    );
    keys[2] = Key::default(
        "rolling",
        Kind::Choice(brazilnut_grains::contact::menu::ROLLING),
        "\"none\"",
        "Rolling law.",
    );
    keys[3] = Key::default("rotation", Kind::Flag, "true", "Grains rotate; false holds their orientation.");
    keys[4] = Key::optional(
        "pairs",
        Kind::Tables(PAIR),
        "Constants of single pairs of materials, in place of the general ones.",
    );
    let mut k = 0;
    while k < 7 {
        keys[k + 5] = CONSTANTS[k];
        k += 1;
    }
    keys
};

const WALL: &[Key] = &[
    Key::optional(
        "material",
        Kind::Text,
        "Material of the wall; a name of its own if it only differs by its contact pair.",
    ),
    Key::default(
        "surface",
        Kind::Word(&["plane", "bumpy-square", "bumpy-triangular"]),
        "\"plane\"",
        "Smooth, or half spheres on it.",
    ),
    Key::optional(
        "bump_diameter",
        Kind::Quantity(D::LENGTH),
        "Diameter of the half spheres; the mean grain diameter by default.",
    )
    .with(POSITIVE),
    Key::optional(
        "motion",
        Kind::Table { keys: &MOTION, shorthand: None },
        "How this wall moves on its own, seen from the cell; it starts when the bed has settled.",
    ),
];

/// `[walls]`
pub const WALLS: &[Key] = &[
    Key::default(
        "material",
        Kind::Text,
        "\"wall\"",
        "Material of all walls; `wall` need not be listed under `materials`.",
    ),
    Key::optional("left", Kind::Table { keys: WALL, shorthand: Some("material") }, "The wall x = 0."),
    Key::optional(
        "right",
        Kind::Table { keys: WALL, shorthand: Some("material") },
        "The wall at the far end of x.",
    ),
    Key::optional("front", Kind::Table { keys: WALL, shorthand: Some("material") }, "The wall y = 0."),
    Key::optional(
        "back",
        Kind::Table { keys: WALL, shorthand: Some("material") },
        "The wall at the far end of y.",
    ),
    Key::optional("floor", Kind::Table { keys: WALL, shorthand: Some("material") }, "The wall z = 0."),
    Key::optional(
        "lid",
        Kind::Table { keys: WALL, shorthand: Some("material") },
        "The wall at the far end of z.",
    ),
];

/// `[[obstacles]]`
pub const OBSTACLE: &[Key] = &[
    Key::required("name", Kind::Text, "Name of the obstacle."),
    Key::required("from", Kind::Vector(D::LENGTH), "Lower corner of the solid box."),
    Key::required("to", Kind::Vector(D::LENGTH), "Upper corner of the solid box."),
    Key::optional("material", Kind::Text, "Its material; that of the walls by default."),
    Key::optional(
        "motion",
        Kind::Table { keys: &MOTION, shorthand: None },
        "How it moves on its own, seen from the cell; it starts when the bed has settled.",
    ),
    Key::default(
        "until_settled",
        Kind::Flag,
        "false",
        "Taken away once the bed has settled; it then settles once more, before time 0.",
    ),
];

const fn fluid_side(name: &'static str, doc: &'static str) -> Key {
    Key::optional(name, Kind::Table { keys: brazilnut_fluid::keys::SIDE_KEYS, shorthand: Some("kind") }, doc)
}

/// `[fluid]`: the fluid itself, and what it meets at the sides.
const FLUID: &[Key] = &[
    Key::required("density", Kind::Quantity(D::DENSITY), "Density of the fluid.").with(NON_NEGATIVE),
    Key::required("viscosity", Kind::Quantity(D::VISCOSITY), "Dynamic viscosity of the fluid.")
        .with(POSITIVE),
    Key::optional(
        "largest_speed",
        Kind::Quantity(D::VELOCITY),
        "Fastest motion expected of the fluid, for the limits of the step; if left out, estimated from the shaking and from a fall of one diameter. What the fluid does is guarded by `courant_limit`.",
    )
    .with(POSITIVE),
    fluid_side("left", "The side x = 0."),
    fluid_side("right", "The far side along x."),
    fluid_side("front", "The side y = 0."),
    fluid_side("back", "The far side along y."),
    fluid_side("floor", "The side z = 0."),
    fluid_side("lid", "The far side along z."),
];

/// The same with the numerics of the grid.
static FLUID_KEYS: LazyLock<Vec<Key>> =
    LazyLock::new(|| FLUID.iter().chain(brazilnut_fluid::keys::KEYS).copied().collect());

/// `[time]`
pub const TIME: &[Key] = &[
    Key::default("dt", Kind::QuantityOr(D::TIME, &["auto"]), "\"auto\"", "Time step; `auto` takes the contact time over `steps_per_contact`, fitted to the shake cycle.").with(POSITIVE),
    Key::default("steps_per_contact", Kind::Quantity(D::NONE), "30.0", "Steps in the shortest contact time when `dt` is `auto`.").with(Check::Between(5.0, 1000.0)),
    Key::default("integrator", Kind::Choice(brazilnut_grains::spec::INTEGRATORS), "\"velocity-verlet\"", "How the grains' equations of motion are stepped."),
    Key::default("settle", Kind::QuantityOr(D::TIME, &["until-at-rest", "none"]), "\"until-at-rest\"", "How long grains settle before time 0.").with(NON_NEGATIVE),
    Key::default("settle_limit", Kind::Quantity(D::TIME), "10.0", "Settling that takes longer than this is an error.").with(POSITIVE),
    Key::default("rest_speed", Kind::Quantity(D::VELOCITY), "1e-3", "At rest: the root-mean-square speed stays below this for the time a grain takes to fall its own diameter, and the floor carries the weight.").with(POSITIVE),
    Key::required("end", Kind::Every, "End of the run: a time or a number of cycles."),
];

/// `[output]`
pub const OUTPUT: &[Key] = &[
    Key::default("frames", Kind::Every, "\"end\"", "When grains are written for ParaView."),
    Key::default(
        "fields",
        Kind::Every,
        "\"end\"",
        "When the flow, where there is one, is written for ParaView.",
    ),
    Key::default("dump", Kind::Flag, "false", "Also write a LAMMPS dump for OVITO."),
    Key::default("pictures", Kind::Integer, "4", "Number of pictures of the bed in the report.")
        .with(Check::Between(0.0, 64.0)),
    Key::default("checkpoint", Kind::Quantity(D::TIME), "600.0", "Wall-clock time between checkpoints.")
        .with(POSITIVE),
    Key::default("keep", Kind::Integer, "2", "Number of checkpoints kept.").with(Check::Between(1.0, 1000.0)),
];

/// `[limits]`
pub const LIMITS: &[Key] = &[
    Key::default(
        "action",
        Kind::Word(&["stop", "warn"]),
        "\"stop\"",
        "What happens when a limit is passed; a value that is not a number always stops.",
    ),
    Key::default("overlap", Kind::Quantity(D::NONE), "0.3", "Largest overlap over the smaller radius.")
        .with(POSITIVE),
    Key::default(
        "overlap_warning",
        Kind::Quantity(D::NONE),
        "0.02",
        "Overlap over the smaller diameter beyond which the report warns.",
    )
    .with(POSITIVE),
    Key::default(
        "energy_residual",
        Kind::Quantity(D::NONE),
        "0.05",
        "Largest mismatch of the energy ledger over the work put in.",
    )
    .with(POSITIVE),
    Key::default("every", Kind::Integer, "100", "Steps between two checks.").with(POSITIVE),
];

fn observers() -> Vec<Entry> {
    brazilnut_observe::observer::menu::MENU.to_vec()
}

fn observer_keys(what: &str) -> &'static [Key] {
    brazilnut_observe::observer::menu::keys(what).unwrap_or_default()
}

/// The keys of a whole case.
#[must_use]
pub fn root() -> Vec<Key> {
    let table = |keys| Kind::Table { keys, shorthand: None };
    let mut keys = vec![
        Key::default("title", Kind::Text, "\"untitled\"", "Title of the report."),
        Key::required("model", Kind::Choice(crate::models::MENU), "The rung of the ladder."),
        Key::default("seed", Kind::Integer, "1", "Seed of everything random.").with(NON_NEGATIVE),
        Key::default("gravity", Kind::Quantity(D::ACCELERATION), "9.81", "Gravity, downward along z.")
            .with(NON_NEGATIVE),
        Key::optional("cell", table(CELL), "The box that holds the bed."),
        Key::optional("shaking", table(SHAKING), "How the cell or its floor moves."),
        Key::optional("materials", Kind::NamedTables(MATERIAL_KEYS), "What grains and walls are made of."),
        Key::optional("grains", Kind::Tables(GRAINS), "The species of grains."),
        Key::default("start", table(PLACEMENT_KEYS), "{}", "How the grains get their places."),
        Key::default("walls", table(WALLS), "{}", "What the sides of the cell are made of."),
        Key::optional("obstacles", Kind::Tables(OBSTACLE), "Solid boxes inside the cell."),
        Key::default("contact", table(CONTACT), "{}", "Laws and constants of contacts."),
        Key::optional("fluid", table(FLUID_KEYS.as_slice()), "The fluid that fills the cell."),
        Key::optional("time", table(TIME), "Time step, settling and end."),
        Key::default("output", table(OUTPUT), "{}", "What is written."),
        Key::default("limits", table(LIMITS), "{}", "Guards against a run that means nothing any more."),
        Key::optional(
            "observe",
            Kind::Variants {
                tag: "what",
                common: brazilnut_observe::watch::COMMON,
                menu: observers,
                keys: observer_keys,
            },
            "What is measured.",
        ),
        Key::default(
            "simple-drag",
            table(brazilnut_coupling::one_way::KEYS),
            "{}",
            "The rung `simple-drag`.",
        ),
    ];
    for (name, own) in RUNGS {
        keys.push(Key::default(name, table(own), "{}", "The rung of this name; ignored by the others."));
    }
    keys
}

/// Tables of the rungs that bring their own keys.
const RUNGS: &[(&str, &[Key])] = &[
    ("navier-stokes", brazilnut_coupling::averaged::KEYS),
    ("particle-template", resolved::TEMPLATE_KEYS),
    ("fluid-springs", resolved::SPRINGS_KEYS),
    ("direct-forcing", resolved::FORCING_KEYS),
    ("plug", brazilnut_bed::plug::KEYS),
    ("coupled-columns", brazilnut_bed::coupled_columns::KEYS),
    ("brazil-nut-column", brazilnut_bed::brazil_nut::KEYS),
    ("kinetic-theory", brazilnut_bed::kinetic_theory::KEYS),
];

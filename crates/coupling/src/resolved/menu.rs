//! What a case may say in `[particle-template]`, `[fluid-springs]` and `[direct-forcing]`.

use super::lubrication::Lubrication;
use super::{Forcing, Inertia, LAYOUTS, Layout, Springs, Strength};
use crate::body::Body;
use crate::spec::{Method, Resolved};
use crate::transfer::{KERNELS, KernelName};
use brazilnut_base::keys::{Check, Key, Kind};
use brazilnut_base::units::Dimension;
use brazilnut_base::values::Values;

const POINTS: Key = Key::default(
    "points_per_radius",
    Kind::Quantity(Dimension::NONE),
    "3",
    "Grid cells per radius of the smallest species; sets the spacing unless `fluid.spacing` does.",
)
.with(Check::Between(1.0, 200.0));

const LUBRICATION: Key = Key::optional(
    "lubrication",
    Kind::Table { keys: FILMS, shorthand: Some("max_gap") },
    "Lubrication below the grid scale, with two grain steps or more in a fluid step; off if left out.",
);

const KERNEL: Key =
    Key::default("kernel", Kind::Choice(KERNELS), "\"trilinear\"", "Between tracers and grid points.");

const LAYOUT: Key = Key::default("layout", Kind::Choice(LAYOUTS), "\"lattice\"", "How tracers fill a grain.");

const RETRACTION: Key = Key::default(
    "retraction",
    Kind::Quantity(Dimension::NONE),
    "0.4",
    "Shells: depth of the outermost one below the surface, in grid spacings.",
)
.with(Check::Between(0.0, 1.0));

const FILMS: &[Key] = &[
    Key::required("max_gap", Kind::Quantity(Dimension::LENGTH), "Gap from which the grid resolves the film.")
        .with(Check::Positive),
    Key::optional(
        "min_gap",
        Kind::Quantity(Dimension::LENGTH),
        "Gap below which the force no longer grows (roughness); a hundredth of `max_gap` if left out.",
    )
    .with(Check::Positive),
];

/// Keys of `[particle-template]`.
pub const TEMPLATE_KEYS: &[Key] = &[POINTS, LUBRICATION];

/// Keys of `[fluid-springs]`.
pub const SPRINGS_KEYS: &[Key] = &[
    POINTS,
    Key::optional(
        "c_s",
        Kind::Quantity(Dimension::NONE),
        "Strength as published; means something only together with the step. Give this or `relaxation_time`.",
    )
    .with(Check::Positive),
    Key::optional("relaxation_time", Kind::Quantity(Dimension::TIME), "Time in which slip decays.")
        .with(Check::Positive),
    Key::default("damping", Kind::Quantity(Dimension::DAMPING), "0.0", "Damping constant of a tracer.")
        .with(Check::NonNegative),
    Key::default(
        "inertia",
        Kind::Word(&["template", "full"]),
        "\"template\"",
        "Mass that stands in the equation of motion: without the enclosed fluid, or all of it as printed.",
    ),
    KERNEL,
    LAYOUT,
    RETRACTION,
    LUBRICATION,
];

/// Keys of `[direct-forcing]`.
pub const FORCING_KEYS: &[Key] = &[
    POINTS,
    Key::default("sweeps", Kind::Integer, "3", "How often the remaining slip is removed in a step.")
        .with(Check::Between(1.0, 100.0)),
    KERNEL,
    Key::default("layout", Kind::Choice(LAYOUTS), "\"shells\"", "How tracers fill a grain."),
    RETRACTION,
    LUBRICATION,
];

impl Resolved {
    /// The rung called `model` from its table.
    ///
    /// # Errors
    /// The key at fault and what is wrong with it.
    pub fn read(
        model: &str,
        values: &Values,
        density: f64,
        viscosity: f64,
        body: Body,
    ) -> Result<Self, (&'static str, String)> {
        let method = match model {
            "particle-template" => Method::Template,
            "direct-forcing" => Method::Forcing(Forcing { sweeps: values.integer("sweeps") as u32 }),
            _ => Method::Springs(Springs {
                strength: match (values.number_opt("c_s"), values.number_opt("relaxation_time")) {
                    (Some(c), None) => Strength::Cs(c),
                    (None, Some(tau)) => Strength::RelaxationTime(tau),
                    (Some(_), Some(_)) => {
                        return Err((
                            "c_s",
                            "`c_s` and `relaxation_time` say the same twice: keep one".into(),
                        ));
                    }
                    (None, None) => {
                        return Err(("c_s", "give `relaxation_time`, or `c_s` as published".into()));
                    }
                },
                damping: values.number("damping"),
                inertia: if values.text("inertia") == "full" { Inertia::Full } else { Inertia::Template },
            }),
        };
        let lubrication = values.table_opt("lubrication").map(|t| {
            let max_gap = t.number("max_gap");
            Lubrication { min_gap: t.number_opt("min_gap").unwrap_or(0.01 * max_gap), max_gap }
        });
        let name = |key| values.text_opt(key).unwrap_or_default();
        Ok(Self {
            method,
            kernel: KernelName::from_name(name("kernel")).unwrap_or_default(),
            layout: Layout::from_name(name("layout")).unwrap_or(Layout::Lattice),
            retraction: values.number_opt("retraction").unwrap_or(0.0),
            lubrication,
            density,
            viscosity,
            body,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use brazilnut_base::values::Value;

    #[test]
    fn springs_want_exactly_one_strength() {
        let read = |pairs: &[(&str, f64)]| {
            let mut v = Values::default();
            v.insert("damping", Value::Number(0.0), None);
            v.insert("inertia", Value::Text("template".into()), None);
            for (key, x) in pairs {
                v.insert(key, Value::Number(*x), None);
            }
            Resolved::read("fluid-springs", &v, 1000.0, 1e-3, Body::Sphere)
        };
        assert_eq!(read(&[]).unwrap_err().0, "c_s");
        assert_eq!(read(&[("c_s", 0.5), ("relaxation_time", 1e-4)]).unwrap_err().0, "c_s");
        let springs = |pairs| match read(pairs).unwrap().method {
            Method::Springs(s) => s.strength,
            other => panic!("{other:?} are no springs"),
        };
        assert_eq!(springs(&[("c_s", 0.5)]), Strength::Cs(0.5));
        assert_eq!(springs(&[("relaxation_time", 1e-4)]), Strength::RelaxationTime(1e-4));
    }
}

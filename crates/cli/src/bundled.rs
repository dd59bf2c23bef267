//! The cases that come with the program.

/// Name and text of each.
const CASES: &[(&str, &str)] = &[
    ("wet-bed", include_str!("../../../cases/wet-bed.toml")),
    ("cavity", include_str!("../../../cases/cavity.toml")),
    ("partition", include_str!("../../../cases/partition.toml")),
    ("brazil-nut", include_str!("../../../cases/brazil-nut.toml")),
    ("layers", include_str!("../../../cases/layers.toml")),
];

/// The text of the case called `name`.
#[must_use]
pub fn text(name: &str) -> Option<&'static str> {
    CASES.iter().find(|(n, _)| *n == name).map(|(_, t)| *t)
}

/// The names of all.
pub fn names() -> impl Iterator<Item = &'static str> {
    CASES.iter().map(|(n, _)| *n)
}

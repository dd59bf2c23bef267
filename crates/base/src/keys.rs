//! The keys of a case, each defined once.
//!
//! From one list of [`Key`]s the case reader checks a table, reports every
//! error with a suggestion, fills in defaults, writes the resolved copy, and
//! prints `describe` and the JSON Schema. Whoever owns a family of parameters
//! (a contact law, an observer) owns its keys.

use crate::menu::Entry;
use crate::units::Dimension;

/// What a value may be.
#[derive(Clone, Copy, Debug)]
pub enum Kind {
    /// A number with a unit; a bare number is SI.
    Quantity(Dimension),
    /// A number with a unit, or one of these words.
    QuantityOr(Dimension, &'static [&'static str]),
    /// A whole number.
    Integer,
    /// `true` or `false`.
    Flag,
    /// Any text.
    Text,
    /// One of these words.
    Word(&'static [&'static str]),
    /// A name from a menu.
    Choice(&'static [Entry]),
    /// Three numbers with units.
    Vector(Dimension),
    /// When: `"cycle"`, `"12 per cycle"`, `"5 cycles"`, `"100 steps"`, `"0.1 s"`, `"end"`.
    Every,
    /// A list of values of one kind.
    List(&'static Kind),
    /// A table. If `shorthand` names a key, a bare value stands for a table with that key alone.
    Table {
        /// Its keys.
        keys: &'static [Key],
        /// The key that a bare value stands for.
        shorthand: Option<&'static str>,
    },
    /// An array of tables.
    Tables(&'static [Key]),
    /// Tables under names that the user chooses, as `[materials.glass]`.
    NamedTables(&'static [Key]),
    /// An array of tables whose further keys depend on a menu name in the key `tag`.
    Variants {
        /// The key that names the variant.
        tag: &'static str,
        /// Keys that every variant has, the tag among them.
        common: &'static [Key],
        /// The names.
        menu: fn() -> Vec<Entry>,
        /// The further keys of a name.
        keys: fn(&str) -> &'static [Key],
    },
}

/// What holds if the key is left out.
#[derive(Clone, Copy, Debug)]
pub enum Absent {
    /// It is an error.
    Required,
    /// Nothing is set; the documentation of the key says what follows.
    Nothing,
    /// This TOML value is used and shown in the resolved copy.
    Is(&'static str),
}

/// What a number must satisfy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Check {
    /// Any finite number.
    Finite,
    /// > 0
    Positive,
    /// >= 0
    NonNegative,
    /// Between these, both included.
    Between(f64, f64),
    /// Between these, both excluded.
    Inside(f64, f64),
}

/// One key of a table.
#[derive(Clone, Copy, Debug)]
pub struct Key {
    /// Name in the case file.
    pub name: &'static str,
    /// What it may be.
    pub kind: Kind,
    /// What holds without it.
    pub absent: Absent,
    /// What a number (or each of a list or vector) must satisfy.
    pub check: Check,
    /// One or two sentences.
    pub doc: &'static str,
}

impl Key {
    /// A key that must be there.
    #[must_use]
    pub const fn required(name: &'static str, kind: Kind, doc: &'static str) -> Self {
        Self { name, kind, absent: Absent::Required, check: Check::Finite, doc }
    }

    /// A key that may be missing without a default.
    #[must_use]
    pub const fn optional(name: &'static str, kind: Kind, doc: &'static str) -> Self {
        Self { name, kind, absent: Absent::Nothing, check: Check::Finite, doc }
    }

    /// A key with a default, written as a TOML value (`"\"walls\""`, `"0.2"`).
    #[must_use]
    pub const fn default(name: &'static str, kind: Kind, value: &'static str, doc: &'static str) -> Self {
        Self { name, kind, absent: Absent::Is(value), check: Check::Finite, doc }
    }

    /// The same key with a condition on its number.
    #[must_use]
    pub const fn with(mut self, check: Check) -> Self {
        self.check = check;
        self
    }
}

impl Check {
    /// Whether `x` passes.
    #[must_use]
    pub fn passes(self, x: f64) -> bool {
        x.is_finite()
            && match self {
                Self::Finite => true,
                Self::Positive => x > 0.0,
                Self::NonNegative => x >= 0.0,
                Self::Between(a, b) => (a..=b).contains(&x),
                Self::Inside(a, b) => x > a && x < b,
            }
    }

    /// The condition in words, for `must be …`.
    #[must_use]
    pub fn words(self) -> String {
        match self {
            Self::Finite => "a finite number".into(),
            Self::Positive => "greater than zero".into(),
            Self::NonNegative => "zero or greater".into(),
            Self::Between(a, b) => format!("between {a} and {b}"),
            Self::Inside(a, b) => format!("greater than {a} and less than {b}"),
        }
    }
}

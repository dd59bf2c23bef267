//! Keeping to instructions that every machine has.

use std::sync::OnceLock;

/// The variable that asks for it: any value but the empty one and 0.
pub const VARIABLE: &str = "BRAZILNUT_PORTABLE";

/// Whether the environment asks for code without instructions that are found at run time. Results are the
/// same; tests run once more this way, and a crash can be told from a fault of such code.
#[must_use]
pub fn wanted() -> bool {
    static WANTED: OnceLock<bool> = OnceLock::new();
    *WANTED.get_or_init(|| std::env::var_os(VARIABLE).is_some_and(|v| !v.is_empty() && v != "0"))
}

//! Any bytes as a case file: read or refused, its resolved copy reads back the same, and what is
//! read can be assembled or is refused. Never a panic.

#![no_main]

use brazilnut_case::{Case, build, check, resolved};
use libfuzzer_sys::{Corpus, fuzz_target};
use std::path::PathBuf;

fuzz_target!(|bytes: &[u8]| -> Corpus {
    let Ok(text) = std::str::from_utf8(bytes) else { return Corpus::Reject };
    match Case::parse(text, "fuzz.toml", PathBuf::new(), &[]) {
        Ok(case) => {
            let copy = case.resolved();
            let again = Case::parse(&copy, "copy.toml", PathBuf::new(), &[]);
            let again = again.unwrap_or_else(|e| panic!("the copy is refused: {e}\n{copy}"));
            assert_eq!(resolved::flatten(&case.values), resolved::flatten(&again.values));
            // Placing a hundred thousand grains is slow, not wrong; an analytical model is assembled by solving it.
            let few = case.values.tables("grains").all(|g| g.integer_opt("count").is_none_or(|n| n <= 100));
            if few && !check::is_analytical(case.model()) {
                let _ = build::build(&case);
            }
        }
        Err(issues) => assert!(!issues.is_empty() && !issues.render(false).is_empty()),
    }
    Corpus::Keep
});

//! How films of lubrication cut the steps of a case.

use brazilnut_case::{Case, build};
use std::path::PathBuf;

const CASE: &str = include_str!("../../../studies/clement-lubrication/case.toml");

/// Grain steps in a fluid step so short that the contacts ask for one.
fn substeps(film: &str) -> u64 {
    let overrides: Vec<String> =
        ["time.dt=1 us", film].into_iter().filter(|o| !o.is_empty()).map(String::from).collect();
    let case = Case::parse(CASE, "x.toml", PathBuf::new(), &overrides)
        .unwrap_or_else(|e| panic!("{}", e.render(false)));
    build::build(&case).unwrap_or_else(|e| panic!("{}", e.render(false))).plan.clock.substeps
}

#[test]
fn films_take_two_grain_steps_at_least() {
    assert_eq!(substeps(""), 1);
    assert_eq!(substeps("fluid-springs.lubrication.max_gap=0.1 mm"), 2);
}

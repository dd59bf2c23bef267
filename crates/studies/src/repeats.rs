//! Runs of one case that differ by their seed.

use crate::runs::Done;
use brazilnut_base::Table;
use brazilnut_runner::Failure;
use std::path::Path;

/// Runs of one case from several seeds.
pub struct Repeats(Vec<Done>);

impl Repeats {
    /// Runs the case as [`Done::new`] does from the seeds 1 to `seeds`, each in a folder of its own in `folder`.
    ///
    /// # Errors
    /// What a run fails with, or that it was stopped.
    pub fn new(
        case: (&str, &str),
        overrides: &[String],
        folder: &Path,
        seeds: u64,
        go_on: bool,
    ) -> Result<Self, Failure> {
        let one = |seed: u64| {
            let overrides: Vec<String> = overrides.iter().cloned().chain([format!("seed={seed}")]).collect();
            Done::new(case, &overrides, &folder.join(format!("seed-{seed}")), go_on)
        };
        (1..=seeds).map(one).collect::<Result<_, _>>().map(Self)
    }

    /// The table `name` of each run.
    ///
    /// # Errors
    /// If there is none.
    pub fn tables(&self, name: &str) -> Result<Vec<Table>, Failure> {
        self.0.iter().map(|run| run.table(name)).collect()
    }
}

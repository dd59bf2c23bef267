//! Runs of cases inside a study.

use brazilnut_base::Table;
use brazilnut_case::Case;
use brazilnut_runner::Failure;
use brazilnut_runner::directory::Directory;
use brazilnut_runner::run::{Options, Outcome, resume, run};
use brazilnut_store::table;
use std::path::{Path, PathBuf};

/// A run that has ended.
pub struct Done {
    directory: Directory,
}

impl Done {
    /// Runs the case `text` (the file `name` of the study's folder) with `overrides` in `folder`.
    ///
    /// With `go_on`, a run of the same case that is there is continued, or left as it is if it has ended.
    ///
    /// # Errors
    /// What the run fails with, or that it was stopped.
    pub fn new(
        (name, text): (&str, &str),
        overrides: &[String],
        folder: &Path,
        go_on: bool,
    ) -> Result<Self, Failure> {
        let case = Case::parse(text, name, PathBuf::new(), overrides)?;
        let directory = Directory::new(folder);
        let read = |path: PathBuf| std::fs::read_to_string(path).unwrap_or_default();
        let same = go_on && read(directory.case()) == case.resolved();
        let status: serde_json::Value = serde_json::from_str(&read(directory.status())).unwrap_or_default();
        if same && status["status"] == "done" {
            return Ok(Self { directory });
        }
        let options =
            Options { out: Some(folder.to_path_buf()), replace: true, quiet: !go_on, ..Options::default() };
        let saved = std::fs::read_dir(directory.checkpoints()).is_ok_and(|mut d| d.next().is_some());
        let outcome = if same && saved { resume(folder, &options)? } else { run(&case, &options)? };
        match outcome {
            Outcome::Done => Ok(Self { directory }),
            Outcome::Stopped(_) => Err(Failure::Usage(format!(
                "{} was stopped early; the same command continues it",
                folder.display()
            ))),
        }
    }

    /// The table `name` of the run.
    ///
    /// # Errors
    /// If there is none.
    pub fn table(&self, name: &str) -> Result<Table, Failure> {
        Ok(table::read(&self.directory.tables().join(format!("{name}.csv")))?)
    }
}

/// The first entry of a column; not a number if there is none.
#[must_use]
pub fn first(table: &Table, name: &str) -> f64 {
    table.column(name).and_then(|c| c.first().copied()).unwrap_or(f64::NAN)
}

/// A column, empty if there is none.
#[must_use]
pub fn column(table: &Table, name: &str) -> Vec<f64> {
    table.column(name).unwrap_or_default()
}

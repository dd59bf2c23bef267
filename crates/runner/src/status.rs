//! `run.json`: status while running, summary at the end.

use crate::directory::Directory;
use brazilnut_store::{StoreError, atomic};
use serde::Serialize;
use std::collections::BTreeMap;

/// What `run.json` says.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Status {
    /// `running`, `done`, `stopped`, `interrupted` or `blown-up`.
    pub status: String,
    /// Title of the case.
    pub title: String,
    /// Rung of the ladder.
    pub model: String,
    /// Version of brazilnut.
    pub version: String,
    /// Commit it was built from, if known.
    pub commit: Option<String>,
    /// Seed of the run.
    pub seed: i64,
    /// Threads used.
    pub threads: usize,
    /// Number of grains.
    pub grains: usize,
    /// Steps since time 0, and at the end of the plan.
    pub step: u64,
    /// Steps from time 0 to the end.
    pub steps: u64,
    /// Steps that settling took.
    pub settling_steps: u64,
    /// Simulated time, s.
    pub time: f64,
    /// Wall-clock time of this part of the run, s.
    pub wall_seconds: f64,
    /// Steps per second of this part of the run.
    pub steps_per_second: f64,
    /// Grains times steps per second, in millions.
    pub million_particle_steps_per_second: f64,
    /// Largest overlap over the smaller radius.
    pub largest_overlap: f64,
    /// Largest mismatch of the energy ledger over the work put in.
    pub largest_energy_residual: f64,
    /// The energy ledger, J.
    pub energy: BTreeMap<String, f64>,
    /// What was measured of the coupling between grains and fluid.
    pub coupling: BTreeMap<String, f64>,
    /// Seconds by stage.
    pub timing: BTreeMap<String, f64>,
    /// Warnings.
    pub warnings: Vec<String>,
    /// What went wrong, if anything.
    pub error: Option<String>,
}

impl Status {
    /// Writes it, replacing the last one at once.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn write(&self, directory: &Directory) -> Result<(), StoreError> {
        let mut text = serde_json::to_string_pretty(self).expect("plain data with text keys");
        text.push('\n');
        atomic::write(&directory.status(), text.as_bytes())
    }
}

/// The commit this program was built from, if the build knew.
#[must_use]
pub fn commit() -> Option<String> {
    option_env!("BRAZILNUT_COMMIT").map(str::to_string)
}

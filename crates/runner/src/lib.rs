//! A run directory: from a case to tables, pictures, checkpoints and a report.

pub mod analytic;
pub mod compare;
pub mod directory;
pub mod failure;
pub mod fields;
pub mod flow_sheet;
pub mod outputs;
pub mod pictures;
mod plane;
pub mod progress;
pub mod report;
pub mod run;
pub mod sheet;
pub mod status;
pub mod stop;
pub mod sweep;

pub use failure::Failure;
pub use run::{Options, Outcome, resume, run};

/// Sets the number of threads of this process; once.
///
/// # Errors
/// If the pool cannot be made.
pub fn threads(n: Option<usize>) -> Result<(), Failure> {
    let mut pool = rayon::ThreadPoolBuilder::new();
    if let Some(n) = n {
        pool = pool.num_threads(n);
    }
    pool.build_global().map_err(|e| Failure::Usage(format!("threads cannot be started: {e}")))
}

//! What the command line may say.

use clap::{Args, Parser, Subcommand};
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  brazilnut new my-bed --from wet-bed      a case file to start from
  brazilnut check my-bed.toml              every limit and number, nothing runs
  brazilnut run my-bed.toml                progress, then a report with pictures
  brazilnut run my-bed.toml --set shaking.gamma=3 --out runs/gamma-3
  brazilnut resume runs/my-bed             exactly where it stopped
  brazilnut describe contact               what a case may name

Exit codes: 0 done, 1 a study's verdict differs from the recorded one, 2 the input is wrong,
3 the physics blew up, 4 stopped at a limit with a good checkpoint, 5 a file could not be
written, 130 interrupted with a good checkpoint.";

/// Simulates shaken granular beds, dry or in a fluid, at any depth of modelling.
#[derive(Parser)]
#[command(name = "brazilnut", version, about, after_help = EXAMPLES)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// What to do.
#[derive(Subcommand)]
pub enum Command {
    /// Run a case: tables, pictures and a report in a run directory.
    Run(Run),
    /// Print the start-up sheet of a case; nothing runs, nothing is written.
    Check(Check),
    /// Continue a run to where it would have ended.
    Resume(Resume),
    /// Run rungs of the ladder on one case and lay their curves over each other.
    Compare(Compare),
    /// Run a case over values of its keys: one table and plots at the end.
    Sweep(Sweep),
    /// Write a case file to start from.
    New(New),
    /// Tell what a case may name, with formulae and units.
    Describe {
        /// A key of the case, like `contact` or `observe`; without it, all of them.
        topic: Option<String>,
    },
    /// Print the JSON Schema of case files, for editors.
    Schema,
    /// List or run the published results.
    Study {
        /// What to do with the studies.
        #[command(subcommand)]
        command: Study,
    },
    /// Print a completion script for a shell.
    Completions {
        /// The shell.
        shell: clap_complete::Shell,
    },
}

/// Arguments of a case.
#[derive(Args)]
pub struct CaseArguments {
    /// The case file.
    pub case: PathBuf,
    /// Lay KEY=VALUE over the case, as `shaking.gamma=3` or `grains.host.count=500`; may be repeated.
    #[arg(long, value_name = "KEY=VALUE")]
    pub set: Vec<String>,
    /// Seed of everything random, in place of the case's.
    #[arg(long)]
    pub seed: Option<u64>,
}

/// Arguments of a running job.
#[derive(Args)]
pub struct JobArguments {
    /// Number of threads; all processors by default. Results do not depend on it.
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// No progress, only errors.
    #[arg(long, short)]
    pub quiet: bool,
    /// Stop with a checkpoint after this wall-clock time, as `11h50m` or `90s`.
    #[arg(long, value_parser = wall_clock)]
    pub wall_limit: Option<std::time::Duration>,
    /// Stop with a checkpoint after this many steps since time 0.
    #[arg(long, hide = true)]
    pub stop_after: Option<u64>,
}

/// `run`
#[derive(Args)]
pub struct Run {
    /// The case.
    #[command(flatten)]
    pub case: CaseArguments,
    /// The run directory; `runs/NAME` by default.
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Replace a run that is there already.
    #[arg(long)]
    pub force: bool,
    /// The job.
    #[command(flatten)]
    pub job: JobArguments,
}

/// `check`
#[derive(Args)]
pub struct Check {
    /// The case.
    #[command(flatten)]
    pub case: CaseArguments,
}

/// `resume`
#[derive(Args)]
pub struct Resume {
    /// The run directory.
    pub directory: PathBuf,
    /// Go on to this end instead of the case's, as `20s` or `"300 cycles"`; the run's case is changed to it.
    #[arg(long, value_name = "TIME")]
    pub until: Option<String>,
    /// The job.
    #[command(flatten)]
    pub job: JobArguments,
}

/// `compare`
#[derive(Args)]
pub struct Compare {
    /// The case.
    #[command(flatten)]
    pub case: CaseArguments,
    /// The rungs, separated by commas, as `modified-kroll,simple-drag`.
    #[arg(long, value_delimiter = ',', required = true)]
    pub models: Vec<String>,
    /// Where the runs and the report go.
    #[arg(long, value_name = "DIR", default_value = "runs/compare")]
    pub out: PathBuf,
    /// Replace runs that are there already.
    #[arg(long)]
    pub force: bool,
    /// The job.
    #[command(flatten)]
    pub job: JobArguments,
}

/// `sweep`
#[derive(Args)]
pub struct Sweep {
    /// The case file.
    pub case: PathBuf,
    /// KEY=A,B,C to vary a key, KEY=VALUE to set one; may be repeated for all combinations.
    #[arg(long, value_name = "KEY=A,B,C", required = true)]
    pub set: Vec<String>,
    /// Where the table, the report and the runs go.
    #[arg(long, value_name = "DIR", default_value = "runs/sweep")]
    pub out: PathBuf,
    /// The job.
    #[command(flatten)]
    pub job: JobArguments,
}

/// `new`
#[derive(Args)]
pub struct New {
    /// Name of the case; NAME.toml is written.
    pub name: String,
    /// The bundled case to start from.
    #[arg(long, default_value = "wet-bed")]
    pub from: String,
}

/// `study`
#[derive(Subcommand)]
pub enum Study {
    /// List the studies with their recorded verdicts.
    List,
    /// Run a study, or all of them.
    Run {
        /// Names of studies.
        ids: Vec<String>,
        /// All studies.
        #[arg(long)]
        all: bool,
        /// The short form that CI runs.
        #[arg(long)]
        quick: bool,
        /// Where findings and plots go, one folder per study.
        #[arg(long, value_name = "DIR", default_value = "runs/studies")]
        out: PathBuf,
        /// Number of threads.
        #[arg(long)]
        threads: Option<u16>,
    },
}

/// Reads `11h50m`, `90s`, `45m`, `2h`.
fn wall_clock(text: &str) -> Result<std::time::Duration, String> {
    let mut seconds = 0_u64;
    let mut digits = String::new();
    for c in text.chars() {
        let unit = match c {
            '0'..='9' => {
                digits.push(c);
                continue;
            }
            'h' => 3600,
            'm' => 60,
            's' => 1,
            _ => return Err(format!("`{c}` is neither a digit nor h, m or s")),
        };
        let n: u64 = digits.parse().map_err(|_| "a number must stand before h, m or s".to_string())?;
        seconds = n.checked_mul(unit).and_then(|s| seconds.checked_add(s)).ok_or("too long")?;
        digits.clear();
    }
    if !digits.is_empty() {
        return Err("the last number lacks its unit: h, m or s".into());
    }
    Ok(std::time::Duration::from_secs(seconds))
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_command_line_is_consistent() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn wall_clock_limits() {
        assert_eq!(wall_clock("11h50m").unwrap().as_secs(), 42_600);
        assert_eq!(wall_clock("90s").unwrap().as_secs(), 90);
        assert!(wall_clock("90").is_err() && wall_clock("x").is_err());
        assert!(wall_clock("99999999999999999999h").is_err());
    }
}

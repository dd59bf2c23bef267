//! What each command does.

use crate::arguments::{Arguments, CaseArguments, Command, JobArguments, New, Study};
use brazilnut_case::{Case, describe, schema};
use brazilnut_runner::{Failure, Options, compare, run, sheet, sweep};
use clap::CommandFactory;
use std::io::{IsTerminal, Write};
use std::path::Path;

/// Carries out a command; the exit code.
#[must_use]
pub fn execute(arguments: Arguments) -> u8 {
    match carry_out(arguments.command) {
        Ok(code) => code,
        Err(failure) => {
            eprint!("{}", failure.render(colour()));
            failure.exit_code()
        }
    }
}

/// Colour only on a terminal, and not if the user says no.
fn colour() -> bool {
    std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|v| v.is_empty())
}

fn carry_out(command: Command) -> Result<u8, Failure> {
    match command {
        Command::Run(r) => {
            let case = load(&r.case)?;
            let options = Options { out: r.out, replace: r.force, ..job(&r.job)? };
            let out = options.out.clone().unwrap_or_else(|| run::default_out(&case));
            let outcome = run::run(&case, &options)?;
            ended(outcome, &out, r.job.quiet);
            Ok(outcome.exit_code())
        }
        Command::Check(c) => {
            print(&sheet::text(&load(&c.case)?)?);
            Ok(0)
        }
        Command::Resume(r) => {
            let options = Options { until: r.until, ..job(&r.job)? };
            let outcome = run::resume(&r.directory, &options)?;
            ended(outcome, &r.directory, r.job.quiet);
            Ok(outcome.exit_code())
        }
        Command::Compare(c) => {
            let options = Options { replace: c.force, ..job(&c.job)? };
            let set = overrides(&c.case);
            let outcome = compare::compare(&c.case.case, &set, &c.models, &c.out, &options)?;
            ended(outcome, &c.out, c.job.quiet);
            Ok(outcome.exit_code())
        }
        Command::Sweep(s) => {
            let options = job(&s.job)?;
            let outcome = sweep::sweep(&s.case, &s.set, &s.out, &options)?;
            ended(outcome, &s.out, s.job.quiet);
            Ok(outcome.exit_code())
        }
        Command::New(n) => new(&n),
        Command::Describe { topic } => {
            print(&describe::describe(topic.as_deref()).map_err(Failure::Usage)?);
            Ok(0)
        }
        Command::Schema => {
            print(&format!("{:#}\n", schema::schema()));
            Ok(0)
        }
        Command::Study { command } => study(command),
        Command::Completions { shell } => {
            let mut out = vec![];
            clap_complete::generate(shell, &mut Arguments::command(), "brazilnut", &mut out);
            print(&String::from_utf8_lossy(&out));
            Ok(0)
        }
    }
}

/// A reader that has gone away (`| head`) is no error.
fn print(text: &str) {
    let _ = std::io::stdout().write_all(text.as_bytes());
}

fn overrides(arguments: &CaseArguments) -> Vec<String> {
    let mut set = arguments.set.clone();
    set.extend(arguments.seed.map(|s| format!("seed={s}")));
    set
}

fn load(arguments: &CaseArguments) -> Result<Case, Failure> {
    Ok(Case::load(&arguments.case, &overrides(arguments))?)
}

fn job(arguments: &JobArguments) -> Result<Options, Failure> {
    brazilnut_runner::threads(arguments.threads.map(usize::from))?;
    Ok(Options {
        quiet: arguments.quiet,
        wall_limit: arguments.wall_limit,
        stop_after: arguments.stop_after,
        ..Options::default()
    })
}

fn ended(outcome: run::Outcome, out: &Path, quiet: bool) {
    if quiet {
        return;
    }
    let report = out.join("report.html");
    match outcome {
        run::Outcome::Done => eprintln!("done: open {}", report.display()),
        run::Outcome::Stopped(_) => {
            eprintln!("stopped with a good checkpoint: `brazilnut resume {}` goes on", out.display());
        }
    }
}

fn new(n: &New) -> Result<u8, Failure> {
    let Some(text) = crate::bundled::text(&n.from) else {
        let known = crate::bundled::names().collect::<Vec<_>>().join(", ");
        return Err(Failure::Usage(format!("there is no bundled case `{}` (there are: {known})", n.from)));
    };
    let path = Path::new(&n.name).with_extension("toml");
    if path.exists() {
        return Err(Failure::Usage(format!("{} exists already", path.display())));
    }
    std::fs::write(&path, text)
        .map_err(|e| Failure::Usage(format!("{} cannot be written: {e}", path.display())))?;
    eprintln!("{} written; `brazilnut check {0}` tells what it would do", path.display());
    Ok(0)
}

fn study(command: Study) -> Result<u8, Failure> {
    match command {
        Study::List => {
            print(&brazilnut_studies::list());
            Ok(0)
        }
        Study::Run { ids, all, quick, out, threads } => {
            brazilnut_runner::threads(threads.map(usize::from))?;
            brazilnut_studies::run(&ids, all, quick, &out)
        }
    }
}

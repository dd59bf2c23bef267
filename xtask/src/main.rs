//! The commands of a working day; CI runs `cargo xtask ci`.

use std::process::{Command, ExitCode};
use std::time::Instant;

/// Name, what it is for, the commands.
type Task = (&'static str, &'static str, &'static [&'static [&'static str]]);

/// In the order of `ci`; a command whose first word has a slash is a script, any other one of cargo.
const TASKS: &[Task] = &[
    ("fmt", "formatting is as rustfmt wants it", &[&["fmt", "--all", "--check"]]),
    ("lint", "clippy finds nothing", &[&["clippy", "--workspace", "--all-targets", "--", "-D", "warnings"]]),
    ("tidy", "the rules of the house", &[&["test", "--package", "brazilnut", "--test", "tidy"]]),
    ("test", "all tests", &[&["test", "--workspace"]]),
    (
        "docs",
        "the documentation builds without a warning, private items included",
        &[&["doc", "--workspace", "--no-deps", "--document-private-items"]],
    ),
    (
        "studies",
        "the published results in their short form",
        &[
            &["build", "--release", "--package", "brazilnut"],
            &[
                "run",
                "--release",
                "--package",
                "brazilnut",
                "--",
                "study",
                "run",
                "--all",
                "--quick",
                "--out",
                "target/studies",
            ],
        ],
    ),
    (
        "crash",
        "runs killed at random moments, or out of disk, resume to the same bytes",
        &[
            &["build", "--release", "--package", "brazilnut"],
            &["scripts/crash-test", "3"],
            &["scripts/full-disk-test"],
        ],
    ),
];

fn main() -> ExitCode {
    let wanted: Vec<String> = std::env::args().skip(1).collect();
    let all = wanted.iter().any(|w| w == "ci");
    let chosen: Vec<&Task> = TASKS.iter().filter(|t| all || wanted.iter().any(|w| w == t.0)).collect();
    if chosen.is_empty() {
        println!("cargo xtask TASK…, or `cargo xtask ci` for all of them in order:");
        for (name, what, _) in TASKS {
            println!("  {name:<8} {what}");
        }
        return ExitCode::from(2);
    }
    for (name, _, commands) in chosen {
        for args in *commands {
            let start = Instant::now();
            let mut command = if args[0].contains('/') {
                println!("--- {name}: {}", args.join(" "));
                let mut script = Command::new(args[0]);
                let _ = script.args(&args[1..]);
                script
            } else {
                println!("--- {name}: cargo {}", args.join(" "));
                let mut cargo = Command::new(env!("CARGO"));
                let _ = cargo.args(*args);
                cargo
            };
            if *name == "docs" {
                let _ = command.env("RUSTDOCFLAGS", "-D warnings");
            }
            match command.status() {
                Ok(s) if s.success() => {
                    println!("--- {name}: done in {:.0} s", start.elapsed().as_secs_f64())
                }
                Ok(s) => {
                    eprintln!("--- {name}: failed ({s})");
                    return ExitCode::FAILURE;
                }
                Err(e) => {
                    eprintln!("--- {name}: could not be started: {e}");
                    return ExitCode::FAILURE;
                }
            }
        }
    }
    ExitCode::SUCCESS
}

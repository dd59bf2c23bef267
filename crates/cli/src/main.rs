//! The brazilnut command.

mod arguments;
mod bundled;
mod commands;

use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = arguments::Arguments::parse();
    ExitCode::from(commands::execute(arguments))
}

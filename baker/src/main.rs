//! `welkin`: bakes sky texture packs, checks them and looks into them.
//!
//! Results go to standard output, progress and messages to standard error. Exit codes: 0 done, 1 something
//! went wrong (one line `error: ...` says what) or `check` found problems, 2 wrong usage or `check` could
//! not read the pack, 130 interrupted. Files and folders appear whole or not at all.

mod cli;

use std::process::ExitCode;

use clap::Parser;

fn main() -> ExitCode {
    cli::run(cli::Cli::parse())
}

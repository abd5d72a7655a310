//! `welkin view|render|bench`: another program's work, handed over as git does with its subcommands.
//!
//! Drawing needs wgpu, which this program does without. `welkin-view` is looked for beside this program
//! and then on PATH.

use std::ffi::OsString;
use std::io::{Error, ErrorKind};
use std::path::PathBuf;
use std::process::{Command, ExitCode};

use anyhow::{Result, anyhow};
use clap::Args;

const PROGRAM: &str = "welkin-view";

#[derive(Debug, Args)]
pub struct ViewArgs {
    /// Handed to welkin-view as they are
    #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
    pub args: Vec<OsString>,
}

/// Runs `welkin-view [subcommand] args...` in place of this program. Its exit code is ours.
pub fn run(subcommand: Option<&str>, args: &[OsString]) -> Result<ExitCode> {
    let program = beside_this_program().unwrap_or_else(|| PROGRAM.into());
    let mut command = Command::new(&program);
    command.args(subcommand).args(args);
    become_it(&mut command).map_err(|error| match error.kind() {
        ErrorKind::NotFound => anyhow!(
            "{PROGRAM} is not installed, and view, render and bench need it; install it \
             (in the source folder: cargo install --path viewer), or put it beside welkin or on PATH"
        ),
        _ => anyhow!("{}: cannot be started: {error}; install {PROGRAM} again", program.display()),
    })
}

fn beside_this_program() -> Option<PathBuf> {
    let name = format!("{PROGRAM}{}", std::env::consts::EXE_SUFFIX);
    let path = std::env::current_exe().ok()?.with_file_name(name);
    path.is_file().then_some(path)
}

/// On Unix the process is replaced, so signals and exit code need no forwarding.
#[cfg(unix)]
fn become_it(command: &mut Command) -> Result<ExitCode, Error> {
    use std::os::unix::process::CommandExt;
    Err(command.exec())
}

#[cfg(not(unix))]
fn become_it(command: &mut Command) -> Result<ExitCode, Error> {
    let code = command
        .status()?
        .code()
        .and_then(|code| u8::try_from(code).ok());
    Ok(ExitCode::from(code.unwrap_or(1)))
}

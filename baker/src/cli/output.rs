//! Standard output for results, standard error for everything else.

use std::io::{ErrorKind, Write};
use std::process::ExitCode;

use anyhow::{Result, anyhow};
use welkin_pack::shown;
use welkin_pack::whole::Leftover;

/// Writes a result. A reader that has gone away has seen enough: that is no error.
pub fn result(text: &str) -> Result<()> {
    let mut stdout = std::io::stdout().lock();
    match stdout
        .write_all(text.as_bytes())
        .and_then(|()| stdout.flush())
    {
        Err(e) if e.kind() == ErrorKind::BrokenPipe => Ok(()),
        written => written.map_err(|e| {
            anyhow!("standard output: cannot be written: {e}; make room where it goes")
        }),
    }
}

/// Writes a line to standard error, where names of files are quoted as texts of files are; if even that fails, there is
/// nobody left to tell.
pub fn message(text: &str) {
    writeln!(std::io::stderr(), "{}", shown(text)).ok();
}

/// Tells what lies beside the outputs and could not be removed.
pub fn leftovers(mut leftovers: Vec<Leftover>) {
    leftovers.sort();
    leftovers.dedup();
    leftovers
        .iter()
        .for_each(|leftover| message(&leftover.to_string()));
}

/// Writes `error: ...` and gives the exit code.
pub fn failure(text: &str, code: u8) -> ExitCode {
    message(&format!("error: {text}"));
    ExitCode::from(code)
}

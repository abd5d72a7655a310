//! `welkin-view`: the window with the sliders; draws and times the skies of Welkin packs.
//!
//! Exit codes: 0 done, 1 something went wrong (one line `error: ...` says what), 2 wrong usage,
//! 130 interrupted.

mod bench;
mod cli;
mod cube;
mod gpus;
mod look;
mod render;
mod save_light;
mod told;
#[cfg(feature = "window")]
mod window;

use std::io::Write;
use std::process::ExitCode;

use cli::{Cli, Command};
use told::told;
use welkin_pack::interrupt;

fn main() -> ExitCode {
    // Wrong usage and `--help` end here, as clap has them end.
    let cli = Cli::read(std::env::args_os()).unwrap_or_else(|e| e.exit());
    let done = match cli.command {
        Some(Command::Render(args)) => render::run(&args),
        Some(Command::Cube(args)) => cube::run(&args),
        Some(Command::Bench(args)) => bench::run(&args),
        Some(Command::Gpus) => gpus::run(),
        Some(Command::Look(args)) => look::run(&args),
        #[cfg(feature = "window")]
        None => window::run(&cli.window),
        #[cfg(not(feature = "window"))]
        None => Err(anyhow::anyhow!(
            "this welkin-view was built without its window; use `render`, `cube`, `bench` or `look`, or build it with `--features window`"
        )),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) if interrupt::requested() => failed(&told(&error), interrupt::EXIT_CODE),
        Err(error) => failed(&told(&error), 1),
    }
}

/// Says why on standard error, where a closed pipe is nobody's concern.
fn failed(message: &str, code: u8) -> ExitCode {
    writeln!(std::io::stderr(), "error: {message}").ok();
    ExitCode::from(code)
}

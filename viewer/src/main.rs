//! `welkin-view`: the window with the sliders; draws and times the skies of Welkin packs.
//!
//! Exit codes: 0 done, 1 something went wrong (one line `error: ...` says what), 2 wrong usage,
//! 130 interrupted.

mod bench;
mod cli;
mod cube;
mod gpus;
mod job;
mod look;
mod render;
mod sample;
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
    #[cfg(target_os = "linux")]
    without_session();
    // Wrong usage and `--help` end here, as clap has them end.
    let cli = Cli::read(std::env::args_os()).unwrap_or_else(|e| e.exit());
    let done = match cli.command {
        Some(Command::Render(args)) => render::run(&args),
        Some(Command::Sample(args)) => sample::run(&args),
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

/// Begins again without Mesa's Vulkan layer that orders devices by what a compositor tells, where there is no session to tell anything:
/// it would complain of that on standard error. What a person has told the layer itself stays in force.
#[cfg(target_os = "linux")]
fn without_session() {
    use std::os::unix::process::CommandExt;
    let told = [
        "XDG_RUNTIME_DIR",
        "NODEVICE_SELECT",
        "MESA_VK_DEVICE_SELECT",
    ];
    if told.iter().any(|name| std::env::var_os(name).is_some()) {
        return;
    }
    let mut words = std::env::args_os();
    if let (Ok(program), Some(name)) = (std::env::current_exe(), words.next()) {
        let mut again = std::process::Command::new(program);
        again.arg0(name).args(words).env("NODEVICE_SELECT", "1");
        // It comes back only where that fails; then all goes on as it would.
        let _failure = again.exec();
    }
}

/// Says why on standard error, where a closed pipe is nobody's concern.
fn failed(message: &str, code: u8) -> ExitCode {
    writeln!(std::io::stderr(), "error: {message}").ok();
    ExitCode::from(code)
}

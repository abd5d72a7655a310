//! The command line: every option with its range. Angles are in degrees here and nowhere else.

mod bench;
mod clear_sky;
mod clouds;
mod export;
mod lit;
mod render;
mod sprites;
mod values;
mod weather;
mod window;

use std::ffi::OsString;

use clap::error::ErrorKind;
use clap::parser::ValueSource;
use clap::{ArgMatches, CommandFactory, FromArgMatches, Parser, Subcommand};

pub use bench::{BenchArgs, Protocol};
pub use export::Shot;
pub use render::RenderArgs;
pub use window::WindowArgs;

/// Looks at the sky of a Welkin pack.
#[derive(Debug, Parser)]
#[command(name = "welkin-view", version, args_conflicts_with_subcommands = true)]
pub struct Cli {
    /// What to do
    #[command(subcommand)]
    pub command: Option<Command>,
    #[command(flatten)]
    pub window: WindowArgs,
}

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Draw without a window: a frame, an environment map, or a sequence of either, as PNG (8-bit sRGB), or EXR, HDR or KTX2 (linear radiance)
    Render(Box<RenderArgs>),
    /// Time each method's sky and two reference passes on the GPU
    Bench(BenchArgs),
}

impl Cli {
    /// Reads a command line, whose first word is the program's name.
    ///
    /// # Errors
    /// What clap finds wrong, and options that do not go together.
    pub fn read(
        words: impl IntoIterator<Item = impl Into<OsString> + Clone>,
    ) -> Result<Cli, clap::Error> {
        let mut command = Cli::command();
        let matches = command.try_get_matches_from_mut(words)?;
        let cli = Cli::from_arg_matches(&matches).map_err(|e| e.format(&mut command))?;
        let Some((name, given)) = matches.subcommand() else {
            return Ok(cli);
        };
        let agreed = match &cli.command {
            Some(Command::Render(args)) => args.refuse_others(given),
            Some(Command::Bench(args)) => args.refuse_others(),
            None => Ok(()),
        };
        agreed.map_err(|message| {
            let subcommand = command.find_subcommand_mut(name);
            subcommand.map_or_else(
                || clap::Error::raw(ErrorKind::ArgumentConflict, &message),
                |subcommand| subcommand.error(ErrorKind::ArgumentConflict, &message),
            )
        })?;
        Ok(cli)
    }
}

/// Whether an option stands on the command line.
fn is_given(given: &ArgMatches, option: &str) -> bool {
    given.value_source(option) == Some(ValueSource::CommandLine)
}

/// Says that an option is for another choice than the one that was made, and what to do.
fn belongs(option: &str, owner: &str, chosen: &str, remedy: &str) -> String {
    format!("--{option} belongs to {owner}, and {chosen} does not use it; leave it out or {remedy}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn a_pack_alone_asks_for_the_window() {
        let cli = Cli::read(["welkin-view", "packs/default"]).unwrap();
        assert!(cli.command.is_none() && cli.window.pack.is_some());
    }
}

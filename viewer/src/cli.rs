//! The command line: every option with its range. Angles are in degrees here and nowhere else.

mod clear_sky;
mod render;
mod values;

use std::ffi::OsString;
use std::path::PathBuf;

use clap::error::ErrorKind;
use clap::parser::ValueSource;
use clap::{ArgMatches, Args, CommandFactory, FromArgMatches, Parser, Subcommand, ValueEnum};
use welkin_runtime::Method;

pub use render::RenderArgs;
use values::size;

/// Looks at the sky of a Welkin pack.
#[derive(Debug, Parser)]
#[command(
    name = "welkin-view",
    version,
    arg_required_else_help = true,
    args_conflicts_with_subcommands = true
)]
pub struct Cli {
    /// What to do
    #[command(subcommand)]
    pub command: Option<Command>,
    /// Pack to look at in a window (not in this version: use `render`)
    pub pack: Option<PathBuf>,
}

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Draw one frame without a window, to a PNG (8-bit sRGB) or an EXR (linear radiance)
    Render(Box<RenderArgs>),
    /// Time each method's sky and two reference passes on the GPU
    Bench(BenchArgs),
}

#[derive(Debug, Args)]
pub struct BenchArgs {
    /// Folder of the pack
    pub pack: PathBuf,
    /// Pixels, width by height
    #[arg(long, value_name = "WxH", default_value = "1600x1200", value_parser = size, allow_hyphen_values = true)]
    pub size: [u32; 2],
    /// Whose skies are timed
    #[arg(long, value_enum, default_value_t = Methods::Packed)]
    pub method: Methods,
    /// Frames that are timed, after a warm-up
    #[arg(long, value_name = "N", default_value_t = 100, value_parser = clap::value_parser!(u32).range(1..=100_000), allow_negative_numbers = true)]
    pub frames: u32,
    /// Print JSON instead of a table
    #[arg(long)]
    pub json: bool,
}

/// The methods of a benchmark.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Methods {
    /// Roden and Parberry: one packed cloud texture
    Packed,
    /// Octaves of white noise, with the cost of each count
    Octaves,
    /// Octaves of smooth noise, with the cost of a sun that moves
    Fbm,
    /// Every method, in one table
    All,
}

impl Methods {
    /// Those that are meant.
    pub fn list(self) -> Vec<Method> {
        match self {
            Methods::Packed => vec![Method::Packed],
            Methods::Octaves => vec![Method::Octaves],
            Methods::Fbm => vec![Method::Fbm],
            Methods::All => Method::ALL.to_vec(),
        }
    }
}

impl Cli {
    /// Reads a command line, whose first word is the program's name.
    ///
    /// # Errors
    /// What clap finds wrong, and options that the chosen method does not know.
    pub fn read(
        words: impl IntoIterator<Item = impl Into<OsString> + Clone>,
    ) -> Result<Cli, clap::Error> {
        let mut command = Cli::command();
        let matches = command.try_get_matches_from_mut(words)?;
        let cli = Cli::from_arg_matches(&matches).map_err(|e| e.format(&mut command))?;
        if let (Some(Command::Render(args)), Some((name, given))) =
            (&cli.command, matches.subcommand())
        {
            args.refuse_others(given).map_err(|message| {
                let render = command.find_subcommand_mut(name);
                render.map_or_else(
                    || clap::Error::raw(ErrorKind::ArgumentConflict, &message),
                    |render| render.error(ErrorKind::ArgumentConflict, &message),
                )
            })?;
        }
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
        assert!(cli.command.is_none() && cli.pack.is_some());
    }

    #[test]
    fn a_benchmark_is_of_one_method_or_of_all() {
        let of = |words: &[&str]| {
            let all = ["welkin-view", "bench", "pack"].iter().chain(words);
            match Cli::read(all).map(|cli| cli.command) {
                Ok(Some(Command::Bench(args))) => args.method.list(),
                other => panic!("{words:?}: {other:?}"),
            }
        };
        assert_eq!(of(&[]), [Method::Packed]);
        assert_eq!(of(&["--method", "all"]), Method::ALL);
        for method in Method::ALL {
            assert_eq!(of(&["--method", method.name()]), [method]);
        }
        let error = Cli::read(["welkin-view", "bench", "pack", "--method", "sprites"]).unwrap_err();
        assert!(
            error.to_string().contains("packed, octaves, fbm, all"),
            "{error}"
        );
    }

    #[test]
    fn the_frames_of_a_benchmark_have_a_range() {
        for frames in ["0", "100001", "-1", "many"] {
            let error =
                Cli::read(["welkin-view", "bench", "pack", "--frames", frames]).unwrap_err();
            assert!(error.to_string().contains("--frames"), "{error}");
        }
    }
}

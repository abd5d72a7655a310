//! The command line: every option with its range. Angles are in degrees here and nowhere else.

mod bench;
mod cube;
mod export;
mod given;
mod gpu;
mod jobs;
mod look;
mod on_map;
mod render;
mod sample;
mod settings;
mod values;
mod window;

use std::ffi::OsString;

use clap::error::ErrorKind;
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};

pub use bench::{BenchArgs, Protocol};
pub use cube::CubeArgs;
pub use export::{Shot, equirect_width, side as verify_side, sides};
pub use jobs::Label;
pub use look::LookArgs;
pub use on_map::stray_on_map;
pub use render::RenderArgs;
pub use sample::SampleArgs;
pub use values::MAX_SIDE;
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
    /// Draw jobs for `render --jobs` from ranges of settings, weathers, dates and places: the same lines on every machine
    Sample(SampleArgs),
    /// Make image-based light of any panorama: a cube map with levels for rough surfaces, as KTX2, and the irradiance as nine spherical
    /// harmonics beside it, as JSON
    Cube(CubeArgs),
    /// Time each method's sky and two reference passes on the GPU
    Bench(BenchArgs),
    /// List the GPUs that can be drawn with, and what `--gpu` knows them by
    Gpus,
    /// Measure the structure of each method's clouds against photographs', and draw a page of its skies
    Look(LookArgs),
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
            Some(Command::Cube(_) | Command::Gpus | Command::Look(_) | Command::Sample(_))
            | None => Ok(()),
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }

    /// What is no number, or none that any option takes.
    const GARBAGE: [&str; 9] = [
        "x", "-x", "-inf", "inf", "nan", "-nan", "-", "1e999", "0x10",
    ];

    /// Every option that takes a value but names of files and words of a list.
    fn numeric(command: &clap::Command) -> Vec<String> {
        let takes_number = |arg: &&clap::Arg| {
            let is_path = arg.get_value_parser().type_id()
                == clap::builder::ValueParser::path_buf().type_id();
            arg.get_action().takes_values() && !is_path && arg.get_possible_values().is_empty()
        };
        let options = command.get_opts().filter(takes_number);
        options
            .filter_map(|arg| arg.get_long().map(str::to_string))
            .collect()
    }

    #[test]
    fn every_number_that_is_none_is_refused_with_what_was_expected() {
        let mut tried = 0;
        let mut command = Cli::command();
        // What they have of their own is known only then.
        command.build();
        let refused = |words: &[&str], option: &str| {
            for text in GARBAGE {
                let option = format!("--{option}");
                let words = [words, &[&option, text]].concat();
                let error = Cli::read(words).unwrap_err().to_string();
                let told = error.lines().next().unwrap_or_default();
                assert!(
                    told.contains(&format!("'{text}' for '{option} ")) && told.contains("expected"),
                    "{option} {text}: {error}"
                );
            }
        };
        for option in numeric(&command) {
            refused(&["welkin-view"], &option);
            tried += 1;
        }
        for (name, words) in [
            ("render", &["welkin-view", "render", "p", "-o", "f.png"][..]),
            (
                "cube",
                &["welkin-view", "cube", "p.hdr", "-o", "c.ktx2"][..],
            ),
            ("bench", &["welkin-view", "bench", "p"][..]),
        ] {
            let options = numeric(command.find_subcommand(name).unwrap());
            options.iter().for_each(|option| refused(words, option));
            tried += options.len();
        }
        assert!(tried > 40, "{tried}");
    }

    #[test]
    fn a_pack_alone_asks_for_the_window() {
        let cli = Cli::read(["welkin-view", "packs/default"]).unwrap();
        assert!(cli.command.is_none() && cli.window.pack.is_some());
    }
}

//! The command line of `welkin`: what there is to say, and who does it.

mod bake;
mod check;
mod file;
mod font;
mod handover;
mod info;
mod input;
mod interrupt;
mod model;
mod output;
mod page;
mod photo;
mod picture;
mod preview;
mod sheet;
mod side;
mod unpack;

use std::ffi::OsString;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, Parser, Subcommand};

/// Bakes sky texture packs, checks them and looks into them.
#[derive(Debug, Parser)]
#[command(name = "welkin", version, arg_required_else_help = true)]
pub struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Bake a pack from a recipe, or from the built-in one
    Bake(BakeArgs),
    /// Validate a pack, or a texture before it is in one: exit code 0 sound, 1 problems found, 2 cannot be read
    Check(CheckArgs),
    /// Tell what is in a pack: textures, channels, bytes, hashes
    Info(PackArgs),
    /// Draw every channel of every texture on one labelled sheet
    Preview(PreviewArgs),
    /// Write one grey image a channel: ROLE.CHANNEL.png or ROLE.LAYER.CHANNEL.png, .exr for floats
    Unpack(UnpackArgs),
    /// Make a photograph into a seamless cloud channel
    Photo(PhotoArgs),
    /// Write a cloud of the field as a model: every sprite a node, to be edited and baked again
    Model(ModelArgs),
    /// Look at a pack in a window (needs welkin-view)
    #[command(disable_help_flag = true)]
    View(ViewArgs),
    /// Draw one frame to a picture (needs welkin-view)
    #[command(disable_help_flag = true)]
    Render(ViewArgs),
    /// Time the sky on the GPU (needs welkin-view)
    #[command(disable_help_flag = true)]
    Bench(ViewArgs),
}

#[derive(Debug, Args)]
struct BakeArgs {
    /// Recipe in TOML; without it the built-in recipe is baked
    recipe: Option<PathBuf>,
    /// Folder to make; missing folders above it are made too
    #[arg(short, long, value_name = "PACK")]
    output: PathBuf,
    /// Seed of every random stream, instead of the recipe's
    #[arg(long, value_name = "N", value_parser = seed, allow_hyphen_values = true)]
    seed: Option<u64>,
    /// Threads to use, 1 to 1024; the bytes are the same with any number [default: one a core]
    #[arg(long, value_name = "N", value_parser = threads, allow_hyphen_values = true)]
    threads: Option<u16>,
    /// Replace a pack that is there already, and the folders of --png and --exr; a folder with anything else in it is kept
    #[arg(long)]
    force: bool,
    /// Also write every channel as it is stored: one 8-bit image each, in a new folder
    #[arg(long, value_name = "DIR")]
    png: Option<PathBuf>,
    /// Also write every channel before it is quantised: one float image each, in a new folder
    #[arg(long, value_name = "DIR")]
    exr: Option<PathBuf>,
}

#[derive(Debug, Args)]
struct PackArgs {
    /// Folder of the pack
    pack: PathBuf,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Args)]
struct CheckArgs {
    /// Folder of the pack; with --as a PNG, OpenEXR or KTX2 file
    #[arg(value_name = "PACK")]
    path: PathBuf,
    /// Print JSON
    #[arg(long)]
    json: bool,
    /// Also bake the pack's recipe anew and compare every texel: proof, not statistics
    #[arg(long)]
    rebake: bool,
    /// For --rebake: the photograph of clouds that the recipe names
    #[arg(long, value_name = "FILE", requires = "rebake")]
    photo: Option<PathBuf>,
    /// For --rebake: another file that the recipe names, by its key, such as skybox.file=sky.exr; once for each
    #[arg(long, value_name = "KEY=FILE", requires = "rebake", value_parser = check::parse_input)]
    input: Vec<(String, OsString)>,
    /// Also write a page to look at: every channel beside what was found in it; a file of that name is replaced
    #[arg(long, value_name = "FILE.html")]
    html: Option<PathBuf>,
    /// Check a texture that is in no pack: a role such as clouds or stars, or one channel such as clouds.noise
    #[arg(long = "as", value_name = "ROLE", conflicts_with = "rebake", value_parser = check::parse_as)]
    role: Option<check::As>,
}

#[derive(Debug, Args)]
struct PreviewArgs {
    /// Folder of the pack
    pack: PathBuf,
    /// PNG to write; a file of that name is replaced
    #[arg(short, long, value_name = "FILE.png")]
    output: PathBuf,
}

#[derive(Debug, Args)]
struct UnpackArgs {
    /// Folder of the pack
    pack: PathBuf,
    /// Folder to make; one that is there must be empty
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
}

#[derive(Debug, Args)]
struct PhotoArgs {
    /// Photograph of thin clouds, PNG or JPEG
    image: PathBuf,
    /// 8-bit grey PNG to write; a file of that name is replaced
    #[arg(short, long, value_name = "TILE.png")]
    output: PathBuf,
}

#[derive(Debug, Args)]
struct ModelArgs {
    /// Folder of the pack
    pack: PathBuf,
    /// Number of the cloud in the field, from 0, in the order of their ranks
    #[arg(long, value_name = "N", default_value_t = 0)]
    cloud: usize,
    /// Binary glTF to write; a file of that name is replaced
    #[arg(short, long, value_name = "CLOUD.glb")]
    output: PathBuf,
}

#[derive(Debug, Args)]
struct ViewArgs {
    /// Handed to welkin-view as they are
    #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
    args: Vec<OsString>,
}

/// More than any machine has today.
const MOST_THREADS: u16 = 1024;

fn seed(text: &str) -> Result<u64, String> {
    text.parse()
        .map_err(|_| format!("expected a whole number from 0 to {}", u64::MAX))
}

fn threads(text: &str) -> Result<u16, String> {
    match text.parse() {
        Ok(count) if (1..=MOST_THREADS).contains(&count) => Ok(count),
        _ => Err(format!("expected a whole number from 1 to {MOST_THREADS}")),
    }
}

/// Does what the command line says and tells how it went.
pub fn run(cli: Cli) -> ExitCode {
    let done = match cli.command {
        // These become another program, which has its own way with signals.
        Command::View(args) => handover::run(None, &args.args),
        Command::Render(args) => handover::run(Some("render"), &args.args),
        Command::Bench(args) => handover::run(Some("bench"), &args.args),
        Command::Check(args) => return check::run(&args),
        Command::Info(args) => info::run(&args),
        other => interrupt::listen().and_then(|()| make(other)),
    };
    match done {
        Ok(code) => code,
        Err(_) if interrupt::requested() => {
            output::message("interrupted; nothing was written");
            ExitCode::from(interrupt::EXIT_CODE)
        }
        Err(error) => output::failure(&error.to_string(), 1),
    }
}

/// The commands that write files.
fn make(command: Command) -> anyhow::Result<ExitCode> {
    match command {
        Command::Bake(args) => bake::run(&args)?,
        Command::Preview(args) => preview::run(&args)?,
        Command::Unpack(args) => unpack::run(&args)?,
        Command::Photo(args) => photo::run(&args)?,
        Command::Model(args) => model::run(&args)?,
        _ => {}
    }
    Ok(ExitCode::SUCCESS)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_that_are_none_are_refused_with_what_was_expected() {
        for option in ["--threads", "--seed"] {
            for text in ["x", "-x", "-inf", "inf", "nan", "-1", "1.5", "-", "1e999"] {
                let words = ["welkin", "bake", "-o", "p", option, text];
                let error = Cli::try_parse_from(words).unwrap_err().to_string();
                assert!(
                    error.contains(&format!(
                        "'{text}' for '{option} <N>': expected a whole number from"
                    )),
                    "{error}"
                );
            }
        }
        let none = ["welkin", "bake", "-o", "p", "--threads", "0"];
        assert!(Cli::try_parse_from(none).is_err());
    }

    #[test]
    fn the_command_line_is_consistent() {
        <Cli as clap::CommandFactory>::command().debug_assert();
    }
}

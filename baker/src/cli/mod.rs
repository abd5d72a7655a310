//! The command line of `welkin`: what there is to say, and who does it.

mod bake;
mod check;
mod font;
mod handover;
mod info;
mod interrupt;
mod model;
mod output;
mod photo;
mod picture;
mod preview;
mod sheet;
mod side;
mod unpack;
mod whole;

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
    /// Validate a pack: exit code 0 sound, 1 problems found, 2 cannot be read
    Check(PackArgs),
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
    #[arg(long, value_name = "N", value_parser = seed, allow_negative_numbers = true)]
    seed: Option<u64>,
    /// Threads to use, 1 to 1024; the bytes are the same with any number [default: one a core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024), allow_negative_numbers = true)]
    threads: Option<u16>,
    /// Replace a pack that is there already, and the folders of --png and --exr
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
    /// Folder to make; it must not be there yet
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

fn seed(text: &str) -> Result<u64, String> {
    text.parse()
        .map_err(|_| format!("expected a whole number from 0 to {}", u64::MAX))
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
    fn the_command_line_is_consistent() {
        <Cli as clap::CommandFactory>::command().debug_assert();
    }
}

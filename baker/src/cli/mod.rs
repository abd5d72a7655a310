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
mod photo_sheet;
mod picture;
mod preview;
mod sheet;
mod side;
mod sky;
mod unpack;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

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
    Bake(bake::BakeArgs),
    /// Validate a pack, or a texture before it is in one: exit code 0 sound, 1 problems found, 2 cannot be read
    Check(check::CheckArgs),
    /// Tell what is in a pack: textures, channels, bytes, hashes
    Info(info::PackArgs),
    /// Draw every channel of every texture on one labelled sheet
    Preview(preview::PreviewArgs),
    /// Write one grey image a channel: ROLE.CHANNEL.png or ROLE.LAYER.CHANNEL.png, .exr for floats
    Unpack(unpack::UnpackArgs),
    /// Make a photograph into a seamless cloud channel
    Photo(photo::PhotoArgs),
    /// Write a cloud of the field as a model: every sprite a node, to be edited and baked again
    Model(model::ModelArgs),
    /// Look at a pack in a window (needs welkin-view)
    #[command(disable_help_flag = true)]
    View(handover::ViewArgs),
    /// Draw one frame to a picture (needs welkin-view)
    #[command(disable_help_flag = true)]
    Render(handover::ViewArgs),
    /// Time the sky on the GPU (needs welkin-view)
    #[command(disable_help_flag = true)]
    Bench(handover::ViewArgs),
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
        other => interrupt::listen()
            .map_err(Into::into)
            .and_then(|()| make(other)),
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

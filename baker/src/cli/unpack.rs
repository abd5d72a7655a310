//! `welkin unpack`: one grey image a channel and layer, from level 0 of every texture.

use std::path::PathBuf;

use anyhow::Result;
use clap::Args;
use welkin_pack::place::verify_apart;
use welkin_pack::whole::Folder;
use welkin_pack::{Format, Role};

use super::side::{self, Kind};
use super::{input, output};

#[derive(Debug, Args)]
pub struct UnpackArgs {
    /// Folder of the pack
    pack: PathBuf,
    /// Folder to make; one that is there must be empty
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
}

pub fn run(args: &UnpackArgs) -> Result<()> {
    verify_apart(&[&args.pack], &[&args.output])?;
    let pack = input::pack(&args.pack)?;
    let folder = Folder::begin(&args.output, None)?;
    for role in Role::ALL {
        let Some(texture) = pack.texture(role) else {
            continue;
        };
        let kind = match texture.format {
            Format::Rgba16Float => Kind::Exr,
            Format::R8Unorm | Format::Rg8Unorm | Format::Rgba8Unorm => Kind::Png,
        };
        side::add(&folder, role, &side::images(texture), kind)?;
    }
    output::leftovers(folder.publish()?);
    Ok(())
}

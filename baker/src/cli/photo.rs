//! `welkin photo`: a photograph made into a seamless cloud channel, with the default recipe's settings.

use std::path::PathBuf;

use anyhow::Result;
use clap::Args;
use image::ExtendedColorType;
use welkin_baker::{Recipe, photo_channel, read_photo};
use welkin_pack::texture::unorm8;

use super::{file, interrupt, picture};

#[derive(Debug, Args)]
pub struct PhotoArgs {
    /// Photograph of thin clouds, PNG or JPEG
    image: PathBuf,
    /// 8-bit grey PNG to write; a file of that name is replaced
    #[arg(short, long, value_name = "TILE.png")]
    output: PathBuf,
}

pub fn run(args: &PhotoArgs) -> Result<()> {
    file::verify_png(&args.output, &args.image)?;
    let name = args.image.display().to_string();
    let settings = Recipe::default().resolve(None)?.clouds.photo;
    let image = args.image.clone();
    let bytes = interrupt::unless_requested(move || read_photo(&image))??;
    let tile = photo_channel(&bytes, &name, &settings)?;
    let grey: Vec<u8> = tile.texels.iter().copied().map(unorm8).collect();
    file::write(
        &args.output,
        &picture::png(tile.width, tile.height, ExtendedColorType::L8, &grey)?,
    )
}

//! `welkin photo`: a photograph made into a seamless cloud channel, with the default recipe's settings.

use anyhow::Result;
use image::ExtendedColorType;
use welkin_baker::{Recipe, photo_channel, read_photo};
use welkin_pack::texture::unorm8;

use super::PhotoArgs;
use super::{interrupt, picture, whole};

pub fn run(args: &PhotoArgs) -> Result<()> {
    let name = args.image.display().to_string();
    let settings = Recipe::default().resolve(None)?.clouds.photo;
    let bytes = read_photo(&args.image)?;
    let tile = photo_channel(&bytes, &name, &settings)?;
    interrupt::stop_if_requested()?;
    let grey: Vec<u8> = tile.texels.iter().copied().map(unorm8).collect();
    whole::write_file(
        &args.output,
        &picture::png(tile.width, tile.height, ExtendedColorType::L8, &grey)?,
    )
}

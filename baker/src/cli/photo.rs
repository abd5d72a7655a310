//! `welkin photo`: a photograph made into a seamless cloud channel, with the default recipe's settings.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use anyhow::{Result, anyhow, bail};
use image::ExtendedColorType;
use welkin_baker::{Recipe, photo_channel};
use welkin_pack::texture::unorm8;

use super::PhotoArgs;
use super::{interrupt, picture, whole};

/// What a camera writes is far smaller; what is larger may have no end.
const MAX_PHOTO_BYTES: u64 = 256 << 20;

pub fn run(args: &PhotoArgs) -> Result<()> {
    let name = args.image.display().to_string();
    let settings = Recipe::default().resolve(None)?.clouds.photo;
    let bytes = read(&args.image)?;
    let tile = photo_channel(&bytes, &name, &settings)?;
    interrupt::stop_if_requested()?;
    let grey: Vec<u8> = tile.texels.iter().copied().map(unorm8).collect();
    whole::write_file(
        &args.output,
        &picture::png(tile.width, tile.height, ExtendedColorType::L8, &grey)?,
    )
}

fn read(path: &Path) -> Result<Vec<u8>> {
    let name = path.display();
    let unreadable = |e| anyhow!("{name}: cannot be read: {e}; expected a PNG or JPEG file");
    let mut bytes = Vec::new();
    let file = File::open(path).map_err(unreadable)?;
    file.take(MAX_PHOTO_BYTES + 1)
        .read_to_end(&mut bytes)
        .map_err(unreadable)?;
    if bytes.len() as u64 > MAX_PHOTO_BYTES {
        bail!("{name}: is larger than {MAX_PHOTO_BYTES} bytes; save it smaller");
    }
    Ok(bytes)
}

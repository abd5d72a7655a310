//! `welkin photo`: a photograph made into a seamless cloud channel, with the default recipe's settings.

use std::path::PathBuf;

use anyhow::Result;
use clap::Args;
use image::ExtendedColorType;
use welkin_baker::{PhotoFile, PhotoTile, Recipe, photo_tile, read_photo};
use welkin_pack::texture::unorm8;

use super::{file, interrupt, output, picture};

#[derive(Debug, Args)]
pub struct PhotoArgs {
    /// Photograph of thin clouds: PNG, JPEG, TIFF, WebP, Radiance HDR or OpenEXR
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
    let photograph = PhotoFile {
        name: &name,
        bytes: &bytes,
    };
    let tile = photo_tile(photograph, None, &settings)?;
    if let Some(note) = unused(&tile) {
        output::message(&format!("{name}: {note}"));
    }
    let tile = tile.channel;
    let grey: Vec<u8> = tile.texels.iter().copied().map(unorm8).collect();
    file::write(
        &args.output,
        &picture::png(tile.width, tile.height, ExtendedColorType::L8, &grey)?,
    )
}

/// What of the photograph is not in the tile.
fn unused(tile: &PhotoTile) -> Option<String> {
    let ([width, height], [x, y, columns, rows]) = (tile.size, tile.region);
    if [columns, rows] == [width, height] {
        return None;
    }
    let share = f64::from(columns) * f64::from(rows) / (f64::from(width) * f64::from(height));
    Some(format!(
        "used {columns}x{rows} at {x}, {y} of {width}x{height}, {:.0} %",
        100.0 * share
    ))
}

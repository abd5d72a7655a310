//! `welkin photo`: a photograph made into a seamless cloud channel, with the settings of a recipe or of the default one.

use std::path::{Path, PathBuf};

use anyhow::{Result, anyhow};
use clap::Args;
use image::ExtendedColorType;
use welkin_baker::{
    BUILT_IN_PHOTO, PhotoFile, PhotoSettings, PhotoTile, Recipe, built_in_photo, photo_tile,
    read_photo,
};
use welkin_pack::place::verify_apart;
use welkin_pack::texture::unorm8;

use super::{file, input, interrupt, output, photo_sheet, picture};

#[derive(Debug, Args)]
pub struct PhotoArgs {
    /// Photograph of clouds: PNG, JPEG, TIFF, WebP, Radiance HDR or OpenEXR; that of the recipe if left out
    #[arg(required_unless_present = "recipe")]
    image: Option<PathBuf>,
    /// Recipe whose [clouds.photo] is used
    #[arg(short, long, value_name = "RECIPE.toml")]
    recipe: Option<PathBuf>,
    /// 8-bit grey PNG to write; a file of that name is replaced
    #[arg(
        short,
        long,
        value_name = "TILE.png",
        required_unless_present = "sheet"
    )]
    output: Option<PathBuf>,
    /// Sheet to write: photograph with the part that is used, plan, tile, four tiles, histogram; a file of that name is replaced
    #[arg(short, long, value_name = "SHEET.png")]
    sheet: Option<PathBuf>,
}

pub fn run(args: &PhotoArgs) -> Result<()> {
    let recipe = match &args.recipe {
        Some(path) => input::recipe(path)?,
        None => Recipe::default(),
    };
    let settings = recipe.resolve(None)?.clouds.photo;
    let folder = args.recipe.as_deref().and_then(Path::parent);
    let beside = |file: &String| folder.map_or(PathBuf::from(file), |folder| folder.join(file));
    let of_recipe = settings.file.as_ref().map(beside);
    let mask = settings.mask.as_ref().map(beside);
    verify_places(args, [&args.image, &of_recipe, &mask, &args.recipe])?;
    let image = args.image.clone().or(of_recipe);
    let name = image.as_ref().map(|image| image.display().to_string());
    let tile = made(image, mask, &settings)?;
    if let Some(note) = unused(&tile) {
        output::message(&format!(
            "{}: {note}",
            name.as_deref().unwrap_or(BUILT_IN_PHOTO)
        ));
    }
    // Both are there before either is written.
    let grey: Vec<u8> = tile.channel.texels.iter().copied().map(unorm8).collect();
    let size = tile.channel.width;
    let grey = picture::png(size, size, ExtendedColorType::L8, &grey)?;
    if let Some(path) = &args.sheet {
        file::write(path, &photo_sheet::png(&tile, &settings)?)?;
    }
    match &args.output {
        Some(path) => file::write(path, &grey),
        None => Ok(()),
    }
}

/// Nothing that is named to be read is written over, nor one output over the other.
fn verify_places(args: &PhotoArgs, read: [&Option<PathBuf>; 4]) -> Result<()> {
    let read: Vec<&Path> = read.into_iter().flatten().map(PathBuf::as_path).collect();
    let outputs = || {
        [&args.output, &args.sheet]
            .into_iter()
            .flatten()
            .map(PathBuf::as_path)
    };
    for output in outputs() {
        file::verify_png_name(output)?;
    }
    Ok(verify_apart(&read, &outputs().collect::<Vec<&Path>>())?)
}

fn made(
    image: Option<PathBuf>,
    mask: Option<PathBuf>,
    settings: &PhotoSettings,
) -> Result<PhotoTile> {
    let read = |path: PathBuf| -> Result<(String, Vec<u8>)> {
        let name = path.display().to_string();
        Ok((
            name,
            interrupt::unless_requested(move || read_photo(&path))??,
        ))
    };
    let (image, mask) = (image.map(read).transpose()?, mask.map(read).transpose()?);
    let picture = match (&image, built_in_photo()) {
        (Some((name, bytes)), _) => PhotoFile { name, bytes },
        (None, Some(bytes)) => PhotoFile {
            name: BUILT_IN_PHOTO,
            bytes,
        },
        (None, None) => {
            return Err(anyhow!(
                "{BUILT_IN_PHOTO}: is not compiled in; name a photograph"
            ));
        }
    };
    let mask = mask.as_ref().map(|(name, bytes)| PhotoFile { name, bytes });
    Ok(photo_tile(picture, mask, settings)?)
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

//! Pictures instead of noise: one of all cells, or one a cell.

use welkin_pack::{Image, SheetCell};

use crate::error::{BakeError, unfit, unfit_size};
use crate::filter;
use crate::inputs::{Named, Picture, Reader};
use crate::load::{self, MAX_FILE_BYTES, MAX_RADIANCE};
use crate::settings::{SpriteSource, SpritesSettings};

/// Sides that a cell may have in a picture, in texels.
const CELL_SIDE: [u32; 2] = [32, 1024];

/// Opacity that the outermost texels of a cell may have: they are cut off, and less is hardly seen.
const MOST_BORDER: f32 = 0.05;

/// Luminance of linear BT.709 (ITU-R BT.709-6, item 3.2).
const LUMINANCE: [f32; 3] = [0.2126, 0.7152, 0.0722];

/// The files that the settings name, in the order of the cells.
pub(crate) fn files(settings: &SpritesSettings) -> Vec<Named> {
    let named = |key: String, file: &str| Named::new(key, file, MAX_FILE_BYTES);
    match &settings.source {
        SpriteSource::Noise(_) => Vec::new(),
        SpriteSource::Sheet(file) => vec![named("sprites.file".to_string(), file)],
        SpriteSource::Cells(files) => {
            let files = files.iter().enumerate();
            let named = files.map(|(cell, file)| named(format!("sprites.pictures[{cell}]"), file));
            named.collect()
        }
    }
}

/// A picture a cell, `side` texels a side: luminance times opacity, and opacity.
pub(super) fn cells(files: &[Named], reader: &Reader, side: u32) -> Result<Vec<Image>, BakeError> {
    let mut cells = Vec::new();
    for named in files {
        let a_side = if files.len() == 1 {
            SheetCell::A_SIDE
        } else {
            1
        };
        let picture = reader.read(named)?;
        let decoded = decode(&picture, a_side)?;
        for index in 0..a_side * a_side {
            let cell = cut(&decoded, a_side, [index % a_side, index / a_side]);
            let name = if a_side > 1 {
                format!(" in cell {index}")
            } else {
                String::new()
            };
            verify(&picture.file, &name, &cell)?;
            cells.push(resampled(&cell, side));
        }
    }
    Ok(cells)
}

/// Luminance times opacity, and opacity, of a square picture of `a_side` cells a side.
fn decode(picture: &Picture, a_side: u32) -> Result<Image, BakeError> {
    let [least, most] = CELL_SIDE.map(|side| side * a_side);
    let decoded = load::decode_sky(picture, &|width, height| {
        let is_fit = width % a_side == 0 && (least..=most).contains(&width);
        if width == height && is_fit {
            return Ok(());
        }
        let cells = match a_side {
            1 => String::new(),
            _ => format!(", {a_side}x{a_side} cells of whole texels"),
        };
        let sides = format!("{least} to {most} texels a side");
        let expected = format!("a square of {sides}{cells}; crop or resize it");
        Err(unfit_size(&picture.file, [width, height], expected))
    })?;
    let mut image = Image::new(decoded.width, decoded.height, 2);
    let texels = image.texels.chunks_exact_mut(2);
    for (texel, from) in texels.zip(decoded.texels.chunks_exact(4)) {
        let weighted = LUMINANCE.iter().zip(from).map(|(w, v)| w * v);
        let light = weighted.sum::<f32>().min(MAX_RADIANCE);
        texel.copy_from_slice(&[light, from[3]]);
    }
    Ok(image)
}

fn cut(picture: &Image, a_side: u32, place: [u32; 2]) -> Image {
    let side = picture.width / a_side;
    let [left, top] = place.map(|i| i * side);
    let mut cell = Image::new(side, side, 2);
    for (y, x) in (0..side).flat_map(|y| (0..side).map(move |x| (y, x))) {
        cell.texel_mut(x, y)
            .copy_from_slice(picture.texel(left + x, top + y));
    }
    cell
}

/// A picture must show something, and have ended before its border.
fn verify(file: &str, name: &str, cell: &Image) -> Result<(), BakeError> {
    let last = cell.width - 1;
    let along = (0..=last).flat_map(|i| [[i, 0], [i, last], [0, i], [last, i]]);
    let border = along.map(|[x, y]| cell.texel(x, y)[1]).fold(0.0, f32::max);
    if border > MOST_BORDER {
        return Err(unfit(
            file,
            "largest alpha along the border",
            format!("{border:.2}{name}"),
            format!("at most {MOST_BORDER}: a cloud that ends inside of the picture, on nothing"),
        ));
    }
    let (opacity, _) = cell.mean_and_spread(1);
    let [least, most] = SheetCell::OPACITY;
    if !(least..=most).contains(&opacity) {
        return Err(unfit(
            file,
            "mean alpha",
            format!("{opacity:.3}{name}"),
            format!("{least} to {most:.3}: something to see, and no more than a disc"),
        ));
    }
    Ok(())
}

fn resampled(cell: &Image, side: u32) -> Image {
    if cell.width == side {
        return cell.clone();
    }
    let [light, alpha] = [0, 1].map(|channel| {
        let plane = filter::plane(cell.width, cell.width, |x, y| cell.texel(x, y)[channel]);
        filter::resample(&plane, side, side)
    });
    let mut image = Image::new(side, side, 2);
    let texels = image.texels.chunks_exact_mut(2);
    for (texel, (light, alpha)) in texels.zip(light.texels.iter().zip(&alpha.texels)) {
        // The filter overshoots a little at edges.
        texel.copy_from_slice(&[light.max(0.0), alpha.clamp(0.0, 1.0)]);
    }
    image
}

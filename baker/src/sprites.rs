//! The sheet of cloud sprites: fog, wisps, puffs, and one puff with a flat bottom.
//!
//! # Theory
//! N. Wang, "Let There Be Clouds! Fast, Realistic Cloud-Rendering in Microsoft Flight Simulator 2004: A Century of
//! Flight", Game Developer, 2004, figure 3: clouds are dozens of sprites over each other, so what looks like a cloud is in
//! the pictures, "interesting features inside the textures that resemble eddies and wisps".
//!
//! # Changes versus the paper
//! - The pictures are not painted: each is a small cloud of noise, and a ray through every texel tells its opacity and the
//!   light that it scatters (`march.rs`).
//! - No colour: the bluish grey of fog is a constant, [`SheetKind::tint`]. In its place light by side (`lights.rs`): from the front; from the
//!   right and left, and from the top and bottom, as what they are more or less than the mean of both; from the back it follows opacity.
//! - A recipe may name pictures instead (`pictures.rs`).
//!
//! The noise repeats in small volumes that all share; each cell has a random stream of its own, such as `sprites.12`, for
//! its shape and its place in them.

mod lights;
mod march;
mod pictures;
mod puff;
mod shade;
mod veil;
mod volume;

use welkin_pack::{Image, SheetCell, SheetKind};

use crate::error::BakeError;
use crate::inputs::Reader;
use crate::settings::{SpriteShape, SpriteSource, SpritesSettings};
use crate::stream::Stream;
use march::picture;
pub(crate) use pictures::files;
pub(crate) use puff::FLOOR;
use puff::Puff;
use veil::{Fog, Wisp};
use volume::{Volume, Volumes};

/// Standard deviation of the grey. Fog has hardly any relief, or a layer of it would look like a heap.
const RELIEF_FOG: f32 = 0.025;
const RELIEF_WISP: f32 = 0.07;
const RELIEF_PUFF: f32 = 0.13;

/// The sheet: grey, opacity, and what light from the right and from the top is more than from the other side.
pub(crate) fn image(
    settings: &SpritesSettings,
    reader: &Reader,
    seed: u64,
) -> Result<Image, BakeError> {
    let side = settings.size / SheetCell::A_SIDE;
    let cells = match &settings.source {
        SpriteSource::Noise(shape) => noise(shape, settings.contrast, side, seed),
        SpriteSource::Sheet(_) | SpriteSource::Cells(_) => {
            let cells = pictures::cells(&files(settings), reader, side)?.into_iter();
            cells
                .map(|cell| shade::level(&shade::relative(&cell, settings.contrast)))
                .collect()
        }
    };
    Ok(sheet(&cells))
}

/// A picture of noise a cell.
fn noise(shape: &SpriteShape, contrast: f32, side: u32, seed: u64) -> Vec<Image> {
    let gradients = Volume::gradients(&mut Stream::new(seed, "sprites.gradients"));
    let lumps = Volume::lumps(&gradients, &mut Stream::new(seed, "sprites.lumps"));
    let volumes = Volumes { gradients, lumps };
    let cells = (0..SheetCell::COUNT).map(|index| {
        let mut stream = Stream::new(seed, &format!("sprites.{index}"));
        let (picture, relief) = cell(&volumes, shape, SheetCell(index), side, &mut stream);
        shade::sides(&picture, contrast * relief)
    });
    cells.collect()
}

/// What [`picture`] makes of it, and the relief that it is to have.
fn cell(
    volumes: &Volumes,
    shape: &SpriteShape,
    cell: SheetCell,
    side: u32,
    stream: &mut Stream,
) -> (Image, f32) {
    match cell.kind() {
        SheetKind::Foggy => (picture(&Fog::new(volumes, shape, stream), side), RELIEF_FOG),
        SheetKind::Wispy => {
            let wisp = Wisp::new(volumes, shape, stream);
            (picture(&wisp, side), RELIEF_WISP)
        }
        kind @ (SheetKind::FlatBottomed | SheetKind::Puffy) => {
            let is_flat = kind == SheetKind::FlatBottomed;
            let puff = Puff::new(volumes, shape, is_flat, stream);
            (picture(&puff, side), RELIEF_PUFF)
        }
    }
}

/// The cells on one sheet, the outermost texels of each transparent.
fn sheet(cells: &[Image]) -> Image {
    let side = cells[0].width;
    let size = side * SheetCell::A_SIDE;
    let mut sheet = Image::new(size, size, 4);
    for (index, cell) in (0..).zip(cells) {
        let [left, top] = SheetCell(index).place().map(|i| i * side);
        for (y, x) in (0..side).flat_map(|y| (0..side).map(move |x| (y, x))) {
            let texel = sheet.texel_mut(left + x, top + y);
            texel.copy_from_slice(cell.texel(x, y));
            if [x, y].iter().any(|i| [0, side - 1].contains(i)) {
                texel[1] = 0.0;
            }
        }
    }
    sheet
}

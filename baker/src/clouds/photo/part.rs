//! Which part of a photograph becomes the tile.

use welkin_pack::Image;

use crate::error::{BakeError, unfit};
use crate::filter;
use crate::settings::PhotoRegion;

/// The square that is used, as left, top, width and height.
pub(super) fn square(
    region: &PhotoRegion,
    picture: &Image,
    file: &str,
) -> Result<[u32; 4], BakeError> {
    whole(region, picture, file).map(middle)
}

/// All that may be used.
pub(super) fn whole(
    region: &PhotoRegion,
    picture: &Image,
    file: &str,
) -> Result<[u32; 4], BakeError> {
    let PhotoRegion::Part(part) = region else {
        return Ok([0, 0, picture.width, picture.height]);
    };
    let [left, top, width, height] = part.map(u64::from);
    if left + width <= picture.width.into() && top + height <= picture.height.into() {
        return Ok(*part);
    }
    let found = format!("{width}x{height} at {left}, {top}");
    let expected = format!(
        "within the {}x{} of the picture; change `clouds.photo.region`",
        picture.width, picture.height
    );
    Err(unfit(file, "region", found, expected))
}

/// The largest square in the middle.
fn middle([left, top, width, height]: [u32; 4]) -> [u32; 4] {
    let side = width.min(height);
    [
        left + (width - side) / 2,
        top + (height - side) / 2,
        side,
        side,
    ]
}

/// A part of one channel.
pub(super) fn cut(picture: &Image, [left, top, width, height]: [u32; 4], channel: usize) -> Image {
    filter::plane(width, height, |x, y| {
        picture.texels[picture.index(left + x, top + y) + channel]
    })
}

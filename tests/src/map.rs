//! Twin of device/map.wgsl: the levels of a map.

use welkin_pack::Image;
use welkin_pack::role::Wrap;
use welkin_pack::texture::unorm8;
use welkin_runtime::internals::device::map::LEAST_SIDE;

use crate::texture::Texture;

/// A map with its levels, each rounded to bytes as a target of 8 bits does it.
pub fn with_levels(top: Image) -> Texture {
    let mut levels = vec![rounded(top)];
    while let Some(last) = levels.last().filter(|level| level.width > LEAST_SIDE) {
        levels.push(rounded(halved(last)));
    }
    Texture::from_levels(levels, Wrap::Repeat)
}

/// The mean of 2x2 texels.
pub fn halved(image: &Image) -> Image {
    let (width, height) = (image.width / 2, image.height / 2);
    let mut half = Image::new(width, height, image.channels);
    for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
        for channel in 0..image.channels {
            let corners = [(0, 0), (1, 0), (0, 1), (1, 1)];
            let sum: f32 = corners
                .iter()
                .map(|(i, j)| image.texel(2 * x + i, 2 * y + j)[channel])
                .sum();
            half.texel_mut(x, y)[channel] = sum / 4.0;
        }
    }
    half
}

/// The nearest bytes, as shares of 255.
pub fn rounded(mut image: Image) -> Image {
    for value in &mut image.texels {
        *value = f32::from(unorm8(*value)) / 255.0;
    }
    image
}

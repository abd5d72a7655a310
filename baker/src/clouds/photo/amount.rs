//! One number a texel: how bright it is, between a black and a white.

use welkin_pack::Image;

use crate::filter;

/// Luma weights of red, green and blue: ITU-R BT.709-6, item 3.2.
const LUMA: [f32; 3] = [0.2126, 0.7152, 0.0722];

/// Luminance of three images, as stored.
pub(super) fn luminance([red, green, blue]: &[Image; 3]) -> Image {
    filter::plane(red.width, red.height, |x, y| {
        let i = red.index(x, y);
        LUMA[0] * red.texels[i] + LUMA[1] * green.texels[i] + LUMA[2] * blue.texels[i]
    })
}

/// What a picture of values says: its grey, or the luminance of its colours.
pub(super) fn values(colours: &Image) -> Image {
    filter::plane(colours.width, colours.height, |x, y| {
        match *colours.texel(x, y) {
            // Weights that add up to 1 would still round.
            [r, g, b] if r == g && g == b => r,
            [r, g, b] => LUMA[0] * r + LUMA[1] * g + LUMA[2] * b,
            _ => 0.0,
        }
    })
}

/// What is `black` or less becomes 0, `white` or more 1.
pub(super) fn level(image: &mut Image, [black, white]: [f32; 2]) {
    if [black, white] == [0.0, 1.0] {
        return;
    }
    for value in &mut image.texels {
        *value = ((*value - black) / (white - black)).clamp(0.0, 1.0);
    }
}

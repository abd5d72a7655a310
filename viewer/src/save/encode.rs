//! Frames as the bytes of picture files.

use std::io::Cursor;

use exr::meta::attribute::Chromaticities;
use exr::prelude::{
    Encoding, Image, Layer, LayerAttributes, SpecificChannels, Text, Vec2, WritableImage,
};
use half::f16;
use image::codecs::hdr::HdrEncoder;
use image::{ExtendedColorType, ImageEncoder, Rgb};

/// Primaries and white point of ITU-R BT.709-6 (2015), table 3, as CIE 1931 x, y.
pub const BT709: Chromaticities = Chromaticities {
    red: Vec2(0.64, 0.33),
    green: Vec2(0.30, 0.60),
    blue: Vec2(0.15, 0.06),
    white: Vec2(0.3127, 0.3290),
};

/// The sky is opaque, so alpha stays out of the file.
pub fn png_rgb(width: u32, height: u32, pixels: &[[u8; 4]]) -> Result<Vec<u8>, String> {
    let rgb: Vec<u8> = pixels.iter().flat_map(|&[r, g, b, _]| [r, g, b]).collect();
    png(width, height, &rgb, ExtendedColorType::Rgb8)
}

pub fn png(
    width: u32,
    height: u32,
    samples: &[u8],
    colour: ExtendedColorType,
) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    let encoder = image::codecs::png::PngEncoder::new(&mut bytes);
    encoder
        .write_image(samples, width, height, colour)
        .map_err(|e| e.to_string())?;
    Ok(bytes)
}

/// Half-float RGB with ZIP compression and the chromaticities of BT.709, which are also those that
/// readers assume where none are given.
pub fn exr(width: u32, height: u32, pixels: &[[f16; 4]]) -> Result<Vec<u8>, String> {
    let size = (width as usize, height as usize);
    let channels = SpecificChannels::rgb(|at: Vec2<usize>| {
        let [r, g, b, _] = pixels[at.y() * size.0 + at.x()];
        (r, g, b)
    });
    let comment = "Linear BT.709 radiance; 1.0 is the white of a sunlit cloud at noon.";
    let attributes = LayerAttributes {
        software_name: Some(Text::from(concat!(
            "welkin-view ",
            env!("CARGO_PKG_VERSION")
        ))),
        comments: Some(Text::from(comment)),
        ..Default::default()
    };
    let layer = Layer::new(size, attributes, Encoding::SMALL_LOSSLESS, channels);
    let mut image = Image::from_layer(layer);
    image.attributes.chromaticities = Some(BT709);
    let mut bytes = Cursor::new(Vec::new());
    image
        .write()
        .non_parallel()
        .to_buffered(&mut bytes)
        .map_err(|e| e.to_string())?;
    Ok(bytes.into_inner())
}

/// Radiance's RGBE: three bytes and their common exponent. The encoder cuts off what a byte does not hold, so colours are rounded before:
/// no channel is off by more than a 256th of the brightest one, and none is darker on average.
pub fn hdr(width: u32, height: u32, pixels: &[[f16; 4]]) -> Result<Vec<u8>, String> {
    let rounded: Vec<Rgb<f32>> = pixels
        .iter()
        .map(|&[r, g, b, _]| Rgb(shared_exponent([r, g, b].map(f16::to_f32))))
        .collect();
    let mut bytes = Vec::new();
    HdrEncoder::new(&mut bytes)
        .encode(&rounded, width as usize, height as usize)
        .map_err(|e| e.to_string())?;
    Ok(bytes)
}

/// The nearest colour that RGBE has: whole numbers of a 256th of the power of two above the brightest channel. What is negative becomes 0.
fn shared_exponent(rgb: [f32; 3]) -> [f32; 3] {
    let brightest = rgb.into_iter().fold(0.0, f32::max);
    if brightest <= 0.0 {
        return [0.0; 3];
    }
    let step = (brightest.log2().floor() - 7.0).exp2();
    // What rounds up to the next power of two has steps of twice the size.
    let step = if (brightest / step).round() < 256.0 {
        step
    } else {
        2.0 * step
    };
    rgb.map(|c| (c.max(0.0) / step).round() * step)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hdr_gives_back_radiance_to_its_own_precision() {
        // From the faintest star to the sun, in rows that are long enough to be compressed.
        let (width, height) = (64, 8);
        let value = |i: usize, c: usize| {
            let exponent = (i / 32) as f32 - 12.0;
            f16::from_f32(exponent.exp2() * (1.0 + ((i * 37 + c * 101) % 64) as f32 / 64.0))
        };
        let pixels: Vec<[f16; 4]> = (0..width * height)
            .map(|i| [value(i, 0), value(i, 1), value(i, 2), f16::ONE])
            .collect();
        let bytes = hdr(width as u32, height as u32, &pixels).unwrap();
        let read = image::load_from_memory_with_format(&bytes, image::ImageFormat::Hdr);
        let read = read.unwrap().into_rgb32f();
        assert_eq!(read.dimensions(), (width as u32, height as u32));
        let mut bias = 0.0;
        for (found, wanted) in read.pixels().zip(&pixels) {
            let wanted = [wanted[0], wanted[1], wanted[2]].map(f16::to_f32);
            let brightest = wanted.into_iter().fold(0.0, f32::max);
            for (found, wanted) in found.0.iter().zip(wanted) {
                // Half a step, and a step is at most a 128th of the brightest channel.
                assert!(
                    (found - wanted).abs() <= brightest / 256.0,
                    "{found} {wanted}"
                );
                bias += f64::from((found - wanted) / brightest);
            }
        }
        // Cutting off would lose half a step on average, a 384th; what rounding leaves to chance is far less in 1536 channels.
        assert!((bias / 1536.0).abs() < 1.0 / 2048.0, "{bias}");
    }

    #[test]
    fn what_rgbe_cannot_hold_becomes_what_it_can() {
        assert_eq!(shared_exponent([0.0; 3]), [0.0; 3]);
        assert_eq!(shared_exponent([-1.0, -0.5, 0.0]), [0.0; 3]);
        assert_eq!(shared_exponent([-1.0, 0.5, 1.0]), [0.0, 0.5, 1.0]);
        // 255.9 steps of 1/256 round up to the next power of two.
        assert_eq!(shared_exponent([0.9999, 0.0, 0.0]), [1.0, 0.0, 0.0]);
        // And then the others have steps of 1/128, not of 1/256.
        assert_eq!(
            shared_exponent([0.9999, 64.6 / 128.0, 0.0]),
            [1.0, 65.0 / 128.0, 0.0]
        );
    }
}

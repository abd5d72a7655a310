//! Skies of any format as linear radiance.

use image::{DynamicImage, ImageFormat, Rgba};
use welkin_pack::Image;

use super::stored::{MAX_SIDE, decode_stored};
use super::{exr, hdr, srgb};
use crate::error::{BakeError, unfit, unfit_size};
use crate::inputs::Picture;

/// The most texels of a sky: 8192x4096, which take 512 MiB as floats.
const MAX_SKY_TEXELS: u64 = 1 << 25;

/// The largest radiance that a half float holds.
pub(crate) const MAX_RADIANCE: f32 = 65504.0;

/// Decodes a sky of any format to linear radiance times cover (red, green, blue) and cover, four channels.
///
/// PNG and JPEG are sRGB-encoded, 1 is white; a PNG's alpha is its cover. Radiance HDR and OpenEXR are linear
/// BT.709 as stored; an OpenEXR's colours are times its alpha already. `fits` is asked about the size before
/// anything is allocated for it. Radiance less than 0 becomes 0; infinity, which is usual beside a sun, is left to the
/// caller. What is not a number is refused.
pub(crate) fn decode_sky(
    picture: &Picture,
    fits: &dyn Fn(u32, u32) -> Result<(), BakeError>,
) -> Result<Image, BakeError> {
    let (bytes, file) = (picture.bytes.as_slice(), picture.file.as_str());
    const EXPECTED: &str = "a PNG, JPEG, Radiance HDR or OpenEXR file";
    if bytes.is_empty() {
        return Err(unfit(file, "length", "0 bytes", EXPECTED));
    }
    let fits = |width: u32, height: u32| {
        if u64::from(width) * u64::from(height) > MAX_SKY_TEXELS || width.max(height) > MAX_SIDE {
            let expected =
                format!("at most {MAX_SKY_TEXELS} texels and {MAX_SIDE} a side; resize it");
            return Err(unfit_size(file, [width, height], expected));
        }
        fits(width, height)
    };
    let mut image = match image::guess_format(bytes) {
        Ok(format @ (ImageFormat::Png | ImageFormat::Jpeg)) => {
            to_radiance(decode_stored(bytes, file, format, &fits)?.picture)
        }
        Ok(ImageFormat::OpenExr) => exr::decode(bytes, file, &fits)?,
        _ if hdr::is_hdr(bytes) => hdr::decode(bytes, file, &fits)?,
        _ => {
            let expected = format!("{EXPECTED}; convert it");
            return Err(unfit(file, "format", "unknown", expected));
        }
    };
    tame(&mut image, file)?;
    Ok(image)
}

/// Refuses what is not a number, and brings radiance to 0 and more and cover to 0..1.
pub(super) fn tame(image: &mut Image, file: &str) -> Result<(), BakeError> {
    let is_nan = |texel: &[f32]| texel.iter().any(|v| v.is_nan());
    let texels = || image.texels.chunks_exact(image.channels);
    if let Some(first) = texels().position(is_nan) {
        let (count, width) = (texels().filter(|t| is_nan(t)).count(), image.width as usize);
        let (x, y) = (first % width, first / width);
        return Err(unfit(
            file,
            "radiance",
            format!("not a number in {count} texels, the first in column {x}, row {y}"),
            "numbers; repair the picture",
        ));
    }
    for texel in image.texels.chunks_exact_mut(4) {
        for value in &mut texel[..3] {
            *value = value.max(0.0);
        }
        texel[3] = texel[3].clamp(0.0, 1.0);
    }
    Ok(())
}

/// sRGB to linear, and colours times alpha.
fn to_radiance(picture: DynamicImage) -> Image {
    let (width, height) = (picture.width(), picture.height());
    let unit = |stored: u16| f32::from(stored) / 65535.0;
    let linear: Vec<f32> = (0..=u16::MAX).map(|v| srgb::decode(unit(v))).collect();
    let mut texels = Vec::with_capacity(width as usize * height as usize * 4);
    // A byte times 257 is the same share of 65535.
    for Rgba([rgb @ .., alpha]) in picture.into_rgba16().pixels() {
        let cover = unit(*alpha);
        texels.extend(rgb.map(|v| linear[usize::from(v)] * cover));
        texels.push(cover);
    }
    Image {
        width,
        height,
        channels: 4,
        texels,
    }
}

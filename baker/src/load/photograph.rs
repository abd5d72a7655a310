//! Photographs of clouds, of any format that cameras and editors write, as values of sRGB.

use image::DynamicImage;
use welkin_pack::Image;

use super::format::{Format, of_photograph};
use super::stored::{Stored, decode_stored};
use super::{colours, exr, hdr, icc, sky};
use crate::error::{BakeError, unfit, unfit_size};

/// The smallest side of a photograph, in texels: less holds no cloud.
const MIN_SIDE: u32 = 64;

/// The largest side, in texels: a strip of a whole horizon.
const MAX_SIDE: u32 = 32768;

/// The most texels: 8192x8192, somewhat more than cameras of 60 million have. They take 768 MiB as floats.
const MAX_TEXELS: u64 = 1 << 26;

/// Share of the texels of a picture of light that are darker than its white. The sun, lamps and glints are the rest.
const WHITE: f64 = 0.99;

/// A picture of clouds.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Photograph {
    /// Red, green and blue, encoded as sRGB, 0..1.
    pub colours: Image,
    /// How much of a texel counts, 0..1: the alpha channel of a picture that has one and is not opaque everywhere.
    pub cover: Option<Image>,
}

/// What the values of a picture are taken for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Reading {
    /// A picture: its profile says what colours its values mean, and light is exposed.
    Photograph,
    /// Numbers: they are taken as they are stored.
    Values,
}

/// Decodes a photograph. Its first bytes say what it is.
///
/// An ICC profile, or a PNG's gamma, says what its values mean; without one they are sRGB. Light (Radiance HDR, OpenEXR, TIFF of floats) is
/// exposed so that 1 % of the texels are white.
pub(crate) fn decode(bytes: &[u8], file: &str, reading: Reading) -> Result<Photograph, BakeError> {
    let fits = |width: u32, height: u32| {
        let is_side = |side| (MIN_SIDE..=MAX_SIDE).contains(&side);
        let texels = u64::from(width) * u64::from(height);
        if is_side(width) && is_side(height) && texels <= MAX_TEXELS {
            return Ok(());
        }
        let expected =
            format!("{MIN_SIDE} to {MAX_SIDE} texels a side, {MAX_TEXELS} in all; resize it");
        Err(unfit_size(file, [width, height], expected))
    };
    let light = match of_photograph(bytes, file)? {
        Format::Hdr => hdr::decode(bytes, file, &fits)?,
        Format::Exr => exr::decode(bytes, file, &fits)?,
        Format::Stored(format) => {
            let Stored { picture, icc } = decode_stored(bytes, file, format, &fits)?;
            match picture {
                DynamicImage::ImageRgb32F(_) | DynamicImage::ImageRgba32F(_) => light_of(picture),
                picture => {
                    let profile = match icc {
                        _ if reading == Reading::Values => None,
                        Some(icc) => icc::read(&icc, file)?,
                        None => colours::png_gamma(bytes, format),
                    };
                    let (mut colours, cover) = colours::split(picture);
                    if let Some(profile) = profile {
                        colours::to_srgb(&mut colours, &profile);
                    }
                    return Ok(Photograph { colours, cover });
                }
            }
        }
    };
    exposed(light, file, reading)
}

/// Light times alpha, and alpha.
fn light_of(picture: DynamicImage) -> Image {
    let (width, height) = (picture.width(), picture.height());
    let mut texels = picture.into_rgba32f().into_raw();
    for texel in texels.chunks_exact_mut(4) {
        let alpha = texel[3];
        texel[..3].iter_mut().for_each(|v| *v *= alpha);
    }
    Image {
        width,
        height,
        channels: 4,
        texels,
    }
}

/// Light times cover, and cover, as a photograph.
fn exposed(mut light: Image, file: &str, reading: Reading) -> Result<Photograph, BakeError> {
    sky::tame(&mut light, file)?;
    let (texels, _) = light.texels.as_chunks::<4>();
    let plain = |[r, g, b, a]: &[f32; 4]| {
        let whole = if *a > 0.0 { 1.0 / a } else { 0.0 };
        [r, g, b].map(|v| v * whole)
    };
    let colours: Vec<f32> = texels.iter().flat_map(plain).collect();
    let is_clear = texels.iter().any(|texel| texel[3] < 1.0);
    let image = |channels, texels| Image {
        width: light.width,
        height: light.height,
        channels,
        texels,
    };
    let cover = is_clear.then(|| image(1, texels.iter().map(|texel| texel[3]).collect()));
    if reading == Reading::Values {
        let colours = image(3, colours);
        return Ok(Photograph { colours, cover });
    }
    let mut brightest: Vec<f32> = colours
        .chunks_exact(3)
        .map(|rgb| rgb[0].max(rgb[1]).max(rgb[2]))
        .filter(|v| v.is_finite())
        .collect();
    let rank = (WHITE * brightest.len().saturating_sub(1) as f64) as usize;
    let white = match brightest.len() {
        0 => 0.0,
        _ => *brightest.select_nth_unstable_by(rank, f32::total_cmp).1,
    };
    if white <= 0.0 {
        let expected = "light in more than 1 % of its texels; choose a picture that shows clouds";
        return Err(unfit(file, "radiance", "0", expected));
    }
    let colours = image(3, colours::exposed(&colours, white));
    Ok(Photograph { colours, cover })
}

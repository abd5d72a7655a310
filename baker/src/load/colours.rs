//! Stored values of a photograph as sRGB, whatever they are stored as.

use image::{DynamicImage, ImageFormat};
use rayon::prelude::*;
use welkin_pack::Image;

use super::icc::{Curve, Profile};
use super::srgb;

/// Steps of the table that encodes linear light: in the dark, where sRGB is steepest, one is a twentieth of a byte's.
const STEPS: usize = 65535;

/// PNG's exponent for what a screen shows as it is, times 100000 (ISO/IEC 15948:2004, 11.3.3.2); sRGB has it too.
const USUAL_GAMMA: u32 = 45_455;

/// Exponents that differ by no more are the same: what programs round differently.
const NEAR_GAMMA: u32 = 500;

/// The meaning of values that a PNG tells by a gamma alone: nothing if they are as usual, or told in a better way.
pub(super) fn png_gamma(bytes: &[u8], format: ImageFormat) -> Option<Profile> {
    const FIRST_CHUNK: usize = 8;
    if format != ImageFormat::Png {
        return None;
    }
    let mut at = FIRST_CHUNK;
    let mut gamma = None;
    loop {
        let [length, name] = [0, 4].map(|i| bytes.get(at + i..at + i + 4));
        let length = u32::from_be_bytes(length?.try_into().ok()?) as usize;
        match name? {
            b"sRGB" | b"iCCP" | b"cICP" => return None,
            b"gAMA" => {
                let data = bytes.get(at + 8..at + 12)?;
                gamma = Some(u32::from_be_bytes(data.try_into().ok()?));
            }
            b"IDAT" => break,
            _ => {}
        }
        at = at.checked_add(length)?.checked_add(12)?;
    }
    let gamma = gamma.filter(|&g| g > 0 && g.abs_diff(USUAL_GAMMA) > NEAR_GAMMA)?;
    let curve = Curve::Power(100_000.0 / f64::from(gamma));
    Some(Profile {
        curves: [curve.clone(), curve.clone(), curve],
        matrix: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    })
}

/// Red, green and blue as stored, 0..1, and alpha if any of it is less than 1.
pub(super) fn split(picture: DynamicImage) -> (Image, Option<Image>) {
    let (width, height) = (picture.width(), picture.height());
    let image = |channels, texels| Image {
        width,
        height,
        channels,
        texels,
    };
    let unit = |v: &u16| f32::from(*v) / 65535.0;
    if !picture.color().has_alpha() {
        let texels = match picture {
            DynamicImage::ImageRgb8(rgb) => {
                rgb.as_raw().iter().map(|&v| f32::from(v) / 255.0).collect()
            }
            other => other.into_rgb16().as_raw().iter().map(unit).collect(),
        };
        return (image(3, texels), None);
    }
    let picture = picture.into_rgba16();
    let (texels, _) = picture.as_raw().as_chunks::<4>();
    let colours = texels.iter().flat_map(|[rgb @ .., _]| rgb).map(unit);
    let colours = image(3, colours.collect());
    let is_clear = texels.iter().any(|texel| texel[3] < u16::MAX);
    let alpha = is_clear.then(|| image(1, texels.iter().map(|texel| unit(&texel[3])).collect()));
    (colours, alpha)
}

/// Values of a profile become those of sRGB. What sRGB cannot show is cut.
pub(super) fn to_srgb(colours: &mut Image, profile: &Profile) {
    let encode = encoder();
    // Values are at most 16 bits, so a table of every one is exact.
    let linear = profile.curves.each_ref().map(|curve| {
        let at = |step: usize| curve.at(step as f64 / STEPS as f64);
        (0..=STEPS).map(at).collect::<Vec<f64>>()
    });
    let row = colours.width as usize * 3;
    colours.texels.par_chunks_mut(row).for_each(|row| {
        for texel in row.chunks_exact_mut(3) {
            let rgb = [0, 1, 2].map(|c| linear[c][step(f64::from(texel[c]))]);
            for (value, [r, g, b]) in texel.iter_mut().zip(profile.matrix) {
                *value = encode[step(r * rgb[0] + g * rgb[1] + b * rgb[2])];
            }
        }
    });
}

/// Linear light becomes values of sRGB; `white` and more is 1.
pub(super) fn exposed(light: &[f32], white: f32) -> Vec<f32> {
    let encode = encoder();
    let shown = |v: &f32| encode[step(f64::from(*v) / f64::from(white))];
    light.par_iter().map(shown).collect()
}

fn encoder() -> Vec<f32> {
    let steps = 0..=STEPS;
    steps
        .map(|s| srgb::encode(s as f32 / STEPS as f32))
        .collect()
}

/// The nearest step; what is infinite is the last.
fn step(value: f64) -> usize {
    (value.clamp(0.0, 1.0) * STEPS as f64 + 0.5) as usize
}

//! How much cloud there is at a texel: by colour where a picture has any, else by luminance.

use welkin_pack::Image;

use crate::filter;

/// Blur of the red/blue ratio, as a share of the working image: above a JPEG's chroma blocks.
const RATIO_BLUR: f32 = 0.012;

/// Blur that stands for the uneven light on the clouds, as a share of the working image.
const LIGHT_BLUR: f32 = 0.11;

/// Blur that measures the local contrast, as a share of the working image.
const EVEN_BLUR: f32 = 0.12;

/// Weight of the large shapes against the fine structure, which has weight 1.
const SHAPE_WEIGHT: f32 = 1.2;

/// Least standard deviation of the blurred ratio from that of the picture's own tint: one step of a byte at middle grey.
/// Up to half of it is the rounding of the bytes; from there on the ratio counts more and more, and from here on fully.
const LEAST_TINT: f32 = 1.0 / 255.0 / (0.5 + DARK);

/// What is added to red and blue: a dark texel has no colour worth the name, and so its ratio stays near 1.
pub(super) const DARK: f32 = 1.0 / 32.0;

/// Blur that parts the large shapes of the ratio from the fine structure of luminance, as a share of the working image: three times
/// that of the ratio, which leaves 0.95 of such waves.
const JOIN_BLUR: f32 = 3.0 * RATIO_BLUR;

/// Least spread of the waves that join luminance to the ratio, of a field of spread 1, and the largest factor between the two: luminance
/// whose waves are weaker is noise.
const LEAST_BAND: f32 = 0.05;
const MOST_FACTOR: f32 = 4.0;

/// Standard deviations that shapes and fine structure are divided by at least: one step of a byte.
const LEAST_SPREAD: f32 = 1.0 / 255.0;

/// The same of their sum, which is 1 and more in a picture that has either.
const LEAST_SUM: f32 = 0.5;

/// Large shapes from the ratio of red to blue, fine structure from flattened luminance; mean 0, spread 1. `strength` is how much of
/// uneven light is taken away, 0..1.
pub(super) fn cloudiness(red: &Image, blue: &Image, luminance: &Image, strength: f32) -> Image {
    let (width, height) = (red.width, red.height);
    let ratio = filter::plane(width, height, |x, y| {
        let i = red.index(x, y);
        (red.texels[i] + DARK) / (blue.texels[i] + DARK)
    });
    let weight = SHAPE_WEIGHT * colourfulness(red, blue, &ratio);
    let mut shape = flatten(
        &filter::wide_blur(&ratio, RATIO_BLUR * width as f32),
        1.5 * LIGHT_BLUR,
        strength,
    );
    let mut fine = flatten(luminance, LIGHT_BLUR, strength);
    filter::standardise(&mut shape, LEAST_SPREAD);
    filter::standardise(&mut fine, LEAST_SPREAD);
    let cloud = filter::plane(width, height, |x, y| {
        let i = shape.index(x, y);
        weight * shape.texels[i] + fine.texels[i]
    });
    even_out(&cloud, strength)
}

/// The same with the fine structure as strong as the picture has it: shapes finer than the ratio tells are those of luminance, with the
/// factor that joins the two where both are known, so that the spectrum goes on as it was.
pub(super) fn with_fine_structure(
    red: &Image,
    blue: &Image,
    luminance: &Image,
    strength: f32,
) -> Image {
    let (width, height) = (red.width, red.height);
    let ratio = filter::plane(width, height, |x, y| {
        let i = red.index(x, y);
        (red.texels[i] + DARK) / (blue.texels[i] + DARK)
    });
    let weight = colourfulness(red, blue, &ratio);
    let sigma = RATIO_BLUR * width as f32;
    let light = 1.5 * LIGHT_BLUR;
    let mut shape = flatten(&filter::wide_blur(&ratio, sigma), light, strength);
    let mut fine = flatten(luminance, light, strength);
    filter::standardise(&mut shape, LEAST_SPREAD);
    filter::standardise(&mut fine, LEAST_SPREAD);
    let join = JOIN_BLUR * width as f32;
    let [shape_low, fine_low] = [&shape, &fine].map(|image| filter::wide_blur(image, join));
    let band = |low: &Image| {
        let lower = filter::wide_blur(low, 2.0 * join);
        let difference = filter::plane(width, height, |x, y| {
            let i = low.index(x, y);
            low.texels[i] - lower.texels[i]
        });
        difference.mean_and_spread(0).1
    };
    let factor = (band(&shape_low) / band(&fine_low).max(LEAST_BAND)).min(MOST_FACTOR);
    let cloud = filter::plane(width, height, |x, y| {
        let i = shape.index(x, y);
        let joined = shape_low.texels[i] + factor * (fine.texels[i] - fine_low.texels[i]);
        weight * joined + (1.0 - weight) * fine.texels[i]
    });
    even_out(&cloud, strength)
}

/// 1 where the ratio of red to blue tells something, 0 where it is that of one tint but for the rounding of bytes: then red
/// is everywhere the same share of blue, and what the ratio does follows from luminance.
pub(super) fn colourfulness(red: &Image, blue: &Image, ratio: &Image) -> f32 {
    let sum = |of: fn(f64, f64) -> f64| {
        let pairs = red.texels.iter().zip(&blue.texels);
        pairs.map(|(&r, &b)| of(r.into(), b.into())).sum::<f64>()
    };
    // The share that fits best. Without any blue there is no ratio either.
    let share = (sum(|r, b| r * b) / sum(|_, b| b * b).max(f64::MIN_POSITIVE)) as f32;
    let off = filter::plane(ratio.width, ratio.height, |x, y| {
        let i = ratio.index(x, y);
        ratio.texels[i] - (share * blue.texels[i] + DARK) / (blue.texels[i] + DARK)
    });
    let blurred = filter::wide_blur(&off, RATIO_BLUR * ratio.width as f32);
    let (_, spread) = blurred.mean_and_spread(0);
    (2.0 * spread / LEAST_TINT - 1.0).clamp(0.0, 1.0)
}

/// Divides by the local contrast, so that no part of the tile stands out and betrays the repetition.
fn even_out(cloud: &Image, strength: f32) -> Image {
    let square = filter::plane(cloud.width, cloud.height, |x, y| {
        let value = cloud.texels[cloud.index(x, y)];
        value * value
    });
    let variance = filter::wide_blur(&square, EVEN_BLUR * cloud.width as f32);
    let variance = partly(variance, strength);
    let mut even = filter::plane(cloud.width, cloud.height, |x, y| {
        let i = cloud.index(x, y);
        cloud.texels[i] / libm::sqrtf(variance.texels[i].max(0.0) + 1.0)
    });
    filter::standardise(&mut even, LEAST_SUM);
    even
}

/// An image relative to its wide blur.
fn flatten(image: &Image, share: f32, strength: f32) -> Image {
    let light = filter::wide_blur(image, share * image.width as f32);
    let light = partly(light, strength);
    filter::plane(image.width, image.height, |x, y| {
        let i = image.index(x, y);
        image.texels[i] / light.texels[i].max(1.0 / 255.0) - 1.0
    })
}

/// An image of which a share is its own mean: at strength 1 nothing, at 0 all of it.
fn partly(mut image: Image, strength: f32) -> Image {
    if strength < 1.0 {
        let (mean, _) = image.mean_and_spread(0);
        let texels = image.texels.iter_mut();
        texels.for_each(|value| *value = mean + strength * (*value - mean));
    }
    image
}

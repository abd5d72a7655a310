//! The grey of a sprite: its mean, its relief, and how it goes on where there is no cloud.

use welkin_pack::Image;

use crate::filter;

/// Where the deepest creases and the brightest knobs are bent in, in standard deviations: as black or white spots they
/// would betray a sprite that comes again.
const OUTLIER: f32 = 1.8;

/// Weight of what is around beside a texel's own opacity.
const AROUND: f32 = 1.0 / 64.0;

/// Grey, with the mean 0.5 where the sprite is opaque and about `relief` as its standard deviation, and opacity, of light
/// times opacity, and opacity.
pub(super) fn standardised(picture: &Image, relief: f32) -> Image {
    let mean = mean(picture);
    let squares = texels(picture).map(|[light, alpha]| {
        let away = light / alpha.max(f32::MIN_POSITIVE) - mean;
        f64::from(alpha * away * away)
    });
    let spread = libm::sqrt(squares.sum::<f64>() / weight(picture)) as f32;
    let scale = if spread > 0.0 { 1.0 / spread } else { 0.0 };
    finished(picture, |light| {
        let away = scale * (light - mean);
        relief * away / libm::sqrtf(1.0 + away * away / (OUTLIER * OUTLIER))
    })
}

/// Grey is 0.5 and what `away` makes of the light.
fn finished(picture: &Image, away: impl Fn(f32) -> f32) -> Image {
    let mut image = picture.clone();
    for texel in image.texels.chunks_exact_mut(2) {
        if texel[1] > 0.0 {
            texel[0] = texel[1] * (0.5 + away(texel[0] / texel[1])).clamp(0.0, 1.0);
        }
    }
    let grey = spread_out(&image);
    for (texel, grey) in image.texels.chunks_exact_mut(2).zip(&grey.texels) {
        texel[0] = texel[1] * grey;
    }
    // Bending and spreading have moved the mean a little.
    let off = 0.5 - mean(&image);
    for (texel, grey) in image.texels.chunks_exact_mut(2).zip(&grey.texels) {
        texel[0] = (grey + off).clamp(0.0, 1.0);
    }
    image
}

/// The first channel over the second, going on smoothly where the second is 0: thin parts take from the same picture at
/// half the size, and so on to one texel. S. J. Gortler, R. Grzeszczuk, R. Szeliski, M. F. Cohen, "The Lumigraph",
/// SIGGRAPH 1996, section 3.4: pull and push.
fn spread_out(image: &Image) -> Image {
    let side = image.width;
    let around = if side > 1 {
        filter::resample(&spread_out(&halved(image)), side, side)
    } else {
        filter::plane(1, 1, |_, _| 0.5)
    };
    filter::plane(side, side, |x, y| {
        let texel = image.texel(x, y);
        (texel[0] + AROUND * around.texel(x, y)[0]) / (texel[1] + AROUND)
    })
}

fn halved(image: &Image) -> Image {
    let side = image.width / 2;
    let mut half = Image::new(side, side, 2);
    for (y, x) in (0..side).flat_map(|y| (0..side).map(move |x| (y, x))) {
        for (i, j) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            let above = image.texel(2 * x + i, 2 * y + j);
            for (sum, value) in half.texel_mut(x, y).iter_mut().zip(above) {
                *sum += 0.25 * value;
            }
        }
    }
    half
}

fn texels(image: &Image) -> impl Iterator<Item = [f32; 2]> + '_ {
    image.texels.chunks_exact(2).map(|t| [t[0], t[1]])
}

fn weight(image: &Image) -> f64 {
    texels(image)
        .map(|[_, alpha]| f64::from(alpha))
        .sum::<f64>()
        .max(f64::MIN_POSITIVE)
}

/// Mean light of what is opaque.
fn mean(image: &Image) -> f32 {
    let light: f64 = texels(image).map(|[light, _]| f64::from(light)).sum();
    (light / weight(image)) as f32
}

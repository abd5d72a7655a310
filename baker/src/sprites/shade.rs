//! The greys of a sprite: their mean, their relief, and how they go on where there is no cloud.

use welkin_pack::Image;

use crate::filter;

/// Where the deepest creases and the brightest knobs are bent in, in standard deviations: as black or white spots they
/// would betray a sprite that comes again.
const OUTLIER: f32 = 1.8;

/// A standard deviation of less than this share of the mean is rounding.
const LEAST_SPREAD: f32 = 1e-4;

/// Opacity that light is divided by at least: a picture's least may be no more than a float holds.
const LEAST_ALPHA: f32 = 1e-6;

/// A picture whose mean light is less is black.
const LEAST_LIGHT: f32 = 1e-30;

/// Weight of what is around beside a texel's own opacity.
const AROUND: f32 = 1.0 / 64.0;

/// Share of a difference of sides that is taken away where it is wider than [`WIDE`] of the sprite: the light through a whole cloud tells it.
const WIDER: f32 = 0.7;
const WIDE: u32 = 8;

/// The texels of a cell of the sheet, of light from the front, opacity, and the differences of the sides.
pub(super) fn sides(picture: &Image, relief: f32) -> Image {
    let [front, right, top] = [0, 2, 3].map(|channel| {
        let mut light = Image::new(picture.width, picture.height, 2);
        let texels = light.texels.chunks_exact_mut(2);
        for (texel, from) in texels.zip(picture.texels.chunks_exact(4)) {
            texel.copy_from_slice(&[from[channel], from[1]]);
        }
        let light = if channel == 0 { light } else { finer(&light) };
        standardised(&light, relief)
    });
    cell(&front, [&right, &top])
}

/// The same of a picture that is lit from one side alone.
pub(super) fn level(picture: &Image) -> Image {
    let flat = filter::plane(picture.width, picture.height, |_, _| 0.5);
    cell(picture, [&flat, &flat])
}

/// Greys of three pictures, and the opacity of the first.
fn cell(front: &Image, sides: [&Image; 2]) -> Image {
    let mut cell = Image::new(front.width, front.height, 4);
    for (i, texel) in cell.texels.chunks_exact_mut(4).enumerate() {
        let [right, top] = sides.map(|side| side.texels[i * side.channels]);
        texel.copy_from_slice(&[front.texels[2 * i], front.texels[2 * i + 1], right, top]);
    }
    cell
}

/// Without most of what changes slowly.
fn finer(picture: &Image) -> Image {
    let mut small = picture.clone();
    while small.width > WIDE {
        small = halved(&small);
    }
    let small = filter::plane(small.width, small.width, |x, y| {
        let texel = small.texel(x, y);
        texel[0] / texel[1].max(AROUND)
    });
    let slow = filter::resample(&small, picture.width, picture.width);
    let mut finer = picture.clone();
    for (texel, slow) in finer.texels.chunks_exact_mut(2).zip(&slow.texels) {
        texel[0] -= WIDER * slow * texel[1];
    }
    finer
}

/// Grey, with the mean 0.5 where the sprite is opaque and about `relief` as its standard deviation, and opacity, of light
/// times opacity, and opacity.
fn standardised(picture: &Image, relief: f32) -> Image {
    let mean = mean(picture);
    let squares = texels(picture).map(|[light, alpha]| {
        let away = light / alpha.max(LEAST_ALPHA) - mean;
        f64::from(alpha * away * away)
    });
    let spread = libm::sqrt(squares.sum::<f64>() / weight(picture)) as f32;
    let scale = if spread > LEAST_SPREAD * mean.abs().max(LEAST_LIGHT) {
        1.0 / spread
    } else {
        0.0
    };
    finished(picture, |light| {
        let away = scale * (light - mean);
        relief * away / libm::sqrtf(1.0 + away * away / (OUTLIER * OUTLIER))
    })
}

/// The same with the relief that a picture has: `contrast` times the light relative to its mean.
pub(super) fn relative(picture: &Image, contrast: f32) -> Image {
    let mean = mean(picture);
    let scale = if mean > LEAST_LIGHT { 0.5 / mean } else { 0.0 };
    finished(picture, |light| contrast * scale * (light - mean))
}

/// Grey is 0.5 and what `away` makes of the light.
fn finished(picture: &Image, away: impl Fn(f32) -> f32) -> Image {
    let mut image = picture.clone();
    for texel in image.texels.chunks_exact_mut(2) {
        if texel[1] > 0.0 {
            texel[0] =
                texel[1] * (0.5 + away(texel[0] / texel[1].max(LEAST_ALPHA))).clamp(0.0, 1.0);
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

/// Sum of the opacity.
fn weight(image: &Image) -> f64 {
    texels(image).map(|[_, alpha]| f64::from(alpha)).sum()
}

/// Mean light of what is opaque, 0.5 where nothing is.
fn mean(image: &Image) -> f32 {
    let weight = weight(image);
    if weight <= 0.0 {
        return 0.5;
    }
    let light: f64 = texels(image).map(|[light, _]| f64::from(light)).sum();
    (light / weight) as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIDE: u32 = 32;

    /// A disc with a soft edge and a light of its own.
    fn disc(light: impl Fn(f32, f32) -> f32) -> Image {
        let mut image = Image::new(SIDE, SIDE, 2);
        for (i, texel) in (0..).zip(image.texels.chunks_exact_mut(2)) {
            let [u, v] = [i % SIDE, i / SIDE].map(|c| (c as f32 + 0.5) / SIDE as f32 * 2.0 - 1.0);
            let alpha = ((0.7 - libm::sqrtf(u * u + v * v)) / 0.2).clamp(0.0, 1.0);
            texel.copy_from_slice(&[alpha * light(u, v), alpha]);
        }
        image
    }

    /// Mean and standard deviation of the grey, weighted by opacity.
    fn statistics(image: &Image) -> [f64; 2] {
        let sum = |value: &dyn Fn(f64) -> f64| {
            let weighted = texels(image).map(|[g, a]| f64::from(a) * value(f64::from(g)));
            weighted.sum::<f64>() / weight(image)
        };
        let mean = sum(&|grey| grey);
        let variance = sum(&|grey| (grey - mean) * (grey - mean));
        [mean, libm::sqrt(variance)]
    }

    #[test]
    fn the_mean_is_one_half_and_the_relief_is_what_was_asked() {
        let waves = disc(|u, v| 3.0 + libm::sinf(6.0 * u) * libm::cosf(5.0 * v));
        for relief in [0.0, 0.05, 0.1] {
            let [mean, spread] = statistics(&standardised(&waves, relief));
            assert!((mean - 0.5).abs() < 1e-6, "{mean}");
            // Bending takes a part of it, and what is around too.
            let relief = f64::from(relief);
            assert!((0.6 * relief..=relief + 1e-6).contains(&spread), "{spread}");
        }
    }

    #[test]
    fn a_picture_keeps_its_own_contrast() {
        // Twice as bright on the right as on the left: 4/3 and 2/3 of the mean.
        let halves = disc(|u, _| if u > 0.0 { 0.4 } else { 0.2 });
        for contrast in [0.0, 0.5, 1.0] {
            let grey = relative(&halves, contrast);
            let [left, right] = [10, 21].map(|x| grey.texel(x, 16)[0]);
            let expected = contrast / 6.0;
            // A 64th of it is what is around.
            assert!((0.5 - left - expected).abs() < expected / 50.0 + 1e-6);
            assert!((right - 0.5 - expected).abs() < expected / 50.0 + 1e-6);
        }
    }

    #[test]
    fn grey_goes_on_where_there_is_no_cloud() {
        let grey = standardised(&disc(|u, _| 1.0 + 0.5 * u), 0.1);
        let row: Vec<f32> = (0..SIDE).map(|x| grey.texel(x, 16)[0]).collect();
        assert_eq!(grey.texel(31, 16)[1], 0.0);
        // To the side it stays as bright as the cloud is there, and nowhere is there a step.
        assert!(row[31] > 0.55 && row[0] < 0.45, "{row:?}");
        assert!(row.windows(2).all(|pair| (pair[1] - pair[0]).abs() < 0.03));
        let opacity: Vec<f32> = disc(|_, _| 0.0).channel(1).collect();
        assert!(opacity == grey.channel(1).collect::<Vec<_>>());
    }

    #[test]
    fn the_faintest_and_the_darkest_picture_stay_numbers() {
        let mut faint = disc(|_, _| 0.3);
        for (i, texel) in faint.texels.chunks_exact_mut(2).enumerate() {
            if i % 3 == 0 {
                texel.copy_from_slice(&[65504.0, 1e-42]);
            }
        }
        for picture in [faint, disc(|u, _| 1e-42 * (2.0 + u)), disc(|_, _| 1e-38)] {
            for grey in [
                standardised(&picture, 0.2),
                relative(&picture, 1.0),
                relative(&picture, 0.0),
            ] {
                assert!(grey.texels.iter().all(|v| (0.0..=1.0).contains(v)));
            }
        }
    }

    #[test]
    fn nothing_and_one_light_alone_have_no_relief() {
        for picture in [Image::new(SIDE, SIDE, 2), disc(|_, _| 0.3)] {
            for grey in [standardised(&picture, 0.2), relative(&picture, 1.0)] {
                assert!(grey.channel(0).all(|grey| (grey - 0.5).abs() < 1e-3));
            }
        }
    }
}

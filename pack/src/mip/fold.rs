//! Two to four texels become one.

use crate::image::Image;

/// Averages 2x2 texels (2x1 or 1x2 where a side is already one texel). Sides are powers of two.
pub(crate) fn halve(image: &Image) -> Image {
    fold(image, mean)
}

pub(super) fn mean(texels: &[&[f32]], out: &mut [f32]) {
    for (channel, value) in out.iter_mut().enumerate() {
        *value = texels.iter().map(|t| t[channel]).sum::<f32>() / texels.len() as f32;
    }
}

/// Gathers the two to four texels under each texel of the next level.
pub(super) fn fold(image: &Image, average: impl Fn(&[&[f32]], &mut [f32])) -> Image {
    let (width, height) = ((image.width / 2).max(1), (image.height / 2).max(1));
    let (step_x, step_y) = (image.width / width, image.height / height);
    let mut out = Image::new(width, height, image.channels);
    let mut texels: Vec<&[f32]> = Vec::with_capacity(4);
    for y in 0..height {
        for x in 0..width {
            texels.clear();
            for (j, i) in (0..step_y).flat_map(|j| (0..step_x).map(move |i| (j, i))) {
                texels.push(image.texel(x * step_x + i, y * step_y + j));
            }
            average(&texels, out.texel_mut(x, y));
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halving_keeps_the_mean() {
        let mut image = Image::new(16, 8, 1);
        for (i, texel) in image.texels.iter_mut().enumerate() {
            *texel = (i % 7) as f32 / 7.0;
        }
        let (mean, _) = image.mean_and_spread(0);
        let half = halve(&image);
        assert_eq!((half.width, half.height), (8, 4));
        assert!((half.mean_and_spread(0).0 - mean).abs() < 1e-6);
        let one = halve(&halve(&halve(&half)));
        assert_eq!((one.width, one.height), (1, 1));
        assert!((one.texels[0] - mean).abs() < 1e-6);
    }
}

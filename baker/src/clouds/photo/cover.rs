//! What of a photograph counts: an alpha channel or a mask, 0 clear sky and 1 cloud.

use welkin_pack::Image;

use crate::error::{BakeError, unfit_size};
use crate::filter;
use crate::load::Photograph;

/// Blur that spreads colours into what does not count, as a share of the image.
const FILL_BLUR: f32 = 0.05;

/// Share of what counts in the blur below which no colour is known there.
const LEAST_KNOWN: f32 = 1e-3;

/// The cover of a photograph with a mask: values times the mask's own alpha and the photograph's.
pub(super) fn mask(
    mut values: Image,
    alpha: Option<Image>,
    photograph: &Photograph,
    file: &str,
) -> Result<Image, BakeError> {
    let expected = &photograph.colours;
    if (values.width, values.height) != (expected.width, expected.height) {
        let expected = format!(
            "{}x{}, as the photograph has upright; save it in that size",
            expected.width, expected.height
        );
        return Err(unfit_size(file, [values.width, values.height], expected));
    }
    for factor in alpha.iter().chain(&photograph.cover) {
        let pairs = values.texels.iter_mut().zip(&factor.texels);
        pairs.for_each(|(value, factor)| *value *= factor);
    }
    Ok(limited(values))
}

/// Resampling overshoots; cover does not.
pub(super) fn limited(mut cover: Image) -> Image {
    let texels = cover.texels.iter_mut();
    texels.for_each(|value| *value = value.clamp(0.0, 1.0));
    cover
}

/// Gives what does not count the colours of what lies around it, so that its own, often black, cast no shade on the clouds
/// beside it.
///
/// Normalised convolution: H. Knutsson, C.-F. Westin, "Normalized and Differential Convolution", CVPR 1993, eq. 2.
pub(super) fn fill(image: &mut Image, cover: &Image) {
    let sigma = FILL_BLUR * image.width as f32;
    let counted = filter::plane(image.width, image.height, |x, y| {
        let i = image.index(x, y);
        image.texels[i] * cover.texels[i]
    });
    let weights: f64 = cover.texels.iter().map(|&w| f64::from(w)).sum();
    let sum: f64 = counted.texels.iter().map(|&v| f64::from(v)).sum();
    let mean = (sum / weights.max(f64::from(LEAST_KNOWN))) as f32;
    let near = filter::wide_blur(&counted, sigma);
    let known = filter::wide_blur(cover, sigma);
    for (i, value) in image.texels.iter_mut().enumerate() {
        let share = known.texels[i].max(0.0);
        // The mean has the weight of the least that is known, and so rules where nothing is near.
        let around = (near.texels[i] + LEAST_KNOWN * mean) / (share + LEAST_KNOWN);
        let weight = cover.texels[i];
        *value = weight * *value + (1.0 - weight) * around;
    }
}

/// Leaves as much cloud as counts, of a field of spread 1: what does not is one spread clearer than the thinnest cloud, so that the
/// outline of an even cloud is seen.
pub(super) fn clear(mut cloud: Image, cover: &Image) -> Image {
    let clearest = cloud.texels.iter().copied().fold(f32::MAX, f32::min) - 1.0;
    for (value, weight) in cloud.texels.iter_mut().zip(&cover.texels) {
        *value = clearest + weight * (*value - clearest);
    }
    cloud
}

//! How much of the sky the fbm method covers: octaves drift apart, so the distribution of their sum is the convolution of theirs.

use welkin_pack::Texture;

use super::map::{Octaves, weights};
use super::{FULL, FbmUniforms};
use crate::clouds::histogram::Histogram;
use crate::clouds::shared::{inverse_roughen, inverse_smoothstep};

/// The distribution of the weighted sum of a pack's octaves.
pub(crate) fn sums(texture: &Texture) -> Histogram {
    let octaves = Octaves::new(texture);
    let weights = weights(&octaves).into_iter().take(octaves.count());
    let nothing = Histogram::of([0.0].into_iter());
    weights.enumerate().fold(nothing, |sum, (layer, weight)| {
        let octave = Histogram::of(texture.image(0, layer as u32).channel(3));
        Histogram::of_pairs(&sum, &octave, |sum, octave| sum + weight * octave)
    })
}

/// The share of places with more than this opacity.
pub(crate) fn covered(sums: &Histogram, fbm: &FbmUniforms, opacity: f32) -> f32 {
    let cover = FULL * inverse_smoothstep(opacity);
    sums.mean(|finer| {
        let rough = 4.0 * fbm.roughness * (finer - fbm.mean);
        sums.above((inverse_roughen(cover, rough) - fbm.intercept) / fbm.slope)
    })
}

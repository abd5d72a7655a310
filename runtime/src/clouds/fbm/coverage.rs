//! How much of the sky the fbm method covers: octaves drift apart, so the distribution of their sum is the convolution of theirs.

use glam::Vec3;
use welkin_pack::Texture;

use super::map::{Octaves, weights};
use super::{FULL, FbmUniforms, lights_at};
use crate::clouds::histogram::Histogram;
use crate::clouds::shared::{CloudUniforms, MeanCloud, inverse_roughen, inverse_smoothstep};
use crate::geometry::math::smoothstep;
use crate::params::Shading;

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

/// Its clouds on average: the sum of octaves is about normally distributed.
pub(crate) fn mean(
    fbm: &FbmUniforms,
    clouds: &CloudUniforms,
    shading: Shading,
    spread: f32,
) -> MeanCloud {
    /// Nodes a standard deviation, and how many each way.
    const NODES: [i32; 2] = [4, 12];
    let [fine, most] = NODES;
    let (mut opacity, mut sums, mut whole) = (0.0, [Vec3::ZERO; 2], 0.0);
    for i in -most..=most {
        let deviations = i as f32 / fine as f32;
        let weight = (-0.5 * deviations * deviations).exp();
        let amount = fbm.mean + spread * deviations;
        let cover = (fbm.slope * amount + fbm.intercept).clamp(0.0, 1.0);
        let alpha = weight * smoothstep(0.0, FULL, cover);
        for (sum, light) in sums.iter_mut().zip(lights_at(fbm, clouds, shading, amount)) {
            *sum += alpha * light;
        }
        opacity += alpha;
        whole += weight;
    }
    let [sunlit, skylit] = sums.map(|sum| sum / f32::max(opacity, 1e-6));
    MeanCloud {
        opacity: opacity / whole,
        sunlit,
        skylit,
    }
}

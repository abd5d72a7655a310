//! How much of the sky the packed method covers: its opacity is a function of photo, noise and detail at places that have nothing to do
//! with each other.

use glam::Vec3;
use welkin_pack::Image;

use super::{EDGE, PackedUniforms, UPPER_OPACITY, UPPER_THRESHOLD, fold};
use crate::clouds::histogram::Histogram;
use crate::clouds::shared::{CloudUniforms, behind, inverse_soften, radiance, softened};
use crate::geometry::math::smoothstep;

/// How the texels of the packed texture are distributed.
#[derive(Clone, Debug, PartialEq)]
pub struct Texels {
    noise: Histogram,
    detail: Histogram,
    /// Photo and noise blended: line 14.
    amount: Histogram,
}

impl Texels {
    /// Counts those of level 0.
    pub fn new(clouds: &Image) -> Texels {
        let [photo, noise, detail] = [0, 1, 2].map(|c| Histogram::of(clouds.channel(c)));
        Texels {
            amount: Histogram::of_pairs(&photo, &noise, |photo, noise| {
                photo + noise * (1.0 - photo)
            }),
            noise,
            detail,
        }
    }

    /// The share of places with more than this opacity, by the packed method.
    pub(crate) fn covered(&self, packed: &PackedUniforms, opacity: f32) -> f32 {
        let smooth = packed.smoothness;
        let lower = |opacity: f32| {
            if opacity < 0.0 {
                return 1.0;
            }
            let alpha =
                inverse_soften(opacity, EDGE) / (packed.contrast * (1.0 + 2.0 * packed.density));
            self.detail.mean(|detail| {
                self.amount
                    .above(packed.threshold + alpha / (detail + (1.0 - detail) * smooth))
            })
        };
        if packed.upper_layer == 0.0 {
            return lower(opacity);
        }
        self.noise.mean(|wisp| {
            let veil = smoothstep(UPPER_THRESHOLD, 1.0, wisp);
            let clear = 1.0 - packed.upper_layer * UPPER_OPACITY * veil;
            lower(behind(opacity, clear))
        })
    }
}

/// Mean opacity and radiance of its clouds, over texels of the packed texture that have nothing to do with each other.
pub(crate) fn mean(
    packed: &PackedUniforms,
    clouds: &CloudUniforms,
    texels: &[[f32; 3]],
) -> (f32, Vec3) {
    let (mut opacity, mut light) = (0.0, Vec3::ZERO);
    for &[photo, noise, detail] in texels {
        let amount = photo + noise * (1.0 - photo);
        let smooth = detail + (1.0 - detail) * packed.smoothness;
        let alpha = ((amount - packed.threshold) * packed.contrast * smooth).max(0.0);
        let thick = 2.0 * packed.density * alpha;
        let grey = fold(amount + detail * (1.0 - amount) + thick).clamp(0.0, 1.0);
        let lower = softened((alpha + thick).min(1.0), EDGE);
        let veil = packed.upper_layer * UPPER_OPACITY * smoothstep(UPPER_THRESHOLD, 1.0, noise);
        light += radiance(clouds, grey) * lower + radiance(clouds, 1.0) * (veil * (1.0 - lower));
        opacity += lower + veil * (1.0 - lower);
    }
    (opacity / texels.len() as f32, light / opacity.max(1e-6))
}

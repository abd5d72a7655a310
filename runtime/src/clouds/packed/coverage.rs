//! How much of the sky the packed method covers: its opacity is a function of photo, noise and detail at places that have nothing to do
//! with each other.

use welkin_pack::Image;

use super::{EDGE, FOOT, FULL, PackedUniforms, Place, UPPER_OPACITY, UPPER_THRESHOLD, paper, veil};
use crate::clouds::histogram::Histogram;
use crate::clouds::shared::{CloudUniforms, MeanCloud, behind, inverse_soften, shares_of_grey};
use crate::geometry::math::smoothstep;
use crate::params::Shading;

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
    pub(crate) fn covered(&self, packed: &PackedUniforms, shading: Shading, opacity: f32) -> f32 {
        let lower = |opacity: f32| {
            if opacity < 0.0 {
                return 1.0;
            }
            match shading {
                Shading::Scattered => self.covered_below(packed, opacity),
                Shading::Paper => paper::covered(packed, [&self.amount, &self.detail], opacity),
            }
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

    /// That of the lower layer alone.
    fn covered_below(&self, packed: &PackedUniforms, opacity: f32) -> f32 {
        let alpha = inverse_soften(opacity, EDGE);
        let square = -(1.0 - alpha / FULL).max(f32::MIN_POSITIVE).log2() / packed.opacity_rate;
        // The positive root of `h^2 / (h + FOOT) = square`.
        let height = 0.5 * (square + (square * (square + 4.0 * FOOT)).sqrt());
        self.detail.mean(|detail| {
            let eaten = packed.erosion * (1.0 - detail);
            self.amount
                .above(packed.threshold + (height + eaten) / packed.contrast)
        })
    }
}

/// Its clouds on average, over texels of the packed texture that have nothing to do with each other.
pub(crate) fn mean(
    packed: &PackedUniforms,
    clouds: &CloudUniforms,
    shading: Shading,
    texels: &[[f32; 3]],
) -> MeanCloud {
    let (mut opacity, mut sums) = (0.0, [0.0; 2]);
    for &texel in texels {
        let (lower, shares) = match shading {
            Shading::Scattered => {
                let place = Place::of(packed, texel);
                (place.opacity(packed), place.shares(packed, clouds))
            }
            Shading::Paper => paper::place(packed, texel),
        };
        let veil = veil(packed, texel[1]) * (1.0 - lower);
        for ((sum, share), white) in sums.iter_mut().zip(shares).zip(shares_of_grey(1.0)) {
            *sum += share * lower + white * veil;
        }
        opacity += lower + veil;
    }
    let shares = sums.map(|sum| sum / f32::max(opacity, 1e-6));
    MeanCloud::of_shares(clouds, opacity / texels.len() as f32, shares)
}

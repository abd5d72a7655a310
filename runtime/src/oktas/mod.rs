//! Cover in oktas: which `cover` makes a method show a number of eighths of the sky.
//!
//! # Theory
//! An okta is an eighth of the sky covered by cloud (World Meteorological Organization, "International Cloud Atlas", 2017).
//! Here a direction is covered where the clouds' opacity is above [`OPAQUE`], and the sky is what stands higher than
//! [`LEAST_SINE`], weighted by solid angle.
//!
//! A method's opacity is a fixed function of a few numbers that it reads at places which have nothing to do with each other,
//! so the share of covered sky is the share of their joint distribution that gives enough opacity. It needs no picture:
//! - packed: photo, noise and detail, with the histograms of the pack's texels ([`crate::clouds::packed`], lines 14 to 25).
//! - octaves: the map holds shares of its own distribution, evenly distributed by construction; three domes and the finer
//!   read are independent ([`crate::clouds::octaves`]).
//! - fbm: octaves drift apart, so the distribution of their sum is the convolution of theirs ([`crate::clouds::fbm`]).
//! - sprites: clouds have ranks by the share of the ground that they cover together; its oktas are that share.
//! - lit: the blend of ranks is evenly distributed by construction, layers are independent, and cover is the covered share but for
//!   thin cloud before thin cloud ([`crate::clouds::lit`]).
//!
//! Each opacity is inverted in closed form for one of those numbers and averaged over the others. The cover is found by
//! bisection, since it enters in several places.
//!
//! # Changes versus the papers
//! None of them says how much of the sky its cover covers.
//!
//! # Practice
//! [`Oktas`] is made once a pack. A cover costs a millisecond or two and depends on neither camera nor moment: find it when a
//! setting changes. It is right on average over moments; one moment is a sample (docs/cover.md).

mod histogram;

use welkin_pack::{Pack, Role};

use crate::clouds::fbm::{self, FbmUniforms};
use crate::clouds::fbm_map;
use crate::clouds::lit::{LitLayerUniforms, LitUniforms};
use crate::clouds::octaves::{self, OctaveDome, OctaveUniforms};
use crate::clouds::packed::{self, PackedUniforms};
use crate::clouds::shared::{OPAQUE, before_smoothstep, before_softening, softened};
use crate::error::{SkyError, texture};
use crate::frame::Uniforms;
use crate::geometry::camera::Camera;
use crate::geometry::math::smoothstep;
use crate::oktas::histogram::Histogram;
use crate::pack_data::PackData;
use crate::params::{LAYERS_AN_ITERATION, Method, SkyParams};

/// Sine of the lowest elevation that counts, 10 degrees: below it haze hides clouds, as it hides them from an observer.
pub const LEAST_SINE: f32 = 0.173_648_18;

/// Eighths of a whole sky.
const OKTAS: f32 = 8.0;
/// Steps of a bisection: to 1 / 2^20 of the range.
const BISECTIONS: usize = 20;
/// Points at which smooth functions are averaged or tabulated.
const NODES: usize = 32;
/// Thicknesses of a dome: whether it needs another one to be opaque is no smooth function.
const DOME_NODES: usize = 64;

/// What a pack's clouds cover: how the numbers that make opacity are distributed in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Oktas {
    pack_data: PackData,
    noise: Histogram,
    detail: Histogram,
    /// Photo and noise blended: line 14.
    amount: Histogram,
    /// The weighted sum of the octaves of smooth noise.
    fbm: Histogram,
}

impl Oktas {
    /// Counts the texels of level 0: some milliseconds.
    ///
    /// # Errors
    /// As [`PackData::new`].
    pub fn new(pack: &Pack) -> Result<Oktas, SkyError> {
        let pack_data = PackData::new(pack)?;
        let clouds = texture(pack, Role::Clouds)?.image(0, 0);
        let [photo, noise, detail] = [0, 1, 2].map(|c| Histogram::of(clouds.channel(c)));
        let smooth = texture(pack, Role::Fbm)?;
        let weights = fbm_map::weights(&pack_data.fbm)
            .into_iter()
            .take(pack_data.fbm.count());
        let nothing = Histogram::of([0.0].into_iter());
        let fbm = weights.enumerate().fold(nothing, |sum, (layer, weight)| {
            let octave = Histogram::of(smooth.image(0, layer as u32).channel(3));
            Histogram::of_pairs(&sum, &octave, |sum, octave| sum + weight * octave)
        });
        Ok(Oktas {
            amount: Histogram::of_pairs(&photo, &noise, |photo, noise| {
                photo + noise * (1.0 - photo)
            }),
            pack_data,
            noise,
            detail,
            fbm,
        })
    }

    /// The `cover` with which the method of `params`, all else as it is, shows `oktas` eighths of cloud on average.
    ///
    /// 0 is no cloud of any kind that cover rules, 8 the cover 1. Oktas out of 0..=8 are clamped; what is no number leaves the
    /// cover as it is. If the other parameters do not let the method show so much, as domes without a cover do, the answer is
    /// 1; if they show more without any cover, as the upper layer of [`Method::Packed`] may, it is 0.
    pub fn cover(&self, params: &SkyParams, oktas: f32) -> f32 {
        if oktas.is_nan() {
            return params.clamped().cover;
        }
        if oktas <= 0.0 || oktas >= OKTAS {
            return if oktas > 0.0 { 1.0 } else { 0.0 };
        }
        let shows = |cover: f32| self.shown(&SkyParams { cover, ..*params });
        let (mut low, mut high) = (0.0, 1.0);
        if shows(low) >= oktas {
            return low;
        }
        if shows(high) <= oktas {
            return high;
        }
        for _ in 0..BISECTIONS {
            let cover = 0.5 * (low + high);
            if shows(cover) < oktas {
                low = cover;
            } else {
                high = cover;
            }
        }
        0.5 * (low + high)
    }

    /// How many oktas parameters show on average, 0..=8. [`Method::Sprites`] counts the ground below clouds instead of the sky, as its
    /// cover does: clouds in space hide more of the sky than they stand over, the more the taller they are.
    pub fn shown(&self, params: &SkyParams) -> f32 {
        // Neither camera nor moment change what is read here.
        let camera = Camera::looking(0.0, 0.0, 1.0, [1, 1]);
        let uniforms = self.pack_data.uniforms(params, &camera, 0.0, 0.0);
        let share = |opacity: f32| match params.method {
            Method::Packed => self.packed_share(&uniforms.packed, opacity),
            Method::Octaves => octaves_share(&uniforms.octaves, opacity),
            Method::Fbm => self.fbm_share(&uniforms.fbm, opacity),
            Method::Lit => lit_share(&uniforms.lit, opacity),
            Method::Sprites => params.clamped().cover,
        };
        let [hazy, clearness] = haze(&uniforms);
        OKTAS * ((1.0 - hazy) * share(OPAQUE) + hazy * share(OPAQUE / clearness))
    }
}

/// The share of the counted sky that lies in the haze of the horizon, and what the haze leaves of opacity in its middle.
fn haze(uniforms: &Uniforms) -> [f32; 2] {
    let out = uniforms.clouds.haze_scale.recip();
    let hazy = ((out - LEAST_SINE) / (1.0 - LEAST_SINE)).max(0.0);
    [hazy, smoothstep(0.0, out, 0.5 * (out + LEAST_SINE))]
}

impl Oktas {
    /// The share of places with more than this opacity, by the packed method.
    fn packed_share(&self, packed: &PackedUniforms, opacity: f32) -> f32 {
        let smooth = packed.smoothness;
        let lower = |opacity: f32| {
            if opacity < 0.0 {
                return 1.0;
            }
            let alpha = before_softening(opacity, packed::EDGE)
                / (packed.contrast * (1.0 + 2.0 * packed.density));
            self.detail.mean(|detail| {
                self.amount
                    .above(packed.threshold + alpha / (detail + (1.0 - detail) * smooth))
            })
        };
        if packed.upper_layer == 0.0 {
            return lower(opacity);
        }
        self.noise.mean(|wisp| {
            let veil = smoothstep(packed::UPPER_THRESHOLD, 1.0, wisp);
            let clear = 1.0 - packed.upper_layer * packed::UPPER_OPACITY * veil;
            lower(behind(opacity, clear))
        })
    }

    /// The same by the fbm method.
    fn fbm_share(&self, fbm: &FbmUniforms, opacity: f32) -> f32 {
        let cover = fbm::FULL * before_smoothstep(opacity);
        self.fbm.mean(|finer| {
            let rough = 4.0 * fbm.roughness * (finer - fbm.mean);
            self.fbm
                .above((before_roughening(cover, rough) - fbm.intercept) / fbm.slope)
        })
    }
}

/// The same by the octaves method, where every amount is equally likely.
fn octaves_share(octaves: &OctaveUniforms, opacity: f32) -> f32 {
    let middle = clearness(&octaves.middle, |thickness| {
        let full = 1.0 - (octaves::THIN * octaves.exponent * thickness).exp2();
        1.0 - octaves::MIDDLE_OPACITY * softened(full, octaves::EDGE)
    });
    let high = clearness(&octaves.high, |thickness| {
        1.0 - octaves::HIGH_OPACITY * smoothstep(0.0, 1.0, thickness * octaves.high_contrast)
    });
    // The low dome needs no more than the whole opacity, whatever is behind it.
    let steps: Vec<f32> = (0..=NODES)
        .map(|i| low_dome(octaves, opacity * i as f32 / NODES as f32))
        .collect();
    let low = |needed: f32| {
        if needed < 0.0 {
            return 1.0;
        }
        let place = (needed / opacity).min(1.0) * NODES as f32;
        let step = (place as usize).min(NODES - 1);
        steps[step] + (steps[step + 1] - steps[step]) * (place - step as f32)
    };
    let pairs = middle
        .iter()
        .flat_map(|m| high.iter().map(move |h| (m[0] * h[0], m[1] * h[1])));
    pairs
        .map(|(share, clear)| share * low(behind(opacity, clear)))
        .sum()
}

/// The share of the low dome with more than this opacity, averaged over the finer read.
fn low_dome(octaves: &OctaveUniforms, opacity: f32) -> f32 {
    let above = |finer: f32| {
        let alpha = before_roughening(opacity, octaves.roughness * finer);
        let full = before_softening(alpha, octaves::EDGE).min(1.0);
        // At sharpness 0 there is no cloud however thick.
        let thickness = (1.0 - full).log2() / octaves.exponent.min(-1e-6);
        1.0 - (octaves.low.threshold + thickness).clamp(0.0, 1.0)
    };
    let nodes = (0..NODES).map(|i| (i as f32 + 0.5) / NODES as f32 - 0.5);
    nodes.map(above).sum::<f32>() / NODES as f32
}

/// The same by the lit method: layers are independent but for the grain of their iteration, of which every rank is equally likely.
fn lit_share(lit: &LitUniforms, opacity: f32) -> f32 {
    const RANKS: usize = 8;
    let count = lit.count as usize;
    let open = Histogram::of([1.0].into_iter());
    let clear_with = |rank: usize| {
        let layers = lit.layers[..count].chunks(LAYERS_AN_ITERATION).enumerate();
        layers.fold(open.clone(), |all, (iteration, layers)| {
            // Another iteration's grain is another one: any other order of the ranks.
            let rank = (rank * (1 + 2 * iteration)) % RANKS;
            let finer = (rank as f32 + 0.5) / RANKS as f32 - 0.5;
            let grain = if layers[0].grain > 0.0 { finer } else { 0.0 };
            layers.iter().fold(all, |all, layer| {
                Histogram::of_pairs(&all, &lit_clearness(layer, grain), |all, layer| all * layer)
            })
        })
    };
    let shares = (0..RANKS).map(|rank| 1.0 - clear_with(rank).above(1.0 - opacity));
    shares.sum::<f32>() / RANKS as f32
}

/// What a layer leaves of the light behind it: every amount is equally likely.
fn lit_clearness(layer: &LitLayerUniforms, grain: f32) -> Histogram {
    const AMOUNTS: usize = 512;
    let clear = (0..AMOUNTS).map(|i| {
        let thickness = ((i as f32 + 0.5) / AMOUNTS as f32 - layer.threshold).max(0.0);
        let alpha = smoothstep(0.0, 1.0, layer.steepness * thickness);
        let rough = alpha + layer.grain * grain * alpha * (1.0 - alpha);
        1.0 - layer.opacity * rough.clamp(0.0, 1.0)
    });
    Histogram::of(clear)
}

/// Shares of a dome and what each leaves of the light behind it, by the thickness above its cut.
fn clearness(dome: &OctaveDome, of_thickness: impl Fn(f32) -> f32) -> Vec<[f32; 2]> {
    let open = dome.threshold.clamp(0.0, 1.0);
    let node = |i: usize| {
        let amount = open + (1.0 - open) * (i as f32 + 0.5) / DOME_NODES as f32;
        [
            (1.0 - open) / DOME_NODES as f32,
            of_thickness(amount - dome.threshold),
        ]
    };
    let clouds = (0..DOME_NODES).map(node).filter(|[share, _]| *share > 0.0);
    [[open, 1.0]].into_iter().chain(clouds).collect()
}

/// The opacity that gives `opacity` together with what leaves `clear` of the light; below 0 none is needed.
fn behind(opacity: f32, clear: f32) -> f32 {
    1.0 - (1.0 - opacity) / clear
}

/// Inverse of `c + k c (1 - c)` in 0..1: the finer reads' roughening. One root, since 0 and 1 stay where they are.
fn before_roughening(rough: f32, k: f32) -> f32 {
    let b = 1.0 + k;
    2.0 * rough / (b + (b * b - 4.0 * k * rough).max(0.0).sqrt()).max(1e-9)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_inverse_is_one() {
        for i in 1..100 {
            let x = i as f32 / 100.0;
            assert!(
                (before_smoothstep(smoothstep(0.0, 1.0, x)) - x).abs() < 1e-3,
                "{x}"
            );
            for edge in [packed::EDGE, octaves::EDGE] {
                assert!((before_softening(softened(x, edge), edge) - x).abs() < 1e-4);
            }
            for k in [-3.0, -1.0, -0.4, 0.0, 0.4, 1.0, 3.0] {
                let c = before_roughening(x, k);
                let back = c + k * c * (1.0 - c);
                assert!(
                    (0.0..=1.0).contains(&c) && (back - x).abs() < 1e-3,
                    "{x} {k}: {c}"
                );
            }
        }
        // Half of the light is behind the veil: 0.1 of the whole is asked for, and the veil alone is enough.
        assert!(behind(0.1, 0.5) < 0.0);
        assert!((behind(0.1, 1.0) - 0.1).abs() < 1e-6);
        let (veil, cloud) = (0.04, behind(0.1, 0.96));
        assert!((1.0 - (1.0 - veil) * (1.0 - cloud) - 0.1_f32).abs() < 1e-6);
    }
}

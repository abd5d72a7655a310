//! Twin of clouds/packed/paper.wgsl.

use glam::Vec3;
use welkin_runtime::internals::clouds::packed::EDGE;
use welkin_runtime::internals::clouds::packed::paper::FOLD;
use welkin_runtime::internals::frame::Uniforms;

use crate::clouds::{self, Inputs, light, soften};
use crate::dome;
use crate::packed::{noise, over_veil, sample};

/// The four samples that the paper's shader starts from (lines 10-13).
#[derive(Clone, Copy, Debug)]
pub struct Samples {
    /// First layer.
    pub photo: f32,
    /// Second layer.
    pub noise: f32,
    /// Detail.
    pub detail: f32,
    /// Sunset gradient times sunset.
    pub tint: f32,
}

/// Lines 14 to 27: display-referred colour and opacity.
pub fn shade(uniforms: &Uniforms, samples: Samples) -> (Vec3, f32) {
    let (packed, clouds) = (&uniforms.packed, &uniforms.clouds);
    let Samples {
        photo,
        noise,
        detail,
        tint,
    } = samples;
    let amount = photo + noise * (1.0 - photo);
    let mut alpha = (amount - packed.threshold) * packed.contrast;
    let mut grey = amount + detail * (1.0 - amount);
    alpha *= detail + (1.0 - detail) * packed.smoothness;
    if alpha > 0.0 {
        let thick = packed.density * alpha * 2.0;
        grey += thick;
        alpha += thick;
    }
    let (grey, alpha) = (fold(grey).clamp(0.0, 1.0), alpha.clamp(0.0, 1.0));
    (Vec3::splat(grey).lerp(clouds.tint, tint), alpha)
}

/// Lines 22-23 with the kink rounded off.
pub fn fold(grey: f32) -> f32 {
    let beyond = grey - 1.0;
    grey - 0.75 * (beyond + libm::sqrtf(beyond * beyond + FOLD * FOLD))
}

/// See [`crate::methods::layer`]. Reads: photo, noise, detail, upper layer.
pub fn layer(inputs: &Inputs, direction: Vec3, narrowing: f32) -> (Vec3, f32) {
    let (packed, clouds) = (&inputs.uniforms.packed, &inputs.uniforms.clouds);
    let hit = dome::intersect(direction);
    let level = clouds::level(&hit, narrowing);
    let photo_uv = hit.plane * packed.photo_scale + packed.photo_offset;
    let detail_uv = hit.plane * packed.detail_scale + packed.detail_offset;
    let tint = clouds::tint(clouds, inputs.clouds, direction);
    let samples = Samples {
        photo: sample(inputs, photo_uv, level + packed.photo_lod_bias)[0] + inputs.nudges[0],
        noise: noise(inputs, hit.plane, level) + inputs.nudges[1],
        detail: sample(inputs, detail_uv, level + packed.detail_lod_bias)[2] + inputs.nudges[2],
        tint,
    };
    let (display, alpha) = shade(inputs.uniforms, samples);
    let lower = (light(clouds, display, 1.0), soften(alpha, EDGE));
    over_veil(inputs, direction, level, tint, lower, inputs.nudges[3])
}

#[cfg(test)]
mod tests {
    use welkin_runtime::internals::clouds::packed::PackedUniforms;
    use welkin_runtime::internals::clouds::shared::CloudUniforms;
    use welkin_runtime::params::Shading;

    use super::*;

    /// The paper's lines, worked by hand; brightness is folded as [`fold`] does it.
    #[test]
    fn lines_14_to_27_give_what_they_give_by_hand() {
        let uniforms = |cover: f32, density: f32| Uniforms {
            packed: PackedUniforms {
                threshold: 1.0 - cover,
                contrast: 1.0 / cover.max(0.05),
                density,
                smoothness: density,
                ..Default::default()
            },
            clouds: CloudUniforms {
                tint: Vec3::new(1.0, 0.5, 0.25),
                sunset: 1.0,
                ..Default::default()
            },
            ..Default::default()
        };
        let near = |(colour, alpha): (Vec3, f32), expected: Vec3, expected_alpha: f32| {
            let off = (colour - expected)
                .abs()
                .max_element()
                .max((alpha - expected_alpha).abs());
            assert!(
                off < 1e-5,
                "{colour} {alpha}, expected {expected} {expected_alpha}"
            );
        };
        let samples = |photo, noise, tint| Samples {
            photo,
            noise,
            detail: 0.5,
            tint,
        };
        // Figure 2's cover: c = 0.2 + 0.3 * 0.8 = 0.44; a = 0.13 / 0.69 * 0.5; rgb = 0.44 + 0.5 * 0.56.
        let thin = Vec3::splat(fold(0.72));
        near(
            shade(&uniforms(0.69, 0.0), samples(0.2, 0.3, 0.0)),
            thin,
            0.094_202_9,
        );
        // Figure 4's: c = 0.8; a = 0.37 / 0.57 * 0.92 = 0.597193; rgb = 0.9 + 1.003284.
        near(
            shade(&uniforms(0.57, 0.84), samples(0.5, 0.6, 0.0)),
            Vec3::splat(fold(1.903_284)),
            1.0,
        );
        // Nothing is left of a clear place, and half the tint where the tint is a half.
        assert_eq!(shade(&uniforms(0.5, 0.3), samples(0.1, 0.2, 0.0)).1, 0.0);
        let half = (thin + Vec3::new(1.0, 0.5, 0.25)) / 2.0;
        near(
            shade(&uniforms(0.69, 0.0), samples(0.2, 0.3, 0.5)),
            half,
            0.094_202_9,
        );
    }

    /// An overcast's horizon is the twin's cloud where every channel has its mean.
    #[test]
    fn a_shut_sky_far_away_is_the_mean_cloud() {
        let pack = crate::pack::default_pack();
        let facts = welkin_runtime::internals::pack_data::PackData::new(pack)
            .expect("the pack has every role");
        let [photo, noise, detail] = facts.cloud_means;
        let camera = welkin_runtime::Camera::looking(0.0, 0.3, 1.0, [64, 64]);
        for (time, density) in [(0.5, 0.0), (0.3, 0.6), (0.0, 1.0)] {
            let params = welkin_runtime::SkyParams {
                cover: 1.0,
                density,
                time,
                shading: Shading::Paper,
                ..Default::default()
            };
            let uniforms = facts.uniforms(&params, &camera, 0.0, 0.0);
            let samples = Samples {
                photo,
                noise,
                detail,
                tint: 0.0,
            };
            let (grey, _) = shade(&uniforms, samples);
            let apart = light(&uniforms.clouds, grey, 1.0) - uniforms.sky.overcast;
            assert!(
                apart.abs().max_element() < 1e-5,
                "{time} {density}: {apart}"
            );
            assert_eq!(uniforms.sky.overcast_weight, 1.0);
        }
        let fair = facts.uniforms(&welkin_runtime::SkyParams::default(), &camera, 0.0, 0.0);
        assert_eq!(
            fair.sky.overcast_weight, 0.0,
            "the paper's sky below cover 0.8"
        );
    }

    #[test]
    fn the_fold_is_the_papers_but_for_its_kink() {
        for i in 0..300 {
            let grey = i as f32 * 0.01;
            let papers = if grey > 1.0 {
                1.0 - (grey - 1.0) * 0.5
            } else {
                grey
            };
            // sqrt(x^2 + w^2) - |x| is at most w^2 / 2|x|, and w at the kink itself.
            let beyond = (grey - 1.0).abs().max(1e-6);
            let bound = 0.75 * FOLD.min(FOLD * FOLD / (2.0 * beyond));
            let below = papers - fold(grey);
            assert!(
                below > -1e-5 && below < bound + 1e-5,
                "{grey}: {papers}, folded {}",
                fold(grey)
            );
        }
    }
}

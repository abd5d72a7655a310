//! Twin of clouds.wgsl.

use glam::{Vec2, Vec3};
use welkin_pack::mapping;
use welkin_runtime::clouds::{CORE, EDGE, FOLD, UPPER_OPACITY, UPPER_THRESHOLD};
use welkin_runtime::dome::CLOUD_SPHERE_RADIUS;
use welkin_runtime::uniforms::CloudUniforms;

use crate::dome;
use crate::texture::{Texture, smoothstep};
use crate::xyz;

/// The four samples that the paper's shader starts from (lines 10-13).
#[derive(Clone, Copy, Debug)]
pub struct Samples {
    /// First layer.
    pub photo: f32,
    /// Second layer.
    pub noise: f32,
    /// Detail.
    pub detail: f32,
    /// Sunset gradient.
    pub gradient: f32,
}

/// Lines 14 to 27: display-referred colour and opacity.
pub fn shade(clouds: &CloudUniforms, samples: Samples) -> (Vec3, f32) {
    let [cut, stretch, density, _] = clouds.shape;
    let Samples {
        photo,
        noise,
        detail,
        gradient,
    } = samples;
    let amount = photo + noise * (1.0 - photo);
    let mut alpha = (amount - cut) * stretch;
    let mut grey = amount + detail * (1.0 - amount);
    alpha *= detail + (1.0 - detail) * clouds.levels[2];
    if alpha > 0.0 {
        let thick = density * alpha * 2.0;
        grey += thick;
        alpha += thick;
    }
    let (grey, alpha) = (fold(grey).clamp(0.0, 1.0), alpha.clamp(0.0, 1.0));
    (
        Vec3::splat(grey).lerp(xyz(clouds.tint), gradient * clouds.tint[3]),
        alpha,
    )
}

/// Lines 22-23 with the kink rounded off.
pub fn fold(grey: f32) -> f32 {
    let beyond = grey - 1.0;
    grey - 0.75 * (beyond + libm::sqrtf(beyond * beyond + FOLD * FOLD))
}

/// Opacity with its foot softened.
pub fn soften(alpha: f32) -> f32 {
    alpha * alpha * (1.0 + EDGE) / (alpha + EDGE)
}

/// Radiance of display-referred grey.
pub fn light(clouds: &CloudUniforms, grey: Vec3) -> Vec3 {
    let bright = CORE + (1.0 - CORE) * grey;
    bright * (bright * xyz(clouds.sunlight) + xyz(clouds.ambient))
}

/// Radiance and opacity along a unit direction above the horizon. `narrowing` is the cosine of its angle to the
/// axis of the lens.
pub fn layer(
    clouds: &CloudUniforms,
    texture: &Texture,
    direction: Vec3,
    narrowing: f32,
) -> (Vec3, f32) {
    let hit = dome::intersect(direction);
    let side = hit.distance * narrowing;
    let level = 0.5 * libm::log2f(side * side * (CLOUD_SPHERE_RADIUS + 1.0) / hit.root);
    let at = |uv: Vec2, constant: f32| texture.sample(uv.to_array(), level + constant);
    let [photo, photo_x, photo_y, photo_level] = clouds.photo;
    let [detail, detail_x, detail_y, detail_level] = clouds.detail;
    let [cos, sin, noise_x, noise_y] = clouds.noise;
    let [noise_level, upper_level, ..] = clouds.levels;
    let [east, south, first, span] = clouds.gradient;
    let place = mapping::direction_to_gradient(direction.to_array(), [east, south]);
    let samples = Samples {
        photo: at(hit.plane * photo + Vec2::new(photo_x, photo_y), photo_level)[0],
        noise: at(
            Vec2::new(cos, sin).rotate(hit.plane) + Vec2::new(noise_x, noise_y),
            noise_level,
        )[1],
        detail: at(
            hit.plane * detail + Vec2::new(detail_x, detail_y),
            detail_level,
        )[2],
        gradient: texture.sample([0.5, first + span * place], 0.0)[3],
    };
    let (display, alpha) = shade(clouds, samples);
    let (mut radiance, mut alpha) = (light(clouds, display), soften(alpha));
    let upper = clouds.shape[3];
    if upper > 0.0 {
        let [x, y, offset_x, offset_y] = clouds.upper;
        let wisp = at(
            hit.plane * Vec2::new(x, y) + Vec2::new(offset_x, offset_y),
            upper_level,
        )[1];
        let veil = upper * UPPER_OPACITY * smoothstep(UPPER_THRESHOLD, 1.0, wisp);
        let over = alpha + veil * (1.0 - alpha);
        let white = light(
            clouds,
            Vec3::ONE.lerp(xyz(clouds.tint), samples.gradient * clouds.tint[3]),
        );
        radiance = white.lerp(radiance, alpha / over.max(1e-4));
        alpha = over;
    }
    (
        radiance,
        alpha * smoothstep(0.0, clouds.levels[3], direction.y),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The paper's lines, worked by hand; brightness is folded as [`fold`] does it.
    #[test]
    fn lines_14_to_27_give_what_they_give_by_hand() {
        let uniforms = |cover: f32, density: f32, sunset: f32| CloudUniforms {
            shape: [1.0 - cover, 1.0 / cover.max(0.05), density, 0.0],
            levels: [0.0, 0.0, density, 0.0],
            tint: [1.0, 0.5, 0.25, sunset],
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
        let samples = |photo, noise, gradient| Samples {
            photo,
            noise,
            detail: 0.5,
            gradient,
        };
        // Figure 2's cover: c = 0.2 + 0.3 * 0.8 = 0.44; a = 0.13 / 0.69 * 0.5; rgb = 0.44 + 0.5 * 0.56.
        let thin = Vec3::splat(fold(0.72));
        near(
            shade(&uniforms(0.69, 0.0, 0.0), samples(0.2, 0.3, 0.0)),
            thin,
            0.094_202_9,
        );
        // Figure 4's: c = 0.8; a = 0.37 / 0.57 * 0.92 = 0.597193; rgb = 0.9 + 1.003284.
        near(
            shade(&uniforms(0.57, 0.84, 0.0), samples(0.5, 0.6, 0.0)),
            Vec3::splat(fold(1.903_284)),
            1.0,
        );
        // Nothing is left of a clear place, and half the tint where gradient times sunset is a half.
        assert_eq!(
            shade(&uniforms(0.5, 0.3, 0.0), samples(0.1, 0.2, 0.0)).1,
            0.0
        );
        let half = (thin + Vec3::new(1.0, 0.5, 0.25)) / 2.0;
        near(
            shade(&uniforms(0.69, 0.0, 0.5), samples(0.2, 0.3, 1.0)),
            half,
            0.094_202_9,
        );
    }

    /// A shut sky's horizon is the twin's cloud where every channel has its mean.
    #[test]
    fn a_shut_sky_far_away_is_the_mean_cloud() {
        let pack = crate::pack::default_pack();
        let facts = welkin_runtime::frame::Facts::new(pack).expect("the pack has every role");
        let [photo, noise, detail] = facts.cloud_means;
        let camera = welkin_runtime::Camera::looking(0.0, 0.3, 1.0, [64, 64]);
        for (time, density) in [(0.5, 0.0), (0.3, 0.6), (0.0, 1.0)] {
            let params = welkin_runtime::SkyParams {
                cover: 1.0,
                density,
                time,
                ..Default::default()
            };
            let uniforms = facts.uniforms(&params, &camera, 0.0, 0.0);
            let samples = Samples {
                photo,
                noise,
                detail,
                gradient: 0.0,
            };
            let (grey, _) = shade(&uniforms.clouds, samples);
            let apart = light(&uniforms.clouds, grey) - xyz(uniforms.sky.overcast);
            assert!(
                apart.abs().max_element() < 1e-5,
                "{time} {density}: {apart}"
            );
            assert_eq!(uniforms.sky.overcast[3], 1.0);
        }
        let fair = facts.uniforms(&welkin_runtime::SkyParams::default(), &camera, 0.0, 0.0);
        assert_eq!(fair.sky.overcast[3], 0.0, "the paper's sky below cover 0.8");
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

    #[test]
    fn opacity_starts_without_a_kink_and_keeps_its_ends() {
        assert_eq!(soften(0.0), 0.0);
        assert!((soften(1.0) - 1.0).abs() < 1e-6);
        assert!(soften(1e-3) / 1e-3 < 0.01, "slope 0 at the foot");
        assert!((1..=100).all(|i| soften(i as f32 * 0.01) > soften((i - 1) as f32 * 0.01)));
    }
}

//! Twin of clouds/packed/packed.wgsl.

use glam::{Vec2, Vec3};
use welkin_runtime::internals::clouds::packed::PackedUniforms;
use welkin_runtime::internals::clouds::packed::{
    DEPTHS, EDGE, FOOT, FULL, OWN, RELIEF, RELIEF_FULL, SHARES, UPPER_OPACITY, UPPER_THRESHOLD,
};

use crate::clouds::{self, Inputs, light, lit, scattered, soften};
use crate::dome;
use crate::texture::smoothstep;

/// What a place of the layer is computed from.
#[derive(Clone, Copy, Debug)]
pub struct Samples {
    /// Photo at three places towards the sun, and here.
    pub photos: [f32; 4],
    /// Noise.
    pub noise: f32,
    /// Detail here, and a little towards the sun.
    pub details: [f32; 2],
}

/// A place of the layer.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// Height of the cloud.
    pub height: f32,
    /// What of it darkens.
    pub thickness: f32,
    /// Cloud that the light has passed, in heights.
    pub passed: f32,
    /// Opacity.
    pub alpha: f32,
}

/// From samples to opacity and to what the light has passed.
pub fn place(packed: &PackedUniforms, samples: Samples) -> Place {
    let noise = samples.noise;
    let heights = samples.photos.map(|photo| {
        let amount = photo + noise * (1.0 - photo);
        (amount - packed.threshold) * packed.contrast
    });
    let [detail, beyond] = samples.details;
    let height = (heights[3] - packed.erosion * (1.0 - detail)).max(0.0);
    let mut passed = RELIEF * (beyond - detail) * (RELIEF_FULL * height).min(1.0);
    for i in 0..3 {
        let over = DEPTHS[i] + packed.shut + 0.5 * packed.erosion;
        passed += SHARES[i] * (heights[i] - over).max(0.0);
    }
    let thickness = (height - packed.shut).max(0.0);
    let halvings = packed.opacity_rate * height * height / (height + FOOT);
    Place {
        height,
        thickness,
        passed: (passed + OWN * thickness).max(0.0),
        alpha: (FULL * (1.0 - libm::exp2f(-halvings))).min(1.0),
    }
}

/// A read of the packed texture.
pub fn sample(inputs: &Inputs, uv: Vec2, level: f32) -> [f32; 4] {
    inputs.clouds.sample(uv.to_array(), level)
}

/// A read of the noise.
pub fn noise(inputs: &Inputs, plane: Vec2, level: f32) -> f32 {
    let packed = &inputs.uniforms.packed;
    let turned = packed.noise_rotation.rotate(plane);
    sample(
        inputs,
        turned + packed.noise_offset,
        level + packed.noise_lod_bias,
    )[1]
}

/// See [`crate::methods::layer`]. Reads: photo at three places towards the sun and here, noise, detail here and beyond, upper layer.
pub fn layer(inputs: &Inputs, direction: Vec3, narrowing: f32) -> (Vec3, f32) {
    let (packed, clouds) = (&inputs.uniforms.packed, &inputs.uniforms.clouds);
    let hit = dome::intersect(direction);
    let level = clouds::level(&hit, narrowing);
    let photo_uv = hit.plane * packed.photo_scale + packed.photo_offset;
    let map = inputs.map_at(photo_uv.to_array(), level + packed.map_lod_bias);
    let detail_uv = hit.plane * packed.detail_scale + packed.detail_offset;
    let detail = |uv, nudge: usize| {
        sample(inputs, uv, level + packed.detail_lod_bias)[2] + inputs.nudges[nudge]
    };
    let samples = Samples {
        photos: std::array::from_fn(|i| map[i] + inputs.nudges[i]),
        noise: noise(inputs, hit.plane, level) + inputs.nudges[4],
        details: [
            detail(detail_uv, 5),
            detail(detail_uv + packed.detail_step, 6),
        ],
    };
    let tint = clouds::tint(clouds, inputs.clouds, direction);
    let place = place(packed, samples);
    let depth = packed.extinction * place.passed;
    let shares = scattered(inputs.uniforms, direction, depth, place.thickness);
    let lower = (lit(clouds, shares, tint), soften(place.alpha, EDGE));
    over_veil(inputs, direction, level, tint, lower, inputs.nudges[7])
}

/// The lower layer, and the upper one behind it.
pub fn over_veil(
    inputs: &Inputs,
    direction: Vec3,
    level: f32,
    tint: f32,
    (lower, alpha): (Vec3, f32),
    nudge: f32,
) -> (Vec3, f32) {
    let (packed, clouds) = (&inputs.uniforms.packed, &inputs.uniforms.clouds);
    let (mut radiance, mut opacity) = (lower, alpha);
    if packed.upper_layer > 0.0 {
        let veil = veil(inputs, dome::intersect(direction).plane, level, nudge);
        opacity = alpha + veil * (1.0 - alpha);
        let facing = clouds::facing(inputs.uniforms, direction, 0.0);
        let white = light(clouds, Vec3::ONE.lerp(clouds.tint, tint), facing);
        radiance = white.lerp(lower, alpha / opacity.max(1e-4));
    }
    (radiance, opacity * clouds::clearness(clouds, direction))
}

/// Opacity of the thin upper layer.
fn veil(inputs: &Inputs, plane: Vec2, level: f32, nudge: f32) -> f32 {
    let packed = &inputs.uniforms.packed;
    let uv = plane * packed.upper_scale + packed.upper_offset;
    let wisp = sample(inputs, uv, level + packed.upper_lod_bias)[1] + nudge;
    packed.upper_layer * UPPER_OPACITY * smoothstep(UPPER_THRESHOLD, 1.0, wisp)
}

/// The dome behind sprites: the upper layer alone.
pub fn upper_layer(inputs: &Inputs, direction: Vec3, narrowing: f32) -> (Vec3, f32) {
    let clouds = &inputs.uniforms.clouds;
    let hit = dome::intersect(direction);
    let level = clouds::level(&hit, narrowing);
    let veil = veil(inputs, hit.plane, level, inputs.nudges[0]);
    let tint = clouds::tint(clouds, inputs.clouds, direction);
    let facing = clouds::facing(inputs.uniforms, direction, 0.0);
    let white = light(clouds, Vec3::ONE.lerp(clouds.tint, tint), facing);
    (white, veil * clouds::clearness(clouds, direction))
}

#[cfg(test)]
mod tests {
    use welkin_runtime::internals::pack_data::PackData;
    use welkin_runtime::{Camera, SkyParams};

    use super::*;

    fn packed(params: &SkyParams) -> PackedUniforms {
        let facts = PackData::new(crate::pack::default_pack()).expect("the pack has every role");
        let camera = Camera::looking(0.0, 0.3, 1.0, [64, 64]);
        facts.uniforms(params, &camera, 0.0, 0.0).packed
    }

    fn of(photos: [f32; 4], details: [f32; 2]) -> Samples {
        Samples {
            photos,
            noise: 0.0,
            details,
        }
    }

    #[test]
    fn cloud_towards_the_sun_takes_light_and_cloud_below_the_ray_does_not() {
        let packed = packed(&SkyParams::default());
        let alone = place(&packed, of([0.0, 0.0, 0.0, 0.9], [0.5, 0.5]));
        let mut last = alone.passed;
        for towards in [0.6, 0.8, 1.0] {
            let shaded = place(&packed, of([towards, towards, towards, 0.9], [0.5, 0.5]));
            assert!(shaded.passed >= last && shaded.alpha == alone.alpha);
            last = shaded.passed;
        }
        assert!(last > alone.passed + 0.5, "{last}");
        // A cloud farther towards the sun that is lower than the ray.
        let low = 1.0 - SkyParams::default().cover + 0.2;
        let below = place(&packed, of([0.0, 0.0, low, 0.9], [0.5, 0.5]));
        assert_eq!(below.passed, alone.passed);
    }

    #[test]
    fn detail_eats_edges_and_leaves_thick_clouds_whole() {
        let packed = packed(&SkyParams::default());
        let height = |photo: f32, detail: f32| place(&packed, of([photo; 4], [detail; 2]));
        let (thin, thick) = (0.5, 1.0);
        assert!(height(thin, 1.0).alpha > 0.2);
        assert_eq!(height(thin, 0.3).alpha, 0.0);
        assert!(height(thick, 0.0).alpha > 0.8 * height(thick, 1.0).alpha);
    }

    #[test]
    fn a_bump_is_brighter_on_the_side_of_the_sun() {
        let packed = packed(&SkyParams::default());
        let passed = |details| place(&packed, of([0.8; 4], details)).passed;
        assert!(passed([0.5, 0.3]) < passed([0.5, 0.5]));
        assert!(passed([0.5, 0.5]) < passed([0.5, 0.7]));
    }

    /// An overcast's horizon is the cloud where every channel has its mean, here and towards the sun.
    #[test]
    fn a_shut_sky_far_away_is_the_mean_cloud() {
        let facts = PackData::new(crate::pack::default_pack()).expect("the pack has every role");
        let [photo, noise, detail] = facts.cloud_means;
        let camera = Camera::looking(0.0, 0.3, 1.0, [64, 64]);
        for (time, density) in [(0.5, 0.0), (0.3, 0.6), (0.0, 1.0)] {
            let params = SkyParams {
                cover: 1.0,
                density,
                time,
                ..Default::default()
            };
            let uniforms = facts.uniforms(&params, &camera, 0.0, 0.0);
            let mean = place(
                &uniforms.packed,
                Samples {
                    photos: [photo; 4],
                    noise,
                    details: [detail; 2],
                },
            );
            let depth = uniforms.packed.extinction * mean.passed;
            // The mean of all directions: scattering that follows the phase function counts as if it went to all sides.
            let sides: Vec<Vec3> = (0..400)
                .map(|i| {
                    let cosine = (i as f32 + 0.5) / 200.0 - 1.0;
                    let direction = side(uniforms.sky.sun_direction, cosine);
                    let shares = scattered(&uniforms, direction, depth, mean.thickness);
                    lit(&uniforms.clouds, shares, 0.0)
                })
                .collect();
            let round = sides.iter().sum::<Vec3>() / 400.0;
            let apart = (round - uniforms.sky.overcast) / uniforms.sky.overcast;
            // The phase function is cut about the sun.
            assert!(
                apart.abs().max_element() < 0.03,
                "{time} {density}: {apart}"
            );
            assert_eq!(uniforms.sky.overcast_weight, 1.0);
        }
        let fair = facts.uniforms(&SkyParams::default(), &camera, 0.0, 0.0);
        assert_eq!(
            fair.sky.overcast_weight, 0.0,
            "the paper's sky below cover 0.8"
        );
    }

    /// A unit direction of that cosine to another.
    fn side(to: Vec3, cosine: f32) -> Vec3 {
        to * cosine + to.any_orthonormal_vector() * (1.0 - cosine * cosine).sqrt()
    }
}

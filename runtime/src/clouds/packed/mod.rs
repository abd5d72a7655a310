//! The packed method: the cloud shader of Roden and Parberry (ACE 2005, section 3.1) on the packed texture.
//!
//! # Theory
//! Photo and noise are blended, cover cuts from below and stretches the rest (lines 14-17), detail
//! brightens and, where clouds are not dense, roughens (18-19), density darkens thick parts by folding
//! brightness at 1 (20-24); tint and light are those of [`crate::clouds::shared`] (26-28).
//! Height scales the coordinates, speed moves them; photo and noise move in slightly different
//! directions at slightly different speeds, so that shapes change (section 3.2).
//!
//! # Changes versus the paper
//! - Coordinates come from the hit with the cloud dome, not from a mesh ([`crate::geometry::dome`]). Noise is
//!   turned and scaled against the photo by irrational amounts, so that their sum does not repeat.
//! - The level of detail is computed: no derivatives, so every read may stand in a branch.
//! - Opacity is softened at its foot, `a^2 (1 + e) / (a + e)`: the paper's rises with a kink that shows
//!   each texel of a cloud's edge.
//! - The fold of brightness at 1 is rounded ([`FOLD`]): its kink draws a bright line into dense clouds.
//! - The paper's cover 1 leaves holes where both channels are 0. Above 0.8 the cut of line 15 goes on below 0,
//!   and detail no longer pierces: an overcast sky has no holes.
//! - The thin upper layer (figure 5) is laid behind the lower one instead of added to it.
//!
//! # Practice
//! Three trilinear reads; one bilinear with sunset above 0, one more trilinear with the upper layer on.

pub mod coverage;

use glam::{DVec2, Vec2, Vec3};

use crate::clouds::shared::{
    CloudUniforms, CloudView, LOW_HEIGHT_M, MAX_WIND, offset, overcast_weight, radiance,
};
use crate::geometry::part::{Part, Value};
use crate::geometry::uniforms::uniforms;
use crate::params::SkyParams;

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[
        ("PACKED_EDGE", Value::F32(EDGE)),
        ("PACKED_FOLD", Value::F32(FOLD)),
        ("UPPER_OPACITY", Value::F32(UPPER_OPACITY)),
        ("UPPER_THRESHOLD", Value::F32(UPPER_THRESHOLD)),
    ],
    structs: &[PackedUniforms::WGSL],
    wgsl: include_str!("packed.wgsl"),
};

uniforms! {
    /// Clouds of the packed method. Scales are in tiles a height of the layer, offsets in tiles, and a level of detail is that at distance 1.
    PackedUniforms {
        /// Where the photo lies.
        photo_offset: Vec2,
        /// Scale of the photo.
        photo_scale: f32,
        /// Level of detail of the photo.
        photo_lod_bias: f32,
        /// Scale of the noise times cosine and sine of its turn.
        noise_rotation: Vec2,
        /// Where the noise lies.
        noise_offset: Vec2,
        /// Where the detail lies.
        detail_offset: Vec2,
        /// Scale of the detail.
        detail_scale: f32,
        /// Level of detail of the detail.
        detail_lod_bias: f32,
        /// Scale of the upper layer to the east and to the south.
        upper_scale: Vec2,
        /// Where the upper layer lies.
        upper_offset: Vec2,
        /// Level of detail of the noise.
        noise_lod_bias: f32,
        /// Level of detail of the upper layer.
        upper_lod_bias: f32,
        /// How little detail pierces the clouds, 0..1 (line 19).
        smoothness: f32,
        /// Nothing.
        _pad: f32,
        /// The amount from which there is cloud (line 15).
        threshold: f32,
        /// 1 / cover, as clamped in line 16.
        contrast: f32,
        /// Density.
        density: f32,
        /// Amount of the upper layer.
        upper_layer: f32,
    }
}

/// How soft the foot of the opacity is: below it the opacity rises as a square, above it in a line.
pub const EDGE: f32 = 0.12;
/// How far from 1 the fold of brightness (lines 22-23) is rounded.
pub const FOLD: f32 = 0.15;
/// Opacity of the upper layer where its noise is 1.
pub const UPPER_OPACITY: f32 = 0.75;
/// Noise below this gives no upper cloud.
pub const UPPER_THRESHOLD: f32 = 0.12;

/// The amount of cloud that the sky has everywhere at cover 1.
const OVERCAST: f32 = 0.75;

/// Tiles of the photo a height of the layer, at height 0 and 1: a tile spans 7 and 2.75 heights.
const SCALE: [f32; 2] = [1.0 / 7.0, 1.0 / 2.75];
/// Scale of the noise and of the detail against that of the photo.
const NOISE_SCALE: f64 = 0.763;
const DETAIL_SCALE: f64 = 3.618;
/// Turn of the noise against the photo, in radians.
const NOISE_TURN: f64 = 0.6543;
/// Height of the upper layer over the ground, in metres, for its parallax.
const UPPER_HEIGHT_M: f64 = 8000.0;
/// Scale of the upper layer to the east and to the south, in tiles a height: streaks lie east to west.
const UPPER_SCALE: [f64; 2] = [0.11, 0.43];

/// Where the wind carries the photo (east, south), and the noise, which is a little faster.
const PHOTO_WIND: DVec2 = DVec2::new(0.80, 0.60);
const NOISE_WIND: DVec2 = DVec2::new(0.97, 0.62);
const UPPER_WIND: DVec2 = DVec2::new(0.45, -0.12);

/// Where the textures lie at time 0, so that no tile's corner is overhead.
const PHOTO_START: DVec2 = DVec2::new(0.37, 0.21);
const NOISE_START: DVec2 = DVec2::new(0.13, 0.58);
const UPPER_START: DVec2 = DVec2::new(0.71, 0.44);

/// The method's share of the uniforms. `params` are in range.
pub fn uniforms(params: &SkyParams, view: &CloudView) -> PackedUniforms {
    let scale = f64::from(SCALE[0] + (SCALE[1] - SCALE[0]) * params.height);
    let way = MAX_WIND * f64::from(params.speed) * view.seconds;
    let (sin, cos) = NOISE_TURN.sin_cos();
    let noise_scale = scale * NOISE_SCALE;
    let noise_way = DVec2::new(cos, sin).rotate(NOISE_WIND) * way;
    let detail_scale = scale * DETAIL_SCALE;
    let place = view.place(LOW_HEIGHT_M);
    let turned_place = DVec2::new(cos, sin).rotate(place);
    // Coordinates on the layer shrink as it comes nearer; offsets are of the layer itself.
    let near = view.distance(LOW_HEIGHT_M);
    let upper_scale = DVec2::from(UPPER_SCALE) * view.distance(UPPER_HEIGHT_M);
    let upper_place = view.place(UPPER_HEIGHT_M) - UPPER_WIND * way;
    let level = |scale: f64| view.level(scale * f64::from(view.texels));
    let overcast_weight = overcast_weight(params.cover);
    PackedUniforms {
        photo_offset: offset(PHOTO_START + (place - PHOTO_WIND * way) * scale),
        photo_scale: (scale * near) as f32,
        photo_lod_bias: level(scale * near),
        noise_rotation: (DVec2::new(cos, sin) * (noise_scale * near)).as_vec2(),
        noise_offset: offset(NOISE_START + (turned_place - noise_way) * noise_scale),
        detail_offset: offset((place - PHOTO_WIND * way) * detail_scale),
        detail_scale: (detail_scale * near) as f32,
        detail_lod_bias: level(detail_scale * near),
        upper_scale: upper_scale.as_vec2(),
        upper_offset: offset(UPPER_START + DVec2::from(UPPER_SCALE) * upper_place),
        noise_lod_bias: level(noise_scale * near),
        upper_lod_bias: level((upper_scale.x * upper_scale.y).sqrt()),
        smoothness: params.density.max(overcast_weight),
        threshold: 1.0 - params.cover - OVERCAST * overcast_weight,
        contrast: 1.0 / params.cover.max(0.05),
        density: params.density,
        upper_layer: params.upper_layer,
        ..Default::default()
    }
}

/// Radiance of an overcast sky far away, where single clouds cannot be told apart.
///
/// It is the light of a place where photo, noise and detail have their means, by the same lines as the
/// shader's; line 19 is left out, since detail does not pierce an overcast sky.
pub fn overcast(packed: &PackedUniforms, clouds: &CloudUniforms, means: [f32; 3]) -> Vec3 {
    let [photo, noise, detail] = means;
    let amount = photo + noise * (1.0 - photo);
    let alpha = ((amount - packed.threshold) * packed.contrast).max(0.0);
    let grey = fold(amount + detail * (1.0 - amount) + packed.density * alpha * 2.0);
    radiance(clouds, grey.clamp(0.0, 1.0))
}

/// `packed_fold` of the shader: lines 22-23 with the kink rounded off.
fn fold(grey: f32) -> f32 {
    let beyond = grey - 1.0;
    grey - 0.75 * (beyond + (beyond * beyond + FOLD * FOLD).sqrt())
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    fn at(params: SkyParams, seconds: f64) -> PackedUniforms {
        from(params, seconds, DVec3::ZERO)
    }

    fn from(params: SkyParams, seconds: f64, place_m: DVec3) -> PackedUniforms {
        let view = CloudView {
            texels: 512,
            pixel_rad: 1e-3,
            seconds,
            place_m,
        };
        uniforms(&params, &view)
    }

    #[test]
    fn still_air_moves_nothing_and_wind_moves_both_layers_each_its_own_way() {
        let still = SkyParams {
            speed: 0.0,
            ..SkyParams::default()
        };
        assert_eq!(at(still, 0.0), at(still, 1e5));
        let windy = SkyParams {
            speed: 1.0,
            ..SkyParams::default()
        };
        let (before, after) = (at(windy, 0.0), at(windy, 1.0));
        // Back from texture coordinates to the plane of the dome: what stood over the viewer has moved so far.
        let photo = (before.photo_offset - after.photo_offset) / before.photo_scale;
        let turn = before.noise_rotation;
        let moved = before.noise_offset - after.noise_offset;
        let noise = Vec2::new(turn.x, -turn.y).rotate(moved) / turn.length_squared();
        for (way, wind) in [(photo, PHOTO_WIND), (noise, NOISE_WIND)] {
            assert!(
                (way - (wind * MAX_WIND).as_vec2()).length() < 1e-5,
                "{way}, expected {wind}"
            );
        }
        let angle = photo.angle_to(noise).abs().to_degrees();
        assert!(
            (1.0..20.0).contains(&angle),
            "slightly different directions: {angle} degrees"
        );
        assert!(
            (1.05..1.3).contains(&(noise.length() / photo.length())),
            "slightly different speeds"
        );
    }

    #[test]
    fn who_walks_a_height_sees_the_lower_layer_a_height_on() {
        let here = at(SkyParams::default(), 0.0);
        let there = from(
            SkyParams::default(),
            0.0,
            DVec3::new(LOW_HEIGHT_M, 0.0, 0.0),
        );
        let moved = there.photo_offset.x - here.photo_offset.x;
        assert!((moved - here.photo_scale).abs() < 1e-5, "{moved}");
        let upper = there.upper_offset.x - here.upper_offset.x;
        let less = (LOW_HEIGHT_M / UPPER_HEIGHT_M) as f32;
        assert!((upper - here.upper_scale.x * less).abs() < 1e-5, "{upper}");
    }

    #[test]
    fn who_climbs_half_way_sees_clouds_twice_as_large() {
        let climbed = from(
            SkyParams::default(),
            0.0,
            DVec3::new(0.0, LOW_HEIGHT_M / 2.0, 0.0),
        );
        let here = at(SkyParams::default(), 0.0);
        assert!((climbed.photo_scale / here.photo_scale - 0.5).abs() < 1e-6);
        assert_eq!(climbed.photo_offset, here.photo_offset);
        assert!((climbed.photo_lod_bias - here.photo_lod_bias + 1.0).abs() < 1e-5);
    }

    #[test]
    fn offsets_stay_in_the_texture_for_ever() {
        let windy = SkyParams {
            speed: 1.0,
            ..SkyParams::default()
        };
        for seconds in [-1e9, -1e-9, 1e6, 1e12] {
            let c = at(windy, seconds);
            let offsets = [
                c.photo_offset,
                c.noise_offset,
                c.detail_offset,
                c.upper_offset,
            ];
            assert!(
                offsets
                    .iter()
                    .all(|o| o.min_element() >= 0.0 && o.max_element() <= 1.0),
                "{seconds}: {offsets:?}"
            );
        }
    }

    #[test]
    fn cover_is_the_papers_until_the_sky_closes() {
        let cut = |cover: f32| {
            at(
                SkyParams {
                    cover,
                    ..SkyParams::default()
                },
                0.0,
            )
            .threshold
        };
        for cover in [0.0, 0.57, 0.69, 0.8] {
            assert_eq!(cut(cover), 1.0 - cover);
        }
        assert!(cut(0.9) < 1.0 - 0.9 && cut(1.0) == -OVERCAST);
    }

    #[test]
    fn higher_clouds_are_smaller() {
        let tile = |height: f32| {
            1.0 / at(
                SkyParams {
                    height,
                    ..SkyParams::default()
                },
                0.0,
            )
            .photo_scale
        };
        assert!((tile(0.0) - 7.0).abs() < 1e-4 && (tile(1.0) - 2.75).abs() < 1e-4);
        assert!(tile(0.52) < tile(0.2));
    }
}

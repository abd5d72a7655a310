//! The packed method: the cloud shader of Roden and Parberry (ACE 2005, section 3.1) on the packed texture.
//!
//! # Theory
//! Photo and noise are blended, cover cuts from below and stretches the rest (lines 14-17): here that is the height of a cloud. Detail
//! eats its edges. Four heights towards the sun ([`map`]) and the slope of the detail tell how much cloud the light has passed, and
//! [`crate::clouds::shared`] what of it is scattered to the eye; density makes clouds thicker, smoother and darker. The paper's own shading,
//! lines 18 to 28, is in [`paper`].
//! Height scales the coordinates, speed moves them; photo and noise move in slightly different
//! directions at slightly different speeds, so that shapes change (section 3.2).
//!
//! # Changes versus the paper
//! - Clouds have a lit and a dark side: the paper's are grey by their amount. [`crate::params::Shading::Paper`] is its form.
//! - Detail is taken from the height instead of multiplying the opacity (line 19): it frays edges and leaves the middle whole.
//! - Coordinates come from the hit with the cloud dome, not from a mesh ([`crate::geometry::dome`]). Noise is
//!   turned and scaled against the photo by irrational amounts, so that their sum does not repeat.
//! - The level of detail is computed: no derivatives, so every read may stand in a branch.
//! - Opacity is softened at its foot, `a^2 (1 + e) / (a + e)`: the paper's rises with a kink that shows
//!   each texel of a cloud's edge.
//! - The fold of brightness at 1 is rounded ([`paper::FOLD`]): its kink draws a bright line into dense clouds.
//! - The paper's cover 1 leaves holes where both channels are 0. Above 0.8 the cut of line 15 goes on below 0,
//!   and detail no longer pierces: an overcast sky has no holes.
//! - The thin upper layer (figure 5) is laid behind the lower one instead of added to it.
//!
//! # Practice
//! Four trilinear reads, three with the paper's shading; one bilinear with sunset above 0, one more trilinear with the upper layer on.

pub mod coverage;
pub mod map;
pub mod paper;

use glam::{DVec2, Vec2, Vec3, Vec4};

use crate::clouds::shared::{
    CloudUniforms, CloudView, LOW_HEIGHT_M, MAX_WIND, lit, offset, overcast_weight, scattered,
    softened, way_through,
};
use crate::device::map::LEAST_SIDE;
use crate::geometry::math::smoothstep;
use crate::geometry::part::{Part, Value};
use crate::geometry::uniforms::uniforms;
use crate::params::{Shading, SkyParams};

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[
        ("PACKED_EDGE", Value::F32(EDGE)),
        ("PACKED_FULL", Value::F32(FULL)),
        ("PACKED_FOOT", Value::F32(FOOT)),
        ("PACKED_OWN", Value::F32(OWN)),
        ("PACKED_SHARES", Value::Vec3(SHARES)),
        ("PACKED_RELIEF", Value::F32(RELIEF)),
        ("PACKED_RELIEF_FULL", Value::F32(RELIEF_FULL)),
    ],
    structs: &[PackedUniforms::WGSL],
    wgsl: include_str!("packed.wgsl"),
};

/// Its thin upper layer, which the dome behind sprites has too.
pub const VEIL: Part = Part {
    constants: &[
        ("UPPER_OPACITY", Value::F32(UPPER_OPACITY)),
        ("UPPER_THRESHOLD", Value::F32(UPPER_THRESHOLD)),
    ],
    structs: &[PackedUniforms::WGSL],
    wgsl: include_str!("veil.wgsl"),
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
        /// How much of a height detail eats where it is 0.
        erosion: f32,
        /// The amount from which there is cloud (line 15).
        threshold: f32,
        /// 1 / cover, as clamped in line 16.
        contrast: f32,
        /// Density.
        density: f32,
        /// Amount of the upper layer.
        upper_layer: f32,
        /// From a place of the photo to the first one towards the sun, in tiles.
        photo_step: Vec2,
        /// The way towards the sun over which the slope of the detail is taken, in tiles.
        detail_step: Vec2,
        /// Levels of the photo at the places towards the sun.
        march_levels: Vec3,
        /// Halvings of the light by a height of 1.
        extinction: f32,
        /// Halvings of the light behind by a height of 1.
        opacity_rate: f32,
        /// Texels a side of the map.
        map_side: f32,
        /// Level of detail of the map.
        map_lod_bias: f32,
        /// Height that an overcast has everywhere and that does not darken.
        shut: f32,
        /// What is taken off an amount times the contrast: for the shade of the places towards the sun, and for the height before detail adds to it.
        cuts: Vec4,
    }
}

/// How soft the foot of the opacity is: below it the opacity rises as a square, above it in a line.
pub const EDGE: f32 = 0.12;
/// Opacity without end is brought to 1 by this: thick clouds let nothing through.
pub const FULL: f32 = 1.1;
/// The height at which opacity goes over from the square of heights to a line: edges are soft.
pub const FOOT: f32 = 0.15;
/// What the light passes of a place's own height, and of the heights towards the sun over the ray. Chosen by eye, as what follows.
pub const OWN: f32 = 0.5;
pub const SHARES: Vec3 = Vec3::new(0.55, 0.8, 1.2);
/// How high the ray has risen at the places towards the sun, as heights of clouds: one of 1 is 0.45 of the layer's height thick.
pub const DEPTHS: Vec3 = Vec3::new(0.088, 0.22, 0.484);
/// What a slope of the detail adds, and the height of a cloud, as 1 over it, from which all of it counts.
pub const RELIEF: f32 = 0.36;
pub const RELIEF_FULL: f32 = 4.0;
/// Share of the height that an overcast has everywhere which does not darken.
const SHUT: f32 = 0.7;
/// The way over which that slope is taken, against the way to the first place.
const RELIEF_WAY: f64 = 0.75;
/// How much detail eats of a height: of thin clouds, and what dense and overcast ones keep of it.
const EROSION: f32 = 0.55;
const ERODED_DENSE: f32 = 0.4;
const ERODED_OVERCAST: f32 = 0.3;
/// Levels by which the detail of an overcast is read coarser: its base is smooth.
const SOFTER: f32 = 1.5;
/// Halvings of the light behind, and of the light of the sun, by a height of 1 at density 0. Density 1 makes three times the first and
/// twice the second.
const OPACITY_RATE: f32 = 8.0;
const EXTINCTION: f32 = 3.8;
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
pub(crate) const UPPER_HEIGHT_M: f64 = 8000.0;
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

/// The method's share of the uniforms. `params` are in range; `sun` is the unit direction towards it.
pub fn uniforms(params: &SkyParams, view: &CloudView, sun: Vec3) -> PackedUniforms {
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
    let step = map::step(sun);
    let photo_step = step * scale;
    let map_side = view.texels.clamp(LEAST_SIDE, map::MOST_SIDE);
    let kept = |least: f32, weight: f32| 1.0 - (1.0 - least) * weight;
    let threshold = 1.0 - params.cover - OVERCAST * overcast_weight;
    let contrast = 1.0 / params.cover.max(0.05);
    let erosion =
        EROSION * kept(ERODED_DENSE, params.density) * kept(ERODED_OVERCAST, overcast_weight);
    let shut = SHUT * OVERCAST * overcast_weight * contrast;
    let softer = match params.shading {
        Shading::Scattered => SOFTER * overcast_weight,
        Shading::Paper => 0.0,
    };
    PackedUniforms {
        photo_offset: offset(PHOTO_START + (place - PHOTO_WIND * way) * scale),
        photo_scale: (scale * near) as f32,
        photo_lod_bias: level(scale * near),
        noise_rotation: (DVec2::new(cos, sin) * (noise_scale * near)).as_vec2(),
        noise_offset: offset(NOISE_START + (turned_place - noise_way) * noise_scale),
        detail_offset: offset((place - PHOTO_WIND * way) * detail_scale),
        detail_scale: (detail_scale * near) as f32,
        detail_lod_bias: level(detail_scale * near) + softer,
        upper_scale: upper_scale.as_vec2(),
        upper_offset: offset(UPPER_START + DVec2::from(UPPER_SCALE) * upper_place),
        noise_lod_bias: level(noise_scale * near),
        upper_lod_bias: level((upper_scale.x * upper_scale.y).sqrt()),
        smoothness: params.density.max(overcast_weight),
        threshold,
        contrast,
        density: params.density,
        upper_layer: params.upper_layer,
        erosion,
        photo_step: photo_step.as_vec2(),
        // Light comes to the base of an overcast from all sides: bumps hardly show.
        detail_step: (step * (RELIEF_WAY * detail_scale)).as_vec2()
            * kept(ERODED_OVERCAST, overcast_weight),
        march_levels: map::levels(photo_step.length() * f64::from(view.texels)),
        extinction: EXTINCTION * (1.0 + params.density) * way_through(sun.y),
        opacity_rate: OPACITY_RATE * (1.0 + 2.0 * params.density),
        map_side: map_side as f32,
        map_lod_bias: view.level(scale * near * f64::from(map_side)),
        shut,
        cuts: (DEPTHS + shut + 0.5 * erosion).extend(erosion) + threshold * contrast,
    }
}

/// Radiance of an overcast sky far away, where single clouds cannot be told apart: the light of a place where photo, noise and detail have
/// their means, and all around it.
pub(crate) fn overcast(packed: &PackedUniforms, clouds: &CloudUniforms, means: [f32; 3]) -> Vec3 {
    lit(clouds, Place::of(packed, means).shares(packed, clouds))
}

/// A place of the layer where clouds have the same height all the way to the sun.
struct Place {
    /// Height before detail, and after it.
    height: f32,
    eaten: f32,
}

impl Place {
    /// Where photo, noise and detail are these: lines 14 to 17.
    fn of(packed: &PackedUniforms, [photo, noise, detail]: [f32; 3]) -> Place {
        let amount = photo + noise * (1.0 - photo);
        let height = (amount - packed.threshold) * packed.contrast;
        Place {
            height,
            eaten: (height - packed.erosion * (1.0 - detail)).max(0.0),
        }
    }

    /// Opacity, by the same lines as the shader's.
    fn opacity(&self, packed: &PackedUniforms) -> f32 {
        let halvings = packed.opacity_rate * self.eaten * self.eaten / (self.eaten + FOOT);
        softened((FULL * (1.0 - (-halvings).exp2())).min(1.0), EDGE)
    }

    /// Shares of sunlight and skylight that it sends to all sides.
    fn shares(&self, packed: &PackedUniforms, clouds: &CloudUniforms) -> [f32; 2] {
        let over = packed.shut + 0.5 * packed.erosion;
        let above = (self.height - DEPTHS - over).max(Vec3::ZERO);
        let thickness = (self.eaten - packed.shut).max(0.0);
        let passed = OWN * thickness + SHARES.dot(above);
        scattered(clouds, None, packed.extinction * passed, thickness)
    }
}

/// Opacity of the upper layer where the noise is this.
fn veil(packed: &PackedUniforms, noise: f32) -> f32 {
    packed.upper_layer * UPPER_OPACITY * smoothstep(UPPER_THRESHOLD, 1.0, noise)
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
        uniforms(&params, &view, Vec3::Y)
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

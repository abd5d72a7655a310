//! What the clouds of every method share: their light, the sunset tint, the haze, and what an overcast is.
//!
//! # Theory
//! Roden and Parberry (ACE 2005, section 3.1): the gradient tints the sun's side (lines 26-27), sunlight
//! lights it all (28). Clouds fade towards the horizon, as haze takes them.
//!
//! By default clouds of four methods scatter what comes through them: light once scattered by a phase function, and, less weakened, light that was
//! scattered many times. docs/clouds.md has the numbers.
//!
//! # Changes versus the paper
//! - The paper's grey is display-referred; its square is taken as reflected sunlight, itself as skylight.
//! - Cores are never black: [`CORE`] is what the paper's black becomes.
//! - A low sun lights clouds from the side: see `cloud_facing` in the shader. The papers' clouds are lit the same on every side of the sky.
//! - Cover above 0.8 makes an overcast: see [`overcast_weight`].
//!
//! # Practice
//! No read of its own by day; one bilinear with sunset above 0.

use glam::{DVec2, DVec3, Vec2, Vec3};

use crate::clear_sky::light::Light;
use crate::geometry::math::{luminance, smoothstep};
use crate::geometry::part::{Part, Value};
use crate::geometry::uniforms::uniforms;
use crate::params::{Shading, SkyParams};

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[
        ("CLOUD_CORE", Value::F32(CORE)),
        ("CLOUD_ABEAM", Value::F32(ABEAM)),
        ("CLOUD_SIDED", Value::F32(SIDED)),
        ("CLOUD_RIM", Value::F32(RIM)),
        ("CLOUD_MULTIPLE", Value::Vec2(MULTIPLE)),
        ("CLOUD_SINGLE", Value::Vec2(SINGLE)),
        ("CLOUD_FORWARD", Value::Vec3(forward())),
        ("CLOUD_BACKWARD", Value::Vec2(BACKWARD)),
        ("CLOUD_BRIGHTEST", Value::F32(BRIGHTEST)),
        ("CLOUD_THIN", Value::F32(THIN)),
        ("CLOUD_POWDER", Value::Vec2(POWDER)),
        ("CLOUD_HIDDEN", Value::F32(HIDDEN)),
    ],
    structs: &[CloudUniforms::WGSL],
    wgsl: include_str!("shared.wgsl"),
};

uniforms! {
    /// What the clouds of every method share.
    CloudUniforms {
        /// Unit vector to the sun's azimuth (east, south).
        sun_azimuth: Vec2,
        /// Where the sunset gradient begins, opposite the sun, as v of the texture.
        gradient_start: f32,
        /// How far it goes from there.
        gradient_span: f32,
        /// Light of the sun on clouds.
        sunlight: Vec3,
        /// 1 / sine of the elevation at which clouds are out of the haze.
        haze_scale: f32,
        /// Light of the sky on clouds.
        ambient: Vec3,
        /// How far the sunset tints clouds.
        sunset: f32,
        /// The sunset colour, display-referred.
        tint: Vec3,
        /// How far light comes from the side.
        low_sun: f32,
    }
}

/// What the darkest core of a cloud, the paper's black, still scatters: display-referred.
pub const CORE: f32 = 0.3;
/// Sine of the elevation at which clouds have come out of the haze of the horizon, and the same of an overcast sky.
const HAZE: [f32; 2] = [0.20, 0.08];

/// Share of a low sun's light that is seen on clouds to the left and right of it, what is more away from the sun and less towards it, and
/// what the thinnest clouds before it let through. Chosen by eye, beside photographs.
pub const ABEAM: f32 = 0.55;
pub const SIDED: f32 = 0.55;
pub const RIM: f32 = 2.5;
/// Light that is scattered many times: its share, and the share of the extinction that it feels. M. Wrenninge, C. Kulla, V. Lundqvist, "Oz:
/// The Great and Volumetric", SIGGRAPH 2013 Talks, have a sum of such terms; here it is one. Numbers here and below are chosen by eye.
pub const MULTIPLE: [f32; 2] = [0.5, 0.3];
/// Light that is scattered once: its share to all sides, and by the phase function.
pub const SINGLE: [f32; 2] = [0.28, 0.28];
/// The phase function: weight and asymmetry of a lobe of Henyey and Greenstein forwards.
pub const FORWARD: [f32; 2] = [0.5, 0.8];
/// Its other half, which goes backwards a little more: `a - b cos`.
pub const BACKWARD: [f32; 2] = [0.5, 0.22];
/// The most that it counts against all sides alike, about the sun.
pub const BRIGHTEST: f32 = 10.0;
/// Halvings of it by a height of 1: what is thick shows no light that was scattered once.
pub const THIN: f32 = 2.9;
/// "Beer-Powder": what edges that are seen away from the sun lack of the light, and 1 over the height at which nothing lacks. A. Schneider, N. Vos,
/// "The Real-time Volumetric Cloudscapes of Horizon: Zero Dawn", SIGGRAPH 2015.
pub const POWDER: [f32; 2] = [0.4, 5.0];
/// The least sine of the sun's elevation that counts: a lower sun comes in from the side.
const LEAST_SINE: f32 = 0.4;
/// Halvings of sunlight on its way to a middling cloud, and its height.
pub(crate) const MIDDLING: [f32; 2] = [1.2, 0.3];
/// Share of skylight that a cloud of height 1 keeps from its own underside.
pub const HIDDEN: f32 = 0.45;
/// Sines of the sun's elevation from which clouds are lit from above, and below which from the side.
const LOW_SUN: [f32; 2] = [0.5, 0.1];

/// Cover from which the sky is overcast.
const OVERCAST_FROM: f32 = 0.8;
/// Share of sunlight that an overcast sky keeps from its own underside.
const SHADE: f32 = 0.75;

/// What a dense overcast takes of all light: a storm is thick.
const DENSE: f32 = 0.8;
/// Share of skylight that it keeps.
const OVERCAST_AMBIENT: f32 = 0.7;

/// Wind at speed 1 in heights of the layer a second: 2.3 degrees a second overhead.
pub(crate) const MAX_WIND: f64 = 0.04;

/// Height of the lowest clouds over the ground, in metres: cumulus of a fair day. World Meteorological Organization,
/// "International Cloud Atlas", 2017, gives low clouds 0 to 2 km.
pub const LOW_HEIGHT_M: f64 = 1000.0;

/// The nearest that a layer comes, in its heights.
const LEAST_DISTANCE: f64 = 0.05;

/// Display-referred colour of the sunset gradient at its full strength.
const SUNSET_TINT: Vec3 = Vec3::new(1.0, 0.47, 0.24);

/// What a frame knows beside its parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CloudView {
    /// Texels a side of the cloud texture.
    pub texels: u32,
    /// A pixel in the middle of the screen, in radians.
    pub pixel_rad: f32,
    /// Time in seconds.
    pub seconds: f64,
    /// Where the viewer stands: metres to the east, up and to the south.
    pub place_m: DVec3,
}

impl CloudView {
    /// The viewer's place in heights of a layer that floats `height_m` above: what a near layer moves more by.
    pub(crate) fn place(&self, height_m: f64) -> DVec2 {
        DVec2::new(self.place_m.x, self.place_m.z) / height_m
    }

    /// How near a layer that floats `height_m` above the ground is, in its heights: 1 from the ground, less from above it.
    /// It never reaches 0: a viewer above the layer is kept just below it.
    pub(crate) fn distance(&self, height_m: f64) -> f64 {
        (1.0 - self.place_m.y / height_m).max(LEAST_DISTANCE)
    }

    /// Level of detail, at distance 1, of a texture with that many texels a height.
    pub(crate) fn level(&self, texels_a_height: f64) -> f32 {
        (f64::from(self.pixel_rad) * texels_a_height).log2() as f32
    }
}

/// The share of the uniforms that no method changes. `params` are in range.
pub fn uniforms(params: &SkyParams, light: &Light, texels: u32) -> CloudUniforms {
    let overcast_weight = overcast_weight(params.cover);
    let half_texel = 0.5 / texels as f32;
    CloudUniforms {
        sun_azimuth: azimuth(light.sun_direction),
        // Half a texel is kept from the ends: the texture repeats, and its ends are far apart.
        gradient_start: half_texel,
        gradient_span: 1.0 - 2.0 * half_texel,
        sunlight: light.sunlight * underside_light(params),
        haze_scale: 1.0 / (HAZE[0] + (HAZE[1] - HAZE[0]) * overcast_weight),
        ambient: ambient(light, overcast_weight) * let_through(params),
        // The gradient is about the sun.
        sunset: if light.is_moon { 0.0 } else { params.sunset },
        tint: SUNSET_TINT,
        low_sun: match params.shading {
            Shading::Scattered => {
                smoothstep(LOW_SUN[0], LOW_SUN[1], light.sun_direction.y) * (1.0 - overcast_weight)
            }
            Shading::Paper => 0.0,
        },
    }
}

/// Clouds on average: away from the haze of the horizon, and as they are lit to all sides.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MeanCloud {
    /// Opacity.
    pub opacity: f32,
    /// Radiance by the light of sun or moon.
    pub sunlit: Vec3,
    /// Radiance by all else.
    pub skylit: Vec3,
}

impl MeanCloud {
    /// By all light.
    pub(crate) fn radiance(&self) -> Vec3 {
        self.sunlit + self.skylit
    }

    /// Of shares of sunlight and of skylight.
    pub(crate) fn of_shares(
        clouds: &CloudUniforms,
        opacity: f32,
        [sunlit, skylit]: [f32; 2],
    ) -> MeanCloud {
        MeanCloud {
            opacity,
            sunlit: sunlit * clouds.sunlight,
            skylit: skylit * clouds.ambient,
        }
    }
}

/// Shares of sunlight and of skylight in [`radiance`].
pub(crate) fn shares_of_grey(grey: f32) -> [f32; 2] {
    let bright = CORE + (1.0 - CORE) * grey;
    [bright * bright, bright]
}

/// Radiance of a cloud of this grey, by the same line as the shader's.
pub(crate) fn radiance(clouds: &CloudUniforms, grey: f32) -> Vec3 {
    let bright = CORE + (1.0 - CORE) * grey;
    bright * (bright * clouds.sunlight + clouds.ambient)
}

/// The way of light through a layer, against its thickness, by the sine of the sun's elevation: the lower the sun, the longer.
pub(crate) fn way_through(sun_sine: f32) -> f32 {
    1.0 / sun_sine.max(LEAST_SINE)
}

/// `w (1 - g^2) / (y - z cos)^(3/2)` is the forward lobe against all sides alike: its numerator, y and z.
const fn forward() -> Vec3 {
    let [weight, g] = FORWARD;
    Vec3::new(weight * (1.0 - g * g), 1.0 + g * g, 2.0 * g)
}

/// `cloud_scattered` of the shader, by the cosine of a direction to the sun; without one, the mean of all directions.
pub(crate) fn scattered(
    clouds: &CloudUniforms,
    cosine: Option<f32>,
    depth: f32,
    height: f32,
) -> [f32; 2] {
    let phase = cosine.map_or(1.0, |cosine| {
        let Vec3 { x, y, z } = forward();
        let root = 1.0 / (y - z * cosine).sqrt();
        (x * root.powi(3) + BACKWARD[0] - BACKWARD[1] * cosine).min(BRIGHTEST)
    });
    let cosine = cosine.unwrap_or(0.0);
    let lacking = POWDER[0] * (0.5 - 0.5 * cosine) * (1.0 - POWDER[1] * height).max(0.0);
    let sided = 1.0 + (ABEAM - SIDED * cosine - 1.0) * clouds.low_sun;
    let through = (-depth).exp2();
    let rim = SINGLE[1] * phase * (-THIN * height).exp2() * through;
    let body = (SINGLE[0] * through + MULTIPLE[0] * (-MULTIPLE[1] * depth).exp2()) * sided;
    [
        (body + rim) * (1.0 - lacking),
        1.0 - HIDDEN * height.min(1.0),
    ]
}

/// Share of the sunlight that middling clouds send to all sides that they send along a direction, by its cosine to the sun.
pub(crate) fn scattered_facing(clouds: &CloudUniforms, cosine: f32) -> f32 {
    let [depth, height] = MIDDLING;
    let towards = |cosine| scattered(clouds, cosine, depth, height)[0];
    towards(Some(cosine)) / towards(None)
}

/// `cloud_lit` of the shader without sunset.
pub(crate) fn lit(clouds: &CloudUniforms, [sunlit, skylit]: [f32; 2]) -> Vec3 {
    clouds.sunlight * sunlit + clouds.ambient * skylit
}

/// How overcast the sky is at a cover, 0..1: an overcast has no holes.
pub fn overcast_weight(cover: f32) -> f32 {
    smoothstep(OVERCAST_FROM, 1.0, cover)
}

/// What the density of an overcast lets through, 0..1.
pub(crate) fn let_through(params: &SkyParams) -> f32 {
    1.0 - DENSE * overcast_weight(params.cover) * params.density
}

/// Share of sunlight that clouds show from below.
pub(crate) fn underside_light(params: &SkyParams) -> f32 {
    (1.0 - SHADE * overcast_weight(params.cover)) * let_through(params)
}

/// `cloud_soften` of the shader.
pub(crate) fn softened(alpha: f32, edge: f32) -> f32 {
    alpha * alpha * (1.0 + edge) / (alpha + edge)
}

/// Its inverse: the positive root of `(1 + e) a^2 - s a - s e`.
pub(crate) fn inverse_soften(softened: f32, edge: f32) -> f32 {
    let wide = 2.0 * (1.0 + edge);
    (softened + (softened * softened + 2.0 * wide * softened * edge).sqrt()) / wide
}

/// Inverse of `smoothstep(0, 1, t)`: the root of the cubic, by angles.
pub(crate) fn inverse_smoothstep(value: f32) -> f32 {
    0.5 - ((1.0 - 2.0 * value).asin() / 3.0).sin()
}

/// The opacity that gives `opacity` together with what leaves `clear` of the light; below 0 none is needed.
pub(crate) fn behind(opacity: f32, clear: f32) -> f32 {
    1.0 - (1.0 - opacity) / clear
}

/// Inverse of `c + k c (1 - c)` in 0..1: the finer reads' roughening. One root, since 0 and 1 stay where they are.
pub(crate) fn inverse_roughen(rough: f32, k: f32) -> f32 {
    let b = 1.0 + k;
    2.0 * rough / (b + (b * b - 4.0 * k * rough).max(0.0).sqrt()).max(1e-9)
}

/// A texture coordinate in 0..1: reduced in 64 bits, since seconds have no end.
pub(crate) fn offset(place: DVec2) -> Vec2 {
    (place - place.floor()).as_vec2()
}

/// Unit vector (east, south) to the sun's azimuth; any one where the sun is at the zenith.
pub fn azimuth(sun: Vec3) -> Vec2 {
    Vec2::new(sun.x, sun.z).normalize_or(Vec2::Y)
}

/// Skylight on clouds: less blue than the sky, as the ground and other clouds add to it. An overcast hides the sky: what comes through
/// it is of the colour of all the light above, and less.
fn ambient(light: &Light, overcast_weight: f32) -> Vec3 {
    let level = luminance(light.skylight);
    let clear = Vec3::splat(level).lerp(light.skylight, 0.6);
    let all = light.ground_sunlight * light.sun_direction.y.max(0.0) + light.sky_on_ground;
    let shut = all * (OVERCAST_AMBIENT * level / luminance(all).max(1e-9));
    clear.lerp(shut, overcast_weight)
}

/// The opacity above which a direction counts as covered.
pub const OPAQUE: f32 = 0.1;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sky_closes_above_cover_0_8_and_loses_light() {
        let light = Light {
            sun_direction: Vec3::Y,
            sunlight: Vec3::ONE,
            ..Light::default()
        };
        let sunlight = |cover: f32| {
            let params = SkyParams {
                cover,
                ..SkyParams::default()
            };
            uniforms(&params, &light, 512).sunlight.x
        };
        assert_eq!((overcast_weight(0.8), overcast_weight(1.0)), (0.0, 1.0));
        assert_eq!((sunlight(0.3), sunlight(0.8)), (1.0, 1.0));
        // At the default density.
        let thick = 1.0 - DENSE * SkyParams::default().density;
        assert_eq!(sunlight(1.0), (1.0 - SHADE) * thick);
    }

    #[test]
    fn every_inverse_is_one() {
        for i in 1..100 {
            let x = i as f32 / 100.0;
            assert!(
                (inverse_smoothstep(smoothstep(0.0, 1.0, x)) - x).abs() < 1e-3,
                "{x}"
            );
            // Of the packed method and of the octaves.
            for edge in [0.12, 0.6] {
                assert!((inverse_soften(softened(x, edge), edge) - x).abs() < 1e-4);
            }
            for k in [-3.0, -1.0, -0.4, 0.0, 0.4, 1.0, 3.0] {
                let c = inverse_roughen(x, k);
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

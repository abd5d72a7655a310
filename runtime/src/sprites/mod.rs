//! Clouds in space, made of sprites, that one can fly through.
//!
//! # Theory
//! N. Wang, "Let There Be Clouds! Fast, Realistic Cloud-Rendering in Microsoft Flight Simulator 2004: A Century of Flight", Game
//! Developer, 2004. A cloud is 5 to 400 textured squares that face the camera, blended back to front. A vertex has the sum of an
//! ambient colour, from five levels over the cloud's height and the time of day, and a directional one: the sun's most colour
//! times a share between a least and a most one, by the cosine between the way from the middle of the vertex's shading group and the
//! sun. Texture colour is added. The parts are files: [`hours`] (light over the day), [`formation`], [`instances`] (what the
//! device reads), [`exposures`] (light in the field), [`grid`] (blocks), [`order`] (sorting), [`locks`] (in the cloud), [`ring`] (impostors).
//!
//! # Changes versus the paper
//! - The sheet's grey is relief about one half: it is added in proportion to the light, or clouds would glow at night.
//! - Air: clouds go over into the clear sky behind them with distance, and out at the end of sight.
//! - Light is the sky's by default, that of sun or moon; the article's table of hours stands behind a switch.
//! - Density makes clouds more opaque and bases darker, height lifts the whole field, sunset tints the sun's colour as
//!   in every method.
//!
//! # Practice
//! A draw for each block of 16 square kilometres in sight, 64 bytes a sprite, eight vertices for near sprites and four for far ones.
//! Sprites are drawn over the sky of another method, its dome ([`crate::params::SpriteParams::behind`]), in the target's own encoding: a float target
//! blends radiance, another one display light. They stand at their depth: a scene drawn before hides them, and
//! what is drawn later should test depth against the scene alone, since sprites write none. It wants a target that can be blended with.

mod cast;
mod device;
pub mod exposures;
pub mod formation;
pub(crate) mod frame;
pub mod grid;
pub mod hours;
pub mod instances;
pub(crate) mod layer;
pub mod locks;
pub mod order;
pub mod outline;
pub(crate) mod pass;
pub mod pipelines;
pub mod ring;
pub mod scene;
pub mod station;
pub mod wind;

use glam::{DVec3, Vec3};
use welkin_pack::Field;
use welkin_pack::field::Hour;

use self::wind::lift_m;
use crate::clear_sky::light::Light;
use crate::clouds::shared::{self, CloudUniforms, CloudView, LOW_HEIGHT_M};
use crate::geometry::math::smoothstep;
use crate::geometry::uniforms::uniforms;
use crate::params::{Shading, SkyParams};

uniforms! {
    /// Clouds of sprites.
    SpriteUniforms {
        /// Unit direction towards sun or moon.
        light_direction: Vec3,
        /// Contrast of the sheet's relief.
        relief: f32,
        /// The most light of sun or moon.
        light: Vec3,
        /// Fraction of it where a group faces away.
        least: f32,
        /// Factor on the colour levels.
        ambient: Vec3,
        /// Fraction of the light where a group faces sun or moon.
        most: f32,
        /// Extinction of the air at sea level, 1 / m.
        extinction_per_m: f32,
        /// 1 / scale height of the air, 1 / m.
        air_height_per_m: f32,
        /// Opacity of a sprite.
        opacity: f32,
        /// How much darker bases are.
        dark_base: f32,
        /// 1 / width of the rim of sight, 1 / m.
        rim_per_m: f32,
        /// How far clouds are seen, m.
        distance_m: f32,
        /// 1 / width of the change to billboards, 1 / m.
        change_per_m: f32,
        /// Where billboards begin, m.
        billboards_m: f32,
        /// Light of a flash of lightning where it strikes.
        flash: Vec3,
        /// Factor on depths; 0 where the shading is the article's.
        thickness: f32,
        /// From the viewer to the flash, m.
        flash_position: Vec3,
        /// 1 / reach of the flash, 1 / m.
        flash_per_m: f32,
    }
}

/// Extinction of clear air at sea level, 1 / m, and the height over which it falls to 1 / e, in metres. Visibility by
/// Koschmieder's rule is 3.912 over it: 71 km, a clear day. H. Koschmieder, "Theorie der horizontalen Sichtweite", 1924. Haze has a
/// scale height of 1 to 2 km.
const EXTINCTION: f32 = 5.5e-5;
const AIR_HEIGHT_M: f32 = 1500.0;
/// Share of sight over which clouds go out.
const RIM: f32 = 0.7;
/// Clouds are opaque up to the last 1 / this of the rim: many of them lie over each other, so opacity alone would end in an edge.
pub const RIM_OPAQUE: f32 = 4.0;
/// Share of the way to the billboards over which sprites change to them.
const CHANGE: f32 = 0.15;
/// Opacity of sprites at density 0 and 1, and how much darker than its colour level a base is then.
const OPACITY: [f32; 2] = [0.85, 1.0];
const DARK_BASE: [f32; 2] = [0.0, 0.5];
/// Factor on depths at density 0 and 1.
const THICKNESS: [f32; 2] = [0.35, 1.5];
/// Share of the phase function in what a sprite shows as a whole; rims show all of it.
pub const PHASE: f32 = 0.08;
/// Pixels of the screen that a texel of the sheet covers: clouds have no edges as sharp as a screen's.
pub const SOFT: f32 = 1.8;
/// How far the near side of a sprite's body is before its middle, in half sides.
pub const BULGE: f32 = 0.7;
/// How much of the relief that is lit from the front shows in light from the side.
pub const FRONT: f32 = 0.4;
/// How much of the relief of the sides shows.
pub const SIDES: f32 = 0.7;
/// Share of skylight that gets to the deepest place.
pub const LEAST_SKY: f32 = 0.25;
/// How strong the relief of the sheet shows at density 0 and 1.
const RELIEF: [f32; 2] = [1.15, 0.8];
/// Sine of the sun's elevation at which moon and sun change places, and over which both are dim.
const MOON: [f32; 2] = [-0.10, 0.04];
/// Height over the lowest clouds at which a flash strikes, in metres, and how far its light reaches.
const FLASH_ABOVE_M: f64 = 700.0;
const FLASH_REACH_M: f32 = 1800.0;

/// The method's share of the uniforms. `params` are in range; `clouds` is the light on the clouds of every method, `hours` the pack's table
/// of light, `flash` the light of a flash of lightning.
pub fn uniforms(
    params: &SkyParams,
    view: &CloudView,
    light: &Light,
    clouds: &CloudUniforms,
    hours: &[Hour],
    flash: Vec3,
) -> SpriteUniforms {
    let own = &params.sprites;
    // The table of hours is the article's, and made for its shading.
    let is_scattered = params.shading == Shading::Scattered && !own.hours;
    let lit = if own.hours {
        let factor = moonlit(light) * shared::underside_light(params);
        hours::of_hour(&hours::between(hours, &light.hours), factor)
    } else if is_scattered {
        hours::of_scattered(clouds)
    } else {
        hours::of_sky(clouds)
    };
    let mix = |[from, to]: [f32; 2]| from + (to - from) * params.density;
    let billboards = own.billboards_beyond_m;
    let [x, y, z] = [
        f64::from(params.weather.lightning.place_m[0]),
        LOW_HEIGHT_M + FLASH_ABOVE_M + lift_m(params),
        f64::from(params.weather.lightning.place_m[1]),
    ];
    let flash_place = DVec3::new(x, y, z) - view.place_m;
    SpriteUniforms {
        light_direction: light.sun_direction,
        relief: mix(RELIEF),
        light: lit.direct,
        least: lit.least,
        ambient: lit.ambient,
        most: lit.most,
        extinction_per_m: EXTINCTION,
        air_height_per_m: 1.0 / AIR_HEIGHT_M,
        opacity: mix(OPACITY),
        dark_base: mix(DARK_BASE),
        rim_per_m: 1.0 / (RIM * own.distance_m),
        distance_m: own.distance_m,
        change_per_m: 1.0 / (CHANGE * billboards),
        billboards_m: billboards,
        flash,
        flash_position: flash_place.as_vec3(),
        flash_per_m: 1.0 / FLASH_REACH_M,
        thickness: if is_scattered { mix(THICKNESS) } else { 0.0 },
    }
}

/// Share of an hour's direct light as moon and sun change places.
fn moonlit(light: &Light) -> f32 {
    let strength = if light.is_moon { light.moonlight } else { 1.0 };
    strength * smoothstep(0.0, MOON[1], (light.sun.y - MOON[0]).abs())
}

/// The lowest base and the highest top of a field's clouds, in metres; 0 if it has none.
pub fn heights_m(field: &Field) -> [f32; 2] {
    let ends = field.clouds.iter().map(|cloud| {
        let (middle, half) = (cloud.centre_m[1], 0.5 * cloud.size_m[1]);
        [middle - half, middle + half]
    });
    let both = ends.reduce(|[a, b], [c, d]| [a.min(c), b.max(d)]);
    both.unwrap_or_default()
}

/// How overcast the sky behind is: from below by cover, as in every method; from above the clouds it is open.
pub fn overcast_weight(params: &SkyParams, viewer_m: f32, [base_m, top_m]: [f32; 2]) -> f32 {
    let height_m = viewer_m - lift_m(params) as f32;
    let above = smoothstep(base_m, top_m.max(base_m + 1.0), height_m);
    shared::overcast_weight(params.cover) * (1.0 - above)
}

/// Mean radiance of a sky that the field's clouds cover.
pub fn overcast(sprites: &SpriteUniforms) -> Vec3 {
    let sunlit = if sprites.thickness > 0.0 {
        // The higher the sun, the shorter the way of its light down to the bases.
        let sine = sprites.light_direction.y;
        THROUGH[0] + THROUGH[1] * sine * sine
    } else {
        UNDERSIDE * 0.5 * (sprites.least + sprites.most)
    };
    OVERCAST_LEVEL * sprites.ambient * (1.0 - 0.5 * sprites.dark_base) + sunlit * sprites.light
}

/// Share of sunlight that comes through a sheet from the horizon, and what a sun overhead adds to it: about what the field of the default pack shows.
const THROUGH: [f32; 2] = [0.15, 0.2];
/// Colour level of the base of a sheet of clouds.
const OVERCAST_LEVEL: f32 = 0.5;
/// Share of directional light on undersides, as they are seen from the ground.
const UNDERSIDE: f32 = 0.35;

#[cfg(test)]
mod tests {
    use super::wind::in_field;
    use super::*;

    #[test]
    fn the_wind_blows_the_field_and_height_lifts_it() {
        let params = SkyParams {
            speed: 1.0,
            height: 0.7,
            ..SkyParams::default()
        };
        let place = in_field(&params, DVec3::new(100.0, 50.0, -20.0), 10.0);
        assert!((place - DVec3::new(100.0 - 320.0, 50.0, -20.0 - 240.0)).length() < 1e-3);
        let high = SkyParams {
            height: 1.0,
            ..params
        };
        assert!((lift_m(&high) - 300.0).abs() < 1e-3);
    }

    #[test]
    fn an_overcast_shuts_the_sky_from_below_and_not_from_above() {
        let shut = SkyParams {
            cover: 1.0,
            ..SkyParams::default()
        };
        let at = |height: f32| overcast_weight(&shut, height, [1000.0, 1800.0]);
        assert_eq!(
            [at(2.0), at(1000.0), at(1800.0), at(9000.0)],
            [1.0, 1.0, 0.0, 0.0]
        );
        assert!((at(1400.0) - 0.5).abs() < 1e-6);
        let fair = SkyParams { cover: 0.5, ..shut };
        assert_eq!(overcast_weight(&fair, 2.0, [1000.0, 1800.0]), 0.0);
    }

    #[test]
    fn sun_and_moon_change_places_in_the_dark() {
        let hours = [Hour {
            time: 0.5,
            ambient: 0.5,
            colour: [1.0; 3],
            least: 0.1,
            most: 1.0,
        }];
        let at = |sine: f32| {
            let sun = Vec3::new((1.0 - sine * sine).sqrt(), sine, 0.0);
            let is_moon = sine <= MOON[0];
            let light = Light {
                sun_direction: if is_moon { -sun } else { sun },
                sun,
                moonlight: 1.0,
                is_moon,
                ..Light::default()
            };
            let view = CloudView {
                texels: 512,
                pixel_rad: 1e-3,
                seconds: 0.0,
                place_m: DVec3::ZERO,
            };
            let mut params = SkyParams::default();
            params.sprites.hours = true;
            let clouds = CloudUniforms::default();
            uniforms(&params, &view, &light, &clouds, &hours, Vec3::ZERO)
        };
        assert_eq!(at(0.5).light.x, 1.0);
        assert!(at(-0.0999).light.x < 1e-3 && at(-0.1001).light.x < 1e-3);
        assert!(at(-0.0999).light_direction.x > 0.9 && at(-0.1001).light_direction.x < -0.9);
        assert_eq!(at(-0.4).light.x, 1.0);
    }
}

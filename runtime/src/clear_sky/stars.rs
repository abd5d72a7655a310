//! Stars: each flickers by its own four numbers, and stays a point.
//!
//! # Theory
//! A star shines `I(t) = mean + variance sin(2 pi (rate t + phase))` (Roden and Parberry, section 4).
//! The texture is tiled on the plane of Lambert's equal-area dome, so that no place has more stars than
//! another (welkin_pack::mapping).
//!
//! # Changes versus the paper
//! The paper samples the texture like a picture, which blends rates and phases of neighbours. Here one
//! texel is read whole and decoded; the star is a point at the texel's centre, projected to the screen,
//! and drawn as a tent one pixel wide each way. The tents of the pixels around it add up to one
//! wherever it is, so that a star which moves over the screen neither shimmers nor changes its light.
//!
//! A tent fits into its texel where the texel is at least 2 sqrt(2) pixels wide: then one texel is all that a pixel
//! reads. Near the horizon the projection narrows texels by sqrt(1/2), and the tents of some stars lose their
//! outermost corners there. On a coarser screen a pixel looks at every texel that its tent may reach, of the level
//! above: that tells where there are stars at all, and those are read from the level below it. The records are those
//! of level 0 down to 185 lines at a field of view of 60 degrees; beyond that, of stars whose light was added up.
//!
//! Away from the lens' axis, at an angle t to it, a pixel covers cos^3 t of the solid angle that one in the middle does. On a screen
//! that is nobody's concern; a map of radiance divides by it ([`crate::SkyParams::even_stars`]).
//!
//! With a date the texture's dome does not stand over the viewer but over the north pole of J2000, its north at right ascension 0, and turns with
//! the stars ([`crate::almanac::stars`]), lifted by the air. It is one hemisphere: the other is the same turned half about the line along which the galaxy crosses the
//! equator, so that the band goes on where it is. Where the two meet, a star whose tent reaches across loses what is beyond, and
//! the galaxies of both are mixed.
//!
//! # Practice
//! One texture read a pixel at night, the rest only where there is a star (about one pixel in 40). Where a texel is too
//! narrow, about a dozen.

use glam::{DMat3, Vec2, Vec3};
use welkin_pack::StarTexel;
use welkin_pack::mapping::{STAR_TILE_SIDE, STAR_TILE_START};

use crate::almanac::refraction::{LEAST_SINE, LIFT};
use crate::almanac::{Date, Place, stars};
use crate::geometry::part::{Part, Value};
use crate::geometry::uniforms::uniforms;

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[
        ("STAR_TILE_SIDE", Value::F32(STAR_TILE_SIDE)),
        ("STAR_RATE_STEPS", Value::F32(255.0)),
        ("STAR_GALAXY_BOOST", Value::F32(GALAXY_BOOST)),
        ("STAR_START", Value::Vec2(STAR_TILE_START)),
        ("STAR_WARM", Value::Vec3(WARM)),
        ("STAR_COLD", Value::Vec3(COLD)),
        ("STAR_LIFT", Value::Vec3(Vec3::from_array(LIFT))),
        ("STAR_LEAST_SINE", Value::F32(LEAST_SINE)),
    ],
    structs: &[StarUniforms::WGSL],
    wgsl: include_str!("stars.wgsl"),
};

uniforms! {
    /// Stars.
    StarUniforms {
        /// Level of the records.
        level: f32,
        /// Texels a side of that level.
        resolution: f32,
        /// Fraction of the flicker's period that has passed.
        period: f32,
        /// Radiance of a star of intensity 1.
        brightness: f32,
        /// 1 if light is spread over the pixel's own solid angle, 0 if over that of one in the middle.
        evenness: f32,
        /// 1 if the level above that of the records tells where they are, 0 if a pixel reads one texel alone.
        is_guided: f32,
        /// How far a tent reaches, in radians.
        reach_rad: f32,
        /// 1 if the dome of the texture stands as a date has it, 0 if over the viewer.
        is_placed: f32,
        /// The world's direction of its east.
        east: Vec3,
        /// East and, further below, south of the line about which its other half is turned.
        node_east: f32,
        /// The world's direction of its zenith.
        zenith: Vec3,
        /// See `node_east`.
        node_south: f32,
        /// The world's direction of its south.
        south: Vec3,
        /// Nothing.
        _pad: f32,
    }
}

/// How the dome of the texture stands over the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stand {
    /// Its east, zenith and south, in the world; airless.
    pub axes: [Vec3; 3],
    /// The line about which its other half is turned: east and south, a unit vector.
    pub node: Vec2,
}

impl Stand {
    /// At a date and place. `node` is that of the galaxy, on its own dome.
    pub fn of_date(date: Date, place: Place, node: Vec2) -> Stand {
        Stand::of_turn(stars::turn(date, place), node)
    }

    /// The same of a turn from the equator of J2000 to the world.
    pub fn of_turn(turn: DMat3, node: Vec2) -> Stand {
        // Its zenith is the pole, its north right ascension 0.
        let axes = [-turn.y_axis, turn.z_axis, -turn.x_axis];
        Stand {
            axes: axes.map(|axis| axis.as_vec3()),
            node,
        }
    }
}

/// How much brighter a star is in the brightest part of the galaxy, less one: "stars inside the galaxies
/// receive an additional intensity increase" (section 4).
pub const GALAXY_BOOST: f32 = 3.0;

/// Colours of the stars, from phase 0 to phase 1, of about equal luminance: 4000 K and 12000 K.
pub const WARM: Vec3 = Vec3::new(1.15, 0.97, 0.76);
/// See [`WARM`].
pub const COLD: Vec3 = Vec3::new(0.84, 1.0, 1.30);

/// Radiance of a star of intensity 1 that fills its pixel.
const BRIGHTNESS: f32 = 1.6;

/// The narrowest texel into which the tent of a star fits at any turn, in pixels: its diagonal.
const MIN_TEXEL_PX: f32 = 2.0 * std::f32::consts::SQRT_2;

/// The narrowest texel of the level that tells where there are stars, in pixels: a tent then reaches four of them each
/// way at most, five next to the horizon.
const MIN_GUIDE_PX: f32 = 1.25;

/// Which level is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Levels {
    /// That of the records.
    records: u32,
    /// Whether the level above it tells where they are; otherwise a pixel reads the one texel that it lies in.
    guided: bool,
}

/// The stars' share of the uniforms. `texels` is the side of level 0, `units` are those of
/// [`StarTexel::level_units`], `pixel_rad` width and height of a pixel in the middle of the screen, `even` is
/// [`crate::SkyParams::even_stars`]; without a `stand` the dome of the texture stands over the viewer.
pub fn uniforms(
    texels: u32,
    units: &[f32],
    pixel_rad: [f32; 2],
    night: f32,
    even: bool,
    seconds: f64,
    stand: Option<Stand>,
) -> StarUniforms {
    let Levels { records, guided } = levels(texels, units.len(), pixel_rad);
    let unit = units.get(records as usize).copied().unwrap_or(1.0);
    let number = |is: bool| f32::from(u8::from(is));
    let over_viewer = Stand {
        axes: [Vec3::X, Vec3::Y, Vec3::Z],
        node: Vec2::X,
    };
    let Stand { axes, node } = stand.unwrap_or(over_viewer);
    StarUniforms {
        is_placed: number(stand.is_some()),
        east: axes[0],
        zenith: axes[1],
        south: axes[2],
        node_east: node.x,
        node_south: node.y,
        level: records as f32,
        resolution: (texels >> records).max(1) as f32,
        period: period(seconds),
        brightness: unit * radiance_of_one(texels, pixel_rad, night),
        evenness: number(even),
        is_guided: number(guided),
        reach_rad: pixel_rad[0].hypot(pixel_rad[1]),
        ..Default::default()
    }
}

/// Radiance of a star of intensity 1 whose light falls on one pixel.
pub fn radiance_of_one(texels: u32, pixel_rad: [f32; 2], night: f32) -> f32 {
    let side_rad = STAR_TILE_SIDE / texels as f32;
    BRIGHTNESS * night * side_rad * side_rad / (pixel_rad[0] * pixel_rad[1])
}

fn levels(texels: u32, levels: usize, pixel_rad: [f32; 2]) -> Levels {
    let texel_px = |level: u32| {
        let side = (texels >> level).max(1) as f32;
        STAR_TILE_SIDE / side / pixel_rad[0].max(pixel_rad[1])
    };
    let last = levels.saturating_sub(1) as u32;
    if last == 0 || texel_px(0) >= MIN_TEXEL_PX {
        return Levels {
            records: 0,
            guided: false,
        };
    }
    let fits = |guide: u32| texel_px(guide) >= MIN_GUIDE_PX;
    let guide = (1..last).find(|&guide| fits(guide)).unwrap_or(last);
    Levels {
        records: guide - 1,
        guided: true,
    }
}

/// Place in the flicker's period, 0..1: reduced in 64 bits, so that any time can be drawn.
fn period(seconds: f64) -> f32 {
    let turns = seconds / StarTexel::PERIOD_S;
    // A value that rounds up to 1 is the start of the next period.
    ((turns - turns.floor()) as f32).min(1.0 - f32::EPSILON)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn records_are_read_from_level_0_down_to_small_pictures() {
        let pixel = |texel_px: f32| [1.0 / (256.0 * texel_px); 2];
        let at = |texel_px: f32| {
            let Levels { records, guided } = levels(256, 9, pixel(texel_px));
            (records, guided)
        };
        assert_eq!(at(4.0), (0, false));
        assert_eq!(at(2.84), (0, false));
        assert_eq!(at(2.82), (0, true));
        assert_eq!(at(0.63), (0, true));
        assert_eq!(at(0.62), (1, true));
        assert_eq!(at(1e-6), (7, true), "never beyond the last");
        for levels_of_one in [0, 1] {
            assert!(!levels(256, levels_of_one, pixel(1e-6)).guided);
        }
    }

    #[test]
    fn the_dome_stands_where_the_pole_is_and_is_not_mirrored() {
        for (latitude_deg, date) in [(51.5, "2026-01-01"), (-33.9, "1969-07-20T20:17:40Z")] {
            let place = Place {
                latitude_deg,
                longitude_deg: 12.0,
            };
            let [east, zenith, south] = Stand::of_date(date.parse().unwrap(), place, Vec2::X).axes;
            // The pole of J2000 has gone by 0.15 degrees at most since.
            let pole = Vec3::new(
                0.0,
                latitude_deg.to_radians().sin(),
                -latitude_deg.to_radians().cos(),
            );
            assert!(zenith.angle_between(pole).to_degrees() < 0.2);
            assert!(east.cross(zenith).distance(south) < 1e-6);
        }
    }

    #[test]
    fn the_same_sky_returns_after_each_period() {
        assert_eq!(period(0.0), period(640.0));
        assert_eq!(period(1e6), period(1e6 + 64.0 * 1e6));
        assert!((0.0..1.0).contains(&period(-1e-12)));
    }

    #[test]
    fn light_does_not_depend_on_the_level() {
        // A step of level 1 stands for three of level 0.
        let units = [1.0, 3.0, 3.0];
        let at = |pixel_rad: f32| uniforms(256, &units, [pixel_rad; 2], 1.0, false, 0.0, None);
        let (fine, coarse) = (at(1e-3), at(8e-3));
        assert_eq!((fine.level, coarse.level), (0.0, 1.0));
        let per_step =
            |stars: StarUniforms, pixel_rad: f32| stars.brightness * pixel_rad * pixel_rad;
        let ratio = per_step(coarse, 8e-3) / per_step(fine, 1e-3);
        assert!((ratio - 3.0).abs() < 1e-5);
    }
}

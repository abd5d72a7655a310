//! The octaves method: three domes of clouds over one map of summed octaves.
//!
//! # Theory
//! S. Guthikonda, A. Meena, D. Linder, S. Yi, "Realistic Real-Time Skies", University of Southern California,
//! CS 580 final project. White noise, up-sampled and filtered, is summed over octaves into one texture
//! ([`crate::clouds::octaves::map`]). `max(c - (1 - cover), 0)` opens the sky; `1 - (1 - sharpness)^(255 c)` gives clouds their
//! edge; alpha follows density, so that several domes at different heights show through each other and move
//! against each other (section "Unexpected and Unique Results").
//!
//! # Changes versus the paper
//! - Cover comes before the exponentiation, as in the page of H. Elias that the paper cites ("Cloud Cover"): the other
//!   way round, sharpness 1 would make everything cloud instead of edges abrupt.
//! - The map holds shares of its own distribution, so that the share of cloud on the sky is the cover.
//! - The paper's clouds are flat white. Here thickness and the difference to the amount one step towards the sun say how much light comes
//!   through, and [`crate::clouds::shared`] what of it is scattered to the eye. With [`crate::params::Shading::Paper`] they darken a grey.
//! - Density thickens: it multiplies the exponent. The foot of the opacity is softened, as in the packed method.
//! - The photograph's large shapes take a part of the sum's variance ([`crate::clouds::photo`]). Streaks of the high dome are bent by a shear, and read coarser.
//! - The veil of the high dome rises as a smoothstep that is half full where the exponentiation is: the same to the eye,
//!   without an exponential a pixel.
//! - A second, finer read of the same map roughens the low clouds: the map has one texel a degree.
//! - At cover above 0.8 the cut goes on below 0, as in the packed method: an overcast has no holes.
//!
//! # Practice
//! Two reads for the low dome, one each for the others, since opacity, relief and grey are in the map; a dome without cover costs nothing. Parallax needs the
//! camera's place in metres ([`crate::Camera::position_m`]).

pub mod coverage;
pub mod map;

use glam::{DMat2, DVec2, Vec2, Vec3, Vec4};

use crate::clouds::shared::{
    CloudUniforms, CloudView, LOW_HEIGHT_M, MAX_WIND, offset, overcast_weight, radiance,
    way_through,
};
use crate::geometry::part::{Part, Value};
use crate::geometry::uniforms::uniforms;
use crate::params::SkyParams;

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[
        ("OCTAVE_FINER", Value::F32(FINER)),
        ("OCTAVE_ROUGH_GREY", Value::F32(ROUGH_GREY)),
        ("OCTAVE_ROUGH_DEPTH", Value::F32(ROUGH_DEPTH)),
        ("OCTAVE_THIN_DEPTH", Value::F32(THIN_DEPTH)),
        ("OCTAVE_LEAST_LIGHT", Value::F32(LEAST_LIGHT)),
        ("OCTAVE_HEIGHTS", Value::Vec2(BODY_HEIGHTS)),
        ("OCTAVE_FINER_LEVEL", Value::Log2(FINER)),
        ("OCTAVE_EDGE", Value::F32(EDGE)),
        ("OCTAVE_THIN", Value::F32(THIN)),
        ("OCTAVE_MIDDLE_OPACITY", Value::F32(MIDDLE_OPACITY)),
        ("OCTAVE_VEIL_LEVEL", Value::F32(VEIL_LEVEL)),
        ("OCTAVE_BEND", Value::F32(BEND)),
        ("OCTAVE_HIGH_OPACITY", Value::F32(HIGH_OPACITY)),
        ("OCTAVE_FINER_START", Value::Vec2(FINER_START)),
    ],
    structs: &[OctaveDome::WGSL, OctaveUniforms::WGSL],
    wgsl: include_str!("octaves.wgsl"),
};

uniforms! {
    /// A dome of the octaves method.
    OctaveDome {
        /// What a height to the east adds to uv.
        east_axis: Vec2,
        /// What a height to the south adds to uv.
        south_axis: Vec2,
        /// Where the map lies.
        offset: Vec2,
        /// Level of detail at distance 1.
        lod_bias: f32,
        /// The amount from which there is cloud, 1 - cover.
        threshold: f32,
    }

    /// Clouds of the octaves method.
    OctaveUniforms {
        /// Low clouds.
        low: OctaveDome,
        /// Middle clouds.
        middle: OctaveDome,
        /// High clouds.
        high: OctaveDome,
        /// log2 of (1 - sharpness)^255.
        exponent: f32,
        /// How thickness darkens.
        darkening: f32,
        /// Strength of the relief.
        relief: f32,
        /// How much the finer read roughens the edges of the low clouds.
        roughness: f32,
        /// A step of the low dome towards the sun, in uv.
        sun_step: Vec2,
        /// Halvings of sunlight by a thickness of 1.
        extinction: f32,
        /// Halvings that the low dome takes where it is thinnest.
        base_depth: f32,
        /// Copies of the noise across the map, four octaves a vector.
        copies: [Vec4; 2],
        /// How many octaves are summed.
        count: f32,
        /// Texels a side of the map.
        resolution: f32,
        /// Display-referred grey of a thin edge.
        edge_grey: f32,
        /// 1 / thickness at which the high dome is full.
        high_contrast: f32,
    }
}

/// How much finer the second read of the map is. A whole number: offsets are reduced by whole tiles.
pub const FINER: f32 = 5.0;
/// How much the second read changes the grey.
pub const ROUGH_GREY: f32 = 0.2;
/// How much it changes the halvings of sunlight.
pub const ROUGH_DEPTH: f32 = 0.6;
/// Halvings of sunlight that thin clouds see.
pub const THIN_DEPTH: f32 = 0.3;
/// The least that a cloud leaves of sunlight: a step of a byte.
pub const LEAST_LIGHT: f32 = 1.0 / 255.0;
/// Heights of thin clouds and of the low dome's where it is opaque.
pub const BODY_HEIGHTS: [f32; 2] = [0.12, 0.6];
/// Halvings of sunlight by a thickness of 1, at density 0 and 1.
const EXTINCTION: [f32; 2] = [6.0, 9.0];
/// Where the second read starts.
pub const FINER_START: [f32; 2] = [0.37, 0.71];
/// How soft the foot of the opacity is.
pub const EDGE: f32 = 0.6;
/// Display-referred grey of a thin edge of the low clouds, at density 0 and 1.
const EDGE_GREY: [f32; 2] = [0.95, 0.62];
/// How much thickness darkens the low clouds at density 0 and 1. Chosen by eye, as are the next two.
const DARKENING: [f32; 2] = [0.25, 0.75];
/// Strength of the relief at density 0 and 1.
const RELIEF: [f32; 2] = [1.4, 0.7];
/// How much the second read roughens the edges of the low clouds.
const ROUGHNESS: f32 = 1.0;
/// How much fuzzier than the low dome the others are: a share of its exponent.
pub const THIN: f32 = 0.22;
/// Opacity of the middle and of the high dome where they are thick.
pub const MIDDLE_OPACITY: f32 = 0.65;
/// See [`MIDDLE_OPACITY`].
pub const HIGH_OPACITY: f32 = 0.45;

/// Heights of the domes over the ground, in metres: in the middle of the low, middle and high clouds of the
/// temperate zone (World Meteorological Organization, "International Cloud Atlas", 2017: 0-2, 2-7, 5-13 km).
pub const HEIGHTS_M: [f64; 3] = [LOW_HEIGHT_M, 4000.0, 9000.0];

/// How far the map reaches in heights of the low dome, at height 0 and 1.
const TILE: [f64; 2] = [9.0, 4.5];
/// The same for the middle and the high dome, in their own heights; the high dome's second number is along its streaks.
const MIDDLE_TILE: f64 = 3.6;
const HIGH_TILE: [f64; 2] = [2.3, 12.0];
/// How much coarser the high dome is read: a veil, not strokes.
pub const VEIL_LEVEL: f32 = 1.4;
/// How far the streaks of the high dome are bent, in tiles.
pub const BEND: f32 = 0.4;
/// How the domes are turned against the world, in radians: no two alike, none along an axis.
const TURNS: [f64; 3] = [0.4, 1.37, 2.5];
/// Where the wind of each dome goes (east, south), in units of the low dome's in metres a second. It veers and
/// grows with height, as in the northern hemisphere.
const WINDS: [DVec2; 3] = [
    DVec2::new(0.80, 0.60),
    DVec2::new(1.25, 1.40),
    DVec2::new(1.1, 2.5),
];
/// Where the map lies over the viewer at time 0, for each dome.
const STARTS: [DVec2; 3] = [
    DVec2::new(0.31, 0.12),
    DVec2::new(0.77, 0.45),
    DVec2::new(0.09, 0.83),
];

/// Step towards the sun for the relief, in heights of the layer.
const RELIEF_STEP: f64 = 0.11;
/// Halvings of sunlight in the thinnest places of an overcast, and how much less the others take beyond them: it is thick everywhere.
const OVERCAST_DEPTH: f32 = 2.0;
const OVERCAST_EVENED: f32 = 0.5;
/// How much the cut goes below 0 in an overcast.
const OVERCAST: f32 = 0.5;
/// The paper's range of a colour, by which it multiplies.
const COLOUR_RANGE: f32 = 255.0;

/// The method's share of the uniforms. `params` are in range; `sun_azimuth` is a unit vector (east, south), `sun_sine` that of
/// the sun's elevation.
pub fn uniforms(
    params: &SkyParams,
    view: &CloudView,
    sun_azimuth: Vec2,
    sun_sine: f32,
) -> OctaveUniforms {
    let own = params.octaves;
    let side = map::side(own.count);
    let low_tile = TILE[0] + (TILE[1] - TILE[0]) * f64::from(params.height);
    let tiles = [
        DVec2::splat(low_tile),
        DVec2::splat(MIDDLE_TILE),
        DVec2::from(HIGH_TILE),
    ];
    let way = MAX_WIND * LOW_HEIGHT_M * f64::from(params.speed) * view.seconds;
    let axes =
        |index: usize| DMat2::from_diagonal(tiles[index].recip()) * DMat2::from_angle(TURNS[index]);
    let dome = |index: usize| {
        let place = view.place(HEIGHTS_M[index]) - WINDS[index] * way / HEIGHTS_M[index];
        let seen = axes(index) * view.distance(HEIGHTS_M[index]);
        let texels_a_height = f64::from(side) * seen.determinant().abs().sqrt();
        let share = own.domes[index];
        // The low dome is what shuts the sky, whatever its share.
        let weight = if index == 0 && share > 0.0 {
            overcast_weight(params.cover)
        } else {
            0.0
        };
        let cover = params.cover * share * (1.0 - weight) + weight;
        OctaveDome {
            east_axis: seen.x_axis.as_vec2(),
            south_axis: seen.y_axis.as_vec2(),
            offset: offset(STARTS[index] + axes(index) * place),
            lod_bias: view.level(texels_a_height),
            threshold: 1.0 - cover - OVERCAST * weight,
        }
    };
    let [low, middle, high] = [0, 1, 2].map(dome);
    let sun_step = (axes(0) * sun_azimuth.as_dvec2() * RELIEF_STEP).as_vec2();
    let exponent = exponent(own.sharpness) * (1.0 + params.density);
    let mix = |[from, to]: [f32; 2]| from + (to - from) * params.density;
    OctaveUniforms {
        low,
        middle,
        high,
        exponent,
        darkening: mix(DARKENING),
        relief: mix(RELIEF),
        roughness: ROUGHNESS,
        sun_step,
        extinction: mix(EXTINCTION)
            * way_through(sun_sine)
            * (1.0 - OVERCAST_EVENED * overcast_weight(params.cover)),
        base_depth: OVERCAST_DEPTH * overcast_weight(params.cover),
        copies: bytemuck::cast(map::copies(own.count)),
        count: own.count as f32,
        resolution: side as f32,
        edge_grey: mix(EDGE_GREY),
        high_contrast: -0.5 * THIN * exponent,
    }
}

/// `log2 (1 - sharpness)^255`: the paper's base as an exponent of 2. Sharpness 1 is taken for as near to it as makes
/// opacity jump within half a step of a byte.
fn exponent(sharpness: f32) -> f32 {
    COLOUR_RANGE * (1.0 - sharpness).max(1e-7).log2()
}

/// Radiance of an overcast sky far away: the low dome where the map has its mean, without relief, as the paper shades it.
pub fn paper_overcast(octaves: &OctaveUniforms, clouds: &CloudUniforms) -> Vec3 {
    radiance(clouds, paper_grey(octaves))
}

/// Its grey.
pub(crate) fn paper_grey(octaves: &OctaveUniforms) -> f32 {
    let thickness = (0.5 - octaves.low.threshold.max(0.0)).max(0.0);
    (octaves.edge_grey - octaves.darkening * thickness).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    fn at(params: &SkyParams, seconds: f64, place_m: DVec3) -> OctaveUniforms {
        let view = CloudView {
            texels: 512,
            pixel_rad: 1e-3,
            seconds,
            place_m,
        };
        uniforms(params, &view, Vec2::X, 1.0)
    }

    /// From offsets in the map back to heights of the dome.
    fn moved(before: &OctaveDome, after: &OctaveDome) -> DVec2 {
        let axes = DMat2::from_cols(before.east_axis.as_dvec2(), before.south_axis.as_dvec2());
        let apart = (after.offset - before.offset).as_dvec2();
        axes.inverse() * (apart - apart.round())
    }

    #[test]
    fn a_walk_moves_near_domes_more_than_far_ones() {
        let params = SkyParams::default();
        let (here, there) = (
            at(&params, 0.0, DVec3::ZERO),
            at(&params, 0.0, DVec3::new(500.0, 0.0, -200.0)),
        );
        let domes = [
            (here.low, there.low),
            (here.middle, there.middle),
            (here.high, there.high),
        ];
        for ((before, after), height_m) in domes.iter().zip(HEIGHTS_M) {
            let expected = DVec2::new(500.0, -200.0) / height_m;
            assert!((moved(before, after) - expected).length() < 1e-5);
        }
    }

    #[test]
    fn wind_moves_clouds_along_and_still_air_does_not() {
        let windy = SkyParams {
            speed: 1.0,
            ..SkyParams::default()
        };
        let (before, after) = (at(&windy, 0.0, DVec3::ZERO), at(&windy, 1.0, DVec3::ZERO));
        // What stands over the viewer was upwind before.
        let low = moved(&before.low, &after.low);
        assert!((low + WINDS[0] * MAX_WIND).length() < 1e-5, "{low}");
        let still = SkyParams {
            speed: 0.0,
            ..SkyParams::default()
        };
        assert_eq!(at(&still, 0.0, DVec3::ZERO), at(&still, 9e8, DVec3::ZERO));
    }

    #[test]
    fn a_dome_without_cover_is_left_out() {
        let mut params = SkyParams::default();
        params.octaves.domes = [1.0, 0.0, 0.5];
        let octaves = at(&params, 0.0, DVec3::ZERO);
        assert_eq!(octaves.middle.threshold, 1.0);
        assert!(octaves.low.threshold < 1.0 && octaves.high.threshold < 1.0);
        params.cover = 0.0;
        assert_eq!(at(&params, 0.0, DVec3::ZERO).low.threshold, 1.0);
    }

    #[test]
    fn sharpness_is_the_papers_base() {
        for (sharpness, colour) in [(0.0, 0.4), (0.02, 0.3), (0.5, 0.01)] {
            let papers = 1.0 - (1.0 - f64::from(sharpness)).powf(255.0 * colour);
            let ours = 1.0 - (f64::from(exponent(sharpness)) * colour).exp2();
            assert!((papers - ours).abs() < 1e-5, "{sharpness} {colour}");
        }
        assert!(1.0 - (exponent(1.0) / 255.0 / 2.0).exp2() > 1.0 - 0.5 / 255.0);
    }
}

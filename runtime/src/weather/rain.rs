//! Rain: streaks at all distances up to 13 metres, and the grey haze that it makes of the air.
//!
//! # Theory
//! A drop of 2 or 3 millimetres falls at 6.5 or 8.1 metres a second (R. Gunn, G. D. Kinzer, "The Terminal Velocity of Fall for Water
//! Droplets in Stagnant Air", Journal of Meteorology 6, 1949, table 2), and while a shutter is open, or an eye looks, it draws a streak.
//! All streaks are parallel: on the screen they run towards the point that the rain falls to, and away from the one it comes from.
//! A drop refracts the whole sky behind it, so it is about as bright as the sky is on average.
//!
//! # Practice
//! Off by default. Drops fall about the viewer, along an axis that leans a little with the wind, over a height of [`HEIGHT_M`]; one that is
//! at the end of it begins anew in another place, which is an integer hash of its number and of how often it has fallen: a frame is a function of
//! parameters, camera and seconds. A streak is a quad that its vertex shader makes from that hash, so streaks cost what they cover, a few
//! hundredths of the screen, and the fragment shader is four multiplications. One that would be narrower or shorter than a pixel is as
//! large as one and fainter, with a profile that adds up to the same wherever it lies between pixels: rain does not sparkle.
//! [`COLUMNS`] are numbered around the axis, and only those in sight are drawn.
//!
//! Streaks lie over the scene too, whatever its depth; the host that wants walls to keep them off draws them later. They want a target
//! that can be blended with; on another one there is the haze only. The haze is part of the sky: how far the things of a scene are
//! away the host alone knows, and fog of its own is what they want.

use std::f32::consts::TAU;

use glam::{DVec2, DVec3, Vec2, Vec3};

use crate::clouds::shared::{CloudUniforms, CloudView};
use crate::geometry::camera::Rays;
use crate::geometry::part::{Part, Value};
use crate::geometry::uniforms::uniforms;
use crate::params::SkyParams;
use crate::weather::lightning::LightningUniforms;

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[
        ("RAIN_HEIGHT", Value::F32(HEIGHT_M as f32)),
        ("RAIN_FADE", Value::F32(FADE)),
        ("RAIN_HAZE_ABOVE", Value::F32(HAZE_ABOVE)),
        ("RAIN_HAZE_FALL", Value::F32(HAZE_FALL)),
        ("RAIN_COLUMNS", Value::U32(COLUMNS)),
        ("RAIN_SLOTS", Value::U32(DROPS_A_COLUMN)),
        ("RAIN_MIDDLE", Value::U32(SLOTS[0])),
        ("RAIN_FAR", Value::U32(SLOTS[0] + SLOTS[1])),
    ],
    structs: &[RainDrops::WGSL, RainUniforms::WGSL],
    wgsl: include_str!("rain.wgsl"),
};

uniforms! {
    /// A kind of drops.
    RainDrops {
        /// How often the first has fallen the whole height: what is over whole numbers.
        fallen_fraction: f32,
        /// The whole number.
        fallen_count: f32,
        /// The nearest to the axis, in metres.
        radius_m: f32,
        /// How far from there they go, in metres.
        radius_range_m: f32,
        /// Half the width and half the length of a streak, in metres.
        half_size_m: Vec2,
        /// Opacity of a streak.
        opacity: f32,
        /// Nothing.
        _pad: f32,
    }

    /// Rain, all 0 without.
    RainUniforms {
        /// Unit vector across the fall.
        right: Vec3,
        /// Fraction of the drops that are there.
        amount: f32,
        /// Unit vector against the fall.
        up: Vec3,
        /// A pixel in the middle of the screen, in radians.
        pixel_rad: f32,
        /// Unit vector across both.
        forward: Vec3,
        /// First column in sight.
        first_column: f32,
        /// Radiance of a streak.
        streak: Vec3,
        /// How many columns are in sight.
        columns: f32,
        /// Radiance of the haze.
        haze: Vec3,
        /// Opacity of the haze at the horizon.
        haze_opacity: f32,
        /// Of each kind, from the nearest.
        drops: [RainDrops; KINDS],
    }
}

/// Kinds of drops: near, farther and far.
pub const KINDS: usize = 3;
/// Parts of the full turn about the axis.
pub const COLUMNS: u32 = 1024;
/// Drops of each kind in a column.
pub const SLOTS: [u32; KINDS] = [2, 6, 16];
/// Drops of all kinds in a column.
pub const DROPS_A_COLUMN: u32 = SLOTS[0] + SLOTS[1] + SLOTS[2];
/// How far a drop falls, half of it above the viewer.
pub const HEIGHT_M: f64 = 20.0;
/// 1 / the share of the height in which streaks come up and fade out.
pub const FADE: f32 = 5.0;
/// Share of the haze that is left far above and below the horizon.
pub const HAZE_ABOVE: f32 = 0.35;
/// Halvings of the rest of the haze by a sine of 1.
pub const HAZE_FALL: f32 = 7.0;

/// A kind of drops.
struct Kind {
    /// The nearest and the farthest from the axis.
    radii_m: [f64; 2],
    /// Speed of the fall: nearer drops are seen if they are large, and large ones are fast.
    fall_m_s: f64,
    /// Diameter of a drop. Near ones are out of focus, and wider.
    diameter_m: f64,
    /// Opacity of a streak.
    opacity: f32,
}

const fn kind(radii_m: [f64; 2], fall_m_s: f64, diameter_m: f64, opacity: f32) -> Kind {
    Kind {
        radii_m,
        fall_m_s,
        diameter_m,
        opacity,
    }
}

/// Near, farther and far: the fall is that of drops of 3 to 2 millimetres (Gunn and Kinzer); widths and opacities are chosen by eye, wide as out of focus.
const RAIN: [Kind; KINDS] = [
    kind([1.2, 2.5], 8.1, 0.007, 0.48),
    kind([2.5, 6.0], 7.4, 0.010, 0.65),
    kind([6.0, 13.0], 6.5, 0.015, 0.72),
];

/// Seconds in which a drop draws its streak: a frame of a film.
const EXPOSURE_S: f64 = 1.0 / 30.0;
/// Wind at speed 1 near the ground, in metres a second to the east and to the south: the way of the lowest clouds.
const WIND_M_S: [f64; 2] = [2.4, 1.8];
/// The slowest fall, that of the axis.
const AXIS_FALL_M_S: f64 = 7.0;
/// The opacity of the haze at the horizon where rain is 1.
const HAZE: f32 = 0.6;
/// Light of sun, sky and lightning on streaks and on haze. Chosen by eye.
const STREAK_LIGHT: [f32; 3] = [0.45, 1.3, 0.45];
const HAZE_LIGHT: [f32; 3] = [0.15, 0.8, 0.12];
/// Falls over the whole height after which the rain repeats: more than a day.
const PERIOD: f64 = 65_536.0;
/// Corners of a streak's two triangles.
const VERTICES_A_DROP: u32 = 6;
/// A point of the axis that is outside the screen by less than this share of its half sides counts as seen.
const NEARLY_SEEN: f32 = 0.1;

/// The rain's share of the uniforms. `params` are in range.
pub fn uniforms(
    params: &SkyParams,
    view: &CloudView,
    screen: &Rays,
    clouds: &CloudUniforms,
    flash: &LightningUniforms,
) -> RainUniforms {
    let amount = params.weather.rain;
    if amount == 0.0 {
        return RainUniforms::default();
    }
    let [east, south] = WIND_M_S.map(|wind| wind * f64::from(params.speed));
    let up = DVec3::new(-east, AXIS_FALL_M_S, -south).normalize();
    // The seam of the columns lies to the north.
    let right = up.cross(DVec3::NEG_Z).normalize();
    let axes = [right, up, up.cross(right)].map(|axis| axis.as_vec3());
    let [first_column, columns] = columns_in_sight(axes, screen, view.pixel_rad);
    let [right, up, forward] = axes;
    let light = |[sun, sky, lightning]: [f32; 3]| {
        sky * clouds.ambient + sun * clouds.sunlight + lightning * flash.light
    };
    RainUniforms {
        right,
        amount: amount.sqrt(),
        up,
        pixel_rad: view.pixel_rad,
        forward,
        first_column: first_column as f32,
        streak: light(STREAK_LIGHT),
        columns: columns as f32,
        haze: light(HAZE_LIGHT),
        haze_opacity: HAZE * amount,
        drops: RAIN.map(|own| drops(&own, view.seconds)),
    }
}

/// How many vertices draw the streaks of a frame, 0 without rain.
pub(crate) fn vertices(rain: &RainUniforms) -> u32 {
    rain.columns as u32 * DROPS_A_COLUMN * VERTICES_A_DROP
}

fn drops(own: &Kind, seconds: f64) -> RainDrops {
    let fallen = (own.fall_m_s * seconds / HEIGHT_M).rem_euclid(PERIOD);
    let [least, most] = own.radii_m;
    RainDrops {
        fallen_fraction: fallen.fract() as f32,
        fallen_count: fallen.trunc() as f32,
        radius_m: least as f32,
        radius_range_m: (most - least) as f32,
        half_size_m: (0.5 * DVec2::new(own.diameter_m, own.fall_m_s * EXPOSURE_S)).as_vec2(),
        opacity: own.opacity,
        ..Default::default()
    }
}

/// The first column that a screen shows a part of, and how many it does. `axes` are those of the rain: right, up, forward.
///
/// Azimuth is monotonic along a straight line of the screen, a great circle, so the screen ends at its corners, unless it shows a
/// point of the axis, where all columns meet.
fn columns_in_sight([right, up, forward]: [Vec3; 3], screen: &Rays, pixel_rad: f32) -> [u32; 2] {
    let inverse = glam::Mat3::from_cols(screen.right, screen.up, screen.forward).inverse();
    let seen = |point: Vec3| {
        let at = inverse * point;
        at.z > 0.0 && at.x.abs().max(at.y.abs()) < (1.0 + NEARLY_SEEN) * at.z
    };
    let widest = RAIN.iter().map(|own| widest_rad(own, pixel_rad));
    let margin = widest.fold(0.0, f32::max) / TAU;
    let turns = |ray: Vec3| ray.dot(right).atan2(ray.dot(forward)) / TAU;
    let middle = turns(screen.forward);
    let corners = [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)];
    let aside = corners.map(|(x, y)| {
        let apart = turns(screen.forward + screen.right * x + screen.up * y) - middle;
        apart - apart.round()
    });
    let least = aside.into_iter().fold(0.0, f32::min) - margin;
    let most = aside.into_iter().fold(0.0, f32::max) + margin;
    let [first, last] = [least, most].map(|a| ((middle + 0.5 + a) * COLUMNS as f32).floor());
    if seen(up) || seen(-up) || last - first >= COLUMNS as f32 {
        return [0, COLUMNS];
    }
    [
        (first as i32).rem_euclid(COLUMNS as i32) as u32,
        (last - first) as u32 + 1,
    ]
}

/// The widest that half a streak of a kind is seen about the axis.
fn widest_rad(own: &Kind, pixel_rad: f32) -> f32 {
    let nearest = own.radii_m[0];
    let farthest = nearest.hypot(0.5 * HEIGHT_M) as f32;
    let half_width = (0.5 * own.diameter_m as f32).max(pixel_rad * farthest);
    (half_width / nearest as f32).atan()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::camera::Camera;

    fn at(speed: f32, seconds: f64, camera: &Camera) -> RainUniforms {
        let mut params = SkyParams {
            speed,
            ..SkyParams::default()
        };
        params.weather.rain = 1.0;
        let screen = camera.rays();
        let view = CloudView {
            texels: 512,
            pixel_rad: 2.0 * screen.up.length() / camera.viewport().y,
            seconds,
            place_m: DVec3::ZERO,
        };
        uniforms(
            &params,
            &view,
            &screen,
            &CloudUniforms::default(),
            &LightningUniforms::default(),
        )
    }

    fn level() -> Camera {
        Camera::looking(1.0, 0.0, 1.0, [1920, 1080])
    }

    fn axes(rain: &RainUniforms) -> [Vec3; 3] {
        [rain.right, rain.up, rain.forward]
    }

    #[test]
    fn it_falls_straight_in_still_air_and_with_the_wind_else() {
        assert_eq!(axes(&at(0.0, 0.0, &level()))[1], Vec3::Y);
        let [right, up, forward] = axes(&at(1.0, 0.0, &level()));
        assert!(
            up.x < 0.0 && up.z < 0.0,
            "it comes from where the wind does: {up}"
        );
        assert!(right.dot(up).abs() + right.dot(forward).abs() + up.dot(forward).abs() < 1e-6);
    }

    /// Numbers of drops and of falls share the bits of a hash.
    #[test]
    fn every_drop_has_its_place() {
        const { assert!(COLUMNS * DROPS_A_COLUMN <= 1 << 15) }
        assert_eq!(PERIOD, f64::from(1 << 16));
        let mut farthest = RAIN[0].radii_m[0];
        for own in &RAIN {
            // 2 and 3 millimetres: Gunn and Kinzer.
            assert!((6.49..=8.1).contains(&own.fall_m_s));
            assert_eq!(own.radii_m[0], farthest, "no gap");
            farthest = own.radii_m[1];
        }
    }

    #[test]
    fn it_falls_at_its_speed_at_any_second() {
        let fallen = |seconds: f64| {
            at(0.0, seconds, &level())
                .drops
                .map(|own| f64::from(own.fallen_count) + f64::from(own.fallen_fraction))
        };
        for seconds in [0.0, 5.0, 7777.7, 1e6, -40.0] {
            let (before, after) = (fallen(seconds), fallen(seconds + 0.5));
            for (own, (before, after)) in RAIN.iter().zip(before.iter().zip(after)) {
                let gone_m = (after - before).rem_euclid(PERIOD) * HEIGHT_M;
                assert!(
                    (gone_m - 0.5 * own.fall_m_s).abs() < 1e-4,
                    "{seconds}: {gone_m}"
                );
            }
        }
    }

    #[test]
    fn whatever_the_screen_shows_is_in_a_column_in_sight() {
        let mut fewest = COLUMNS;
        for turn in 0..400_u32 {
            let number = |step: f32| (turn as f32 * step).fract();
            let (azimuth, elevation) = (TAU * number(0.618), 3.1 * (number(0.755) - 0.5));
            let fov = 0.1 + 2.4 * number(0.31) * number(0.31);
            let mut camera = Camera::looking(azimuth, elevation, fov, [1920, 1080]);
            camera.orientation *= glam::Quat::from_rotation_z(TAU * number(0.413));
            camera.lens_shift = glam::Vec2::new(number(0.27), number(0.59)) - 0.5;
            let rain = at(number(0.9), 0.0, &camera);
            let ([right, _, forward], rays) = (axes(&rain), camera.rays());
            let [first, count] = [rain.first_column, rain.columns];
            fewest = fewest.min(count as u32);
            for (x, y) in (0..21).flat_map(|x| (0..21).map(move |y| (x, y))) {
                let [x, y] = [x, y].map(|i| i as f32 / 10.0 - 1.0);
                let ray = rays.forward + rays.right * x + rays.up * y;
                let turns = ray.dot(right).atan2(ray.dot(forward)) / TAU + 0.5;
                let column = (turns * COLUMNS as f32).floor();
                let after = (column - first).rem_euclid(COLUMNS as f32);
                assert!(
                    after < count,
                    "{turn}: {column} is not among {count} from {first}"
                );
            }
        }
        assert!(fewest < COLUMNS / 20, "{fewest}: narrow views show few");
    }
}

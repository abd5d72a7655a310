//! Rain: streaks at several distances, and the grey haze that it makes of the air.
//!
//! # Theory
//! A drop of 2 or 3 millimetres falls at 6.5 or 8.1 metres a second (R. Gunn, G. D. Kinzer, "The Terminal Velocity of Fall for Water
//! Droplets in Stagnant Air", Journal of Meteorology 6, 1949, table 2), and while a shutter is open, or an eye looks, it draws a streak.
//! All streaks are parallel: on the screen they run towards the point that the rain falls to, and away from the one it comes from.
//! A drop refracts the whole sky behind it, so it is about as bright as the sky is on average.
//!
//! # Practice
//! Off by default. Drops are cells of [`CYLINDERS`] cylinders about the viewer, whose axis is the way that the rain falls, down and a
//! little with the wind. Which cells hold a drop, and where in its cell that drop is, is an integer hash: a frame is a function
//! of parameters, camera and seconds. A streak that would be narrower than a pixel is as wide as one and fainter, so rain
//! does not sparkle. It is one triangle over the screen with no read at all, over the scene too, whatever its depth; the host
//! that wants walls to keep it off draws them later. It wants a target that can be blended with; on another one there is no rain.

use glam::{DVec3, Vec3};

use crate::clouds::CloudView;
use crate::uniforms::{CloudUniforms, LightningUniforms, LitUniforms, RainUniforms, vec4};
use crate::{Method, SkyParams};

/// Cylinders of streaks, each about twice as far as the one before it.
pub const CYLINDERS: usize = 3;
/// Share of the haze that is left far above and below the horizon.
pub const HAZE_ABOVE: f32 = 0.35;
/// Halvings of the rest of the haze by a sine of 1.
pub const HAZE_FALL: f32 = 7.0;

/// A cylinder.
struct Cylinder {
    radius_m: f64,
    /// How many drops lie side by side around it.
    columns: f32,
    /// How far a column's drops are apart.
    cell_m: f64,
    /// Speed of the fall: nearer drops are seen if they are large, and large ones are fast.
    fall_m_s: f64,
    /// Diameter of a drop. Near ones are out of focus, and wider.
    diameter_m: f64,
    /// Opacity of a streak.
    opacity: f32,
}

const fn cylinder(
    radius_m: f64,
    columns: f32,
    cell_m: f64,
    fall_m_s: f64,
    diameter_m: f64,
    opacity: f32,
) -> Cylinder {
    Cylinder {
        radius_m,
        columns,
        cell_m,
        fall_m_s,
        diameter_m,
        opacity,
    }
}

const RAIN: [Cylinder; CYLINDERS] = [
    cylinder(1.6, 120.0, 0.9, 8.1, 0.007, 0.5),
    cylinder(4.0, 330.0, 0.8, 7.4, 0.010, 0.6),
    cylinder(9.0, 820.0, 0.9, 6.5, 0.015, 0.6),
];

/// Seconds in which a drop draws its streak: a frame of a film.
const EXPOSURE_S: f64 = 1.0 / 30.0;
/// Wind at speed 1 near the ground, in metres a second to the east and to the south: the way of the lowest clouds.
const WIND_M_S: [f64; 2] = [2.4, 1.8];
/// The slowest fall, that of the axis.
const AXIS_FALL_M_S: f64 = 7.0;
/// The opacity of streaks and of the haze at the horizon where rain is 1.
const STREAKS: f32 = 0.8;
const HAZE: f32 = 0.6;
/// What a flash adds to the light of streaks and haze.
const FLASH: [f32; 2] = [0.45, 0.12];
/// Half the width of a streak, as a share of its column, at which it begins to fade.
const ROOM: f32 = 0.15;
/// Share of cells that hold a drop where rain is 1.
const DROPS: f32 = 0.85;
/// Cells after which the rain repeats: more than two hours.
const PERIOD: f64 = 65_536.0;

/// The rain's share of the uniforms, all 0 without rain. `params` are in range.
pub fn uniforms(
    params: &SkyParams,
    view: &CloudView,
    clouds: &CloudUniforms,
    lit: &LitUniforms,
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
    let mut rain = RainUniforms {
        right: vec4(right.as_vec3(), DROPS * amount.sqrt()),
        up: vec4(up.as_vec3(), view.pixel_rad),
        forward: vec4(up.cross(right).as_vec3(), 0.0),
        ..Default::default()
    };
    for (index, own) in RAIN.iter().enumerate() {
        let fallen = (own.fall_m_s * view.seconds / own.cell_m).rem_euclid(PERIOD);
        rain.cylinders[index] = [
            own.columns,
            (own.radius_m / own.cell_m) as f32,
            fallen.fract() as f32,
            fallen.trunc() as f32,
        ];
        rain.widths[index] = widths(own, view.pixel_rad);
    }
    let rgb = |v: [f32; 4]| Vec3::new(v[0], v[1], v[2]);
    let sunlight = match params.method {
        Method::Lit => lit.light,
        _ => clouds.sunlight,
    };
    let (sun, ambient) = (rgb(sunlight), rgb(clouds.ambient));
    let [lit_streaks, lit_haze] = FLASH.map(|share| share * rgb(flash.light));
    rain.streak = vec4(1.3 * ambient + 0.45 * sun + lit_streaks, STREAKS);
    rain.haze = vec4(0.8 * ambient + 0.15 * sun + lit_haze, HAZE * amount);
    rain
}

/// Of the streaks on a cylinder: columns over half their width, 1 / half their length in cells, opacity, and how little room
/// columns leave them.
fn widths(own: &Cylinder, pixel_rad: f32) -> [f32; 4] {
    let real_rad = (0.5 * own.diameter_m / own.radius_m) as f32;
    // A streak that is narrower than a pixel is as wide as one, and fainter.
    let half_width_rad = real_rad.max(pixel_rad);
    let column_rad = std::f32::consts::TAU / own.columns;
    [
        column_rad / half_width_rad,
        (2.0 * own.cell_m / (own.fall_m_s * EXPOSURE_S)) as f32,
        own.opacity * (real_rad / pixel_rad).min(1.0),
        half_width_rad / (ROOM * column_rad),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(speed: f32, seconds: f64) -> RainUniforms {
        let mut params = SkyParams {
            speed,
            ..SkyParams::default()
        };
        params.weather.rain = 1.0;
        let view = CloudView {
            texels: 512,
            pixel_rad: 1e-3,
            seconds,
            place_m: DVec3::ZERO,
        };
        uniforms(
            &params,
            &view,
            &CloudUniforms::default(),
            &LitUniforms::default(),
            &LightningUniforms::default(),
        )
    }

    #[test]
    fn it_falls_straight_in_still_air_and_with_the_wind_else() {
        let xyz = |v: [f32; 4]| Vec3::new(v[0], v[1], v[2]);
        assert_eq!(xyz(at(0.0, 0.0).up), Vec3::Y);
        let windy = at(1.0, 0.0);
        let (right, up, forward) = (xyz(windy.right), xyz(windy.up), xyz(windy.forward));
        assert!(
            up.x < 0.0 && up.z < 0.0,
            "it comes from where the wind does: {up}"
        );
        assert!(right.dot(up).abs() + right.dot(forward).abs() + up.dot(forward).abs() < 1e-6);
    }

    /// Columns and cells share the bits of a hash, and streaks keep off the edges of their cells.
    #[test]
    fn every_drop_has_its_place() {
        for (own, [columns, ..]) in RAIN.iter().zip(at(0.3, 0.0).cylinders) {
            assert_eq!(columns, own.columns);
            assert!(own.columns < 1024.0, "ten bits");
            assert!(own.fall_m_s * EXPOSURE_S < 0.5 * own.cell_m, "half a cell");
            // 2 and 3 millimetres: Gunn and Kinzer.
            assert!((6.49..=8.1).contains(&own.fall_m_s));
        }
    }

    #[test]
    fn it_falls_at_its_speed_at_any_second() {
        let fallen = |seconds: f64| {
            at(0.0, seconds)
                .cylinders
                .map(|c| f64::from(c[3]) + f64::from(c[2]))
        };
        for seconds in [0.0, 5.0, 7777.7, 1e6, -40.0] {
            let (before, after) = (fallen(seconds), fallen(seconds + 0.5));
            for (own, (before, after)) in RAIN.iter().zip(before.iter().zip(after)) {
                let gone = (after - before).rem_euclid(PERIOD);
                assert!(
                    (gone - 0.5 * own.fall_m_s / own.cell_m).abs() < 1e-3,
                    "{seconds}: {gone}"
                );
            }
        }
    }
}

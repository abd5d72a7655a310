//! The light that a sky says it gives, beside what its picture gives: every method, by day, in the evening, at night.

use std::f32::consts::{FRAC_PI_2, PI, TAU};

use glam::Vec3;
use welkin_runtime::internals::geometry::harmonics::{CLAMPED_COSINE, COUNT, basis};
use welkin_runtime::internals::geometry::math::luminance;
use welkin_runtime::params::SkyModel;
use welkin_runtime::{Camera, Method, Oktas, Sky, SkyParams};
use welkin_tests::{gpu, pack};

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
/// Pixels a side of a face.
const SIDE: u32 = 48;

/// Directions of the faces: azimuth and elevation.
const FACES: [[f32; 2]; 6] = [
    [0.0, 0.0],
    [0.25 * TAU, 0.0],
    [0.5 * TAU, 0.0],
    [0.75 * TAU, 0.0],
    [0.0, FRAC_PI_2],
    [0.0, -FRAC_PI_2],
];

/// Coefficients of irradiance of the picture all round, without sun and stars.
fn drawn(sky: &mut Sky, params: &SkyParams, seconds: f64) -> [Vec3; COUNT] {
    let params = SkyParams {
        sun: false,
        stars: false,
        flare: 0.0,
        ..*params
    };
    let mut sum = [Vec3::ZERO; COUNT];
    for [azimuth, elevation] in FACES {
        let view = Camera::looking(azimuth, elevation, FRAC_PI_2, [SIDE, SIDE]);
        let rays = view.rays();
        let pixels = gpu::rgb(&gpu::render(sky, FORMAT, &params, &view, seconds));
        for (i, radiance) in pixels.iter().enumerate() {
            let [x, y] = [i as u32 % SIDE, i as u32 / SIDE]
                .map(|p| 2.0 * (p as f32 + 0.5) / SIDE as f32 - 1.0);
            let ray = rays.forward + rays.right * x - rays.up * y;
            let solid_angle = 4.0 / (SIDE * SIDE) as f32 / (1.0 + x * x + y * y).powf(1.5);
            let terms = basis(ray.normalize().as_dvec3().to_array());
            for ((sum, term), factor) in sum.iter_mut().zip(terms).zip(CLAMPED_COSINE) {
                *sum += *radiance * (solid_angle * (term * factor) as f32);
            }
        }
    }
    sum
}

/// Normals of planes: up, four walls, down.
const NORMALS: [Vec3; 6] = [
    Vec3::Y,
    Vec3::X,
    Vec3::NEG_X,
    Vec3::Z,
    Vec3::NEG_Z,
    Vec3::NEG_Y,
];

/// By how much the largest irradiance of a plane is off, as a share of what lies flat.
fn apart(light: &[Vec3; COUNT], other: &[Vec3; COUNT]) -> f32 {
    let at = |light: &[Vec3; COUNT], normal: Vec3| {
        let terms = basis(normal.as_dvec3().to_array());
        let pairs = light.iter().zip(terms);
        luminance(pairs.map(|(c, t)| *c * t as f32).sum())
    };
    let flat = at(other, Vec3::Y);
    let off = NORMALS.map(|normal| (at(light, normal) - at(other, normal)).abs() / flat);
    off.into_iter().fold(0.0, f32::max)
}

/// Times with the sun at 60, some 20 and 3 degrees, under the horizon, and by moonlight.
const TIMES: [(&str, f32); 5] = [
    ("noon", 0.5),
    ("afternoon", 0.68),
    ("evening", 0.7404),
    ("twilight", 0.76),
    ("night", 0.95),
];

/// What a plane may be off by, as a share of what lies flat, under 0, 4 and 8 oktas. The clear sky is sampled at the texels of its table, an overcast's
/// colour is a mean. Between them the clouds of a moment are not known: the mean over moments is asked for.
const BOUNDS: [f32; 3] = [0.05, 0.3, 0.12];

/// Of planes that face six ways, whatever the method and the hour.
#[test]
fn the_light_of_a_sky_is_that_of_its_picture() {
    let oktas = Oktas::new(pack::default_pack()).expect("the pack is whole");
    let mut worst = [0.0_f32; 3];
    let mut failed = Vec::new();
    for method in Method::ALL {
        let mut sky = gpu::sky(pack::default_pack(), FORMAT);
        for (name, time) in TIMES {
            for (i, eighths) in [0.0, 4.0, 8.0].into_iter().enumerate() {
                let mut params = SkyParams {
                    method,
                    time,
                    upper_layer: 0.0,
                    // Its pattern is that of a place: see below.
                    ground: [0.0; 3],
                    ..SkyParams::default()
                };
                params.cover = oktas.cover(&params, eighths);
                let light = sky.light(&params, 30.0);
                let moments: &[f64] = if i == 1 {
                    &[30.0, 900.0, 4000.0, 9000.0]
                } else {
                    &[30.0]
                };
                let mut mean = [Vec3::ZERO; COUNT];
                for &seconds in moments {
                    let picture = drawn(&mut sky, &params, seconds);
                    for (mean, c) in mean.iter_mut().zip(picture) {
                        *mean += c / moments.len() as f32;
                    }
                }
                let off = apart(&light.ambient, &mean);
                worst[i] = worst[i].max(off);
                println!("{} {name} {eighths}: {off:.3}", method.name());
                if off > BOUNDS[i] {
                    failed.push(format!("{} {name} {eighths}: {off:.3}", method.name()));
                }
            }
        }
    }
    println!("worst: {worst:?}");
    assert!(failed.is_empty(), "{failed:#?}");
}

/// Perez's clear sky, too.
#[test]
fn so_is_that_of_a_perez_sky() {
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    for (name, time) in TIMES {
        let params = SkyParams {
            sky: SkyModel::Perez,
            cover: 0.0,
            upper_layer: 0.0,
            ground: [0.0; 3],
            time,
            ..SkyParams::default()
        };
        let light = sky.light(&params, 0.0);
        let off = apart(&light.ambient, &drawn(&mut sky, &params, 0.0));
        println!("{name}: {off:.3}");
        assert!(off < BOUNDS[0], "{name}: {off}");
    }
}

/// What comes up from a sea, with the glitter of the sun, and single waves that stand for none.
#[test]
fn so_is_that_over_a_sea() {
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    for (name, time) in TIMES {
        for cover in [0.0, 1.0] {
            let params = SkyParams {
                cover,
                upper_layer: 0.0,
                sea: true,
                time,
                ..SkyParams::default()
            };
            let light = sky.light(&params, 0.0);
            let picture = drawn(&mut sky, &params, 0.0);
            let at = |light: &[Vec3; COUNT], normal: Vec3| {
                let terms = basis(normal.as_dvec3().to_array());
                let pairs = light.iter().zip(terms);
                luminance(pairs.map(|(c, t)| *c * t as f32).sum())
            };
            // A wall that faces the glitter has several times what lies flat.
            let flat = at(&picture, Vec3::Y);
            let off = NORMALS.map(|normal| {
                let [found, seen] = [&light.ambient, &picture].map(|light| at(light, normal));
                (found - seen).abs() / seen.max(flat)
            });
            let off = off.into_iter().fold(0.0, f32::max);
            println!("sea, {name} {cover}: {off:.3}");
            assert!(off < 0.12, "{name} {cover}: {off}");
        }
    }
}

/// With the sun's light added, what lies flat under a clear noon has what the disc in the picture gives.
#[test]
fn the_light_of_the_sun_is_that_of_its_disc() {
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    let params = SkyParams {
        cover: 0.0,
        upper_layer: 0.0,
        flare: 0.0,
        ..SkyParams::default()
    };
    let light = sky.light(&params, 0.0);
    let sun = light.sun.direction;
    let azimuth = sun.x.atan2(-sun.z);
    let fov = 2.0_f32.to_radians();
    let view = Camera::looking(azimuth, sun.y.asin(), fov, [256, 256]);
    let without = SkyParams {
        sun: false,
        ..params
    };
    let [with, without] = [params, without]
        .map(|params| gpu::rgb(&gpu::render(&mut sky, FORMAT, &params, &view, 0.0)));
    let pixel_sr = (2.0 * (0.5 * fov).tan() / 256.0).powi(2);
    let disc: Vec3 = with
        .iter()
        .zip(&without)
        .map(|(a, b)| (*a - *b) * pixel_sr)
        .sum();
    let off = (disc / light.sun.irradiance - 1.0).abs().max_element();
    assert!(off < 0.02, "{disc} {}", light.sun.irradiance);
    assert_eq!(light.moon.irradiance, Vec3::ZERO);
}

/// An automatic exposure is the one that the light says.
#[test]
fn a_sky_is_exposed_by_its_light() {
    let format = wgpu::TextureFormat::Rgba8UnormSrgb;
    let mut sky = gpu::sky(pack::default_pack(), format);
    let view = Camera::looking(1.0, 0.3, 1.0, [32, 18]);
    for (_, time) in TIMES {
        let params = SkyParams {
            time,
            exposure_ev: -1.0,
            ..SkyParams::default()
        };
        let given = SkyParams {
            exposure: sky.light(&params, 0.0).exposure,
            ..params
        };
        let automatic = SkyParams {
            auto_exposure: true,
            exposure: 1.0,
            ..params
        };
        assert_eq!(sky.exposed(&automatic, 0.0).exposure, given.exposure);
        let [given, automatic] =
            [given, automatic].map(|params| gpu::render(&mut sky, format, &params, &view, 0.0));
        assert_eq!(given, automatic);
    }
}

/// A frame of the same moment spares the sky its making, and changes nothing.
#[test]
fn light_is_the_same_before_and_after_a_frame_and_at_another_moment() {
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    for time in [0.3, 0.5, 0.9] {
        let params = SkyParams {
            time,
            ..SkyParams::default()
        };
        let before = sky.light(&params, 3.0);
        gpu::prepare(
            &mut sky,
            &params,
            &Camera::looking(0.0, 0.0, 1.0, [8, 8]),
            3.0,
        );
        assert_eq!(sky.light(&params, 3.0), before);
        let hazy = SkyParams {
            haze: 1.0,
            ..params
        };
        assert!(sky.light(&hazy, 3.0) != before);
    }
}

/// Clouds take the sun's light, and by night there is the moon's alone.
#[test]
fn luminaries_go_with_clouds_and_hours() {
    let sky = gpu::sky(pack::default_pack(), FORMAT);
    let at = |time: f32, cover: f32| {
        let params = SkyParams {
            time,
            cover,
            ..SkyParams::default()
        };
        sky.light(&params, 0.0)
    };
    let levels = [0.0, 0.4, 0.7, 1.0].map(|cover| luminance(at(0.5, cover).sun.irradiance));
    assert!(levels.windows(2).all(|w| w[1] < w[0]), "{levels:?}");
    assert!(levels[3] < 0.02 * levels[0]);
    let night = at(0.0, 0.0);
    assert_eq!(night.sun.irradiance, Vec3::ZERO);
    assert!(luminance(night.moon.irradiance) > 0.0 && night.moon.direction.y > 0.5);
    assert!((night.sun.direction + night.moon.direction).length() < 1e-6);
    // A white surface under a clear noon is about 1: sun and sky.
    let noon = at(0.5, 0.0);
    let white = luminance(noon.irradiance(Vec3::Y)) / PI;
    assert!((0.8..1.3).contains(&white), "{white}");
    assert!(at(0.74, 0.3).exposure > noon.exposure);
}

/// The ground's light from below, as a mean over places, since its pattern is not the same everywhere.
#[test]
fn the_ground_throws_light_back() {
    const PLACES: usize = 24;
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    for (name, time) in TIMES {
        let params = SkyParams {
            cover: 0.0,
            upper_layer: 0.0,
            sun: false,
            stars: false,
            flare: 0.0,
            time,
            ..SkyParams::default()
        };
        let light = sky.light(&params, 0.0);
        let mut mean = Vec3::ZERO;
        for i in 0..PLACES {
            let view = Camera {
                position_m: Vec3::new(1234.5 * i as f32, 0.0, 777.7 * (i * i) as f32),
                ..Camera::looking(0.0, -FRAC_PI_2, FRAC_PI_2, [16, 16])
            };
            let pixels = gpu::rgb(&gpu::render(&mut sky, FORMAT, &params, &view, 0.0));
            mean += pixels.iter().sum::<Vec3>() / (256 * PLACES) as f32;
        }
        // Straight down, where the sun's light comes back alike from all sides, and with the light of the horizon left out.
        let black = SkyParams {
            ground: [0.0; 3],
            ..params
        };
        let without = sky.light(&black, 0.0);
        let below = luminance(
            light.ambient_irradiance(Vec3::NEG_Y) - without.ambient_irradiance(Vec3::NEG_Y),
        ) / PI;
        let off = below / luminance(mean) - 1.0;
        println!("{name}: {off:.3}");
        assert!(off.abs() < 0.15, "{name}: {off}");
    }
}

//! GPU and CPU agree, pixel by pixel, for skies of every kind.

use glam::Vec3;
use welkin_runtime::frame::Facts;
use welkin_runtime::{Camera, SkyParams};
use welkin_tests::renderer::Twin;
use welkin_tests::{compare, gpu, pack, tonemap};

const SIZE: [u32; 2] = [96, 72];

/// Name, parameters, azimuth and elevation of the camera in degrees, seconds.
fn skies() -> Vec<(&'static str, SkyParams, f32, f32, f64)> {
    let day = SkyParams::default();
    let at = |time: f32, cover: f32| SkyParams { time, cover, ..day };
    vec![
        ("figure_2", SkyParams::figure_2(), 120.0, 22.0, 40.0),
        ("figure_4", SkyParams::figure_4(), 255.0, 18.0, 0.0),
        ("noon", at(0.5, 0.6), 180.0, 40.0, 12.0),
        (
            "sunset",
            SkyParams {
                sunset: 0.7,
                ..at(0.745, 0.6)
            },
            270.0,
            12.0,
            100.0,
        ),
        ("twilight", at(0.77, 0.5), 270.0, 10.0, 3.0),
        ("night", at(0.0, 0.3), 180.0, 45.0, 21.5),
        ("clear_night_zenith", at(0.98, 0.0), 0.0, 90.0, 63.9),
        (
            "overcast",
            SkyParams {
                density: 0.5,
                ..at(0.4, 0.95)
            },
            20.0,
            30.0,
            500.0,
        ),
        (
            "dense",
            SkyParams {
                density: 1.0,
                height: 0.0,
                ..at(0.6, 0.5)
            },
            330.0,
            60.0,
            7.0,
        ),
        (
            "upper_layer",
            SkyParams {
                upper_layer: 1.0,
                sunset: 0.5,
                ..at(0.3, 0.45)
            },
            80.0,
            25.0,
            50.0,
        ),
        ("below_the_horizon", at(0.35, 0.7), 100.0, -30.0, 0.0),
        (
            "late",
            SkyParams {
                speed: 1.0,
                ..at(0.5, 0.7)
            },
            200.0,
            50.0,
            1e6,
        ),
    ]
}

fn camera(azimuth_deg: f32, elevation_deg: f32) -> Camera {
    Camera::looking(
        azimuth_deg.to_radians(),
        elevation_deg.to_radians(),
        1.05,
        SIZE,
    )
}

fn rgb(texels: &[[f32; 4]]) -> Vec<Vec3> {
    texels.iter().map(|t| Vec3::new(t[0], t[1], t[2])).collect()
}

/// What one step of the cloud texture is worth in radiance.
///
/// A texture unit may filter 8-bit texels in 8 bits (Mesa's software does; Vulkan asks for no more), which
/// makes an amount of cloud wrong by up to one step, 1/255. Opacity takes that times 1 / cover (line 17) times
/// 1 + 2 density (line 21), and the picture takes the opacity's error times the contrast of clouds, at
/// most their white.
fn cloud_step(params: &SkyParams) -> f32 {
    let facts = Facts::new(pack::default_pack()).expect("the pack has every role");
    let clouds = facts.uniforms(params, &camera(0.0, 0.0), 0.0, 0.0).clouds;
    let white = (0..3)
        .map(|c| clouds.sunlight[c] + clouds.ambient[c])
        .fold(0.0, f32::max);
    white * (1.0 + 2.0 * params.density) / params.cover.max(0.05) / 255.0
}

/// What radiance may differ by, for each expected value: the step of the clouds; 2 % for half floats
/// (2^-11), bilinear weights of 8 bits, the exponentials of a GPU (2^-11) and 8-bit filtering of galaxy and
/// sun; and the least that a half float tells in the dark.
fn allowed(params: &SkyParams) -> impl Fn(f32) -> f32 {
    let step = cloud_step(params);
    move |radiance| step + 0.02 * radiance + 1e-4
}

/// What radiance may differ by on average: rounding is off by a quarter of a step.
fn allowed_mean(params: &SkyParams) -> f32 {
    cloud_step(params) / 4.0 + 1e-4
}

#[test]
fn radiance_agrees_in_a_float_target() {
    let format = wgpu::TextureFormat::Rgba16Float;
    let mut sky = gpu::sky(pack::default_pack(), format);
    let twin = Twin::new(pack::default_pack());
    for (name, params, azimuth, elevation, seconds) in skies() {
        let camera = camera(azimuth, elevation);
        let expected = twin.render(&params, &camera, seconds);
        let actual = rgb(&gpu::render(&mut sky, format, &params, &camera, seconds));
        let difference = compare::difference(&expected, &actual, allowed(&params));
        println!("{name}: {difference:?}");
        if difference.worst > 1.0 || difference.mean > allowed_mean(&params) {
            let picture = compare::save(&format!("twins_{name}"), &expected, &actual, SIZE);
            let index = difference.pixel;
            panic!(
                "{name}: {difference:?}: {} {}; see {}",
                expected[index],
                actual[index],
                picture.display()
            );
        }
    }
}

#[test]
fn pictures_agree_in_8_bit_targets() {
    for format in [
        wgpu::TextureFormat::Rgba8UnormSrgb,
        wgpu::TextureFormat::Rgba8Unorm,
    ] {
        let mut sky = gpu::sky(pack::default_pack(), format);
        let twin = Twin::new(pack::default_pack());
        for (name, params, azimuth, elevation, seconds) in skies() {
            let (camera, params) = (
                camera(azimuth, elevation),
                SkyParams {
                    dither: false,
                    ..params
                },
            );
            let radiance = twin.render(&params, &camera, seconds);
            let expected: Vec<Vec3> = radiance
                .iter()
                .map(|&r| tonemap::to_bytes(r, params.exposure) / 255.0)
                .collect();
            let actual = rgb(&gpu::render(&mut sky, format, &params, &camera, seconds));
            // What the radiance may differ by, through tone curve and encoding, and one step: half for rounding,
            // the rest for the hardware's encoding (Vulkan allows it 0.6 in all).
            let may = allowed(&params);
            let bounds = radiance.iter().map(|&r| {
                let more = Vec3::from(r.to_array().map(&may));
                (tonemap::to_bytes(r + more, 1.0) - tonemap::to_bytes(r - more, 1.0)) / 2.0 / 255.0
                    + 1.0 / 255.0
            });
            let scaled = |picture: &[Vec3]| {
                picture
                    .iter()
                    .zip(bounds.clone())
                    .map(|(p, b)| *p / b)
                    .collect::<Vec<_>>()
            };
            let difference = compare::difference(&scaled(&expected), &scaled(&actual), |_| 1.0);
            println!("{name} {format:?}: {difference:?}");
            if difference.worst > 1.0 {
                let picture = compare::save(
                    &format!("twins_{format:?}_{name}"),
                    &expected,
                    &actual,
                    SIZE,
                );
                panic!("{name}: {difference:?}; see {}", picture.display());
            }
        }
    }
}

/// The comparison itself can fail: a sky that is only a little different is told apart.
#[test]
fn a_slightly_different_sky_is_told_apart() {
    let twin = Twin::new(pack::default_pack());
    let camera = camera(180.0, 40.0);
    let usual = SkyParams::default();
    let expected = twin.render(&usual, &camera, 0.0);
    for other in [
        SkyParams {
            cover: usual.cover + 0.02,
            ..usual
        },
        SkyParams {
            density: usual.density + 0.05,
            ..usual
        },
        SkyParams {
            height: usual.height + 0.01,
            ..usual
        },
        SkyParams {
            time: usual.time + 0.02,
            ..usual
        },
    ] {
        let difference = compare::difference(
            &expected,
            &twin.render(&other, &camera, 0.0),
            allowed(&usual),
        );
        let told = difference.worst > 1.0 || difference.mean > allowed_mean(&usual);
        assert!(told, "{other:?} passes for {usual:?}: {difference:?}");
    }
}

//! Opacity as a sky of opacity draws it: what a picture of the same parameters shows of its clouds.

use welkin_runtime::params::{SpriteParams, WeatherParams};
use welkin_runtime::{Camera, Method, Sky, SkyConfig, SkyError, SkyParams};
use welkin_tests::film::Film;
use welkin_tests::{gpu, pack};

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;

fn config(target_format: wgpu::TextureFormat) -> SkyConfig {
    SkyConfig {
        target_format,
        depth: None,
        sample_count: 1,
    }
}

fn opacity_sky() -> Sky {
    let gpu::Gpu { device, queue, .. } = gpu::gpu();
    Sky::of_opacity(device, queue, config(FORMAT), pack::default_pack()).expect("the sky is made")
}

fn opacities(sky: &mut Sky, params: &SkyParams, view: &Camera) -> Vec<f32> {
    sky.reset_history();
    let picture = gpu::render(sky, FORMAT, params, view, 20.0);
    let channels = |texel: &[f32; 4]| {
        assert!(texel[0] == texel[1] && texel[1] == texel[2] && texel[3] == 1.0);
        texel[0]
    };
    picture.iter().map(channels).collect()
}

#[test]
fn opacity_is_what_clouds_leave_of_black_and_white_behind_them() {
    let field = pack::default_pack()
        .field()
        .expect("the default pack has one");
    let (mut sky, mut film) = (opacity_sky(), Film::with_field(field));
    for method in Method::ALL {
        for (time, upper) in [(0.45, 0.0), (0.74, 0.6)] {
            let params = SkyParams {
                method,
                time,
                upper_layer: upper,
                cover: 0.5,
                // Impostors hold bytes.
                sprites: SpriteParams {
                    ring_radius_m: 0.0,
                    ..SpriteParams::default()
                },
                ..SkyParams::default()
            };
            let view = Camera {
                position_m: [300.0, 20.0, -700.0].into(),
                ..Camera::looking(2.0, 0.4, 1.2, [96, 72])
            };
            let found = opacities(&mut sky, &params, &view);
            // Two pictures of clouds of up to some 4, each a half float, whose steps there are 1/256; sprites round each of their layers.
            let wanted = film.alpha(&params, &view, 20.0);
            let layers = if method == Method::Sprites { 8.0 } else { 1.0 };
            let mut different = [0, 0];
            for (found, wanted) in found.iter().zip(&wanted) {
                assert!((0.0..=1.0).contains(found), "{method:?}: {found}");
                let apart = (found - wanted).abs();
                assert!(
                    apart < layers / 256.0,
                    "{method:?} at {time}: {found} {wanted}"
                );
                different[usize::from(*found > 0.1)] += 1;
            }
            assert!(
                different.iter().all(|count| *count > 100),
                "{method:?}: {different:?}"
            );
        }
    }
}

#[test]
fn what_is_no_cloud_is_not_in_it() {
    let mut sky = opacity_sky();
    let towards_sun = Camera::looking(std::f32::consts::PI, 0.9, 1.2, [64, 48]);
    let clear = SkyParams {
        cover: 0.0,
        flare: 1.0,
        weather: WeatherParams {
            rays: 1.0,
            rain: 1.0,
            ..WeatherParams::default()
        },
        ..SkyParams::default()
    };
    for time in [0.0, 0.5] {
        let params = SkyParams { time, ..clear };
        let found = opacities(&mut sky, &params, &towards_sun);
        assert!(found.iter().all(|opacity| *opacity == 0.0), "at {time}");
    }
    // Below the horizon there is ground.
    let down = Camera::looking(0.0, -0.9, 0.8, [16, 16]);
    let overcast = SkyParams {
        cover: 1.0,
        ..SkyParams::default()
    };
    assert!(
        opacities(&mut sky, &overcast, &down)
            .iter()
            .all(|o| *o == 0.0)
    );
}

#[test]
fn targets_that_the_hardware_encodes_are_refused() {
    let gpu::Gpu { device, queue, .. } = gpu::gpu();
    let make = |format| Sky::of_opacity(device, queue, config(format), pack::default_pack());
    for format in [
        wgpu::TextureFormat::Rgba8UnormSrgb,
        wgpu::TextureFormat::R32Uint,
    ] {
        assert!(matches!(make(format), Err(SkyError::TargetFormat { .. })));
    }
    assert!(make(wgpu::TextureFormat::Rgba8Unorm).is_ok());
}

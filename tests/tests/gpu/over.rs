//! Clouds and stars over a sky of the application's own, and targets that it exposes.

use glam::Vec3;
use welkin_runtime::{Camera, Method, PackLight, Sky, SkyConfig, SkyError, SkyParams};
use welkin_tests::{gpu, pack, renderer};

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;
/// One that every device can blend with.
const BLENDED: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
const SIZE: [u32; 2] = [96, 64];
/// What targets of tests are cleared to.
const RED: Vec3 = Vec3::X;

fn config(target_format: wgpu::TextureFormat) -> SkyConfig {
    SkyConfig {
        target_format,
        depth: None,
        sample_count: 1,
    }
}

fn camera() -> Camera {
    Camera::looking(0.7, 0.2, 1.2, SIZE)
}

/// A frame over red.
fn over(params: &SkyParams) -> Vec<Vec3> {
    let gpu::Gpu { device, queue, .. } = gpu::gpu();
    let sky = Sky::over(device, queue, config(BLENDED), pack::default_pack());
    let mut sky = sky.expect("a sky over another");
    gpu::rgb(&gpu::render(&mut sky, BLENDED, params, &camera(), 9.0))
}

#[test]
fn clouds_hide_what_is_behind_them_by_their_opacity() {
    let twin = renderer::Twin::new(pack::default_pack());
    for cover in [0.0, 0.5] {
        let params = SkyParams {
            cover,
            time: 0.42,
            ..SkyParams::default()
        };
        let frame = twin.frame(&params, &camera(), 9.0);
        let expected = frame.clouds_over(&vec![RED; (SIZE[0] * SIZE[1]) as usize]);
        let shown = over(&params);
        let off = shown.iter().zip(&expected);
        let off = off.map(|(a, b)| (*a - *b).abs().max_element());
        // Half floats, and reads that a device filters by steps.
        let mean = off.sum::<f32>() / expected.len() as f32;
        assert!(mean < 2e-3, "{cover}: {mean}");
        let hidden = expected.iter().filter(|pixel| pixel.y > 0.1).count();
        assert_eq!(hidden > expected.len() / 8, cover > 0.0, "{hidden}");
    }
}

#[test]
fn stars_are_added_and_the_ground_is_left() {
    let night = SkyParams {
        cover: 0.0,
        time: 0.0,
        moon: 0.0,
        ..SkyParams::default()
    };
    let shown = over(&night);
    assert!(
        shown
            .iter()
            .all(|pixel| (*pixel - RED).min_element() > -1e-3)
    );
    let lit = shown.iter().filter(|pixel| pixel.y > 1e-3).count();
    assert!(lit > 10, "stars: {lit}");
    let ground = &shown[(SIZE[0] * (SIZE[1] - 8)) as usize..];
    assert!(ground.iter().all(|pixel| *pixel == RED));
}

#[test]
fn a_display_target_cannot_be_laid_over() {
    let gpu::Gpu { device, queue, .. } = gpu::gpu();
    let format = wgpu::TextureFormat::Rgba8UnormSrgb;
    let refused = Sky::over(device, queue, config(format), pack::default_pack());
    assert_eq!(refused.err(), Some(SkyError::OverFormat { format }));
}

#[test]
fn a_float_target_gets_radiance_times_the_scale() {
    for method in Method::ALL {
        let params = SkyParams {
            method,
            cover: 0.5,
            time: 0.7,
            // Neither is for float targets.
            exposure: 9.0,
            exposure_ev: 2.0,
            ..SkyParams::default()
        };
        let mut sky = gpu::sky(pack::default_pack(), FORMAT);
        let sun = sky.light(&params, 9.0).sun.direction;
        let camera = Camera::looking(sun.x.atan2(-sun.z), 0.2, 1.2, SIZE);
        let mut drawn = |scale: Option<f32>| {
            if let Some(scale) = scale {
                sky.set_scale(scale);
            }
            sky.reset_history();
            gpu::rgb(&gpu::render(&mut sky, FORMAT, &params, &camera, 9.0))
        };
        let [raw, third, brighter] = [None, Some(1.0 / 3.0), Some(1e4)].map(&mut drawn);
        for ((raw, third), brighter) in raw.iter().zip(&third).zip(&brighter) {
            let off = (*third * 3.0 - *raw).abs().max_element();
            assert!(
                off < 1e-4 + 1e-3 * raw.max_element(),
                "{method:?}: {third} {raw}"
            );
            assert!(brighter.max_element() <= 65504.0, "{method:?}: {brighter}");
        }
        let nonsense = drawn(Some(f32::NAN));
        assert_eq!(nonsense, drawn(Some(1.0)), "{method:?}");
    }
}

#[test]
fn the_light_of_a_pack_is_that_of_its_sky() {
    let sky = gpu::sky(pack::default_pack(), FORMAT);
    let light = PackLight::new(pack::default_pack()).expect("light");
    for (time, cover) in [(0.5, 0.2), (0.74, 0.6), (0.0, 0.1)] {
        let params = SkyParams {
            time,
            cover,
            ..SkyParams::default()
        };
        assert_eq!(light.light(&params, 3.0), sky.light(&params, 3.0));
    }
}

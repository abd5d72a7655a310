//! GPU and CPU agree, pixel by pixel, for skies of every kind and every method.

mod skies;

use glam::Vec3;
use welkin_runtime::{Method, SkyParams};
use welkin_tests::renderer::{Frame, Twin};
use welkin_tests::{compare, gpu, pack, tonemap};

use skies::{Case, SIZE, camera, common_skies, skies, toned_skies};

/// What radiance may differ by, for each pixel and its expected value, where each read of clouds is off by up to `off`: what
/// that is worth, and what the sun's read is; 2 % for half floats (2^-11), bilinear weights of 8 bits, the exponentials of a GPU (2^-11) and
/// 8-bit filtering of the galaxy; and the least that a half float tells in the dark.
fn allowed(frame: &mut Frame, off: &[f32], expected: &[Vec3]) -> Vec<Vec3> {
    let behind = frame.behind();
    let worth = frame.worth_of_reads(off, |frame| frame.clouds_over(&behind));
    let sun = frame.worth_of_sun().into_iter();
    let others = expected.iter().zip(sun);
    let others = others.map(|(e, sun)| 0.02 * e.abs() + sun + 1e-4);
    worth.iter().zip(others).map(|(w, o)| *w + o).collect()
}

/// The same where the device's map was read: each texture unit is off by its step.
fn allowed_with_own_reads(frame: &mut Frame, expected: &[Vec3]) -> Vec<Vec3> {
    allowed(frame, &frame.filter_steps(), expected)
}

/// What a read of the twin's own map may be off by: the filter's step and what the map is off by.
fn off_with_own_map(frame: &Frame) -> Vec<f32> {
    let most: Vec<_> = frame
        .map_allowance()
        .iter()
        .map(|(most, _)| *most)
        .collect();
    let reads = frame.in_order_of_reads(&most).into_iter();
    reads.map(|bytes| (bytes + 1.0) / 255.0).collect()
}

/// The dome alone: the twin reads the map that the device has drawn.
#[test]
fn radiance_agrees_in_a_float_target() {
    let format = wgpu::TextureFormat::Rgba16Float;
    let mut sky = gpu::sky(pack::default_pack(), format);
    let twin = Twin::new(pack::default_pack());
    for case in skies() {
        let (params, name) = (&case.params, &case.name);
        let actual = gpu::rgb(&gpu::render(
            &mut sky,
            format,
            params,
            &case.camera,
            case.seconds,
        ));
        let mut frame = twin.frame_without_map(params, &case.camera, case.seconds);
        frame.map = gpu::read_map(&sky);
        let expected = frame.render();
        let bounds = allowed_with_own_reads(&mut frame, &expected);
        let difference = compare::in_bounds([&expected, &actual], &bounds);
        println!("{name}: {difference:?}");
        // Rounding is off by a quarter of a step on average.
        if difference.worst > 1.0 || difference.mean > 0.25 {
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

/// The whole path: the twin makes its own map.
#[test]
fn pictures_agree_in_8_bit_targets() {
    let formats = [
        wgpu::TextureFormat::Rgba8UnormSrgb,
        wgpu::TextureFormat::Rgba8Unorm,
    ];
    let mut targets = formats.map(|format| (format, gpu::sky(pack::default_pack(), format)));
    let twin = Twin::for_display(pack::default_pack());
    for Case {
        name,
        params,
        camera,
        seconds,
    } in common_skies().into_iter().chain(toned_skies())
    {
        let params = SkyParams {
            dither: false,
            ..params
        };
        let mut frame = twin.frame(&params, &camera, seconds);
        let radiance = frame.render();
        let off = off_with_own_map(&frame);
        let may = allowed(&mut frame, &off, &radiance);
        let bytes = |radiance: Vec3| tonemap::to_bytes(radiance, &params) / 255.0;
        let expected: Vec<Vec3> = radiance.iter().map(|&r| bytes(r)).collect();
        // What the radiance may differ by, through tone curve and encoding, and one step: half for rounding,
        // the rest for the hardware's encoding (Vulkan allows it 0.6 in all).
        let both = radiance.iter().zip(&may);
        let bounds: Vec<Vec3> = both
            .map(|(&r, &may)| (tonemap::spread(r, may, &params) + 1.0) / 255.0)
            .collect();
        for (format, sky) in &mut targets {
            let actual = gpu::rgb(&gpu::render(sky, *format, &params, &camera, seconds));
            let difference = compare::in_bounds([&expected, &actual], &bounds);
            println!("{name} {format:?}: {difference:?}");
            if difference.worst > 1.0 || difference.mean > 0.25 {
                let file = format!("twins_{format:?}_{name}");
                let picture = compare::save(&file, &expected, &actual, SIZE);
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
    for method in Method::DOMES {
        let defaults = SkyParams {
            method,
            ..SkyParams::default()
        };
        let mut frame = twin.frame(&defaults, &camera, 0.0);
        let expected = frame.render();
        let bounds = allowed_with_own_reads(&mut frame, &expected);
        for other in [
            SkyParams {
                cover: defaults.cover + 0.02,
                ..defaults
            },
            // Density only shades clouds of these methods a little more.
            SkyParams {
                density: defaults.density
                    + match method {
                        Method::Fbm => 0.3,
                        Method::Lit => 0.15,
                        _ => 0.05,
                    },
                ..defaults
            },
            SkyParams {
                height: defaults.height + 0.01,
                ..defaults
            },
            SkyParams {
                time: defaults.time + 0.02,
                ..defaults
            },
        ] {
            let changed = twin.render(&other, &camera, 0.0);
            let difference = compare::in_bounds([&expected, &changed], &bounds);
            let told = difference.worst > 1.0 || difference.mean > 0.25;
            assert!(told, "{other:?} passes for {defaults:?}: {difference:?}");
        }
    }
}

//! Vulkan and GL draw the same pictures, whatever the layers of the arrays that a method reads.
//!
//! On GL, as on WebGL2, a view is the whole texture, and wgpu tells planes, arrays and cubes apart by size alone. Without either
//! driver these tests fail: `make gpu-tools` installs both.

// There is neither.
#![cfg(not(target_os = "macos"))]

use glam::Vec3;
use welkin_pack::{LayerKind, Pack};
use welkin_runtime::params::{LitLayer, LitParams, OctaveParams};
use welkin_runtime::{Camera, Method, SkyParams};
use welkin_tests::gpu::{Gpu, rgb};
use welkin_tests::renderer::Twin;
use welkin_tests::{compare, drivers, pack};

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;
const SIZE: [u32; 2] = [96, 54];
const SECONDS: f64 = 30.0;

fn defaults(method: Method) -> SkyParams {
    SkyParams {
        method,
        flare: 0.0,
        dither: false,
        ..SkyParams::default()
    }
}

fn view() -> Camera {
    Camera::looking(1.7, 0.4, 1.05, SIZE)
}

/// Each frame by a device of each backend, the same sky for all.
fn assert_same_pictures(pack: &Pack, frames: &[(&str, SkyParams)]) {
    let gpus = [wgpu::Backends::VULKAN, wgpu::Backends::GL].map(Gpu::open);
    let mut skies = gpus.each_ref().map(|gpu| gpu.sky(pack, FORMAT));
    let twin = Twin::for_display(pack);
    let are_alike = gpus.iter().all(|gpu| gpu.is_llvmpipe);
    for (name, params) in frames {
        let picture = |i: usize| {
            let (gpu, sky) = (&gpus[i], &mut skies[i]);
            rgb(&gpu.render(sky, FORMAT, params, &view(), SECONDS))
        };
        let [vulkan, gl] = [0, 1].map(picture);
        let bounds = allowed(&twin, params, are_alike);
        let difference = compare::in_bounds([&vulkan, &gl], &bounds);
        // Rounding is off by a quarter of its step on average.
        if difference.worst > 1.0 || difference.mean > 0.25 {
            let picture = compare::save(&format!("backends_{name}"), &vulkan, &gl, SIZE);
            panic!("{name}: {difference:?}; see {}", picture.display());
        }
    }
}

/// What each pixel may differ by.
fn allowed(twin: &Twin, params: &SkyParams, are_alike: bool) -> Vec<Vec3> {
    let mut frame = twin.frame(params, &view(), SECONDS);
    if are_alike {
        return drivers::alike(&mut frame, params);
    }
    let bounds = drivers::unlike(&mut frame, params);
    if params.method != Method::Sprites {
        return bounds;
    }
    bounds
        .iter()
        .map(|bound| *bound + drivers::SPRITES)
        .collect()
}

#[test]
fn every_method_draws_the_same() {
    let mut frames: Vec<_> = Method::ALL.map(|m| (m.name(), defaults(m))).to_vec();
    let octaves = |count| SkyParams {
        octaves: OctaveParams {
            count,
            ..OctaveParams::default()
        },
        ..defaults(Method::Octaves)
    };
    // Back from six: what was made for seven layers or for two may serve again.
    frames.extend([1, 6, 7, 2].map(|count| ("octaves_in_other_numbers", octaves(count))));
    let layers = LayerKind::ALL.map(|kind| LitLayer::of(kind, 0.5)).repeat(2);
    let six = SkyParams {
        lit: LitParams::with_layers(&layers),
        ..defaults(Method::Lit)
    };
    frames.push(("lit_of_six_layers", six));
    assert_same_pictures(pack::default_pack(), &frames);
}

#[test]
fn fbm_of_one_octave_and_of_six_draws_the_same() {
    for count in [1, 6] {
        let frames = [("fbm_of_other_octaves", defaults(Method::Fbm))];
        assert_same_pictures(&pack::with_octaves(count), &frames);
    }
}

/// The comparison itself can fail: a little more cover is told apart.
#[test]
fn a_slightly_different_sky_is_told_apart() {
    let gpus = [wgpu::Backends::VULKAN, wgpu::Backends::GL].map(Gpu::open);
    let pack = pack::default_pack();
    let mut skies = gpus.each_ref().map(|gpu| gpu.sky(pack, FORMAT));
    let twin = Twin::for_display(pack);
    let are_alike = gpus.iter().all(|gpu| gpu.is_llvmpipe);
    for method in Method::ALL {
        let params = defaults(method);
        // A byte of the photo may move the edges of clouds by so much.
        let cover = params.cover + if method == Method::Octaves { 0.1 } else { 0.05 };
        let both = [params, SkyParams { cover, ..params }];
        let [vulkan, gl] = [0, 1].map(|i: usize| {
            let (gpu, sky) = (&gpus[i], &mut skies[i]);
            rgb(&gpu.render(sky, FORMAT, &both[i], &view(), SECONDS))
        });
        let bounds = allowed(&twin, &params, are_alike);
        let difference = compare::in_bounds([&vulkan, &gl], &bounds);
        assert!(difference.worst > 1.0, "{method:?}: {difference:?}");
    }
}

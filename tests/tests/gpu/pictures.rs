//! Golden pictures: each method at noon, at sunset and in a storm or, where it has a moon, by night, as the software driver drew
//! them.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::path::PathBuf;

use glam::Vec3;
use welkin_runtime::params::FbmParams;
use welkin_runtime::{Camera, Method, SkyParams};
use welkin_tests::renderer::Twin;
use welkin_tests::{compare, drivers, gpu, pack};

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;
const SIZE: [u32; 2] = [192, 108];
const SECONDS: f64 = 30.0;

/// Name, parameters, azimuth and elevation of the view in degrees.
fn pictures(method: Method) -> [(String, SkyParams, Camera); 3] {
    let defaults = SkyParams {
        method,
        flare: 0.0,
        dither: false,
        ..SkyParams::default()
    };
    let sunset = SkyParams {
        time: 0.742,
        sunset: 1.0,
        ..defaults
    };
    let storm = SkyParams {
        cover: 0.9,
        density: 0.9,
        time: 0.42,
        fbm: FbmParams::STORMY,
        ..defaults
    };
    let view = |azimuth: f32, elevation: f32| {
        Camera::looking(azimuth.to_radians(), elevation.to_radians(), 1.05, SIZE)
    };
    let name = |name: &str| format!("{}-{name}", method.name());
    let moonlit = SkyParams {
        time: 0.93,
        ..defaults
    };
    let last = match method {
        Method::Lit | Method::Sprites => (name("moonlit"), moonlit, view(120.0, 30.0)),
        _ => (name("storm"), storm, view(160.0, 25.0)),
    };
    [
        (name("noon"), defaults, view(90.0, 28.0)),
        (name("sunset"), sunset, view(270.0, 20.0)),
        last,
    ]
}

fn path(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(format!("golden/{name}.png"))
}

/// Writes what was drawn as the new golden picture.
fn bless(name: &str, texels: &[[f32; 4]]) {
    let byte = |value: f32| (value * 255.0 + 0.5) as u8;
    let [width, height] = SIZE;
    let picture = image::RgbImage::from_fn(width, height, |x, y| {
        let [r, g, b, _] = texels[(y * width + x) as usize];
        image::Rgb([r, g, b].map(byte))
    });
    picture.save(path(name)).unwrap();
}

fn golden(name: &str) -> Vec<Vec3> {
    let picture = image::open(path(name))
        .unwrap_or_else(|e| {
            panic!(
                "{}: {e}; run with WELKIN_BLESS=1 and look at it",
                path(name).display()
            )
        })
        .into_rgb8();
    assert_eq!(picture.dimensions(), (SIZE[0], SIZE[1]), "{name}");
    picture
        .pixels()
        .map(|p| Vec3::from(p.0.map(|byte| f32::from(byte) / 255.0)))
        .collect()
}

/// What the picture of another driver may differ by at each pixel.
///
/// Versions of the software driver that drew the golden pictures differ by one step of the target; a second is spare.
fn allowed(twin: &Twin, params: &SkyParams, view: &Camera) -> Vec<Vec3> {
    let [width, height] = SIZE;
    if gpu::gpu().is_llvmpipe {
        return vec![Vec3::splat(2.0 / 255.0); (width * height) as usize];
    }
    let dome = drivers::unlike(&mut twin.frame(params, view, SECONDS), params);
    let more = if params.method == Method::Sprites {
        drivers::SPRITES
    } else {
        0.0
    };
    dome.into_iter().map(|bound| bound + more).collect()
}

/// If this fails and pictures were meant to change: run with WELKIN_BLESS=1 and look at every one of them.
#[test]
fn pictures_are_the_golden_ones() {
    let twin = Twin::for_display(pack::default_pack());
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    for (name, params, view) in Method::ALL.into_iter().flat_map(pictures) {
        let texels = gpu::render(&mut sky, FORMAT, &params, &view, SECONDS);
        if std::env::var_os("WELKIN_BLESS").is_some() {
            bless(&name, &texels);
        }
        let (expected, actual) = (golden(&name), gpu::rgb(&texels));
        let bounds = allowed(&twin, &params, &view);
        let difference = compare::in_bounds([&expected, &actual], &bounds);
        println!("{name}: {difference:?}");
        // Rounding is off by a quarter of its step on average.
        if difference.worst > 1.0 || difference.mean > 0.25 {
            let picture = compare::save(&format!("pictures_{name}"), &expected, &actual, SIZE);
            panic!("{name}: {difference:?}; see {}", picture.display());
        }
    }
}

//! Cover in oktas: rendered skies show as many eighths of cloud as they were asked for.

use std::f32::consts::{FRAC_PI_2, TAU};
use std::sync::OnceLock;

use glam::Vec2;
use welkin_pack::Pack;
use welkin_runtime::oktas::{LEAST_SINE, OPAQUE};
use welkin_runtime::{Camera, Method, Oktas, Sky, SkyParams};
use welkin_tests::{gpu, pack};

/// Its opacities are within 1/2048.
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;

/// Pixels a side of the square overhead: 0.45 degrees a pixel in its middle, 0.22 at its corners and on the horizon.
const SIDE: u32 = 256;

/// How far from what was asked for the mean may be.
const BOUND_OKTAS: f32 = 0.5;

/// Moments and places of each seed. What stands over the viewer is a tile of the clouds or less, with room for some tens
/// of them, so one frame of half a sky scatters by 0.2 to 0.5 okta; ten frames (of five seeds) tell 0.5 at
/// three deviations of their mean. The tests check that they do.
const FRAMES: u32 = 2;

/// Five packs, baked once.
fn packs() -> &'static [Pack] {
    static PACKS: OnceLock<Vec<Pack>> = OnceLock::new();
    PACKS.get_or_init(|| (1..=5).map(pack::opacity_alone).collect())
}

/// Clouds without light, and nothing else.
fn black(method: Method) -> SkyParams {
    SkyParams {
        method,
        time: 0.0,
        sun: false,
        stars: false,
        flare: 0.0,
        ..SkyParams::default()
    }
}

/// The upper half of a cube around the viewer: a square overhead and four half squares on the horizon.
fn faces() -> [Camera; 5] {
    [0, 1, 2, 3, 4].map(|face| match face {
        4 => Camera::looking(0.0, FRAC_PI_2, FRAC_PI_2, [SIDE, SIDE]),
        _ => Camera {
            lens_shift: Vec2::Y,
            ..Camera::looking(
                face as f32 * FRAC_PI_2,
                0.0,
                2.0 * 0.5_f32.atan(),
                [SIDE, SIDE / 2],
            )
        },
    })
}

/// Sine of the elevation of each pixel, row by row, and its solid angle.
fn pixels(camera: &Camera) -> impl Iterator<Item = (f32, f32)> {
    let (rays, [width, height]) = (camera.rays(), camera.viewport_px);
    let area = 4.0 * rays.right.length() * rays.up.length() / (width * height) as f32;
    (0..width * height).map(move |i| {
        let x = ((i % width) as f32 + 0.5) / width as f32 * 2.0 - 1.0;
        let y = 1.0 - ((i / width) as f32 + 0.5) / height as f32 * 2.0;
        let ray = rays.forward + rays.right * x + rays.up * y;
        (ray.y / ray.length(), area / ray.length().powi(3))
    })
}

/// Oktas of one rendered sky.
fn seen(sky: &mut Sky, params: &SkyParams, frame: u32) -> f32 {
    let (mut covered, mut whole) = (0.0_f64, 0.0_f64);
    for mut camera in faces() {
        // Another part of the tile, and other states of the octaves.
        camera.position_m = [3_170.0 * frame as f32, 0.0, 7_430.0 * frame as f32].into();
        let picture = gpu::render(sky, FORMAT, params, &camera, 1_000.0 * f64::from(frame));
        for (texel, (sine, angle)) in picture.iter().zip(pixels(&camera)) {
            if sine > LEAST_SINE {
                whole += f64::from(angle);
                // Black clouds before white.
                if 1.0 - texel[1] > OPAQUE {
                    covered += f64::from(angle);
                }
            }
        }
    }
    let exact = f64::from(TAU * (1.0 - LEAST_SINE));
    // A row of pixels is on one side of the bound or on the other: half a row of 0.22 degrees is 0.0023 of the sky.
    assert!((whole / exact - 1.0).abs() < 0.003, "{whole} of {exact}");
    (8.0 * covered / whole) as f32
}

/// A sky with its calibration.
type Calibrated = (Sky, Oktas);

/// Frames of every seed's sky, calibrated for so many oktas.
fn sample(skies: &mut [Calibrated], params: &SkyParams, oktas: f32, frames: u32) -> Vec<f32> {
    let mut sample = Vec::new();
    for (sky, calibration) in skies {
        let cover = calibration.cover(params, oktas);
        let params = SkyParams { cover, ..*params };
        sample.extend((0..frames).map(|frame| seen(sky, &params, frame)));
    }
    sample
}

fn skies() -> Vec<Calibrated> {
    let calibrated = |pack| {
        let calibration = Oktas::new(pack).expect("the pack has every role");
        (gpu::sky(pack, FORMAT), calibration)
    };
    packs().iter().map(calibrated).collect()
}

/// The mean of ten frames is what was asked for, and ten are enough to say so.
fn assert_shows(name: &str, skies: &mut [Calibrated], params: &SkyParams, oktas: f32) {
    let sample = sample(skies, params, oktas, FRAMES);
    let count = sample.len() as f32;
    let mean = sample.iter().sum::<f32>() / count;
    let square = sample.iter().map(|v| (v - mean) * (v - mean)).sum::<f32>();
    let scatter = (square / (count - 1.0)).sqrt();
    assert!(
        3.0 * scatter / count.sqrt() < BOUND_OKTAS,
        "{name}, {oktas} oktas: one frame scatters by {scatter}"
    );
    assert!(
        (mean - oktas).abs() < BOUND_OKTAS,
        "{name}, {oktas} oktas: {mean} in the mean, one frame scatters by {scatter}"
    );
}

fn assert_all_nine(method: Method) {
    let (params, mut skies) = (black(method), skies());
    for end in [0.0, 8.0] {
        let sample = sample(&mut skies, &params, end, 1);
        assert_eq!(sample, [end; 5], "{}: all or nothing", method.name());
    }
    for oktas in 1..=7 {
        assert_shows(method.name(), &mut skies, &params, oktas as f32);
    }
}

#[test]
fn packed_shows_the_oktas_that_it_is_asked_for() {
    assert_all_nine(Method::Packed);
}

#[test]
fn octaves_shows_the_oktas_that_it_is_asked_for() {
    assert_all_nine(Method::Octaves);
}

#[test]
fn fbm_shows_the_oktas_that_it_is_asked_for() {
    assert_all_nine(Method::Fbm);
}

#[test]
fn so_they_do_with_other_parameters() {
    let with = |method: Method, change: &dyn Fn(&mut SkyParams)| {
        let mut params = black(method);
        change(&mut params);
        params
    };
    let cases = [
        ("packed, thick", with(Method::Packed, &|p| p.density = 1.0)),
        (
            "octaves, one dome",
            with(Method::Octaves, &|p| p.octaves.domes = [1.0, 0.0, 0.0]),
        ),
        (
            "octaves, sharp and thick",
            with(Method::Octaves, &|p| {
                p.octaves.sharpness = 0.1;
                p.density = 1.0;
            }),
        ),
        (
            "octaves, one",
            with(Method::Octaves, &|p| p.octaves.count = 1),
        ),
        ("fbm, soft", with(Method::Fbm, &|p| p.fbm.sharpness = 0.0)),
        ("fbm, sharp", with(Method::Fbm, &|p| p.fbm.sharpness = 1.0)),
    ];
    let mut skies = skies();
    for (name, params) in cases {
        assert_shows(name, &mut skies, &params, 4.0);
    }
}

#[test]
fn more_oktas_take_more_cover_and_the_calculation_goes_both_ways() {
    let calibration = Oktas::new(pack::default_pack()).expect("the pack has every role");
    for method in Method::ALL {
        let params = black(method);
        let mut last = -1.0;
        for half in 0..=16 {
            let oktas = half as f32 / 2.0;
            let cover = calibration.cover(&params, oktas);
            let back = calibration.shown(&SkyParams { cover, ..params });
            // The domes of octaves are averaged over 64 thicknesses, so the sky grows by steps of an eighth of an okta at most.
            assert!((back - oktas).abs() < 0.07, "{method:?} {oktas}: {back}");
            assert!(cover > last, "{method:?} {oktas}: {cover} after {last}");
            last = cover;
        }
        assert_eq!(calibration.cover(&params, -1.0), 0.0);
        assert_eq!(calibration.cover(&params, f32::INFINITY), 1.0);
        assert_eq!(calibration.cover(&params, f32::NAN), params.cover);
    }
}

#[test]
fn what_cannot_be_shown_is_shown_as_far_as_it_can() {
    let calibration = Oktas::new(pack::default_pack()).expect("the pack has every role");
    let mut without_domes = black(Method::Octaves);
    without_domes.octaves.domes = [0.0; 3];
    assert_eq!(calibration.cover(&without_domes, 4.0), 1.0);
    assert_eq!(calibration.shown(&without_domes), 0.0);
    let veiled = SkyParams {
        upper_layer: 1.0,
        cover: 0.0,
        ..black(Method::Packed)
    };
    assert_eq!(calibration.cover(&veiled, 0.5), 0.0);
    assert!(calibration.shown(&veiled) > 0.5);
}

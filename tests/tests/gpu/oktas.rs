//! Cover in oktas: rendered skies show as many eighths of cloud as they were asked for.

use std::f32::consts::{FRAC_PI_2, TAU};
use std::sync::OnceLock;

use glam::Vec2;
use welkin_pack::{LayerKind, Pack};
use welkin_runtime::internals::clouds::shared::OPAQUE;
use welkin_runtime::internals::oktas::LEAST_SINE;
use welkin_runtime::params::{LitLayer, LitParams};
use welkin_runtime::{Camera, Method, Oktas, Sky, SkyParams};
use welkin_tests::{gpu, pack};

/// Its opacities are within 1/2048.
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;

/// Pixels a side of the square overhead: 0.45 degrees a pixel in its middle, 0.22 at its corners and on the horizon.
const SIDE: u32 = 256;

/// How far from what was asked for the mean may be.
const BOUND_OKTAS: f32 = 0.5;

/// Moments and places of each seed, at most. What stands over the viewer is a tile of the clouds or less, with room for some tens
/// of them, so one frame of half a sky scatters by 0.2 to 0.8 okta, most where a photo gathers clouds; five to twenty-five frames (of five
/// seeds) tell 0.5 at three deviations of their mean. There are as many as it takes.
const MOST_FRAMES: u32 = 5;

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

/// How a number of oktas is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
enum By {
    /// The cover that the calibration finds.
    Calibration,
    /// The cover that is its share of the sky.
    Share,
}

/// A frame of every seed's sky that is asked for so many oktas, each of another moment and place.
fn sample(
    skies: &mut [Calibrated],
    params: &SkyParams,
    by: By,
    oktas: f32,
    frame: u32,
) -> Vec<f32> {
    let count = skies.len() as u32;
    let each = (0..).zip(skies).map(|(seed, (sky, calibration))| {
        let cover = match by {
            By::Calibration => calibration.cover(params, oktas),
            By::Share => oktas / 8.0,
        };
        seen(sky, &SkyParams { cover, ..*params }, frame * count + seed)
    });
    each.collect()
}

/// Mean of a sample, and the deviation of one of it.
fn mean_and_scatter(sample: &[f32]) -> (f32, f32) {
    let count = sample.len() as f32;
    let mean = sample.iter().sum::<f32>() / count;
    let square = sample.iter().map(|v| (v - mean) * (v - mean)).sum::<f32>();
    (mean, (square / (count - 1.0)).sqrt())
}

fn skies() -> Vec<Calibrated> {
    let calibrated = |pack| {
        let calibration = Oktas::new(pack).expect("the pack has every role");
        (gpu::sky(pack, FORMAT), calibration)
    };
    packs().iter().map(calibrated).collect()
}

/// The mean of the frames is what was asked for, and they are enough to say so.
fn assert_shows(name: &str, skies: &mut [Calibrated], params: &SkyParams, by: By, oktas: f32) {
    let mut frames = Vec::new();
    for frame in 0..MOST_FRAMES {
        frames.extend(sample(skies, params, by, oktas, frame));
        let (mean, scatter) = mean_and_scatter(&frames);
        let told = 3.0 * scatter / (frames.len() as f32).sqrt();
        if told < BOUND_OKTAS {
            assert!(
                (mean - oktas).abs() < BOUND_OKTAS,
                "{name}, {oktas} oktas: {mean} in the mean, one frame scatters by {scatter}"
            );
            return;
        }
    }
    panic!("{name}, {oktas} oktas: {frames:?} are too few to tell half an okta");
}

fn assert_all_nine(name: &str, params: &SkyParams, by: By) {
    let mut skies = skies();
    for end in [0.0, 8.0] {
        let sample = sample(&mut skies, params, by, end, 0);
        assert_eq!(sample, [end; 5], "{name}: all or nothing");
    }
    for oktas in 1..=7 {
        assert_shows(name, &mut skies, params, by, oktas as f32);
    }
}

fn assert_calibrated(method: Method) {
    assert_all_nine(method.name(), &black(method), By::Calibration);
}

#[test]
fn packed_shows_the_oktas_that_it_is_asked_for() {
    assert_calibrated(Method::Packed);
}

#[test]
fn octaves_shows_the_oktas_that_it_is_asked_for() {
    assert_calibrated(Method::Octaves);
}

#[test]
fn fbm_shows_the_oktas_that_it_is_asked_for() {
    assert_calibrated(Method::Fbm);
}

/// With the cover that is the share it shows all nine; the calibration makes hardly another cover of it.
#[test]
fn lit_shows_the_oktas_that_it_is_asked_for() {
    let (params, mut skies) = (black(Method::Lit), skies());
    assert_shows("lit", &mut skies, &params, By::Calibration, 4.0);
    for (_, calibration) in &skies {
        for oktas in 0..=8 {
            let oktas = oktas as f32;
            let cover = calibration.cover(&params, oktas);
            assert!((8.0 * cover - oktas).abs() < 0.25, "{oktas} oktas: {cover}");
        }
    }
}

/// Without any calibration, since the bake has stored the inverse distribution.
#[test]
fn the_cover_of_lit_is_the_share_of_covered_sky_with_three_layers() {
    assert_all_nine("lit, three layers", &black(Method::Lit), By::Share);
}

#[test]
fn the_cover_of_lit_is_the_share_of_covered_sky_with_one_layer() {
    assert_all_nine(
        "lit, one layer",
        &one_layer(LayerKind::Stratocumulus),
        By::Share,
    );
}

/// One layer of clouds without light.
fn one_layer(kind: LayerKind) -> SkyParams {
    SkyParams {
        lit: LitParams::with_layers(&[LitLayer::of(kind, 1.0)]),
        ..black(Method::Lit)
    }
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
        ("lit, cumulus", one_layer(LayerKind::Cumulus)),
        ("lit, cirrus", one_layer(LayerKind::Cirrus)),
        (
            "lit, six layers",
            with(Method::Lit, &|p| {
                p.lit.layers =
                    [0, 1, 2, 0, 1, 2].map(|kind| LitLayer::of(LayerKind::ALL[kind], 0.5));
            }),
        ),
    ];
    let mut skies = skies();
    for (name, params) in cases {
        assert_shows(name, &mut skies, &params, By::Calibration, 4.0);
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

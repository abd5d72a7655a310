//! GPU and CPU agree, pixel by pixel, for skies of every kind and every method.

use glam::Vec3;
use welkin_runtime::{
    Camera, FbmParams, Method, OctaveParams, PerezParams, PerezShape, SkyModel, SkyParams,
};
use welkin_tests::clouds::MOST_READS;
use welkin_tests::renderer::{FILTER_STEP, Frame, Twin};
use welkin_tests::{compare, gpu, pack, tonemap};

const SIZE: [u32; 2] = [96, 72];

/// A sky to compare.
struct Case {
    name: String,
    params: SkyParams,
    camera: Camera,
    seconds: f64,
}

/// Azimuth and elevation of the camera are in degrees.
fn case(name: &str, params: SkyParams, azimuth: f32, elevation: f32, seconds: f64) -> Case {
    Case {
        name: format!("{}_{name}", params.method.name()),
        params: SkyParams {
            flare: 0.0,
            ..params
        },
        camera: camera(azimuth, elevation),
        seconds,
    }
}

fn camera(azimuth_deg: f32, elevation_deg: f32) -> Camera {
    Camera::looking(
        azimuth_deg.to_radians(),
        elevation_deg.to_radians(),
        1.05,
        SIZE,
    )
}

/// Skies that every method draws.
fn shared_skies(method: Method) -> Vec<Case> {
    let day = SkyParams {
        method,
        ..SkyParams::default()
    };
    let at = |time: f32, cover: f32| SkyParams { time, cover, ..day };
    let sunset = SkyParams {
        sunset: 0.7,
        ..at(0.745, 0.6)
    };
    let overcast = SkyParams {
        density: 0.5,
        ..at(0.4, 0.95)
    };
    let late = SkyParams {
        speed: 1.0,
        ..at(0.5, 0.7)
    };
    let mut walked = case("walked", at(0.45, 0.5), 60.0, 50.0, 30.0);
    walked.camera.position_m = Vec3::new(2750.0, 120.0, -1300.0);
    vec![
        case("noon", at(0.5, 0.6), 180.0, 40.0, 12.0),
        case("sunset", sunset, 270.0, 12.0, 100.0),
        case("twilight", at(0.77, 0.5), 270.0, 10.0, 3.0),
        case("night", at(0.0, 0.3), 180.0, 45.0, 21.5),
        case("overcast", overcast, 20.0, 30.0, 500.0),
        case("shut", at(0.55, 1.0), 140.0, 15.0, 45.0),
        case("below_the_horizon", at(0.35, 0.7), 100.0, -30.0, 0.0),
        case("zenith", at(0.6, 0.5), 0.0, 90.0, 63.9),
        case("late", late, 200.0, 50.0, 1e6),
        walked,
    ]
}

fn packed_skies() -> Vec<Case> {
    let day = SkyParams::default();
    let dense = SkyParams {
        density: 1.0,
        height: 0.0,
        time: 0.6,
        cover: 0.5,
        ..day
    };
    let upper_layer = SkyParams {
        upper_layer: 1.0,
        sunset: 0.5,
        time: 0.3,
        cover: 0.45,
        ..day
    };
    let clear_night = SkyParams {
        time: 0.98,
        cover: 0.0,
        ..day
    };
    vec![
        case("figure_2", SkyParams::figure_2(), 120.0, 22.0, 40.0),
        case("figure_4", SkyParams::figure_4(), 255.0, 18.0, 0.0),
        case("dense", dense, 330.0, 60.0, 7.0),
        case("upper_layer", upper_layer, 80.0, 25.0, 50.0),
        case("clear_night_zenith", clear_night, 0.0, 90.0, 63.9),
    ]
}

fn octave_skies() -> Vec<Case> {
    let day = SkyParams {
        method: Method::Octaves,
        ..SkyParams::default()
    };
    let with = |octaves: OctaveParams| SkyParams { octaves, ..day };
    let usual = OctaveParams::default();
    let storm = SkyParams {
        cover: 0.9,
        density: 0.9,
        time: 0.42,
        ..day
    };
    let dome = |index: usize| {
        let mut domes = [0.0; 3];
        domes[index] = 1.0;
        with(OctaveParams { domes, ..usual })
    };
    let sharp = with(OctaveParams {
        sharpness: 0.1,
        ..usual
    });
    let six = with(OctaveParams { count: 6, ..usual });
    vec![
        case("storm", storm, 160.0, 25.0, 70.0),
        case("low", dome(0), 90.0, 35.0, 8.0),
        case("middle", dome(1), 300.0, 35.0, 8.0),
        case("high", dome(2), 10.0, 35.0, 8.0),
        case("sharp", sharp, 240.0, 50.0, 59.99),
        case("six_octaves", six, 330.0, 40.0, 33.0),
    ]
}

fn fbm_skies() -> Vec<Case> {
    let day = SkyParams {
        method: Method::Fbm,
        ..SkyParams::default()
    };
    let storm = SkyParams {
        cover: 0.9,
        density: 0.9,
        time: 0.42,
        fbm: FbmParams::STORMY,
        ..day
    };
    let sharpness = |sharpness: f32| SkyParams {
        fbm: FbmParams {
            sharpness,
            lit: [1.0, 0.9, 0.6],
            shaded: [0.2, 0.4, 0.7],
        },
        ..day
    };
    vec![
        case("storm", storm, 160.0, 25.0, 70.0),
        case("soft", sharpness(0.0), 90.0, 35.0, 8.0),
        case("sharp", sharpness(0.8), 300.0, 35.0, 1234.5),
    ]
}

/// Skies of the other model, before the clouds of a method each.
fn perez_skies() -> Vec<Case> {
    let of = |shape: PerezShape, turbidity: f32, time: f32| SkyParams {
        sky: SkyModel::Perez,
        perez: PerezParams { shape, turbidity },
        time,
        cover: 0.3,
        ..SkyParams::default()
    };
    let preetham = |turbidity: f32, time: f32| of(PerezShape::Preetham, turbidity, time);
    let cie = |number: u8, time: f32| of(PerezShape::Cie(number), 2.5, time);
    let custom = PerezShape::Custom([2.0, -0.3, 20.0, -4.0, 1.0]);
    let with = |method: Method, params: SkyParams| SkyParams { method, ..params };
    let mut shut = preetham(2.5, 0.4);
    shut.cover = 1.0;
    vec![
        case("perez_noon", preetham(2.5, 0.5), 180.0, 40.0, 12.0),
        case("perez_clear", preetham(1.7, 0.4), 300.0, 30.0, 1.0),
        case(
            "perez_haze",
            with(Method::Fbm, preetham(8.0, 0.7)),
            250.0,
            15.0,
            3.0,
        ),
        case("perez_sunset", preetham(3.0, 0.749), 270.0, 12.0, 5.0),
        case(
            "perez_twilight",
            with(Method::Octaves, preetham(2.5, 0.757)),
            270.0,
            15.0,
            5.0,
        ),
        case("perez_night", preetham(2.5, 0.0), 180.0, 45.0, 21.5),
        case("perez_overcast", cie(1, 0.4), 20.0, 60.0, 0.0),
        case("perez_blue", cie(12, 0.3), 90.0, 20.0, 0.0),
        case("perez_turbid", cie(15, 0.6), 200.0, -10.0, 0.0),
        case("perez_custom", of(custom, 5.0, 0.55), 0.0, 90.0, 0.0),
        case("perez_shut", shut, 140.0, 10.0, 0.0),
    ]
}

fn skies() -> Vec<Case> {
    let own = [packed_skies(), octave_skies(), fbm_skies(), perez_skies()];
    let shared = Method::ALL.map(shared_skies);
    shared.into_iter().chain(own).flatten().collect()
}

/// What radiance may differ by, for each pixel and its expected value, where each read of clouds is off by up to `off`: what
/// that is worth; 2 % for half floats (2^-11), bilinear weights of 8 bits, the exponentials of a GPU (2^-11) and
/// 8-bit filtering of galaxy and sun; and the least that a half float tells in the dark.
fn allowed(frame: &mut Frame, off: [f32; MOST_READS], expected: &[Vec3]) -> Vec<Vec3> {
    let worth = frame.worth_of_reads(off, Frame::render);
    let others = expected.iter().map(|e| 0.02 * e.abs() + 1e-4);
    worth.iter().zip(others).map(|(w, o)| *w + o).collect()
}

/// What a read of the twin's own map may be off by: the filter's step and what the map is off by.
fn off_with_own_map(frame: &Frame) -> [f32; MOST_READS] {
    let (most, _) = frame.map_allowance();
    frame
        .in_order_of_reads(most)
        .map(|bytes| (bytes + 1.0) / 255.0)
}

/// Expected and actual in units of what each pixel may differ by.
fn in_bounds(pictures: [&[Vec3]; 2], bounds: &[Vec3]) -> compare::Difference {
    let [expected, actual] = pictures.map(|picture| {
        picture
            .iter()
            .zip(bounds)
            .map(|(p, b)| *p / *b)
            .collect::<Vec<_>>()
    });
    compare::difference(&expected, &actual, |_| 1.0)
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
        let bounds = allowed(&mut frame, FILTER_STEP, &expected);
        let difference = in_bounds([&expected, &actual], &bounds);
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
    let twin = Twin::new(pack::default_pack());
    for Case {
        name,
        params,
        camera,
        seconds,
    } in skies()
    {
        let params = SkyParams {
            dither: false,
            ..params
        };
        let mut frame = twin.frame(&params, &camera, seconds);
        let radiance = frame.render();
        let off = off_with_own_map(&frame);
        let may = allowed(&mut frame, off, &radiance);
        let bytes = |radiance: Vec3| tonemap::to_bytes(radiance, params.exposure) / 255.0;
        let expected: Vec<Vec3> = radiance.iter().map(|&r| bytes(r)).collect();
        // What the radiance may differ by, through tone curve and encoding, and one step: half for rounding,
        // the rest for the hardware's encoding (Vulkan allows it 0.6 in all).
        let bound = |r: Vec3, may: Vec3| {
            let (less, here, more) = (bytes(r - may), bytes(r), bytes(r + may));
            (here - less).max(more - here) + 1.0 / 255.0
        };
        let bounds: Vec<Vec3> = radiance
            .iter()
            .zip(&may)
            .map(|(&r, &may)| bound(r, may))
            .collect();
        for (format, sky) in &mut targets {
            let actual = gpu::rgb(&gpu::render(sky, *format, &params, &camera, seconds));
            let difference = in_bounds([&expected, &actual], &bounds);
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
    for method in Method::ALL {
        let usual = SkyParams {
            method,
            ..SkyParams::default()
        };
        let mut frame = twin.frame(&usual, &camera, 0.0);
        let expected = frame.render();
        let bounds = allowed(&mut frame, FILTER_STEP, &expected);
        for other in [
            SkyParams {
                cover: usual.cover + 0.02,
                ..usual
            },
            // Density only shades clouds of this method a little more.
            SkyParams {
                density: usual.density + if method == Method::Fbm { 0.3 } else { 0.05 },
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
            let changed = twin.render(&other, &camera, 0.0);
            let difference = in_bounds([&expected, &changed], &bounds);
            let told = difference.worst > 1.0 || difference.mean > 0.25;
            assert!(told, "{other:?} passes for {usual:?}: {difference:?}");
        }
    }
}

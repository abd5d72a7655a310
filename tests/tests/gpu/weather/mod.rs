//! Rays, rain and lightning over the clouds of every method: there when they are asked for, and nowhere else.

mod lightning;
mod rain;
mod rays;

use std::f32::consts::{FRAC_PI_2, PI};

use glam::Vec3;
use welkin_runtime::params::{Lightning, SkyModel, WeatherParams};
use welkin_runtime::{Camera, DepthConfig, Method, Sky, SkyConfig, SkyParams};
use welkin_tests::renderer::{Frame, Twin};
use welkin_tests::{compare, gpu, pack};

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
const SIZE: [u32; 2] = [96, 72];

/// An afternoon with clouds.
fn params(method: Method) -> SkyParams {
    SkyParams {
        method,
        cover: 0.6,
        time: 0.68,
        flare: 0.0,
        ..SkyParams::default()
    }
}

fn with(params: SkyParams, change: impl Fn(&mut WeatherParams)) -> SkyParams {
    let mut params = params;
    change(&mut params.weather);
    params
}

/// A flash a kilometre to the east and two to the south that begins at 20 s.
fn flash() -> Lightning {
    Lightning {
        strength: 1.0,
        start_s: 20.0,
        place_m: [1000.0, 2000.0],
    }
}

/// The second at which it is bright.
const BRIGHT_S: f64 = 20.01;

/// A view of the afternoon's sun.
fn view() -> Camera {
    Camera::looking(4.0, 0.45, 1.0, SIZE)
}

fn drawn(sky: &mut Sky, params: &SkyParams, view: &Camera, seconds: f64) -> Vec<Vec3> {
    gpu::rgb(&gpu::render(sky, FORMAT, params, view, seconds))
}

/// Every kind of weather at once.
fn all_weather(params: SkyParams) -> SkyParams {
    with(params, |w| {
        (w.rays, w.rain, w.lightning) = (1.0, 1.0, flash());
    })
}

/// No pixel is off by more than its bound, and on average they are off by no more than this share of theirs.
fn assert_near(name: &str, expected: &[Vec3], actual: &[Vec3], bounds: &[Vec3], mean: f32) {
    let ratio = |picture: &[Vec3]| -> Vec<Vec3> {
        picture.iter().zip(bounds).map(|(p, b)| *p / *b).collect()
    };
    let difference = compare::difference(&ratio(expected), &ratio(actual), |_| 1.0);
    if difference.worst > 1.0 || difference.mean > mean {
        let picture = compare::save(&format!("weather_{name}"), expected, actual, SIZE);
        let at = difference.pixel;
        panic!(
            "{name}: {difference:?}: {} {} may differ by {}; see {}",
            expected[at],
            actual[at],
            bounds[at],
            picture.display()
        );
    }
}

/// What an overlay makes of a picture, and its bounds: an opacity that is `off` moves the picture on its way to the colours of
/// the overlay; half floats, twice.
fn overlaid(
    frame: &Frame,
    without: &[Vec3],
    overlay: impl Fn(Vec3) -> (Vec3, f32),
    colours: [Vec3; 2],
    off: f32,
) -> [Vec<Vec3>; 2] {
    let bound = |behind: &Vec3| {
        let [a, b] = colours.map(|colour| off * (colour - *behind).abs());
        a.max(b) + 0.002 * behind.abs() + 1e-4
    };
    let bounds = without.iter().map(bound).collect();
    [frame.under(without, overlay), bounds]
}

#[test]
fn what_is_off_changes_nothing() {
    for method in Method::DOMES {
        let (mut sky, mut other) = (
            gpu::sky(pack::default_pack(), FORMAT),
            gpu::sky(pack::default_pack(), FORMAT),
        );
        let defaults = params(method);
        let expected = drawn(&mut sky, &defaults, &view(), 30.0);
        // After all of it was shown once, and is off again.
        let all = drawn(&mut other, &all_weather(defaults), &view(), BRIGHT_S);
        assert_ne!(all, expected);
        assert_eq!(
            drawn(&mut other, &defaults, &view(), 30.0),
            expected,
            "{method:?}"
        );
        let before_and_after = with(defaults, |w| w.lightning = flash());
        for seconds in [19.999, 21.0, 1e6, -1e6] {
            let without = drawn(&mut sky, &defaults, &view(), seconds);
            assert_eq!(
                drawn(&mut other, &before_and_after, &view(), seconds),
                without
            );
        }
        // Rays need a sun: not at night, not in the back of the viewer.
        let night = SkyParams {
            time: 0.95,
            ..defaults
        };
        let rays = with(night, |w| w.rays = 1.0);
        assert_eq!(
            drawn(&mut other, &rays, &view(), 5.0),
            drawn(&mut sky, &night, &view(), 5.0)
        );
        let away = Camera::looking(4.0 + PI, 0.3, 1.0, SIZE);
        let rays = with(defaults, |w| w.rays = 1.0);
        assert_eq!(
            drawn(&mut other, &rays, &away, 5.0),
            drawn(&mut sky, &defaults, &away, 5.0)
        );
        // And clouds.
        let clear = SkyParams {
            cover: 0.0,
            ..defaults
        };
        let rays = with(clear, |w| w.rays = 1.0);
        let (none, some) = (
            drawn(&mut sky, &clear, &view(), 5.0),
            drawn(&mut other, &rays, &view(), 5.0),
        );
        assert_eq!(some, none, "{method:?}: a clear sky has no rays");
    }
}

#[test]
fn a_frame_depends_on_its_own_second_alone() {
    for method in Method::DOMES {
        let params = all_weather(params(method));
        let mut old = gpu::sky(pack::default_pack(), FORMAT);
        for seconds in [0.0, 20.1, 1e6, 3.0] {
            drawn(&mut old, &params, &view(), seconds);
        }
        let mut new = gpu::sky(pack::default_pack(), FORMAT);
        let expected = drawn(&mut new, &params, &view(), BRIGHT_S);
        assert_eq!(
            drawn(&mut old, &params, &view(), BRIGHT_S),
            expected,
            "{method:?}"
        );
    }
}

#[test]
fn no_weather_makes_a_pixel_that_is_no_light() {
    let overhead = pack::changed_pack(Some(FRAC_PI_2), |_, _| {});
    for (pack, times) in [
        (
            pack::default_pack(),
            vec![0.0, 0.24, 0.25, 0.252, 0.5, 0.748],
        ),
        (&overhead, vec![0.5]),
    ] {
        for method in Method::DOMES {
            let mut sky = gpu::sky(pack, FORMAT);
            for elevation in [FRAC_PI_2, -FRAC_PI_2, 0.0] {
                for &time in &times {
                    // The middle pixel of an odd size looks exactly along the axis.
                    let view = Camera::looking(0.0, elevation, 1.5, [65, 49]);
                    let params = all_weather(SkyParams {
                        time,
                        sunset: 1.0,
                        speed: 1.0,
                        ..params(method)
                    });
                    for texel in gpu::render(&mut sky, FORMAT, &params, &view, BRIGHT_S) {
                        let sound =
                            texel.iter().all(|c| c.is_finite() && *c >= 0.0) && texel[3] == 1.0;
                        assert!(sound, "{method:?} at {time}, {elevation}: {texel:?}");
                    }
                }
            }
        }
    }
}

/// With depth and four samples, reversed, into an encoded target: pipelines fit their pass.
#[test]
fn weather_is_drawn_into_any_pass_that_the_sky_is_drawn_into() {
    let gpu::Gpu { device, queue, .. } = gpu::gpu();
    for (target_format, reversed, sample_count) in [
        (wgpu::TextureFormat::Rgba8UnormSrgb, true, 4),
        (wgpu::TextureFormat::Rgba8Unorm, false, 1),
    ] {
        let format = wgpu::TextureFormat::Depth32Float;
        let config = SkyConfig {
            target_format,
            depth: Some(DepthConfig { format, reversed }),
            sample_count,
        };
        let mut sky =
            Sky::with_dome_mesh(device, queue, config, pack::default_pack(), 5.0).expect("a sky");
        let target = gpu::target(target_format, SIZE, 1);
        let samples = (sample_count > 1).then(|| gpu::target(target_format, SIZE, sample_count));
        let depth = gpu::target(format, SIZE, sample_count);
        let clear = if reversed { 0.0 } else { 1.0 };
        for method in Method::DOMES {
            for model in SkyModel::ALL {
                let mut picture = |params: SkyParams| {
                    let params = SkyParams {
                        sky: model,
                        flare: 1.0,
                        ..params
                    };
                    gpu::prepare(&mut sky, &params, &view(), BRIGHT_S);
                    gpu::pass(&target, samples.as_ref(), Some((&depth, clear)), |pass| {
                        sky.draw(pass)
                    });
                    gpu::read(&target)
                };
                let defaults = picture(params(method));
                assert_ne!(
                    picture(all_weather(params(method))),
                    defaults,
                    "{method:?} {model:?}"
                );
                assert_eq!(picture(params(method)), defaults, "{method:?} {model:?}");
            }
        }
    }
}

/// Targets of 32-bit floats cannot be blended with: rays and streaks are left out, haze and lightning are there.
#[test]
fn a_target_that_cannot_be_blended_with_shows_what_needs_no_blending() {
    let gpu::Gpu { device, queue, .. } = gpu::gpu();
    let format = wgpu::TextureFormat::Rgba32Float;
    let config = SkyConfig {
        target_format: format,
        depth: None,
        sample_count: 1,
    };
    let Ok(mut sky) = Sky::new(device, queue, config, pack::default_pack()) else {
        panic!("the sky can be drawn to 32-bit floats");
    };
    let mut picture = |params: &SkyParams| {
        let target = gpu::target(format, SIZE, 1);
        gpu::prepare(&mut sky, params, &view(), BRIGHT_S);
        gpu::pass(&target, None, None, |pass| sky.draw(pass));
        gpu::read(&target)
    };
    let defaults = params(Method::Packed);
    let without = picture(&defaults);
    assert_eq!(picture(&with(defaults, |w| w.rays = 1.0)), without);
    let rain = with(defaults, |w| w.rain = 1.0);
    let twin = Twin::new(pack::default_pack());
    let frame = twin.frame_without_map(&rain, &view(), BRIGHT_S);
    let hazed = frame.rained_on(&gpu::rgb(&without));
    let bounds: Vec<Vec3> = hazed.iter().map(|h| 1e-6 * h.abs() + 1e-4).collect();
    assert_near("haze", &hazed, &gpu::rgb(&picture(&rain)), &bounds, 0.1);
    assert_ne!(
        picture(&with(defaults, |w| w.lightning = Lightning {
            place_m: [-900.0, 600.0],
            ..flash()
        })),
        without
    );
}

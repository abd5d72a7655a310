//! Rain: that it falls, and that the shader computes what its twin does.

use std::f32::consts::FRAC_PI_2;

use glam::Vec3;
use welkin_runtime::internals::frame::Uniforms;
use welkin_runtime::{Camera, Method, SkyParams};
use welkin_tests::renderer::{Frame, Twin};
use welkin_tests::{gpu, pack, rain};

use super::{FORMAT, SIZE, assert_near, drawn, params, with};

/// What haze and streaks make of a picture without either, if streaks are turned so far about the axis of the fall.
fn rained_on(frame: &Frame, picture: &[Vec3], turned_rad: f32) -> Vec<Vec3> {
    let Uniforms { camera, rain, .. } = &frame.uniforms;
    let mut covered = rain::streaks(camera, rain, turned_rad).into_iter();
    let hazed = frame.rained_on(picture);
    frame.under(&hazed, |_| {
        (rain.streak, covered.next().expect("every pixel is there"))
    })
}

/// What Vulkan lets a sine or a cosine be off by.
const SINE_OFF: f32 = 1.0 / 2048.0;

#[test]
fn rain_is_the_twins() {
    let twin = Twin::new(pack::default_pack());
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    for (name, azimuth, elevation, speed, amount, seconds) in [
        ("level", 0.3, 0.1, 0.0, 1.0, 3.0),
        ("seam", 0.0, 0.2, 0.7, 0.6, 77.7),
        ("up", 1.0, 1.2, 0.3, 1.0, 1e5),
        ("down", 2.0, -1.3, 1.0, 0.6, -12.0),
        ("late", 5.0, 0.4, 0.2, 0.9, 1e7),
        // Away from the sun: both bows.
        ("bow", 1.1, 0.3, 0.2, 0.9, 3.0),
    ] {
        let off = SkyParams {
            speed,
            ..params(Method::Packed)
        };
        let params = with(off, |w| w.rain = amount);
        let view = Camera::looking(azimuth, elevation, 0.6, SIZE);
        let without = drawn(&mut sky, &off, &view, seconds);
        let actual = drawn(&mut sky, &params, &view, seconds);
        let frame = twin.frame_without_map(&params, &view, seconds);
        let [expected, left, right] =
            [0.0, -SINE_OFF, SINE_OFF].map(|turned| rained_on(&frame, &without, turned));
        // Streaks that a GPU's sine turns, and steps of half floats: the haze is one, and each streak over another.
        let bounds: Vec<Vec3> = (expected.iter().zip(left).zip(right))
            .map(|((e, l), r)| (*e - l).abs().max((*e - r).abs()) + 0.003 * e.abs() + 1e-4)
            .collect();
        assert_near(&format!("rain_{name}"), &expected, &actual, &bounds, 0.25);
        let hazed = frame.rained_on(&without);
        let most = actual
            .iter()
            .zip(&hazed)
            .map(|(a, h)| a.distance(*h))
            .fold(0.0, f32::max);
        assert!(most > 0.02, "{name}: streaks are there: {most}");
    }
}

/// A column of a picture through the top of the bow, which a sun 20 degrees high has 22 degrees high.
#[test]
fn a_bow_stands_opposite_the_sun_red_outside() {
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    let clear = SkyParams {
        cover: 0.0,
        speed: 0.0,
        ..params(Method::Packed)
    };
    let wet = with(clear, |w| w.rain = 0.5);
    let twin = Twin::new(pack::default_pack());
    let north = Camera::looking(0.0, 0.3, 1.0, [1, 400]);
    let rainbow = twin.frame_without_map(&wet, &north, 0.0).uniforms.rainbow;
    let azimuth = rainbow.antisolar.x.atan2(-rainbow.antisolar.z);
    let view = Camera::looking(azimuth, 0.3, 1.0, [1, 400]);
    let frame = twin.frame_without_map(&wet, &view, 0.0);
    let dry = drawn(&mut sky, &clear, &view, 0.0);
    // Streaks aside.
    let bow = frame.rained_on(&dry);
    let mut hazed = frame;
    hazed.uniforms.rainbow = Default::default();
    let added: Vec<Vec3> = bow
        .iter()
        .zip(hazed.rained_on(&dry))
        .map(|(a, b)| *a - b)
        .collect();
    let angle = |row: usize| {
        let up = 1.0 - 2.0 * (row as f32 + 0.5) / 400.0;
        let elevation = 0.3 + (up * 0.5_f32.tan()).atan();
        (elevation - rainbow.antisolar.y.asin()).to_degrees()
    };
    let brightest = |channel: usize| {
        let rows = (0..400).filter(|&row| angle(row) < 46.0);
        angle(
            rows.max_by(|&a, &b| added[a][channel].total_cmp(&added[b][channel]))
                .unwrap(),
        )
    };
    let [red, green, blue] = [0, 1, 2].map(brightest);
    // C. B. Boyer, "The Rainbow: From Myth to Mathematics", 1959: 42 degrees.
    assert!((red - 42.0).abs() < 0.5, "{red}");
    assert!(blue < green && green < red, "{red} {green} {blue}");
}

/// Streaks stand along the ray of the middle pixel, which meets none of them.
#[test]
fn straight_up_and_down_there_is_haze_alone() {
    let twin = Twin::new(pack::default_pack());
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    let off = SkyParams {
        speed: 0.0,
        ..params(Method::Packed)
    };
    for (elevation, side) in [(-FRAC_PI_2, 1), (FRAC_PI_2, 1), (-FRAC_PI_2, 3)] {
        let params = with(off, |w| w.rain = 0.5);
        let view = Camera::looking(0.0, elevation, 150_f32.to_radians(), [side, side]);
        let middle = (side * side / 2) as usize;
        let without = drawn(&mut sky, &off, &view, 0.0);
        let frame = twin.frame_without_map(&params, &view, 0.0);
        let expected = rained_on(&frame, &without, 0.0)[middle];
        let actual = drawn(&mut sky, &params, &view, 0.0)[middle];
        let bound = 0.003 * expected.abs() + 1e-4;
        let near = (expected - actual).abs().cmple(bound).all();
        assert!(near, "{elevation} {side}: {actual}, expected {expected}");
    }
}

/// What streaks cover of a picture: level view, so that down is down.
fn streaks(amount: f32, side: u32, seconds: f64) -> Vec<f32> {
    let twin = Twin::new(pack::default_pack());
    let still = SkyParams {
        speed: 0.0,
        ..params(Method::Packed)
    };
    let params = with(still, |w| w.rain = amount);
    let view = Camera::looking(1.0, 0.0, 0.4, [side, side]);
    let frame = twin.frame_without_map(&params, &view, seconds);
    rain::streaks(&frame.uniforms.camera, &frame.uniforms.rain, 0.0)
}

#[test]
fn rain_falls() {
    // In 10 ms far drops fall 65 mm in 13 m at most, near ones 81 mm in 1.2 m at least: 2.4 to 32 pixels of 0.0021 radian.
    let [before, after] = [5.0, 5.01].map(|seconds| streaks(1.0, 192, seconds));
    let moved = |by: i32| -> f32 {
        let rows = 50..142;
        let pairs = rows.flat_map(|y| (0..192).map(move |x| (y * 192 + x, (y + by) * 192 + x)));
        pairs
            .map(|(from, to)| before[from as usize] * after[to as usize])
            .sum()
    };
    let found: Vec<f32> = (-40..=40).map(moved).collect();
    let best = (0..found.len())
        .max_by(|a, b| found[*a].total_cmp(&found[*b]))
        .unwrap_or(0) as i32
        - 40;
    println!("best moved down by {best} pixels");
    assert!((2..=32).contains(&best), "{best}: {found:?}");
    let up: f32 = found[..38].iter().sum();
    let down: f32 = found[43..].iter().sum();
    assert!(down > up, "{down} {up}");
}

#[test]
fn more_rain_is_more_haze_and_more_drops_beside_those_that_were_there() {
    let twin = Twin::new(pack::default_pack());
    let (mut last_haze, mut last) = (0.0, vec![0.0; 96 * 96]);
    for amount in [0.1, 0.3, 0.6, 1.0] {
        let params = with(params(Method::Packed), |w| w.rain = amount);
        let frame = twin.frame_without_map(&params, &Camera::looking(1.0, 0.1, 1.0, SIZE), 3.0);
        let haze = frame.uniforms.rain.haze_opacity;
        let now = streaks(amount, 96, 3.0);
        assert!(haze > last_haze, "{amount}: {haze} after {last_haze}");
        let there = last.iter().zip(&now).all(|(l, n)| *n >= l - 1e-6);
        assert!(there, "{amount}: what was there is there");
        let [before, after] = [&last, &now].map(|streaks| streaks.iter().sum::<f32>());
        assert!(after > before, "{amount}: {after} after {before}");
        (last_haze, last) = (haze, now);
    }
}

/// A streak narrower than a pixel is as wide as one and fainter, so a picture of a fourth of the pixels has the same light.
/// Where streaks lie over each other a little is lost, and more where they are wide.
#[test]
fn the_light_of_streaks_does_not_depend_on_the_pixels() {
    let mean = |side: u32| {
        let streaks = streaks(0.05, side, 3.0);
        streaks.iter().sum::<f32>() / streaks.len() as f32
    };
    let [coarse, fine] = [96, 384].map(mean);
    println!("{coarse} of {fine}");
    assert!((coarse / fine - 1.0).abs() < 0.1, "{coarse} of {fine}");
}

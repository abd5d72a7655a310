//! Rain: that it falls, and that the shader computes what its twin does.

use glam::Vec3;
use welkin_runtime::{Camera, Method, SkyParams};
use welkin_tests::renderer::Twin;
use welkin_tests::{gpu, pack, rain};

use crate::{FORMAT, SIZE, assert_near, drawn, overlaid, params, with};

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
        let own = frame.uniforms.rain;
        // A GPU's arc tangent is off by 4096 units in the last place (Vulkan's precision of `atan2`), so columns by
        // 2^-12 of 820 at most; in truth by a hundredth of that. Half of a streak's width is a tenth of a column and more.
        let over = |ray: Vec3| rain::over(&own, ray);
        let [expected, bounds] = overlaid(&frame, &without, over, [own.streak, own.haze], 0.015);
        assert_near(&format!("rain_{name}"), &expected, &actual, &bounds, 0.05);
        let most = actual
            .iter()
            .zip(&without)
            .map(|(a, b)| a.distance(*b))
            .fold(0.0, f32::max);
        assert!(most > 0.02, "{name}: haze and streaks are there: {most}");
    }
}

/// What streaks do to a picture, as a grey picture of opacity: level view, narrow, so that down is down.
fn streaks(seconds: f64) -> Vec<f32> {
    let twin = Twin::new(pack::default_pack());
    let params = with(
        SkyParams {
            speed: 0.0,
            ..params(Method::Packed)
        },
        |w| w.rain = 1.0,
    );
    let view = Camera::looking(1.0, 0.0, 0.4, [192, 192]);
    let rain = twin
        .frame_without_map(&params, &view, seconds)
        .uniforms
        .rain;
    let frame = twin.frame_without_map(&params, &view, seconds);
    let picture = frame.under(&vec![Vec3::ZERO; 192 * 192], |ray| {
        (Vec3::ONE, rain::streaks(&rain, ray))
    });
    picture.iter().map(|p| p.x).collect()
}

#[test]
fn rain_falls() {
    // In 10 ms the farthest cylinder falls 65 mm in 9 m, the nearest 81 mm in 1.6 m: 3.4 to 24 pixels of 0.0021 radian.
    let (before, after) = (streaks(5.0), streaks(5.01));
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
    assert!((3..=25).contains(&best), "{best}: {found:?}");
    let up: f32 = found[..38].iter().sum();
    let down: f32 = found[43..].iter().sum();
    assert!(down > up, "{down} {up}");
}

#[test]
fn more_rain_is_more_haze_and_more_drops() {
    let twin = Twin::new(pack::default_pack());
    let mut last = (0.0, 0.0);
    for amount in [0.1, 0.3, 0.6, 1.0] {
        let params = with(params(Method::Packed), |w| w.rain = amount);
        let frame = twin.frame_without_map(&params, &Camera::looking(1.0, 0.1, 1.0, SIZE), 3.0);
        let rain = frame.uniforms.rain;
        let black = vec![Vec3::ZERO; (SIZE[0] * SIZE[1]) as usize];
        let streaks = frame.under(&black, |ray| (Vec3::ONE, rain::streaks(&rain, ray)));
        let now = (rain.haze[3], streaks.iter().map(|s| s.x).sum::<f32>());
        assert!(
            now.0 > last.0 && now.1 > last.1,
            "{amount}: {now:?} after {last:?}"
        );
        last = now;
    }
}

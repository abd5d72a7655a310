//! A flash: where it is, when it is, and that the shader computes what its twin does.

use glam::{Vec2, Vec3};
use welkin_pack::mapping;
use welkin_runtime::internals::weather::lightning;
use welkin_runtime::{Camera, Method, SkyParams};
use welkin_tests::renderer::{Frame, Twin};
use welkin_tests::{camera, dome, gpu, pack};

use super::{BRIGHT_S, FORMAT, SIZE, assert_near, drawn, flash, params, with};

#[test]
fn lightning_is_the_twins() {
    let twin = Twin::new(pack::default_pack());
    for method in Method::DOMES {
        let mut sky = gpu::sky(pack::default_pack(), FORMAT);
        for (name, time, place_m) in [
            ("night", 0.0, Vec3::ZERO),
            ("afternoon", 0.68, Vec3::new(300.0, 200.0, 900.0)),
            ("far", 0.76, Vec3::new(-15_000.0, 0.0, 4000.0)),
        ] {
            let params = SkyParams {
                time,
                cover: 0.8,
                ..params(method)
            };
            let params = with(params, |w| w.lightning = flash());
            let mut view = Camera::looking(2.6, 0.5, 1.0, SIZE);
            view.position_m = place_m;
            let actual = drawn(&mut sky, &params, &view, BRIGHT_S);
            let mut frame = twin.frame_without_map(&params, &view, BRIGHT_S);
            frame.map = gpu::read_map(&sky);
            let expected = frame.render();
            // As of any other sky: see tests/gpu/twins.
            let steps = frame.filter_steps();
            let worth = frame.worth_of_reads(&steps, Frame::render);
            let bounds: Vec<Vec3> = expected
                .iter()
                .zip(&worth)
                .map(|(e, w)| *w + 0.02 * e.abs() + 1e-4)
                .collect();
            assert_near(
                &format!("{}_lightning_{name}", method.name()),
                &expected,
                &actual,
                &bounds,
                // Rounding is off by a quarter of a step on average.
                0.25,
            );
        }
    }
}

#[test]
fn lightning_is_brightest_at_its_place_and_follows_its_strokes() {
    let twin = Twin::new(pack::default_pack());
    for method in Method::DOMES {
        let mut sky = gpu::sky(pack::default_pack(), FORMAT);
        // An overcast sky at night: cloud everywhere, and nothing else is bright.
        let dark = SkyParams {
            cover: 1.0,
            time: 0.0,
            ..params(method)
        };
        let params = with(dark, |w| w.lightning = flash());
        for place_m in [
            Vec2::ZERO,
            Vec2::new(700.0, 1500.0),
            Vec2::new(1900.0, 3000.0),
        ] {
            // On the sphere of the dome, 16 heights below and 17 wide, straight above its place.
            let away = (Vec2::from(flash().place_m) - place_m) / 1000.0;
            let height = (17.0_f32.powi(2) - away.length_squared()).sqrt() - 16.0;
            let towards = Vec3::new(away.x, height, away.y).normalize();
            let (azimuth, elevation) = mapping::angles_from_direction(towards.to_array());
            let mut view = Camera::looking(azimuth + 0.1, (elevation - 0.1).min(1.4), 1.2, SIZE);
            view.position_m = Vec3::new(place_m.x, 0.0, place_m.y);
            let without = drawn(&mut sky, &dark, &view, BRIGHT_S);
            let mut light = |seconds: f64, params: &SkyParams| -> Vec<f32> {
                let with = drawn(&mut sky, params, &view, seconds);
                with.iter()
                    .zip(&without)
                    .map(|(a, b)| (*a - *b).element_sum())
                    .collect()
            };
            let bright = light(BRIGHT_S, &params);
            // The middle of the brightest twentieth: clouds are not equally thick.
            let mut order: Vec<usize> = (0..bright.len()).collect();
            order.sort_by(|a, b| bright[*b].total_cmp(&bright[*a]));
            let uniforms = twin.frame_without_map(&params, &view, 0.0).uniforms;
            let plane = |i: usize| {
                let pixel = [i as u32 % SIZE[0], i as u32 / SIZE[0]].map(|i| i as f32 + 0.5);
                let ray = camera::ray_of(&uniforms.camera, pixel.into());
                dome::intersect(ray.normalize()).plane
            };
            let brightest = &order[..bright.len() / 20];
            let middle = brightest.iter().map(|&i| plane(i)).sum::<Vec2>() / brightest.len() as f32;
            let off = middle.distance(away);
            println!("{} from {place_m}: {off:.2} heights off", method.name());
            // Half of the core's light is within half a height, and clouds are not equally thick.
            assert!(
                off < 0.5,
                "{method:?} from {place_m}: {middle}, expected {away}"
            );
            assert!(bright[order[0]] > 1.0, "{method:?}: it can be seen");
        }
        // Its strokes, at any second: light is the flash's brightness times what it is at the brightest.
        let mut at = |seconds: f64| {
            let still = SkyParams {
                speed: 0.0,
                ..params
            };
            let none = SkyParams { speed: 0.0, ..dark };
            let view = Camera::looking(2.7, 0.4, 1.2, SIZE);
            let [with, without] = [still, none].map(|p| drawn(&mut sky, &p, &view, seconds));
            let sum: Vec3 = with.iter().zip(&without).map(|(a, b)| *a - *b).sum();
            sum.element_sum()
        };
        let (full, of) = (at(BRIGHT_S), lightning::brightness(&flash(), BRIGHT_S));
        for seconds in [
            19.9, 20.0, 20.005, 20.06, 20.13, 20.3, 20.5, 20.8, 21.0, 25.0,
        ] {
            let (found, expected) = (
                at(seconds) / full,
                lightning::brightness(&flash(), seconds) / of,
            );
            // Half floats of a picture whose clouds form a little in the meantime.
            assert!(
                (found - expected).abs() < 0.02,
                "{method:?} at {seconds}: {found}, {expected}"
            );
        }
        assert_eq!([at(19.9), at(21.0), at(25.0)], [0.0; 3]);
    }
}

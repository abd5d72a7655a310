//! Crepuscular rays: where they point, and that the shaders compute what their twin does.

use std::f32::consts::TAU;

use glam::Vec3;
use welkin_runtime::internals::weather::rays::{GAIN, REACH};
use welkin_runtime::{Camera, Method, SkyParams};
use welkin_tests::renderer::Twin;
use welkin_tests::{gpu, pack, rays};

use super::{FORMAT, SIZE, assert_near, drawn, overlaid, params, view, with};

#[test]
fn rays_are_the_twins() {
    let twin = Twin::new(pack::default_pack());
    for method in Method::DOMES {
        let mut sky = gpu::sky(pack::default_pack(), FORMAT);
        for (name, time, cover) in [
            ("afternoon", 0.68, 0.6),
            ("sunset", 0.747, 0.5),
            ("storm", 0.6, 0.85),
        ] {
            let off = SkyParams {
                time,
                cover,
                ..params(method)
            };
            let params = with(off, |w| w.rays = 1.0);
            let view = Camera::looking(4.2, 0.35, 1.2, SIZE);
            let without = drawn(&mut sky, &off, &view, 9.0);
            let actual = drawn(&mut sky, &params, &view, 9.0);
            let mut frame = twin.frame_without_map(&params, &view, 9.0);
            frame.map = gpu::read_map(&sky);
            let streaks = rays::streaks(method, &frame.inputs());
            let own = frame.uniforms.rays;
            let strongest = own.opacity;
            assert!(strongest > 0.3, "{name}: {strongest}");
            // Each of three maps is rounded to bytes, and each read of one is off by up to a byte: 1.5 bytes for the mask, as many for
            // the sum, for the streak and for its surroundings, times the gain; and 1.5 of the streaks, 127 to one.
            let bytes = 2.0 * 3.0 * GAIN / 255.0 + 1.5 / 127.0;
            let [expected, bounds] = overlaid(
                &frame,
                &without,
                |ray| rays::haze(&own, &streaks, ray),
                [own.bright, own.dark],
                strongest * bytes,
            );
            assert_near(
                &format!("{}_rays_{name}", method.name()),
                &expected,
                &actual,
                &bounds,
                // A quarter of a step, of six that are all off the same way in the bound.
                0.25 / 6.0,
            );
            let most = actual
                .iter()
                .zip(&without)
                .map(|(a, b)| (*a - *b).abs().max_element());
            let most = most.fold(0.0, f32::max);
            println!("  strongest {most}");
            assert!(most > 0.01, "{method:?} {name}: rays can be seen: {most}");
        }
    }
}

/// Along a ray, away from the sun, little changes; across rays much does.
#[test]
fn rays_point_away_from_the_sun() {
    let twin = Twin::new(pack::default_pack());
    for method in Method::DOMES {
        let params = with(params(method), |w| w.rays = 1.0);
        let frame = twin.frame(&params, &view(), 30.0);
        let streaks = rays::streaks(method, &frame.inputs());
        let own = frame.uniforms.rays;
        let contrast = |direction: Vec3| {
            let away = direction.normalize() - own.sun_direction;
            let turns = libm::atan2f(away.dot(own.up), away.dot(own.right)) / TAU;
            rays::contrast(&streaks, [turns, away.length() / REACH])
        };
        let (mut along, mut across) = (0.0, 0.0);
        for (turn, share) in (0..200).flat_map(|turn| (3..10).map(move |share| (turn, share))) {
            let here = rays::direction(&own, [turn as f32 / 200.0, share as f32 / 20.0]);
            let sideways = own.sun_direction.cross(here).normalize();
            let [out, side] = [sideways.cross(here), sideways]
                .map(|step| contrast(here + 0.02 * step) - contrast(here));
            along += out * out;
            across += side * side;
        }
        let ratio = (across / along).sqrt();
        println!(
            "{}: {ratio:.2} times as steep across as along",
            method.name()
        );
        // A blur along one direction, by half of its map, leaves a slope of a fraction.
        assert!(ratio > 2.0, "{method:?}: {ratio}");
    }
}

/// The map of the rays belongs to the sky: it is the same however the view is turned, and however wide or fine it is.
#[test]
fn rays_stay_in_the_sky_as_the_view_turns() {
    let twin = Twin::new(pack::default_pack());
    for method in Method::DOMES {
        let params = with(params(method), |w| w.rays = 1.0);
        let map = |camera: &Camera| {
            let frame = twin.frame(&params, camera, 30.0);
            let streaks = rays::streaks(method, &frame.inputs());
            streaks.levels()[0].texels.clone()
        };
        let expected = map(&view());
        for other in [
            Camera::looking(3.6, 0.1, 0.5, [1920, 1080]),
            Camera::looking(4.6, 0.9, 1.4, [300, 900]),
        ] {
            let turned = map(&other);
            let bytes = |(a, b): (&f32, &f32)| ((a - b) * 255.0).abs();
            let worst = expected.iter().zip(&turned).map(bytes).fold(0.0, f32::max);
            // The mask may be rounded another way, by a byte, which is less than the gain in the streaks.
            assert!(worst <= GAIN, "{method:?}: {worst} bytes");
        }
    }
}

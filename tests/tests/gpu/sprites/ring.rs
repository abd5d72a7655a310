//! The ring of impostors: size, likeness, seams, cross-fade, and what it remembers.

use glam::{DVec3, Vec2, Vec3, Vec4};
use welkin_runtime::internals::sprites::ring::Ring;
use welkin_runtime::internals::sprites::station::{BYTES, FADE_FRAMES, PICTURES, Station};
use welkin_runtime::params::MOST_DISTANCE_M;
use welkin_runtime::params::SpriteParams;
use welkin_runtime::{Camera, Sky, SkyParams};
use welkin_tests::ring::hit;
use welkin_tests::{compare, gpu, pack};

use super::{mean_difference, params, view, without_ring};

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;
const SIZE: [u32; 2] = [240, 136];

/// The default field, so much of it.
fn at(cover: f32, ring_radius_m: f32) -> SkyParams {
    SkyParams {
        cover,
        sprites: SpriteParams {
            ring_radius_m,
            ..without_ring()
        },
        ..params()
    }
}

const RADIUS_M: f32 = 8_000.0;

fn frame(sky: &mut Sky, params: &SkyParams, camera: &Camera) -> Vec<Vec3> {
    gpu::rgb(&gpu::render(sky, FORMAT, params, camera, 0.0))
}

/// Places on the ground, among the clouds and above them.
const PLACES: [[f64; 3]; 3] = [
    [500.0, 2.0, 700.0],
    [3100.0, 1300.0, -900.0],
    [-2000.0, 3400.0, 5000.0],
];

#[test]
fn with_the_ring_the_picture_is_the_same_within_two_percent() {
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    for cover in [0.25, 0.6, 1.0] {
        for place in PLACES {
            for azimuth in [20.0, 200.0] {
                let camera = view(DVec3::from(place), azimuth, -2.0, SIZE);
                sky.reset_history();
                let expected = frame(&mut sky, &at(cover, 0.0), &camera);
                sky.reset_history();
                let actual = frame(&mut sky, &at(cover, RADIUS_M), &camera);
                let [_, into_ring] = sky.sprites_drawn();
                assert!(into_ring > 0, "the ring is made");
                let difference = mean_difference(&expected, &actual);
                println!("cover {cover}, {place:?}, {azimuth}: {difference:.4}");
                if difference >= 0.02 {
                    let picture = compare::save("ring", &expected, &actual, SIZE);
                    panic!("{difference}; see {}", picture.display());
                }
            }
        }
    }
}

/// By default a far cloud is one sprite: the picture is as like as the ring is to what it stands for, and a third of the sprites and more
/// need not be drawn into it.
#[test]
fn far_clouds_of_one_sprite_are_on_by_default_and_pay() {
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    let ring_radius_m = SpriteParams::default().ring_radius_m;
    for cover in [0.25, 0.6, 1.0] {
        let one = at(cover, ring_radius_m);
        let mut all = one;
        all.sprites.billboards_beyond_m = MOST_DISTANCE_M;
        let camera = view(DVec3::from(PLACES[0]), 20.0, 4.0, SIZE);
        let [(expected, every), (actual, fewer)] = [all, one].map(|params| {
            sky.reset_history();
            let picture = frame(&mut sky, &params, &camera);
            (picture, sky.sprites_drawn()[1])
        });
        let difference = mean_difference(&expected, &actual);
        println!("cover {cover}: {fewer} of {every} sprites into the ring, {difference:.4}");
        assert!(3 * fewer < 2 * every, "cover {cover}: {fewer} of {every}");
        assert!(difference < 0.02, "cover {cover}: {difference}");
    }
}

/// Where two pictures of the ring meet, the picture changes no more than beside it. The seam lies between the two columns in the middle.
#[test]
fn no_seam_shows_between_the_pictures() {
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    // Every block is in the ring, but for the nearest ones, which are not looked at.
    let params = at(0.7, 4000.0);
    let mut steps = vec![0.0_f32; SIZE[0] as usize - 1];
    for picture in 0..PICTURES {
        let azimuth = 22.5 + 45.0 * picture as f32;
        let camera = Camera {
            fov_y_rad: 0.25,
            ..view(DVec3::new(500.0, 700.0, 700.0), azimuth, 5.0, SIZE)
        };
        sky.reset_history();
        let picture = frame(&mut sky, &params, &camera);
        for row in picture.chunks_exact(SIZE[0] as usize) {
            for (step, pair) in steps.iter_mut().zip(row.windows(2)) {
                *step += (pair[1] - pair[0]).abs().element_sum();
            }
        }
    }
    let middle = SIZE[0] as usize / 2 - 1;
    let beside = steps.iter().enumerate().filter(|(i, _)| *i != middle);
    let largest = beside.map(|(_, step)| *step).fold(0.0, f32::max);
    assert!(largest > 0.0);
    assert!(
        steps[middle] <= largest,
        "{} at the seam, at most {largest} beside it",
        steps[middle]
    );
}

#[test]
fn it_takes_two_megabytes_and_four_while_it_changes() {
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    let params = at(0.5, RADIUS_M);
    let mut bytes_at = |x: f64| {
        let camera = view(DVec3::new(x, 2.0, 0.0), 0.0, 5.0, [16, 9]);
        gpu::prepare(&mut sky, &params, &camera, 0.0);
        sky.ring_bytes()
    };
    assert_eq!(bytes_at(0.0), BYTES);
    assert_eq!(bytes_at(1100.0), BYTES);
    // One frame a picture, one more before the fade, the fade, and one in which the old one goes.
    let changing: Vec<u64> = (0..PICTURES as u32 + FADE_FRAMES)
        .map(|_| bytes_at(1300.0))
        .collect();
    assert!(changing.iter().all(|&bytes| bytes == 2 * BYTES));
    assert_eq!(bytes_at(1300.0), BYTES);
    assert_eq!(BYTES, 2 << 20);
}

/// A viewer who has moved and now stands still sees the old ring go over into the new one by small steps.
#[test]
fn old_and_new_are_cross_faded() {
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    let params = at(0.6, RADIUS_M);
    let there = view(DVec3::new(1300.0, 300.0, 0.0), 40.0, 4.0, SIZE);
    frame(
        &mut sky,
        &params,
        &view(DVec3::new(0.0, 300.0, 0.0), 40.0, 4.0, SIZE),
    );
    let frames: Vec<_> = (0..PICTURES as u32 + FADE_FRAMES + 3)
        .map(|_| frame(&mut sky, &params, &there))
        .collect();
    let steps: Vec<f32> = frames
        .windows(2)
        .map(|pair| mean_difference(&pair[0], &pair[1]))
        .collect();
    let whole = mean_difference(&frames[0], &frames[frames.len() - 1]);
    let largest = steps.iter().copied().fold(0.0, f32::max);
    println!("whole {whole:.5}, largest step {largest:.5}");
    assert!(whole > 0.0);
    // Even steps are a sixteenth each; bytes are rounded once in both pictures.
    assert!(largest <= 3.0 * whole / FADE_FRAMES as f32 + 0.25 / 255.0);
    // In the end it is the ring that would have been made there at once.
    let mut new = gpu::sky(pack::default_pack(), FORMAT);
    let at_once = frame(&mut new, &params, &there);
    let last = mean_difference(&frames[frames.len() - 1], &at_once);
    assert!(last < 1e-6, "{last}");
}

#[test]
fn a_sky_that_forgets_draws_what_a_new_one_draws() {
    let mut old = gpu::sky(pack::default_pack(), FORMAT);
    let params = at(0.6, RADIUS_M);
    let camera = |x: f64| view(DVec3::new(x, 1250.0, 0.3 * x), 100.0, 2.0, SIZE);
    for step in 0..12 {
        frame(&mut old, &params, &camera(f64::from(step) * 180.0));
    }
    old.reset_history();
    let mut new = gpu::sky(pack::default_pack(), FORMAT);
    let here = camera(2300.0);
    let [old, new] = [&mut old, &mut new].map(|sky| frame(sky, &params, &here));
    assert!(old == new, "{}", mean_difference(&old, &new));
}

/// A place beyond the ring is on the picture where the ring's own view saw it, for a viewer in its middle.
#[test]
fn a_ray_meets_the_picture_where_it_was_drawn() {
    let station = Station {
        place_m: DVec3::new(100.0, 50.0, -30.0),
        radius_m: 8000.0,
        distance_m: 30_000.0,
        heights_m: [900.0, 2000.0],
        sun: Vec3::Y,
        look: [0.0; 11],
    };
    let (uniforms, shows) = Ring::new(station).uniforms(station.place_m);
    assert!(shows);
    for step in 0..720 {
        let azimuth = (step as f32 * 0.5 + 0.1).to_radians();
        let ray = Vec3::new(azimuth.sin(), 0.07, -azimuth.cos());
        let (side, uv) = hit(&uniforms, &uniforms.used, ray);
        let view = station.view(side, 128.0, 0.0);
        let along = |row: Vec4| row.truncate().dot(ray);
        let clip = Vec2::new(along(view.clip_x), along(view.clip_y)) / along(view.clip_w);
        let seen = Vec2::new(0.5 + 0.5 * clip.x, 0.5 - 0.5 * clip.y);
        assert!(
            (uv - seen).abs().max_element() < 1e-4,
            "{step}: {uv} {seen}"
        );
        assert!((0.0..=1.0).contains(&uv.x));
    }
}

/// From anywhere that the viewer may be before the ring is made anew, a ray leaves the octagon through the side that is
/// found: none is nearer.
#[test]
fn a_ray_leaves_through_the_nearest_side_wherever_the_viewer_is() {
    let station = |x: f64, z: f64| Station {
        place_m: DVec3::new(x, 50.0, z),
        radius_m: 8000.0,
        distance_m: 30_000.0,
        heights_m: [900.0, 2000.0],
        sun: Vec3::Y,
        look: [0.0; 11],
    };
    let made = Ring::new(station(0.0, 0.0));
    for (x, z) in [(0.0, 0.0), (1200.0, 0.0), (-800.0, 850.0), (0.0, -1199.0)] {
        let (uniforms, _) = made.uniforms(DVec3::new(x, 50.0, z));
        let middle = uniforms.used.centre;
        for step in 0..1000 {
            let azimuth = (step as f32 * 0.36 + 0.05).to_radians();
            let ray = Vec3::new(azimuth.sin(), 0.1, -azimuth.cos());
            let (side, _) = hit(&uniforms, &uniforms.used, ray);
            let reach = |side: usize| {
                let azimuth = (side as f32 * 45.0).to_radians();
                let normal = Vec3::new(azimuth.sin(), 0.0, -azimuth.cos());
                let along = ray.dot(normal);
                let reach = (8000.0 + normal.dot(middle)) / along;
                if along > 0.0 { reach } else { f32::INFINITY }
            };
            let nearest = (0..PICTURES).map(reach).fold(f32::INFINITY, f32::min);
            assert!(
                reach(side) <= nearest * (1.0 + 1e-5),
                "{x} {z} {step}: {side}"
            );
        }
    }
}

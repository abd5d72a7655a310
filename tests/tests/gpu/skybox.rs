//! The skybox is where it belongs in every direction, in the right amount, behind the clouds.

use glam::{Vec2, Vec3};
use welkin_pack::Pack;
use welkin_runtime::internals::pack_data::PackData;
use welkin_runtime::{Camera, Method, Sky, SkyParams};
use welkin_tests::skybox::{self, Skybox};
use welkin_tests::{camera, compare, gpu, pack};

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;

/// Texels a side of a face: in a picture of 96 pixels over a right angle, level 0.
const FACE: u32 = 64;

const SIZE: [u32; 2] = [96, 96];

/// A clear sky without sun and stars, so that nothing covers the skybox.
fn clear() -> SkyParams {
    SkyParams {
        cover: 0.0,
        sun: false,
        stars: false,
        flare: 0.0,
        ..SkyParams::default()
    }
}

/// Straight at every face, edge and corner, and past them.
fn views(size: [u32; 2]) -> Vec<(String, Camera)> {
    let mut angles = vec![(0.0, 90.0), (0.0, -90.0), (75.0, 12.0)];
    for eighth in 0..8 {
        for elevation in [-45.0, 0.0, 35.264, 60.0] {
            angles.push((45.0 * eighth as f32, elevation));
        }
    }
    let view = |(azimuth, elevation): (f32, f32)| {
        let (a, e) = (azimuth.to_radians(), elevation.to_radians());
        let camera = Camera::looking(a, e, std::f32::consts::FRAC_PI_2, size);
        (format!("azimuth {azimuth} elevation {elevation}"), camera)
    };
    angles.into_iter().map(view).collect()
}

/// A colour that tells every direction from every other, between 0.2 and 1.8.
fn colour([east, up, south]: [f32; 3]) -> [f32; 3] {
    [1.0 + 0.5 * east, 1.0 + 0.8 * up, 1.0 + 0.6 * south]
}

/// The directions of a camera's pixels.
fn directions(pack: &Pack, view: &Camera) -> Vec<Vec3> {
    let facts = PackData::new(pack).expect("the pack has every role");
    let uniforms = facts.uniforms(&clear(), view, 0.0, 0.0);
    let [width, height] = view.viewport_px;
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| Vec2::new(x as f32, y as f32)));
    pixels
        .map(|pixel| camera::ray_of(&uniforms.camera, pixel + 0.5).normalize())
        .collect()
}

fn sky(pack: &Pack) -> Sky {
    gpu::sky(pack, FORMAT)
}

fn draw(sky: &mut Sky, params: &SkyParams, view: &Camera, seconds: f64) -> Vec<Vec3> {
    gpu::rgb(&gpu::render(sky, FORMAT, params, view, seconds))
}

/// What the picture of `colour` may differ by.
///
/// A texel is at most 2 / 64 radians wide. Bilinear filtering between texels of a function that bends by at most
/// 0.8 is off by `2 * 0.8 * texel^2 / 8`. On an edge the grid bends, by at most a right angle, half a texel from
/// where it is interpolated: half of half a texel's slope of at most 0.8. Texel weights have 8 bits: a 512th of
/// a texel's slope on each axis. Half floats, of texels and of the target, have 11 bits.
fn allowed(radiance: f32) -> f32 {
    let texel = 2.0 / FACE as f32;
    let curve = 2.0 * 0.8 * texel * texel / 8.0;
    let edge = 0.5 * 0.8 * texel / 2.0;
    let weights = 2.0 * 0.8 * texel / 512.0;
    curve + edge + weights + radiance / 1024.0
}

#[test]
fn every_direction_shows_what_the_picture_has_there() {
    let pack = pack::with_skybox(FACE, |direction| {
        let [r, g, b] = colour(direction);
        [r, g, b, 1.0]
    });
    let mut sky = sky(&pack);
    for (name, view) in views(SIZE) {
        let directions = directions(&pack, &view);
        let expected: Vec<Vec3> = directions
            .iter()
            .map(|d| colour(d.to_array()).into())
            .collect();
        let actual = draw(&mut sky, &clear(), &view, 0.0);
        let difference = compare::difference(&expected, &actual, allowed);
        println!("{name}: {difference:?}");
        assert!(
            difference.worst <= 1.0,
            "{name}: {difference:?}, {}: {} {}",
            directions[difference.pixel],
            expected[difference.pixel],
            actual[difference.pixel]
        );
    }
}

/// Numbers without any order, 0..1: a hash of the direction's digits.
fn noise(direction: [f32; 3]) -> [f32; 4] {
    let mut state = direction.iter().fold(17_u32, |s, c| {
        (s ^ c.to_bits()).wrapping_mul(0x9E37_79B1).rotate_left(13)
    });
    [(); 4].map(|()| {
        state = (state ^ (state >> 15)).wrapping_mul(0x85EB_CA6B);
        (state >> 8) as f32 / 16_777_216.0
    })
}

/// Over faces, edges and corners, at levels 0 to 4 and between them, in a picture in which neighbouring texels have
/// nothing in common.
#[test]
fn gpu_and_cpu_agree_on_noise_at_every_level() {
    let pack = pack::with_skybox(FACE, noise);
    let skybox = Skybox::new(&pack).expect("the pack has a skybox");
    let facts = PackData::new(&pack).expect("the pack has every role");
    let [mut sky, mut computed] = [&pack, pack::default_pack()].map(sky);
    for side in [96, 30, 9] {
        for (name, view) in views([side, side]) {
            let uniforms = facts.uniforms(&clear(), &view, 0.0, 0.0).skybox;
            let behind = draw(&mut computed, &clear(), &view, 0.0);
            let along = directions(&pack, &view).into_iter().zip(behind);
            let expected: Vec<Vec3> = along
                .map(|(direction, behind)| skybox::mix(&uniforms, &skybox, behind, direction))
                .collect();
            let actual = draw(&mut sky, &clear(), &view, 0.0);
            // Weights of 8 bits on two axes and between levels are off by a 512th each of the range of 1, in
            // colour and cover; the sky behind and the result are half floats.
            let difference = compare::difference(&expected, &actual, |e| 6.0 / 512.0 + e / 512.0);
            println!("{side} {name} level {}: {difference:?}", uniforms.lod);
            assert!(difference.worst <= 1.0, "{side} {name}: {difference:?}");
        }
    }
}

#[test]
fn strength_and_cover_mix_the_picture_with_the_computed_sky() {
    let half = pack::with_skybox(FACE, |_| [0.9, 0.2, 0.4, 0.5]);
    let view = Camera::looking(2.0, 0.3, 1.2, SIZE);
    let computed = draw(&mut sky(pack::default_pack()), &clear(), &view, 0.0);
    let mut half = sky(&half);
    for strength in [0.0, 0.3, 1.0] {
        let params = SkyParams {
            skybox: strength,
            ..clear()
        };
        let expected: Vec<Vec3> = computed
            .iter()
            .map(|c| *c * (1.0 - 0.5 * strength) + Vec3::new(0.9, 0.2, 0.4) * strength)
            .collect();
        let actual = draw(&mut half, &params, &view, 0.0);
        // Two half floats: that of the computed sky and that of the mixture.
        let difference = compare::difference(&expected, &actual, |e| e / 512.0 + 1e-4);
        assert!(difference.worst <= 1.0, "{strength}: {difference:?}");
    }
}

#[test]
fn no_cover_shows_the_computed_sky() {
    let empty = pack::with_skybox(16, |_| [0.0; 4]);
    let [mut empty, mut defaults] = [&empty, pack::default_pack()].map(sky);
    for (name, view) in views([32, 32]).into_iter().take(8) {
        let params = SkyParams {
            cover: 0.5,
            ..SkyParams::default()
        };
        let computed = draw(&mut defaults, &params, &view, 7.0);
        assert_eq!(draw(&mut empty, &params, &view, 7.0), computed, "{name}");
    }
}

#[test]
fn a_whole_picture_hides_sun_stars_and_sky() {
    let mut grey = sky(&pack::in_skybox(0.25));
    let at_the_sun = Camera::looking(std::f32::consts::PI, 1.05, 0.6, SIZE);
    let at_the_stars = Camera::looking(0.0, 0.8, 1.0, SIZE);
    for (time, view) in [(0.5, at_the_sun), (0.0, at_the_stars)] {
        let params = SkyParams {
            time,
            sun: true,
            stars: true,
            ..clear()
        };
        let picture = draw(&mut grey, &params, &view, 3.0);
        assert!(
            picture.iter().all(|texel| *texel == Vec3::splat(0.25)),
            "time {time}"
        );
    }
}

/// How much of the skybox is seen through the clouds in each pixel: the difference of a white and a black one.
fn seen_through(skies: &mut [Sky; 2], params: &SkyParams, view: &Camera, seconds: f64) -> Vec<f32> {
    let [black, white] = skies.each_mut().map(|sky| draw(sky, params, view, seconds));
    white.iter().zip(&black).map(|(w, b)| w.y - b.y).collect()
}

#[test]
fn the_clouds_of_every_method_move_in_front_of_it() {
    let mut skies = [0.0, 1.0].map(|grey| sky(&pack::in_skybox(grey)));
    let view = Camera::looking(0.7, 0.6, 1.2, SIZE);
    for method in Method::DOMES {
        let params = SkyParams {
            method,
            cover: 0.75,
            density: 0.6,
            speed: 0.5,
            ..clear()
        };
        let now = seen_through(&mut skies, &params, &view, 0.0);
        // A half float's step at 1 and at the clouds' white.
        assert!(
            now.iter().all(|s| (-0.002..1.002).contains(s)),
            "{method:?}"
        );
        let part = |low: f32, high: f32| {
            let within = now.iter().filter(|s| (low..=high).contains(*s)).count();
            within as f32 / now.len() as f32
        };
        println!(
            "{method:?}: behind clouds {}, open {}",
            part(-1.0, 0.3),
            part(0.95, 2.0)
        );
        assert!(part(-1.0, 0.3) > 0.02, "{method:?} hides nothing");
        assert!(part(0.95, 2.0) > 0.02, "{method:?} leaves nothing open");
        let later = seen_through(&mut skies, &params, &view, 300.0);
        let moved = now
            .iter()
            .zip(&later)
            .map(|(a, b)| (a - b).abs())
            .sum::<f32>()
            / now.len() as f32;
        assert!(moved > 0.05, "{method:?} stands still: {moved}");
    }
}

/// Without clouds, so that nothing but the skybox could move.
#[test]
fn the_picture_stands_still() {
    let mut sky = sky(&pack::with_skybox(FACE, noise));
    let view = Camera::looking(0.7, 0.6, 1.2, SIZE);
    let params = SkyParams {
        speed: 1.0,
        ..clear()
    };
    let now = draw(&mut sky, &params, &view, 0.0);
    assert_eq!(now, draw(&mut sky, &params, &view, 1e6));
}

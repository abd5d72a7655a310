//! Cloud shadows on the ground: they are what stands before the sun, and go with the clouds.

use std::f32::consts::TAU;

use glam::{DVec2, Vec2, Vec3};
use welkin_pack::role::Wrap;
use welkin_pack::{Image, LayerKind, mapping};
use welkin_runtime::internals::clouds::shadow::SIDE;
use welkin_runtime::params::MAX_LAYERS;
use welkin_runtime::params::{LitLayer, LitParams};
use welkin_runtime::{Camera, Method, Sky, SkyParams};
use welkin_tests::film::Film;
use welkin_tests::renderer::{Frame, Twin};
use welkin_tests::texture::Texture;
use welkin_tests::{gpu, pack, shadow};

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;

/// Half of the sky under clouds of a method.
fn params_of(method: Method, time: f32, extent_m: f32) -> SkyParams {
    SkyParams {
        method,
        ..params(time, extent_m)
    }
}

/// Half of the sky under three layers of `lit`, in a square of `extent_m`.
fn params(time: f32, extent_m: f32) -> SkyParams {
    SkyParams {
        method: Method::Lit,
        cover: 0.5,
        time,
        speed: 0.6,
        sun: false,
        stars: false,
        shadow_extent_m: extent_m,
        ..SkyParams::default()
    }
}

/// Pixels a side of what a viewer sees.
const SEEN: u32 = 33;

/// A viewer on the ground, who looks towards a direction through the smallest angle that a camera has: the middle pixel is 1/30000 radian wide.
fn viewer(place_m: Vec2, towards: Vec3) -> Camera {
    let (azimuth, elevation) = mapping::angles_from_direction(towards.to_array());
    let mut camera = Camera::looking(azimuth, elevation, 1e-4, [SEEN; 2]);
    camera.position_m = Vec3::new(place_m.x, 0.0, place_m.y);
    camera
}

/// The shadows' texture and where it lies.
struct Shadows {
    texels: Vec<f32>,
    centre_m: Vec2,
    extent_m: f32,
    area: [f32; 4],
}

impl Shadows {
    fn of(sky: &Sky) -> Shadows {
        let shadow = sky.shadow().expect("the method throws shadows");
        assert_eq!(shadow.texture.format(), wgpu::TextureFormat::R8Unorm);
        assert_eq!([shadow.texture.width(), shadow.texture.height()], [SIDE; 2]);
        Shadows {
            texels: gpu::read(shadow.texture).iter().map(|t| t[0]).collect(),
            centre_m: shadow.centre_m.into(),
            extent_m: shadow.extent_m,
            area: shadow.area(),
        }
    }

    fn at(&self, [x, y]: [u32; 2]) -> f32 {
        self.texels[(y * SIDE + x) as usize]
    }

    /// The middle of a texel, in metres east and south.
    fn place_m(&self, texel: [u32; 2]) -> Vec2 {
        let [x, y] = texel.map(|i| (i as f32 + 0.5) / SIDE as f32 - 0.5);
        self.centre_m + self.extent_m * Vec2::new(x, y)
    }

    fn texture(&self) -> Texture {
        let image = Image {
            width: SIDE,
            height: SIDE,
            channels: 1,
            texels: self.texels.clone(),
        };
        Texture::from_levels(vec![image], Wrap::Clamp)
    }
}

/// What opacities of `lit` may differ by where each read of each layer is off by a step of 8-bit filtering: that step, times what
/// the finer read makes of it, `z + s (r - 1/2) z (1 - z)`, whose slopes are at most `1 + s/2` and `s/4`.
fn worth_of_a_step(frame: &Frame) -> f32 {
    let lit = &frame.uniforms.lit;
    let layers = lit.layers.iter().take(lit.count as usize);
    layers.map(|layer| 1.0 + 0.75 * layer.grain).sum::<f32>() / 255.0
}

/// Times of the day: noon, a sun at 12 degrees, a moon.
const LIGHTS: [(&str, f32); 3] = [("noon", 0.5), ("low sun", 0.29), ("moon", 0.06)];

/// A shadow is what a viewer at its place sees before the sun.
///
/// Texels of 0.6 metres are finer than those of the clouds and their grain, however soft a low sun's are read, and so is the viewer's pixel, so that
/// both read the finest level of everything. What is left: two half floats, a byte of the shadow, and how places round.
#[test]
fn a_shadow_is_what_clouds_hide_of_the_sun_there() {
    const BOUND: f32 = 2.0 / 1024.0 + 0.5 / 255.0 + 0.006;
    let mut film = Film::new();
    for method in Method::DOMES {
        let mut sky = gpu::sky(pack::default_pack(), FORMAT);
        for (name, time) in LIGHTS {
            let (mut least, mut most, mut worst) = (1.0_f32, 0.0_f32, 0.0_f32);
            for (place_m, seconds) in [
                (Vec2::ZERO, 0.0),
                (Vec2::new(2750.0, -1300.0), 40.0),
                (Vec2::new(-3600.0, 800.0), 11.0),
                (Vec2::new(-90_000.0, 41_000.0), 7777.0),
                (Vec2::new(1500.0, 5200.0), 3.0),
                (Vec2::new(700.0, -4100.0), 900.0),
            ] {
                let params = SkyParams {
                    upper_layer: 0.5,
                    ..params_of(method, time, 160.0)
                };
                gpu::prepare(&mut sky, &params, &viewer(place_m, Vec3::Y), seconds);
                let towards = sky.light(&params, seconds);
                let towards = match towards.sun.irradiance.max_element() > 0.0 {
                    true => towards.sun.direction,
                    false => towards.moon.direction,
                };
                assert!(towards.y > 0.0, "{name}: {towards}");
                let shadows = Shadows::of(&sky);
                for texel in [[0, 0], [128, 128], [17, 230]] {
                    let there = viewer(shadows.place_m(texel), towards);
                    let middle = (SEEN * SEEN / 2) as usize;
                    let alpha = film.alpha(&params, &there, seconds)[middle];
                    let (found, seen) = (shadows.at(texel), 1.0 - alpha);
                    assert!(
                        (found - seen).abs() < BOUND,
                        "{method:?}, {name} at {seconds} s, {texel:?}: {found}, a viewer sees {seen}"
                    );
                    worst = worst.max((found - seen).abs());
                    (least, most) = (least.min(found), most.max(found));
                }
            }
            println!("{method:?}, {name}: from {least:.2} to {most:.2}, off by {worst:.4}");
            assert!(
                most - least > 0.3,
                "{method:?}, {name}: shade and light: {least} {most}"
            );
        }
    }
}

/// Larger texels read coarser levels: the twin knows which.
#[test]
fn shadows_are_the_twins() {
    let twin = Twin::new(pack::default_pack());
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    for (name, time) in LIGHTS {
        for (extent_m, seconds) in [(300.0, 3.0), (8000.0, 60.0), (100_000.0, 1e5)] {
            let params = params(time, extent_m);
            let mut camera = Camera::looking(1.0, 0.4, 1.0, [96, 72]);
            camera.position_m = Vec3::new(-731.0, 260.0, 5120.0);
            gpu::prepare(&mut sky, &params, &camera, seconds);
            let found = Shadows::of(&sky);
            let mut frame = twin.frame_without_map(&params, &camera, seconds);
            frame.map = gpu::read_map(&sky);
            let expected = shadow::render(&frame.inputs());
            let bound = worth_of_a_step(&frame) + 0.5 / 255.0;
            let apart = found
                .texels
                .iter()
                .zip(&expected)
                .map(|(f, e)| (f - e).abs());
            let (worst, mean) = apart.fold((0.0_f32, 0.0), |(worst, sum), apart| {
                (worst.max(apart), sum + apart / expected.len() as f32)
            });
            println!("{name}, {extent_m} m: {worst}, mean {mean}, may be {bound}");
            assert!(
                worst < bound,
                "{name}, {extent_m} m: {worst}, expected {bound}"
            );
            // Rounding is off by a quarter of a step on average, filtering by no more for each layer.
            assert!(mean < bound / 4.0, "{name}, {extent_m} m: {mean}");
        }
    }
}

/// A layer of heaps alone, so that its wind is the clouds' wind.
fn heaps() -> LitParams {
    LitParams {
        formation_interval_s: 86_400.0,
        ..LitParams::with_layers(&[LitLayer::of(LayerKind::Cumulus, 1.0)])
    }
}

#[test]
fn shadows_move_with_the_wind() {
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    let params = SkyParams {
        lit: heaps(),
        ..params(0.45, 6400.0)
    };
    let velocity_m_s = Vec2::from(params.lit.layers[0].velocity_m_s) * params.speed;
    let mut at = |seconds: f64| {
        gpu::prepare(&mut sky, &params, &viewer(Vec2::ZERO, Vec3::Y), seconds);
        Shadows::of(&sky)
    };
    // Whole texels of 25 metres, as near as they come.
    let seconds = 20.0;
    let (before, after) = (at(0.0), at(seconds));
    let way = velocity_m_s * seconds as f32 / 25.0;
    let apart = |moved: Vec2| {
        let [dx, dy] = moved.round().as_ivec2().to_array();
        let mut sum = 0.0;
        for y in 64..192 {
            for x in 64..192 {
                let was = before.at([(x - dx) as u32, (y - dy) as u32]);
                sum += (after.at([x as u32, y as u32]) - was).abs();
            }
        }
        sum / 128.0 / 128.0
    };
    let (with, without, against) = (apart(way), apart(Vec2::ZERO), apart(-way));
    println!(
        "moved by {way} texels: {with:.4} with the wind, {without:.4} without, {against:.4} against it"
    );
    assert!(
        way.abs().min_element() > 5.0,
        "a way that can be told: {way}"
    );
    assert!(4.0 * with < without && 4.0 * with < against);
}

#[test]
fn shadows_stay_where_they_are_as_the_viewer_walks_and_climbs() {
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    for method in Method::ALL {
        let params = params_of(method, 0.4, 6400.0);
        let mut from = |place_m: Vec3, fov_y_rad: f32| {
            let mut camera = Camera::looking(0.3, 0.2, fov_y_rad, [64, 48]);
            camera.position_m = place_m;
            gpu::prepare(&mut sky, &params, &camera, 9.0);
            Shadows::of(&sky)
        };
        let defaults = from(Vec3::ZERO, 1.0);
        for (place_m, fov_y_rad) in [
            (Vec3::new(61.0, 0.0, -1234.5), 1.0),
            (Vec3::new(0.0, 900.0, 0.0), 0.2),
            (Vec3::new(-300.0, 20_000.0, 40.0), 2.0),
        ] {
            let other = from(place_m, fov_y_rad);
            let moved = (other.centre_m - defaults.centre_m) / 25.0;
            assert_eq!(moved, moved.round(), "whole texels");
            let [dx, dy] = moved.as_ivec2().to_array();
            let (mut worst, mut mean) = (0.0_f32, 0.0);
            for y in 60..190 {
                for x in 60..190 {
                    let here = defaults.at([x as u32, y as u32]);
                    let there = other.at([(x - dx) as u32, (y - dy) as u32]);
                    worst = worst.max((here - there).abs());
                    mean += (here - there).abs() / (130.0 * 130.0);
                }
            }
            println!("{method:?} {place_m}: off by {worst:.4}, mean {mean:.5}");
            // Places round another way: steps of 8-bit filtering show where opacity is steep, and sprites' edges move by parts of a texel.
            let bound = match method {
                Method::Lit => 3.1 / 255.0,
                _ => 0.08,
            };
            assert!(
                worst < bound && mean < 0.004,
                "{method:?} {place_m}: {worst} {mean}"
            );
        }
    }
}

#[test]
fn there_is_none_without_an_extent() {
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    assert!(sky.shadow().is_none(), "before the first frame");
    let view = viewer(Vec2::ZERO, Vec3::Y);
    for method in Method::ALL {
        for extent_m in [0.0, -5.0, f32::NAN, 500.0] {
            let params = params_of(method, 0.5, extent_m);
            gpu::prepare(&mut sky, &params, &view, 0.0);
            let expected = extent_m > 0.0;
            assert_eq!(sky.shadow().is_some(), expected, "{method:?} {extent_m}");
        }
    }
}

#[test]
fn light_from_the_horizon_meets_no_cloud_and_a_clear_sky_throws_no_shadow() {
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    let view = viewer(Vec2::ZERO, Vec3::Y);
    for method in Method::ALL {
        // The sun a little below the horizon, before the moon takes over; no cover; no layer.
        let dusk = params_of(method, 0.753, 4000.0);
        let mut bare = params(0.5, 4000.0);
        bare.lit
            .layers
            .iter_mut()
            .for_each(|layer| layer.share = 0.0);
        let clear = SkyParams {
            cover: 0.0,
            ..params_of(method, 0.5, 4000.0)
        };
        for params in [dusk, bare, clear] {
            gpu::prepare(&mut sky, &params, &view, 4.0);
            assert!(
                Shadows::of(&sky).texels.iter().all(|&t| t == 1.0),
                "{params:?}"
            );
        }
        let overcast = SkyParams {
            cover: 1.0,
            ..params_of(method, 0.5, 4000.0)
        };
        gpu::prepare(&mut sky, &overcast, &view, 4.0);
        let texels = Shadows::of(&sky).texels;
        let mean = texels.iter().sum::<f32>() / texels.len() as f32;
        let most = texels.iter().fold(0.0_f32, |most, t| most.max(*t));
        println!("{method:?}: an overcast lets through {mean:.3}, {most:.3} at most");
        // The low dome of octaves has thin places.
        let bound = if method == Method::Octaves { 0.2 } else { 0.1 };
        assert!(mean < 0.1 && most < bound, "{method:?}: {mean} {most}");
        assert_eq!(overcast.lit.layers.len(), MAX_LAYERS);
    }
}

/// Shares of light at places over the whole square, and what a viewer on each sees of the sun through the sprites. A viewer faces those about him as a
/// square of ground faces the sun, but for an angle of half a sprite.
#[test]
fn sprites_throw_the_shadows_that_a_viewer_finds() {
    let (mut sky, mut film) = (gpu::sky(pack::default_pack(), FORMAT), Film::new());
    for (name, time) in [("noon", 0.5), ("low sun", 0.29)] {
        let mut params = SkyParams {
            cover: 0.4,
            ..params_of(Method::Sprites, time, 6000.0)
        };
        params.sprites.ring_radius_m = 0.0;
        let seconds = 5.0;
        gpu::prepare(&mut sky, &params, &viewer(Vec2::ZERO, Vec3::Y), seconds);
        let towards = sky.light(&params, seconds).sun.direction;
        let shadows = Shadows::of(&sky);
        let texels = (0..8).flat_map(|y| (0..8).map(move |x| [9 + 34 * x, 9 + 34 * y]));
        let pairs: Vec<[f32; 2]> = texels
            .map(|texel| {
                let there = viewer(shadows.place_m(texel), towards);
                let alpha = film.alpha(&params, &there, seconds)[(SEEN * SEEN / 2) as usize];
                [shadows.at(texel), 1.0 - alpha]
            })
            .collect();
        let count = pairs.len() as f32;
        let mean = |i: usize| pairs.iter().map(|pair| pair[i]).sum::<f32>() / count;
        let means = [mean(0), mean(1)];
        let moment = |i: usize, j: usize| {
            let products = pairs
                .iter()
                .map(|pair| (pair[i] - means[i]) * (pair[j] - means[j]));
            products.sum::<f32>() / count
        };
        let correlation = moment(0, 1) / (moment(0, 0) * moment(1, 1)).sqrt();
        println!("{name}: {means:?}, correlation {correlation:.3}");
        assert!(
            (means[0] - means[1]).abs() < 0.03 && correlation > 0.95,
            "{name}: {means:?} {correlation}"
        );
        assert!(
            moment(0, 0) > 0.05,
            "{name}: shade and light: {}",
            moment(0, 0)
        );
    }
}

/// Clouds of the dome behind stand behind the sprites.
#[test]
fn what_comes_through_sprites_and_the_dome_behind_is_the_product() {
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    let of = |sky: &mut Sky, method: Method, behind: Method| {
        let mut params = SkyParams {
            cover: 0.35,
            ..params_of(method, 0.4, 4000.0)
        };
        params.sprites.behind = behind;
        params.sprites.behind_cover = 0.35;
        gpu::prepare(sky, &params, &viewer(Vec2::ZERO, Vec3::Y), 7.0);
        Shadows::of(sky).texels
    };
    let alone = of(&mut sky, Method::Sprites, Method::Sprites);
    for behind in [Method::Packed, Method::Lit] {
        let both = of(&mut sky, Method::Sprites, behind);
        let dome = of(&mut sky, behind, behind);
        let product = alone.iter().zip(&dome).map(|(a, b)| a * b);
        let apart = both.iter().zip(product).map(|(found, p)| (found - p).abs());
        // A byte is rounded after each sprite that lies over another.
        let worst = apart.fold(0.0_f32, f32::max);
        assert!(worst < 12.0 / 255.0, "{behind:?}: {worst}");
        assert!(both.iter().sum::<f32>() < 0.9 * alone.iter().sum::<f32>());
    }
}

/// The application's own shader, by its twin: the texel's value at its middle, 1 outside, no step at the edge.
#[test]
fn the_applications_function_gives_texels_inside_and_1_outside() {
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    let place_m = Vec2::new(400.0, -900.0);
    gpu::prepare(
        &mut sky,
        &params(0.4, 2000.0),
        &viewer(place_m, Vec3::Y),
        4.0,
    );
    let shadows = Shadows::of(&sky);
    let map = shadows.texture();
    let at = |place: Vec2| shadow::cloud_shadow(&map, shadows.area, place);
    for texel in [[128, 128], [40, 60], [200, 90]] {
        let found = at(shadows.place_m(texel));
        assert!(
            (found - shadows.at(texel)).abs() < 1e-3,
            "{texel:?}: {found}"
        );
    }
    let (middle, half) = (shadows.centre_m, 0.5 * shadows.extent_m);
    for i in 0..64 {
        let out = Vec2::from_angle(i as f32 / 64.0 * TAU) * 1.5 * half;
        assert_eq!(at(middle + out), 1.0, "outside");
        let edge = out / out.abs().max_element() * half;
        assert!(
            1.0 - at(middle + 0.9999 * edge) < 0.01,
            "just inside the edge"
        );
    }
    assert_eq!(at(DVec2::splat(1e9).as_vec2()), 1.0);
    assert_eq!(
        shadow::cloud_shadow(&map, [0.0; 4], Vec2::ZERO),
        1.0,
        "no shadows at all"
    );
}

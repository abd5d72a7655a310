//! A frame is a pure function of pack, parameters, camera and seconds.

use welkin_pack::LayerKind;
use welkin_runtime::params::{LitLayer, LitParams, OctaveParams, Shading, SkyModel, SpriteParams};
use welkin_runtime::{Camera, Method, Sky, SkyParams};
use welkin_tests::{gpu, pack};

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
const SIZE: [u32; 2] = [64, 48];

/// A day in ten thousand seconds, with everything switched on.
fn params(method: Method, seconds: f64) -> SkyParams {
    SkyParams {
        method,
        speed: 1.0,
        time: (seconds / 1e4).rem_euclid(1.0) as f32,
        // The one thing that goes by what was before: tests/gpu/sprites.
        sprites: SpriteParams {
            ring_radius_m: 0.0,
            ..SpriteParams::default()
        },
        ..SkyParams::default()
    }
}

/// The view follows the sun's side round, and walks.
fn view(seconds: f64) -> Camera {
    let mut camera = Camera::looking(seconds as f32 * 1e-3, 0.5, 1.2, SIZE);
    camera.position_m = glam::Vec3::new(seconds as f32, 2.0, -0.5 * seconds as f32);
    camera
}

fn frame(sky: &mut Sky, method: Method, seconds: f64) -> Vec<[f32; 4]> {
    gpu::render(
        sky,
        FORMAT,
        &params(method, seconds),
        &view(seconds),
        seconds,
    )
}

/// Not nearly the same: the same.
fn assert_same(a: &[[f32; 4]], b: &[[f32; 4]], what: &str) {
    let differ = a.iter().zip(b).filter(|(a, b)| a != b).count();
    assert_eq!(differ, 0, "{what}: {differ} pixels differ");
}

#[test]
fn a_sky_that_went_through_a_film_draws_what_a_new_one_draws_at_once() {
    let late = 1e6;
    for method in Method::ALL {
        let mut old = gpu::sky(pack::default_pack(), FORMAT);
        for step in 0..40 {
            let seconds = if step < 30 {
                f64::from(step) * 33.3
            } else {
                late - f64::from(40 - step)
            };
            gpu::prepare(&mut old, &params(method, seconds), &view(seconds), seconds);
        }
        let mut new = gpu::sky(pack::default_pack(), FORMAT);
        let at_once = frame(&mut new, method, late);
        assert_same(&frame(&mut old, method, late), &at_once, method.name());
        // And back again.
        assert_same(
            &frame(&mut old, method, 5.0),
            &frame(&mut new, method, 5.0),
            method.name(),
        );
    }
}

#[test]
fn two_skies_in_turn_agree_and_switching_methods_changes_nothing() {
    let mut skies = [0, 1].map(|_| gpu::sky(pack::default_pack(), FORMAT));
    let alone =
        Method::ALL.map(|method| frame(&mut gpu::sky(pack::default_pack(), FORMAT), method, 77.0));
    for round in 0..2 {
        for (method, expected) in Method::ALL.into_iter().zip(&alone) {
            for sky in &mut skies {
                let what = format!("{} in round {round}", method.name());
                assert_same(&frame(sky, method, 77.0), expected, &what);
            }
        }
    }
}

#[test]
fn another_model_of_the_clear_sky_and_back_is_the_same_sky() {
    for method in Method::ALL {
        let with = |sky: &mut Sky, model: SkyModel| {
            let params = SkyParams {
                sky: model,
                ..params(method, 4000.0)
            };
            gpu::render(sky, FORMAT, &params, &view(20.0), 20.0)
        };
        let mut sky = gpu::sky(pack::default_pack(), FORMAT);
        let [perez, gradient] =
            [SkyModel::Perez, SkyModel::Table].map(|model| with(&mut sky, model));
        assert_ne!(perez, gradient);
        let mut new = gpu::sky(pack::default_pack(), FORMAT);
        assert_same(&with(&mut new, SkyModel::Table), &gradient, method.name());
        assert_same(&with(&mut sky, SkyModel::Perez), &perez, method.name());
    }
}

/// With a low sun, which lights clouds from the side in every method, but not in their papers.
#[test]
fn another_shading_and_back_is_the_same_sky() {
    for method in Method::ALL {
        let with = |sky: &mut Sky, shading: Shading| {
            let params = SkyParams {
                shading,
                ..params(method, 2600.0)
            };
            gpu::render(sky, FORMAT, &params, &view(20.0), 20.0)
        };
        let mut sky = gpu::sky(pack::default_pack(), FORMAT);
        let [paper, scattered] =
            [Shading::Paper, Shading::Scattered].map(|shading| with(&mut sky, shading));
        assert_ne!(paper, scattered, "{}", method.name());
        let mut new = gpu::sky(pack::default_pack(), FORMAT);
        let fresh = with(&mut new, Shading::Scattered);
        assert_same(&fresh, &scattered, method.name());
        assert_same(&with(&mut sky, Shading::Paper), &paper, method.name());
    }
}

#[test]
fn another_count_of_octaves_and_back_is_the_same_sky() {
    let with = |sky: &mut Sky, count: u32| {
        let octaves = OctaveParams {
            count,
            ..OctaveParams::default()
        };
        let params = SkyParams {
            octaves,
            ..params(Method::Octaves, 20.0)
        };
        gpu::render(sky, FORMAT, &params, &view(20.0), 20.0)
    };
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    let four = with(&mut sky, 4);
    let seven = with(&mut sky, 7);
    assert_ne!(four, seven);
    assert_same(&with(&mut sky, 4), &four, "four octaves after seven");
}

#[test]
fn other_layers_and_back_are_the_same_sky() {
    let with = |sky: &mut Sky, count: usize| {
        let layers = LayerKind::ALL.repeat(2);
        let layers: Vec<_> = layers.iter().map(|kind| LitLayer::of(*kind, 0.5)).collect();
        let params = SkyParams {
            lit: LitParams::with_layers(&layers[..count]),
            ..params(Method::Lit, 20.0)
        };
        gpu::render(sky, FORMAT, &params, &view(20.0), 20.0)
    };
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    let two = with(&mut sky, 2);
    let six = with(&mut sky, 6);
    assert_ne!(two, six);
    assert_same(&with(&mut sky, 2), &two, "two layers after six");
    let mut new = gpu::sky(pack::default_pack(), FORMAT);
    assert_same(&with(&mut new, 6), &six, "six layers at once");
}

#[test]
fn what_another_method_is_told_changes_nothing() {
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    for method in Method::ALL {
        let defaults = params(method, 3000.0);
        let mut other = defaults;
        if method != Method::Octaves {
            other.octaves.sharpness = 0.5;
            other.octaves.count = 2;
        }
        if method != Method::Fbm {
            other.fbm = welkin_runtime::params::FbmParams::STORMY;
        }
        if !matches!(method, Method::Packed | Method::Sprites) {
            other.upper_layer = 1.0;
        }
        if method != Method::Sprites {
            other.sprites.behind = Method::Fbm;
            other.sprites.behind_cover = 0.5;
        }
        if method != Method::Lit {
            let layers = [LitLayer::of(LayerKind::Cirrus, 1.0)];
            other.lit = LitParams::with_layers(&layers);
            other.moon = 0.0;
        }
        let [a, b] = [defaults, other].map(|p| gpu::render(&mut sky, FORMAT, &p, &view(1.0), 1.0));
        assert_same(&a, &b, method.name());
    }
}

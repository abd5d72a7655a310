//! The air that an application's scene is seen through is the one that our own ground is seen through, and its shader says what the CPU does.

use glam::{Vec3, Vec3Swizzles};
use welkin_runtime::internals::pack_data::PackData;
use welkin_runtime::{Camera, SkyParams, air};
use welkin_tests::{gpu, pack};

use super::application;

/// Times and hazes.
const SKIES: [(f32, f32); 4] = [(0.5, 0.0), (0.7, 0.5), (0.742, 0.0), (0.95, 1.0)];

fn params((time, haze): (f32, f32)) -> SkyParams {
    SkyParams {
        time,
        haze,
        cover: 0.0,
        upper_layer: 0.0,
        ..SkyParams::default()
    }
}

/// Ways of a viewer: from and to, metres.
fn ways() -> Vec<[Vec3; 2]> {
    let mut ways = Vec::new();
    for height_m in [0.0, 60.0, 1500.0, 11_000.0] {
        for to in [
            Vec3::new(0.0, height_m, 0.0),
            Vec3::new(3.0, height_m + 0.5, -2.0),
            Vec3::new(800.0, 20.0, 900.0),
            Vec3::new(-20_000.0, 2500.0, 3000.0),
            Vec3::new(1e5, 0.0, -1e5),
        ] {
            ways.push([Vec3::new(0.0, height_m, 0.0), to]);
        }
    }
    ways
}

/// `air_between` on the device.
fn drawn(air: &air::Air, radiance: Vec3, ways: &[[Vec3; 2]]) -> Vec<Vec3> {
    let from = |end: usize| ways.iter().map(|way| way[end]).collect::<Vec<_>>();
    let function = format!(
        "{}
        @group(0) @binding(0) var<uniform> air: Air;
        fn asked(a: vec3f, b: vec3f) -> vec3f {{ return air_between(air, {}, a, b); }}",
        air::WGSL,
        application::vector(radiance),
    );
    application::asked(&function, &air.uniform(), [&from(0), &from(1)])
}

#[test]
fn the_shader_says_what_the_cpu_does() {
    let sky = gpu::sky(pack::default_pack(), wgpu::TextureFormat::Rgba16Float);
    let ways = ways();
    for setting in SKIES {
        let air = sky.light(&params(setting), 0.0).air;
        let radiance = Vec3::new(0.4, 0.2, 0.1);
        for (seen, [from, to]) in drawn(&air, radiance, &ways).into_iter().zip(&ways) {
            let expected = air.between(radiance, *from, *to);
            let off = (seen - expected).abs();
            // The exponentials of a GPU: 2^-11 of what they are of, and the ways' lengths.
            assert!(
                off.cmple(expected * 2e-3 + 1e-4).all(),
                "{setting:?} {from} {to}: {seen} {expected}"
            );
        }
    }
}

/// Towards the sun and away from it, where the horizon's colours are known, a place on the ground looks as our own does.
#[test]
fn the_ground_is_seen_through_the_same_air() {
    let data = PackData::new(pack::default_pack()).expect("the pack has every role");
    for setting in SKIES {
        let params = params(setting);
        let air = data.light(&params, 0.0).air;
        for height_m in [60.0, 800.0, 9000.0] {
            let camera = Camera {
                position_m: Vec3::new(0.0, height_m, 0.0),
                ..Camera::looking(0.0, 0.0, 1.0, [1, 1])
            };
            let uniforms = data.uniforms(&params, &camera, 0.0, 0.0);
            let sun = uniforms.sky.sun_direction;
            for (side, horizon) in [1.0, -1.0].into_iter().zip(air.horizon) {
                for depth in [0.005_f32, 0.05, 0.5] {
                    let azimuth = air.sun_azimuth * side;
                    let direction = Vec3::new(azimuth.x, -depth, azimuth.y).normalize();
                    let to = camera.position_m + direction * (height_m / -direction.y);
                    // What the ground has itself: what is seen through no air at all.
                    let bare = uniforms.ground.seen(Vec3::ZERO, direction, sun)
                        / air
                            .transmittance(camera.position_m, to)
                            .max(Vec3::splat(1e-20));
                    if bare.max_element() > 10.0 {
                        // Nothing of it is left.
                        continue;
                    }
                    let expected = uniforms.ground.seen(horizon, direction, sun);
                    let seen = air.between(bare, camera.position_m, to);
                    let off = (seen - expected).abs();
                    assert!(
                        off.cmple(expected * 1e-3 + 1e-5).all(),
                        "{setting:?} {height_m} {side} {depth}: {seen} {expected} {}",
                        to.xz()
                    );
                }
            }
        }
    }
}

//! The sky of Perez and others goes over to the night, and to the other model, without a step.

use glam::Vec3;
use welkin_pack::Role;
use welkin_runtime::internals::clear_sky::perez;
use welkin_runtime::internals::clear_sky::perez::PerezUniforms;
use welkin_runtime::internals::clear_sky::perez::TWILIGHT_END;
use welkin_runtime::internals::frame::Uniforms;
use welkin_runtime::internals::geometry::math::luminance;
use welkin_runtime::internals::pack_data::PackData;
use welkin_runtime::params::{PerezShape, SkyModel};
use welkin_runtime::{Camera, SkyParams};
use welkin_tests::perez::{colour, hemisphere, linear, overhead, time_of, uniforms};
use welkin_tests::texture::Texture;
use welkin_tests::{pack, sky};

/// A moment of a day, as it is seen in some directions.
struct Moment {
    /// Mean luminance of the gradient.
    level: f32,
    seen: Vec<Vec3>,
    /// The same of the gradient alone.
    gradient: Vec<Vec3>,
    /// The same of this model alone, its brightest channel.
    perez: Vec<f32>,
}

fn moment(facts: &PackData, shape: PerezShape, elevation_deg: f32, directions: &[Vec3]) -> Moment {
    let time = time_of(elevation_deg);
    let params = SkyParams {
        time,
        ..SkyParams::default()
    };
    let texture = sky::texture(facts, &params);
    let clouds = Texture::new(pack::default_pack(), Role::Clouds);
    let frame = uniforms(facts, shape, 2.5, time);
    let alone = Uniforms {
        perez: PerezUniforms::default(),
        ..frame
    };
    let look = |frame: &Uniforms| {
        let seen = |d: &Vec3| sky::radiance(frame, &texture, &clouds, *d);
        directions.iter().map(seen).collect::<Vec<_>>()
    };
    let perez = |d: &Vec3| match frame.perez.weight {
        0.0 => 0.0,
        _ => linear(colour(&frame.perez, *d)).max_element(),
    };
    Moment {
        level: luminance(facts.lit_sky(&params, 0.0).light.skylight),
        seen: look(&frame),
        gradient: look(&alone),
        perez: directions.iter().map(perez).collect(),
    }
}

/// From the zenith to the nadir, in frames 0.1 degree of the sun apart.
#[test]
fn no_step_is_seen_while_the_sun_goes_from_the_zenith_to_the_nadir() {
    let pack = overhead();
    let facts = PackData::new(&pack).unwrap();
    let directions: Vec<Vec3> = hemisphere(5, 8)
        .chain([Vec3::Y, Vec3::X, -Vec3::X])
        .collect();
    for shape in [
        PerezShape::Preetham,
        PerezShape::Cie(1),
        PerezShape::Cie(12),
        PerezShape::Cie(15),
    ] {
        let of = |elevation: f32| moment(&facts, shape, elevation, &directions);
        let mut last = of(90.0);
        for step in 1..=1800 {
            let elevation_deg = 90.0 - step as f32 * 0.1;
            let now = of(elevation_deg);
            let levels = (now.level - last.level).abs() / last.level.min(now.level);
            for (i, towards) in directions.iter().enumerate() {
                let apart = (now.seen[i] - last.seen[i]).abs().max_element();
                let gradients = (now.gradient[i] - last.gradient[i]).abs().max_element();
                let perez = now.perez[i].max(last.perez[i]);
                let brighter = now.gradient[i]
                    .max(last.gradient[i])
                    .max_element()
                    .max(perez);
                // The gradient's own change. The level's. The distribution's, exponents of 3 a radian in f and in
                // its mean, and half of that for the colours: 1.5 %. The share's, 1.5 times 0.1 of 6 degrees: 2.5 %.
                let bound = gradients + perez * (levels + 0.015) + 0.025 * brighter;
                let seen = [last.seen[i], now.seen[i]];
                assert!(
                    apart <= bound + 1e-5,
                    "{shape:?} at {elevation_deg}, {towards}: {seen:?}"
                );
                assert!(seen[1].is_finite() && seen[1].min_element() >= 0.0);
            }
            last = now;
        }
    }
}

#[test]
fn by_night_and_with_the_other_model_nothing_is_left_of_it() {
    assert_eq!([perez::share(0.0), perez::share(1.0)], [1.0, 1.0]);
    assert_eq!(
        [perez::share(-TWILIGHT_END), perez::share(-1.0)],
        [0.0, 0.0]
    );
    assert!((TWILIGHT_END - 6.0_f32.to_radians().sin()).abs() < 1e-7);
    let facts = PackData::new(pack::default_pack()).unwrap();
    let of = |sky: SkyModel, time: f32| {
        let params = SkyParams {
            sky,
            time,
            ..SkyParams::default()
        };
        let camera = Camera::looking(0.0, 0.0, 1.0, [64, 48]);
        facts.uniforms(&params, &camera, 0.0, 0.0).perez
    };
    let none = PerezUniforms::default();
    assert_eq!(
        [of(SkyModel::Perez, 0.0), of(SkyModel::Table, 0.5)],
        [none; 2]
    );
    assert_ne!(of(SkyModel::Perez, 0.5), none);
}

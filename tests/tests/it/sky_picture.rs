//! The picture that the shader reads the clear sky from shows the sky of the table.

use std::f32::consts::PI;

use glam::{Vec2, Vec3};
use welkin_pack::Role;
use welkin_runtime::SkyParams;
use welkin_runtime::internals::clear_sky::table::aureole_lobe;
use welkin_runtime::internals::geometry::math::luminance;
use welkin_runtime::internals::pack_data::PackData;
use welkin_runtime::{Camera, internals::clear_sky::table::SkySample};
use welkin_tests::texture::Texture;
use welkin_tests::{pack, sky, tonemap};

/// At every texel of the table, from noon to the end of nautical twilight, what a display shows is nearer than a byte.
#[test]
fn it_is_the_tables_sky_to_a_byte() {
    let data = PackData::new(pack::default_pack()).expect("the pack has every role");
    let clouds = Texture::new(pack::default_pack(), Role::Clouds);
    let mut worst = 0.0_f32;
    for (step, haze) in (0..=60).flat_map(|step| [0.0, 0.3, 1.0].map(|haze| (step, haze))) {
        let params = SkyParams {
            time: 0.5 + step as f32 / 200.0,
            haze,
            cover: 0.0,
            ..SkyParams::default()
        };
        let lit = data.lit_sky(&params, 0.0);
        if lit.light.is_moon {
            continue;
        }
        let camera = Camera::looking(PI, 0.3, 1.0, [64, 64]);
        let uniforms = data.uniforms(&params, &camera, 0.0, 0.0);
        let texture = sky::texture(&data, &params);
        let azimuth = uniforms.sky.azimuth;
        let mut below = Vec3::ZERO;
        for at in data.sky.samples(&lit.view) {
            if at.azimuth_cos == 1.0 {
                below = at.aureole;
            }
            let direction = direction(&at, azimuth);
            let cosine = direction.dot(lit.light.sun_direction);
            let share = luminance(at.aureole) / luminance(below).max(1e-9);
            let phase = aureole_lobe(0, cosine) + aureole_lobe(1, cosine);
            let wanted = at.radiance + below * (share.min(4.0) * phase);
            let shown = sky::radiance(&uniforms, &texture, &clouds, direction);
            let [shown, wanted] = [shown, wanted].map(|r| tonemap::to_bytes(r, &params));
            let off = (shown - wanted).abs().max_element();
            worst = worst.max(off);
            assert!(
                off < 1.0,
                "{} {haze} {direction}: {shown} {wanted}",
                params.time
            );
        }
    }
    println!("off by {worst:.2} of a byte at most");
}

fn direction(at: &SkySample, azimuth: Vec2) -> Vec3 {
    let flat = (1.0 - at.sine * at.sine).max(0.0).sqrt();
    let across = (1.0 - at.azimuth_cos * at.azimuth_cos).max(0.0).sqrt();
    let place = azimuth * at.azimuth_cos + azimuth.perp() * across;
    Vec3::new(flat * place.x, at.sine, flat * place.y)
}

//! Twin of clear_sky/table.wgsl and clear_sky/ground.wgsl.

use glam::{Vec2, Vec3, Vec3Swizzles};
use welkin_pack::air::AUREOLE_LOBES;
use welkin_pack::role::Wrap;
use welkin_runtime::SkyParams;
use welkin_runtime::internals::clear_sky::ground::{BACKSCATTER, FINER, MOTTLING};
use welkin_runtime::internals::clear_sky::picture::BEND;
use welkin_runtime::internals::clear_sky::table::{AUREOLE_END, AUREOLE_LEAST};
use welkin_runtime::internals::frame::Uniforms;
use welkin_runtime::internals::pack_data::PackData;

use crate::perez;
use crate::texture::Texture;

/// The picture that the shader reads the clear sky of a moment from.
pub fn texture(data: &PackData, params: &SkyParams) -> Texture {
    let view = data.lit_sky(&params.clamped(), 0.0).view;
    Texture::from_levels(vec![view.image()], Wrap::Clamp)
}

/// Radiance of the sky behind the clouds along a unit direction above the horizon; below it, that of the horizon.
pub fn above(uniforms: &Uniforms, texture: &Texture, direction: Vec3) -> Vec3 {
    let sky = &uniforms.sky;
    let light = perez::light(
        &uniforms.perez,
        direction,
        table(uniforms, texture, direction),
    );
    let low = 1.0 - direction.y.clamp(0.0, 1.0);
    let slit = 1.0 + sky.slit * low.powi(6);
    light.lerp(sky.overcast * slit, sky.overcast_weight)
}

/// Radiance of the clear sky along a unit direction, or of the ground, whose pattern is in the texture of the clouds.
pub fn radiance(uniforms: &Uniforms, texture: &Texture, clouds: &Texture, direction: Vec3) -> Vec3 {
    let sky = &uniforms.sky;
    let light = above(uniforms, texture, direction);
    if direction.y >= 0.0 {
        return light;
    }
    let ground = &uniforms.ground;
    let away = 1.0 / (-direction.y).max(1e-6);
    let uv = ground.place + direction.xz() * (away * ground.height_tiles);
    let level = ground.lod + 1.5 * libm::log2f(away);
    let noise = clouds.sample(uv.to_array(), level)[2] - ground.mean;
    let finer_level = level + libm::log2f(FINER);
    let finer = clouds.sample((uv * FINER).to_array(), finer_level)[2] - ground.mean;
    let facing = 1.0 - BACKSCATTER * direction.dot(sky.sun_direction);
    let lit = ground.skylit + ground.sunlit * (facing / (ground.sun_sin - direction.y));
    let pattern = 1.0 + MOTTLING * noise;
    let radiance = lit * pattern * (1.0 + ground.finer_mottling * finer);
    let through = Vec3::from((-ground.depth * away).to_array().map(libm::exp2f));
    light + (radiance - light) * through
}

fn table(uniforms: &Uniforms, texture: &Texture, direction: Vec3) -> Vec3 {
    let sky = &uniforms.sky;
    let up = direction.y.clamp(0.0, 1.0);
    let flat = match direction.y < 0.0 {
        true => direction.xz().length().max(1e-6),
        false => 1.0,
    };
    let sideways = direction.xz().dot(uniforms.sky.azimuth) / flat;
    let place = Vec2::new(sideways, up.sqrt() * (1.0 + BEND * up));
    let uv = sky.start + sky.span * place;
    let texel = texture.sample(uv.to_array(), 0.0);
    let below_sun = texture.sample([sky.aureole_u, uv.y], 0.0);
    let colour = Vec3::from_slice(&below_sun[..3]);
    let cosine = direction.dot(sky.sun_direction).min(1.0);
    Vec3::from_slice(&texel[..3]) + colour * (texel[3] * aureole(cosine))
}

/// Henyey and Greenstein's lobes, in 64 bits.
fn aureole(cosine: f32) -> f32 {
    let lobe = |[weight, g]: [f32; 2]| {
        let (weight, g) = (f64::from(weight), f64::from(g));
        let base = 1.0 + g * g - 2.0 * g * f64::from(cosine);
        weight * (1.0 - g * g) / (4.0 * std::f64::consts::PI * base * libm::sqrt(base))
    };
    let [narrow, wide] = AUREOLE_LOBES.map(lobe);
    match cosine > AUREOLE_END {
        true => (wide + narrow) as f32 - AUREOLE_LEAST,
        false => wide as f32,
    }
}

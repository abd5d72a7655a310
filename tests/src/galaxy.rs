//! Twin of galaxy.wgsl.

use glam::{Vec2, Vec3};
use welkin_pack::mapping;
use welkin_runtime::internals::clear_sky::galaxy::GRAIN_SCALE;
use welkin_runtime::internals::clear_sky::galaxy::GalaxyUniforms;

use crate::texture::Texture;

/// Brightness of the galaxy along a unit direction above the horizon.
pub fn brightness(
    uniforms: &GalaxyUniforms,
    texture: &Texture,
    clouds: &Texture,
    direction: Vec3,
) -> f32 {
    let direction = direction.to_array();
    let [stored, ..] = texture.sample(mapping::direction_to_galaxy_uv(direction), 0.0);
    let plane = Vec2::from(mapping::direction_to_dome(direction));
    let [_, noise, detail, _] = clouds.sample((plane * GRAIN_SCALE).to_array(), uniforms.grain_lod);
    stored * stored * (uniforms.plain + uniforms.noise * noise + uniforms.detail * detail)
}

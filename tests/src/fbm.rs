//! Twin of fbm.wgsl.

use glam::{Vec2, Vec3};
use welkin_runtime::clouds::fbm::{FINER, FINER_START, FULL, ROUGH_SHADE};

use crate::clouds::{self, Inputs};
use crate::dome;
use crate::texture::smoothstep;
use crate::vector::xyz;

/// See [`crate::methods::layer`]. Reads: shade, cover, finer sum.
pub fn layer(inputs: &Inputs, direction: Vec3, narrowing: f32) -> (Vec3, f32) {
    let (fbm, uniforms) = (&inputs.uniforms.fbm, &inputs.uniforms.clouds);
    let hit = dome::intersect(direction);
    let [offset_x, offset_y, level, _] = fbm.place;
    let level = clouds::level(&hit, narrowing) + level;
    let [east_u, east_v, south_u, south_v] = fbm.axes;
    let uv = Vec2::new(east_u, east_v) * hit.plane.x
        + Vec2::new(south_u, south_v) * hit.plane.y
        + Vec2::new(offset_x, offset_y);
    let [shade, _, _, cover] = inputs.map_at(uv.to_array(), level);
    let (shade, cover) = (shade + inputs.nudges[0], cover + inputs.nudges[1]);
    let finer_uv = uv * FINER + Vec2::from(FINER_START);
    let [_, sum, ..] = inputs.map_at(finer_uv.to_array(), level + libm::log2f(FINER));
    let finer = sum + inputs.nudges[2] - fbm.step[2];
    let rough = 4.0 * fbm.shaded[3] * finer * cover * (1.0 - cover);
    let shade = (fbm.lit[3] * (shade + ROUGH_SHADE * finer * cover)).clamp(0.0, 1.0);
    let tint = Vec3::ONE.lerp(
        xyz(uniforms.tint),
        clouds::tint(uniforms, inputs.clouds, direction),
    );
    let colour = xyz(fbm.lit).lerp(xyz(fbm.shaded), shade) * tint;
    (
        colour * (xyz(uniforms.sunlight) + xyz(uniforms.ambient)),
        smoothstep(0.0, FULL, cover + rough) * clouds::clearness(uniforms, direction),
    )
}

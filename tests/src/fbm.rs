//! Twin of fbm.wgsl.

use glam::{Vec2, Vec3};
use welkin_runtime::internals::clouds::fbm::{DEPTH, FINER, FINER_START, FULL, ROUGH_SHADE, THICK};
use welkin_runtime::params::Shading;

use crate::clouds::{self, Inputs};
use crate::dome;
use crate::texture::smoothstep;

/// See [`crate::methods::layer`]. Reads: shade, cover, finer sum.
pub fn layer(inputs: &Inputs, direction: Vec3, narrowing: f32) -> (Vec3, f32) {
    let (fbm, uniforms) = (&inputs.uniforms.fbm, &inputs.uniforms.clouds);
    let hit = dome::intersect(direction);
    let level = clouds::level(&hit, narrowing) + fbm.lod_bias;
    let uv = fbm.east_axis * hit.plane.x + fbm.south_axis * hit.plane.y + fbm.offset;
    let [shade, _, _, cover] = inputs.map_at(uv.to_array(), level);
    let (shade, cover) = (shade + inputs.nudges[0], cover + inputs.nudges[1]);
    let finer_uv = uv * FINER + Vec2::from(FINER_START);
    let [_, sum, ..] = inputs.map_at(finer_uv.to_array(), level + libm::log2f(FINER));
    let finer = sum + inputs.nudges[2] - fbm.mean;
    let rough = 4.0 * fbm.roughness * finer * cover * (1.0 - cover);
    let shade = (fbm.shade_strength * (shade + ROUGH_SHADE * finer * cover)).clamp(0.0, 1.0);
    let tint = Vec3::ONE.lerp(
        uniforms.tint,
        clouds::tint(uniforms, inputs.clouds, direction),
    );
    let colour = fbm.lit.lerp(fbm.shaded, shade);
    let alpha = smoothstep(0.0, FULL, cover + rough);
    let light = match inputs.shading {
        Shading::Scattered => {
            let [sunlit, skylit] =
                clouds::scattered(inputs.uniforms, direction, DEPTH * shade, THICK * cover);
            fbm.lit * sunlit * uniforms.sunlight + colour * skylit * uniforms.ambient
        }
        Shading::Paper => colour * (uniforms.sunlight + uniforms.ambient),
    };
    (light * tint, alpha * clouds::clearness(uniforms, direction))
}

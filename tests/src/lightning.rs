//! Twin of lightning.wgsl.

use glam::Vec3;
use welkin_runtime::internals::frame::Uniforms;
use welkin_runtime::internals::geometry::math::luminance;
use welkin_runtime::internals::weather::lightning::{CORE, SPREAD, THIN};

use crate::dome;

/// What a flash adds to clouds of this radiance and opacity along a unit direction above the horizon.
pub fn light(uniforms: &Uniforms, direction: Vec3, radiance: Vec3, opacity: f32) -> Vec3 {
    let flash = &uniforms.lightning;
    let apart = (dome::intersect(direction).plane - flash.position).length();
    let [core, wide] = SPREAD.map(|spread| spread * apart * apart);
    let glow = CORE * libm::exp2f(-core) + 1.0 / ((1.0 + wide) * (1.0 + wide));
    let brightness = (luminance(radiance) * flash.per_white).clamp(0.0, 1.0);
    flash.light * (glow * opacity * opacity * (1.0 - THIN * brightness))
}

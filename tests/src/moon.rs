//! Twin of moon.wgsl.

use glam::{Vec3, Vec4};
use welkin_runtime::internals::clear_sky::sun::HORIZON;
use welkin_runtime::internals::frame::Uniforms;

use crate::sun::disc_shown;
use crate::texture::smoothstep;

/// Radiance of the moon's disc along a unit direction, of which a share comes through, and how far it covers what is behind it.
pub fn seen(uniforms: &Uniforms, direction: Vec3, share: f32) -> Vec4 {
    let moon = &uniforms.moon;
    if direction.dot(moon.direction) <= moon.least_cosine {
        return Vec4::ZERO;
    }
    let [x, y] = [direction.dot(moon.right), direction.dot(moon.up)];
    let away = x.hypot(y);
    let covered = 1.0 - smoothstep(1.0 - moon.edge, 1.0 + moon.edge, away);
    let towards = (1.0 - away * away).max(0.0).sqrt();
    let sunny = moon.sunwards.dot(Vec3::new(x, y, towards)).max(0.0);
    let lit = 2.0 * sunny / (sunny + towards).max(1e-4);
    let risen = smoothstep(-HORIZON, HORIZON, direction.y);
    let light = share * (moon.lit * lit + moon.earthlit);
    (disc_shown(uniforms, light) * (covered * risen)).extend(covered)
}

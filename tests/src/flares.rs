//! Twin of flares.wgsl.

use glam::{Vec2, Vec3};
use welkin_runtime::Method;

use crate::clouds::Inputs;
use crate::methods;
use crate::texture::Texture;

/// What the clouds leave of the sun.
pub fn clearness(method: Method, inputs: &Inputs) -> f32 {
    let uniforms = inputs.uniforms;
    let (sun, around) = (uniforms.sky.sun_direction, uniforms.flares.sun_radius);
    let right = uniforms.camera.right.normalize() * around;
    let up = uniforms.camera.up.normalize() * around;
    let cover = |towards: Vec3| {
        let direction = towards.normalize();
        let direction = Vec3::new(direction.x, direction.y.max(0.0), direction.z);
        let narrowing = direction.dot(uniforms.camera.clip_w.truncate());
        methods::layer(method, inputs, direction, narrowing).1
    };
    let looks = [sun, sun, sun + right, sun - right, sun + up, sun - up];
    1.0 - looks.map(cover).iter().sum::<f32>() / 6.0
}

/// What the flare adds to a pixel, if nothing of the sun is hidden. `atlas` are the pack's flares.
pub fn light(inputs: &Inputs, atlas: &Texture, pixel: Vec2) -> Vec3 {
    let (flares, camera) = (&inputs.uniforms.flares, &inputs.uniforms.camera);
    let size = Vec2::new(camera.width_px, camera.height_px);
    let clip = Vec2::new(2.0, -2.0) * (pixel / size) + Vec2::new(-1.0, 1.0);
    let mut sum = Vec3::ZERO;
    for square in &flares.squares {
        // From the upper left corner of the square, 0..1.
        let from_middle = clip - square.position;
        let place = from_middle / (Vec2::new(2.0, -2.0) * square.half_size) + 0.5;
        if place.min_element() >= 0.0 && place.max_element() < 1.0 {
            let uv = square.cell + square.cell_size * place;
            let light = atlas.sample(uv.to_array(), square.lod)[0];
            sum += square.colour * (square.opacity * flares.strength * light);
        }
    }
    sum
}

//! Twin of flares.wgsl.

use glam::{Vec2, Vec3};
use welkin_runtime::Method;

use crate::clouds::Inputs;
use crate::methods;
use crate::texture::Texture;
use crate::vector::xyz;

/// What the clouds leave of the sun.
pub fn clearness(method: Method, inputs: &Inputs) -> f32 {
    let uniforms = inputs.uniforms;
    let (sun, around) = (xyz(uniforms.sky.sun), uniforms.flares.light[1]);
    let right = xyz(uniforms.camera.right).normalize() * around;
    let up = xyz(uniforms.camera.up).normalize() * around;
    let cover = |towards: Vec3| {
        let direction = towards.normalize();
        let direction = Vec3::new(direction.x, direction.y.max(0.0), direction.z);
        let narrowing = direction.dot(xyz(uniforms.camera.clip_w));
        methods::layer(method, inputs, direction, narrowing).1
    };
    let looks = [sun, sun, sun + right, sun - right, sun + up, sun - up];
    1.0 - looks.map(cover).iter().sum::<f32>() / 6.0
}

/// What the flare adds to a pixel, if nothing of the sun is hidden. `atlas` are the pack's flares.
pub fn light(inputs: &Inputs, atlas: &Texture, pixel: Vec2) -> Vec3 {
    let (flares, camera) = (&inputs.uniforms.flares, &inputs.uniforms.camera);
    let size = Vec2::new(camera.right[3], camera.up[3]);
    let clip = Vec2::new(2.0, -2.0) * (pixel / size) + Vec2::new(-1.0, 1.0);
    let squares = flares.places.iter().zip(flares.colours).zip(flares.cells);
    let mut sum = Vec3::ZERO;
    for ((&[x, y, half_x, half_y], colour), [u, v, side, level]) in squares {
        // From the upper left corner of the square, 0..1.
        let place = (clip - Vec2::new(x, y)) / Vec2::new(2.0 * half_x, -2.0 * half_y) + 0.5;
        if place.min_element() >= 0.0 && place.max_element() < 1.0 {
            let uv = Vec2::new(u, v) + side * place;
            let light = atlas.sample(uv.to_array(), level)[0];
            sum += xyz(colour) * (colour[3] * flares.light[0] * light);
        }
    }
    sum
}

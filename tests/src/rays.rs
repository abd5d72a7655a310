//! Twin of rays.wgsl: the three maps one after the other, each rounded to bytes as the device rounds it.

use std::f32::consts::TAU;

use glam::{Vec2, Vec3};
use welkin_pack::Image;
use welkin_pack::role::Wrap;
use welkin_runtime::Method;
use welkin_runtime::internals::weather::rays::RayUniforms;
use welkin_runtime::internals::weather::rays::{
    AROUND, CORE, DECAY, GAIN, GROUND, HORIZON, REACH, SIZE, SOURCE, TAPS, TEXEL_RAD, WINDOW,
};

use crate::clouds::Inputs;
use crate::methods;
use crate::texture::{Texture, smoothstep};

/// The byte that is neither bright nor dark.
const NEITHER: f32 = 128.0;

/// The streaks of a frame.
pub fn streaks(method: Method, inputs: &Inputs) -> Texture {
    let mask = map(|place| mask(method, inputs, place));
    let sum = map(|place| sum(&mask, place));
    map(|place| [streak(&sum, place), 0.0])
}

/// A map of two channels. Places are in texels, their middles at halves.
fn map(texel: impl Fn(Vec2) -> [f32; 2]) -> Texture {
    let [width, height] = SIZE;
    let mut image = Image::new(width, height, 2);
    for (i, out) in (0..).zip(image.texels.chunks_exact_mut(2)) {
        let place = Vec2::new((i % width) as f32 + 0.5, (i / width) as f32 + 0.5);
        let bytes = texel(place).map(|v| (v.clamp(0.0, 1.0) * 255.0).round());
        out.copy_from_slice(&bytes.map(|byte| byte / 255.0));
    }
    Texture::from_levels(vec![image], Wrap::Repeat)
}

/// A place in texels as texture coordinates: turns around the sun, and the share of the reach.
fn uv(place: Vec2) -> Vec2 {
    place / Vec2::new(SIZE[0] as f32, SIZE[1] as f32)
}

/// The unit direction that lies so many turns around the sun, so far away from it.
pub fn direction(rays: &RayUniforms, [turns, share]: [f32; 2]) -> Vec3 {
    let angle_rad = 2.0 * libm::asinf(0.5 * share * REACH);
    let around = rays.right * libm::cosf(TAU * turns) + rays.up * libm::sinf(TAU * turns);
    rays.sun_direction * libm::cosf(angle_rad) + around * libm::sinf(angle_rad)
}

fn mask(method: Method, inputs: &Inputs, place: Vec2) -> [f32; 2] {
    let rays = &inputs.uniforms.rays;
    let [turns, share] = uv(place).to_array();
    let direction = direction(rays, [turns, share]);
    if direction.y <= 0.0 {
        return [0.0; 2];
    }
    let texel_rad = (TEXEL_RAD[0] * share).max(TEXEL_RAD[1]);
    let (_, opacity) = methods::layer(method, inputs, direction, texel_rad * rays.pixels_per_rad);
    let weight = smoothstep(0.0, HORIZON, direction.y);
    [weight * (1.0 - opacity), weight]
}

/// Mitchell's sum, over that of a clear sky; and how much of it is in the sky.
fn sum(mask: &Texture, place: Vec2) -> [f32; 2] {
    let [turns, share] = uv(place).to_array();
    let (mut through, mut sky, mut all) = (0.0, 0.0, 0.0);
    for i in 0..TAPS {
        let nearer = share * (TAPS as f32 - i as f32 - 0.5) / TAPS as f32;
        let row = nearer.max(0.5 / SIZE[1] as f32);
        let weight = libm::powf(DECAY, i as f32) / (1.0 + SOURCE * nearer * nearer);
        let [left, of, ..] = mask.sample([turns, row], 0.0);
        through += weight * left;
        sky += weight * of;
        all += weight;
    }
    [through / sky.max(1e-3), sky / all]
}

fn streak(sum: &Texture, place: Vec2) -> f32 {
    let [turns, share] = uv(place).to_array();
    let (mut mean, mut all) = (0.0, 1e-3);
    for i in 0..AROUND {
        let away = 2.0 * (i as f32 + 0.5) / AROUND as f32 - 1.0;
        let [light, sky, ..] = sum.sample([turns + away * WINDOW, share], 0.0);
        let weight = (1.0 - away * away) * sky;
        mean += weight * light;
        all += weight;
    }
    let [light, sky, ..] = sum.sample([turns, share], 0.0);
    let contrast = (GAIN * (light - mean / all) * sky).clamp(-1.0, 1.0);
    (NEITHER + (255.0 - NEITHER) * contrast) / 255.0
}

/// How bright, above 0, or dark the rays are in a place of their map.
pub fn contrast(streaks: &Texture, place: [f32; 2]) -> f32 {
    let [byte, ..] = streaks.sample(place, 0.0);
    (255.0 * byte - NEITHER) / (255.0 - NEITHER)
}

/// Colour and opacity of the haze along a ray.
pub fn haze(rays: &RayUniforms, streaks: &Texture, ray: Vec3) -> (Vec3, f32) {
    let direction = ray.normalize();
    let away = direction - rays.sun_direction;
    let chord = away.length();
    if chord >= REACH {
        return (Vec3::ZERO, 0.0);
    }
    let turns = libm::atan2f(away.dot(rays.up), away.dot(rays.right)) / TAU;
    let half_row = 0.5 / SIZE[1] as f32;
    let row = (chord / REACH).clamp(half_row, 1.0 - half_row);
    let contrast = contrast(streaks, [turns, row]);
    let glow = libm::exp2f(-rays.fall * chord)
        * smoothstep(0.0, CORE, chord)
        * (1.0 - smoothstep(0.5 * REACH, REACH, chord))
        * smoothstep(-GROUND, 0.0, direction.y);
    let colour = if contrast > 0.0 {
        rays.bright
    } else {
        rays.dark
    };
    (colour, rays.opacity * glow * contrast.abs())
}

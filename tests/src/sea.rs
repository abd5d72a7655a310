//! Twin of clear_sky/sea.wgsl.

use std::f32::consts::TAU;

use glam::{Vec2, Vec3, Vec3Swizzles};
use welkin_runtime::Method;
use welkin_runtime::internals::clear_sky::sea::{
    ACROSS, FINER, GUSTS, LEAST_RISE, SEEN, SHARES, SPREAD, WATER,
};

use crate::clouds::Inputs;
use crate::texture::Texture;
use crate::{clouds, methods, sky};

/// Reads of the waves, whose nudges stand behind those of the clouds: wind, three waves.
pub const READS: usize = 4;

/// What is seen along a direction below the horizon.
pub fn seen(method: Method, inputs: &Inputs, texture: &Texture, direction: Vec3) -> Vec3 {
    let (uniforms, nudges) = (inputs.uniforms, inputs.nudges);
    let (ground, sea) = (&uniforms.ground, &uniforms.sea);
    let nudges = &nudges[nudges.len() - READS..];
    let down = (-direction.y).max(1e-6);
    let flat = direction.xz().length();
    let heading = direction.xz() / flat;
    let uv = ground.place + direction.xz() * (ground.height_tiles / down);
    let level = ground.lod - 1.5 * libm::log2f(down);
    let wave = |times: Vec2, drift: Vec2, nudge: usize| {
        let place = uv * times + drift;
        let level = level + 0.5 * libm::log2f(times.x * times.y);
        inputs.clouds.sample(place.to_array(), level)[2] + nudges[nudge] - ground.mean
    };
    let gust = (1.0 + GUSTS * wave(Vec2::ONE, Vec2::ZERO, 0)).max(0.3);
    let drifts = [sea.long_drift, sea.short_drift, -sea.short_drift];
    let waves = (0..3).map(|i| SHARES[i] * wave(Vec2::new(FINER[i], ACROSS[i]), drifts[i], 1 + i));
    let ripple = sea.ripple * gust * waves.sum::<f32>();
    let alone = (1.0 - (level + libm::log2f(FINER[2])) / SEEN[1]).clamp(0.0, 1.0);
    let deviation = sea.deviation * gust * (1.0 - SEEN[0] * alone);
    let x = down / (deviation * flat);
    let share = 1.0 / (1.0 + libm::expf(-1.702 * x));
    let over = x * share + libm::expf(-0.5 * x * x) / TAU.sqrt();
    let lean = deviation * share / over + ripple;

    let (mut reflected, mut shares) = (Vec3::ZERO, 0.0);
    for side in [-SPREAD, SPREAD] {
        let slope = lean + side * deviation;
        let normal = Vec3::new(-slope * heading.x, 1.0, -slope * heading.y).normalize();
        let cosine = (-direction.dot(normal)).max(0.0);
        let mut back = direction + 2.0 * cosine * normal;
        back.y = back.y.max(LEAST_RISE);
        let back = back.normalize();
        let [depth, height] = sea.middling.to_array();
        let [sunlit, _] = clouds::scattered(uniforms, back, depth, height);
        let mean = sunlit * sea.cloud_sunlit + sea.cloud_skylit;
        let opacity = sea.cloud_opacity * clouds::clearness(&uniforms.clouds, back);
        let share = 0.5 * fresnel(cosine);
        reflected += share * sky::above(uniforms, texture, back).lerp(mean, opacity);
        shares += share;
    }
    let sun = uniforms.sky.sun_direction;
    let between = (sun - direction).normalize();
    let mut glitter = Vec3::ZERO;
    if sun.y > 0.0 && between.y > 0.05 {
        let hidden = methods::layer(method, inputs, sun, sea.softer).1;
        let slope = (between.xz() / between.y + ripple * heading) / deviation;
        let density = libm::expf(-0.5 * slope.length_squared()) / (TAU * deviation * deviation);
        let area = deviation * flat * over + sea.sun_hidden * down;
        let geometry = fresnel(between.dot(sun)) * density / (between.y.powi(4) * area);
        glitter = (1.0 - hidden) * geometry * sea.sun;
    }
    let lit = reflected + glitter + sea.body * (1.0 - shares);
    let through = Vec3::from((-ground.depth / down).to_array().map(libm::exp2f));
    let horizon = sky::above(uniforms, texture, direction);
    horizon + (lit - horizon) * through
}

fn fresnel(cosine: f32) -> f32 {
    WATER + (1.0 - WATER) * (1.0 - cosine).clamp(0.0, 1.0).powi(5)
}

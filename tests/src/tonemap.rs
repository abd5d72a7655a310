//! Twin of tonemap.wgsl, without the dither. The curves are the runtime's own on the CPU, which environment maps go through too.

use glam::Vec3;
use welkin_runtime::SkyParams;
use welkin_runtime::internals::tonemap::{displayed, srgb_encoded};

/// What an 8-bit target holds, 0..255, not rounded.
pub fn to_bytes(radiance: Vec3, params: &SkyParams) -> Vec3 {
    srgb_encoded(displayed(
        radiance * params.exposure_factor(),
        params.tonemap,
    )) * 255.0
}

/// How far the bytes move if each channel of the radiance is off by up to `may`, those of one channel after those of another: curves mix channels.
pub fn spread(radiance: Vec3, may: Vec3, params: &SkyParams) -> Vec3 {
    let here = to_bytes(radiance, params);
    let apart = |off: Vec3| (to_bytes(radiance + off, params) - here).abs();
    [Vec3::X, Vec3::Y, Vec3::Z]
        .map(|axis| apart(axis * may).max(apart(-axis * may)))
        .iter()
        .sum()
}

//! Twin of tonemap.wgsl, without the dither.

use glam::Vec3;
use welkin_runtime::internals::tonemap::{KNEE, SHOULDER};

/// The tone curve.
pub fn curve(radiance: Vec3) -> Vec3 {
    let x = radiance.max(Vec3::ZERO);
    let shoulder = x * x * SHOULDER;
    ((x + shoulder) / (1.0 + x * KNEE + shoulder)).min(Vec3::ONE)
}

/// Linear to sRGB, IEC 61966-2-1.
pub fn srgb_encode(linear: f32) -> f32 {
    if linear <= 0.003_130_8 {
        linear * 12.92
    } else {
        1.055 * libm::powf(linear, 1.0 / 2.4) - 0.055
    }
}

/// What an 8-bit target holds, 0..255, not rounded.
pub fn to_bytes(radiance: Vec3, exposure: f32) -> Vec3 {
    let display = curve(radiance * exposure);
    Vec3::from(display.to_array().map(srgb_encode)) * 255.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_curve_rises_from_the_origin_to_white_and_keeps_its_promises() {
        let at = |x: f32| curve(Vec3::splat(x)).x;
        assert_eq!(at(0.0), 0.0);
        assert!((at(1e-4) / 1e-4 - 1.0).abs() < 1e-3, "slope 1 in the dark");
        assert!(
            (0.92..0.95).contains(&srgb_encode(at(1.0))),
            "sunlit white is near white, not at it"
        );
        assert_eq!(at(1e9), 1.0);
        for i in 1..4000 {
            assert!(
                at(i as f32 * 1e-3) >= at((i - 1) as f32 * 1e-3),
                "rises at {i}"
            );
        }
    }
}

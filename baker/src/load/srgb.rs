//! The encoding of sRGB, IEC 61966-2-1.

/// Stored 0..1 to linear 0..1.
pub(super) fn decode(stored: f32) -> f32 {
    if stored <= 0.04045 {
        stored / 12.92
    } else {
        libm::powf((stored + 0.055) / 1.055, 2.4)
    }
}

/// Linear 0..1 to stored 0..1.
pub(super) fn encode(linear: f32) -> f32 {
    if linear <= 0.003_130_8 {
        linear * 12.92
    } else {
        1.055 * libm::powf(linear, 1.0 / 2.4) - 0.055
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_encoded_is_decoded() {
        for step in 0..=1000_u16 {
            let linear = f32::from(step) / 1000.0;
            assert!((decode(encode(linear)) - linear).abs() < 2e-5, "{linear}");
        }
    }
}

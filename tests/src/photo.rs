//! Twin of clouds/photo.wgsl.

use glam::Vec2;
use welkin_runtime::internals::clouds::photo::PhotoUniforms;
use welkin_runtime::internals::geometry::math::{NORMAL_BEND, NORMAL_SLOPE};

use crate::texture::Texture;

/// The share of a normal distribution below z, as the runtime approximates it.
pub fn normal_share(z: f32) -> f32 {
    0.5 + 0.5 * libm::tanhf(NORMAL_SLOPE * z * (1.0 + NORMAL_BEND * z * z))
}

/// The photograph, and how it is mixed into a method's map.
#[derive(Clone, Copy, Debug)]
pub struct Photo<'a> {
    /// The pack's clouds, whose first channel it is.
    pub clouds: &'a Texture,
    /// Its share of the uniforms.
    pub uniforms: PhotoUniforms,
}

impl Photo<'_> {
    /// How many deviations it lies over its mean.
    pub fn deviation(&self, uv: Vec2) -> f32 {
        let PhotoUniforms {
            level,
            mean,
            per_spread,
            ..
        } = self.uniforms;
        per_spread * (self.clouds.sample(uv.to_array(), level)[0] - mean)
    }

    /// What a method's own noise is multiplied by.
    pub fn rest(&self) -> f32 {
        libm::sqrtf(1.0 - self.uniforms.weight * self.uniforms.weight)
    }

    /// A normal number of variance 1 with the photo's large shapes.
    pub fn over(&self, z: f32, uv: Vec2) -> f32 {
        self.rest() * z + self.uniforms.weight * self.deviation(uv)
    }

    /// The photo's share of an evenly distributed blend, and its amount there.
    pub fn share(&self, uv: Vec2) -> [f32; 2] {
        let weight = self.uniforms.weight;
        [
            weight / (weight + self.rest()),
            normal_share(self.deviation(uv)),
        ]
    }

    /// By how much a deviation is off at most where a texture unit filters 8-bit texels in 8 bits.
    pub fn off(&self) -> f32 {
        self.uniforms.weight * self.uniforms.per_spread / 255.0
    }
}

/// An evenly distributed amount blended with another of a share, made even again.
pub fn over_even(amount: f32, [share, other]: [f32; 2]) -> f32 {
    match share == 0.0 {
        true => amount,
        false => even_blend(amount + (other - amount) * share, share),
    }
}

/// The share of places where two even numbers, of which the second has a share of the blend, are less than this: the area below a slanted line in
/// the unit square, as areas of triangles.
pub fn even_blend(blend: f32, share: f32) -> f32 {
    let triangle = |side: f32| 0.5 * side.max(0.0) * side.max(0.0);
    let outside = triangle(blend - share) + triangle(blend - (1.0 - share));
    (triangle(blend) - outside + triangle(blend - 1.0)) / (share * (1.0 - share))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_blend_with_a_photo_is_made_even() {
        let count = 300;
        let place = |i: i32| (i as f32 + 0.5) / count as f32;
        for share in [0.2, 0.5, 0.7] {
            // Of evenly distributed pairs, the share below each amount is the amount.
            let mut found: Vec<f32> = (0..count * count)
                .map(|i| over_even(place(i % count), [share, place(i / count)]))
                .collect();
            found.sort_by(f32::total_cmp);
            for (i, amount) in found.iter().enumerate().step_by(997) {
                let expected = i as f32 / found.len() as f32;
                assert!((amount - expected).abs() < 0.01, "{share}: {amount}");
            }
        }
        assert_eq!(over_even(0.3, [0.0, 0.9]), 0.3);
    }
}

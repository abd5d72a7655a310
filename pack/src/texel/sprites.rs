//! The texel of the role `sprites`.

use crate::texture::unorm8;

/// A texel of the role `sprites`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SpriteTexel {
    /// Shade of the cloud, 0..1; 0.5 is the mean over a sprite, so twice this is a factor on its light.
    pub grey: f32,
    /// Opacity, 0..1.
    pub alpha: f32,
}

impl SpriteTexel {
    /// The nearest RG8 texel.
    pub fn encode(self) -> [u8; 2] {
        [self.grey, self.alpha].map(unorm8)
    }

    /// Reads an RG8 texel.
    pub fn decode(bytes: [u8; 2]) -> SpriteTexel {
        let [grey, alpha] = bytes.map(|b| f32::from(b) / 255.0);
        SpriteTexel { grey, alpha }
    }
}

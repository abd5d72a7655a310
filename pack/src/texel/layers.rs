//! The texel of the role `layers`.

use crate::texture::unorm8;

/// A texel of the role `layers`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LayerTexel {
    /// Components along +u and +v of the unit normal of the cloud's upper surface, -1..1. The third,
    /// upwards, is the positive rest: [`LayerTexel::normal`].
    pub normal_xy: [f32; 2],
    /// Cloud amount, 0..1.
    pub density: f32,
    /// Share of the layer's texels that are thinner, 0..1.
    pub rank: f32,
}

impl LayerTexel {
    /// The nearest RGBA8 texel.
    pub fn encode(self) -> [u8; 4] {
        let [x, y] = self.normal_xy.map(|n| 0.5 + 0.5 * n);
        [x, y, self.density, self.rank].map(unorm8)
    }

    /// Reads an RGBA8 texel.
    pub fn decode(bytes: [u8; 4]) -> LayerTexel {
        let [x, y, density, rank] = bytes.map(|b| f32::from(b) / 255.0);
        LayerTexel {
            normal_xy: [x, y].map(|v| 2.0 * v - 1.0),
            density,
            rank,
        }
    }

    /// The unit normal along +u, along +v (down the rows) and upwards.
    pub fn normal(self) -> [f32; 3] {
        let [x, y] = self.normal_xy;
        [x, y, libm::sqrtf((1.0 - x * x - y * y).max(0.0))]
    }
}

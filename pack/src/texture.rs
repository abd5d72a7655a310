//! A texture as it is stored and uploaded: quantised texels, every level.

use half::f16;

use crate::format::{Format, Shape};
use crate::image::Image;

/// A texture with its mip levels, as tightly packed bytes.
///
/// A level holds its layers (or cube faces) one after another, each as rows from the top. Level `n` is
/// `max(1, width >> n)` by `max(1, height >> n)` texels.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Texture {
    /// Texel format.
    pub format: Format,
    /// Arrangement of the images of a level.
    pub shape: Shape,
    /// Texels a row of level 0.
    pub width: u32,
    /// Rows of level 0.
    pub height: u32,
    /// Images a level: 1 for a 2-D texture, 6 for a cube.
    pub layers: u32,
    /// Bytes of every level, largest first.
    pub levels: Vec<Vec<u8>>,
}

impl Texture {
    /// Width and height of a level.
    pub fn level_size(&self, level: usize) -> (u32, u32) {
        level_size(self.width, self.height, level)
    }

    /// How many levels a full chain down to one texel has.
    pub fn full_level_count(width: u32, height: u32) -> usize {
        (u32::BITS - width.max(height).leading_zeros()) as usize
    }

    /// Bytes that level `level` must have.
    pub fn level_bytes(&self, level: usize) -> usize {
        let (w, h) = self.level_size(level);
        w as usize * h as usize * self.layers as usize * self.format.bytes_per_texel()
    }

    /// One image of one level as linear floats: unorm bytes become `byte / 255`.
    ///
    /// # Panics
    /// If the level or the layer does not exist.
    pub fn image(&self, level: usize, layer: u32) -> Image {
        let (width, height) = self.level_size(level);
        let bytes = self.level_bytes(level) / self.layers as usize;
        let start = bytes * layer as usize;
        Image {
            width,
            height,
            channels: self.format.channels(),
            texels: decode(self.format, &self.levels[level][start..start + bytes]),
        }
    }

    /// All images of one level, one below the other, as one image.
    ///
    /// # Panics
    /// If the level does not exist.
    pub fn stacked(&self, level: usize) -> Image {
        let (width, height) = self.level_size(level);
        Image {
            width,
            height: height * self.layers,
            channels: self.format.channels(),
            texels: decode(self.format, &self.levels[level]),
        }
    }

    /// BLAKE3 of all decoded texels: level 0 first, each level as it is stored here.
    pub fn blake3(&self) -> blake3::Hash {
        let mut hasher = blake3::Hasher::new();
        for level in &self.levels {
            hasher.update(level);
        }
        hasher.finalize()
    }
}

/// Width and height of level `level` of a `width` x `height` texture.
pub fn level_size(width: u32, height: u32, level: usize) -> (u32, u32) {
    let shift = |n: u32| n.checked_shr(level as u32).unwrap_or(0).max(1);
    (shift(width), shift(height))
}

/// Quantises linear values to the bytes of `format`, rounding to nearest.
///
/// Unorm values are clamped to 0..1 (not a number becomes 0); halves round to nearest even and are
/// clamped to the largest finite half.
pub fn encode(format: Format, values: &[f32]) -> Vec<u8> {
    match format {
        Format::Rgba16Float => values
            .iter()
            .flat_map(|&v| f16::from_f32(finite_half(v)).to_le_bytes())
            .collect(),
        _ => values.iter().map(|&v| unorm8(v)).collect(),
    }
}

/// The inverse of [`encode`].
pub fn decode(format: Format, bytes: &[u8]) -> Vec<f32> {
    match format {
        Format::Rgba16Float => bytes
            .chunks_exact(2)
            .map(|b| f16::from_le_bytes([b[0], b[1]]).to_f32())
            .collect(),
        _ => bytes.iter().map(|&b| f32::from(b) / 255.0).collect(),
    }
}

/// The nearest of the 256 unorm steps; values outside 0..1 are clamped, not a number becomes 0.
pub fn unorm8(value: f32) -> u8 {
    // `as` saturates and sends NaN to 0.
    (value * 255.0 + 0.5) as u8
}

fn finite_half(value: f32) -> f32 {
    if value.is_nan() {
        0.0
    } else {
        value.clamp(f16::MIN.to_f32(), f16::MAX.to_f32())
    }
}

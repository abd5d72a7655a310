//! The picture that comes back from the GPU.

use half::f16;

/// A drawn frame. Rows follow each other from the top, texels of a row from the left.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Pixels a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// `width * height` pixels.
    pub pixels: Pixels,
}

/// The pixels of a frame, in the form in which they were drawn.
#[derive(Clone, Debug, PartialEq)]
pub enum Pixels {
    /// Red, green, blue, alpha: tonemapped and encoded as sRGB (IEC 61966-2-1), 8 bits each.
    Srgb8(Vec<[u8; 4]>),
    /// Red, green, blue, alpha: linear BT.709 radiance, 1.0 the white of a sunlit cloud at noon.
    Linear(Vec<[f16; 4]>),
    /// One number, from 0 (byte 0) to 1 (byte 255): a share of light, not a colour.
    Share8(Vec<u8>),
}

/// What to draw into: the form of the pixels and the texture that holds them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// Display-referred pixels, for PNG.
    Srgb8,
    /// Scene radiance, for EXR.
    Linear,
}

impl Target {
    /// The format of the texture that is drawn into.
    pub const fn texture_format(self) -> wgpu::TextureFormat {
        match self {
            Target::Srgb8 => wgpu::TextureFormat::Rgba8UnormSrgb,
            Target::Linear => wgpu::TextureFormat::Rgba16Float,
        }
    }

    /// Bytes a pixel of that texture.
    pub const fn bytes_per_pixel(self) -> u32 {
        match self {
            Target::Srgb8 => 4,
            Target::Linear => 8,
        }
    }

    /// Bytes from one row to the next in a buffer that such a texture is copied to.
    pub(crate) const fn padded_row(self, width: u32) -> u32 {
        padded(width * self.bytes_per_pixel())
    }

    /// Tightly packed bytes of that texture to pixels.
    pub(crate) fn pixels(self, bytes: &[u8]) -> Pixels {
        match self {
            Target::Srgb8 => Pixels::Srgb8(bytemuck::pod_collect_to_vec(bytes)),
            Target::Linear => Pixels::Linear(bytemuck::pod_collect_to_vec(bytes)),
        }
    }
}

/// Light of a byte of [`Pixels::Srgb8`], 0..=1: IEC 61966-2-1.
pub(crate) fn linear(byte: u8) -> f32 {
    let encoded = f32::from(byte) / 255.0;
    match encoded <= 0.04045 {
        true => encoded / 12.92,
        false => ((encoded + 0.055) / 1.055).powf(2.4),
    }
}

/// Bytes from one row to the next in a buffer that a texture with rows of `row` bytes is copied to.
pub(crate) const fn padded(row: u32) -> u32 {
    row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT)
}

//! The stars of a frame's screen on a device: see [`cells`].

use super::cells::{self, HEADER};
use crate::device::upload::written;

/// The texture that the shader reads them from.
#[derive(Debug)]
pub(crate) struct CatalogueTexture {
    pub texture: wgpu::Texture,
}

impl CatalogueTexture {
    /// Floats of 32 bits; of a pack without a catalogue a single texel, which nobody reads.
    pub fn new(device: &wgpu::Device, has_catalogue: bool) -> CatalogueTexture {
        let size = match has_catalogue {
            true => [cells::WIDTH, cells::HEIGHT].map(|side| side as u32),
            false => [1, 1],
        };
        let format = wgpu::TextureFormat::Rgba32Float;
        CatalogueTexture {
            texture: written(device, "stars of a catalogue", format, size),
        }
    }

    /// Writes whole rows of texels, one at least.
    pub fn write(&self, queue: &wgpu::Queue, texels: &[[f32; 4]]) {
        debug_assert!(texels.len() >= HEADER && texels.len().is_multiple_of(cells::WIDTH));
        let rows = (texels.len() / cells::WIDTH) as u32;
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(16 * cells::WIDTH as u32),
            rows_per_image: None,
        };
        let size = wgpu::Extent3d {
            width: cells::WIDTH as u32,
            height: rows,
            depth_or_array_layers: 1,
        };
        let bytes = bytemuck::cast_slice(texels);
        queue.write_texture(self.texture.as_image_copy(), bytes, layout, size);
    }
}

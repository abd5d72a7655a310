//! The clear sky of the moment on a device.

use crate::clear_sky::table::{SkyView, halves};

/// The texture that the shader reads the clear sky from, and what was written to it last.
#[derive(Debug)]
pub(crate) struct ViewTexture {
    pub texture: wgpu::Texture,
    written: Option<SkyView>,
}

impl ViewTexture {
    /// An empty texture of half floats.
    pub fn new(device: &wgpu::Device, [width, height]: [u32; 2]) -> ViewTexture {
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("clear sky"),
            size: wgpu::Extent3d {
                width,
                height,
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba16Float,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        ViewTexture {
            texture,
            written: None,
        }
    }

    /// Writes a view, unless it is there.
    pub fn write(&mut self, queue: &wgpu::Queue, view: &SkyView) {
        if self.written.as_ref() == Some(view) {
            return;
        }
        let image = view.image();
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(8 * image.width),
            rows_per_image: None,
        };
        queue.write_texture(
            self.texture.as_image_copy(),
            &halves(&image),
            layout,
            self.texture.size(),
        );
        self.written = Some(view.clone());
    }
}

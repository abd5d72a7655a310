//! The clear sky of the moment on a device.

use crate::clear_sky::light::LitSky;
use crate::clear_sky::moment::Lighting;
use crate::clear_sky::table::halves;

/// The texture that the shader reads the clear sky from, and the light that goes with what is in it.
#[derive(Debug)]
pub(crate) struct ViewTexture {
    pub texture: wgpu::Texture,
    written: Option<(Lighting, LitSky)>,
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

    /// The light of a moment, made and its sky written unless they are there.
    pub fn lit(
        &mut self,
        queue: &wgpu::Queue,
        moment: Lighting,
        make: impl FnOnce(&Lighting) -> LitSky,
    ) -> &LitSky {
        let last = self.written.take().filter(|(last, _)| *last == moment);
        let lit = last.map(|(_, lit)| lit).unwrap_or_else(|| {
            let lit = make(&moment);
            self.write(queue, &lit);
            lit
        });
        &self.written.insert((moment, lit)).1
    }

    fn write(&self, queue: &wgpu::Queue, lit: &LitSky) {
        let image = lit.view.image();
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
    }
}

//! The clear sky of the moment on a device.

use crate::clear_sky::light::LitSky;
use crate::clear_sky::moment::Lighting;
use crate::clear_sky::table::halves;
use crate::device::upload::written;

/// The texture that the shader reads the clear sky from, and the light that goes with what is in it.
#[derive(Debug)]
pub(crate) struct ViewTexture {
    pub texture: wgpu::Texture,
    written: Option<(Lighting, LitSky)>,
}

impl ViewTexture {
    /// An empty texture of half floats.
    pub fn new(device: &wgpu::Device, size: [u32; 2]) -> ViewTexture {
        let format = wgpu::TextureFormat::Rgba16Float;
        ViewTexture {
            texture: written(device, "clear sky", format, size),
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

    /// The light of a moment if it is the one that is there.
    pub fn kept(&self, moment: &Lighting) -> Option<&LitSky> {
        let kept = self.written.as_ref().filter(|(last, _)| last == moment);
        kept.map(|(_, lit)| lit)
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

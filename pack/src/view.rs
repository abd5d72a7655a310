//! An image of a texture, read where it lies.

use half::f16;

use crate::format::Format;
use crate::texture::Texture;

/// One image of one level as linear floats, decoded texel by texel: the checks look at textures of hundreds of megabytes,
/// of which an [`crate::Image`] would be up to four times as large.
#[derive(Clone, Copy, Debug)]
pub(crate) struct View<'a> {
    /// Texels a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    format: Format,
    bytes: &'a [u8],
}

/// The channels of a texel; those that the format lacks are 0.
pub(crate) type Texel = [f32; 4];

impl Texture {
    /// One image of one level.
    ///
    /// # Panics
    /// If the level or the layer does not exist.
    pub(crate) fn view(&self, level: usize, layer: u32) -> View<'_> {
        let (width, height) = self.level_size(level);
        let bytes = self.level_bytes(level) / self.layers as usize;
        View {
            width,
            height,
            format: self.format,
            bytes: &self.levels[level][bytes * layer as usize..][..bytes],
        }
    }

    /// All images of one level, one below the other, as one image.
    ///
    /// # Panics
    /// If the level does not exist.
    pub(crate) fn view_of_level(&self, level: usize) -> View<'_> {
        let (width, height) = self.level_size(level);
        View {
            width,
            height: height * self.layers,
            format: self.format,
            bytes: &self.levels[level],
        }
    }

    /// Every image of every level.
    pub(crate) fn views(&self) -> impl Iterator<Item = View<'_>> {
        let levels = 0..self.levels.len();
        levels.flat_map(move |level| (0..self.layers).map(move |layer| self.view(level, layer)))
    }
}

impl<'a> View<'a> {
    /// The channels of texel `(x, y)`.
    pub fn texel(&self, x: u32, y: u32) -> Texel {
        let at = y as usize * self.width as usize + x as usize;
        let size = self.format.bytes_per_texel();
        decode(self.format, &self.bytes[at * size..][..size])
    }

    /// All texels, row by row.
    pub fn texels(self) -> impl Iterator<Item = Texel> + Clone + use<'a> {
        let texels = self.bytes.chunks_exact(self.format.bytes_per_texel());
        texels.map(move |bytes| decode(self.format, bytes))
    }

    /// One channel alone, row by row.
    pub fn channel(self, channel: usize) -> impl Iterator<Item = f32> + Clone + use<'a> {
        self.texels().map(move |texel| texel[channel])
    }

    /// Mean and standard deviation of one channel, as those of an image.
    pub fn mean_and_spread(self, channel: usize) -> (f32, f32) {
        crate::image::mean_and_spread(self.channel(channel))
    }
}

fn decode(format: Format, bytes: &[u8]) -> Texel {
    let mut texel = [0.0; 4];
    match format {
        Format::Rgba16Float => {
            for (value, bytes) in texel.iter_mut().zip(bytes.as_chunks().0) {
                *value = f16::from_le_bytes(*bytes).to_f32();
            }
        }
        _ => {
            for (value, byte) in texel.iter_mut().zip(bytes) {
                *value = f32::from(*byte) / 255.0;
            }
        }
    }
    texel
}

#[cfg(test)]
mod tests {
    use crate::format::{Format, Shape};
    use crate::texture::Texture;

    #[test]
    fn a_view_shows_what_the_image_holds() {
        for format in Format::ALL {
            let mut texture = Texture {
                format,
                shape: Shape::Array,
                width: 8,
                height: 4,
                layers: 2,
                levels: Vec::new(),
            };
            for level in 0..4 {
                let bytes = 0..texture.level_bytes(level);
                texture
                    .levels
                    .push(bytes.map(|i| (i * 7 % 60) as u8).collect());
            }
            assert_eq!(texture.views().count(), 8);
            for (level, layer) in (0..4).flat_map(|level| [(level, 0), (level, 1)]) {
                let (view, image) = (texture.view(level, layer), texture.image(level, layer));
                assert_eq!((view.width, view.height), (image.width, image.height));
                let (x, y) = (image.width - 1, image.height - 1);
                assert_eq!(view.texel(x, y)[..image.channels], *image.texel(x, y));
                for channel in 0..image.channels {
                    assert!(view.channel(channel).eq(image.channel(channel)));
                    assert_eq!(
                        view.mean_and_spread(channel),
                        image.mean_and_spread(channel)
                    );
                }
            }
        }
    }
}

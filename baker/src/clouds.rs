//! The packed cloud texture: photo, noise, detail and sunset gradient side by side.
//!
//! T. Roden, I. Parberry, "Clouds and Stars: Efficient Real-Time Procedural Sky Rendering Using 3D
//! Hardware", ACE 2005, section 3 and figure 3.

pub(crate) mod gradient;
pub(crate) mod noise;
pub mod photo;
pub(crate) mod source;

use welkin_pack::Image;

/// Four images of one channel and one size become one image of four channels.
pub(crate) fn pack(channels: [&Image; 4]) -> Image {
    let mut packed = Image::new(channels[0].width, channels[0].height, 4);
    for (i, texel) in packed.texels.chunks_exact_mut(4).enumerate() {
        for (value, channel) in texel.iter_mut().zip(channels) {
            *value = channel.texels[i];
        }
    }
    packed
}

//! White noise for the octaves of procedural clouds.
//!
//! S. Guthikonda, A. Meena, D. V. Linder, S. Yi, "Realistic Real-Time Skies", CS 580 final project, University
//! of Southern California, part I: one texture of 32x32 random numbers an octave.
//!
//! # Changes versus the paper
//! Numbers are not drawn but shuffled: each channel holds every byte equally often, so that its mean is
//! exactly a half and clouds of every seed cover the same share of the sky. The four octaves are the
//! channels of one texture.

use welkin_pack::{Image, Role};

use crate::stream::Stream;

/// Four channels, octaves 1 to 4, each from its own random stream `octaves.octave1` and so on.
pub(crate) fn image(seed: u64) -> Image {
    let spec = Role::Octaves.spec();
    let [width, height] = spec.size;
    let mut image = Image::new(width, height, spec.channels.len());
    for (index, channel) in spec.channels.iter().enumerate() {
        let name = format!("{}.{}", Role::Octaves.name(), channel.name);
        let bytes = shuffled((width * height) as usize, &mut Stream::new(seed, &name));
        for (texel, byte) in image
            .texels
            .chunks_exact_mut(spec.channels.len())
            .zip(bytes)
        {
            texel[index] = f32::from(byte) / 255.0;
        }
    }
    image
}

/// `count` bytes, a multiple of 256, every value equally often, in a random order.
///
/// R. Durstenfeld, "Algorithm 235: Random Permutation", CACM 7(7), 1964.
fn shuffled(count: usize, stream: &mut Stream) -> Vec<u8> {
    let mut bytes: Vec<u8> = (0..=255).cycle().take(count).collect();
    for last in (1..count).rev() {
        // The upper half of the bits, scaled: uneven by less than one part in four million.
        let other = ((stream.bits() >> 32) * (last as u64 + 1)) >> 32;
        bytes.swap(last, other as usize);
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_place_is_as_likely_for_a_value() {
        let mut places = [0_u32; 16];
        for seed in 0..1600 {
            let bytes = shuffled(256, &mut Stream::new(seed, "test"));
            let place = bytes.iter().position(|&b| b == 7).unwrap();
            places[place / 16] += 1;
        }
        let off = places.map(|n| f64::from(n) - 100.0);
        let chi_squared: f64 = off.map(|d| d * d / 100.0).iter().sum();
        // Exceeded once in a thousand at 15 degrees of freedom.
        assert!(chi_squared < 37.7, "{places:?}");
    }
}

//! Levels of the role `stars`: each texel keeps one star, with the light of all stars under it.
//!
//! A mean of two records is no star, and the mean of a faint star over many texels is less than a step of a
//! byte. So light is summed and not averaged, rate and phase are those of the brightest star, and a level
//! divides its sums by one number, its unit, where the largest would not fit a byte. A star that stands alone
//! is then the record that it was on level 0, for as long as the unit is 1.

use crate::image::Image;
use crate::texture::unorm8;

/// The stars under a texel.
#[derive(Clone, Copy, Default)]
struct Block {
    /// Sums of intensity and variance, in steps of a byte of level 0.
    intensity: u32,
    variance: u32,
    /// Intensity, rate and phase of the brightest.
    brightest: [u8; 3],
}

/// All `count` levels, encoded.
pub(super) fn levels(base: &Image, count: usize) -> Vec<Vec<u8>> {
    let bytes: Vec<u8> = base.texels.iter().map(|&v| unorm8(v)).collect();
    let mut blocks: Vec<Block> = bytes.chunks_exact(4).map(block).collect();
    let (mut width, mut height) = (base.width as usize, base.height as usize);
    let mut levels = vec![bytes];
    for _ in 1..count {
        blocks = halve(&blocks, width, height);
        (width, height) = ((width / 2).max(1), (height / 2).max(1));
        levels.push(encode(&blocks));
    }
    levels
}

fn block(texel: &[u8]) -> Block {
    Block {
        intensity: texel[0].into(),
        variance: texel[2].into(),
        brightest: [texel[0], texel[1], texel[3]],
    }
}

fn halve(blocks: &[Block], width: usize, height: usize) -> Vec<Block> {
    let (columns, rows) = ((width / 2).max(1), (height / 2).max(1));
    let mut halved = vec![Block::default(); columns * rows];
    for (i, block) in blocks.iter().enumerate() {
        let sum = &mut halved[(i / width * rows / height) * columns + i % width * columns / width];
        sum.intensity += block.intensity;
        sum.variance += block.variance;
        if block.brightest[0] > sum.brightest[0] {
            sum.brightest = block.brightest;
        }
    }
    halved
}

/// Divides by the level's unit. What rounding takes from one texel is given to the next, so that the light
/// of the whole level and its flicker are kept; no star is rounded away.
fn encode(blocks: &[Block]) -> Vec<u8> {
    let largest = blocks.iter().map(|b| b.intensity + b.variance).max();
    let unit = f64::from(largest.unwrap_or(0).div_ceil(255).max(1));
    let mut carry = [0.0_f64; 2];
    let mut bytes = Vec::with_capacity(4 * blocks.len());
    for block in blocks {
        if block.intensity == 0 {
            bytes.extend([0; 4]);
            continue;
        }
        let mut round = |i: usize, sum: u32, least: f64, most: f64| {
            let wanted = f64::from(sum) / unit + carry[i];
            let rounded = libm::round(wanted).clamp(least, most);
            carry[i] = wanted - rounded;
            rounded as u8
        };
        let intensity = round(0, block.intensity, 1.0, 255.0);
        // The flicker must not reach beyond 0 or 1.
        let room = intensity.min(255 - intensity);
        let variance = round(1, block.variance, 0.0, room.into());
        let [_, rate, phase] = block.brightest;
        bytes.extend([intensity, rate, variance, phase]);
    }
    bytes
}

#[cfg(all(test, feature = "write"))]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::test_pack::stars;

    fn sums(level: &[u8]) -> [f64; 2] {
        [0, 2].map(|c| level.iter().skip(c).step_by(4).map(|&b| f64::from(b)).sum())
    }

    #[test]
    fn a_star_alone_is_the_record_that_it_was() {
        let record = [5, 77, 2, 200];
        let mut image = Image::new(64, 64, 4);
        for (x, y, texel) in [(37, 20, record), (3, 60, [255, 9, 0, 1])] {
            let texel = texel.map(|b| f32::from(b) / 255.0);
            image.texel_mut(x, y).copy_from_slice(&texel);
        }
        for (level, bytes) in levels(&image, 6).iter().enumerate() {
            let side = 64 >> level;
            let at = ((20 >> level) * side + (37 >> level)) * 4;
            assert_eq!(bytes[at..at + 4], record, "level {level}");
            assert_eq!(bytes.iter().filter(|b| **b == 5).count(), 1);
        }
    }

    #[test]
    fn stars_that_meet_add_their_light_and_keep_the_beat_of_the_brightest() {
        let mut image = Image::new(2, 2, 4);
        let records: [[u8; 4]; 4] = [[30, 11, 10, 250], [0; 4], [40, 12, 4, 20], [20, 13, 12, 99]];
        let texels = records.as_flattened().iter().map(|&b| f32::from(b) / 255.0);
        image.texels = texels.collect();
        assert_eq!(levels(&image, 2)[1], [90, 12, 26, 20]);
        // Sums of 300 and 60 do not fit: the unit is 2.
        image.texels.iter_mut().for_each(|v| *v = 0.0);
        let bright = [100.0 / 255.0, 0.1, 20.0 / 255.0, 0.5];
        for x in 0..3 {
            image.texel_mut(x % 2, x / 2).copy_from_slice(&bright);
        }
        assert_eq!(levels(&image, 2)[1], [150, 26, 30, 128]);
    }

    proptest! {
        #[test]
        fn light_and_flicker_survive_every_level(count in 20_usize..2000) {
            let levels = levels(&stars(128, count), 8);
            let [intensity, variance] = sums(&levels[0]);
            for level in &levels[1..] {
                let [i, v] = sums(level);
                // Half a step of either sum is left over, of a level that has at least 128 steps in all.
                prop_assert!((v / i / (variance / intensity) - 1.0).abs() < 0.02, "{count}: {v} {i}");
                for t in level.chunks_exact(4) {
                    prop_assert!(t[2] <= t[0] && u16::from(t[0]) + u16::from(t[2]) <= 255);
                    prop_assert!(t[0] > 0 || t == [0; 4]);
                }
            }
        }
    }
}

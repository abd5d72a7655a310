//! Twin of clouds/fbm/map.wgsl: the article's loop over up to eight layers, in floats.

use glam::Vec2;
use welkin_pack::Image;
use welkin_runtime::internals::clouds::fbm::FbmUniforms;
use welkin_runtime::internals::clouds::fbm::map::{ABSORPTION, DEPTHS};

use crate::photo::Photo;
use crate::texture::Texture;

/// Level 0 of the map, not rounded: shade, sum, nothing, cover. `layers` are those of
/// [`crate::fbm_pack::packed`].
pub fn render(fbm: &FbmUniforms, photo: &Photo<'_>, layers: &[Texture]) -> Image {
    map(fbm, photo, layers, |sums| texel(fbm, sums))
}

/// What a texel of level 0 may be off by, in bytes: the four channels at most, and on average.
///
/// A texture unit may filter 8-bit texels in 8 bits (Mesa's software does), so a read is off by up to a byte; the
/// channels that point towards the sun have been read and rounded once before, which makes two. Weights add up to 1, so
/// the sums are off by no more. What that is worth is asked of every texel; the target rounds by half a byte. On
/// average rounding is off by a quarter of its step.
pub fn allowance(fbm: &FbmUniforms, photo: &Photo<'_>, layers: &[Texture]) -> ([f32; 4], [f32; 4]) {
    // Of the octaves a part is left; the photo's own reads are off by up to a byte of the photo.
    let by_photo = fbm.spread * photo.off();
    let bounds = map(fbm, photo, layers, |sums| {
        let moved = |sign: f32| {
            let bytes =
                [2.0, 2.0, 2.0, 1.0].map(|bytes| sign * (photo.rest() * bytes / 255.0 + by_photo));
            texel(fbm, std::array::from_fn(|i| sums[i] + bytes[i]))
        };
        let (less, here, more) = (moved(-1.0), texel(fbm, sums), moved(1.0));
        std::array::from_fn(|i| 255.0 * (more[i] - here[i]).max(here[i] - less[i]) + 0.5)
    });
    let texels = bounds.texels.len() as f32 / 4.0;
    let channel = |i: usize| bounds.texels.iter().skip(i).step_by(4);
    (
        std::array::from_fn(|i| channel(i).fold(0.0, |most, bound| bound.max(most))),
        std::array::from_fn(|i| channel(i).sum::<f32>() / texels / 4.0),
    )
}

/// A map of something that follows from the sums of the octaves, three, two, one and no steps towards the sun.
fn map(
    fbm: &FbmUniforms,
    photo: &Photo<'_>,
    layers: &[Texture],
    texel: impl Fn([f32; 4]) -> [f32; 4],
) -> Image {
    let side = fbm.resolution;
    let offsets = fbm.offsets.map(|two| two.to_array()).concat();
    let weights = fbm.weights.map(|four| four.to_array()).concat();
    let (width, height) = (side as u32, side as u32);
    let mut map = Image::new(width, height, 4);
    for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
        let (u, v) = ((x as f32 + 0.5) / side, (y as f32 + 0.5) / side);
        let mut sums = [0.0; 4];
        for k in 0..fbm.count as usize {
            let read = layers[k].sample([u + offsets[2 * k], v + offsets[2 * k + 1]], 0.0);
            for (sum, noise) in sums.iter_mut().zip(read) {
                *sum += weights[k] * noise;
            }
        }
        let place = Vec2::new(u + offsets[0], v + offsets[1]);
        for (steps, sum) in [3.0, 2.0, 1.0, 0.0].into_iter().zip(&mut sums) {
            let photo_s = photo.over(0.0, place + fbm.sun_step * steps);
            *sum = fbm.mean + photo.rest() * (*sum - fbm.mean) + fbm.spread * photo_s;
        }
        map.texel_mut(x, y).copy_from_slice(&texel(sums));
    }
    map
}

fn texel(fbm: &FbmUniforms, sums: [f32; 4]) -> [f32; 4] {
    let cover = (fbm.slope * sums[3] + fbm.intercept).clamp(0.0, 1.0);
    let shade = shade(sums.map(|sum| fbm.ray_slope * sum + fbm.ray_intercept));
    [shade, sums[3], 0.0, cover]
}

/// What the cloud takes from the light: by the mean height above the ray.
fn shade(heights: [f32; 4]) -> f32 {
    let above = heights
        .iter()
        .zip(DEPTHS)
        .map(|(h, depth)| (h - depth).max(0.0));
    1.0 - libm::exp2f(-ABSORPTION * above.sum::<f32>() / 4.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_cloud_takes_no_light_and_more_cloud_takes_more() {
        assert_eq!(shade([0.0; 4]), 0.0);
        assert_eq!(shade(DEPTHS), 0.0, "nothing is above the ray");
        // One of four samples inside, by a half: an eighth in the mean.
        let expected = 1.0 - libm::exp2f(-ABSORPTION / 8.0);
        assert!((shade([0.0, 0.0, 0.0, 0.5]) - expected).abs() < 1e-6);
        assert!(shade([1.0; 4]) > shade([0.9; 4]));
    }
}

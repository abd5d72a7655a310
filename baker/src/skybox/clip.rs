//! Light that a half float does not hold.

use welkin_pack::Image;

use crate::load::MAX_RADIANCE;
use crate::notice::Clipped;

/// Radiance that no picture means. Sums of as many texels as there may be, times the largest gain, stay below what a float
/// holds.
const NONSENSE: f32 = 1e30;

/// The half float before the largest: a texel that is told to keep its light does not look like one that was cut.
const KEPT: f32 = 65_472.0;

/// The least gain that a recipe may have (`resolve/skybox.rs`).
const LEAST_GAIN: f32 = 0.001;

/// Luminance of linear BT.709 (ITU-R BT.709-6, item 3.2).
const LUMINANCE: [f32; 3] = [0.2126, 0.7152, 0.0722];

/// Gives infinity the largest radiance of a half float, where it most often comes from; counts the texels.
pub(super) fn tame(picture: &mut Image) -> usize {
    let mut count = 0;
    for texel in picture.texels.chunks_exact_mut(4) {
        let mut is_infinite = false;
        for value in texel[..3].iter_mut().filter(|value| **value > NONSENSE) {
            *value = MAX_RADIANCE;
            is_infinite = true;
        }
        count += usize::from(is_infinite);
    }
    count
}

/// Cuts the faces of a cube to what a half float holds, and says what that took, if anything; `infinite` texels of the
/// picture had no end.
pub(super) fn cut(faces: &mut [Image], gain: f32, infinite: usize) -> Option<Clipped> {
    let (mut texels, mut brightest, mut light, mut lost) = (0, 0.0_f32, 0.0_f64, 0.0_f64);
    for face in faces.iter_mut() {
        let size = face.width as usize;
        for (i, texel) in face.texels.chunks_exact_mut(4).enumerate() {
            let weight = solid_angle([i % size, i / size], size);
            let before = luminance(texel);
            let most = texel[..3].iter().copied().fold(0.0, f32::max);
            light += weight * before;
            if most > MAX_RADIANCE {
                for value in &mut texel[..3] {
                    *value = value.min(MAX_RADIANCE);
                }
                lost += weight * (before - luminance(texel));
                texels += 1;
                brightest = brightest.max(most);
            }
        }
    }
    let keeping = rounded_down(gain / brightest * KEPT);
    let clipped = Clipped {
        texels,
        share: if texels > 0 {
            (lost / light) as f32
        } else {
            0.0
        },
        brightest,
        gain,
        keeping_gain: (texels > 0 && keeping >= LEAST_GAIN).then_some(keeping),
        infinite,
    };
    (texels > 0 || infinite > 0).then_some(clipped)
}

/// Solid angle of a texel, in an arbitrary unit: on a cube of half side 1 it falls with the cube of the distance.
fn solid_angle(place: [usize; 2], size: usize) -> f64 {
    let [s, t] = place.map(|i| (i as f64 + 0.5) / size as f64 * 2.0 - 1.0);
    let squared = 1.0 + s * s + t * t;
    1.0 / (squared * libm::sqrt(squared))
}

fn luminance(texel: &[f32]) -> f64 {
    let weighted = LUMINANCE.iter().zip(texel);
    weighted.map(|(w, v)| f64::from(*w) * f64::from(*v)).sum()
}

/// Down to three digits, so that it is short to write and still enough.
fn rounded_down(gain: f32) -> f32 {
    if !gain.is_finite() {
        return 0.0;
    }
    let digits = libm::pow(10.0, libm::floor(libm::log10(f64::from(gain))) - 2.0);
    let digits = if digits > 0.0 { digits } else { 1.0 };
    let text = format!("{:.9}", libm::floor(f64::from(gain) / digits) * digits);
    text.parse().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn faces(size: u32) -> Vec<Image> {
        let mut face = Image::new(size, size, 4);
        face.texels.fill(1.0);
        vec![face; 6]
    }

    #[test]
    fn solid_angles_fill_the_sphere() {
        let size = 64;
        let texels = (0..size * size).map(|i| solid_angle([i % size, i / size], size));
        let area = 4.0 / (size * size) as f64;
        let sphere = 6.0 * area * texels.sum::<f64>();
        assert!((sphere / (4.0 * std::f64::consts::PI) - 1.0).abs() < 1e-3);
    }

    #[test]
    fn what_a_half_float_holds_is_left_alone() {
        let mut bright = faces(16);
        bright[2].texel_mut(3, 4)[..3].fill(MAX_RADIANCE);
        let before = bright.clone();
        assert_eq!(cut(&mut bright, 1.0, 0), None);
        assert_eq!(bright, before);
    }

    #[test]
    fn the_light_that_is_cut_is_told_and_the_gain_that_keeps_it() {
        let mut sun = faces(16);
        // Both as far from the middle of their face, so of one solid angle.
        sun[0].texel_mut(7, 8)[..3].fill(4.0 * MAX_RADIANCE);
        sun[4].texel_mut(8, 7)[..3].fill(MAX_RADIANCE);
        let clipped = cut(&mut sun, 2.0, 0).unwrap();
        assert_eq!(
            sun[0].texel(7, 8),
            [MAX_RADIANCE, MAX_RADIANCE, MAX_RADIANCE, 1.0]
        );
        assert_eq!((clipped.texels, clipped.brightest), (1, 4.0 * MAX_RADIANCE));
        // Three of five; the rest of the sky weighs next to nothing.
        assert!((clipped.share - 0.6).abs() < 0.005, "{clipped:?}");
        assert_eq!(clipped.keeping_gain, Some(0.499));
        // With that gain nothing is cut.
        let mut again = faces(16);
        again[0].texel_mut(7, 8)[..3].fill(2.0 * MAX_RADIANCE * 0.499);
        assert_eq!(cut(&mut again, 0.499, 0), None);
    }

    #[test]
    fn a_sun_beyond_every_gain_and_infinity_are_told() {
        let mut sun = faces(16);
        sun[0].texel_mut(7, 8)[1] = 1e9;
        assert_eq!(cut(&mut sun, 1.0, 0).unwrap().keeping_gain, None);
        let mut picture = Image::new(2, 1, 4);
        picture.texels[1] = f32::INFINITY;
        picture.texels[2] = 1e38;
        assert_eq!(tame(&mut picture), 1);
        assert_eq!(picture.texels[..4], [0.0, MAX_RADIANCE, MAX_RADIANCE, 0.0]);
        let told = cut(&mut faces(16), 1.0, 3).unwrap();
        assert_eq!((told.texels, told.share, told.infinite), (0, 0.0, 3));
    }
}

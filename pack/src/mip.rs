//! Mip levels, made for what each channel means.
//!
//! Every level is filtered from the linear image above it and quantised once, so that errors do not add
//! up. Amounts are averaged over 2x2 texels. The sunset gradient keeps its first and last row. Stars keep
//! their light: see [`stars`]. Normals keep their length: see `layers.rs`. Sprites keep apart: see `sprites.rs`.

mod layers;
mod sprites;

use crate::texture::encode;
use crate::{Format, Image, Role};

/// All levels of the images that the role asks for, encoded, with the images of a level one after another.
pub(crate) fn levels(role: Role, format: Format, images: Vec<Image>) -> Vec<Vec<u8>> {
    let mut joined: Vec<Vec<u8>> = Vec::new();
    for image in images {
        for (index, level) in levels_of(role, format, image).into_iter().enumerate() {
            match joined.get_mut(index) {
                Some(bytes) => bytes.extend(level),
                None => joined.push(level),
            }
        }
    }
    joined
}

fn levels_of(role: Role, format: Format, image: Image) -> Vec<Vec<u8>> {
    let count = role.spec().mips.count(image.width, image.height);
    let mut level = image;
    let base_gradient = (role == Role::Clouds).then(|| column(&level, GRADIENT));
    let mut levels = Vec::with_capacity(count);
    for index in 0..count {
        if index > 0 {
            level = match role {
                Role::Stars => stars(&level),
                Role::Layers => layers::halve(&level),
                Role::Sprites => sprites::halve(&level),
                _ => halve(&level),
            };
        }
        if let Some(base) = base_gradient.as_deref().filter(|_| index > 0) {
            keep_ends(&mut level, base);
        }
        levels.push(match (role, index) {
            (Role::Stars, 1..) => encode_stars(&level),
            _ => encode(format, &level.texels),
        });
    }
    levels
}

/// Averages 2x2 texels (2x1 or 1x2 where a side is already one texel). Sides are powers of two.
pub(crate) fn halve(image: &Image) -> Image {
    fold(image, mean)
}

fn mean(texels: &[&[f32]], out: &mut [f32]) {
    for (channel, value) in out.iter_mut().enumerate() {
        *value = texels.iter().map(|t| t[channel]).sum::<f32>() / texels.len() as f32;
    }
}

/// Averages star records so that light is kept.
///
/// Intensity and variance are averaged over the area: the sum of intensity per solid angle, and with it
/// the light of a star, stays what it was, and so does the relative amplitude of a lone star's flicker.
/// Rate and phase are averaged with the intensity as weight, the phase as an angle.
pub(crate) fn stars(image: &Image) -> Image {
    fold(image, |texels, out| {
        let weight: f32 = texels.iter().map(|t| t[0]).sum();
        if weight <= 0.0 {
            return;
        }
        let weighted =
            |value: &dyn Fn(&[f32]) -> f32| texels.iter().map(|t| t[0] * value(t)).sum::<f32>();
        let angle = |t: &[f32]| std::f32::consts::TAU * t[3];
        let (sin, cos) = (
            weighted(&|t| libm::sinf(angle(t))),
            weighted(&|t| libm::cosf(angle(t))),
        );
        let phase = libm::atan2f(sin, cos) / std::f32::consts::TAU;
        out[0] = weight / texels.len() as f32;
        out[1] = weighted(&|t| t[1]) / weight;
        out[2] = texels.iter().map(|t| t[2]).sum::<f32>() / texels.len() as f32;
        out[3] = if phase < 0.0 { phase + 1.0 } else { phase };
    })
}

/// Gathers the two to four texels under each texel of the next level.
fn fold(image: &Image, average: impl Fn(&[&[f32]], &mut [f32])) -> Image {
    let (width, height) = ((image.width / 2).max(1), (image.height / 2).max(1));
    let (step_x, step_y) = (image.width / width, image.height / height);
    let mut out = Image::new(width, height, image.channels);
    let mut texels: Vec<&[f32]> = Vec::with_capacity(4);
    for y in 0..height {
        for x in 0..width {
            texels.clear();
            for (j, i) in (0..step_y).flat_map(|j| (0..step_x).map(move |i| (j, i))) {
                texels.push(image.texel(x * step_x + i, y * step_y + j));
            }
            average(&texels, out.texel_mut(x, y));
        }
    }
    out
}

/// Quantises an averaged star level so that the light of the whole level is kept.
///
/// A faint star's average over many texels is less than one step of a byte. Rounding each alone would
/// lose them all, so the rounding error of one star is carried to the next in row order.
fn encode_stars(level: &Image) -> Vec<u8> {
    let mut carry = 0.0_f32;
    let mut bytes = Vec::with_capacity(level.texels.len());
    for texel in level.texels.chunks_exact(4) {
        if texel[0] <= 0.0 {
            bytes.extend([0; 4]);
            continue;
        }
        let wanted = texel[0] * 255.0 + carry;
        let intensity = (wanted + 0.5) as u8;
        carry = wanted - f32::from(intensity);
        if intensity == 0 {
            bytes.extend([0; 4]);
            continue;
        }
        let [rate, _, phase] = [texel[1], texel[2], texel[3]].map(crate::texture::unorm8);
        let amplitude = texel[2] / texel[0] * f32::from(intensity);
        // Rounded down: the flicker must not reach beyond 0 or 1.
        let variance = (amplitude as u8).min(intensity).min(255 - intensity);
        bytes.extend([intensity, rate, variance, phase]);
    }
    bytes
}

const GRADIENT: usize = 3;

fn column(image: &Image, channel: usize) -> Vec<f32> {
    (0..image.height)
        .map(|y| image.texel(0, y)[channel])
        .collect()
}

/// Replaces the gradient channel by the base column resampled with its first and last value in place.
fn keep_ends(level: &mut Image, base: &[f32]) {
    for y in 0..level.height {
        let value = if level.height == 1 {
            base.iter().sum::<f32>() / base.len() as f32
        } else {
            let position = y as f32 * (base.len() - 1) as f32 / (level.height - 1) as f32;
            let below = (position as usize).min(base.len() - 1);
            let above = (below + 1).min(base.len() - 1);
            base[below] + (base[above] - base[below]) * (position - below as f32)
        };
        for x in 0..level.width {
            level.texel_mut(x, y)[GRADIENT] = value;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn star_field(stars: &[(u32, u32, [f32; 4])]) -> Image {
        let mut image = Image::new(64, 64, 4);
        for (x, y, texel) in stars {
            image.texel_mut(*x, *y).copy_from_slice(texel);
        }
        image
    }

    #[test]
    fn halving_keeps_the_mean() {
        let mut image = Image::new(16, 8, 1);
        for (i, texel) in image.texels.iter_mut().enumerate() {
            *texel = (i % 7) as f32 / 7.0;
        }
        let (mean, _) = image.mean_and_spread(0);
        let half = halve(&image);
        assert_eq!((half.width, half.height), (8, 4));
        assert!((half.mean_and_spread(0).0 - mean).abs() < 1e-6);
        let one = halve(&halve(&halve(&half)));
        assert_eq!((one.width, one.height), (1, 1));
        assert!((one.texels[0] - mean).abs() < 1e-6);
    }

    #[test]
    fn the_light_of_stars_survives_every_level_to_half_a_step() {
        let field: Vec<_> = (0..40)
            .map(|i| {
                (
                    (i * 13) % 64,
                    (i * 29 + i / 5) % 64,
                    [0.03 + 0.02 * i as f32, 0.5, 0.01, 0.3],
                )
            })
            .collect();
        let field = star_field(&field);
        let light: f32 = field.channel(0).sum::<f32>() / 4096.0;
        for (index, bytes) in levels_of(Role::Stars, Format::Rgba8Unorm, field)
            .iter()
            .enumerate()
        {
            let texels = bytes.len() / 4;
            let sum: u32 = bytes.iter().step_by(4).map(|&b| u32::from(b)).sum();
            // Level 0 rounds each of 40 stars by at most half a step; further levels carry the error on.
            let slack = if index == 0 { 20.0 } else { 0.51 };
            let expected = light * 255.0 * texels as f32;
            assert!(
                (sum as f32 - expected).abs() <= slack,
                "level {index}: {sum} {expected}"
            );
        }
    }

    #[test]
    fn two_stars_meet_weighted_by_their_light_and_phase_wraps() {
        let field = star_field(&[(0, 0, [0.6, 0.2, 0.3, 0.95]), (1, 1, [0.2, 0.6, 0.1, 0.05])]);
        let met = stars(&field).texel(0, 0).to_vec();
        assert!((met[0] - 0.2).abs() < 1e-6);
        assert!((met[1] - (0.6 * 0.2 + 0.2 * 0.6) / 0.8).abs() < 1e-6);
        assert!((met[2] - 0.1).abs() < 1e-6);
        // Angles of -18 and +18 degrees with weights 3 and 1: tan = 0.5 tan(18 deg).
        let expected =
            1.0 - libm::atanf(0.5 * libm::tanf(0.1 * std::f32::consts::PI)) / std::f32::consts::TAU;
        assert!((met[3] - expected).abs() < 1e-6, "{} {expected}", met[3]);
    }

    #[test]
    fn no_star_level_clips() {
        let field = star_field(&[
            (3, 3, [0.5, 0.2, 0.5, 0.95]),
            (40, 41, [0.01, 0.2, 0.01, 0.1]),
        ]);
        for bytes in levels_of(Role::Stars, Format::Rgba8Unorm, field)
            .iter()
            .skip(1)
        {
            for t in bytes.chunks_exact(4) {
                assert!(t[2] <= t[0] && u16::from(t[0]) + u16::from(t[2]) <= 255);
                assert!(t[0] > 0 || t == [0; 4]);
            }
        }
    }

    #[test]
    fn the_gradient_keeps_its_ends() {
        let mut image = Image::new(64, 64, 4);
        for y in 0..64 {
            for x in 0..64 {
                image.texel_mut(x, y)[GRADIENT] = (y as f32 / 63.0) * (y as f32 / 63.0);
            }
        }
        let levels = levels_of(Role::Clouds, Format::Rgba8Unorm, image);
        for (index, bytes) in levels.iter().enumerate().take(6) {
            assert_eq!(
                (bytes[3], bytes[bytes.len() - 1]),
                (0, 255),
                "level {index}"
            );
        }
    }
}

//! Mip levels, made for what each channel means.
//!
//! Every level is filtered from the linear image above it and quantised once, so that errors do not add
//! up. Amounts are averaged over 2x2 texels. The sunset gradient keeps its first and last row. Stars keep
//! their records: see `stars.rs`. Normals keep their length: see `layers.rs`. Sprites keep apart: see `sprites.rs`.

mod layers;
mod sprites;
mod stars;

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
    if role == Role::Stars {
        return stars::levels(&image, count);
    }
    let mut level = image;
    let base_gradient = (role == Role::Clouds).then(|| column(&level, GRADIENT));
    let mut levels = Vec::with_capacity(count);
    for index in 0..count {
        if index > 0 {
            level = match role {
                Role::Layers => layers::halve(&level),
                Role::Sprites => sprites::halve(&level),
                _ => halve(&level),
            };
        }
        if let Some(base) = base_gradient.as_deref().filter(|_| index > 0) {
            keep_ends(&mut level, base);
        }
        levels.push(encode(format, &level.texels));
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

//! Mip levels, made for what each channel means.
//!
//! Every level is filtered from the linear image above it and quantised once, so that errors do not add
//! up. Amounts are averaged over 2x2 texels. The sunset gradient keeps its first and last row. Stars keep
//! their records: see `stars.rs`. Normals keep their length: see `layers.rs`. Sprites keep apart: see `sprites.rs`.

pub(crate) mod fold;
mod layers;
mod sprites;
mod stars;

use crate::format::Format;
use crate::image::Image;
use crate::role::Role;
use crate::texture::encode;

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
                _ => fold::halve(&level),
            };
        }
        if let Some(base) = base_gradient.as_deref().filter(|_| index > 0) {
            keep_ends(&mut level, base);
        }
        levels.push(encode(format, &level.texels));
    }
    levels
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

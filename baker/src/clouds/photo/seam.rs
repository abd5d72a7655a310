//! A tile whose opposite sides meet, as smooth as the runtime wants it.

use welkin_pack::Image;

use crate::filter::{self, Edge};

/// The last blur: a mix of a narrow and a wide Gaussian, in texels of a tile of 512. The narrow one keeps
/// the shapes of edges, the wide one takes part of the contrast from everything of a few texels.
const SMOOTH_TEXELS: [f32; 2] = [1.8, 5.5];

/// Weight of the narrow Gaussian.
const NARROW_SHARE: f32 = 0.4;

/// `sharpness` divides the width of the blur.
pub(super) fn soften(tile: &Image, sharpness: f32) -> Image {
    let scale = tile.width as f32 / 512.0 / sharpness;
    let [narrow, wide] =
        SMOOTH_TEXELS.map(|sigma| filter::gaussian_blur(tile, sigma * scale, Edge::Wrap));
    filter::plane(tile.width, tile.height, |x, y| {
        let i = tile.index(x, y);
        NARROW_SHARE * narrow.texels[i] + (1.0 - NARROW_SHARE) * wide.texels[i]
    })
}

/// Cuts a tile of `size` texels whose first `margin` columns and rows are blended with those beyond its far sides.
pub(super) fn close(field: &Image, size: u32, margin: u32, blend: Blend) -> Image {
    let columns = filter::plane(size, field.height, |x, y| {
        let near = field.texels[field.index(x, y)];
        if x < margin {
            blend.of(near, field.texels[field.index(x + size, y)], x, margin)
        } else {
            near
        }
    });
    filter::plane(size, size, |x, y| {
        let near = columns.texels[columns.index(x, y)];
        if y < margin {
            blend.of(near, columns.texels[columns.index(x, y + size)], y, margin)
        } else {
            near
        }
    })
}

/// What a blend of two values keeps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Blend {
    /// The variance of fields of mean 0.
    Variance,
    /// The range, 0..1 of cover.
    Range,
}

impl Blend {
    fn of(self, near: f32, far: f32, i: u32, margin: u32) -> f32 {
        let w = filter::smoothstep(0.0, 1.0, (i as f32 + 0.5) / margin as f32);
        let mixed = w * near + (1.0 - w) * far;
        match self {
            Blend::Variance => mixed / libm::sqrtf(w * w + (1.0 - w) * (1.0 - w)),
            Blend::Range => mixed,
        }
    }
}

//! The photo channel: how much cloud a photograph shows, made seamless.
//!
//! # Theory
//! A clear sky is blue and a cloud is grey, so the ratio of red to blue tells cloud from sky
//! (C. N. Long, J. M. Sabburg, J. Calbo, D. Pages, "Retrieving Cloud Characteristics from Ground-Based
//! Daytime Color All-Sky Images", J. Atmos. Oceanic Technol. 23, 2006). A JPEG stores colour in coarse
//! blocks, so here the ratio is blurred and gives the large shapes alone; the fine structure comes from
//! luminance, divided by its own wide blur so that no uneven light remains. A grey picture, or one of a single tint, has
//! no ratio to go by: all of its channel comes from luminance.
//!
//! The tile is closed by blending a margin with the opposite side. Plain blending averages two
//! uncorrelated pictures and loses contrast; dividing by `sqrt(w^2 + (1-w)^2)` keeps the variance
//! (E. Heitz, F. Neyret, "High-Performance By-Example Noise using a Histogram-Preserving Blending
//! Operator", HPG 2018, eq. 5; the field's nearly Gaussian histogram makes their transform unnecessary).
//!
//! # Practice
//! Most of the channel is near 0 and the thickest parts reach 1. The runtime magnifies it and multiplies
//! its contrast by up to five, so it ends with a blur that leaves nothing sharper than a few texels.

mod cover;
#[cfg(test)]
mod tests;

use welkin_pack::Image;

use crate::error::{BakeError, unfit};
use crate::filter::{self, Edge};
use crate::load::{self, Photograph};
use crate::settings::PhotoSettings;

/// The photograph that is used when a recipe names none; assets-src/SOURCES.md says whose it is.
#[cfg(feature = "photo")]
pub(crate) const BUILT_IN: Option<&[u8]> = Some(include_bytes!(
    "../../../assets-src/photos/god-rays-1024.png"
));
/// It is larger than the rest of the library, so that it may be left out.
#[cfg(not(feature = "photo"))]
pub(crate) const BUILT_IN: Option<&[u8]> = None;

/// BLAKE3 of its bytes, in lower-case hexadecimal.
pub(crate) const BUILT_IN_BLAKE3: &str =
    "523490efb81147a06951731826110f864652dd1211cad5d043da3214911259b5";

/// The name of the built-in photograph in errors and, without the feature `photo`, among the files in memory.
pub const BUILT_IN_NAME: &str = "built-in photograph";

/// Share of the tile that is blended with the opposite side.
const MARGIN: f32 = 0.25;

/// Blur of the red/blue ratio, as a share of the working image: above a JPEG's chroma blocks.
const RATIO_BLUR: f32 = 0.012;

/// Blur that stands for the uneven light on the clouds, as a share of the working image.
const LIGHT_BLUR: f32 = 0.11;

/// Blur that measures the local contrast, as a share of the working image.
const EVEN_BLUR: f32 = 0.12;

/// Weight of the large shapes against the fine structure, which has weight 1.
const SHAPE_WEIGHT: f32 = 1.2;

/// The last blur: a mix of a narrow and a wide Gaussian, in texels of a tile of 512. The narrow one keeps
/// the shapes of edges, the wide one takes part of the contrast from everything of a few texels.
const SMOOTH_TEXELS: [f32; 2] = [1.8, 5.5];

/// Weight of the narrow Gaussian.
const NARROW_SHARE: f32 = 0.4;

/// Least standard deviation of luminance, 0..1: less is a blank picture, whose noise would be stretched to clouds.
const LEAST_CONTRAST: f32 = 1.0 / 255.0;

/// Least standard deviation of the blurred ratio from that of the picture's own tint: one step of a byte at middle grey.
/// Up to half of it is the rounding of the bytes; from there on the ratio counts more and more, and from here on fully.
const LEAST_TINT: f32 = 1.0 / 255.0 / (0.5 + DARK);

/// What is added to red and blue: a dark texel has no colour worth the name, and so its ratio stays near 1.
const DARK: f32 = 1.0 / 32.0;

/// Standard deviations that shapes and fine structure are divided by at least: one step of a byte.
const LEAST_SPREAD: f32 = 1.0 / 255.0;

/// The same of their sum, which is 1 and more in a picture that has either.
const LEAST_SUM: f32 = 0.5;

/// Contrast that has to be left of it when all that is finer than a few texels is gone.
const LEAST_LEFT: f32 = 1.0 / 64.0;

/// Share of the tile left quite clear.
const CLEAR: f32 = 0.05;

/// Where outliers are bent in, in standard deviations.
const OUTLIER: f32 = 8.0;

/// A photograph made into a seamless cloud channel: one channel, `settings.size` texels a side, 0..1.
///
/// `file_name` names the bytes in errors. Where the picture has an alpha channel, what is transparent is clear sky.
///
/// # Errors
/// [`BakeError::Decode`] or [`BakeError::Photo`].
pub fn photo_channel(
    image_bytes: &[u8],
    file_name: &str,
    settings: &PhotoSettings,
) -> Result<Image, BakeError> {
    photo_tile(image_bytes, file_name, settings).map(|tile| tile.channel)
}

/// The channel of a photograph, and what was taken of it.
#[derive(Clone, Debug, PartialEq)]
pub struct PhotoTile {
    /// What [`photo_channel`] gives.
    pub channel: Image,
    /// Columns and rows of the photograph, upright.
    pub size: [u32; 2],
    /// Left, top, width and height of the part that was used, in texels of the photograph.
    pub region: [u32; 4],
}

/// The same as [`photo_channel`], with what was taken of the photograph.
///
/// # Errors
/// As [`photo_channel`].
pub fn photo_tile(
    image_bytes: &[u8],
    file_name: &str,
    settings: &PhotoSettings,
) -> Result<PhotoTile, BakeError> {
    let photograph = load::decode(image_bytes, file_name)?;
    tile(&photograph, file_name, settings)
}

fn tile(
    photograph: &Photograph,
    file: &str,
    settings: &PhotoSettings,
) -> Result<PhotoTile, BakeError> {
    let size = settings.size;
    let margin = (size as f32 * MARGIN) as u32;
    let work = size + margin;
    let Photograph { colours, cover } = photograph;
    let region = middle_square(colours);
    let part = |image, channel| filter::resample(&cut(image, region, channel), work, work);
    let mut rgb = [0, 1, 2].map(|channel| part(colours, channel));
    let cover = cover.as_ref().map(|cover| cover::limited(part(cover, 0)));
    if let Some(cover) = &cover {
        rgb.iter_mut().for_each(|image| cover::fill(image, cover));
    }
    let [red, green, blue] = rgb;
    let luminance = filter::plane(work, work, |x, y| {
        let i = red.index(x, y);
        // Rec. 709 luma weights, ITU-R BT.709-6, item 3.2.
        0.2126 * red.texels[i] + 0.7152 * green.texels[i] + 0.0722 * blue.texels[i]
    });
    let mut cloud = match &cover {
        // An even cloud is fit for use if its outline is there.
        Some(cover) if cover.mean_and_spread(0).1 >= LEAST_CONTRAST => {
            cover::clear(cloudiness(&red, &blue, &luminance), cover)
        }
        _ => {
            verify_contrast(file, "contrast", &luminance, LEAST_CONTRAST)?;
            cloudiness(&red, &blue, &luminance)
        }
    };
    cloud = soften(&close(&cloud, size, margin));
    verify_contrast(file, "contrast of its clouds", &cloud, LEAST_LEFT)?;
    filter::calibrate(&mut cloud, CLEAR, OUTLIER, settings.mean);
    verify_contrast(file, "contrast of its channel", &cloud, LEAST_CONTRAST)?;
    Ok(PhotoTile {
        channel: cloud,
        size: [colours.width, colours.height],
        region,
    })
}

/// Refuses an image that is nearly constant.
fn verify_contrast(
    file: &str,
    key: &'static str,
    image: &Image,
    least: f32,
) -> Result<(), BakeError> {
    let (_, contrast) = image.mean_and_spread(0);
    if contrast >= least {
        return Ok(());
    }
    let expected = format!("at least {least:.5}; choose a picture that shows clouds");
    Err(unfit(file, key, format!("{contrast:.5}"), expected))
}

/// The largest square in the middle: left, top, width, height.
fn middle_square(picture: &Image) -> [u32; 4] {
    let side = picture.width.min(picture.height);
    [
        (picture.width - side) / 2,
        (picture.height - side) / 2,
        side,
        side,
    ]
}

/// A part of one channel.
fn cut(picture: &Image, [left, top, width, height]: [u32; 4], channel: usize) -> Image {
    filter::plane(width, height, |x, y| {
        picture.texels[picture.index(left + x, top + y) + channel]
    })
}

/// Large shapes from the ratio of red to blue, fine structure from flattened luminance; mean 0, spread 1.
fn cloudiness(red: &Image, blue: &Image, luminance: &Image) -> Image {
    let (width, height) = (red.width, red.height);
    let ratio = filter::plane(width, height, |x, y| {
        let i = red.index(x, y);
        (red.texels[i] + DARK) / (blue.texels[i] + DARK)
    });
    let weight = SHAPE_WEIGHT * colourfulness(red, blue, &ratio);
    let mut shape = flatten(
        &filter::wide_blur(&ratio, RATIO_BLUR * width as f32),
        1.5 * LIGHT_BLUR,
    );
    let mut fine = flatten(luminance, LIGHT_BLUR);
    filter::standardise(&mut shape, LEAST_SPREAD);
    filter::standardise(&mut fine, LEAST_SPREAD);
    let cloud = filter::plane(width, height, |x, y| {
        let i = shape.index(x, y);
        weight * shape.texels[i] + fine.texels[i]
    });
    even_out(&cloud)
}

/// 1 where the ratio of red to blue tells something, 0 where it is that of one tint but for the rounding of bytes: then red
/// is everywhere the same share of blue, and what the ratio does follows from luminance.
fn colourfulness(red: &Image, blue: &Image, ratio: &Image) -> f32 {
    let sum = |of: fn(f64, f64) -> f64| {
        let pairs = red.texels.iter().zip(&blue.texels);
        pairs.map(|(&r, &b)| of(r.into(), b.into())).sum::<f64>()
    };
    // The share that fits best. Without any blue there is no ratio either.
    let share = (sum(|r, b| r * b) / sum(|_, b| b * b).max(f64::MIN_POSITIVE)) as f32;
    let off = filter::plane(ratio.width, ratio.height, |x, y| {
        let i = ratio.index(x, y);
        ratio.texels[i] - (share * blue.texels[i] + DARK) / (blue.texels[i] + DARK)
    });
    let blurred = filter::wide_blur(&off, RATIO_BLUR * ratio.width as f32);
    let (_, spread) = blurred.mean_and_spread(0);
    (2.0 * spread / LEAST_TINT - 1.0).clamp(0.0, 1.0)
}

fn soften(tile: &Image) -> Image {
    let scale = tile.width as f32 / 512.0;
    let [narrow, wide] =
        SMOOTH_TEXELS.map(|sigma| filter::gaussian_blur(tile, sigma * scale, Edge::Wrap));
    filter::plane(tile.width, tile.height, |x, y| {
        let i = tile.index(x, y);
        NARROW_SHARE * narrow.texels[i] + (1.0 - NARROW_SHARE) * wide.texels[i]
    })
}

/// Divides by the local contrast, so that no part of the tile stands out and betrays the repetition.
fn even_out(cloud: &Image) -> Image {
    let square = filter::plane(cloud.width, cloud.height, |x, y| {
        let value = cloud.texels[cloud.index(x, y)];
        value * value
    });
    let variance = filter::wide_blur(&square, EVEN_BLUR * cloud.width as f32);
    let mut even = filter::plane(cloud.width, cloud.height, |x, y| {
        let i = cloud.index(x, y);
        cloud.texels[i] / libm::sqrtf(variance.texels[i].max(0.0) + 1.0)
    });
    filter::standardise(&mut even, LEAST_SUM);
    even
}

/// An image relative to its wide blur.
fn flatten(image: &Image, share: f32) -> Image {
    let light = filter::wide_blur(image, share * image.width as f32);
    filter::plane(image.width, image.height, |x, y| {
        let i = image.index(x, y);
        image.texels[i] / light.texels[i].max(1.0 / 255.0) - 1.0
    })
}

/// Cuts a tile of `size` texels whose first `margin` columns and rows are blended with those beyond its far sides.
fn close(field: &Image, size: u32, margin: u32) -> Image {
    let columns = filter::plane(size, field.height, |x, y| {
        let near = field.texels[field.index(x, y)];
        if x < margin {
            blend(near, field.texels[field.index(x + size, y)], x, margin)
        } else {
            near
        }
    });
    filter::plane(size, size, |x, y| {
        let near = columns.texels[columns.index(x, y)];
        if y < margin {
            blend(near, columns.texels[columns.index(x, y + size)], y, margin)
        } else {
            near
        }
    })
}

fn blend(near: f32, far: f32, i: u32, margin: u32) -> f32 {
    let w = filter::smoothstep(0.0, 1.0, (i as f32 + 0.5) / margin as f32);
    (w * near + (1.0 - w) * far) / libm::sqrtf(w * w + (1.0 - w) * (1.0 - w))
}

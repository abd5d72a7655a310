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

mod amount;
mod cloudiness;
mod cover;
mod cut;
mod fourier;
mod horizon;
mod part;
mod projection;
mod seam;
#[cfg(test)]
mod tests;
mod view;

use welkin_pack::Image;

use cloudiness::{cloudiness, with_fine_structure};
use seam::{Blend, close, soften};
use view::View;

use crate::error::{BakeError, unfit, unfit_size};
use crate::filter::{self, Edge};
use crate::load::{self, Photograph, Reading};
use crate::settings::{PhotoRegion, PhotoSeam, PhotoSettings};

/// The photograph that is used when a recipe names none; assets-src/SOURCES.md says whose it is.
#[cfg(feature = "photo")]
pub(crate) const BUILT_IN: Option<&[u8]> = Some(include_bytes!(concat!(
    env!("WELKIN_ASSETS"),
    "/photos/god-rays-1024.png"
)));
/// It is larger than the rest of the library, so that it may be left out.
#[cfg(not(feature = "photo"))]
pub(crate) const BUILT_IN: Option<&[u8]> = None;

/// BLAKE3 of its bytes, in lower-case hexadecimal.
pub(crate) const BUILT_IN_BLAKE3: &str =
    "523490efb81147a06951731826110f864652dd1211cad5d043da3214911259b5";

/// The name of the built-in photograph in errors and, without the feature `photo`, among the files in memory.
pub const BUILT_IN_NAME: &str = "built-in photograph";

/// The bytes of the built-in photograph, if it is compiled in.
pub fn built_in_photo() -> Option<&'static [u8]> {
    BUILT_IN
}

/// Share of the tile that is blended with the opposite side.
const MARGIN: f32 = 0.25;

/// Least standard deviation of luminance, 0..1: less is a blank picture, whose noise would be stretched to clouds.
const LEAST_CONTRAST: f32 = 1.0 / 255.0;

/// Contrast that has to be left of it when all that is finer than a few texels is gone.
const LEAST_LEFT: f32 = 1.0 / 64.0;

/// Blur of a tile that was closed by a cut, in texels: the ratio of second to first differences of clouds whose energy falls by the third
/// power of the wave number is then `1 / (sqrt(2) 0.75)`, and the rule `smooth` of `check` allows 1.
const CUT_BLUR: f32 = 0.75;

/// Share of the tile left quite clear.
const CLEAR: f32 = 0.05;

/// Where outliers are bent in, in standard deviations.
const OUTLIER: f32 = 8.0;

/// The bytes of a picture, and its name for errors.
#[derive(Clone, Copy, Debug)]
pub struct PhotoFile<'a> {
    /// What errors call it.
    pub name: &'a str,
    /// What is in it.
    pub bytes: &'a [u8],
}

/// The channel of a photograph, and what was taken of it.
#[derive(Clone, Debug, PartialEq)]
pub struct PhotoTile {
    /// One channel, `settings.size` texels a side, 0..1, seamless.
    pub channel: Image,
    /// Columns and rows of the photograph, upright.
    pub size: [u32; 2],
    /// Left, top, width and height of the part that was used, in texels of the photograph.
    pub region: [u32; 4],
    /// Points of the outline of the square that was used, close to each other, in texels of the photograph.
    pub outline: Vec<[f32; 2]>,
    /// Red, green and blue of the photograph, upright, 0..1, encoded as sRGB.
    pub picture: Image,
    /// How much of it counts, by its alpha and its mask; all if absent.
    pub cover: Option<Image>,
    /// Red, green and blue of the square, as the layer of clouds is seen from below.
    pub plan: Image,
}

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
    let picture = PhotoFile {
        name: file_name,
        bytes: image_bytes,
    };
    photo_tile(picture, None, settings).map(|tile| tile.channel)
}

/// The same as [`photo_channel`], with a mask and with what was taken of the photograph.
///
/// The mask is a picture as large as the photograph is when upright: where it is white there is cloud, where it is black none.
///
/// # Errors
/// As [`photo_channel`].
pub fn photo_tile(
    picture: PhotoFile,
    mask: Option<PhotoFile>,
    settings: &PhotoSettings,
) -> Result<PhotoTile, BakeError> {
    let reading = if settings.as_is {
        Reading::Values
    } else {
        Reading::Photograph
    };
    let mut photograph = load::decode(picture.bytes, picture.name, reading)?;
    if let Some(mask) = mask {
        let Photograph { colours, cover } = load::decode(mask.bytes, mask.name, Reading::Values)?;
        let values = amount::values(&colours);
        photograph.cover = Some(cover::mask(values, cover, &photograph, mask.name)?);
    }
    tile(photograph, picture.name, settings)
}

fn tile(
    photograph: Photograph,
    file: &str,
    settings: &PhotoSettings,
) -> Result<PhotoTile, BakeError> {
    let colours = &photograph.colours;
    let view = View::of(colours, file, settings)?;
    let channel = if settings.as_is {
        as_is(&photograph, view.bounds(), file, settings)?
    } else {
        clouds(&photograph, &view, file, settings)?
    };
    verify_contrast(file, "contrast of its channel", &channel, LEAST_CONTRAST)?;
    Ok(PhotoTile {
        channel,
        size: [colours.width, colours.height],
        region: view.bounds(),
        outline: view.outline(),
        plan: plan(colours, &view, settings.size),
        picture: photograph.colours,
        cover: photograph.cover,
    })
}

/// Three channels of the square.
fn plan(colours: &Image, view: &View, size: u32) -> Image {
    let planes = [0, 1, 2].map(|channel| view.taken(colours, channel, size));
    let mut plan = Image::new(size, size, 3);
    for (i, texel) in plan.texels.chunks_exact_mut(3).enumerate() {
        let values = planes
            .each_ref()
            .map(|plane| plane.texels[i].clamp(0.0, 1.0));
        texel.copy_from_slice(&values);
    }
    plan
}

/// The clouds of a photograph.
fn clouds(
    photograph: &Photograph,
    view: &View,
    file: &str,
    settings: &PhotoSettings,
) -> Result<Image, BakeError> {
    let size = settings.size;
    let margin = (size as f32 * MARGIN) as u32;
    let work = size + margin;
    let Photograph { colours, cover } = photograph;
    let mut rgb = [0, 1, 2].map(|channel| view.taken(colours, channel, work));
    rgb.iter_mut()
        .for_each(|c| amount::level(c, settings.levels));
    let cover = cover
        .as_ref()
        .map(|cover| cover::limited(view.taken(cover, 0, work)));
    if let Some(cover) = &cover {
        rgb.iter_mut().for_each(|image| cover::fill(image, cover));
    }
    let luminance = amount::luminance(&rgb);
    let [red, _, blue] = &rgb;
    // An even cloud is fit for use if its outline is there.
    let outline = cover.as_ref().map_or(0.0, |c| c.mean_and_spread(0).1);
    if outline < LEAST_CONTRAST {
        verify_contrast(file, "contrast", &luminance, LEAST_CONTRAST)?;
    }
    let mut cloud = match settings.seam {
        PhotoSeam::Blend => cloudiness(red, blue, &luminance, settings.flatten),
        PhotoSeam::Cut => with_fine_structure(red, blue, &luminance, settings.flatten),
    };
    if settings.invert {
        cloud.texels.iter_mut().for_each(|value| *value = -*value);
    }
    let mut channel = match settings.seam {
        PhotoSeam::Blend => {
            cloud = close(&cloud, size, margin, Blend::Variance);
            if let Some(cover) = &cover {
                cloud = cover::clear(cloud, &close(cover, size, margin, Blend::Range));
            }
            soften(&cloud, settings.sharpness)
        }
        PhotoSeam::Cut => {
            if let Some(cover) = &cover {
                cloud = cover::clear(cloud, cover);
            }
            let tile = cut::close(&cloud, size, margin);
            filter::gaussian_blur(&tile, CUT_BLUR / settings.sharpness, Edge::Wrap)
        }
    };
    verify_contrast(file, "contrast of its clouds", &channel, LEAST_LEFT)?;
    // Only a tile that is taken as it is has none.
    let mean = settings.mean.unwrap_or(PhotoSettings::MEAN);
    if filter::stretch(&mut channel, CLEAR, OUTLIER) {
        verify_share(file, &channel, mean)?;
        filter::raise_to_mean(&mut channel, mean);
        return Ok(channel);
    }
    channel.texels.fill(mean);
    Ok(channel)
}

/// A tile that somebody has finished: values as they are stored, in another size.
fn as_is(
    photograph: &Photograph,
    region: [u32; 4],
    file: &str,
    settings: &PhotoSettings,
) -> Result<Image, BakeError> {
    let Photograph { colours, cover } = photograph;
    let whole = region == [0, 0, colours.width, colours.height];
    if !whole && settings.region == PhotoRegion::Middle {
        let expected = "as wide as high, since it is taken as it is; cut it, or give `region`";
        let size = [colours.width, colours.height];
        return Err(unfit_size(file, size, expected.to_string()));
    }
    // A whole tile goes on beyond its sides.
    let edge = if whole { Edge::Wrap } else { Edge::Mirror };
    let size = settings.size;
    let scaled = |image: &Image| {
        let part = part::cut(image, region, 0);
        if part.width == size {
            part
        } else {
            filter::resample_to(&part, size, size, edge)
        }
    };
    let mut channel = scaled(&amount::values(colours));
    amount::level(&mut channel, settings.levels);
    for value in &mut channel.texels {
        *value = value.clamp(0.0, 1.0);
        if settings.invert {
            *value = 1.0 - *value;
        }
    }
    if let Some(cover) = cover {
        let cover = cover::limited(scaled(cover));
        let pairs = channel.texels.iter_mut().zip(&cover.texels);
        pairs.for_each(|(value, cover)| *value *= cover);
    }
    if let Some(mean) = settings.mean {
        verify_share(file, &channel, mean)?;
        filter::raise_to_mean(&mut channel, mean);
    }
    Ok(channel)
}

/// Refuses values of which fewer are cloud than the mean asks for: since none is more than 1, the mean would come from what is
/// less than a step of a byte.
fn verify_share(file: &str, channel: &Image, mean: f32) -> Result<(), BakeError> {
    let cloud = channel.texels.iter().filter(|v| **v >= LEAST_CONTRAST);
    let share = cloud.count() as f32 / channel.texels.len() as f32;
    if share >= mean {
        return Ok(());
    }
    let expected = format!(
        "at least {mean}, which is `clouds.photo.mean`; choose a picture that shows more clouds, or another mean"
    );
    Err(unfit(
        file,
        "share of texels with contrast",
        format!("{share:.4}"),
        expected,
    ))
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

//! Pictures of channels, each once on the page however often it is shown.

use std::fmt::Write;

use anyhow::Result;
use data_encoding::BASE64;
use image::imageops::{self, FilterType};
use image::{ExtendedColorType, GrayImage, ImageBuffer, Pixel, RgbImage};
use welkin_pack::texture::unorm8;
use welkin_pack::{Image, Role};

use crate::cli::{picture, preview};

/// What is not a finite number.
const NOT_FINITE: [u8; 3] = [255, 0, 255];

/// The pictures of a page, as rules of its style sheet: a picture and its 2x2 view are one.
#[derive(Default)]
pub struct Pictures {
    count: usize,
    css: String,
}

impl Pictures {
    /// Adds a picture and gives the class that shows it.
    fn add(
        &mut self,
        width: u32,
        height: u32,
        colour: ExtendedColorType,
        pixels: &[u8],
    ) -> Result<String> {
        let png = picture::png(width, height, colour, pixels)?;
        let name = format!("p{}", self.count);
        self.count += 1;
        writeln!(
            self.css,
            ".{name}{{background-image:url(data:image/png;base64,{})}}",
            BASE64.encode(&png)
        )?;
        Ok(name)
    }

    /// The rules.
    pub fn css(&self) -> &str {
        &self.css
    }
}

/// A picture as it is shown.
pub struct Shown {
    /// The class that shows it.
    pub class: String,
    /// Pixels a row and rows.
    pub size: [u32; 2],
}

/// Adds a channel, as an image of that alone, at most `most` pixels a side: records are cut, all else is averaged.
pub fn channel(
    pictures: &mut Pictures,
    role: Role,
    image: &Image,
    channel: usize,
    most: u32,
) -> Result<Shown> {
    let curve = preview::curve(role, role.spec().channels[channel].name);
    let grey: Vec<u8> = image.texels.iter().map(|&v| unorm8(curve(v))).collect();
    let is_record = role.spec().filter == welkin_pack::role::Filter::Nearest;
    if image.texels.iter().all(|v| v.is_finite()) {
        let grey = GrayImage::from_raw(image.width, image.height, grey).unwrap_or_default();
        let small = fitted(&grey, most, is_record);
        let size = [small.width(), small.height()];
        let class = pictures.add(size[0], size[1], ExtendedColorType::L8, &small)?;
        return Ok(Shown { class, size });
    }
    let pixel = |(grey, value): (u8, f32)| {
        if value.is_finite() {
            [grey; 3]
        } else {
            NOT_FINITE
        }
    };
    let pixels = grey
        .into_iter()
        .zip(image.texels.iter().copied())
        .flat_map(pixel);
    let rgb = RgbImage::from_raw(image.width, image.height, pixels.collect()).unwrap_or_default();
    let small = fitted(&rgb, most, is_record);
    let size = [small.width(), small.height()];
    let class = pictures.add(size[0], size[1], ExtendedColorType::Rgb8, &small)?;
    Ok(Shown { class, size })
}

/// Adds a picture in colour, at most `most` pixels a side.
pub fn colour(pictures: &mut Pictures, whole: &RgbImage, most: u32) -> Result<Shown> {
    let small = fitted(whole, most, false);
    let size = [small.width(), small.height()];
    let class = pictures.add(size[0], size[1], ExtendedColorType::Rgb8, &small)?;
    Ok(Shown { class, size })
}

fn fitted<P>(whole: &ImageBuffer<P, Vec<u8>>, most: u32, is_record: bool) -> ImageBuffer<P, Vec<u8>>
where
    P: Pixel<Subpixel = u8> + 'static,
{
    let (width, height) = whole.dimensions();
    let longer = width.max(height).max(1);
    if longer <= most {
        return whole.clone();
    }
    if is_record {
        return imageops::crop_imm(whole, 0, 0, width.min(most), height.min(most)).to_image();
    }
    let [width, height] = [width, height]
        .map(|side| (u64::from(side) * u64::from(most) / u64::from(longer)).max(1) as u32);
    imageops::resize(whole, width, height, FilterType::Triangle)
}

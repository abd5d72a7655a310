//! Pixels to the bytes of picture files, and a texture in words.

use std::io::Cursor;

use anyhow::{Result, anyhow};
use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, LayerAttributes, Text,
    WritableImage,
};
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder};
use welkin_pack::Shape;
use welkin_pack::manifest::TextureEntry;

/// 8-bit PNG of one (grey) or three (sRGB) channels.
pub fn png(width: u32, height: u32, colour: ExtendedColorType, pixels: &[u8]) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    PngEncoder::new_with_quality(&mut bytes, CompressionType::Best, FilterType::Adaptive)
        .write_image(pixels, width, height, colour)
        .map_err(|e| {
            anyhow!("a picture of {width}x{height} cannot be encoded: {e}; choose smaller textures")
        })?;
    Ok(bytes)
}

/// Float EXR of one channel, `Y`.
pub fn grey_exr(width: u32, height: u32, values: Vec<f32>) -> Result<Vec<u8>> {
    let attributes = LayerAttributes {
        software_name: Some(Text::from(concat!("welkin ", env!("CARGO_PKG_VERSION")))),
        ..Default::default()
    };
    let channel = AnyChannel::new("Y", FlatSamples::F32(values));
    let channels = AnyChannels::sort([channel].into_iter().collect());
    let size = (width as usize, height as usize);
    let image = Image::from_layer(Layer::new(
        size,
        attributes,
        Encoding::SMALL_LOSSLESS,
        channels,
    ));
    let mut bytes = Cursor::new(Vec::new());
    image
        .write()
        .non_parallel()
        .to_buffered(&mut bytes)
        .map_err(|e| {
            anyhow!("a picture of {width}x{height} cannot be encoded: {e}; choose smaller textures")
        })?;
    Ok(bytes.into_inner())
}

/// A texture's size in words, such as `256x256 rgba8unorm, 4 layers, 1 level`.
pub fn size_of(entry: &TextureEntry) -> String {
    let counted = |n: u32, one: &str| format!("{n} {one}{}", if n == 1 { "" } else { "s" });
    let layers = match entry.shape {
        Shape::D2 => String::new(),
        Shape::Array => format!(", {}", counted(entry.layers, "layer")),
        Shape::Cube => format!(", {}", counted(entry.layers, "face")),
    };
    let (width, height, format) = (entry.width, entry.height, entry.format.name());
    let levels = counted(entry.levels, "level");
    format!("{width}x{height} {format}{layers}, {levels}")
}

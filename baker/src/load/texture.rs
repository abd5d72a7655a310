//! Textures that another tool made, for the checks: PNG, OpenEXR, KTX2.

use std::io::Cursor;

use exr::meta::MetaData;
use exr::prelude::{ReadChannels, ReadLayers, f16, read};
use image::{DynamicImage, ImageFormat};
use welkin_pack::role::RoleSpec;
use welkin_pack::{Format, Image, Role, Shape, Texture, ktx};

use super::exr as open_exr;
use super::stored::{MAX_FILE_BYTES, MAX_SIDE, decode_stored};
use crate::error::{BakeError, too_long, unfit, unfit_size};

/// A texture from a file, laid out as its role asks.
#[derive(Clone, Debug, PartialEq)]
pub struct TextureFile {
    /// The texture; level 0 alone if the file has no others.
    pub texture: Texture,
    /// What was changed on the way, a sentence each.
    pub notes: Vec<String>,
}

const KTX2: &[u8] = b"\xabKTX 20\xbb\r\n\x1a\n";
const PNG: &[u8] = b"\x89PNG\r\n\x1a\n";
const EXR: &[u8] = b"\x76\x2f\x31\x01";

/// Reads a texture of a role from the bytes of a PNG, OpenEXR or KTX2 file; its first bytes say which. `file` names it in errors.
///
/// Values are taken as they are stored, without any gamma: 0..1 in a PNG. Channels are red, green, blue and alpha in the order
/// of the role; a role of two channels also takes grey and alpha, one of one channel takes grey. An OpenEXR file may instead name
/// its channels as the role does. Layers and faces lie one below the other, each with the proportions that the role has by default:
/// as high as wide, but for `sky`, where they are twice as high. A KTX2 file is taken as it is.
///
/// PNG values of 16 bits are rounded to bytes; floats become half floats where the role has them, else bytes.
///
/// With `channel`, an index, the file is one grey tile, and the other channels of the texture are 0.
///
/// # Errors
/// [`BakeError::Photo`], [`BakeError::Decode`] or [`BakeError::Pack`], which name the file, what was found and what was expected.
pub fn decode_texture(
    bytes: &[u8],
    file: &str,
    role: Role,
    channel: Option<usize>,
) -> Result<TextureFile, BakeError> {
    if bytes.len() as u64 > MAX_FILE_BYTES {
        return Err(too_long(file, MAX_FILE_BYTES));
    }
    let wanted = Wanted {
        file,
        role,
        channel,
    };
    let (texture, notes) = if bytes.starts_with(KTX2) {
        if channel.is_some() {
            let expected = "PNG or OpenEXR for one channel alone";
            return Err(unfit(file, "format", "KTX2", expected));
        }
        (ktx::decode(file, bytes)?, Vec::new())
    } else if bytes.starts_with(PNG) {
        wanted.read_png(bytes)?
    } else if bytes.starts_with(EXR) {
        wanted.read_exr(bytes)?
    } else {
        let expected = "a PNG, OpenEXR or KTX2 file; convert it";
        return Err(unfit(file, "format", "unknown", expected));
    };
    role.verify_texture(file, &texture)?;
    Ok(TextureFile { texture, notes })
}

/// What is asked of a picture.
#[derive(Clone, Copy)]
struct Wanted<'a> {
    file: &'a str,
    role: Role,
    channel: Option<usize>,
}

type Read = (Texture, Vec<String>);

impl Wanted<'_> {
    fn spec(self) -> &'static RoleSpec {
        self.role.spec()
    }

    /// Names of the channels that the file should have.
    fn names(self) -> Vec<&'static str> {
        let names: Vec<_> = self.spec().channels.iter().map(|c| c.name).collect();
        match self.channel {
            Some(channel) => vec![names[channel]],
            None => names,
        }
    }

    /// An error about the channels of a picture.
    fn channels(self, found: impl ToString) -> BakeError {
        let names = self.names();
        let expected = match names.len() {
            1 => format!("grey: {}", names[0]),
            n => format!("{n}: {}", names.join(", ")),
        };
        unfit(self.file, "channels", found, expected)
    }

    fn fits(self, width: u32, height: u32) -> Result<(), BakeError> {
        let most = u64::from(MAX_SIDE) * u64::from(self.spec().layers[1]);
        if width <= MAX_SIDE && u64::from(height) <= most {
            return Ok(());
        }
        let expected = format!("at most {MAX_SIDE} texels a side; resize it");
        Err(unfit_size(self.file, [width, height], expected))
    }

    fn read_png(self, bytes: &[u8]) -> Result<Read, BakeError> {
        let format = self.spec().formats[0];
        if format == Format::Rgba16Float {
            let expected = "OpenEXR or KTX2: the role has half floats";
            return Err(unfit(self.file, "format", "PNG", expected));
        }
        let fits = |width, height| self.fits(width, height);
        let picture = decode_stored(bytes, self.file, ImageFormat::Png, &fits)?.picture;
        let mut notes = Vec::new();
        if picture.color().bytes_per_pixel() / picture.color().channel_count() > 1 {
            notes.push(
                "its 16-bit values were rounded to bytes, as the role stores them".to_string(),
            );
        }
        let channels = usize::from(picture.color().channel_count());
        let (image, note) = self.pick(&stored(picture, channels))?;
        notes.extend(note);
        Ok((self.texture(image, format)?, notes))
    }

    /// The channels of the role out of those of a PNG.
    fn pick(self, image: &Image) -> Result<(Image, Option<String>), BakeError> {
        let names = self.names();
        let is_grey = |texel: &[f32]| match texel {
            [_] => true,
            [_, alpha] => *alpha == 1.0,
            [r, g, b] => r == g && g == b,
            [r, g, b, alpha] => r == g && g == b && *alpha == 1.0,
            _ => false,
        };
        let kind = ["grey", "grey and alpha", "RGB", "RGBA"];
        let found = || {
            let kind = kind
                .get(image.channels.wrapping_sub(1))
                .copied()
                .unwrap_or("unknown");
            format!("{} ({kind})", image.channels)
        };
        match (names.len(), image.channels) {
            (1, _) => {
                let mut texels = image.texels.chunks_exact(image.channels);
                if !texels.all(is_grey) {
                    return Err(self.channels(match image.channels {
                        2 => "grey with transparency",
                        4 => "coloured, or transparent",
                        _ => "coloured",
                    }));
                }
                Ok((first_channels(image, 1), None))
            }
            (2, 3 | 4) => {
                let note = format!(
                    "of its {} channels red and green were taken",
                    image.channels
                );
                Ok((first_channels(image, 2), Some(note)))
            }
            (wanted, has) if wanted == has => Ok((image.clone(), None)),
            _ => Err(self.channels(found())),
        }
    }

    fn read_exr(self, bytes: &[u8]) -> Result<Read, BakeError> {
        let failed = |error| open_exr::failed(self.file, error);
        let meta = MetaData::read_from_buffered(Cursor::new(bytes), false).map_err(failed)?;
        let Some(header) = meta.headers.iter().find(|header| !header.deep) else {
            return Err(unfit(self.file, "content", "deep data", "a flat picture"));
        };
        open_exr::verify(header, self.file)?;
        let (width, height) = (header.layer_size.x() as u32, header.layer_size.y() as u32);
        self.fits(width, height)?;
        let names: Vec<String> = header
            .channels
            .list
            .iter()
            .map(|c| c.name.to_string())
            .collect();
        let Some(order) = self.order(&names) else {
            return Err(self.channels(open_exr::channel_names(&meta.headers)));
        };
        let picture = read()
            .no_deep_data()
            .largest_resolution_level()
            .all_channels()
            .first_valid_layer()
            .all_attributes()
            .non_parallel()
            .from_buffered(Cursor::new(bytes))
            .map_err(failed)?;
        let channels = picture.layer_data.channel_data.list;
        let mut image = Image::new(width, height, order.len());
        for (target, source) in order.into_iter().enumerate() {
            let values = channels.get(source).map(|c| &c.sample_data);
            let values = values.filter(|v| v.len() == width as usize * height as usize);
            let Some(values) = values else {
                return Err(self.channels("subsampled"));
            };
            let texels = image.texels.iter_mut().skip(target).step_by(image.channels);
            texels
                .zip(values.values_as_f32())
                .for_each(|(texel, value)| *texel = value);
        }
        if self.spec().formats.contains(&Format::Rgba16Float) {
            return Ok((self.texture(image, Format::Rgba16Float)?, Vec::new()));
        }
        self.verify_unorm(&image)?;
        let note = "its floats were rounded to bytes, as the role stores them".to_string();
        Ok((self.texture(image, self.spec().formats[0])?, vec![note]))
    }

    /// Where in an OpenEXR file's list the channels of the role are.
    fn order(self, found: &[String]) -> Option<Vec<usize>> {
        let names = self.names();
        let place = |name: &str| found.iter().position(|n| n == name);
        let of_role: Option<Vec<_>> = names.iter().map(|name| place(name)).collect();
        of_role
            .or_else(|| {
                ["R", "G", "B", "A"][..names.len()]
                    .iter()
                    .map(|n| place(n))
                    .collect()
            })
            .filter(|_| names.len() > 1 || found.len() == 1)
            .or_else(|| (names.len() == 1 && found.len() == 1).then(|| vec![0]))
    }

    /// What a byte cannot hold is refused, not cut off.
    fn verify_unorm(self, image: &Image) -> Result<(), BakeError> {
        let half_step = 0.5 / 255.0;
        let fits = |v: &f32| (-half_step..=1.0 + half_step).contains(v);
        match image.texels.iter().position(|v| !fits(v)) {
            None => Ok(()),
            Some(index) => {
                let texel = index / image.channels;
                let (x, y) = (texel % image.width as usize, texel / image.width as usize);
                let found = format!("{} at ({x}, {y})", image.texels[index]);
                Err(unfit(
                    self.file,
                    "value",
                    found,
                    "0 to 1: the role is stored as bytes",
                ))
            }
        }
    }

    fn texture(self, image: Image, format: Format) -> Result<Texture, BakeError> {
        let spec = self.spec();
        let (width, rows) = (image.width, image.height);
        let height = width * spec.size[1] / spec.size[0];
        let layers = match spec.shape {
            Shape::D2 => 1,
            Shape::Array | Shape::Cube if rows.is_multiple_of(height) => rows / height,
            Shape::Array | Shape::Cube => {
                let expected = format!("layers of {width}x{height}, one below the other");
                return Err(unfit_size(self.file, [width, rows], expected));
            }
        };
        let image = match self.channel {
            Some(channel) => alone(&image, channel, spec.channels.len()),
            None => image,
        };
        Ok(Texture {
            format,
            shape: spec.shape,
            width,
            height: rows / layers,
            layers,
            levels: vec![encode(format, &image.texels)],
        })
    }
}

/// A PNG's values, 0..1.
fn stored(picture: DynamicImage, channels: usize) -> Image {
    let (width, height) = (picture.width(), picture.height());
    let bytes = |raw: Vec<u8>| raw.into_iter().map(|v| f32::from(v) / 255.0).collect();
    let words = |raw: Vec<u16>| raw.into_iter().map(|v| f32::from(v) / 65535.0).collect();
    let texels = match picture {
        DynamicImage::ImageLuma8(p) => bytes(p.into_raw()),
        DynamicImage::ImageLumaA8(p) => bytes(p.into_raw()),
        DynamicImage::ImageRgb8(p) => bytes(p.into_raw()),
        DynamicImage::ImageRgba8(p) => bytes(p.into_raw()),
        DynamicImage::ImageLuma16(p) => words(p.into_raw()),
        DynamicImage::ImageLumaA16(p) => words(p.into_raw()),
        DynamicImage::ImageRgb16(p) => words(p.into_raw()),
        // A PNG has no other; whatever it is, this has four channels.
        other => words(other.into_rgba16().into_raw()),
    };
    Image {
        width,
        height,
        channels,
        texels,
    }
}

fn first_channels(image: &Image, count: usize) -> Image {
    let texels = image.texels.chunks_exact(image.channels);
    Image {
        width: image.width,
        height: image.height,
        channels: count,
        texels: texels
            .flat_map(|texel| texel[..count].iter().copied())
            .collect(),
    }
}

/// One channel of a texel of `channels`, the others 0.
fn alone(grey: &Image, channel: usize, channels: usize) -> Image {
    let mut image = Image::new(grey.width, grey.height, channels);
    let texels = image.texels.chunks_exact_mut(channels);
    texels
        .zip(&grey.texels)
        .for_each(|(texel, value)| texel[channel] = *value);
    image
}

/// As a pack stores values, but for half floats that are not finite: they stay, so that the checks see them.
fn encode(format: Format, values: &[f32]) -> Vec<u8> {
    match format {
        Format::Rgba16Float => {
            let halves = values.iter().map(|&v| f16::from_f32(v).to_le_bytes());
            halves.flatten().collect()
        }
        _ => welkin_pack::texture::encode(format, values),
    }
}

//! KTX2 files: the container of one texture.
//!
//! Khronos Group, "KTX File Format Specification", version 2.0. The crate `ktx2` parses headers and
//! builds the data format descriptor; this file lays out the sections, inflates the levels, and refuses
//! whatever does not match what it claims before it allocates for it. `sections.rs` compares every offset and length
//! with the only ones that a file may have, `key_values.rs` reads the key/value data. docs/pack-format.md lists the
//! rules, and those of Khronos's own validator that are not ours.
//!
//! Layout written: header, level index, descriptor, key/value data, levels from the smallest to the
//! largest. Levels are compressed with Zstandard one by one. The descriptor keeps its `bytesPlane`
//! values, as the current revision of the specification asks for compressed files too.

mod key_values;
mod sections;

use ktx2::dfd::{Basic, Block};
use ktx2::{Header, ParseError, SupercompressionScheme};

use crate::error::PackError;
use crate::format::{Format, Shape};
use crate::limits::{MAX_LAYERS, MAX_SIDE, MAX_TEXTURE_BYTES};
use crate::texture::Texture;

#[cfg(feature = "write")]
pub use write::{encode, encode_with};

/// The largest window of a compressed level that is read whatever the level's size: 8 MiB, which RFC 8878, section
/// 3.1.1.1.2, recommends to support.
const WINDOW_BYTES: u64 = 8 << 20;

/// The largest window in all. A decoder keeps as many bytes beside the texels.
const MAX_WINDOW_BYTES: u64 = 64 << 20;

/// Reads a KTX2 file. `file` names it in errors.
///
/// # Errors
/// [`PackError::Value`] and [`PackError::TooLarge`], each naming the field of the container.
pub fn decode(file: &str, bytes: &[u8]) -> Result<Texture, PackError> {
    let bad =
        |key: &str, found: String, expected: &str| PackError::value(file, key, found, expected);
    let not_ktx2 = |e: ParseError| bad("container", e.to_string(), "a KTX2 file");
    let start = bytes
        .first_chunk()
        .ok_or_else(|| not_ktx2(ParseError::UnexpectedEnd))?;
    let header = Header::from_bytes(start).map_err(not_ktx2)?;
    let mut texture = describe(file, &header)?;
    verify_descriptor(file, bytes, &header, texture.format)?;
    let total: u64 = (0..header.level_count as usize)
        .map(|level| texture.level_bytes(level) as u64)
        .sum();
    if total > MAX_TEXTURE_BYTES {
        return Err(too_large(
            file,
            "decoded size in bytes",
            total,
            MAX_TEXTURE_BYTES,
        ));
    }
    let sections = sections::verify(file, bytes, &header, &texture)?;
    key_values::verify(file, sections.key_values)?;
    for (index, data) in sections.levels.into_iter().enumerate() {
        let key = format!("level {index}");
        let expected = texture.level_bytes(index);
        let texels = match header.supercompression_scheme {
            None => data.to_vec(),
            Some(_) => inflate(data, expected).map_err(|found| bad(&key, found, ONE_FRAME))?,
        };
        if texels.len() != expected {
            return Err(bad(
                &key,
                format!("{} bytes", texels.len()),
                &format!("{expected} bytes"),
            ));
        }
        texture.levels.push(texels);
    }
    Ok(texture)
}

fn describe(file: &str, header: &Header) -> Result<Texture, PackError> {
    let bad = |key: &str, found: String, expected: &str| {
        Err(PackError::value(file, key, found, expected))
    };
    let Some(format) = Format::ALL
        .into_iter()
        .find(|f| Some(f.vk()) == header.format)
    else {
        let found = header.format.map_or(0, |f| f.value());
        return bad(
            "vkFormat",
            found.to_string(),
            "R8, RG8 or RGBA8 UNORM, or RGBA16 SFLOAT (9, 16, 37, 97)",
        );
    };
    let (width, height) = (header.pixel_width, header.pixel_height);
    for (key, side) in [("pixelWidth", width), ("pixelHeight", height)] {
        if side > MAX_SIDE {
            return Err(too_large(file, key, side.into(), MAX_SIDE.into()));
        }
    }
    if height == 0 {
        return bad("pixelHeight", "0".into(), "1 or more: a 2-D texture");
    }
    if header.pixel_depth != 0 {
        return bad(
            "pixelDepth",
            header.pixel_depth.to_string(),
            "0: a 2-D texture",
        );
    }
    if header.layer_count > MAX_LAYERS {
        return Err(too_large(
            file,
            "layerCount",
            header.layer_count.into(),
            MAX_LAYERS.into(),
        ));
    }
    let (shape, layers) = match (header.face_count, header.layer_count) {
        (1, 0) => (Shape::D2, 1),
        (1, layers) => (Shape::Array, layers),
        (6, 0) if width == height => (Shape::Cube, 6),
        (faces, layers) => {
            let found = format!("{faces} with layerCount {layers}, {width}x{height}");
            return bad("faceCount", found, "1, or 6 square ones with layerCount 0");
        }
    };
    let all = Texture::full_level_count(width, height) as u32;
    if !(1..=all).contains(&header.level_count) {
        let expected = format!("1 to {all} for {width}x{height}");
        return bad("levelCount", header.level_count.to_string(), &expected);
    }
    if !matches!(
        header.supercompression_scheme,
        None | Some(SupercompressionScheme::Zstandard)
    ) {
        let found = format!("{:?}", header.supercompression_scheme);
        return bad("supercompressionScheme", found, "none or Zstandard");
    }
    Ok(Texture {
        format,
        shape,
        width,
        height,
        layers,
        levels: Vec::new(),
    })
}

/// Compares the descriptor with the one of the format, byte by byte. `bytesPlane` of a compressed file may be zero
/// throughout, as older revisions of the specification asked.
fn verify_descriptor(
    file: &str,
    bytes: &[u8],
    header: &Header,
    format: Format,
) -> Result<(), PackError> {
    let (block, type_size) = descriptor(file, format)?;
    let expected = descriptor_section(&block);
    let index = &header.index;
    let Some(found) = section(bytes, index.dfd_byte_offset, index.dfd_byte_length) else {
        let found = format!(
            "{} bytes at {}",
            index.dfd_byte_length, index.dfd_byte_offset
        );
        let key = "data format descriptor";
        return Err(PackError::value(file, key, found, "inside the file"));
    };
    let mut unsized_block = block;
    unsized_block.bytes_planes = [0; 8];
    let is_unsized =
        header.supercompression_scheme.is_some() && found == descriptor_section(&unsized_block);
    if found != expected && !is_unsized {
        let lengths = [found.len(), expected.len()].map(|n| format!("{n} bytes"));
        let (key, [found, expected]) = if found.len() == expected.len() {
            differing_field(found, &expected)
        } else {
            ("dfdByteLength".to_string(), lengths)
        };
        return Err(PackError::value(
            file,
            &format!("data format descriptor: {key}"),
            found,
            format!("{expected}, as linear {} has it", format.name()),
        ));
    }
    if header.type_size != type_size {
        return Err(PackError::value(
            file,
            "typeSize",
            header.type_size,
            type_size,
        ));
    }
    Ok(())
}

/// Fields of a basic block after the total size: name and bytes (Khronos Group, "Data Format Specification", 1.4,
/// section 5).
const BLOCK_FIELDS: [(&str, usize); 9] = [
    ("dfdTotalSize", 4),
    ("vendorId and descriptorType", 4),
    ("versionNumber", 2),
    ("descriptorBlockSize", 2),
    ("colorModel", 1),
    ("colorPrimaries", 1),
    ("transferFunction", 1),
    ("flags", 1),
    ("texelBlockDimension", 4),
];

/// Fields of a sample of the block.
const SAMPLE_FIELDS: [(&str, usize); 6] = [
    ("bitOffset", 2),
    ("bitLength", 1),
    ("channelType", 1),
    ("samplePosition", 4),
    ("sampleLower", 4),
    ("sampleUpper", 4),
];

/// The first field that differs, with its bytes in both descriptors, which are equally long.
fn differing_field(found: &[u8], expected: &[u8]) -> (String, [String; 2]) {
    let block = BLOCK_FIELDS.into_iter().chain([("bytesPlane", 8)]);
    let block = block.map(|(name, bytes)| (name.to_string(), bytes));
    let samples = (0..).flat_map(|sample| {
        SAMPLE_FIELDS.map(|(name, bytes)| (format!("{name} of sample {sample}"), bytes))
    });
    let mut at = 0;
    for (name, bytes) in block.chain(samples) {
        let fields = [found, expected].map(|all| all.get(at..at + bytes).unwrap_or_default());
        if fields[0] != fields[1] || at >= found.len() {
            return (name, fields.map(|bytes| format!("{bytes:02x?}")));
        }
        at += bytes;
    }
    Default::default()
}

/// The descriptor's section: its length, and one basic block.
fn descriptor_section(block: &Basic) -> Vec<u8> {
    let block = Block::Basic(block.clone()).to_vec();
    [&(block.len() as u32 + 4).to_le_bytes()[..], &block].concat()
}

fn section(bytes: &[u8], offset: u32, length: u32) -> Option<&[u8]> {
    bytes.get(offset as usize..)?.get(..length as usize)
}

/// What a compressed level is.
const ONE_FRAME: &str = "one frame of Zstandard data";

/// Inflates one level, or says what is wrong with it. It may hold more than `expected` bytes, of which one is read.
fn inflate(data: &[u8], expected: usize) -> Result<Vec<u8>, String> {
    use ruzstd::decoding::StreamingDecoder;
    use std::io::Read;
    let damaged = |e: &dyn std::fmt::Display| format!("damaged ({e})");
    let window = (expected as u64).clamp(WINDOW_BYTES, MAX_WINDOW_BYTES);
    let mut decoder =
        StreamingDecoder::new_with_max_window_size(data, window).map_err(|e| damaged(&e))?;
    let mut texels = Vec::with_capacity(expected);
    // One byte more than expected is enough to tell that there are too many.
    let mut limited = (&mut decoder).take(expected as u64 + 1);
    limited.read_to_end(&mut texels).map_err(|e| damaged(&e))?;
    if texels.len() > expected {
        return Ok(texels);
    }
    let (rest, decoder) = decoder.into_parts();
    let told = decoder.get_checksum_from_data();
    if told.is_some() && told != decoder.get_calculated_checksum() {
        return Err(damaged(&"its checksum is another"));
    }
    if !rest.is_empty() {
        return Err(format!("{} bytes longer than its frame", rest.len()));
    }
    Ok(texels)
}

/// The linear data format descriptor of a format, with its type size in bytes.
fn descriptor(file: &str, format: Format) -> Result<(Basic, u32), PackError> {
    Basic::from_format(format.vk())
        .map_err(|e| PackError::value(file, "format", e, "a format with a known descriptor"))
}

fn too_large(file: &str, key: &str, found: u64, limit: u64) -> PackError {
    PackError::TooLarge {
        file: file.to_string(),
        key: key.to_string(),
        found,
        limit,
    }
}

#[cfg(feature = "write")]
mod write {
    use ktx2::{Index, LevelIndex};
    use zstd::bulk::Compressor;
    use zstd::zstd_safe::{CParameter, Strategy};

    use super::*;

    /// The compressor's settings. Texels repeat three of their four bytes (the sunset gradient beside smooth
    /// noise, noise displaced by a texel or more), near by or one row above: so matches of three bytes in a small
    /// window, which only the optimal parser takes. That is within 3 % of the size of level 19 at a quarter of the time.
    fn compressor() -> std::io::Result<Compressor<'static>> {
        let mut compressor = Compressor::new(12)?;
        for setting in [
            CParameter::Strategy(Strategy::ZSTD_btopt),
            CParameter::MinMatch(3),
            CParameter::TargetLength(12),
            CParameter::SearchLog(2),
            CParameter::WindowLog(14),
            CParameter::HashLog(14),
            CParameter::ChainLog(14),
        ] {
            compressor.set_parameter(setting)?;
        }
        Ok(compressor)
    }

    /// Writes a texture as a KTX2 file. `writer` goes into `KTXwriter`; `file` names it in errors.
    ///
    /// # Errors
    /// [`PackError::Value`] if a level cannot be compressed.
    pub fn encode(file: &str, texture: &Texture, writer: &str) -> Result<Vec<u8>, PackError> {
        encode_with(file, texture, writer, &[])
    }

    /// The same with key/value data of an application: keys that do not begin with `KTX` or `ktx`, and texts, which are stored with
    /// a NUL at their end.
    ///
    /// # Errors
    /// [`PackError::Value`] if a level cannot be compressed, or for a key that the specification does not allow.
    pub fn encode_with(
        file: &str,
        texture: &Texture,
        writer: &str,
        texts: &[(&str, &str)],
    ) -> Result<Vec<u8>, PackError> {
        let levels: Vec<Vec<u8>> = compressor()
            .and_then(|mut compressor| {
                let levels = texture.levels.iter();
                levels.map(|level| compressor.compress(level)).collect()
            })
            .map_err(|e| PackError::value(file, "levels", e, "compressed texels"))?;
        let (basic, type_size) = descriptor(file, texture.format)?;
        let dfd = descriptor_section(&basic);
        let kvd = key_values::encode(file, writer, texts)?;
        let dfd_start = Header::LENGTH + levels.len() * LevelIndex::LENGTH;
        let header = Header {
            format: Some(texture.format.vk()),
            type_size,
            pixel_width: texture.width,
            pixel_height: texture.height,
            pixel_depth: 0,
            layer_count: if texture.shape == Shape::Array {
                texture.layers
            } else {
                0
            },
            face_count: if texture.shape == Shape::Cube { 6 } else { 1 },
            level_count: levels.len() as u32,
            supercompression_scheme: Some(SupercompressionScheme::Zstandard),
            index: Index {
                dfd_byte_offset: dfd_start as u32,
                dfd_byte_length: dfd.len() as u32,
                kvd_byte_offset: (dfd_start + dfd.len()) as u32,
                kvd_byte_length: kvd.len() as u32,
                sgd_byte_offset: 0,
                sgd_byte_length: 0,
            },
        };
        let mut bytes = header.as_bytes().to_vec();
        bytes.extend(level_index(
            texture,
            &levels,
            dfd_start + dfd.len() + kvd.len(),
        ));
        bytes.extend(dfd);
        bytes.extend(kvd);
        bytes.extend(levels.iter().rev().flatten());
        Ok(bytes)
    }

    /// Offsets of the levels: the smallest lies first in the file, the largest first in the index.
    fn level_index(texture: &Texture, levels: &[Vec<u8>], data_start: usize) -> Vec<u8> {
        let mut offset = data_start as u64;
        let mut entries: Vec<[u8; LevelIndex::LENGTH]> = Vec::new();
        for (raw, packed) in texture.levels.iter().zip(levels).rev() {
            let entry = LevelIndex {
                byte_offset: offset,
                byte_length: packed.len() as u64,
                uncompressed_byte_length: raw.len() as u64,
            };
            entries.push(entry.as_bytes());
            offset += packed.len() as u64;
        }
        entries.into_iter().rev().flatten().collect()
    }
}

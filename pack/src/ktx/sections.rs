//! Where the sections of a file lie.
//!
//! The specification leaves no freedom: the level index follows the header, the descriptor the index, the key/value data
//! the descriptor, and the levels come next, the smallest first, each at the first place that its alignment allows. So every
//! offset is compared with the one that it must have, and no two sections can overlap.

use ktx2::{Header, LevelIndex};

use crate::error::PackError;
use crate::texture::Texture;

/// The parts of a file that are read after its header and its descriptor.
pub(super) struct Sections<'a> {
    /// Key/value data.
    pub key_values: &'a [u8],
    /// The levels as they are stored, the largest first.
    pub levels: Vec<&'a [u8]>,
}

/// Compares every offset and length, and every byte between the sections, with what they must be. The descriptor was
/// looked at before.
pub(super) fn verify<'a>(
    file: &str,
    bytes: &'a [u8],
    header: &Header,
    texture: &Texture,
) -> Result<Sections<'a>, PackError> {
    let expect = |key: &str, found: u64, expected: u64| {
        if found == expected {
            Ok(())
        } else {
            Err(PackError::value(file, key, found, expected))
        }
    };
    let inside = |key: &str, start: u64, length: u64| {
        let end = start.checked_add(length);
        let range =
            end.and_then(|end| Some(usize::try_from(start).ok()?..usize::try_from(end).ok()?));
        range.and_then(|range| bytes.get(range)).ok_or_else(|| {
            let found = format!("{length} bytes at {start}");
            let expected = format!("inside the file of {} bytes", bytes.len());
            PackError::value(file, key, found, expected)
        })
    };
    let index = &header.index;
    let index_bytes = u64::from(header.level_count) * LevelIndex::LENGTH as u64;
    let entries = inside("level index", Header::LENGTH as u64, index_bytes)?;
    let mut end = Header::LENGTH as u64 + index_bytes;
    expect("dfdByteOffset", index.dfd_byte_offset.into(), end)?;
    end += u64::from(index.dfd_byte_length);
    let key_value_bytes = u64::from(index.kvd_byte_length);
    let key_value_start = if key_value_bytes == 0 { 0 } else { end };
    expect(
        "kvdByteOffset",
        index.kvd_byte_offset.into(),
        key_value_start,
    )?;
    let key_values = inside("key/value data", key_value_start, key_value_bytes)?;
    end += key_value_bytes;
    // Neither of the two ways to store levels has global data.
    expect("sgdByteLength", index.sgd_byte_length, 0)?;
    expect("sgdByteOffset", index.sgd_byte_offset, 0)?;

    // Texels that are not compressed may be read where they lie.
    let is_raw = header.supercompression_scheme.is_none();
    let alignment = if is_raw {
        texture.format.bytes_per_texel().max(4) as u64
    } else {
        1
    };
    let mut levels = Vec::new();
    let (entries, _) = entries.as_chunks();
    for (level, entry) in entries.iter().enumerate().rev() {
        let entry = LevelIndex::from_bytes(entry);
        let key = |name: &str| format!("level {level}: {name}");
        let texel_bytes = texture.level_bytes(level) as u64;
        let start = end.next_multiple_of(alignment);
        expect(&key("byteOffset"), entry.byte_offset, start)?;
        let inflated = entry.uncompressed_byte_length;
        expect(&key("uncompressedByteLength"), inflated, texel_bytes)?;
        if is_raw {
            expect(&key("byteLength"), entry.byte_length, texel_bytes)?;
        }
        let padding = inside(&key("padding"), end, start - end)?;
        if let Some(&byte) = padding.iter().find(|byte| **byte != 0) {
            expect(&key("padding"), byte.into(), 0)?;
        }
        levels.push(inside(&key("byteLength"), start, entry.byte_length)?);
        end = start + entry.byte_length;
    }
    expect("size in bytes", bytes.len() as u64, end)?;
    levels.reverse();
    Ok(Sections { key_values, levels })
}

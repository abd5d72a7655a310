//! Every rule of the container, broken alone.

use ktx2::{Header, LevelIndex};

use super::{blamed_in, sample, texture};
use crate::format::{Format, Shape};
use crate::ktx::{decode, encode};
use crate::role::Mips;

/// A file in parts, to be changed and put together.
struct Parts {
    header: Header,
    descriptor: Vec<u8>,
    key_values: Vec<u8>,
    /// As they are stored, the largest first, with the length that they claim to inflate to.
    levels: Vec<(Vec<u8>, u64)>,
    /// Levels begin at multiples of this.
    alignment: usize,
}

/// The sample, or with texels that are not compressed and need an alignment.
fn parts(is_raw: bool) -> Parts {
    let format = if is_raw {
        Format::Rgba16Float
    } else {
        Format::Rgba8Unorm
    };
    let texture = texture(format, Shape::D2, 16, 8, 1, Mips::All);
    let bytes = encode("t.ktx2", &texture, "welkin test").unwrap();
    let mut header = Header::from_bytes(bytes.first_chunk().unwrap()).unwrap();
    let section = |start: u32, length: u32| bytes[start as usize..][..length as usize].to_vec();
    let index = header.index;
    let descriptor = section(index.dfd_byte_offset, index.dfd_byte_length);
    let key_values = section(index.kvd_byte_offset, index.kvd_byte_length);
    let levels = texture.levels.iter().enumerate().map(|(level, texels)| {
        let entry = &bytes[Header::LENGTH + level * LevelIndex::LENGTH..];
        let entry = LevelIndex::from_bytes(entry.first_chunk().unwrap());
        let stored = section(entry.byte_offset as u32, entry.byte_length as u32);
        (
            if is_raw { texels.clone() } else { stored },
            texels.len() as u64,
        )
    });
    let levels = levels.collect();
    if is_raw {
        header.supercompression_scheme = None;
    }
    Parts {
        header,
        descriptor,
        key_values,
        levels,
        alignment: if is_raw { 8 } else { 1 },
    }
}

impl Parts {
    fn join(mut self) -> Vec<u8> {
        let mut bytes = vec![0; Header::LENGTH + self.levels.len() * LevelIndex::LENGTH];
        let index = &mut self.header.index;
        index.dfd_byte_offset = bytes.len() as u32;
        index.dfd_byte_length = self.descriptor.len() as u32;
        bytes.extend(&self.descriptor);
        index.kvd_byte_length = self.key_values.len() as u32;
        index.kvd_byte_offset = if self.key_values.is_empty() {
            0
        } else {
            bytes.len() as u32
        };
        bytes.extend(&self.key_values);
        bytes[..Header::LENGTH].copy_from_slice(&self.header.as_bytes());
        for (level, (stored, inflated)) in self.levels.iter().enumerate().rev() {
            bytes.resize(bytes.len().next_multiple_of(self.alignment), 0);
            let entry = LevelIndex {
                byte_offset: bytes.len() as u64,
                byte_length: stored.len() as u64,
                uncompressed_byte_length: *inflated,
            };
            bytes[Header::LENGTH + level * LevelIndex::LENGTH..][..LevelIndex::LENGTH]
                .copy_from_slice(&entry.as_bytes());
            bytes.extend(stored);
        }
        bytes
    }
}

/// The field that is blamed after a change of the parts of the compressed sample.
fn blamed(change: impl FnOnce(&mut Parts)) -> String {
    let mut parts = parts(false);
    change(&mut parts);
    blamed_in(&parts.join())
}

/// The field that is blamed after a change of the bytes of a file.
fn blamed_bytes(is_raw: bool, change: impl FnOnce(&mut Vec<u8>)) -> String {
    let mut bytes = parts(is_raw).join();
    change(&mut bytes);
    blamed_in(&bytes)
}

fn add(bytes: &mut [u8], at: usize, n: u64) {
    let number = bytes[at..].first_chunk_mut().unwrap();
    *number = (u64::from_le_bytes(*number).wrapping_add(n)).to_le_bytes();
}

/// Key/value data of these entries, each filled up to four bytes.
fn key_values(entries: &[(&[u8], &[u8])]) -> Vec<u8> {
    let mut bytes = Vec::new();
    for (key, value) in entries {
        let length = key.len() + 1 + value.len();
        bytes.extend((length as u32).to_le_bytes());
        bytes.extend([*key, b"\0", *value].concat());
        bytes.resize(bytes.len().next_multiple_of(4), 0);
    }
    bytes
}

/// What is wrong with these entries, if anything.
fn told(entries: &[(&[u8], &[u8])]) -> Option<String> {
    let mut parts = parts(false);
    parts.key_values = key_values(entries);
    let error = decode("t.ktx2", &parts.join()).err()?;
    Some(error.to_string())
}

#[test]
fn parts_join_to_sound_files() {
    assert_eq!(parts(false).join(), sample());
    let raw = parts(true).join();
    let texture = texture(Format::Rgba16Float, Shape::D2, 16, 8, 1, Mips::All);
    assert_eq!(decode("t.ktx2", &raw).unwrap(), texture);
    // A texture of one level, and a file without key/value data.
    let mut parts = parts(false);
    parts.key_values.clear();
    parts.levels.truncate(1);
    parts.header.level_count = 1;
    assert!(decode("t.ktx2", &parts.join()).is_ok());
}

#[test]
fn sections_lie_where_the_specification_puts_them() {
    // A copy of the descriptor, or of the key/value data, at the end of the file.
    let moved = |offset: usize, length: usize| {
        blamed_bytes(false, |bytes| {
            let number =
                |at: usize| u32::from_le_bytes(*bytes[at..].first_chunk().unwrap()) as usize;
            let section = bytes[number(offset)..][..number(length)].to_vec();
            let end = bytes.len() as u32;
            bytes[offset..offset + 4].copy_from_slice(&end.to_le_bytes());
            bytes.extend(section);
        })
    };
    assert_eq!(moved(48, 52), "dfdByteOffset");
    assert_eq!(moved(56, 60), "kvdByteOffset");
    assert_eq!(blamed_bytes(false, |b| b[60..64].fill(0)), "kvdByteOffset");
    assert_eq!(blamed_bytes(false, |b| b[72] = 1), "sgdByteLength");
    assert_eq!(blamed_bytes(false, |b| b[64] = 80), "sgdByteOffset");
}

#[test]
fn levels_follow_each_other_from_the_smallest_to_the_largest() {
    let byte_offset = |level: usize| Header::LENGTH + level * LevelIndex::LENGTH;
    for is_raw in [false, true] {
        let last = byte_offset(4);
        let gap = blamed_bytes(is_raw, |bytes| add(bytes, last, 8));
        assert_eq!(gap, "level 4: byteOffset");
        let overlap = blamed_bytes(is_raw, |bytes| {
            add(bytes, byte_offset(0), 0_u64.wrapping_sub(8))
        });
        assert_eq!(overlap, "level 0: byteOffset");
        let beyond = blamed_bytes(is_raw, |bytes| add(bytes, byte_offset(0), u64::MAX / 2));
        assert_eq!(beyond, "level 0: byteOffset");
        let wrong = blamed_bytes(is_raw, |bytes| add(bytes, byte_offset(1) + 16, 1));
        assert_eq!(wrong, "level 1: uncompressedByteLength");
        let long = blamed_bytes(is_raw, |bytes| add(bytes, byte_offset(0) + 8, u64::MAX / 2));
        assert_eq!(long, "level 0: byteLength");
        assert_eq!(blamed_bytes(is_raw, |bytes| bytes.push(0)), "size in bytes");
    }
    let short = blamed_bytes(true, |bytes| {
        add(bytes, byte_offset(0) + 8, 0_u64.wrapping_sub(8))
    });
    assert_eq!(short, "level 0: byteLength");
    // The other way round in the file, with an index that says so.
    let order = blamed_bytes(false, |bytes| {
        let data = byte_offset(5) + 92 + 48;
        let levels = parts(false).levels;
        let (mut end, mut entries) = (data as u64, Vec::new());
        bytes.truncate(data);
        for (stored, inflated) in levels {
            entries.extend(
                LevelIndex {
                    byte_offset: end,
                    byte_length: stored.len() as u64,
                    uncompressed_byte_length: inflated,
                }
                .as_bytes(),
            );
            end += stored.len() as u64;
            bytes.extend(stored);
        }
        bytes[byte_offset(0)..byte_offset(5)].copy_from_slice(&entries);
    });
    assert_eq!(order, "level 4: byteOffset");
}

#[test]
fn raw_levels_are_aligned_and_what_is_between_is_zero() {
    let mut unaligned = parts(true);
    unaligned.alignment = 4;
    unaligned.key_values = key_values(&[(b"KTXwriter", b"a\0")]);
    assert_eq!(blamed_in(&unaligned.join()), "level 4: byteOffset");
    let mut padded = parts(true);
    padded.key_values = key_values(&[(b"KTXwriter", b"a\0")]);
    let mut bytes = padded.join();
    assert!(decode("t.ktx2", &bytes).is_ok());
    let first = u64::from_le_bytes(
        *bytes[Header::LENGTH + 4 * LevelIndex::LENGTH..]
            .first_chunk()
            .unwrap(),
    );
    bytes[first as usize - 1] = 1;
    assert_eq!(blamed_in(&bytes), "level 4: padding");
}

#[test]
fn a_level_is_one_whole_frame_of_the_size_that_it_claims() {
    let with = |stored: Vec<u8>| {
        let mut parts = parts(false);
        parts.levels[0].0 = stored;
        decode("t.ktx2", &parts.join()).unwrap_err().to_string()
    };
    let texels = parts(true).levels[0].0[..512].to_vec();
    let frame = |texels: &[u8]| zstd::bulk::compress(texels, 3).unwrap();
    let bomb = vec![0_u8; 10_000_000];
    assert_eq!(
        with(frame(&bomb)),
        "t.ktx2: level 0 is 513 bytes, expected 512 bytes"
    );
    assert_eq!(
        with(frame(&texels[..500])),
        "t.ktx2: level 0 is 500 bytes, expected 512 bytes"
    );
    let mut trailing = frame(&texels);
    trailing.push(0);
    assert!(with(trailing).contains("1 bytes longer than its frame"));
    let two = [frame(&texels[..256]), frame(&texels[256..])].concat();
    assert!(with(two).contains("level 0 is"));
    let mut half = frame(&texels);
    half.truncate(half.len() / 2);
    assert!(with(half).contains("damaged"));
    assert!(with(Vec::new()).contains("damaged"));
    let mut compressor = zstd::bulk::Compressor::new(3).unwrap();
    compressor.include_checksum(true).unwrap();
    let mut checked = compressor.compress(&texels).unwrap();
    let mut sound = parts(false);
    sound.levels[0].0 = checked.clone();
    assert!(decode("t.ktx2", &sound.join()).is_ok());
    *checked.last_mut().unwrap() ^= 1;
    assert!(with(checked).contains("its checksum is another"));
}

/// A window makes a decoder keep as many bytes, whatever the size of the level.
#[test]
fn a_window_larger_than_the_level_needs_is_refused() {
    // Magic, a descriptor without a content size, and 2^27 as the window; a raw block of 512 bytes, the last.
    let frame = |window_log: u8| {
        let header = [0x28, 0xb5, 0x2f, 0xfd, 0x00, (window_log - 10) << 3];
        let block = (512_u32 << 3 | 1).to_le_bytes();
        [&header[..], &block[..3], &[7; 512]].concat()
    };
    for (window_log, is_read) in [(10, true), (23, true), (24, false), (27, false)] {
        let mut parts = parts(false);
        parts.levels[0].0 = frame(window_log);
        let read = decode("t.ktx2", &parts.join());
        assert_eq!(read.is_ok(), is_read, "{window_log}: {read:?}");
    }
}

#[test]
fn every_field_of_the_descriptor_is_that_of_the_format() {
    // Where it begins in the descriptor, and what it becomes.
    let fields = [
        (0, 91, "dfdTotalSize"),
        (4, 1, "vendorId and descriptorType"),
        (6, 2, "vendorId and descriptorType"),
        (8, 1, "versionNumber"),
        (10, 72, "descriptorBlockSize"),
        (12, 2, "colorModel"),
        (13, 4, "colorPrimaries"),
        (14, 2, "transferFunction"),
        (15, 1, "flags"),
        (16, 3, "texelBlockDimension"),
        (20, 3, "bytesPlane"),
        (21, 1, "bytesPlane"),
        (28, 8, "bitOffset of sample 0"),
        (30, 15, "bitLength of sample 0"),
        (31, 15, "channelType of sample 0"),
        (31, 0x80, "channelType of sample 0"),
        (48, 1, "samplePosition of sample 1"),
        (68, 1, "sampleLower of sample 2"),
        (88, 1, "sampleUpper of sample 3"),
    ];
    for (at, value, name) in fields {
        let key = blamed(|parts| parts.descriptor[at] = value);
        assert_eq!(key, format!("data format descriptor: {name}"));
    }
    let longer = blamed(|parts| parts.descriptor.extend([0; 4]));
    assert_eq!(longer, "data format descriptor: dfdByteLength");
}

#[test]
fn only_compressed_files_may_have_planes_without_bytes() {
    for is_raw in [false, true] {
        let mut parts = parts(is_raw);
        parts.descriptor[20..28].fill(0);
        assert_eq!(decode("t.ktx2", &parts.join()).is_err(), is_raw);
    }
}

#[test]
fn key_value_data_is_well_formed() {
    let blamed = |change: fn(&mut Vec<u8>)| {
        let mut parts = parts(false);
        change(&mut parts.key_values);
        decode("t.ktx2", &parts.join()).unwrap_err().to_string()
    };
    let error = blamed(|b| b.extend([0; 3]));
    assert!(error.contains("3 bytes after the last entry"), "{error}");
    let error = blamed(|b| b.extend([0; 4]));
    assert!(error.contains("an entry of 0 bytes"), "{error}");
    let error = blamed(|b| b[0] = 1);
    assert!(error.contains("an entry of 1 bytes"), "{error}");
    let error = blamed(|b| b[3] = 0xff);
    assert!(error.contains("expected inside the section"), "{error}");
    let error = blamed(|b| b.truncate(b.len() - 2));
    assert!(error.contains("expected inside the section"), "{error}");
    let error = blamed(|b| *b.last_mut().unwrap() = 1);
    assert!(error.contains("padding"), "{error}");
    let error = blamed(|b| b[4 + 14] = b'x');
    assert!(error.contains("KTXorientationxrd"), "{error}");
    let error = blamed(|b| b[4..4 + 18].fill(b'x'));
    assert!(error.contains("a key without an end"), "{error}");
}

#[test]
fn keys_are_text_in_order_and_each_there_once() {
    assert_eq!(
        told(&[(b"A", b""), (b"KTXwriter", b"\0"), (b"a", b"\xff")]),
        None
    );
    let error = told(&[(b"", b"a")]).unwrap();
    assert!(error.contains("a key of the bytes []"), "{error}");
    let error = told(&[(b"a\xff", b"")]).unwrap();
    assert!(error.contains("a key of the bytes [61, ff]"), "{error}");
    let error = told(&[(b"\xef\xbb\xbfa", b"")]).unwrap();
    assert!(error.contains("byte order mark"), "{error}");
    let error = told(&[(b"b", b""), (b"a", b"")]).unwrap();
    assert!(error.contains("a after b"), "{error}");
    let error = told(&[(b"a", b"1"), (b"a", b"2")]).unwrap();
    assert!(error.contains("a after a"), "{error}");
}

#[test]
fn keys_of_the_specification_say_what_a_pack_holds() {
    for (key, value) in [
        ("KTXorientation", "ru\0"),
        ("KTXorientation", "rd"),
        ("KTXorientation", "r\0"),
        ("KTXorientation", "rdi\0"),
        ("KTXswizzle", "bgra\0"),
        ("KTXswizzle", "rgba"),
        ("KTXwriter", "welkin"),
        ("KTXwriter", ""),
        ("KTXcubemapIncomplete", "\u{3f}"),
        ("KTXglFormat", "\0\0\0\0\0\0\0\0\0\0\0\0"),
        ("KTXdxgiFormat__", "\0\0\0\0"),
        ("KTXmetalPixelFormat", "\0\0\0\0"),
        ("KTXastcDecodeMode", "unorm8\0"),
        ("KTXanimData", "\0\0\0\0\0\0\0\0\0\0\0\0"),
        ("KTXnothing", ""),
        ("ktxwriter", "a\0"),
    ] {
        let error = told(&[(key.as_bytes(), value.as_bytes())]).unwrap();
        assert!(error.starts_with(&format!("t.ktx2: {key} is ")), "{error}");
    }
    let error = told(&[(b"KTXwriter", b"\xff\0")]).unwrap();
    assert!(error.contains("UTF-8 that ends with a NUL"), "{error}");
    let error = told(&[(b"KTXwriterScParams", b"--zcmp 9\0")]).unwrap();
    assert!(error.contains("without KTXwriter"), "{error}");
    let sound: &[(&[u8], &[u8])] = &[
        (b"KTXorientation", b"rd\0"),
        (b"KTXswizzle", b"rgba\0"),
        (b"KTXwriter", b"a\0"),
        (b"KTXwriterScParams", b"--zcmp 9\0"),
    ];
    assert_eq!(told(sound), None);
}

//! Files that the encoders at hand do not write.

use std::io::Cursor;

use exr::prelude::{SpecificChannels, WritableImage};
use image::RgbImage;

/// An OpenEXR of red, green and blue.
pub fn exr(width: usize, height: usize, light: &[f32]) -> Vec<u8> {
    let channels = SpecificChannels::rgb(|place: exr::prelude::Vec2<usize>| {
        let at = (place.y() * width + place.x()) * 3;
        (light[at], light[at + 1], light[at + 2])
    });
    let mut bytes = Cursor::new(Vec::new());
    let image = exr::prelude::Image::from_channels((width, height), channels);
    image
        .write()
        .non_parallel()
        .to_buffered(&mut bytes)
        .unwrap();
    bytes.into_inner()
}

/// An entry of a directory of TIFF: tag, type, bytes.
pub type Entry = (u16, u16, Vec<u8>);

/// A TIFF of 8 bits a channel, not compressed (TIFF 6.0, section 4), with entries of one's own. Photometric
/// interpretation 2 is red, green and blue; 5 is CMYK, here with black 0.
pub fn tiff(picture: &RgbImage, photometric: u16, more: &[Entry]) -> Vec<u8> {
    let short = |v: u16| v.to_le_bytes().to_vec();
    let long = |v: u32| v.to_le_bytes().to_vec();
    let (width, height) = picture.dimensions();
    let pixels: Vec<u8> = match photometric {
        5 => picture
            .pixels()
            .flat_map(|p| [p[0], p[1], p[2], 0])
            .collect(),
        _ => picture.as_raw().clone(),
    };
    let samples = if photometric == 5 { 4_u16 } else { 3 };
    let mut entries: Vec<Entry> = vec![
        (0x0100, 4, long(width)),
        (0x0101, 4, long(height)),
        (0x0102, 3, short(8).repeat(usize::from(samples))),
        (0x0103, 3, short(1)),
        (0x0106, 3, short(photometric)),
        (0x0111, 4, long(8)),
        (0x0115, 3, short(samples)),
        (0x0116, 4, long(height)),
        (0x0117, 4, long(pixels.len() as u32)),
    ];
    entries.extend_from_slice(more);
    entries.sort();
    let mut values = pixels;
    values.resize(values.len().next_multiple_of(2), 0);
    let mut directory = (entries.len() as u16).to_le_bytes().to_vec();
    for (tag, kind, bytes) in entries {
        let size = [1, 1, 1, 2, 4, 8, 1, 1][usize::from(kind)];
        directory.extend(tag.to_le_bytes());
        directory.extend(kind.to_le_bytes());
        directory.extend(((bytes.len() / size) as u32).to_le_bytes());
        if bytes.len() <= 4 {
            directory.extend(bytes.iter().copied().chain([0; 4]).take(4));
        } else {
            directory.extend((8 + values.len() as u32).to_le_bytes());
            values.extend(bytes);
            values.resize(values.len().next_multiple_of(2), 0);
        }
    }
    directory.extend([0; 4]);
    let mut file = b"II*\0".to_vec();
    file.extend((8 + values.len() as u32).to_le_bytes());
    file.extend(values);
    file.extend(directory);
    file
}

/// A chunk of a PNG.
pub fn chunk(kind: &[u8; 4], data: &[u8]) -> Vec<u8> {
    let mut chunk = (data.len() as u32).to_be_bytes().to_vec();
    chunk.extend(kind);
    chunk.extend(data);
    // The checksum of PNG's chunks: ISO/IEC 15948:2004, annex D.
    let step = |crc: u32, _| {
        if crc & 1 == 1 {
            0xEDB8_8320 ^ (crc >> 1)
        } else {
            crc >> 1
        }
    };
    let crc = !chunk[4..]
        .iter()
        .fold(!0, |crc, &byte| (0..8).fold(crc ^ u32::from(byte), step));
    chunk.extend(crc.to_be_bytes());
    chunk
}

/// Where the first chunk of a kind begins, and the bytes of its data.
pub fn find_chunk(png: &[u8], kind: &[u8; 4]) -> (usize, Vec<u8>) {
    let mut at = 8;
    loop {
        let length = u32::from_be_bytes(png[at..at + 4].try_into().unwrap()) as usize;
        if &png[at + 4..at + 8] == kind {
            return (at, png[at + 8..at + 8 + length].to_vec());
        }
        at += 12 + length;
    }
}

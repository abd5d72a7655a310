//! The container of binary glTF: a header, a chunk of JSON, a chunk of bytes.

use crate::error::PackError;

const MAGIC: u32 = u32::from_le_bytes(*b"glTF");
const VERSION: u32 = 2;
const JSON: u32 = u32::from_le_bytes(*b"JSON");
const BIN: u32 = u32::from_le_bytes(*b"BIN\0");

/// Splits a file into JSON and bytes.
pub(super) fn split<'a>(file: &str, bytes: &'a [u8]) -> Result<(&'a [u8], &'a [u8]), PackError> {
    let bad = |key: &str, found: String, expected: String| {
        Err(PackError::value(file, key, found, expected))
    };
    let mut rest = bytes;
    let magic = number(file, &mut rest)?;
    if magic != MAGIC {
        return bad("magic", format!("{magic:#010x}"), format!("{MAGIC:#010x}"));
    }
    let version = number(file, &mut rest)?;
    if version != VERSION {
        return bad("glTF version", version.to_string(), VERSION.to_string());
    }
    let length = number(file, &mut rest)?;
    if length as usize != bytes.len() {
        return bad("length", length.to_string(), bytes.len().to_string());
    }
    let json = chunk(file, &mut rest, JSON)?;
    let bin = chunk(file, &mut rest, BIN)?;
    if !rest.is_empty() {
        return bad(
            "chunks",
            format!("{} bytes after the second", rest.len()),
            "two chunks".to_string(),
        );
    }
    Ok((json, bin))
}

/// The contents of the next chunk, which must be of this kind.
fn chunk<'a>(file: &str, rest: &mut &'a [u8], kind: u32) -> Result<&'a [u8], PackError> {
    let length = number(file, rest)? as usize;
    let found = number(file, rest)?;
    if found != kind {
        let (found, expected) = (format!("{found:#010x}"), format!("{kind:#010x}"));
        return Err(PackError::value(file, "chunk", found, expected));
    }
    if !length.is_multiple_of(4) {
        return Err(PackError::value(
            file,
            "chunk length",
            length,
            "a multiple of 4",
        ));
    }
    let Some((contents, after)) = rest.split_at_checked(length) else {
        return Err(too_short(file, rest.len(), length));
    };
    *rest = after;
    Ok(contents)
}

fn number(file: &str, rest: &mut &[u8]) -> Result<u32, PackError> {
    let Some((bytes, after)) = rest.split_first_chunk() else {
        return Err(too_short(file, rest.len(), 4));
    };
    *rest = after;
    Ok(u32::from_le_bytes(*bytes))
}

fn too_short(file: &str, found: usize, expected: usize) -> PackError {
    PackError::value(
        file,
        "length",
        format!("{found} bytes more"),
        format!("{expected}: the file was cut, bake again"),
    )
}

/// The file of two chunks, each filled up to a multiple of four bytes.
#[cfg(feature = "write")]
pub(super) fn join(mut json: Vec<u8>, mut bin: Vec<u8>) -> Vec<u8> {
    json.resize(json.len().next_multiple_of(4), b' ');
    bin.resize(bin.len().next_multiple_of(4), 0);
    let length = 12 + 8 + json.len() + 8 + bin.len();
    let mut bytes = Vec::with_capacity(length);
    let number = |bytes: &mut Vec<u8>, n: u32| bytes.extend(n.to_le_bytes());
    for n in [MAGIC, VERSION, length as u32, json.len() as u32, JSON] {
        number(&mut bytes, n);
    }
    bytes.extend(json);
    number(&mut bytes, bin.len() as u32);
    number(&mut bytes, BIN);
    bytes.extend(bin);
    bytes
}

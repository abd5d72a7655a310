//! The key/value data: well-formed, in order, and of the keys that the specification reserves only those that say what
//! this crate holds anyway.

use crate::error::PackError;

/// Which way rows and columns go.
const ORIENTATION_KEY: &str = "KTXorientation";
/// Columns go right, rows go down: what [`crate::Texture`] holds.
const ORIENTATION: &[u8] = b"rd\0";
/// The program that wrote the file.
const WRITER_KEY: &str = "KTXwriter";
/// What it told its compressor.
const WRITER_PARAMETERS_KEY: &str = "KTXwriterScParams";

/// An entry has this many bytes at least: one of a key, and the NUL that ends it.
const LEAST_ENTRY: usize = 2;

/// The section: which way rows and columns go, the writer, and texts of an application; keys in code point order, each entry padded to four
/// bytes.
///
/// # Errors
/// [`PackError::Value`] for a key that the specification does not allow.
#[cfg(feature = "write")]
pub(super) fn encode(
    file: &str,
    writer: &str,
    texts: &[(&str, &str)],
) -> Result<Vec<u8>, PackError> {
    let text = |value: &str| [value.as_bytes(), b"\0"].concat();
    let own = [
        (ORIENTATION_KEY, ORIENTATION.to_vec()),
        (WRITER_KEY, text(writer)),
    ];
    let texts = texts.iter().map(|(key, value)| (*key, text(value)));
    let mut entries: Vec<_> = own.into_iter().chain(texts).collect();
    entries.sort();
    let mut bytes = Vec::new();
    for (key, value) in entries {
        let entry = [key.as_bytes(), b"\0", &value].concat();
        bytes.extend((entry.len() as u32).to_le_bytes());
        bytes.extend(entry);
        bytes.resize(bytes.len().next_multiple_of(4), 0);
    }
    verify(file, &bytes)?;
    Ok(bytes)
}

/// Looks at every entry of the section.
pub(super) fn verify(file: &str, section: &[u8]) -> Result<(), PackError> {
    let bad = |found: String, expected: &str| {
        Err(PackError::value(file, "key/value data", found, expected))
    };
    let mut rest = section;
    let mut last = "";
    let mut has_writer = false;
    while !rest.is_empty() {
        let Some((length, after)) = rest.split_first_chunk() else {
            let found = format!("{} bytes after the last entry", rest.len());
            return bad(found, "none");
        };
        let length = u32::from_le_bytes(*length) as usize;
        if length < LEAST_ENTRY {
            let found = format!("an entry of {length} bytes");
            return bad(found, "a key and the NUL that ends it");
        }
        let padded = length.checked_next_multiple_of(4).unwrap_or(length);
        let Some((entry, after)) = after.split_at_checked(padded) else {
            let found = format!("an entry of {length} bytes, filled up to a multiple of 4");
            return bad(found, "inside the section");
        };
        let (entry, padding) = entry.split_at(length);
        if padding.iter().any(|byte| *byte != 0) {
            return bad(format!("padding of {padding:02x?}"), "zeros");
        }
        let Some(end) = entry.iter().position(|byte| *byte == 0) else {
            let found = format!("a key without an end: {}", String::from_utf8_lossy(entry));
            return bad(found, "a NUL between key and value");
        };
        let key = match std::str::from_utf8(&entry[..end]) {
            Ok(key) if !key.is_empty() && !key.starts_with('\u{feff}') => key,
            _ => {
                let found = format!("a key of the bytes {:02x?}", &entry[..end]);
                return bad(
                    found,
                    "UTF-8 of a character or more, without a byte order mark",
                );
            }
        };
        // The order of UTF-8's bytes is that of its code points.
        if key <= last {
            return bad(
                format!("{key} after {last}"),
                "each key once, in code point order",
            );
        }
        has_writer |= key == WRITER_KEY;
        if key == WRITER_PARAMETERS_KEY && !has_writer {
            return bad(format!("{key} without {WRITER_KEY}"), "both, or neither");
        }
        verify_value(file, key, &entry[end + 1..])?;
        (last, rest) = (key, after);
    }
    Ok(())
}

/// What the specification says of the values of its own keys. Keys of applications may have any value.
fn verify_value(file: &str, key: &str, value: &[u8]) -> Result<(), PackError> {
    let is_text = || std::str::from_utf8(value).is_ok_and(|text| text.ends_with('\0'));
    let (is_right, expected) = match key {
        ORIENTATION_KEY => (value == ORIENTATION, "rd and a NUL: right and down"),
        "KTXswizzle" => (
            value == b"rgba\0",
            "rgba and a NUL: every channel is in its place",
        ),
        WRITER_KEY | WRITER_PARAMETERS_KEY => (is_text(), "UTF-8 that ends with a NUL"),
        _ if key.starts_with("KTX") || key.starts_with("ktx") => (
            false,
            "no such key: of those that begin with KTX a pack has KTXorientation, KTXswizzle, KTXwriter and KTXwriterScParams",
        ),
        _ => (true, ""),
    };
    if is_right {
        return Ok(());
    }
    let found = String::from_utf8_lossy(value).escape_debug().to_string();
    Err(PackError::value(file, key, found, expected))
}

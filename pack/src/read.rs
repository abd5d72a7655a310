//! The bytes of a pack's files, from a folder or from memory: no more than a limit that is looked at first.

use std::collections::BTreeMap;
use std::fs;
use std::io::{self, Read};
use std::path::Path;

use crate::error::PackError;

/// The name of a pack's file in errors.
pub(crate) fn join(place: &str, name: &str) -> String {
    format!("{}/{name}", place.trim_end_matches('/'))
}

/// Reads a file of a pack's folder that has at most `limit` bytes.
pub(crate) fn in_folder(folder: &Path, name: &str, limit: u64) -> Result<Vec<u8>, PackError> {
    let path = folder.join(name);
    let file = path.display().to_string();
    let failed = |source: io::Error| match source.kind() {
        io::ErrorKind::NotFound | io::ErrorKind::NotADirectory => PackError::Missing {
            file: file.clone(),
            expected: expected(&folder.display().to_string()),
        },
        _ => PackError::Read {
            file: file.clone(),
            source,
        },
    };
    let mut handle = fs::File::open(&path).map_err(failed)?;
    let size = handle.metadata().map_err(failed)?.len();
    let mut bytes = Vec::new();
    if size <= limit {
        // A device or a growing file may hold more than it says.
        (&mut handle)
            .take(limit + 1)
            .read_to_end(&mut bytes)
            .map_err(failed)?;
    }
    verify_size(&file, size.max(bytes.len() as u64), limit)?;
    Ok(bytes)
}

/// The same of files in memory. `place` stands for the folder.
pub(crate) fn in_memory(
    place: &str,
    files: &BTreeMap<String, Vec<u8>>,
    name: &str,
    limit: u64,
) -> Result<Vec<u8>, PackError> {
    let file = join(place, name);
    let Some(bytes) = files.get(name) else {
        let expected = expected(place);
        return Err(PackError::Missing { file, expected });
    };
    verify_size(&file, bytes.len() as u64, limit)?;
    Ok(bytes.clone())
}

fn expected(place: &str) -> String {
    format!("a file of the pack {place}")
}

fn verify_size(file: &str, found: u64, limit: u64) -> Result<(), PackError> {
    if found > limit {
        return Err(PackError::TooLarge {
            file: file.to_string(),
            key: "size in bytes".to_string(),
            found,
            limit,
        });
    }
    Ok(())
}

/// Compares a file's bytes with the size and the hash that the manifest gives.
pub(crate) fn verify_bytes(
    file: &str,
    bytes: &[u8],
    size: u64,
    blake3: &str,
) -> Result<(), PackError> {
    if bytes.len() as u64 != size {
        return Err(PackError::value(file, "file_bytes", bytes.len(), size));
    }
    let found = blake3::hash(bytes).to_hex().to_string();
    if found != blake3 {
        return Err(PackError::value(file, "file_blake3", found, blake3));
    }
    Ok(())
}

//! What can be wrong with a pack: every error names the file, the key, what was found and what was expected.

use std::io;

/// Why a pack could not be read, built or saved.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PackError {
    /// A file or folder could not be read.
    #[error("{file}: cannot be read: {source}")]
    Read {
        /// File or folder.
        file: String,
        /// The operating system's reason.
        source: io::Error,
    },
    /// A file or folder could not be written. Nothing of the pack was left behind.
    #[error("{file}: cannot be written: {source}; nothing was changed")]
    Write {
        /// File or folder.
        file: String,
        /// The operating system's reason.
        source: io::Error,
    },
    /// The place for the pack is taken.
    #[error("{file}: already exists; choose another folder, or replace it with --force")]
    Exists {
        /// The folder.
        file: String,
    },
    /// The folder is not a pack, so it is not replaced.
    #[error(
        "{file}: is not a pack (it has no pack.json) and is not replaced; move it away or choose another folder"
    )]
    NotAPack {
        /// The folder.
        file: String,
    },
    /// A file that the pack must have is missing.
    #[error("{file}: missing, expected {expected}; bake the pack again")]
    Missing {
        /// File.
        file: String,
        /// What should be there.
        expected: String,
    },
    /// A file is larger than a reader accepts.
    #[error("{file}: {key} is {found}, expected at most {limit}")]
    TooLarge {
        /// File.
        file: String,
        /// What is too large.
        key: String,
        /// Its size.
        found: u64,
        /// The largest accepted.
        limit: u64,
    },
    /// The pack has a version that this build does not know.
    #[error(
        "{file}: version is {found}, expected {expected}; use a welkin that knows this version, or bake again"
    )]
    Version {
        /// File.
        file: String,
        /// Version in the file.
        found: u64,
        /// Version known here.
        expected: u64,
    },
    /// The manifest is not the JSON that it should be.
    #[error(
        "{file}:{line}:{column}: {message}; expected a manifest as docs/pack.schema.json describes it"
    )]
    Json {
        /// File.
        file: String,
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// What is wrong there.
        message: String,
    },
    /// The caller asked to stop. Nothing was changed.
    #[error("cancelled; nothing was changed")]
    Cancelled,
    /// A value is not what it must be.
    #[error("{file}: {key} is {found}, expected {expected}")]
    Value {
        /// File.
        file: String,
        /// Key in the manifest, field of the container, or name of the argument.
        key: String,
        /// The value.
        found: String,
        /// What it should be.
        expected: String,
    },
}

impl PackError {
    /// A [`PackError::Value`] from anything that can be printed.
    pub(crate) fn value(
        file: &str,
        key: &str,
        found: impl ToString,
        expected: impl ToString,
    ) -> PackError {
        PackError::Value {
            file: file.to_string(),
            key: key.to_string(),
            found: found.to_string(),
            expected: expected.to_string(),
        }
    }
}

//! What can be wrong with a pack: every error names the file, the key, what was found and what was expected.
//!
//! The fields have texts as they are; a message quotes them through [`shown`].

use std::io;

use crate::shown;

/// Why a pack could not be read, built or saved.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PackError {
    /// A file or folder could not be read.
    #[error("{}: cannot be read: {source}", shown(.file))]
    Read {
        /// File or folder.
        file: String,
        /// The operating system's reason.
        source: io::Error,
    },
    /// A file or folder could not be written. Nothing of the pack was left behind.
    #[error("{}: cannot be written: {source}; nothing was changed", shown(.file))]
    Write {
        /// File or folder.
        file: String,
        /// The operating system's reason.
        source: io::Error,
    },
    /// The place for the pack is taken.
    #[error("{}: already exists; choose another folder, or replace it with --force", shown(.file))]
    Exists {
        /// The folder.
        file: String,
    },
    /// The folder is not a pack, so it is not replaced.
    #[error(
        "{}: is not a pack (it has no pack.json) and is not replaced; move it away or choose another folder",
        shown(.file)
    )]
    NotAPack {
        /// The folder.
        file: String,
    },
    /// A file that the pack must have is missing.
    #[error("{}: missing, expected {}; bake the pack again", shown(.file), shown(.expected))]
    Missing {
        /// File.
        file: String,
        /// What should be there.
        expected: String,
    },
    /// A file is larger than a reader accepts.
    #[error("{}: {} is {found}, expected at most {limit}", shown(.file), shown(.key))]
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
        "{}: version is {found}, expected {expected}; use a welkin that knows this version, or bake again",
        shown(.file)
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
        "{}:{line}:{column}: {}; expected a manifest as docs/pack.schema.json describes it",
        shown(.file), shown(.message)
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
    #[error("{}: {} is {}, expected {}", shown(.file), shown(.key), shown(.found), shown(.expected))]
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

//! What can be wrong with a pack: every error names the file, the key, what was found and what was expected.
//!
//! The fields have texts as they are; a message quotes them through [`shown`].

use std::io;

use crate::shown::shown;

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
    /// The pack could not be saved. Nothing was changed.
    #[cfg(all(feature = "write", not(target_family = "wasm")))]
    #[error(transparent)]
    Write(#[from] WriteError),
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

/// Why a file or a folder could not be written. What was there is as it was.
#[cfg(all(feature = "write", not(target_family = "wasm")))]
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WriteError {
    /// The place for a folder is taken.
    #[error("{file}: already exists; choose another folder, or move it away")]
    Exists {
        /// The folder.
        file: String,
    },
    /// There is a folder with something in it that nobody would write there.
    #[error(
        "{file}: is not replaced, since {found} in it is none of the files that would be written; choose another folder, or move it away"
    )]
    NotOurs {
        /// The folder.
        file: String,
        /// What is in it, by name.
        found: String,
    },
    /// There is a folder that is not a pack.
    #[error(
        "{file}: is not a pack and is not replaced: {reason}; move it away or choose another folder"
    )]
    NotAPack {
        /// The folder.
        file: String,
        /// Why it is none.
        reason: String,
    },
    /// There is something that is not a folder.
    #[error("{file}: is there and is not a folder; choose another name")]
    NotAFolder {
        /// The place.
        file: String,
    },
    /// There is a folder or a device.
    #[error("{file}: is there and is not a file; choose another name")]
    NotAFile {
        /// The place.
        file: String,
    },
    /// The program runs in the folder that would be replaced.
    #[error(
        "{file}: is not replaced, since this command runs in it; name a new folder in it, or run the command from outside"
    )]
    InUse {
        /// The folder.
        file: String,
    },
    /// An output is an input, or a folder that holds one.
    #[error("{file}: would be written over {input}, which is read; choose another place")]
    OverInput {
        /// The output.
        file: String,
        /// The input.
        input: String,
    },
    /// An output lies in a folder that is read.
    #[error("{file}: would be written into {input}, which is read; choose another place")]
    IntoInput {
        /// The output.
        file: String,
        /// The input.
        input: String,
    },
    /// Two outputs are one place.
    #[error("{file}: is named twice, also as {other}; give each output a place of its own")]
    Twice {
        /// An output.
        file: String,
        /// The other.
        other: String,
    },
    /// An output lies in another.
    #[error("{file}: lies in {other}, which is written too; give each output a place of its own")]
    Nested {
        /// The inner one.
        file: String,
        /// The outer one.
        other: String,
    },
    /// The operating system refused.
    #[error("{file}: cannot be written: {reason}; {}", advice(reason))]
    Failed {
        /// The file or folder.
        file: String,
        /// The operating system's reason.
        reason: io::Error,
    },
    /// The caller asked to stop.
    #[error("cancelled; nothing was changed")]
    Cancelled,
}

#[cfg(all(feature = "write", not(target_family = "wasm")))]
impl WriteError {
    /// A [`WriteError::Failed`].
    pub(crate) fn failed(file: &std::path::Path, reason: io::Error) -> WriteError {
        WriteError::Failed {
            file: file.display().to_string(),
            reason,
        }
    }
}

/// What to do about it.
#[cfg(all(feature = "write", not(target_family = "wasm")))]
fn advice(reason: &io::Error) -> &'static str {
    match reason.kind() {
        io::ErrorKind::NotFound => "make the folder above it first",
        io::ErrorKind::StorageFull | io::ErrorKind::FileTooLarge | io::ErrorKind::QuotaExceeded => {
            "make room there"
        }
        io::ErrorKind::ResourceBusy => {
            "a disk is mounted there, or a program uses it; name a new folder in it"
        }
        _ => "choose another place",
    }
}

//! What can go wrong in a bake: every error names the file, what was found and what was expected.
//!
//! The fields have texts as they are; a message quotes them through [`shown`].

use std::io;

use welkin_pack::check::Finding;
use welkin_pack::{PackError, shown};

use crate::catalogue::CatalogueError;

/// Why a recipe was refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RecipeError {
    /// The text is not TOML, or has a key or a table that no recipe has.
    #[error("{}:{line}:{column}: {}; correct the recipe there", shown(.file), shown(.message))]
    Syntax {
        /// The recipe.
        file: String,
        /// Line, from 1.
        line: usize,
        /// Column in characters, from 1.
        column: usize,
        /// What is wrong, with the keys that are known.
        message: String,
    },
    /// A value has the wrong type or is out of range.
    #[error(
        "{}:{line}:{column}: {} is {}, expected {}",
        shown(.file), shown(.key), shown(.found), shown(.expected)
    )]
    Value {
        /// The recipe.
        file: String,
        /// Line of the value, from 1.
        line: usize,
        /// Column of the value in characters, from 1.
        column: usize,
        /// Full key, such as `clouds.size`.
        key: String,
        /// The value.
        found: String,
        /// What it should be.
        expected: String,
    },
}

/// Why a bake stopped.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum BakeError {
    /// The caller asked to stop. Nothing was written.
    #[error("cancelled; nothing was written")]
    Cancelled,
    /// A picture could not be read.
    #[error("{}: cannot be read: {source}; check `{}` in the recipe", shown(.file), shown(.key))]
    Read {
        /// The picture.
        file: String,
        /// The key in the recipe that names it, such as `clouds.photo.file`.
        key: String,
        /// The operating system's reason.
        source: io::Error,
    },
    /// A photograph that no recipe names could not be read.
    #[error("{}: cannot be read: {source}; name a photograph", shown(.file))]
    ReadPhoto {
        /// The photograph.
        file: String,
        /// The operating system's reason.
        source: io::Error,
    },
    /// A PNG, JPEG, TIFF or WebP could not be decoded.
    #[error(
        "{}: cannot be decoded: {}; expected a whole file of its kind; save or copy it again",
        shown(.file), shown(&.source.to_string())
    )]
    Decode {
        /// The picture.
        file: String,
        /// The decoder's reason.
        source: image::ImageError,
    },
    /// A picture is not fit for use.
    #[error("{}: {} is {}, expected {}", shown(.file), shown(.key), shown(.found), shown(.expected))]
    Photo {
        /// The picture.
        file: String,
        /// What about it.
        key: &'static str,
        /// As it is.
        found: String,
        /// As it should be.
        expected: String,
    },
    /// The recipe names a picture by a relative path, but was not read from a folder.
    #[error(
        "{}: a relative path in a recipe that has no folder; give an absolute path for `{}`",
        shown(.file), shown(.key)
    )]
    NoBase {
        /// The picture.
        file: String,
        /// The key in the recipe that names it.
        key: String,
    },
    /// A model of a cloud is not fit for use.
    #[error("{}: {} is {}, expected {}", shown(.file), shown(.key), shown(.found), shown(.expected))]
    Model {
        /// The glTF file.
        file: String,
        /// What in it.
        key: String,
        /// As it is.
        found: String,
        /// As it should be.
        expected: String,
    },
    /// A catalogue of stars is not fit for use.
    #[error(transparent)]
    Catalogue(#[from] CatalogueError),
    /// The field of clouds would be larger than it may be.
    #[error(
        "{key}: the field needs {found} {what}, expected at most {limit}; lower its cover, density or copies, or raise `field.most_sprites`"
    )]
    Field {
        /// The entry of the recipe that asks for too much, such as `field.clouds[1]`.
        key: String,
        /// Of what.
        what: &'static str,
        /// How many there would be, or more.
        found: usize,
        /// The most.
        limit: usize,
    },
    /// The pack breaks rules of `welkin check`.
    #[error("the pack would not be sound: {}", told(faults))]
    Unsound {
        /// One or more.
        faults: Vec<Fault>,
    },
    /// The images were refused as a pack.
    #[error(transparent)]
    Pack(#[from] PackError),
}

/// A broken rule of `welkin check`, and what to do about it.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// The key of the recipe that it leans on most, such as `clouds.noise.mean`.
    pub key: String,
    /// What the check found.
    pub finding: Finding,
}

fn told(faults: &[Fault]) -> String {
    let lines = faults.iter().map(|Fault { key, finding }| {
        let Finding {
            rule,
            subject,
            expected,
            note,
            ..
        } = finding;
        let figure = finding.figure.map(|figure| format!("{figure:.4}"));
        let found = figure.as_deref().unwrap_or(note);
        format!("{rule}: {subject} is {found}, expected {expected}; change `{key}` in the recipe")
    });
    lines.collect::<Vec<String>>().join(", ")
}

/// An error about the size of a picture.
pub(crate) fn unfit_size(file: &str, [width, height]: [u32; 2], expected: String) -> BakeError {
    unfit(file, "size", format!("{width}x{height}"), expected)
}

/// An error about what a picture is.
pub(crate) fn unfit(
    file: &str,
    key: &'static str,
    found: impl ToString,
    expected: impl ToString,
) -> BakeError {
    BakeError::Photo {
        file: file.to_string(),
        key,
        found: found.to_string(),
        expected: expected.to_string(),
    }
}

/// Says that a file has more bytes than are read.
pub(crate) fn too_long(file: &str, most_bytes: u64) -> BakeError {
    let most = most_bytes >> 20;
    let (found, expected) = (
        format!("over {most} MiB"),
        format!("at most {most} MiB; save it smaller"),
    );
    unfit(file, "length", found, expected)
}

/// An error about what is in a model.
pub(crate) fn model_error(file: &str, key: &str, found: String, expected: &str) -> BakeError {
    BakeError::Model {
        file: file.to_string(),
        key: key.to_string(),
        found,
        expected: expected.to_string(),
    }
}

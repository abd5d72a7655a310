//! Semantic checks: whether every channel of a pack is what it claims to be.
//!
//! A container validator sees bytes; these rules know what a star, a seam or a sunset gradient is. They run
//! on a folder or on files in memory, go on after a broken file, and report every rule with its figure. Rules that lean on
//! statistics say how often they would blame a sound pack: never more than once in a million.

mod catalogue;
mod chance;
mod clouds;
mod fbm;
mod field;
mod files;
mod finite;
mod flares;
mod galaxy;
mod layers;
mod mips;
mod octaves;
mod report;
mod role;
mod rule;
mod sky;
mod skybox;
mod spectrum;
mod sprites;
mod stars;
mod sun;
#[cfg(test)]
#[cfg(feature = "write")]
mod tests;
mod texture;
mod tiling;

use std::collections::BTreeMap;
use std::path::Path;

pub use report::{Finding, Outcome, Report};
pub use rule::{RULES, Rule, Severity};
pub use spectrum::radial_spectrum;
pub use texture::check_texture;

use crate::error::PackError;
use crate::field::Field;
use crate::manifest::Manifest;
use crate::pack::Pack;
use crate::read::{in_folder, in_memory};
use crate::role::Role;
use crate::texture::Texture;
use files::Place;
use role::{Claim, check_role};

/// Checks the pack in a folder.
///
/// # Errors
/// [`PackError`] if the manifest cannot be read at all: then there is nothing to check. Everything else
/// that is wrong, a damaged texture too, is in the report.
pub fn check(folder: impl AsRef<Path>) -> Result<Report, PackError> {
    let folder = folder.as_ref();
    let place = Place {
        name: &folder.display().to_string(),
        read: &|name, limit| in_folder(folder, name, limit),
    };
    Ok(check_place(place, |_, _| ())?.0)
}

/// A pack that was checked: what was found, and what could be read of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Examined {
    /// What was found.
    pub report: Report,
    /// The manifest, whether it is sound or not.
    pub manifest: Manifest,
    /// The textures that decode and are laid out as their role asks, in the order of the manifest.
    pub textures: Vec<(Role, Texture)>,
    /// The field of clouds, if the pack has one that decodes.
    pub field: Option<Field>,
}

/// Checks the pack in a folder as [`check`] does, and gives what it read too.
///
/// # Errors
/// As [`check`].
pub fn examine(folder: impl AsRef<Path>) -> Result<Examined, PackError> {
    let folder = folder.as_ref();
    let place = Place {
        name: &folder.display().to_string(),
        read: &|name, limit| in_folder(folder, name, limit),
    };
    let mut textures = Vec::new();
    let (report, manifest, field) =
        check_place(place, |role, texture| textures.push((role, texture)))?;
    Ok(Examined {
        report,
        manifest,
        textures,
        field,
    })
}

/// Checks a pack whose files are in memory, by their names: the same rules, the same report.
///
/// `place` stands before file names in errors.
///
/// # Errors
/// As [`check`].
pub fn check_memory(place: &str, files: &BTreeMap<String, Vec<u8>>) -> Result<Report, PackError> {
    let place = Place {
        name: place,
        read: &|name, limit| in_memory(place, files, name, limit),
    };
    Ok(check_place(place, |_, _| ())?.0)
}

/// Checks what the textures and the field of a pack mean, as they are in memory.
///
/// The rules about files are left out: a [`Pack`] has read its files back, or was read from them. So nothing is decoded
/// twice.
pub fn check_pack(pack: &Pack) -> Report {
    let mut report = Report::default();
    for (entry, texture) in pack.manifest.textures.iter().zip(&pack.textures) {
        let claim = Claim::new(&pack.manifest, entry.role);
        check_role(&mut report, entry.role, texture, claim);
    }
    if let Some(field) = &pack.field {
        field::check(&mut report, field);
    }
    report.sort();
    report
}

/// `keep` gets every texture that was looked at; whoever does not keep them has one in memory at a time.
fn check_place(
    place: Place,
    mut keep: impl FnMut(Role, Texture),
) -> Result<(Report, Manifest, Option<Field>), PackError> {
    let mut report = Report::default();
    let (manifest, field) = files::check(&mut report, place, |report, manifest, role, texture| {
        check_role(report, role, &texture, Claim::new(manifest, role));
        keep(role, texture);
    })?;
    if let Some(field) = &field {
        field::check(&mut report, field);
    }
    report.sort();
    Ok((report, manifest, field))
}

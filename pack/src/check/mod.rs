//! Semantic checks: whether every channel of a pack is what it claims to be.
//!
//! A container validator sees bytes; these rules know what a star, a seam or a sunset gradient is. They run
//! on a folder or on files in memory, go on after a broken file, and report every rule with its figure. Rules that lean on
//! statistics say how often they would blame a sound pack: never more than once in a million.

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

use crate::manifest::TextureEntry;
use crate::read::{in_folder, in_memory};
use crate::{Field, Manifest, Pack, PackError, Role, Texture};
use files::Place;

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

/// What a manifest says that rules rely on; nothing of a texture that is in no pack.
#[derive(Clone, Copy, Default)]
struct Claim<'a> {
    /// The texture's entry.
    entry: Option<&'a TextureEntry>,
    /// Elevation of the sun at noon.
    noon_elevation_rad: Option<f32>,
}

impl Claim<'_> {
    fn new(manifest: &Manifest, role: Role) -> Claim<'_> {
        Claim {
            entry: manifest.texture(role),
            noon_elevation_rad: Some(manifest.noon_elevation_rad),
        }
    }
}

/// The rules about the texels of a role. The texture is laid out as the role asks, with all levels.
fn check_role(report: &mut Report, role: Role, texture: &Texture, claim: Claim) {
    if !finite::check(report, role, texture) {
        // No figure of what is not a number means anything.
        return;
    }
    mips::check(report, role, texture);
    match role {
        Role::Clouds => clouds::check(report, texture, claim.entry),
        Role::Stars => stars::check(report, texture),
        Role::Galaxy => galaxy::check(report, texture),
        Role::Sky => sky::check(report, texture, claim.noon_elevation_rad),
        Role::Sun => sun::check(report, texture),
        Role::Octaves => octaves::check(report, texture),
        Role::Fbm => fbm::check(report, texture),
        Role::Flares => flares::check(report, texture),
        Role::Layers => layers::check(report, texture),
        Role::Sprites => sprites::check(report, texture),
        Role::Skybox => skybox::check(report, texture),
    }
}

/// The largest distance of a byte value's count from an equal share of all.
fn unevenness(bytes: impl Iterator<Item = u8>) -> usize {
    let mut counts = [0_usize; 256];
    bytes.for_each(|byte| counts[usize::from(byte)] += 1);
    let share = counts.iter().sum::<usize>() / counts.len();
    let distances = counts.iter().map(|count| count.abs_diff(share));
    distances.max().unwrap_or(0)
}

/// `role.channel`, as reports name a channel.
fn subject(role: Role, channel: usize) -> String {
    format!("{}.{}", role.name(), role.spec().channels[channel].name)
}

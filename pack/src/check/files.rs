//! The files of a pack: seal, manifest, hashes, containers, layouts.

use super::field;
use super::report::{Report, subject};
use super::rule::{
    CONTAINER, FIELD_FILE, FILE_HASH, LAYOUT, MANIFEST, ROLES, Rule, SEAL, STATISTICS, TEXEL_HASH,
};
use crate::error::PackError;
use crate::field::{Field, glb};
use crate::ktx;
use crate::limits::{MAX_FIELD_BYTES, MAX_FILE_BYTES, MAX_MANIFEST_BYTES};
use crate::manifest::{FieldEntry, MANIFEST_FILE, Manifest, TextureEntry};
use crate::read::join;
use crate::role::Role;
use crate::texture::Texture;

/// Gives the bytes of a file of at most so many.
type Read<'a> = &'a dyn Fn(&str, u64) -> Result<Vec<u8>, PackError>;

/// Where the files of a pack are.
#[derive(Clone, Copy)]
pub(super) struct Place<'a> {
    /// Stands before file names in errors.
    pub name: &'a str,
    /// Reads them.
    pub read: Read<'a>,
}

/// Checks the files. Each texture that could be decoded and is laid out as its role asks is handed to `each`, so that there
/// is one at a time. Gives the manifest, sound or not, and the field of clouds, if it could be read.
pub(super) fn check(
    report: &mut Report,
    place: Place,
    mut each: impl FnMut(&mut Report, &Manifest, Role, Texture),
) -> Result<(Manifest, Option<Field>), PackError> {
    let bytes = (place.read)(MANIFEST_FILE, MAX_MANIFEST_BYTES)?;
    let file = join(place.name, MANIFEST_FILE);
    let manifest = Manifest::parse(&file, &bytes)?;
    report.verify(SEAL, MANIFEST_FILE, manifest.verify_seal(&file, &bytes));
    let sound = report
        .verify(MANIFEST, MANIFEST_FILE, manifest.verify(&file))
        .is_some();
    for role in Role::ALL.into_iter().filter(|role| !role.is_optional()) {
        let found = f64::from(u8::from(manifest.texture(role).is_some()));
        report.at_least(ROLES, role.name(), found, 1.0);
    }
    if !sound {
        for rule in [FILE_HASH, CONTAINER, LAYOUT, TEXEL_HASH, STATISTICS] {
            report.skip(rule, "every texture", "the manifest is not sound");
        }
        if manifest.field.is_some() {
            report.skip(FIELD_FILE, field::SUBJECT, "the manifest is not sound");
        }
        return Ok((manifest, None));
    }
    for entry in &manifest.textures {
        if let Some(texture) = check_entry(report, place, entry) {
            each(report, &manifest, entry.role, texture);
        }
    }
    let entry = manifest.field.as_ref();
    let field = entry.and_then(|entry| check_field(report, place, entry));
    Ok((manifest, field))
}

fn check_field(report: &mut Report, place: Place, entry: &FieldEntry) -> Option<Field> {
    let file = join(place.name, &entry.file);
    let bytes = (place.read)(&entry.file, MAX_FIELD_BYTES);
    let bytes = bytes.and_then(|bytes| entry.verify_file(&file, &bytes).map(|()| bytes));
    let Some(bytes) = report.verify(FILE_HASH, field::SUBJECT, bytes) else {
        report.skip(FIELD_FILE, field::SUBJECT, "the file is missing or damaged");
        return None;
    };
    let clouds = glb::decode(&file, &bytes)
        .and_then(|clouds| entry.verify_counts(&file, &clouds).map(|()| clouds));
    report.verify(FIELD_FILE, field::SUBJECT, clouds)
}

fn check_entry(report: &mut Report, place: Place, entry: &TextureEntry) -> Option<Texture> {
    let file = join(place.name, &entry.file);
    let name = entry.role.name();
    let bytes = (place.read)(&entry.file, MAX_FILE_BYTES);
    let bytes = bytes.and_then(|bytes| entry.verify_file(&file, &bytes).map(|()| bytes));
    let Some(bytes) = report.verify(FILE_HASH, name, bytes) else {
        skip(
            report,
            entry,
            &[CONTAINER, LAYOUT, TEXEL_HASH, STATISTICS],
            "the file is missing or damaged",
        );
        return None;
    };
    let decoded = ktx::decode(&file, &bytes);
    drop(bytes);
    let Some(texture) = report.verify(CONTAINER, name, decoded) else {
        skip(
            report,
            entry,
            &[LAYOUT, TEXEL_HASH, STATISTICS],
            "the container does not decode",
        );
        return None;
    };
    let layout = report.verify(LAYOUT, name, entry.verify_layout(&file, &texture));
    report.verify(TEXEL_HASH, name, entry.verify_texels(&file, &texture));
    if layout.is_none() {
        skip(
            report,
            entry,
            &[STATISTICS],
            "the layout is not that of its role",
        );
        return None;
    }
    check_statistics(report, entry, &texture);
    Some(texture)
}

fn skip(report: &mut Report, entry: &TextureEntry, rules: &[Rule], why: &str) {
    for rule in rules {
        report.skip(*rule, entry.role.name(), why);
    }
}

/// The manifest's figures were computed from the same bytes in the same order: only their decimal
/// digits may differ.
fn check_statistics(report: &mut Report, entry: &TextureEntry, texture: &Texture) {
    let image = texture.view_of_level(0);
    for (index, channel) in entry.channels.iter().enumerate() {
        let (mean, spread) = image.mean_and_spread(index);
        let apart = (mean - channel.mean)
            .abs()
            .max((spread - channel.spread).abs());
        let scale = 1.0_f32.max(mean.abs());
        report.at_most(STATISTICS, &subject(entry.role, index), apart / scale, 1e-5);
    }
}

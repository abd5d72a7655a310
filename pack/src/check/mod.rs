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
mod tiling;

use std::collections::BTreeMap;
use std::path::Path;

pub use report::{Finding, Outcome, Report};
pub use rule::{RULES, Rule, Severity};

use crate::read::{in_folder, in_memory};
use crate::{PackError, Role, Texture};
use files::Place;

/// Checks the pack in a folder.
///
/// # Errors
/// [`PackError`] if the manifest cannot be read at all: then there is nothing to check. Everything else
/// that is wrong, a damaged texture too, is in the report.
pub fn check(folder: impl AsRef<Path>) -> Result<Report, PackError> {
    let folder = folder.as_ref();
    check_place(Place {
        name: &folder.display().to_string(),
        read: &|name, limit| in_folder(folder, name, limit),
    })
}

/// Checks a pack whose files are in memory, by their names: the same rules, the same report.
///
/// `place` stands before file names in errors.
///
/// # Errors
/// As [`check`].
pub fn check_memory(place: &str, files: &BTreeMap<String, Vec<u8>>) -> Result<Report, PackError> {
    check_place(Place {
        name: place,
        read: &|name, limit| in_memory(place, files, name, limit),
    })
}

fn check_place(place: Place) -> Result<Report, PackError> {
    let mut report = Report::default();
    let clouds = files::check(&mut report, place, check_texture)?;
    if let Some(clouds) = &clouds {
        field::check(&mut report, clouds);
    }
    let order = |id: &str| RULES.iter().position(|rule| rule.id == id);
    report.findings.sort_by_key(|finding| order(finding.rule));
    Ok(report)
}

fn check_texture(report: &mut Report, role: Role, texture: &Texture) {
    mips::check(report, role, texture);
    match role {
        Role::Clouds => clouds::check(report, texture),
        Role::Stars => stars::check(report, texture),
        Role::Galaxy => galaxy::check(report, texture),
        Role::Sky => sky::check(report, texture),
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

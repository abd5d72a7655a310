//! Proof instead of statistics: the recipe that a manifest holds is baked anew, and everything is compared.

mod clouds;
mod entries;
mod finding;
mod texels;

use std::collections::BTreeMap;
use std::ops::ControlFlow;

use welkin_pack::check::{Examined, Finding, Outcome, Severity};
use welkin_pack::manifest::{Input, MANIFEST_FILE};
use welkin_pack::{Manifest, Pack};

use crate::bake::{BAKER, Progress, bake_from};
use crate::error::BakeError;
use crate::inputs::Inputs;
use crate::recipe::Recipe;

pub use finding::REBAKE;
use finding::finding;

/// Why a pack could not be baked anew.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RebakeError {
    /// Files that the recipe names were not given.
    #[error("{place}: was baked from files that were not given: {files}")]
    Missing {
        /// The pack's manifest.
        place: String,
        /// Their keys in the recipe, with their hashes.
        files: String,
    },
    /// A file was given under a key that the manifest does not have.
    #[error("{place}: was not baked from a file `{key}`, expected {expected}")]
    Unknown {
        /// The pack's manifest.
        place: String,
        /// The key.
        key: String,
        /// The keys that it has.
        expected: String,
    },
    /// A file is not the one that the pack was baked from.
    #[error(
        "`{key}`: BLAKE3 of the file is {found}, expected {expected}; give the file that the pack was baked from"
    )]
    Other {
        /// The key in the recipe.
        key: String,
        /// Hash of the file that was given.
        found: String,
        /// Hash in the manifest.
        expected: String,
    },
    /// The caller asked to stop.
    #[error("cancelled")]
    Cancelled,
}

/// Bakes the recipe in the manifest of a pack anew, with the manifest's seed, and compares manifest, texels and clouds.
///
/// `files` holds the bytes of the files that the recipe names, by their keys, such as `clouds.photo.file`: exactly those that
/// the manifest lists; no path in the recipe is opened. The built-in photograph needs no file.
///
/// A pack has a finding for its manifest, one for every channel, and one for the field of clouds. The figure is the number of
/// entries, values or clouds that differ; the note names the first of them with both values. Left out are what only tells how a
/// file was compressed (`file_bytes`, `file_blake3`, `seal`), and `baker`. What `examined` could not read is skipped.
///
/// Only the version that baked a pack bakes the same bytes for sure. If another one did, a difference is a warning and says so:
/// it is no proof of forgery. That nothing differs is proof in any case.
///
/// # Errors
/// [`RebakeError`], if the files are not those of the manifest or the caller asks to stop. A recipe that cannot be baked is a
/// finding.
pub fn rebake(
    examined: &Examined,
    files: &BTreeMap<String, Vec<u8>>,
    progress: &(dyn Fn(Progress) -> ControlFlow<()> + Sync),
) -> Result<Vec<Finding>, RebakeError> {
    let manifest = &examined.manifest;
    verify_files(&manifest.inputs, files)?;
    let mut findings = match bake(manifest, files, progress) {
        Ok(fresh) => compare(examined, &fresh),
        Err(Failure::Cancelled) => return Err(RebakeError::Cancelled),
        Err(Failure::Refused(why)) => {
            let note = format!("the recipe cannot be baked: {why}");
            vec![finding(MANIFEST_FILE, Outcome::Failed, None, note)]
        }
    };
    if manifest.baker != BAKER {
        findings.iter_mut().for_each(|f| excuse(f, &manifest.baker));
    }
    Ok(findings)
}

/// The files are those of the manifest, no more and no less.
fn verify_files(inputs: &[Input], files: &BTreeMap<String, Vec<u8>>) -> Result<(), RebakeError> {
    let place = || MANIFEST_FILE.to_string();
    for (key, bytes) in files {
        let Some(input) = inputs.iter().find(|input| input.key == *key) else {
            let keys: Vec<String> = inputs.iter().map(|i| format!("`{}`", i.key)).collect();
            let expected = match keys.as_slice() {
                [] => "none: its recipe names no file".to_string(),
                _ => keys.join(", "),
            };
            let (place, key) = (place(), key.clone());
            return Err(RebakeError::Unknown {
                place,
                key,
                expected,
            });
        };
        let found = blake3::hash(bytes).to_hex().to_string();
        if found != input.blake3 {
            let (key, expected) = (key.clone(), input.blake3.clone());
            return Err(RebakeError::Other {
                key,
                found,
                expected,
            });
        }
    }
    let missing = inputs.iter().filter(|i| !files.contains_key(&i.key));
    let missing: Vec<String> = missing
        .map(|i| format!("`{}` (BLAKE3 {})", i.key, i.blake3))
        .collect();
    if missing.is_empty() {
        return Ok(());
    }
    let (place, files) = (place(), missing.join(", "));
    Err(RebakeError::Missing { place, files })
}

/// Why there is no pack to compare with.
enum Failure {
    Cancelled,
    Refused(String),
}

fn bake(
    manifest: &Manifest,
    files: &BTreeMap<String, Vec<u8>>,
    progress: &(dyn Fn(Progress) -> ControlFlow<()> + Sync),
) -> Result<Pack, Failure> {
    let refused = |why: String| Failure::Refused(why);
    let recipe = Recipe::parse("recipe", &manifest.recipe).map_err(|e| refused(e.to_string()))?;
    let resolved = recipe.resolve(Some(manifest.seed));
    let resolved = resolved.map_err(|e| refused(e.to_string()))?;
    bake_from(&resolved, Inputs::Keys(files), progress).map_err(|error| match error {
        BakeError::Cancelled => Failure::Cancelled,
        other => refused(other.to_string()),
    })
}

fn compare(examined: &Examined, fresh: &Pack) -> Vec<Finding> {
    let mut findings = vec![entries::compare(&examined.manifest, fresh.manifest())];
    findings.extend(texels::compare(examined, fresh));
    findings.extend(clouds::compare(examined, fresh.field()));
    findings
}

/// Says of a difference what it is worth where another version baked the pack.
fn excuse(finding: &mut Finding, baker: &str) {
    if finding.outcome == Outcome::Failed {
        finding.severity = Severity::Warning;
        finding.note += &format!(
            "; baked by {baker}, compared with {BAKER}: versions may bake different bytes, so this is no proof of forgery"
        );
    }
}

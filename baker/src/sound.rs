//! A pack is checked before it leaves the baker, and what is not sound is told by the key of the recipe to turn.

use welkin_pack::Pack;
use welkin_pack::check::{Finding, Report, check_pack};

use crate::error::{BakeError, Fault};

/// What `welkin check` says of the textures and the field of a pack: all passed, but perhaps for warnings.
///
/// # Errors
/// [`BakeError::Unsound`] if a rule of severity *error* is broken.
pub fn verify(pack: &Pack) -> Result<Report, BakeError> {
    let report = check_pack(pack);
    let errors = report.findings.iter().filter(|finding| finding.is_error());
    let faults: Vec<Fault> = errors
        .map(|finding| Fault {
            key: recipe_key(finding).to_string(),
            finding: finding.clone(),
        })
        .collect();
    if faults.is_empty() {
        Ok(report)
    } else {
        Err(BakeError::Unsound { faults })
    }
}

/// The key of the recipe that a finding of `check` leans on most.
pub fn recipe_key(finding: &Finding) -> &'static str {
    let is_told = |(rule, subject, _): &&(&str, &str, &str)| {
        finding.rule.starts_with(rule) && finding.subject.starts_with(subject)
    };
    KEYS.iter().find(is_told).map_or("seed", |(_, _, key)| key)
}

/// How the rule and its subject begin, and the key to turn; the first that fits. What depends on chance alone is told as
/// `seed`.
const KEYS: &[(&str, &str, &str)] = &[
    ("cloud-apart", "", "clouds.noise.cells"),
    ("cloud-mean", "clouds.noise", "clouds.noise.mean"),
    ("cloud-mean", "clouds.detail", "clouds.detail.mean"),
    ("cloud-cover", "", "clouds.noise.mean"),
    ("cloud-clear", "clouds.photo", "clouds.photo.levels"),
    ("cloud-spread", "clouds.photo", "clouds.photo.mean"),
    ("cloud-spread", "clouds.noise", "clouds.noise.mean"),
    ("cloud-spread", "clouds.detail", "clouds.detail.mean"),
    ("", "clouds.photo", "clouds.photo.file"),
    ("smooth", "clouds.noise", "clouds.noise.octaves"),
    ("smooth", "clouds.detail", "clouds.detail.octaves"),
    ("", "clouds.noise", "clouds.noise.cells"),
    ("", "clouds.detail", "clouds.detail.cells"),
    ("", "clouds.gradient", "clouds.gradient.power"),
    ("star-share", "", "stars.count"),
    ("star-light", "", "stars.brightest"),
    ("star", "", "seed"),
    ("galaxy", "", "galaxy.tilt_deg"),
    ("", "galaxy", "galaxy.size"),
    ("sky-smooth", "", "sky.suns"),
    ("sky", "", "sky.haze"),
    ("", "sky.", "sky.haze"),
    ("", "sun", "sun.size"),
    ("", "fbm", "fbm.cells"),
    ("", "flares", "flares.size"),
    ("smooth", "layers", "layers.size"),
    (
        "normal-slope",
        "layers stratocumulus",
        "layers.stratocumulus.relief",
    ),
    ("normal-slope", "layers cumulus", "layers.cumulus.relief"),
    ("normal-slope", "layers cirrus", "layers.cirrus.relief"),
    ("", "layers stratocumulus", "layers.stratocumulus.cells"),
    ("", "layers cumulus", "layers.cumulus.cells"),
    ("", "layers cirrus", "layers.cirrus.cells"),
    ("", "layers", "layers.size"),
    ("sprite-cells", "", "sprites.softness"),
    ("", "sprites", "sprites.size"),
    ("skybox-range", "", "skybox.gain"),
    ("", "skybox", "skybox.size"),
    ("", "catalogue", "stars.catalogue"),
    ("field-boxes", "", "field.models"),
    ("field-rank", "", "field.models"),
    ("field-hours", "", "field.hours"),
    ("field-light", "", "field.hours"),
    ("field-counts", "", "field.clouds"),
    ("", "field", "field.clouds"),
];

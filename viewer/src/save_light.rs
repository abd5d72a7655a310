//! Saves image-based light: a texture, and the JSON beside it.

use std::path::{Path, PathBuf};

use anyhow::Result;
use welkin_pack::whole::write_files;
use welkin_viewer::export::light::Light;

/// The place of the JSON that goes beside a texture.
pub fn json_path(texture: &Path) -> PathBuf {
    texture.with_extension("json")
}

/// Writes both files, each whole, or neither. `source` is what the light is of; its name alone is told.
pub fn save(light: &Light, texture: &Path, source: &Path) -> Result<()> {
    let bytes = light.ktx2(&texture.display().to_string())?;
    let json = light.json(&name(source), &name(texture))?;
    let beside = json_path(texture);
    let files = [(beside.as_path(), json.as_bytes()), (texture, &bytes)];
    Ok(write_files(&files, &|| false)?)
}

/// The last part of a path, of one such as `.` too.
fn name(path: &Path) -> String {
    let last = |path: &Path| Some(path.file_name()?.to_string_lossy().into_owned());
    let resolved = || last(&path.canonicalize().ok()?);
    last(path).or_else(resolved).unwrap_or_default()
}

//! What was dropped on the window.

use std::path::{Path, PathBuf};

/// A file or folder by what the window makes of it.
#[derive(Debug, PartialEq, Eq)]
pub enum Dropped {
    /// A folder with a pack: it is shown.
    Pack(PathBuf),
    /// A picture: it becomes the photo channel.
    Photo(PathBuf),
    /// Settings: they are loaded.
    Settings(PathBuf),
    /// Something else: what to say.
    Unknown(String),
}

/// What a path is, by its kind and its name.
pub fn sort(path: &Path) -> Dropped {
    if path.is_dir() {
        return Dropped::Pack(path.to_path_buf());
    }
    if path.file_name().is_some_and(|name| name == "pack.json") {
        let folder = path.parent().unwrap_or(Path::new("."));
        return Dropped::Pack(folder.to_path_buf());
    }
    let extension = path
        .extension()
        .and_then(|e| e.to_str())
        .unwrap_or_default();
    match extension.to_ascii_lowercase().as_str() {
        "png" | "jpg" | "jpeg" => Dropped::Photo(path.to_path_buf()),
        "toml" => Dropped::Settings(path.to_path_buf()),
        _ => Dropped::Unknown(format!(
            "{}: can be nothing here; drop a pack's folder, a photograph (.png, .jpg) or settings (.toml)",
            path.display()
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_is_sorted_by_its_kind_and_name() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path();
        assert_eq!(sort(path), Dropped::Pack(path.to_path_buf()));
        let of = |name: &str| sort(&path.join(name));
        assert_eq!(of("pack.json"), Dropped::Pack(path.to_path_buf()));
        assert_eq!(of("a.JPG"), Dropped::Photo(path.join("a.JPG")));
        assert_eq!(of("sky.toml"), Dropped::Settings(path.join("sky.toml")));
        assert!(matches!(of("a.gif"), Dropped::Unknown(text) if text.contains("a.gif")));
    }
}

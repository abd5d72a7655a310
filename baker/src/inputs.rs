//! Where the files that a recipe names come from.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use crate::error::BakeError;
use crate::load::{MAX_FILE_BYTES, verify_bytes};

/// Where the files that a recipe names come from.
#[derive(Clone, Copy, Debug)]
pub enum Inputs<'a> {
    /// From files. Relative paths start from the folder; without one they are errors.
    Folder(Option<&'a Path>),
    /// From memory, by the names that the recipe gives them.
    Memory(&'a BTreeMap<String, Vec<u8>>),
    /// From memory, by their keys in the recipe, such as `clouds.photo.file`. No path is looked at.
    Keys(&'a BTreeMap<String, Vec<u8>>),
}

/// A file that a recipe names.
pub(crate) struct Picture {
    /// Its key in the recipe.
    pub key: String,
    /// Its path, for errors.
    pub file: String,
    /// What is in it.
    pub bytes: Vec<u8>,
}

impl Inputs<'_> {
    /// Reads `file`, the value of `key`: at most 256 MiB.
    pub(crate) fn read(self, file: &str, key: &str) -> Result<Picture, BakeError> {
        let (file, bytes) = match self {
            Inputs::Folder(base) => {
                let path = place(base, file, key)?;
                (path.display().to_string(), read_file(&path, key)?)
            }
            Inputs::Memory(files) | Inputs::Keys(files) => {
                let name = match self {
                    Inputs::Keys(_) => key,
                    _ => file,
                };
                let missing = || BakeError::Read {
                    file: file.to_string(),
                    key: key.to_string(),
                    source: io::Error::new(io::ErrorKind::NotFound, "it was not given"),
                };
                let bytes = files.get(name).ok_or_else(missing)?;
                verify_bytes(file, bytes)?;
                (file.to_string(), bytes.clone())
            }
        };
        let key = key.to_string();
        Ok(Picture { key, file, bytes })
    }
}

fn place(base: Option<&Path>, file: &str, key: &str) -> Result<PathBuf, BakeError> {
    match base {
        _ if Path::new(file).is_absolute() => Ok(PathBuf::from(file)),
        Some(folder) => Ok(folder.join(file)),
        None => Err(BakeError::NoBase {
            file: file.to_string(),
            key: key.to_string(),
        }),
    }
}

/// Reads the bytes of a picture that the recipe names under `key`.
pub(crate) fn read_file(path: &Path, key: &str) -> Result<Vec<u8>, BakeError> {
    let file = path.display().to_string();
    let failed = |source| BakeError::Read {
        file: file.clone(),
        key: key.to_string(),
        source,
    };
    let opened = File::open(path).map_err(failed)?;
    let mut bytes = Vec::new();
    opened
        .take(MAX_FILE_BYTES + 1)
        .read_to_end(&mut bytes)
        .map_err(failed)?;
    verify_bytes(&file, &bytes)?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_by_their_keys_have_any_name_in_the_recipe() {
        let files = BTreeMap::from([("sprites.file".to_string(), vec![3])]);
        let inputs = Inputs::Keys(&files);
        let picture = inputs.read("/no/such/file.png", "sprites.file").unwrap();
        assert_eq!(
            (picture.bytes, picture.file),
            (vec![3], "/no/such/file.png".to_string())
        );
        assert!(inputs.read("sprites.file", "skybox.file").is_err());
    }

    #[test]
    fn memory_gives_what_it_has_by_its_name() {
        let files = BTreeMap::from([("a/b.png".to_string(), vec![1, 2])]);
        let inputs = Inputs::Memory(&files);
        assert_eq!(
            inputs.read("a/b.png", "sprites.file").unwrap().bytes,
            [1, 2]
        );
        let error = inputs.read("b.png", "sprites.file").err().unwrap();
        assert_eq!(
            error.to_string(),
            "b.png: cannot be read: it was not given; check `sprites.file` in the recipe"
        );
    }
}

//! Where the files that a recipe names come from, and how they are read: one after another, each gone before the next.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use welkin_pack::manifest::Input;

use crate::error::{BakeError, too_long};

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

/// A file as a recipe names it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Named {
    /// Its key in the recipe.
    pub key: String,
    /// Its path as the recipe has it.
    pub file: String,
    /// The most bytes that it may have.
    pub most_bytes: u64,
}

impl Named {
    pub fn new(key: impl Into<String>, file: &str, most_bytes: u64) -> Named {
        Named {
            key: key.into(),
            file: file.to_string(),
            most_bytes,
        }
    }
}

/// A file that was read.
#[derive(Debug)]
pub(crate) struct Picture {
    /// Its path, for errors.
    pub file: String,
    /// What is in it.
    pub bytes: Vec<u8>,
}

/// Reads files when they are needed, and keeps their hashes alone.
#[derive(Debug)]
pub(crate) struct Reader<'a> {
    inputs: Inputs<'a>,
    hashes: RefCell<Vec<Input>>,
}

impl<'a> Reader<'a> {
    pub fn new(inputs: Inputs<'a>) -> Reader<'a> {
        Reader {
            inputs,
            hashes: RefCell::default(),
        }
    }

    /// Reads a file. The hash that is kept is that of these very bytes.
    pub fn read(&self, named: &Named) -> Result<Picture, BakeError> {
        let picture = self.read_only(named)?;
        self.hashes.borrow_mut().push(Input {
            key: named.key.clone(),
            blake3: blake3::hash(&picture.bytes).to_hex().to_string(),
        });
        Ok(picture)
    }

    /// Reads a file that no manifest names.
    pub fn read_only(&self, named: &Named) -> Result<Picture, BakeError> {
        let Named {
            key,
            file,
            most_bytes,
        } = named;
        match self.inputs {
            Inputs::Folder(base) => {
                let path = place(base, file, key)?;
                let name = path.display().to_string();
                let bytes = read_limited(&path, *most_bytes)
                    .map_err(|source| unreadable(&name, key, source))?;
                let bytes = bytes.ok_or_else(|| too_long(&name, *most_bytes))?;
                Ok(Picture { file: name, bytes })
            }
            Inputs::Memory(files) => picture(file, given(files, file, named)?),
            Inputs::Keys(files) => picture(file, given(files, key, named)?),
        }
    }

    /// Sees that a file is there and not too long, without reading it: what is missing is told before a bake begins, and not
    /// in the midst of it.
    pub fn look_for(&self, named: &Named) -> Result<(), BakeError> {
        match self.inputs {
            Inputs::Folder(base) => {
                let path = place(base, &named.file, &named.key)?;
                let name = path.display().to_string();
                let found = fs::metadata(&path).map_err(|e| unreadable(&name, &named.key, e))?;
                if found.is_file() && found.len() > named.most_bytes {
                    return Err(too_long(&name, named.most_bytes));
                }
                Ok(())
            }
            Inputs::Memory(files) => given(files, &named.file, named).map(drop),
            Inputs::Keys(files) => given(files, &named.key, named).map(drop),
        }
    }

    /// Keys and hashes of the files that were read, in their order.
    pub fn into_hashes(self) -> Vec<Input> {
        self.hashes.into_inner()
    }
}

fn picture(file: &str, bytes: &[u8]) -> Result<Picture, BakeError> {
    Ok(Picture {
        file: file.to_string(),
        bytes: bytes.to_vec(),
    })
}

/// A file of the memory, which is not too long. `name` is what it is found by.
fn given<'a>(
    files: &'a BTreeMap<String, Vec<u8>>,
    name: &str,
    named: &Named,
) -> Result<&'a Vec<u8>, BakeError> {
    let bytes = files.get(name).ok_or_else(|| {
        let source = io::Error::new(io::ErrorKind::NotFound, "it was not given");
        unreadable(&named.file, &named.key, source)
    })?;
    if bytes.len() as u64 > named.most_bytes {
        return Err(too_long(&named.file, named.most_bytes));
    }
    Ok(bytes)
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

/// The bytes of a file, or nothing if there are more than `most`.
pub(crate) fn read_limited(path: &Path, most: u64) -> io::Result<Option<Vec<u8>>> {
    let file = File::open(path)?;
    let mut bytes = Vec::new();
    // A file that says its length takes no more memory than that.
    bytes.try_reserve_exact(file.metadata()?.len().min(most) as usize + 1)?;
    file.take(most + 1).read_to_end(&mut bytes)?;
    Ok((bytes.len() as u64 <= most).then_some(bytes))
}

fn unreadable(file: &str, key: &str, source: io::Error) -> BakeError {
    BakeError::Read {
        file: file.to_string(),
        key: key.to_string(),
        source,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_by_their_keys_have_any_name_in_the_recipe() {
        let files = BTreeMap::from([("sprites.file".to_string(), vec![3])]);
        let reader = Reader::new(Inputs::Keys(&files));
        let named = |key: &str, file: &str| Named::new(key, file, 8);
        let picture = reader
            .read(&named("sprites.file", "/no/such/file.png"))
            .unwrap();
        assert_eq!(
            (picture.bytes, picture.file),
            (vec![3], "/no/such/file.png".to_string())
        );
        assert!(reader.read(&named("skybox.file", "sprites.file")).is_err());
    }

    #[test]
    fn memory_gives_what_it_has_by_its_name() {
        let files = BTreeMap::from([("a/b.png".to_string(), vec![1, 2])]);
        let reader = Reader::new(Inputs::Memory(&files));
        let named = |file: &str| Named::new("sprites.file", file, 1 << 20);
        assert_eq!(reader.read(&named("a/b.png")).unwrap().bytes, [1, 2]);
        for error in [
            reader.read(&named("b.png")).unwrap_err(),
            reader.look_for(&named("b.png")).unwrap_err(),
        ] {
            assert_eq!(
                error.to_string(),
                "b.png: cannot be read: it was not given; check `sprites.file` in the recipe"
            );
        }
    }

    #[test]
    fn the_limit_is_told_before_and_after_a_file_is_opened() {
        let folder = tempfile::tempdir().unwrap();
        let long = vec![7; (1 << 20) + 1];
        std::fs::write(folder.path().join("long"), &long).unwrap();
        std::fs::write(folder.path().join("fits"), &long[1..]).unwrap();
        let files = BTreeMap::from([
            ("long".to_string(), long.clone()),
            ("fits".to_string(), long[1..].to_vec()),
        ]);
        for inputs in [Inputs::Folder(Some(folder.path())), Inputs::Memory(&files)] {
            let reader = Reader::new(inputs);
            let named = |file: &str| Named::new("k", file, 1 << 20);
            for error in [
                reader.look_for(&named("long")).unwrap_err(),
                reader.read(&named("long")).unwrap_err(),
            ] {
                let text = error.to_string();
                assert!(
                    text.ends_with(
                        "long: length is over 1 MiB, expected at most 1 MiB; save it smaller"
                    ),
                    "{text}"
                );
            }
            reader.look_for(&named("fits")).unwrap();
            assert_eq!(reader.read(&named("fits")).unwrap().bytes.len(), 1 << 20);
            let hashes = reader.into_hashes();
            let expected = blake3::hash(&long[1..]).to_hex();
            assert_eq!(hashes.len(), 1);
            assert_eq!(hashes[0].blake3.as_str(), expected.as_str());
        }
    }
}

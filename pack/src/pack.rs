//! A pack in memory: built from images, opened from a folder, saved to one.

use std::fs;
use std::io::{self, Read};
use std::path::Path;

use crate::field::glb;
use crate::limits::{MAX_FIELD_BYTES, MAX_FILE_BYTES, MAX_MANIFEST_BYTES};
use crate::manifest::MANIFEST_FILE;
use crate::{Field, Manifest, PackError, Role, Texture, ktx};

#[cfg(feature = "write")]
pub use crate::build::{PackInfo, Source};
#[cfg(feature = "write")]
pub use crate::save::Overwrite;

/// A pack: its manifest, its textures and its field of clouds, which agree with each other.
///
/// It also keeps the bytes of its files, so that saving it again copies them.
#[derive(Clone, Debug, PartialEq)]
pub struct Pack {
    pub(crate) manifest: Manifest,
    pub(crate) textures: Vec<Texture>,
    pub(crate) field: Option<Field>,
    /// Name and bytes of every file, the manifest last.
    pub(crate) files: Vec<(String, Vec<u8>)>,
}

impl Pack {
    /// What the pack says of itself.
    pub fn manifest(&self) -> &Manifest {
        &self.manifest
    }

    /// The texture of a role, if the pack has it.
    pub fn texture(&self, role: Role) -> Option<&Texture> {
        let index = self.manifest.textures.iter().position(|t| t.role == role)?;
        self.textures.get(index)
    }

    /// The clouds in space, if the pack has any.
    pub fn field(&self) -> Option<&Field> {
        self.field.as_ref()
    }

    /// Name and bytes of every file of the pack, the manifest last.
    pub fn files(&self) -> &[(String, Vec<u8>)] {
        &self.files
    }

    /// Reads a pack from a folder and verifies it: version, seal, every file, every hash.
    ///
    /// # Errors
    /// See [`PackError`]. Sizes are compared with [`crate::limits`] before anything is allocated for them.
    pub fn open(folder: impl AsRef<Path>) -> Result<Pack, PackError> {
        let folder = folder.as_ref();
        Pack::from_files(&folder.display().to_string(), |name, limit| {
            read_file(folder, name, limit)
        })
    }

    /// Reads a pack through `read(name, limit)`, which gives the bytes of a file of at most `limit` bytes.
    ///
    /// `place` stands before file names in errors.
    ///
    /// # Errors
    /// As [`Pack::open`], and those of `read`.
    pub fn from_files(
        place: &str,
        read: impl Fn(&str, u64) -> Result<Vec<u8>, PackError>,
    ) -> Result<Pack, PackError> {
        let bytes = read(MANIFEST_FILE, MAX_MANIFEST_BYTES)?;
        let manifest = Manifest::from_json(&join(place, MANIFEST_FILE), &bytes)?;
        manifest.verify(&join(place, MANIFEST_FILE))?;
        let mut textures = Vec::new();
        let mut files = Vec::new();
        for entry in &manifest.textures {
            let file = join(place, &entry.file);
            let bytes = read(&entry.file, MAX_FILE_BYTES)?;
            entry.verify_file(&file, &bytes)?;
            let texture = ktx::decode(&file, &bytes)?;
            entry.verify_layout(&file, &texture)?;
            entry.verify_texels(&file, &texture)?;
            textures.push(texture);
            files.push((entry.file.clone(), bytes));
        }
        let mut field = None;
        if let Some(entry) = &manifest.field {
            let file = join(place, &entry.file);
            let bytes = read(&entry.file, MAX_FIELD_BYTES)?;
            entry.verify_file(&file, &bytes)?;
            let decoded = glb::decode(&file, &bytes)?;
            entry.verify_counts(&file, &decoded)?;
            decoded.verify(&file)?;
            field = Some(decoded);
            files.push((entry.file.clone(), bytes));
        }
        files.push((MANIFEST_FILE.to_string(), bytes));
        Ok(Pack {
            manifest,
            textures,
            field,
            files,
        })
    }
}

fn join(place: &str, name: &str) -> String {
    format!("{}/{name}", place.trim_end_matches('/'))
}

/// Reads a file of a pack's folder that has at most `limit` bytes.
pub(crate) fn read_file(folder: &Path, name: &str, limit: u64) -> Result<Vec<u8>, PackError> {
    let path = folder.join(name);
    let file = path.display().to_string();
    let failed = |source: io::Error| match source.kind() {
        io::ErrorKind::NotFound | io::ErrorKind::NotADirectory => PackError::Missing {
            file: file.clone(),
            expected: format!("a file of the pack {}", folder.display()),
        },
        _ => PackError::Read {
            file: file.clone(),
            source,
        },
    };
    let mut handle = fs::File::open(&path).map_err(failed)?;
    let size = handle.metadata().map_err(failed)?.len();
    let mut bytes = Vec::new();
    if size <= limit {
        // A device or a growing file may hold more than it says.
        (&mut handle)
            .take(limit + 1)
            .read_to_end(&mut bytes)
            .map_err(failed)?;
    }
    let found = size.max(bytes.len() as u64);
    if found > limit {
        return Err(PackError::TooLarge {
            file,
            key: "size in bytes".to_string(),
            found,
            limit,
        });
    }
    Ok(bytes)
}

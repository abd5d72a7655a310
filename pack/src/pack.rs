//! A pack in memory: built from images, opened from a folder, saved to one.

use std::collections::BTreeMap;
use std::path::Path;

use crate::error::PackError;
use crate::field::Field;
use crate::ktx;
use crate::limits::{MAX_FIELD_BYTES, MAX_FILE_BYTES, MAX_MANIFEST_BYTES};
use crate::manifest::{MANIFEST_FILE, Manifest};
use crate::read::{in_folder, in_memory, join};
use crate::role::Role;
use crate::texture::Texture;

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
            in_folder(folder, name, limit)
        })
    }

    /// Reads a pack from the bytes of its files by their names, and verifies it as [`Pack::open`] does.
    ///
    /// `place` stands before file names in errors.
    ///
    /// # Errors
    /// As [`Pack::open`].
    pub fn from_memory(place: &str, files: &BTreeMap<String, Vec<u8>>) -> Result<Pack, PackError> {
        Pack::from_files(place, |name, limit| in_memory(place, files, name, limit))
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
            let decoded = Field::from_glb(&file, &bytes)?;
            entry.verify_counts(&file, &decoded)?;
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

//! The entry of the field of clouds.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::error::PackError;
use crate::field::Field;
use crate::limits::{MAX_BOXES, MAX_CLOUDS, MAX_SECTIONS, MAX_SPRITES};
use crate::read::verify_bytes;

/// The field of clouds of a pack.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FieldEntry {
    /// Its file, in the folder of the manifest: always `field.glb`.
    pub file: String,
    /// Sections along a side.
    pub sections: u32,
    /// Clouds.
    pub clouds: u32,
    /// Boxes of all clouds.
    pub boxes: u32,
    /// Sprites of all clouds.
    pub sprites: u32,
    /// Bytes of the file.
    pub file_bytes: u64,
    /// BLAKE3 of the file, in lower-case hexadecimal: tells a damaged file.
    pub file_blake3: String,
}

impl FieldEntry {
    /// The name of the file in every pack.
    pub const FILE: &str = "field.glb";

    /// The entry of a field that was written as `bytes`.
    #[cfg(feature = "write")]
    pub(crate) fn new(field: &Field, bytes: &[u8]) -> FieldEntry {
        FieldEntry {
            file: FieldEntry::FILE.to_string(),
            sections: field.sections,
            clouds: field.clouds.len() as u32,
            boxes: field.box_count() as u32,
            sprites: field.sprite_count() as u32,
            file_bytes: bytes.len() as u64,
            file_blake3: blake3::hash(bytes).to_hex().to_string(),
        }
    }

    /// Verifies the name and that the counts are within the limits.
    pub(super) fn verify(&self, file: &str) -> Result<(), PackError> {
        if self.file != FieldEntry::FILE {
            return Err(PackError::value(
                file,
                "field.file",
                &self.file,
                FieldEntry::FILE,
            ));
        }
        let counts = [
            ("sections", self.sections, MAX_SECTIONS),
            ("clouds", self.clouds, MAX_CLOUDS as u32),
            ("boxes", self.boxes, MAX_BOXES as u32),
            ("sprites", self.sprites, MAX_SPRITES as u32),
        ];
        for (key, found, most) in counts {
            if !(1..=most).contains(&found) {
                let key = format!("field.{key}");
                return Err(PackError::value(file, &key, found, format!("1 to {most}")));
            }
        }
        Ok(())
    }

    /// Compares a file's bytes with this entry.
    pub(crate) fn verify_file(&self, file: &str, bytes: &[u8]) -> Result<(), PackError> {
        verify_bytes(file, bytes, self.file_bytes, &self.file_blake3)
    }

    /// Compares what was read with this entry.
    pub(crate) fn verify_counts(&self, file: &str, field: &Field) -> Result<(), PackError> {
        let counts = [
            ("sections", field.sections as usize, self.sections),
            ("clouds", field.clouds.len(), self.clouds),
            ("boxes", field.box_count(), self.boxes),
            ("sprites", field.sprite_count(), self.sprites),
        ];
        for (key, found, expected) in counts {
            if found != expected as usize {
                return Err(PackError::value(file, key, found, expected));
            }
        }
        Ok(())
    }
}

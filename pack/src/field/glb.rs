//! `field.glb`: a field as binary glTF, for any tool that reads it.
//!
//! # Theory
//! Khronos Group, "glTF 2.0 Specification", 2021, section 4.4 (the container) and 5 (the JSON); D. McCurdy and others,
//! "EXT_mesh_gpu_instancing", 2020: a node's mesh is drawn once for each entry of TRANSLATION, ROTATION, SCALE, and
//! attributes that begin with an underscore are the application's.
//!
//! # Practice
//! Two nodes: `sprites` instances a unit square, `boxes` a unit cube. What is not an instance (light, colour
//! levels, clouds and their shading groups) is in the scene's `extras`. docs/pack-format.md says it to the byte.
//!
//! The crate `gltf` is not used here: it does not know the extension, so that accessors would be resolved by hand all the
//! same; version 1.4.1 subtracts without a look when a file says that it is shorter than its own header; and the runtime
//! would carry a second reader of JSON documents. `serde_json` is here anyway.

mod accessor;
mod container;
mod document;
mod read;
mod rotation;
#[cfg(test)]
#[cfg(feature = "write")]
mod tests;
#[cfg(feature = "write")]
mod write;

pub(crate) use read::decode;
#[cfg(feature = "write")]
pub(crate) use write::encode;

use super::Field;
use crate::error::PackError;

impl Field {
    /// Reads a field from the bytes of a `field.glb`, and verifies it as [`Field::verify`] does. `file` names it in errors.
    ///
    /// # Errors
    /// [`PackError`] if it is not a file as docs/pack-format.md describes it. Counts are compared with
    /// [`crate::limits`] and with the length of the file before anything is allocated for them.
    pub fn from_glb(file: &str, bytes: &[u8]) -> Result<Field, PackError> {
        let field = decode(file, bytes)?;
        field.verify(file)?;
        Ok(field)
    }
}

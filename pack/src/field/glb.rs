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
#[cfg(test)]
#[cfg(feature = "write")]
mod tests;
#[cfg(feature = "write")]
mod write;

pub(crate) use read::decode;
#[cfg(feature = "write")]
pub(crate) use write::encode;

use super::{ROTATION_STEPS, rotation_step};

/// The extension by which sprites and boxes are instances.
const INSTANCING: &str = "EXT_mesh_gpu_instancing";

/// Names of the nodes.
const SPRITES: &str = "sprites";
const BOXES: &str = "boxes";

/// A rotation as a unit quaternion (x, y, z, w) in steps of a signed 16-bit unorm.
///
/// A facing sprite is turned about +Z. A flat one is first laid down, so that it faces +Y and its height points to
/// -Z, and then turned about +Y.
fn quaternion(rotation_rad: f32, flat: bool) -> [i16; 4] {
    let half =
        f64::from(rotation_step(rotation_rad)) * std::f64::consts::PI / f64::from(ROTATION_STEPS);
    let (sin, cos) = (libm::sin(half), libm::cos(half));
    let lay = std::f64::consts::FRAC_1_SQRT_2;
    let parts = if flat {
        [-lay * cos, lay * sin, lay * sin, lay * cos]
    } else {
        [0.0, 0.0, sin, cos]
    };
    parts.map(|part| libm::round(part * f64::from(i16::MAX)) as i16)
}

/// The inverse of [`quaternion`]; nothing if it is not one of those.
fn rotation(quaternion_steps: [i16; 4], flat: bool) -> Option<f32> {
    let [_, y, z, w] = quaternion_steps.map(f32::from);
    let rotation = super::rounded_rotation(2.0 * libm::atan2f(if flat { y } else { z }, w));
    (quaternion(rotation, flat) == quaternion_steps).then_some(rotation)
}

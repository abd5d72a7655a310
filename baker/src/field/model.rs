//! An artist's model: a glTF file whose mesh nodes are boxes, or sprites that are placed one by one.
//!
//! Khronos Group, "glTF 2.0 Specification", 2021. A box is the bounds of a node's mesh, as its accessors tell them, after the
//! transforms of the node and of those above it; so no buffer is read. Its custom properties, `extras`, say the rest. A node
//! with the property `cell` is a sprite (`sprites.rs`); [`cloud_model`] writes a cloud in that way, for an artist to edit and to bake again.

mod extras;
mod node;
mod sprites;
#[cfg(test)]
mod tests;
mod write;

use std::collections::BTreeMap;

use gltf::{Document, Gltf, Node};

use super::boxes::{self, Fault, PLACES_M, SIZES_M};
use super::cloud::groups;
use crate::error::{BakeError, model_error};
use crate::settings::{BoxSettings, PlacedSprite};
use welkin_pack::limits::MAX_GROUPS;

use node::{IDENTITY, Matrix, corners, product, transformed};
pub use write::cloud_model;

/// The largest file: boxes take a few kilobytes.
pub(crate) const MAX_BYTES: u64 = 16 << 20;

/// The most values of its JSON, those of a mesh's buffers not among them: a box has about 40. The shortest value, `{}`,
/// takes a hundred times its length once it is read.
const MAX_VALUES: usize = 1 << 18;

/// The most nodes that are visited, and how deep they may be nested: a file may name a node twice, or within itself.
const MAX_NODES: usize = 4096;
const MAX_DEPTH: usize = 64;

/// The boxes of a model, in the order of its nodes. `file` names it in errors.
///
/// # Errors
/// [`BakeError::Model`].
pub(crate) fn boxes(bytes: &[u8], file: &str) -> Result<Vec<BoxSettings>, BakeError> {
    let unfit = |key: &str, found: String, expected: &str| model_error(file, key, found, expected);
    let values = value_count(bytes);
    if values > MAX_VALUES {
        let expected = format!("at most {MAX_VALUES}; export the boxes alone");
        return Err(unfit("glTF", format!("of {values} values"), &expected));
    }
    let gltf = document(bytes).map_err(|found| {
        let expected = "a whole glTF 2.0 file without required extensions; export it again";
        unfit("glTF", found, expected)
    })?;
    let scene = gltf.default_scene().or_else(|| gltf.scenes().next());
    let scene = scene.ok_or_else(|| unfit("scenes", "none".to_string(), "a scene"))?;
    let mut visit = Visit {
        file,
        nodes: 0,
        boxes: Vec::new(),
        by_hand: BTreeMap::new(),
    };
    for node in scene.nodes() {
        visit.node(&node, &IDENTITY, 0)?;
    }
    let by_hand = visit.by_hand.iter();
    let by_hand = by_hand.flat_map(|(group, placed)| sprites::boxes(*group, placed));
    visit.boxes.extend(by_hand);
    if visit.boxes.is_empty() {
        let expected = "boxes: nodes of the scene that have a mesh";
        return Err(unfit("nodes", "without a mesh".to_string(), expected));
    }
    let groups = groups(&visit.boxes).len();
    if groups > MAX_GROUPS {
        let expected = format!("at most {MAX_GROUPS} different numbers");
        return Err(unfit("group", format!("{groups} numbers"), &expected));
    }
    Ok(visit.boxes)
}

/// The most values that the JSON can have: each but the first follows a comma, a bracket or a brace. A binary file's first
/// chunk is its JSON.
fn value_count(bytes: &[u8]) -> usize {
    let json = match bytes.strip_prefix(b"glTF") {
        Some(binary) => {
            let length = binary.get(8..12).and_then(|b| b.first_chunk());
            let length = length.map_or(0, |b| u32::from_le_bytes(*b) as usize);
            let json = binary.get(16..).unwrap_or_default();
            &json[..length.min(json.len())]
        }
        None => bytes,
    };
    json.iter().filter(|b| b",[{".contains(b)).count()
}

/// The document, every index of which names something that is there; or what is wrong.
fn document(bytes: &[u8]) -> Result<Document, String> {
    if !has_sound_header(bytes) {
        return Err("shorter than it says".to_string());
    }
    let gltf = Gltf::from_slice_without_validation(bytes).map_err(|e| e.to_string())?;
    let root = gltf.document.into_json();
    // The library's own look at the positions takes it for granted that they are there.
    let primitives = root.meshes.iter().flat_map(|mesh| &mesh.primitives);
    let mut accessors = primitives.flat_map(|primitive| primitive.attributes.values());
    if let Some(missing) = accessors.find(|index| index.value() >= root.accessors.len()) {
        let (index, count) = (missing.value(), root.accessors.len());
        return Err(format!("naming accessor {index} of {count}"));
    }
    Document::from_json(root).map_err(|e| e.to_string())
}

/// The library subtracts the header's length from what a binary file says of its own, without a look.
fn has_sound_header(bytes: &[u8]) -> bool {
    let length = bytes.get(8..12).and_then(|b| b.first_chunk());
    let length = length.map(|b| u32::from_le_bytes(*b));
    !bytes.starts_with(b"glTF") || length.is_some_and(|length| length >= 12)
}

struct Visit<'a> {
    file: &'a str,
    nodes: usize,
    boxes: Vec<BoxSettings>,
    /// Sprites that are placed one by one, by their shading group.
    by_hand: BTreeMap<u32, Vec<PlacedSprite>>,
}

impl Visit<'_> {
    fn node(&mut self, node: &Node, above: &Matrix, depth: usize) -> Result<(), BakeError> {
        self.nodes += 1;
        if self.nodes > MAX_NODES || depth > MAX_DEPTH {
            let found = format!("over {MAX_NODES}, or nested over {MAX_DEPTH} deep");
            let expected = "fewer nodes, none within itself";
            return Err(model_error(self.file, "nodes", found, expected));
        }
        let matrix = product(above, &node.transform().matrix());
        if node.mesh().is_some() {
            match sprites::read(self.file, node, &matrix)? {
                Some((group, placed)) => self.by_hand.entry(group).or_default().push(placed),
                None => {
                    let of_node = self.cloud_box(node, &matrix)?;
                    self.boxes.push(of_node);
                }
            }
        }
        let mut children = node.children();
        children.try_for_each(|child| self.node(&child, &matrix, depth + 1))
    }

    fn cloud_box(&self, node: &Node, matrix: &Matrix) -> Result<BoxSettings, BakeError> {
        let name = match node.name() {
            Some(name) => format!("node \"{name}\""),
            None => format!("node {}", node.index()),
        };
        let unfit = |key: &str, found: String, expected: String| {
            model_error(self.file, &format!("{name}: {key}"), found, &expected)
        };
        let corners = corners(node).map(|c| c.map(|corner| transformed(matrix, corner)));
        let Some(corners) = corners.filter(|c| c.as_flattened().iter().all(|v| v.is_finite()))
        else {
            let expected = "a least and a largest position, finite".to_string();
            return Err(unfit("bounds", "without them".to_string(), expected));
        };
        let pick = |axis: usize, pick: fn(f32, f32) -> f32| {
            corners.iter().map(|c| c[axis]).reduce(pick).unwrap_or(0.0)
        };
        let mut found = extras::read(node.extras().as_deref(), &unfit)?;
        for axis in 0..3 {
            let (low, high) = (pick(axis, f32::min), pick(axis, f32::max));
            found.centre_m[axis] = 0.5 * (low + high);
            found.size_m[axis] = high - low;
        }
        for (key, values, [least, most]) in [
            ("middle", found.centre_m, PLACES_M),
            ("size", found.size_m, SIZES_M),
        ] {
            if let Some(value) = values.iter().find(|v| !(least..=most).contains(v)) {
                let expected = format!("{least} to {most} m along each axis");
                return Err(unfit(key, format!("{value} m"), expected));
            }
        }
        boxes::verify(&found).map_err(
            |Fault {
                 key,
                 found,
                 expected,
             }| unfit(key, found, expected),
        )?;
        Ok(found)
    }
}

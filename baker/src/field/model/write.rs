//! A cloud as a model that an artist edits: a node for each of its sprites.

use serde_json::{Value, json};
use welkin_pack::field::{Cloud, Sprite};

use crate::field::grid::snapped;

/// A unit square that faces +Z, and the two triangles of it.
const CORNERS: [[f32; 3]; 4] = [
    [-0.5, -0.5, 0.0],
    [0.5, -0.5, 0.0],
    [0.5, 0.5, 0.0],
    [-0.5, 0.5, 0.0],
];
const TRIANGLES: [u16; 6] = [0, 1, 2, 0, 2, 3];

/// Bytes of the two in the file.
const CORNER_BYTES: usize = 48;
const TRIANGLE_BYTES: usize = 12;

/// A binary glTF file with every sprite of a cloud as a node: its place, sides and turn, and the properties `cell` and `group`. The origin
/// is in the middle of the cloud at the height of its base.
///
/// Baked as a model of the same kind with one copy it has the very sprites again, so that one may be moved, added or taken away
/// and the others stay.
pub fn cloud_model(cloud: &Cloud) -> Vec<u8> {
    let mut origin = cloud.centre_m;
    origin[1] -= 0.5 * cloud.size_m[1];
    let origin = origin.map(snapped);
    let sprites = cloud.sprites.iter().enumerate();
    let nodes: Vec<Value> = sprites
        .map(|(number, sprite)| {
            let group = cloud.boxes.get(usize::from(sprite.cloud_box));
            let group = group.map_or(0, |own| own.group);
            let place = [0, 1, 2].map(|axis| sprite.centre_m[axis] - origin[axis]);
            let [width, height] = sprite.size_m;
            json!({
                "name": format!("sprite {number}"),
                "mesh": 0,
                "translation": place,
                "rotation": rotation(sprite, cloud.kind.is_flat()),
                "scale": [width, height, 1.0],
                "extras": {"cell": sprite.cell, "group": group},
            })
        })
        .collect();
    let all: Vec<usize> = (0..nodes.len()).collect();
    let document = json!({
        "asset": {"version": "2.0", "generator": concat!("welkin ", env!("CARGO_PKG_VERSION"))},
        "scene": 0,
        "scenes": [{"nodes": all}],
        "nodes": nodes,
        "meshes": [{"name": "sprite", "primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
                "min": CORNERS[0], "max": CORNERS[2]},
            {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": CORNER_BYTES, "target": 34962},
            {"buffer": 0, "byteOffset": CORNER_BYTES, "byteLength": TRIANGLE_BYTES, "target": 34963},
        ],
        "buffers": [{"byteLength": CORNER_BYTES + TRIANGLE_BYTES}],
    });
    let corners = CORNERS.as_flattened().iter().flat_map(|v| v.to_le_bytes());
    let triangles = TRIANGLES.iter().flat_map(|v| v.to_le_bytes());
    container(
        document.to_string().into_bytes(),
        corners.chain(triangles).collect(),
    )
}

/// A turn as a unit quaternion: see docs/pack-format.md, field.glb.
fn rotation(sprite: &Sprite, is_flat: bool) -> [f32; 4] {
    let half = 0.5 * sprite.rotation_rad;
    let (sin, cos) = (libm::sinf(half), libm::cosf(half));
    let lay = std::f32::consts::FRAC_1_SQRT_2;
    if is_flat {
        [-lay * cos, lay * sin, lay * sin, lay * cos]
    } else {
        [0.0, 0.0, sin, cos]
    }
}

/// Header, a chunk of JSON, a chunk of bytes: Khronos Group, "glTF 2.0 Specification", 2021, section 4.4. Chunks are multiples of four bytes.
fn container(mut json: Vec<u8>, bytes: Vec<u8>) -> Vec<u8> {
    json.resize(json.len().next_multiple_of(4), b' ');
    let length = 12 + 8 + json.len() + 8 + bytes.len();
    let mut file = Vec::with_capacity(length);
    file.extend_from_slice(b"glTF");
    file.extend_from_slice(&2_u32.to_le_bytes());
    file.extend_from_slice(&(length as u32).to_le_bytes());
    for (kind, chunk) in [(b"JSON", json), (b"BIN\0", bytes)] {
        file.extend_from_slice(&(chunk.len() as u32).to_le_bytes());
        file.extend_from_slice(kind);
        file.extend_from_slice(&chunk);
    }
    file
}

//! The JSON of the file: the parts of glTF that a field needs, and what is in the scene's `extras`.

use std::collections::BTreeMap;
use std::fmt;
use std::marker::PhantomData;

use serde::de::{Error, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};

use crate::field::COLOUR_LEVELS;

/// The extension by which sprites and boxes are instances.
pub(super) const INSTANCING: &str = "EXT_mesh_gpu_instancing";

/// Names of the nodes.
pub(super) const SPRITES: &str = "sprites";
pub(super) const BOXES: &str = "boxes";

/// Component types of accessors.
pub(super) const UNSIGNED_BYTE: u32 = 5121;
pub(super) const SHORT: u32 = 5122;
pub(super) const UNSIGNED_SHORT: u32 = 5123;
pub(super) const FLOAT: u32 = 5126;

/// The whole document. Keys that are not named here are passed over, as glTF asks.
#[derive(Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Document {
    pub asset: Asset,
    #[serde(default, deserialize_with = "few")]
    pub extensions_used: Vec<String>,
    #[serde(default, deserialize_with = "few", skip_serializing)]
    pub extensions_required: Vec<String>,
    #[serde(default)]
    pub scene: usize,
    #[serde(deserialize_with = "few")]
    pub scenes: Vec<Scene>,
    #[serde(deserialize_with = "few")]
    pub nodes: Vec<Node>,
    #[serde(default, skip_deserializing)]
    pub materials: Vec<Material>,
    #[serde(default, skip_deserializing)]
    pub meshes: Vec<Mesh>,
    #[serde(deserialize_with = "few")]
    pub accessors: Vec<Accessor>,
    #[serde(deserialize_with = "few")]
    pub buffer_views: Vec<BufferView>,
    #[serde(default, deserialize_with = "few")]
    pub buffers: Vec<Buffer>,
}

/// Most entries of the lists of glTF itself: three bytes of JSON would make a hundred of memory otherwise.
const MOST: usize = 1024;

/// A list of at most [`MOST`] entries.
fn few<'de, D: Deserializer<'de>, T: Deserialize<'de>>(from: D) -> Result<Vec<T>, D::Error> {
    struct Few<T>(PhantomData<T>);
    impl<'de, T: Deserialize<'de>> Visitor<'de> for Few<T> {
        type Value = Vec<T>;

        fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
            write!(f, "a list of at most {MOST} entries")
        }

        fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Vec<T>, A::Error> {
            let mut entries = Vec::new();
            while let Some(entry) = list.next_element()? {
                if entries.len() == MOST {
                    return Err(A::Error::invalid_length(MOST + 1, &self));
                }
                entries.push(entry);
            }
            Ok(entries)
        }
    }
    from.deserialize_seq(Few(PhantomData))
}

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Asset {
    pub version: String,
    #[serde(default, skip_serializing)]
    pub min_version: Option<String>,
    #[serde(default)]
    pub generator: String,
}

#[derive(Serialize, Deserialize)]
pub(super) struct Scene {
    #[serde(default)]
    pub name: String,
    #[serde(default, deserialize_with = "few")]
    pub nodes: Vec<usize>,
    pub extras: Option<Extras>,
}

#[derive(Serialize, Deserialize)]
pub(super) struct Node {
    #[serde(default)]
    pub name: String,
    #[serde(default, skip_deserializing)]
    pub mesh: usize,
    pub extensions: Option<Extensions>,
}

#[derive(Serialize, Deserialize)]
pub(super) struct Extensions {
    #[serde(rename = "EXT_mesh_gpu_instancing")]
    pub instancing: Option<Instancing>,
}

#[derive(Serialize, Deserialize)]
pub(super) struct Instancing {
    /// Index of the accessor of each attribute.
    pub attributes: BTreeMap<String, usize>,
}

#[derive(Default, Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Material {
    pub name: &'static str,
    pub double_sided: bool,
    pub alpha_mode: &'static str,
    pub pbr_metallic_roughness: Surface,
}

#[derive(Default, Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Surface {
    pub base_color_factor: [f32; 4],
    pub metallic_factor: f32,
}

#[derive(Default, Serialize)]
pub(super) struct Mesh {
    pub name: &'static str,
    pub primitives: Vec<Primitive>,
}

#[derive(Default, Serialize)]
pub(super) struct Primitive {
    pub attributes: BTreeMap<&'static str, usize>,
    pub indices: usize,
    pub material: usize,
}

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Accessor {
    pub buffer_view: Option<usize>,
    #[serde(default)]
    pub byte_offset: u64,
    pub component_type: u32,
    #[serde(default)]
    pub normalized: bool,
    pub count: u64,
    #[serde(rename = "type")]
    pub kind: String,
    #[serde(default, skip_deserializing, skip_serializing_if = "Option::is_none")]
    pub min: Option<Vec<f32>>,
    #[serde(default, skip_deserializing, skip_serializing_if = "Option::is_none")]
    pub max: Option<Vec<f32>>,
    /// Only looked for, and refused.
    #[serde(default, skip_serializing)]
    pub sparse: Option<serde::de::IgnoredAny>,
}

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct BufferView {
    pub buffer: usize,
    #[serde(default)]
    pub byte_offset: u64,
    pub byte_length: u64,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub byte_stride: Option<u64>,
    #[serde(default, skip_deserializing, skip_serializing_if = "Option::is_none")]
    pub target: Option<u32>,
}

#[derive(Default, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Buffer {
    pub byte_length: u64,
    /// Only looked for, and refused.
    #[serde(default, skip_serializing)]
    pub uri: Option<serde::de::IgnoredAny>,
}

/// The scene's `extras`.
#[derive(Serialize, Deserialize)]
pub(super) struct Extras {
    pub welkin_field: FieldExtras,
}

/// What of a field is not an instance.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FieldExtras {
    pub sections: u32,
    pub hours: Vec<HourExtras>,
    /// Tables of colour levels, each once: height, red, green, blue, opacity.
    pub levels: Vec<[[f32; 5]; COLOUR_LEVELS]>,
    pub clouds: Vec<CloudExtras>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct HourExtras {
    pub time: f32,
    pub ambient: f32,
    pub colour: [f32; 3],
    pub least: f32,
    pub most: f32,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CloudExtras {
    pub kind: String,
    pub rank: f32,
    /// Index of its table of colour levels.
    pub levels: usize,
    /// Centres of its shading groups.
    pub groups: Vec<[f32; 3]>,
}

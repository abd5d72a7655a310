//! Writes the file: two meshes, then the instances, record by record.

use std::collections::BTreeMap;

use super::accessor::is_normalized;
use super::container;
use super::document::{
    Accessor, Asset, BOXES, Buffer, BufferView, CloudExtras, Document, Extensions, Extras, FLOAT,
    FieldExtras, HourExtras, INSTANCING, Instancing, Material, Mesh, Node, Primitive, SHORT,
    SPRITES, Scene, Surface, UNSIGNED_BYTE, UNSIGNED_SHORT,
};
use super::rotation::quaternion;
use crate::error::PackError;
use crate::field::{Category, Field};

/// Targets of buffer views.
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

/// Corners of the unit square, which faces +Z, and where they lie in the picture, from its upper left.
const SQUARE: [[f32; 5]; 4] = [
    [-0.5, -0.5, 0.0, 0.0, 1.0],
    [0.5, -0.5, 0.0, 1.0, 1.0],
    [0.5, 0.5, 0.0, 1.0, 0.0],
    [-0.5, 0.5, 0.0, 0.0, 0.0],
];
const SQUARE_TRIANGLES: [u16; 6] = [0, 1, 2, 0, 2, 3];

/// Triangles of the unit cube, anticlockwise from outside; bit 0 of a corner's number is x, bit 1 y, bit 2 z.
const CUBE_TRIANGLES: [u16; 36] = [
    0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5,
    7, 4, 7, 6,
];

/// Attributes of a record: name, type, component type, where it begins.
type Layout = &'static [(&'static str, &'static str, u32, u64)];

const SPRITE_BYTES: u64 = 48;
const SPRITE_LAYOUT: Layout = &[
    ("TRANSLATION", "VEC3", FLOAT, 0),
    ("SCALE", "VEC3", FLOAT, 12),
    ("ROTATION", "VEC4", SHORT, 24),
    ("_CELL", "SCALAR", UNSIGNED_SHORT, 32),
    ("_GROUP", "SCALAR", UNSIGNED_SHORT, 34),
    ("_CLOUD", "SCALAR", UNSIGNED_SHORT, 36),
    ("_BOX", "SCALAR", UNSIGNED_SHORT, 38),
    ("_SUN", "VEC4", UNSIGNED_BYTE, 40),
    ("_SKY", "VEC4", UNSIGNED_BYTE, 44),
];

/// The last two bytes of a box are empty: records begin at multiples of four.
const BOX_BYTES: u64 = 36;
const BOX_LAYOUT: Layout = &[
    ("TRANSLATION", "VEC3", FLOAT, 0),
    ("SCALE", "VEC3", FLOAT, 12),
    ("_CULL", "SCALAR", FLOAT, 24),
    ("_CATEGORY", "SCALAR", UNSIGNED_SHORT, 28),
    ("_GROUP", "SCALAR", UNSIGNED_SHORT, 30),
    ("_CLOUD", "SCALAR", UNSIGNED_SHORT, 32),
];

/// Encodes a field. `generator` is the program that does.
///
/// # Errors
/// [`PackError::Value`] if the JSON cannot be written: a number in it is not finite.
pub(crate) fn encode(file: &str, field: &Field, generator: &str) -> Result<Vec<u8>, PackError> {
    let mut parts = Parts::default();
    let square = parts.square();
    let cube = parts.cube();
    let sprites = parts.instances(SPRITE_LAYOUT, SPRITE_BYTES, &sprite_records(field));
    let boxes = parts.instances(BOX_LAYOUT, BOX_BYTES, &box_records(field));
    let document = Document {
        asset: Asset {
            version: "2.0".to_string(),
            min_version: None,
            generator: generator.to_string(),
        },
        extensions_used: vec![INSTANCING.to_string()],
        extensions_required: Vec::new(),
        scene: 0,
        scenes: vec![Scene {
            name: "field".to_string(),
            nodes: vec![0, 1],
            extras: Some(Extras {
                welkin_field: extras(field),
            }),
        }],
        nodes: vec![node(SPRITES, 0, sprites), node(BOXES, 1, boxes)],
        materials: vec![material(SPRITES, 0.25), material(BOXES, 0.1)],
        meshes: vec![mesh(SPRITES, square, 0), mesh(BOXES, cube, 1)],
        accessors: parts.accessors,
        buffer_views: parts.views,
        buffers: vec![Buffer {
            byte_length: parts.bin.len() as u64,
            uri: None,
        }],
    };
    let json = serde_json::to_vec(&document)
        .map_err(|e| PackError::value(file, "JSON", e, "finite numbers"))?;
    Ok(container::join(json, parts.bin))
}

/// The buffer and what tells its parts.
#[derive(Default)]
struct Parts {
    bin: Vec<u8>,
    views: Vec<BufferView>,
    accessors: Vec<Accessor>,
}

impl Parts {
    fn view(&mut self, bytes: &[u8], stride: Option<u64>, target: Option<u32>) {
        self.bin.resize(self.bin.len().next_multiple_of(4), 0);
        self.views.push(BufferView {
            buffer: 0,
            byte_offset: self.bin.len() as u64,
            byte_length: bytes.len() as u64,
            byte_stride: stride,
            target,
        });
        self.bin.extend(bytes);
    }

    /// An accessor into the last view; gives its index.
    fn accessor(&mut self, kind: &str, component_type: u32, byte_offset: u64, count: u64) -> usize {
        self.accessors.push(Accessor {
            buffer_view: Some(self.views.len() - 1),
            byte_offset,
            component_type,
            normalized: is_normalized(component_type),
            count,
            kind: kind.to_string(),
            min: None,
            max: None,
            sparse: None,
        });
        self.accessors.len() - 1
    }

    /// Corners, whose bounds glTF wants to know.
    fn positions(&mut self, count: u64, half_depth: f32) -> usize {
        let index = self.accessor("VEC3", FLOAT, 0, count);
        let half = [0.5, 0.5, half_depth];
        self.accessors[index].min = Some(half.map(|h| 0.0 - h).to_vec());
        self.accessors[index].max = Some(half.to_vec());
        index
    }

    fn square(&mut self) -> Primitive {
        let corners: Vec<u8> = SQUARE
            .iter()
            .flatten()
            .flat_map(|v| v.to_le_bytes())
            .collect();
        self.view(&corners, Some(20), Some(ARRAY_BUFFER));
        let attributes = BTreeMap::from([
            ("POSITION", self.positions(4, 0.0)),
            ("TEXCOORD_0", self.accessor("VEC2", FLOAT, 12, 4)),
        ]);
        self.primitive(attributes, &SQUARE_TRIANGLES)
    }

    fn cube(&mut self) -> Primitive {
        let corner = |n: u16| [0, 1, 2].map(|bit| if n >> bit & 1 == 1 { 0.5_f32 } else { -0.5 });
        let corners = (0..8).flat_map(corner);
        let corners: Vec<u8> = corners.flat_map(f32::to_le_bytes).collect();
        self.view(&corners, Some(12), Some(ARRAY_BUFFER));
        let attributes = BTreeMap::from([("POSITION", self.positions(8, 0.5))]);
        self.primitive(attributes, &CUBE_TRIANGLES)
    }

    fn primitive(
        &mut self,
        attributes: BTreeMap<&'static str, usize>,
        triangles: &[u16],
    ) -> Primitive {
        let bytes: Vec<u8> = triangles.iter().flat_map(|n| n.to_le_bytes()).collect();
        self.view(&bytes, None, Some(ELEMENT_ARRAY_BUFFER));
        Primitive {
            attributes,
            indices: self.accessor("SCALAR", UNSIGNED_SHORT, 0, triangles.len() as u64),
            material: 0,
        }
    }

    fn instances(&mut self, layout: Layout, size: u64, records: &[u8]) -> Instancing {
        self.view(records, Some(size), None);
        let count = records.len() as u64 / size;
        let attributes = layout.iter().map(|&(name, kind, component, offset)| {
            (
                name.to_string(),
                self.accessor(kind, component, offset, count),
            )
        });
        Instancing {
            attributes: attributes.collect(),
        }
    }
}

fn node(name: &str, mesh: usize, instancing: Instancing) -> Node {
    Node {
        name: name.to_string(),
        mesh,
        extensions: Some(Extensions {
            instancing: Some(instancing),
        }),
    }
}

fn mesh(name: &'static str, mut primitive: Primitive, material: usize) -> Mesh {
    primitive.material = material;
    Mesh {
        name,
        primitives: vec![primitive],
    }
}

/// White and translucent, so that a viewer of glTF shows something like a cloud.
fn material(name: &'static str, opacity: f32) -> Material {
    Material {
        name,
        double_sided: true,
        alpha_mode: "BLEND",
        pbr_metallic_roughness: Surface {
            base_color_factor: [1.0, 1.0, 1.0, opacity],
            metallic_factor: 0.0,
        },
    }
}

fn extras(field: &Field) -> FieldExtras {
    let mut levels: Vec<[[f32; 5]; crate::field::COLOUR_LEVELS]> = Vec::new();
    let mut clouds = Vec::with_capacity(field.clouds.len());
    for cloud in &field.clouds {
        let table = cloud.levels.map(|level| {
            let [red, green, blue, alpha] = level.rgba;
            [level.height, red, green, blue, alpha]
        });
        let index = levels.iter().position(|known| *known == table);
        let index = index.unwrap_or(levels.len());
        if index == levels.len() {
            levels.push(table);
        }
        clouds.push(CloudExtras {
            kind: cloud.kind.name().to_string(),
            rank: cloud.rank,
            levels: index,
            groups: cloud.groups_m.clone(),
        });
    }
    let hours = field.hours.iter().map(|hour| HourExtras {
        time: hour.time,
        ambient: hour.ambient,
        colour: hour.colour,
        least: hour.least,
        most: hour.most,
    });
    FieldExtras {
        sections: field.sections,
        hours: hours.collect(),
        levels,
        clouds,
    }
}

fn sprite_records(field: &Field) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(SPRITE_BYTES as usize * field.sprite_count());
    for (index, cloud) in field.clouds.iter().enumerate() {
        for sprite in &cloud.sprites {
            let [width, height] = sprite.size_m;
            let [x, y, z, w] = quaternion(sprite.rotation_rad, cloud.kind.is_flat());
            let of_box = cloud.boxes.get(usize::from(sprite.cloud_box));
            floats(&mut bytes, &sprite.centre_m);
            floats(&mut bytes, &[width, height, 1.0]);
            [x, y, z, w]
                .iter()
                .for_each(|q| bytes.extend(q.to_le_bytes()));
            let numbers = [
                u16::from(sprite.cell),
                of_box.map_or(0, |of_box| of_box.group),
                index as u16,
                sprite.cloud_box,
            ];
            numbers.iter().for_each(|n| bytes.extend(n.to_le_bytes()));
            let own = sprite.exposure;
            bytes.extend(own.sides);
            bytes.extend([own.above, own.sky, own.halvings, 0]);
        }
    }
    bytes
}

fn box_records(field: &Field) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(BOX_BYTES as usize * field.box_count());
    for (index, cloud) in field.clouds.iter().enumerate() {
        for of_cloud in &cloud.boxes {
            floats(&mut bytes, &of_cloud.centre_m);
            floats(&mut bytes, &of_cloud.size_m);
            floats(&mut bytes, &[of_cloud.cull_m]);
            let category = Category::ALL.iter().position(|c| *c == of_cloud.category);
            let category = category.unwrap_or(0) as u16;
            let numbers = [category, of_cloud.group, index as u16, 0];
            numbers.iter().for_each(|n| bytes.extend(n.to_le_bytes()));
        }
    }
    bytes
}

fn floats(bytes: &mut Vec<u8>, values: &[f32]) {
    values.iter().for_each(|v| bytes.extend(v.to_le_bytes()));
}

//! Attributes of instances: accessors resolved to numbers, every offset looked at before it is used.

use super::document::{
    Accessor, Document, FLOAT, INSTANCING, SHORT, SPRITES, UNSIGNED_BYTE, UNSIGNED_SHORT,
};
use crate::error::PackError;
use crate::limits::{MAX_BOXES, MAX_SPRITES};

/// The instances of one node.
pub(super) struct Instances<'a> {
    file: &'a str,
    node: &'static str,
    document: &'a Document,
    bin: &'a [u8],
    attributes: &'a std::collections::BTreeMap<String, usize>,
    /// How many there are.
    pub count: usize,
}

impl<'a> Instances<'a> {
    /// The instances of the node of this name. Their count is within the limit.
    pub fn of(
        file: &'a str,
        node: &'static str,
        document: &'a Document,
        bin: &'a [u8],
    ) -> Result<Instances<'a>, PackError> {
        let scene = document.scenes.get(document.scene);
        let in_scene = scene.iter().flat_map(|scene| &scene.nodes);
        let mut named = in_scene
            .filter_map(|index| document.nodes.get(*index))
            .filter(|n| n.name == node);
        let found = named.next();
        if named.next().is_some() {
            let expected = format!("one node `{node}` in the scene");
            return Err(PackError::value(file, "nodes", "two", expected));
        }
        let instancing = found.and_then(|n| n.extensions.as_ref()?.instancing.as_ref());
        let Some(instancing) = instancing else {
            let expected = format!("a node `{node}` with {INSTANCING} in the scene");
            return Err(PackError::value(file, "nodes", "without one", expected));
        };
        let mut instances = Instances {
            file,
            node,
            document,
            bin,
            attributes: &instancing.attributes,
            count: 0,
        };
        let count = instances.accessor("TRANSLATION")?.count;
        let most = if node == SPRITES {
            MAX_SPRITES
        } else {
            MAX_BOXES
        };
        if count > most as u64 {
            return Err(PackError::TooLarge {
                file: file.to_string(),
                key: format!("count of {node}"),
                found: count,
                limit: most as u64,
            });
        }
        instances.count = count as usize;
        Ok(instances)
    }

    /// Three floats an instance.
    pub fn vectors(&self, name: &str) -> Result<Vec<[f32; 3]>, PackError> {
        self.read(name, "VEC3", FLOAT, |bytes: &[u8; 12]| {
            [0, 4, 8].map(|i| float([bytes[i], bytes[i + 1], bytes[i + 2], bytes[i + 3]]))
        })
    }

    /// Four signed 16-bit steps of a unit an instance.
    pub fn quaternions(&self, name: &str) -> Result<Vec<[i16; 4]>, PackError> {
        self.read(name, "VEC4", SHORT, |bytes: &[u8; 8]| {
            [0, 2, 4, 6].map(|i| i16::from_le_bytes([bytes[i], bytes[i + 1]]))
        })
    }

    /// One float an instance.
    pub fn floats(&self, name: &str) -> Result<Vec<f32>, PackError> {
        self.read(name, "SCALAR", FLOAT, |bytes: &[u8; 4]| float(*bytes))
    }

    /// One unsigned 16-bit number an instance.
    pub fn numbers(&self, name: &str) -> Result<Vec<u16>, PackError> {
        self.read(name, "SCALAR", UNSIGNED_SHORT, |bytes: &[u8; 2]| {
            u16::from_le_bytes(*bytes)
        })
    }

    /// Four bytes an instance, in 255ths of a unit.
    pub fn bytes(&self, name: &str) -> Result<Vec<[u8; 4]>, PackError> {
        self.read(name, "VEC4", UNSIGNED_BYTE, |bytes: &[u8; 4]| *bytes)
    }

    fn accessor(&self, name: &str) -> Result<&'a Accessor, PackError> {
        let index = self.attributes.get(name);
        let accessor = index.and_then(|i| self.document.accessors.get(*i));
        accessor.ok_or_else(|| {
            let found = index.map_or("missing".to_string(), |i| format!("accessor {i}"));
            self.error(name, found, "an accessor of the file")
        })
    }

    /// Reads `count` elements of `SIZE` bytes.
    fn read<T, const SIZE: usize>(
        &self,
        name: &str,
        kind: &str,
        component: u32,
        parse: impl Fn(&[u8; SIZE]) -> T,
    ) -> Result<Vec<T>, PackError> {
        let accessor = self.accessor(name)?;
        let normalized = is_normalized(component);
        let laid_out = (accessor.kind.as_str(), accessor.component_type) == (kind, component);
        if !laid_out || accessor.normalized != normalized || accessor.sparse.is_some() {
            let found = format!("{} of {}", accessor.kind, accessor.component_type);
            let expected = format!("{kind} of {component}, as docs/pack-format.md says");
            return Err(self.error(name, found, expected));
        }
        if accessor.count != self.count as u64 {
            return Err(self.error(name, accessor.count, self.count));
        }
        let (view, stride) = self.view(name, accessor, SIZE as u64)?;
        let element = |i: usize| view.get(i * stride..)?.first_chunk();
        let elements = (0..self.count).map(|i| element(i).map(&parse));
        let elements: Option<Vec<T>> = elements.collect();
        elements.ok_or_else(|| {
            let found = format!("{} elements at every {stride} bytes", self.count);
            self.error(name, found, format!("as many as {} bytes hold", view.len()))
        })
    }

    /// The bytes from the accessor's first element to the end of its buffer view, and the distance of elements. There is
    /// a byte at least for each element.
    fn view(
        &self,
        name: &str,
        accessor: &Accessor,
        size: u64,
    ) -> Result<(&'a [u8], usize), PackError> {
        let view = accessor.buffer_view;
        let view = view.and_then(|i| self.document.buffer_views.get(i));
        let Some(view) = view.filter(|view| view.buffer == 0) else {
            let found = "without a buffer view of the file";
            return Err(self.error(name, found, "one of buffer 0"));
        };
        let bytes = slice(self.bin, view.byte_offset, Some(view.byte_length));
        let bytes = bytes.and_then(|bytes| slice(bytes, accessor.byte_offset, None));
        let stride = view.byte_stride.unwrap_or(size);
        // What begins an attribute is at a multiple of four in any file of glTF; of its component is what matters here.
        let unit = match accessor.component_type {
            FLOAT => 4,
            UNSIGNED_BYTE => 1,
            _ => 2,
        };
        match bytes {
            // So that elements do not overlap, and a few bytes cannot claim to be many sprites.
            Some(bytes) if (size..=256).contains(&stride) && stride.is_multiple_of(unit) => {
                if (view.byte_offset + accessor.byte_offset).is_multiple_of(unit) {
                    return Ok((bytes, stride as usize));
                }
                let found = format!("at {}", view.byte_offset + accessor.byte_offset);
                Err(self.error(name, found, format!("at a multiple of {unit}")))
            }
            Some(_) => Err(self.error(
                name,
                format!("byteStride {stride}"),
                format!("a multiple of {unit} from {size} to 256"),
            )),
            None => Err(self.error(
                name,
                format!("{} bytes at {}", view.byte_length, view.byte_offset),
                format!("within {} bytes", self.bin.len()),
            )),
        }
    }

    fn error(&self, name: &str, found: impl ToString, expected: impl ToString) -> PackError {
        PackError::value(self.file, &format!("{}.{name}", self.node), found, expected)
    }
}

/// Whether its numbers are steps of a unit.
pub(super) fn is_normalized(component: u32) -> bool {
    matches!(component, SHORT | UNSIGNED_BYTE)
}

/// `length` bytes from `start`, or all that follow.
fn slice(bytes: &[u8], start: u64, length: Option<u64>) -> Option<&[u8]> {
    let rest = bytes.get(usize::try_from(start).ok()?..)?;
    match length {
        Some(length) => rest.get(..usize::try_from(length).ok()?),
        None => Some(rest),
    }
}

fn float(bytes: [u8; 4]) -> f32 {
    f32::from_le_bytes(bytes)
}

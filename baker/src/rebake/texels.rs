//! Textures, value by value.

use welkin_pack::check::{Examined, Finding, Outcome};
use welkin_pack::{Format, Pack, Role, Shape, Texture};

use super::finding::{counted, finding, skipped};

/// A finding a channel of every role that either has.
pub(super) fn compare(examined: &Examined, fresh: &Pack) -> Vec<Finding> {
    let roles = Role::ALL.into_iter();
    roles
        .flat_map(|role| {
            let found = examined.textures.iter().find(|(r, _)| *r == role);
            match (found, fresh.texture(role)) {
                (Some((_, found)), Some(expected)) => compare_role(role, found, expected),
                (None, Some(_)) => vec![skipped(role.name(), "the texture could not be read")],
                (Some(_), None) => {
                    let note = "in the pack, but the recipe makes none".to_string();
                    vec![finding(role.name(), Outcome::Failed, None, note)]
                }
                (None, None) => Vec::new(),
            }
        })
        .collect()
}

fn compare_role(role: Role, found: &Texture, expected: &Texture) -> Vec<Finding> {
    let [was, is] = [found, expected].map(layout);
    if was != is {
        let note = format!("{was} in the pack, {is} baked anew");
        return vec![finding(role.name(), Outcome::Failed, None, note)];
    }
    let channels = role.spec().channels.iter().enumerate();
    channels
        .map(|(channel, spec)| {
            let subject = format!("{}.{}", role.name(), spec.name);
            let (differences, first) = differences(found, expected, channel);
            let first = first.map(|first| first.to_string(role, found, expected));
            counted(&subject, differences, first)
        })
        .collect()
}

fn layout(texture: &Texture) -> String {
    let Texture {
        format,
        shape,
        width,
        height,
        layers,
        levels,
    } = texture;
    let (format, shape, levels) = (format.name(), shape.name(), levels.len());
    format!("{shape} {format} {width}x{height}, {layers} layers, {levels} levels")
}

/// Where a value is in a texture.
struct Place {
    level: usize,
    /// Byte of its first byte in the level.
    byte: usize,
}

/// How many values of a channel differ, and the first: level by level, layer by layer, row by row.
fn differences(found: &Texture, expected: &Texture, channel: usize) -> (usize, Option<Place>) {
    let (texel, value) = (
        found.format.bytes_per_texel(),
        found.format.bytes_per_channel(),
    );
    let start = channel * value;
    let (mut count, mut first) = (0, None);
    let levels = found.levels.iter().zip(&expected.levels).enumerate();
    for (level, (a, b)) in levels.filter(|(_, (a, b))| a != b) {
        let texels = a.chunks_exact(texel).zip(b.chunks_exact(texel)).enumerate();
        let differ =
            texels.filter(|(_, (a, b))| a[start..start + value] != b[start..start + value]);
        for (index, _) in differ {
            count += 1;
            first.get_or_insert(Place {
                level,
                byte: index * texel + start,
            });
        }
    }
    (count, first)
}

impl Place {
    fn to_string(&self, role: Role, found: &Texture, expected: &Texture) -> String {
        let (width, height) = found.level_size(self.level);
        let index = self.byte / found.format.bytes_per_texel();
        let [width, height] = [width, height].map(|side| side as usize);
        let (x, y) = (index % width, index / width % height);
        let layer = index / (width * height);
        let layer = match role.layer_name(layer as u32) {
            // Its name is a number, from 1.
            Some(_) if found.shape == Shape::Array && role != Role::Layers => {
                format!(", layer {layer}")
            }
            Some(name) => format!(", layer {layer} ({name})"),
            None => String::new(),
        };
        let [was, is] =
            [found, expected].map(|t| stored(t.format, &t.levels[self.level][self.byte..]));
        format!(
            "first at level {}{layer}, ({x}, {y}): {was} in the pack, {is} baked anew",
            self.level
        )
    }
}

/// The value that begins with these bytes, as it is stored.
fn stored(format: Format, bytes: &[u8]) -> String {
    match (format, bytes) {
        (Format::Rgba16Float, &[low, high, ..]) => {
            let value = welkin_pack::texture::decode(format, &[low, high]);
            let bits = u16::from_le_bytes([low, high]);
            format!("{} (0x{bits:04x})", value[0])
        }
        (_, bytes) => format!("{}/255", bytes[0]),
    }
}

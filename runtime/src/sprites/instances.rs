//! The sprites of a field as the device reads them, block by block.
//!
//! # Theory
//! Wang: clouds are kept in blocks of 16 square kilometres. Ambient light is interpolated between the five colour levels of a cloud; here
//! it is looked up once, at the lower and the upper edge of each sprite, and the device goes on from there.
//!
//! # Practice
//! [`Instance`] is 64 bytes, four texels of a texture that the vertex stage reads. The blocks of one field are made once and repeat
//! for ever.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use welkin_pack::field::{
    COLOUR_LEVELS, Cloud, CloudKind, ColourLevel, Exposure, SECTION_SIDE_M, Sprite,
};
use welkin_pack::{Field, SheetCell};

/// A sprite on the device: see `SpriteInstance` of sprites.wgsl for what each member holds.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct Instance {
    /// xyz: place in its block, in metres; w: turn in radians.
    pub centre: [f32; 4],
    /// Half width and half height over [`MOST_HALF_SIZE_M`], shares of the cloud's height at the lower and the upper edge, in 65535ths.
    pub size: [u16; 4],
    /// xyz: from the middle of its shading group over [`MOST_AWAY_M`], w: 1 if it lies flat, in 32767ths.
    pub from_group: [i16; 4],
    /// xyz: from the middle of its cloud, w: the cloud's radius, over [`MOST_AWAY_M`], in 32767ths.
    pub from_cloud: [i16; 4],
    /// Colour level at the lower edge and opacity, in 255ths.
    pub low: [u8; 4],
    /// The same at the upper edge.
    pub high: [u8; 4],
    /// Cell of the sheet; the cloud's number, low byte first; 1 for the billboard of a whole cloud.
    pub names: [u8; 4],
    /// xyz: the way it faces for ever, w: 1 if it does, in 127ths.
    pub lock: [i8; 4],
    /// Nothing.
    pub padding: [u8; 8],
}

/// The largest half side of a sprite, in metres: what a device reads as 1. Steps are an eighth of a metre.
pub const MOST_HALF_SIZE_M: f32 = 8192.0;

/// The farthest that a sprite is from the middle of its group or cloud, and a cloud's largest radius, in metres. Steps are half a metre.
pub const MOST_AWAY_M: f32 = 16_384.0;

/// Sprites in a row of the texture, four texels each.
pub const INSTANCES_PER_ROW: u32 = 256;

impl Instance {
    /// Its middle in its block, in metres.
    pub fn centre_m(&self) -> Vec3 {
        let [x, y, z, _] = self.centre;
        Vec3::new(x, y, z)
    }

    /// Half width and half height, in metres.
    pub fn half_size_m(&self) -> [f32; 2] {
        let [width, height, ..] = self.size.map(|v| f32::from(v) / 65535.0);
        [width * MOST_HALF_SIZE_M, height * MOST_HALF_SIZE_M]
    }

    /// Shares of the cloud's height at its lower and upper edge.
    pub fn heights(&self) -> [f32; 2] {
        let [.., low, high] = self.size.map(|v| f32::from(v) / 65535.0);
        [low, high]
    }

    /// From the middle of its shading group, in metres.
    pub fn from_group_m(&self) -> Vec3 {
        away_m(self.from_group)
    }

    /// From the middle of its cloud, in metres.
    pub fn from_cloud_m(&self) -> Vec3 {
        away_m(self.from_cloud)
    }

    /// Radius of its cloud, in metres.
    pub fn cloud_radius_m(&self) -> f32 {
        f32::from(self.from_cloud[3]) / 32767.0 * MOST_AWAY_M
    }

    /// Half of its longer side, in metres.
    pub fn radius_m(&self) -> f32 {
        let [width, height] = self.half_size_m();
        width.max(height)
    }

    /// Whether it lies flat.
    pub fn lies_flat(&self) -> bool {
        self.from_group[3] > 0
    }

    /// Whether it stands for a whole cloud.
    pub fn is_billboard(&self) -> bool {
        self.names[3] == 1
    }

    /// The number of its cloud in the field.
    pub fn cloud(&self) -> usize {
        usize::from(u16::from_le_bytes([self.names[1], self.names[2]]))
    }
}

/// The sprites of one section of a field.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Section {
    /// In the order of their clouds, the billboard of a cloud before its sprites.
    pub instances: Vec<Instance>,
    /// Lowest and highest place of a sprite's edge, in metres; empty where there is none.
    pub heights_m: Option<[f32; 2]>,
    /// How far a sprite reaches over the sides of the block, in metres.
    pub overhang_m: f32,
}

/// Every section of a field: row by row from the north, in a row from the west.
pub fn sections(field: &Field) -> Vec<Section> {
    let count = field.sections.max(1) as usize;
    let mut sections = vec![Section::default(); count * count];
    for (number, cloud) in field.clouds.iter().enumerate() {
        let number = u16::try_from(number).unwrap_or(u16::MAX).to_le_bytes();
        sections_add(&mut sections, count, billboard(cloud, number));
        for sprite in &cloud.sprites {
            sections_add(&mut sections, count, of_sprite(cloud, sprite, number));
        }
    }
    sections
}

/// Puts an instance, whose place is still that in the field, where it belongs.
fn sections_add(sections: &mut [Section], count: usize, mut instance: Instance) {
    let block = |at: f32| (at / SECTION_SIDE_M).floor();
    let [x, y, z, _] = instance.centre;
    let (column, row) = (block(x), block(z));
    instance.centre[0] = x - column * SECTION_SIDE_M;
    instance.centre[2] = z - row * SECTION_SIDE_M;
    let wrapped = |i: f32| (i as i64).rem_euclid(count as i64) as usize;
    let section = &mut sections[wrapped(row) * count + wrapped(column)];
    // The longest half diagonal, however it is turned.
    let reach = instance.radius_m() * std::f32::consts::SQRT_2;
    let [low, high] = section.heights_m.unwrap_or([f32::MAX, f32::MIN]);
    section.heights_m = Some([low.min(y - reach), high.max(y + reach)]);
    section.overhang_m = section.overhang_m.max(reach);
    section.instances.push(instance);
}

fn of_sprite(cloud: &Cloud, sprite: &Sprite, number: [u8; 2]) -> Instance {
    let centre = Vec3::from(sprite.centre_m);
    let group = cloud
        .boxes
        .get(usize::from(sprite.cloud_box))
        .and_then(|own| cloud.groups_m.get(usize::from(own.group)))
        .map_or(Vec3::from(cloud.centre_m), |&group| Vec3::from(group));
    let [width, height] = sprite.size_m;
    let up = 0.5
        * if cloud.kind.is_flat() {
            width.max(height)
        } else {
            height
        };
    let shares = [-up, up].map(|offset| share_of_height(cloud, centre.y + offset));
    let tint = Vec3::from(SheetCell(sprite.cell).kind().tint());
    let [low, high] = shares.map(|share| colour(&cloud.levels, share, tint));
    Instance {
        centre: centre.extend(sprite.rotation_rad).to_array(),
        size: [
            0.5 * width / MOST_HALF_SIZE_M,
            0.5 * height / MOST_HALF_SIZE_M,
            shares[0],
            shares[1],
        ]
        .map(|v| (v * 65535.0).round().clamp(0.0, 65535.0) as u16),
        from_group: away(
            centre - group,
            MOST_AWAY_M * f32::from(u8::from(cloud.kind.is_flat())),
        ),
        from_cloud: away(
            centre - Vec3::from(cloud.centre_m),
            cloud.radius_m().max(1.0),
        ),
        low,
        high,
        names: [sprite.cell, number[0], number[1], 0],
        lock: [0; 4],
        padding: [0; 8],
    }
}

/// The degenerate case: a cloud of one sprite, as large as its box.
fn billboard(cloud: &Cloud, number: [u8; 2]) -> Instance {
    let [x, y, z] = cloud.size_m;
    let (cell, width, height) = match cloud.kind {
        CloudKind::Stratus | CloudKind::Stratocumulus => (SheetCell::FOGGY[0], x.max(z), y),
        CloudKind::Altocumulus => (SheetCell::WISPY[0], x.max(z), y),
        CloudKind::Cirrus => (SheetCell::WISPY[1], x, z),
        CloudKind::Cumulus | CloudKind::Congestus | CloudKind::Cumulonimbus => {
            (SheetCell::FLAT_BOTTOMED[0], x.max(z), y)
        }
    };
    let sprite = Sprite {
        centre_m: cloud.centre_m,
        // The pictures of the sheet keep clear of the sides of their cells.
        size_m: [BILLBOARD_SCALE * width, BILLBOARD_SCALE * height],
        rotation_rad: 0.0,
        cell,
        cloud_box: u16::MAX,
        exposure: Exposure::default(),
    };
    let mut instance = of_sprite(cloud, &sprite, number);
    instance.names[3] = 1;
    instance
}

/// How much larger a cloud's billboard is than the cloud.
const BILLBOARD_SCALE: f32 = 1.25;

/// How high in its cloud a height is: 0 at the base, 1 at the top.
fn share_of_height(cloud: &Cloud, height_m: f32) -> f32 {
    let base = cloud.centre_m[1] - 0.5 * cloud.size_m[1];
    ((height_m - base) / cloud.size_m[1].max(1.0)).clamp(0.0, 1.0)
}

/// The colour of the levels at a share of the cloud's height, in 255ths.
fn colour(levels: &[ColourLevel; COLOUR_LEVELS], share: f32, tint: Vec3) -> [u8; 4] {
    let above = levels.iter().position(|level| level.height >= share);
    let above = above.unwrap_or(COLOUR_LEVELS - 1);
    let (from, to) = (&levels[above.saturating_sub(1)], &levels[above]);
    let span = to.height - from.height;
    let part = if span > 0.0 {
        ((share - from.height) / span).clamp(0.0, 1.0)
    } else {
        1.0
    };
    let tints = [tint.x, tint.y, tint.z, 1.0];
    std::array::from_fn(|c| {
        let value = from.rgba[c] + (to.rgba[c] - from.rgba[c]) * part;
        (value * tints[c] * 255.0).round().clamp(0.0, 255.0) as u8
    })
}

/// Three lengths and a fourth as the device reads them.
fn away(v: Vec3, w: f32) -> [i16; 4] {
    let step = |v: f32| (v / MOST_AWAY_M * 32767.0).round().clamp(-32767.0, 32767.0) as i16;
    v.extend(w).to_array().map(step)
}

fn away_m([x, y, z, _]: [i16; 4]) -> Vec3 {
    Vec3::from([x, y, z].map(f32::from)) / 32767.0 * MOST_AWAY_M
}

#[cfg(test)]
mod tests {
    use welkin_pack::field::{Category, CloudBox};

    use super::*;

    fn levels() -> [ColourLevel; COLOUR_LEVELS] {
        std::array::from_fn(|i| ColourLevel {
            height: i as f32 / 4.0,
            rgba: [i as f32 / 4.0, 0.5, 0.25, 1.0],
        })
    }

    fn cloud(centre_m: [f32; 3], sprites: Vec<Sprite>) -> Cloud {
        Cloud {
            kind: CloudKind::Cumulus,
            rank: 0.0,
            centre_m,
            size_m: [800.0, 400.0, 800.0],
            levels: levels(),
            groups_m: vec![centre_m],
            boxes: vec![CloudBox {
                centre_m,
                size_m: [800.0, 400.0, 800.0],
                category: Category::Cumulus,
                group: 0,
                cull_m: 50.0,
            }],
            sprites,
        }
    }

    fn sprite(centre_m: [f32; 3]) -> Sprite {
        Sprite {
            centre_m,
            size_m: [200.0, 100.0],
            rotation_rad: 0.5,
            cell: 12,
            cloud_box: 0,
            exposure: Exposure::default(),
        }
    }

    #[test]
    fn every_sprite_is_in_the_block_of_its_middle_and_wraps() {
        let places = [
            [100.0, 1200.0, 100.0],
            [7900.0, 1100.0, 4100.0],
            [-10.0, 1000.0, 8005.0],
        ];
        let clouds = places.map(|place| cloud(place, vec![sprite(place)]));
        let field = Field {
            sections: 2,
            hours: Vec::new(),
            clouds: clouds.to_vec(),
        };
        let sections = sections(&field);
        let counts: Vec<_> = sections.iter().map(|s| s.instances.len()).collect();
        // A sprite and a billboard of each cloud; the last one lies beyond the west and the south side.
        assert_eq!(counts, [2, 2, 0, 2]);
        let wrapped = sections[1].instances[1];
        assert_eq!(wrapped.centre_m(), Vec3::new(3990.0, 1000.0, 5.0));
        assert_eq!((wrapped.cloud(), wrapped.is_billboard()), (2, false));
        assert_eq!(sections[2].heights_m, None);
    }

    #[test]
    fn colour_levels_are_met_at_their_heights_and_mixed_between_them() {
        for (share, red) in [(0.0, 0), (0.25, 64), (0.5, 128), (1.0, 255), (0.125, 32)] {
            let found = colour(&levels(), share, Vec3::ONE);
            assert_eq!(found, [red, 128, 64, 255], "{share}");
        }
        assert_eq!(colour(&levels(), 1.0, Vec3::new(0.5, 1.0, 1.0))[0], 128);
    }

    #[test]
    fn edges_of_a_sprite_know_how_high_they_are_in_the_cloud() {
        let centre = [1000.0, 1000.0, 1000.0];
        let own = cloud(centre, Vec::new());
        let instance = of_sprite(&own, &sprite([1100.0, 1100.0, 1000.0]), [0, 0]);
        let [low, high] = instance.heights();
        // The box is 400 high: 250/400 and 350/400.
        assert!((low - 0.625).abs() < 1e-3 && (high - 0.875).abs() < 1e-3);
        let off = instance.from_group_m() - Vec3::new(100.0, 100.0, 0.0);
        assert!(off.abs().max_element() < 0.3 && !instance.lies_flat());
        assert!((instance.radius_m() - 100.0).abs() < 0.1);
        assert_eq!(size_of::<Instance>(), 64);
    }
}

//! Sprites of a model that are placed one by one: nodes with the property `cell`.
//!
//! N. Wang, "Let There Be Clouds!", Game Developer, 2004, "Cloud Modeling": a tool fills boxes with sprites, and the artist edits them.

use gltf::Node;
use welkin_pack::field::Category;
use welkin_pack::{SheetCell, SheetKind};

use super::extras;
use super::node::{Matrix, corners, transformed};
use crate::error::{BakeError, model_error};
use crate::field::boxes::{PLACES_M, SPRITE_SIZES_M, SPRITES, default_box};
use crate::settings::{BoxSettings, PlacedSprite};

/// How much larger a box is than the sprites' middles in it, in metres: more than the grid rounds by.
const ROOM_M: f32 = 1.0;

/// The sprite of a node and the number of its shading group; nothing if the node is a box. `matrix` is that of the node and of those
/// above it.
///
/// A mesh with no height is a square that lies, as modelling programs make a plane: its third axis, backwards, is the sprite's height.
pub(super) fn read(
    file: &str,
    node: &Node,
    matrix: &Matrix,
) -> Result<Option<(u32, PlacedSprite)>, BakeError> {
    let name = match node.name() {
        Some(name) => format!("node \"{name}\""),
        None => format!("node {}", node.index()),
    };
    let unfit = |key: &str, found: String, expected: String| {
        model_error(file, &format!("{name}: {key}"), found, &expected)
    };
    let Some((cell, group)) = extras::sprite(node.extras().as_deref(), &unfit)? else {
        return Ok(None);
    };
    // Of the corners the first is the lowest, and each of the next along one axis from it.
    let own = corners(node).map(|c| [0, 1, 2, 4, 7].map(|i| transformed(matrix, c[i])));
    let Some([low, right, up, back, high]) =
        own.filter(|c| c.as_flattened().iter().all(|v| v.is_finite()))
    else {
        let expected = "a least and a largest position, finite".to_string();
        return Err(unfit("bounds", "without them".to_string(), expected));
    };
    let [across, upwards, backwards] = [right, up, back].map(|c| away(low, c));
    let [width, height, depth] = [across, upwards, backwards].map(length);
    let placed = PlacedSprite {
        centre_m: [0, 1, 2].map(|i| 0.5 * (low[i] + high[i])),
        size_m: [width, if height > 0.0 { height } else { depth }],
        // Of a facing one in the plane of x and y, of a flat one in that of x and z.
        rotation_rad: libm::atan2f(across[1] - across[2], across[0]),
        cell,
    };
    for (key, values, [least, most]) in [
        ("middle", &placed.centre_m[..], PLACES_M),
        ("size", &placed.size_m[..], SPRITE_SIZES_M),
    ] {
        if let Some(value) = values.iter().find(|v| !(least..=most).contains(*v)) {
            let expected = format!("{least} to {most} m along each axis");
            return Err(unfit(key, format!("{value} m"), expected));
        }
    }
    Ok(Some((group, placed)))
}

/// Boxes that hold the sprites of a shading group, as many a box as may be. They are culled by nothing: where an artist puts a sprite,
/// there it stays.
pub(super) fn boxes(group: u32, placed: &[PlacedSprite]) -> impl Iterator<Item = BoxSettings> {
    placed.chunks(SPRITES[1] as usize).map(move |placed| {
        let mut own = BoxSettings {
            sprites: placed.len() as u32,
            group,
            cull: 0.0,
            by_hand: placed.to_vec(),
            ..default_box()
        };
        if let Some(first) = placed.first() {
            own.category = match SheetCell(first.cell).kind() {
                SheetKind::Foggy => Category::Stratus,
                SheetKind::Wispy => Category::Wispy,
                SheetKind::FlatBottomed | SheetKind::Puffy => Category::Cumulus,
            };
        }
        let most =
            |value: fn(&PlacedSprite) -> f32| placed.iter().map(value).fold(f32::MIN, f32::max);
        let least =
            |value: fn(&PlacedSprite) -> f32| placed.iter().map(value).fold(f32::MAX, f32::min);
        own.width_m = [least(|s| s.size_m[0]), most(|s| s.size_m[0])];
        own.height_m = [least(|s| s.size_m[1]), most(|s| s.size_m[1])];
        for (axis, value) in [
            (|s: &PlacedSprite| s.centre_m[0]) as fn(&PlacedSprite) -> f32,
            |s| s.centre_m[1],
            |s| s.centre_m[2],
        ]
        .into_iter()
        .enumerate()
        {
            let (low, high) = (least(value), most(value));
            own.centre_m[axis] = 0.5 * (low + high);
            own.size_m[axis] = high - low + ROOM_M;
        }
        own
    })
}

fn away(from: [f32; 3], to: [f32; 3]) -> [f32; 3] {
    [0, 1, 2].map(|i| to[i] - from[i])
}

fn length([x, y, z]: [f32; 3]) -> f32 {
    libm::sqrtf(x * x + y * y + z * z)
}

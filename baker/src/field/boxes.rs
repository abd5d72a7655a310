//! Boxes as an artist gives them: what may be asked of one, and what holds where nothing is said.

use std::f32::consts::PI;

use welkin_pack::field::Category;

use crate::settings::BoxSettings;

/// Where the middle of a box may be, from the origin of its cloud, in metres.
pub(crate) const PLACES_M: [f32; 2] = [-20_000.0, 20_000.0];

/// Sides of a box, in metres.
pub(crate) const SIZES_M: [f32; 2] = [1.0, 20_000.0];

/// Sides of a sprite, in metres.
pub(crate) const SPRITE_SIZES_M: [f32; 2] = [1.0, 10_000.0];

/// Sprites of a box: the article has 1 to 100, depending on the density.
pub(crate) const SPRITES: [u32; 2] = [1, 100];

/// The largest number of a shading group.
pub(crate) const GROUPS: u32 = 9999;

/// Turns of a sprite, in degrees.
pub(crate) const ROTATIONS_DEG: [f32; 2] = [-180.0, 180.0];

/// The cull distance as a share of the sprites' height: a third for typical clouds, a fifth to a sixth for dense ones.
pub(crate) const CULL: [f32; 2] = [0.0, 1.0];

/// What holds where an artist says nothing. It has no size.
pub(crate) fn default_box() -> BoxSettings {
    BoxSettings {
        centre_m: [0.0; 3],
        size_m: [0.0; 3],
        sprites: 12,
        width_m: [180.0, 300.0],
        height_m: [160.0, 260.0],
        category: Category::Cumulus,
        rotation_rad: [-PI, PI],
        group: 0,
        flat_bottom: false,
        cull: 1.0 / 3.0,
        by_hand: Vec::new(),
    }
}

/// What is wrong with a box whose numbers are each in range.
pub(crate) struct Fault {
    pub key: &'static str,
    pub found: String,
    pub expected: String,
}

/// The most that a side of a sprite has, in half diagonals of its box: what is wider hides the cloud that it is in. The rule
/// `field-size` of `welkin check` asks the same of a cloud, which is no smaller than its boxes.
const MOST_RADII: f32 = 4.0;

/// The cull distance is at most the longest side: above it a box could hold one sprite alone. Sprites are not far larger
/// than their box.
pub(crate) fn verify(of_cloud: &BoxSettings) -> Result<(), Fault> {
    let [x, y, z] = of_cloud.size_m;
    let radius_m = 0.5 * libm::sqrtf(x * x + y * y + z * z);
    for (key, [_, side_m]) in [
        ("width_m", of_cloud.width_m),
        ("height_m", of_cloud.height_m),
    ] {
        if side_m > MOST_RADII * radius_m {
            return Err(Fault {
                key,
                found: format!("up to {side_m} m"),
                expected: format!(
                    "at most {} m, four times half the diagonal of the box: make the box larger, or its sprites smaller",
                    MOST_RADII * radius_m
                ),
            });
        }
    }
    let longest = of_cloud.size_m.into_iter().fold(0.0, f32::max);
    let cull_m = of_cloud.cull_m();
    if cull_m <= longest || of_cloud.sprites == 1 {
        return Ok(());
    }
    Err(Fault {
        key: "cull",
        found: format!("{cull_m} m of the sprites' mean height"),
        expected: format!(
            "at most the longest side of the box, {longest} m: make the box larger, or its sprites lower"
        ),
    })
}

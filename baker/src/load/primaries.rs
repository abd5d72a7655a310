//! Colours of which primaries a picture has.

use crate::error::{BakeError, unfit};

/// ITU-R BT.709-6, item 1.3 and 1.4: red, green, blue and white as x, y; what a file that says nothing means.
const BT_709: [[f32; 2]; 4] = [
    [0.640, 0.330],
    [0.300, 0.600],
    [0.150, 0.060],
    [0.3127, 0.3290],
];

/// Half of the last digit that the standard gives, and room for programs that round.
const ROUNDED: f32 = 0.001;

/// Refuses a picture whose primaries and white, given under `key`, are not those of BT.709.
pub(super) fn verify(
    found: &[[f32; 2]; 4],
    file: &str,
    key: &'static str,
) -> Result<(), BakeError> {
    if are_near(found, &BT_709) {
        return Ok(());
    }
    let expected = "those of BT.709 (sRGB), linear; convert it";
    Err(unfit(file, key, format!("{found:?}"), expected))
}

/// Whether two sets differ by no more than rounding.
pub(super) fn are_near(a: &[[f32; 2]; 4], b: &[[f32; 2]; 4]) -> bool {
    let mut pairs = a.as_flattened().iter().zip(b.as_flattened());
    pairs.all(|(a, b)| (a - b).abs() < ROUNDED)
}

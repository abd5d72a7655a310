//! Whether what half floats store are numbers.

use super::report::Report;
use super::rule::FINITE;
use crate::format::Format;
use crate::role::Role;
use crate::texture::Texture;

/// Counts what is not a finite number, on every level: a comparison with it holds no bound, and filters spread it.
pub(super) fn check(report: &mut Report, role: Role, texture: &Texture) -> bool {
    if texture.format != Format::Rgba16Float {
        return true;
    }
    // All exponent bits set: an infinity, or not a number.
    let is_wrong = |half: &[u8]| half[1] & 0x7C == 0x7C;
    let halves = texture
        .levels
        .iter()
        .flat_map(|level| level.chunks_exact(2));
    let wrong = halves.filter(|half| is_wrong(half)).count();
    report.at_most(FINITE, role.name(), wrong as f64, 0.0);
    wrong == 0
}

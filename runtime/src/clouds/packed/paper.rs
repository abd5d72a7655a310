//! The packed method's clouds as the paper shades them: lines 14 to 28, grey by their amount, the same wherever the sun stands.

use glam::Vec3;

use super::{EDGE, PackedUniforms};
use crate::clouds::histogram::Histogram;
use crate::clouds::shared::{CloudUniforms, inverse_soften, radiance, shares_of_grey, softened};
use crate::geometry::part::{Part, Value};

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[("PACKED_FOLD", Value::F32(FOLD))],
    structs: &[],
    wgsl: include_str!("paper.wgsl"),
};

/// How far from 1 the fold of brightness (lines 22-23) is rounded.
pub const FOLD: f32 = 0.15;

/// Radiance of an overcast sky far away, where single clouds cannot be told apart.
///
/// It is the light of a place where photo, noise and detail have their means, by the same lines as the
/// shader's; line 19 is left out, since detail does not pierce an overcast sky.
pub(crate) fn overcast(packed: &PackedUniforms, clouds: &CloudUniforms, means: [f32; 3]) -> Vec3 {
    let [photo, noise, detail] = means;
    let amount = photo + noise * (1.0 - photo);
    let alpha = ((amount - packed.threshold) * packed.contrast).max(0.0);
    let grey = fold(amount + detail * (1.0 - amount) + packed.density * alpha * 2.0);
    radiance(clouds, grey.clamp(0.0, 1.0))
}

/// Opacity of the lower layer where photo, noise and detail are these, and shares of sunlight and skylight.
pub(super) fn place(packed: &PackedUniforms, [photo, noise, detail]: [f32; 3]) -> (f32, [f32; 2]) {
    let amount = photo + noise * (1.0 - photo);
    let smooth = detail + (1.0 - detail) * packed.smoothness;
    let alpha = ((amount - packed.threshold) * packed.contrast * smooth).max(0.0);
    let thick = 2.0 * packed.density * alpha;
    let grey = fold(amount + detail * (1.0 - amount) + thick).clamp(0.0, 1.0);
    (
        softened((alpha + thick).min(1.0), EDGE),
        shares_of_grey(grey),
    )
}

/// The share of places where the lower layer has more than this opacity.
pub(super) fn covered(
    packed: &PackedUniforms,
    [amount, detail]: [&Histogram; 2],
    opacity: f32,
) -> f32 {
    let smooth = packed.smoothness;
    let alpha = inverse_soften(opacity, EDGE) / (packed.contrast * (1.0 + 2.0 * packed.density));
    detail.mean(|detail| {
        let pierced = detail + (1.0 - detail) * smooth;
        amount.above(packed.threshold + alpha / pierced)
    })
}

/// `packed_fold` of the shader: lines 22-23 with the kink rounded off.
fn fold(grey: f32) -> f32 {
    let beyond = grey - 1.0;
    grey - 0.75 * (beyond + (beyond * beyond + FOLD * FOLD).sqrt())
}

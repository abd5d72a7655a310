//! Twin of rain.wgsl.

use std::f32::consts::TAU;

use glam::Vec3;
use welkin_runtime::rain::{CYLINDERS, HAZE_ABOVE, HAZE_FALL};
use welkin_runtime::uniforms::RainUniforms;

use crate::xyz;

/// Colour and opacity of rain and haze along a ray.
pub fn over(rain: &RainUniforms, ray: Vec3) -> (Vec3, f32) {
    let streaks = rain.streak[3] * streaks(rain, ray);
    let far = libm::exp2f(-HAZE_FALL * ray.normalize().y.abs());
    let haze = rain.haze[3] * (HAZE_ABOVE + (1.0 - HAZE_ABOVE) * far);
    let opacity = haze + streaks - haze * streaks;
    let share = streaks / opacity.max(1e-4);
    (xyz(rain.haze).lerp(xyz(rain.streak), share), opacity)
}

/// What the streaks of all cylinders cover together.
pub fn streaks(rain: &RainUniforms, ray: Vec3) -> f32 {
    let direction = ray.normalize();
    let [x, y, z] = [rain.right, rain.up, rain.forward].map(|axis| direction.dot(xyz(axis)));
    let across = libm::hypotf(x, z).max(1e-4);
    let turns = libm::atan2f(x, z) / TAU;
    let open = (0..CYLINDERS).map(|index| 1.0 - cylinder(rain, index, turns, y / across, across));
    1.0 - open.product::<f32>()
}

fn cylinder(rain: &RainUniforms, index: usize, turns: f32, rise: f32, across: f32) -> f32 {
    let [columns, cells, fraction, whole] = rain.cylinders[index];
    let [columns_a_half_width, per_half_length, opacity, tightness] = rain.widths[index];
    let drops = rain.right[3];
    let column = (turns + 0.5) * columns;
    let number = (column as u32).min(columns as u32 - 1) | (index as u32) << 10;
    let along = rise * cells + fraction + share(hash(number), 8);
    let cell = (along.floor() as i32 + whole as i32).rem_euclid(65_536) as u32;
    let drop = hash(cell << 13 | number);
    if share(drop, 0) >= drops {
        return 0.0;
    }
    let off = (column - column.floor() - (0.3 + 0.4 * share(drop, 8))).abs();
    let room = 2.0 - tightness / across;
    let off_middle = (along - along.floor() - 0.5) * per_half_length;
    (1.0 - off * columns_a_half_width * across).max(0.0)
        * (1.0 - off_middle * off_middle).max(0.0)
        * room.clamp(0.0, 1.0)
        * (opacity * (0.4 + 0.6 * share(drop, 16)))
}

/// The finaliser of MurmurHash3.
fn hash(value: u32) -> u32 {
    let bits = (value ^ value >> 16).wrapping_mul(0x85EB_CA6B);
    let bits = (bits ^ bits >> 13).wrapping_mul(0xC2B2_AE35);
    bits ^ bits >> 16
}

/// A byte of a hash, from this bit on, as a number from 0 up to 1.
fn share(bits: u32, first: u32) -> f32 {
    f32::from((bits >> first) as u8) / 256.0
}

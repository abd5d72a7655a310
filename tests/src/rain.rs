//! Twin of rain.wgsl and rainbow.wgsl.

use std::f32::consts::TAU;

use glam::{Mat3, Vec2, Vec3};
use welkin_runtime::internals::geometry::camera::CameraUniforms;
use welkin_runtime::internals::weather::rain::RainUniforms;
use welkin_runtime::internals::weather::rain::{
    COLUMNS, DROPS_A_COLUMN, FADE, HAZE_ABOVE, HAZE_FALL, HEIGHT_M, SLOTS,
};

use welkin_runtime::internals::weather::rainbow::{
    ENDS, GROUND, RainbowColour, RainbowUniforms, TEXELS,
};

use crate::camera;

/// Colour and opacity of the haze along a ray.
pub fn haze(rain: &RainUniforms, ray: Vec3) -> (Vec3, f32) {
    let far = libm::exp2f(-HAZE_FALL * ray.normalize().y.abs());
    let opacity = rain.haze_opacity * (HAZE_ABOVE + (1.0 - HAZE_ABOVE) * far);
    (rain.haze, opacity)
}

/// Light of the bow along a unit direction.
pub fn bow(rainbow: &RainbowUniforms, direction: Vec3) -> Vec3 {
    let cosine = direction.dot(rainbow.antisolar);
    let last = (TEXELS - 1) as f32;
    let at = |bow: &[RainbowColour; TEXELS], place: f32| {
        let place = place.clamp(0.0, last);
        let next = (place as usize + 1).min(TEXELS - 1);
        bow[place as usize]
            .colour
            .lerp(bow[next].colour, place.fract())
    };
    let colour = if cosine > rainbow.band {
        let place = (rainbow.primary_from - cosine) * rainbow.primary_per_cosine;
        at(&rainbow.primary, place)
    } else {
        let place = (rainbow.secondary_from - cosine) * rainbow.secondary_per_cosine;
        let outer = rainbow.secondary_from - last / rainbow.secondary_per_cosine;
        at(&rainbow.secondary, place) * (1.0 - ENDS * (outer - cosine)).clamp(0.0, 1.0)
    };
    rainbow.light * colour * (1.0 + direction.y / GROUND).clamp(0.0, 1.0)
}

/// What the streaks cover of each pixel, row by row from the top, if each is turned so far about the axis.
pub fn streaks(view: &CameraUniforms, rain: &RainUniforms, turned_rad: f32) -> Vec<f32> {
    let size = [view.width_px, view.height_px].map(|side| side as usize);
    let mut clear = vec![1.0; size[0] * size[1]];
    let [first, count] = [rain.first_column, rain.columns].map(|v| v as u32);
    for column in (first..first + count).map(|column| column % COLUMNS) {
        for slot in 0..DROPS_A_COLUMN {
            if let Some(streak) = Streak::new(rain, column, slot, turned_rad) {
                streak.cover(view, size, &mut clear);
            }
        }
    }
    clear.into_iter().map(|clear| 1.0 - clear).collect()
}

/// The quad of a drop: a flat thing in space, in metres from the eye.
struct Streak {
    middle: Vec3,
    half_width: Vec3,
    half_length: Vec3,
    opacity: f32,
}

impl Streak {
    /// The streak of a drop, if that is there.
    fn new(rain: &RainUniforms, column: u32, slot: u32, turned_rad: f32) -> Option<Streak> {
        let number = column * DROPS_A_COLUMN + slot;
        let kind = usize::from(slot >= SLOTS[0]) + usize::from(slot >= SLOTS[0] + SLOTS[1]);
        let own = rain.drops[kind];
        let [half_width, half_length] = own.half_size_m.to_array();
        let fallen = own.fallen_fraction + (hash(number) >> 16) as f32 / 65_536.0;
        let times = (own.fallen_count as u32 + fallen as u32) % 65_536;
        let bits = hash(times << 15 | number).to_le_bytes();
        let [aside, away, bright, rank] = bits.map(|byte| f32::from(byte) / 256.0);
        if rank >= rain.amount {
            return None;
        }
        let radius = own.radius_m + own.radius_range_m * away;
        let height = HEIGHT_M as f32 * (0.5 - fallen.fract());
        let angle = TAU * ((column as f32 + aside) / COLUMNS as f32 - 0.5) + turned_rad;
        let (sine, cosine) = (libm::sinf(angle), libm::cosf(angle));
        let [right, up, forward] = [rain.right, rain.up, rain.forward];
        // What a pixel covers there, across the ray; and along the streak, which is seen at a slant.
        let distance = libm::hypotf(radius, height);
        let pixel = rain.pixel_rad * distance;
        let drawn = [
            half_width.max(pixel),
            half_length.max(pixel * distance / radius),
        ];
        let fainter = half_width / drawn[0] * (half_length / drawn[1]);
        let to_end = fallen.fract().min(1.0 - fallen.fract());
        Some(Streak {
            middle: (right * sine + forward * cosine) * radius + up * height,
            half_width: (right * cosine - forward * sine) * drawn[0],
            half_length: up * drawn[1],
            opacity: own.opacity * fainter * (FADE * to_end).min(1.0) * (0.4 + 0.6 * bright),
        })
    }

    /// Covers the pixels before it.
    fn cover(&self, view: &CameraUniforms, [width, height]: [usize; 2], clear: &mut [f32]) {
        let Some([from, to]) = self.box_of_pixels(view) else {
            return;
        };
        let range = |from: f32, to: f32, size: usize| {
            let [first, last] = [from.floor() - 1.0, to.ceil() + 1.0].map(|v| v.max(0.0) as usize);
            first.min(size)..last.min(size)
        };
        // A ray is a sum of the three where it meets the quad, scaled.
        let on_quad = Mat3::from_cols(self.half_width, self.half_length, self.middle).inverse();
        for y in range(from.y, to.y, height) {
            for x in range(from.x, to.x, width) {
                let pixel = Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
                let met = on_quad * camera::ray_of(view, pixel);
                let [across, along] = [met.x / met.z, met.y / met.z];
                if met.z > 0.0 && across.abs() < 1.0 && along.abs() < 1.0 {
                    let profile = (1.0 - across.abs()) * (1.0 - along * along);
                    clear[y * width + x] *= 1.0 - self.opacity * profile;
                }
            }
        }
    }

    /// Two corners of a box around it: all pixels if a part is behind the eye, none if all of it is.
    fn box_of_pixels(&self, view: &CameraUniforms) -> Option<[Vec2; 2]> {
        let corners = [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)]
            .map(|(x, y)| self.middle + self.half_width * x + self.half_length * y);
        let ahead = corners.map(|corner| corner.dot(view.clip_w.truncate()) > 1e-3);
        if !ahead.contains(&true) {
            return None;
        }
        if ahead.contains(&false) {
            return Some([Vec2::ZERO, Vec2::new(view.width_px, view.height_px)]);
        }
        let seen = corners.map(|corner| camera::pixel_of(view, corner));
        let [first, ..] = seen;
        let [from, to] = [Vec2::min, Vec2::max].map(|pick| seen.into_iter().fold(first, pick));
        Some([from, to])
    }
}

/// The finaliser of MurmurHash3.
fn hash(value: u32) -> u32 {
    let bits = (value ^ value >> 16).wrapping_mul(0x85EB_CA6B);
    let bits = (bits ^ bits >> 13).wrapping_mul(0xC2B2_AE35);
    bits ^ bits >> 16
}

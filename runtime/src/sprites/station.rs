//! What a ring of impostors is made for: a place, a sun, and the views of its eight pictures. See [`super::ring`].

use glam::{DVec3, Vec2, Vec3, Vec4};
use welkin_pack::field::SECTION_SIDE_M;

use super::grid::BlockId;
use crate::geometry::uniforms::uniforms;

uniforms! {
    /// A viewpoint that sprites are drawn for, in a buffer of its own: the camera, or the middle of the ring towards one of its sides.
    SpriteView {
        /// Row of a matrix: dot of its xyz with a position gives its clip x.
        clip_x: Vec4,
        /// The same for y.
        clip_y: Vec4,
        /// The same for z, plus w.
        clip_z: Vec4,
        /// The same as x for w.
        clip_w: Vec4,
        /// Height above the sea, m.
        height_m: f32,
        /// A pixel in the middle of the picture, in radians.
        pixel_rad: f32,
        /// Texels a side of a cell of the sheet.
        cell_texels: f32,
        /// A texel of the ground's shadows, m.
        texel_m: f32,
    }

    /// One of two rings that are cross-faded.
    RingSet {
        /// From the viewer to the middle of the ring, m.
        centre: Vec3,
        /// Its weight.
        weight: f32,
        /// Tangent of the elevation at the upper edge.
        top: f32,
        /// 1 / (that less the lower edge's).
        per_height: f32,
        /// 1 / width of a picture, over the radius.
        per_width: f32,
        /// Nothing.
        _pad: f32,
    }

    /// A side of the ring.
    RingSide {
        /// Outward normal (east, south).
        normal: Vec2,
        /// Along it, clockwise.
        along: Vec2,
    }

    /// The ring of impostors, in a buffer of its own.
    RingUniforms {
        /// The ring in use.
        used: RingSet,
        /// The one that it fades to.
        next: RingSet,
        /// Radius to the middle of a side, m.
        radius_m: f32,
        /// Tangent of the elevation at the lower edge of what is drawn.
        bottom: f32,
        /// Tangent at its upper edge.
        top: f32,
        /// Nothing.
        _pad: f32,
        /// From the north to the east.
        sides: [RingSide; PICTURES],
    }
}

/// Pictures of a ring.
pub const PICTURES: usize = 8;
/// Texels a side of a picture.
pub const SIDE: u32 = 256;
/// Bytes of a ring: the article's 2 MB.
pub const BYTES: u64 = PICTURES as u64 * SIDE as u64 * SIDE as u64 * 4;
/// Radiance that the pictures hold at most, where the target wants radiance.
pub const BRIGHTEST: f32 = 2.0;
/// Blocks of a picture that are drawn in one frame.
pub const BLOCKS_A_FRAME: f64 = 48.0;
/// Frames over which old and new are cross-faded.
pub const FADE_FRAMES: u32 = 16;

/// How far the viewer goes before the ring is rebuilt, over its radius: sideways, and up or down.
pub(super) const REACH: [f64; 2] = [0.15, 0.02];
/// How far the sun goes, as a cosine: one degree.
pub(super) const SUN_COSINE: f32 = 0.999_847_7;
/// How much the light or a cloud changes.
pub(super) const CHANGE: f32 = 0.04;
/// How far the sun goes, as a cosine, and how much the light changes, at once when time itself jumps: then the ring is made at once. Ten
/// degrees are forty minutes.
pub(super) const JUMP_COSINE: f32 = 0.984_807_8;
pub(super) const JUMP: f32 = 0.2;
/// 10,000 feet, in metres.
pub const MOST_ABOVE_M: f64 = 3048.0;
/// Texels by which a picture is wider than its side of the octagon.
pub(super) const OVERSCAN_TEXELS: f32 = 2.0;
/// How much nearer than a block's middle its clouds may be, in metres: half its diagonal.
pub(super) const HALF_DIAGONAL_M: f64 = 2829.0;
/// Clouds are never taken for nearer than this, in metres.
pub(super) const NEAREST_M: f64 = 500.0;

/// Half of a side over the radius: the tangent of 22.5 degrees.
pub const HALF_SIDE: f32 = 0.414_213_56;
/// Cosine of 22.5 degrees: the radius to a side over that to a corner.
pub const COSINE: f32 = 0.923_879_5;

/// What a ring is made for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Station {
    /// The viewer's place in the field, in metres.
    pub place_m: DVec3,
    /// Radius to the middle of a side, in metres; 0 for no ring.
    pub radius_m: f64,
    /// How far clouds are seen, in metres.
    pub distance_m: f64,
    /// The lowest and the highest edge of a cloud of the field, in metres.
    pub heights_m: [f64; 2],
    /// Unit direction towards sun or moon.
    pub sun: Vec3,
    /// Numbers that the look of all clouds depends on.
    pub look: [f32; 11],
}

impl Station {
    /// Whether there is a ring: not from high above or far below the clouds.
    pub fn is_on(&self) -> bool {
        let [low, high] = self.heights_m;
        let away = self.place_m.y - self.place_m.y.clamp(low, high);
        self.radius_m > 0.0 && away.abs() <= MOST_ABOVE_M
    }

    /// Whether a block is in its pictures.
    pub fn holds(&self, block: BlockId) -> bool {
        self.is_on() && block.distance_of_middle_m(self.place_m) > self.radius_m
    }

    /// Frames that a picture takes.
    pub fn parts(&self) -> usize {
        let blocks = std::f64::consts::PI * (self.distance_m / f64::from(SECTION_SIDE_M)).powi(2);
        (blocks / PICTURES as f64 / BLOCKS_A_FRAME).ceil().max(1.0) as usize
    }

    /// Tangents of the elevations between which its clouds are.
    pub fn span(&self) -> [f32; 2] {
        // Towards its edges a picture's own depth is less than the distance.
        let near = f64::from(COSINE) * (self.radius_m - HALF_DIAGONAL_M).max(NEAREST_M);
        let [low, high] = self.heights_m.map(|height| height - self.place_m.y);
        let tangent = |height: f64, outward: f64| {
            let distance = if height * outward > 0.0 {
                near
            } else {
                self.distance_m
            };
            (height / distance) as f32
        };
        let (low, high) = (tangent(low, -1.0), tangent(high, 1.0));
        [low, high.max(low + 1e-3)]
    }

    /// Whether another one is wanted for `now`.
    pub fn is_stale(&self, now: &Station) -> bool {
        if self.is_on() != now.is_on() {
            return true;
        }
        let moved = now.place_m - self.place_m;
        let sideways = DVec3::new(moved.x, 0.0, moved.z).length();
        now.is_on()
            && (sideways > REACH[0] * self.radius_m
                || moved.y.abs() > REACH[1] * self.radius_m
                || self.sun.dot(now.sun) < SUN_COSINE
                || self.change(now) > CHANGE)
    }

    /// The largest change of the look.
    pub(super) fn change(&self, now: &Station) -> f32 {
        let change = self.look.iter().zip(now.look).map(|(a, b)| (a - b).abs());
        change.fold(0.0, f32::max)
    }

    /// Whether it has nothing in common with `now`: settings or the hour changed, or the viewer jumped.
    pub(super) fn is_another(&self, now: &Station) -> bool {
        self.radius_m != now.radius_m
            || self.distance_m != now.distance_m
            || self.place_m.distance(now.place_m) > self.radius_m.max(HALF_DIAGONAL_M)
            || self.sun.dot(now.sun) < JUMP_COSINE
            || self.change(now) > JUMP
    }

    /// The view from its middle onto one of its pictures, whose origin is its place.
    pub fn view(&self, picture: usize, cell_texels: f32, sea_m: f64) -> SpriteView {
        let (sin, cos) = azimuth_rad(picture).sin_cos();
        let (forward, right) = (Vec3::new(sin, 0.0, -cos), Vec3::new(cos, 0.0, sin));
        let [low, high] = self.span();
        let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
        let texel = 2.0 / SIDE as f32 * (half_width() * half).sqrt();
        SpriteView {
            clip_x: (right / half_width()).extend(0.0),
            clip_y: ((Vec3::Y - middle * forward) / half).extend(0.0),
            clip_z: (0.5 * forward).extend(0.0),
            clip_w: forward.extend(0.0),
            height_m: (self.place_m.y - sea_m) as f32,
            pixel_rad: texel,
            cell_texels,
            ..Default::default()
        }
    }

    /// How the pictures stand for a viewer at `now_m`.
    pub(super) fn set(&self, now_m: DVec3, share: f32) -> RingSet {
        if !self.is_on() {
            return RingSet::default();
        }
        let [low, high] = self.span();
        // Clouds at this distance stay where they belong when the viewer moves.
        let typical = (self.radius_m * self.distance_m).sqrt().max(self.radius_m);
        let behind = (self.place_m - now_m) * (self.radius_m / typical);
        RingSet {
            centre: behind.as_vec3(),
            weight: share,
            top: high,
            per_height: 1.0 / (high - low),
            per_width: 0.5 / half_width(),
            ..Default::default()
        }
    }
}

/// Azimuth of the middle of a side, from north towards east.
pub(super) fn azimuth_rad(side: usize) -> f32 {
    side as f32 * std::f32::consts::TAU / PICTURES as f32
}

/// Half the width of a picture over the radius.
pub(super) fn half_width() -> f32 {
    HALF_SIDE * SIDE as f32 / (SIDE as f32 - OVERSCAN_TEXELS)
}

//! The ring of impostors: far blocks as eight pictures around the viewer.
//!
//! # Theory
//! Wang, "Performance": an octagonal ring of eight pictures of 256x256, 45 degrees each, about the camera. Blocks beyond its radius are
//! drawn into it, those within as sprites. All eight are made anew when the camera has moved by 15 % of the radius sideways or 2 % up or
//! down or the sun has moved, one a frame, and old and new are cross-faded. They shift with the camera's height, and are not used when
//! clouds are more than 10,000 feet above or below the camera. Eight pictures of four bytes a texel: 2 MB, 4 MB while they change.
//!
//! # Changes versus the paper
//! - The pictures reach just from the lowest to the highest elevation that the clouds in them can have, so that no row is spent on clear sky.
//! - What is shifted with the viewer is the whole ring, sideways too, by the share that brings clouds at a typical distance to where they
//!   belong.
//! - Old and new are mixed before they are blended, not drawn one over the other: halfway a cloud is as opaque as before.
//! - Pictures are a texel wider than their 45 degrees, so that filtering at a seam sees the neighbour's clouds.
//!
//! # Practice
//! The ring remembers where it was made: with it a frame depends on those before, but for the first one, whose ring is made at once.
//! A frame that draws one picture draws an eighth of the far sprites, at a thirtieth of the pixels of a screen. Where clouds are seen
//! so far that a picture has more than [`BLOCKS_A_FRAME`] blocks, it takes several frames.

use glam::{DVec3, Vec2, Vec3, Vec4};
use welkin_pack::field::SECTION_SIDE_M;

use super::grid::BlockId;
use crate::geometry::part::{Part, Value};
use crate::geometry::uniforms::uniforms;

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[
        ("RING_COS", Value::F32(COSINE)),
        ("RING_HALF_SIDE", Value::F32(HALF_SIDE)),
        ("RING_BRIGHTEST", Value::F32(BRIGHTEST)),
    ],
    structs: &[RingSet::WGSL, RingSide::WGSL, RingUniforms::WGSL],
    wgsl: include_str!("ring.wgsl"),
};

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
        /// Nothing.
        _pad: f32,
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

/// How far the viewer goes before the ring is made anew, over its radius: sideways, and up or down.
const REACH: [f64; 2] = [0.15, 0.02];
/// How far the sun goes, as a cosine: one degree.
const SUN_COSINE: f32 = 0.999_847_7;
/// How much the light or a cloud changes.
const CHANGE: f32 = 0.04;
/// How far the sun goes, as a cosine, and how much the light changes, at once when time itself jumps: then the ring is made at once. Ten
/// degrees are forty minutes.
const JUMP_COSINE: f32 = 0.984_807_8;
const JUMP: f32 = 0.2;
/// 10,000 feet, in metres.
pub const MOST_ABOVE_M: f64 = 3048.0;
/// Texels by which a picture is wider than its side of the octagon.
const OVERSCAN_TEXELS: f32 = 2.0;
/// How much nearer than a block's middle its clouds may be, in metres: half its diagonal.
const HALF_DIAGONAL_M: f64 = 2829.0;
/// Clouds are never taken for nearer than this, in metres.
const NEAREST_M: f64 = 500.0;

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
    pub look: [f32; 8],
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
    fn change(&self, now: &Station) -> f32 {
        let change = self.look.iter().zip(now.look).map(|(a, b)| (a - b).abs());
        change.fold(0.0, f32::max)
    }

    /// Whether it has nothing in common with `now`: settings or the hour changed, or the viewer jumped.
    fn is_another(&self, now: &Station) -> bool {
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
    fn set(&self, now_m: DVec3, share: f32) -> RingSet {
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
fn azimuth_rad(side: usize) -> f32 {
    side as f32 * std::f32::consts::TAU / PICTURES as f32
}

/// Half the width of a picture over the radius.
fn half_width() -> f32 {
    HALF_SIDE * SIDE as f32 / (SIDE as f32 - OVERSCAN_TEXELS)
}

/// What the ring is about to do.
#[derive(Clone, Copy, Debug, PartialEq)]
enum State {
    /// Nothing.
    Idle,
    /// Pictures of another one are drawn; so many parts of them are done.
    Building(Station, usize),
    /// From one to another; so many frames have passed.
    Fading(Station, u32),
}

/// What a frame does for the ring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step {
    /// Nothing is drawn.
    Keep,
    /// Every picture of the ring in use is drawn at once.
    All,
    /// A part of a picture of the next ring is drawn: picture and part, both 0 for a new ring.
    Part([usize; 2]),
    /// The next ring has taken the place of the one in use.
    Swap,
}

/// The ring's story.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ring {
    current: Station,
    state: State,
}

impl Ring {
    /// A ring that is made at once; see [`Step::All`].
    pub fn new(now: Station) -> Ring {
        Ring {
            current: now,
            state: State::Idle,
        }
    }

    /// Goes on by a frame.
    pub fn step(&mut self, now: Station) -> Step {
        if self.current.is_another(&now) {
            *self = Ring::new(now);
            return Step::All;
        }
        match self.state {
            State::Idle if self.current.is_stale(&now) => {
                if now.is_on() {
                    self.state = State::Building(now, 1);
                    Step::Part([0, 0])
                } else {
                    self.state = State::Fading(now, 0);
                    Step::Keep
                }
            }
            State::Idle => Step::Keep,
            State::Building(next, done) if done < PICTURES * next.parts() => {
                self.state = State::Building(next, done + 1);
                Step::Part([done / next.parts(), done % next.parts()])
            }
            State::Building(next, _) => {
                self.state = State::Fading(next, 1);
                Step::Keep
            }
            State::Fading(next, frames) if frames < FADE_FRAMES => {
                self.state = State::Fading(next, frames + 1);
                Step::Keep
            }
            State::Fading(next, _) => {
                self.current = next;
                self.state = State::Idle;
                Step::Swap
            }
        }
    }

    /// The ring in use.
    pub fn current(&self) -> &Station {
        &self.current
    }

    /// The ring that is being drawn or faded to.
    pub fn next(&self) -> Option<&Station> {
        match &self.state {
            State::Idle => None,
            State::Building(next, _) | State::Fading(next, _) => Some(next),
        }
    }

    /// Shares of the ring in use and of the next one.
    pub fn shares(&self) -> [f32; 2] {
        let faded = match self.state {
            State::Fading(_, frames) => frames as f32 / FADE_FRAMES as f32,
            _ => 0.0,
        };
        [1.0 - faded, faded]
    }

    /// The share of a block that is drawn as sprites.
    pub fn share_of_sprites(&self, block: BlockId) -> f32 {
        let [old, new] = self.shares();
        let drawn = |station: &Station, share: f32| if station.holds(block) { 0.0 } else { share };
        drawn(&self.current, old) + self.next().map_or(0.0, |next| drawn(next, new))
    }

    /// The uniforms for a viewer at `now_m`, and whether anything of the ring shows.
    pub fn uniforms(&self, now_m: DVec3) -> (RingUniforms, bool) {
        let [old_share, new_share] = self.shares();
        let used = self.current.set(now_m, old_share);
        let next = self
            .next()
            .filter(|_| new_share > 0.0)
            .map_or(RingSet::default(), |next| next.set(now_m, new_share));
        let (mut bottom, mut top) = (f32::MAX, f32::MIN);
        for set in [used, next].iter().filter(|set| set.weight > 0.0) {
            // A tenth of the radius up or down is more than the ring is ever shifted by.
            bottom = bottom.min(set.top - 1.0 / set.per_height - 0.1);
            top = top.max(set.top + 0.1);
        }
        let side = |side: usize| {
            let (sin, cos) = azimuth_rad(side).sin_cos();
            RingSide {
                normal: Vec2::new(sin, -cos),
                along: Vec2::new(cos, sin),
            }
        };
        let uniforms = RingUniforms {
            used,
            next,
            radius_m: self.current.radius_m as f32,
            bottom,
            top,
            sides: std::array::from_fn(side),
            ..Default::default()
        };
        (uniforms, bottom < top)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn station(place_m: DVec3) -> Station {
        Station {
            place_m,
            radius_m: 10_000.0,
            distance_m: 30_000.0,
            heights_m: [900.0, 2500.0],
            sun: Vec3::Y,
            look: [0.5; 8],
        }
    }

    /// Goes on until it rests; gives the pictures that were drawn and the frames that it took.
    fn finish(ring: &mut Ring, now: Station) -> (Vec<usize>, u32) {
        let (mut drawn, mut frames) = (Vec::new(), 0);
        loop {
            frames += 1;
            match ring.step(now) {
                Step::Part([picture, _]) => drawn.push(picture),
                Step::Swap => return (drawn, frames),
                Step::Keep | Step::All => assert!(frames < 100, "it never rests"),
            }
        }
    }

    #[test]
    fn all_eight_are_made_anew_beyond_15_percent_sideways_2_percent_up_or_a_degree_of_sun() {
        let here = DVec3::new(100.0, 1000.0, 100.0);
        let moved = |x: f64, y: f64| station(here + DVec3::new(x, y, 0.0));
        let turned = |degrees: f32| Station {
            sun: Vec3::new(degrees.to_radians().sin(), degrees.to_radians().cos(), 0.0),
            ..station(here)
        };
        let used = station(here);
        for (now, stale) in [
            (moved(1499.0, 0.0), false),
            (moved(1501.0, 0.0), true),
            (moved(0.0, 199.0), false),
            (moved(0.0, -201.0), true),
            (turned(0.9), false),
            (turned(1.1), true),
        ] {
            assert_eq!(used.is_stale(&now), stale, "{now:?}");
            let mut ring = Ring::new(used);
            let first = ring.step(now);
            assert_eq!(
                first,
                if stale {
                    Step::Part([0, 0])
                } else {
                    Step::Keep
                }
            );
        }
    }

    #[test]
    fn one_picture_a_frame_then_a_fade_whose_shares_are_one_together() {
        let mut ring = Ring::new(station(DVec3::ZERO));
        let now = station(DVec3::new(2000.0, 0.0, 0.0));
        let (mut drawn, mut last) = (Vec::new(), 0.0);
        loop {
            match ring.step(now) {
                Step::Part([picture, 0]) => {
                    drawn.push(picture);
                    assert_eq!(ring.shares(), [1.0, 0.0], "not before all are there");
                }
                Step::Swap => break,
                Step::Keep => {}
                other => panic!("{other:?}"),
            }
            let [old, new] = ring.shares();
            assert!((old + new - 1.0).abs() < 1e-6 && new >= last);
            last = new;
        }
        assert_eq!(drawn, [0, 1, 2, 3, 4, 5, 6, 7]);
        assert_eq!(ring.step(now), Step::Keep);
        assert_eq!((ring.current(), ring.next()), (&now, None));
        assert_eq!(ring.shares(), [1.0, 0.0]);
    }

    #[test]
    fn every_block_is_there_once_whatever_the_ring_does() {
        let mut ring = Ring::new(station(DVec3::ZERO));
        let now = station(DVec3::new(4000.0, 0.0, 3000.0));
        for _ in 0..30 {
            ring.step(now);
            let [old, new] = ring.shares();
            for east in -6..6 {
                for south in -6..6 {
                    let block = BlockId { east, south };
                    let in_ring =
                        |station: &Station, share| if station.holds(block) { share } else { 0.0 };
                    let pictured = in_ring(ring.current(), old)
                        + ring.next().map_or(0.0, |next| in_ring(next, new));
                    let sum = pictured + ring.share_of_sprites(block);
                    assert!((sum - 1.0).abs() < 1e-6, "{block:?}: {sum}");
                }
            }
        }
    }

    #[test]
    fn from_10000_feet_above_the_clouds_there_is_no_ring() {
        let at = |height: f64| station(DVec3::new(0.0, height, 0.0));
        assert!(at(0.0).is_on() && at(5500.0).is_on());
        assert!(!at(5549.0).is_on(), "2500 m and 10,000 feet");
        let off = Station {
            radius_m: 0.0,
            ..at(0.0)
        };
        assert!(!off.is_on() && !off.holds(BlockId { east: 9, south: 9 }));
        // Climbing out, the ring fades without a new one being drawn.
        let mut ring = Ring::new(at(5500.0));
        let (drawn, frames) = finish(&mut ring, at(5600.0));
        assert_eq!((drawn.len(), frames), (0, FADE_FRAMES + 2));
        assert!(!ring.current().is_on());
    }

    #[test]
    fn a_jump_makes_a_ring_at_once() {
        let mut ring = Ring::new(station(DVec3::ZERO));
        let far = station(DVec3::new(50_000.0, 0.0, 0.0));
        assert_eq!(ring.step(far), Step::All);
        assert_eq!(ring.step(far), Step::Keep);
        assert_eq!(ring.current(), &far);
    }

    /// The eight pictures hold every place that a cloud beyond the radius can have.
    #[test]
    fn every_cloud_of_the_ring_is_in_a_picture() {
        for height in [0.0, 1200.0, 5000.0] {
            let station = station(DVec3::new(1234.0, height, -777.0));
            for step in 0..2000 {
                let azimuth = f64::from(step) * 0.618_034 * std::f64::consts::TAU;
                let distance = 10_000.0 - 2829.0 + 32.0 + f64::from(step * 7 % 20_000);
                let up = 900.0 + f64::from(step * 13 % 1601);
                let place = DVec3::new(azimuth.sin(), 0.0, -azimuth.cos()) * distance
                    + DVec3::Y * (up - height);
                let picture = (azimuth / std::f64::consts::TAU * 8.0).round() as usize % PICTURES;
                let view = station.view(picture, 128.0, 0.0);
                let along = |row: Vec4| row.truncate().dot(place.as_vec3());
                let w = along(view.clip_w);
                let (x, y) = (along(view.clip_x) / w, along(view.clip_y) / w);
                // Where its own side ends, two texels of 256 are left.
                assert!(x.abs() <= 254.0 / 256.0 + 1e-4, "{azimuth}: {x}");
                assert!(y.abs() <= 1.0 + 1e-4, "{height} {place}: {y}");
            }
        }
    }

    #[test]
    fn a_picture_of_many_blocks_takes_several_frames() {
        let far = |x: f64| Station {
            distance_m: 60_000.0,
            ..station(DVec3::new(x, 0.0, 0.0))
        };
        assert_eq!((station(DVec3::ZERO).parts(), far(0.0).parts()), (1, 2));
        let mut ring = Ring::new(far(0.0));
        let (drawn, frames) = finish(&mut ring, far(2000.0));
        let twice: Vec<usize> = (0..PICTURES).flat_map(|picture| [picture; 2]).collect();
        assert_eq!(drawn, twice);
        assert_eq!(frames, 2 * PICTURES as u32 + FADE_FRAMES + 1);
    }

    #[test]
    fn it_has_the_articles_size() {
        assert_eq!(BYTES, 8 * 256 * 256 * 4);
        assert_eq!(BYTES, 2 << 20);
    }
}

//! The skybox.

use super::report::{Report, subject};
use super::rule::{SKYBOX_CLIP, SKYBOX_RANGE, SKYBOX_SEAM};
use crate::mapping::cube_texel;
use crate::role::Role;
use crate::texture::Texture;
use crate::view::{Texel, View};

const NAME: &str = Role::Skybox.name();
const COVER: usize = 3;

pub(super) fn check(report: &mut Report, texture: &Texture) {
    let wrong: usize = texture.views().map(out_of_range).sum();
    report.at_most(SKYBOX_RANGE, NAME, wrong as f64, 0.0);
    let clipped = clipped(texture);
    report.at_most(SKYBOX_CLIP, NAME, clipped as f64, 0.0);
    let faces: Vec<View> = (0..texture.layers).map(|f| texture.view(0, f)).collect();
    for channel in 0..=COVER {
        let name = subject(Role::Skybox, channel);
        if wrong > 0 {
            report.skip(SKYBOX_SEAM, &name, "the radiance is not sound");
        } else {
            let ratio = worst_seam(&faces, channel);
            report.at_most(SKYBOX_SEAM, &name, ratio, 2.0);
        }
    }
}

/// Texels with a value that no skybox has.
fn out_of_range(image: View) -> usize {
    let sound = |texel: &Texel| {
        let [.., cover] = *texel;
        texel.iter().all(|v| v.is_finite() && *v >= 0.0) && cover <= 1.0
    };
    image.texels().filter(|texel| !sound(texel)).count()
}

/// Texels that are as bright as a half float can be: brighter ones were cut to that, and none is so bright by itself.
fn clipped(texture: &Texture) -> usize {
    let largest = half::f16::MAX.to_f32();
    let is_largest = |texel: &Texel| texel[..COVER].iter().any(|v| *v >= largest);
    texture.view_of_level(0).texels().filter(is_largest).count()
}

/// The worst ratio, over the edges of the cube, of the mean difference across the edge to the largest mean
/// difference between neighbouring lines near it on both faces.
///
/// Texels are as far apart across an edge as beside it, so an edge is a place like any other. A lone bright
/// texel beside an edge makes a difference on both its sides, and two can meet: hence a bound of 2. Faces
/// that do not belong together differ by the contrast of the whole picture instead.
fn worst_seam(faces: &[View], channel: usize) -> f64 {
    let mut worst = 0.0_f64;
    for face in 0..faces.len() as u32 {
        for side in Side::ALL {
            let line = Line {
                face,
                side,
                depth: 0,
            };
            let inside = line
                .inside(faces, channel)
                .max(line.beyond(faces).inside(faces, channel));
            worst = worst.max(line.across(faces, channel) / (inside + HALF_STEP));
        }
    }
    worst
}

/// Below half a step of a byte a difference is rounding.
const HALF_STEP: f64 = 0.5 / 255.0;

/// A value as the eye weighs it: radiance bent into 0..1, so that a sun counts for no more than a white wall.
fn seen(faces: &[View], channel: usize, (face, [x, y]): (u32, [u32; 2])) -> f64 {
    let value = f64::from(faces[face as usize].texel(x, y)[channel]);
    if channel == COVER {
        value
    } else {
        value / (1.0 + value)
    }
}

/// A side of a face.
#[derive(Clone, Copy)]
enum Side {
    Left,
    Right,
    Top,
    Bottom,
}

impl Side {
    const ALL: [Side; 4] = [Side::Left, Side::Right, Side::Top, Side::Bottom];
}

/// A line of texels along a side of a face; `depth` counts from the side.
#[derive(Clone, Copy)]
struct Line {
    face: u32,
    side: Side,
    depth: i32,
}

impl Line {
    /// A texel of the line. At depth -1 it is beyond the side.
    fn texel(self, along: u32, size: u32) -> (u32, [u32; 2]) {
        let (along, last) = (along as i32, size as i32 - 1);
        let place = match self.side {
            Side::Left => [self.depth, along],
            Side::Right => [last - self.depth, along],
            Side::Top => [along, self.depth],
            Side::Bottom => [along, last - self.depth],
        };
        cube_texel(self.face, place, size)
    }

    /// The line on the other side of the edge.
    fn beyond(self, faces: &[View]) -> Line {
        let size = faces[0].width;
        let (face, [x, y]) = Line { depth: -1, ..self }.texel(size / 2, size);
        let side = match (x, y) {
            (0, _) => Side::Left,
            (_, 0) => Side::Top,
            (x, _) if x == size - 1 => Side::Right,
            _ => Side::Bottom,
        };
        Line {
            face,
            side,
            depth: 0,
        }
    }

    fn across(self, faces: &[View], channel: usize) -> f64 {
        self.difference(Line { depth: -1, ..self }, faces, channel)
    }

    /// The largest difference between neighbouring lines in the eighth of the face next to the side.
    fn inside(self, faces: &[View], channel: usize) -> f64 {
        let depths = 1..=(faces[0].width / 8) as i32;
        let pair = |depth| [depth - 1, depth].map(|depth| Line { depth, ..self });
        let differences = depths.map(|depth| {
            let [a, b] = pair(depth);
            a.difference(b, faces, channel)
        });
        differences.fold(0.0, f64::max)
    }

    /// Mean difference of two lines, texel by texel.
    fn difference(self, other: Line, faces: &[View], channel: usize) -> f64 {
        let size = faces[0].width;
        let at = |line: Line, i: u32| seen(faces, channel, line.texel(i, size));
        let sum: f64 = (0..size).map(|i| (at(self, i) - at(other, i)).abs()).sum();
        sum / f64::from(size)
    }
}

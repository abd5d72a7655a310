//! Light through a small cloud.
//!
//! # Theory
//! A ray goes from the viewer through the cloud. Of a step of the optical depth `t` the share `1 - exp(-t)` is seen (Beer
//! and Lambert), dimmed by the steps before it. It shines with the light of one direction, scattered once and dimmed on
//! its way through the cloud, and with light from everywhere, dimmed by how deep it lies. J. T. Kajiya, B. P. Von Herzen,
//! "Ray Tracing Volume Densities", SIGGRAPH 1984.

use rayon::prelude::*;
use welkin_pack::Image;

/// A small cloud in the cube from -1 to 1: x to the right, y up, z towards the viewer.
pub(super) trait Body: Sync {
    /// Length of a step through it.
    const STEP: f32;

    /// What is there.
    fn medium(&self, place: [f32; 3]) -> Medium;

    /// Optical depth a unit of length there, without the finest detail: for shadows.
    fn shadow(&self, place: [f32; 3]) -> f32;
}

/// What is in one place of a cloud.
pub(super) enum Medium {
    /// Nothing, and nothing nearer than this.
    Clear(f32),
    /// Cloud.
    Cloud {
        /// Optical depth a unit of length.
        extinction: f32,
        /// Share of the light from everywhere that gets there, 0..1.
        openness: f32,
    },
}

/// Where the ray is no more transparent than this, it ends.
const OPAQUE: f32 = 1.0 / 256.0;

/// A step that is seen less than this is as bright as the one before it.
const FAINT: f32 = 1.0 / 64.0;

/// Unit vector to the light: from the viewer's side, half right and from above.
const LIGHT: [f32; 3] = [0.2, 0.52, 0.83];

/// Steps towards the light: where each ends. Beyond, little more is hidden.
const LIGHT_STEPS: [f32; 3] = [0.05, 0.13, 0.28];

/// Share of the light that comes from one direction.
const DIRECT: f32 = 0.5;

/// Share of the optical depth that dims it: most of what is scattered goes on forwards.
const DIMMING: f32 = 0.15;

/// A picture of `side` texels: light times opacity, and opacity.
pub(super) fn picture(body: &impl Body, side: u32) -> Image {
    let mut image = Image::new(side, side, 2);
    let unit = |i: usize| (i as f32 + 0.5) / side as f32 * 2.0 - 1.0;
    let rows = image.texels.par_chunks_mut(2 * side as usize);
    rows.enumerate().for_each(|(y, row)| {
        for (x, texel) in row.chunks_exact_mut(2).enumerate() {
            texel.copy_from_slice(&ray(body, [unit(x), -unit(y)]));
        }
    });
    image
}

/// Light that comes out of the cloud towards +z, and opacity.
fn ray<B: Body>(body: &B, [x, y]: [f32; 2]) -> [f32; 2] {
    let step = B::STEP;
    let (mut clear, mut light, mut before) = (1.0, 0.0, None);
    let mut z = 1.0;
    while z > -1.0 && clear > OPAQUE {
        let place = [x, y, z];
        match body.medium(place) {
            Medium::Clear(away) => z -= away.max(step),
            Medium::Cloud {
                extinction,
                openness,
            } => {
                let passed = libm::expf(-extinction * step);
                let seen = clear * (1.0 - passed);
                let shine = before
                    .filter(|_| seen < FAINT)
                    .unwrap_or_else(|| brightness(body, place, openness));
                before = Some(shine);
                light += seen * shine;
                clear *= passed;
                z -= step;
            }
        }
    }
    [light, 1.0 - clear]
}

fn brightness(body: &impl Body, place: [f32; 3], openness: f32) -> f32 {
    let (mut depth, mut from) = (0.0, 0.0);
    for to in LIGHT_STEPS {
        let along = 0.5 * (from + to);
        let there = [0, 1, 2].map(|a| place[a] + along * LIGHT[a]);
        depth += (to - from) * body.shadow(there);
        from = to;
    }
    DIRECT * libm::expf(-DIMMING * depth) + (1.0 - DIRECT) * openness
}

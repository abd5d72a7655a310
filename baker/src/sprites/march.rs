//! Light through a small cloud.
//!
//! # Theory
//! A ray goes from the viewer through the cloud. Of a step of the optical depth `t` the share `1 - exp(-t)` is seen (Beer
//! and Lambert), dimmed by the steps before it. It shines with the light of one of five directions, dimmed on
//! its way through the cloud, and with light from everywhere, dimmed by how deep it lies. J. T. Kajiya, B. P. Von Herzen,
//! "Ray Tracing Volume Densities", SIGGRAPH 1984.

use rayon::prelude::*;
use welkin_pack::Image;

use super::lights::{BySide, Lights};

/// Nothing of a sprite lies farther from the middle of its cell, whose half side is 1.
pub(super) const REACH: f32 = 0.84;

/// A small cloud in the cube from -1 to 1: x to the right, y up, z towards the viewer.
pub(super) trait Body: Sync {
    /// Length of a step through it.
    const STEP: f32;

    /// Between which z a ray along -z through this x and y may meet it: the first is not more than the second where it
    /// meets nothing.
    fn span(&self, place: [f32; 2]) -> [f32; 2];

    /// What is there.
    fn medium(&self, place: [f32; 3]) -> Medium;

    /// Optical depth a unit of length there, without the finest detail: for shadows.
    fn shadow(&self, place: [f32; 3]) -> f32;
}

/// What is in one place of a cloud.
pub(super) enum Medium {
    /// Nothing.
    Clear,
    /// Cloud.
    Cloud {
        /// Optical depth a unit of length.
        extinction: f32,
        /// Share of the light from everywhere that gets there, 0..1.
        openness: f32,
    },
}

/// Where the ray is no more transparent than this, it ends.
const OPAQUE: f32 = 1.0 / 128.0;

/// A step that is seen less than this is as bright as the one before it.
const FAINT: f32 = 1.0 / 32.0;

/// Share of the light that comes from one direction.
const DIRECT: f32 = 0.5;

/// Share of the optical depth that dims it: most of what is scattered goes on forwards.
const DIMMING: f32 = 0.15;

/// A picture of `side` texels, times opacity but for the opacity: light from the front, opacity, and half of what light from the right
/// is more than that from the left, and from the top than from the bottom.
pub(super) fn picture(body: &impl Body, side: u32) -> Image {
    let lights = Lights::new(REACH, |place| body.shadow(place));
    let mut image = Image::new(side, side, 4);
    let unit = |i: usize| (i as f32 + 0.5) / side as f32 * 2.0 - 1.0;
    let rows = image.texels.par_chunks_mut(4 * side as usize);
    rows.enumerate().for_each(|(y, row)| {
        for (x, texel) in row.chunks_exact_mut(4).enumerate() {
            let ([right, left, top, bottom, front], alpha) =
                ray(body, &lights, [unit(x), -unit(y)]);
            texel.copy_from_slice(&[front, alpha, 0.5 * (right - left), 0.5 * (top - bottom)]);
        }
    });
    image
}

/// Light of each of the directions that comes out of the cloud towards +z, and opacity.
fn ray<B: Body>(body: &B, lights: &Lights, [x, y]: [f32; 2]) -> (BySide, f32) {
    let step = B::STEP;
    let (mut clear, mut light, mut before) = (1.0, BySide::default(), None);
    let [mut z, back] = body.span([x, y]);
    while z > back && clear > OPAQUE {
        let place = [x, y, z];
        match body.medium(place) {
            Medium::Clear => {}
            Medium::Cloud {
                extinction,
                openness,
            } => {
                let passed = libm::expf(-extinction * step);
                let seen = clear * (1.0 - passed);
                let shine = before
                    .filter(|_| seen < FAINT)
                    .unwrap_or_else(|| brightness(lights.depths(place), openness));
                before = Some(shine);
                for (sum, shine) in light.iter_mut().zip(shine) {
                    *sum += seen * shine;
                }
                clear *= passed;
            }
        }
        z -= step;
    }
    (light, 1.0 - clear)
}

fn brightness(depths: BySide, openness: f32) -> BySide {
    depths.map(|depth| DIRECT * libm::expf(-DIMMING * depth) + (1.0 - DIRECT) * openness)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A block from z = 0.5 to -0.5 of one optical depth a unit, in which light is dimmed by another.
    struct Block {
        extinction: f32,
        shadow: f32,
    }

    impl Body for Block {
        const STEP: f32 = 1.0 / 64.0;

        fn span(&self, [x, _]: [f32; 2]) -> [f32; 2] {
            if x < 0.0 { [1.0, -1.0] } else { [0.0; 2] }
        }

        fn medium(&self, [_, _, z]: [f32; 3]) -> Medium {
            if !(-0.5..0.5).contains(&z) {
                return Medium::Clear;
            }
            Medium::Cloud {
                extinction: self.extinction,
                openness: 0.25,
            }
        }

        fn shadow(&self, _: [f32; 3]) -> f32 {
            self.shadow
        }
    }

    #[test]
    fn opacity_is_that_of_beer_and_lambert() {
        for extinction in [0.01, 0.3, 1.0, 4.0] {
            let block = Block {
                extinction,
                shadow: 0.0,
            };
            let lights = Lights::new(REACH, |place| block.shadow(place));
            let ([light, ..], alpha) = ray(&block, &lights, [-0.5, 0.0]);
            assert!((alpha - 1.0 + libm::expf(-extinction)).abs() < 1e-5);
            // One half is not dimmed, of the other a quarter is left.
            assert!((light / alpha - 0.625).abs() < 1e-5);
            assert_eq!(ray(&block, &lights, [0.5, 0.0]), ([0.0; 5], 0.0));
        }
    }

    #[test]
    fn light_is_dimmed_on_its_way_and_rays_end_where_all_is_hidden() {
        let block = Block {
            extinction: 1e4,
            shadow: 5.0,
        };
        let lights = Lights::new(REACH, |place| block.shadow(place));
        let (light, alpha) = ray(&block, &lights, [-0.5, 0.0]);
        assert!(alpha > 1.0 - OPAQUE);
        // The ray is seen where it enters, a quarter of the way from the front to the back.
        for (light, way) in light.iter().zip([1.34, 0.34, 0.84, 0.84, 0.34]) {
            let expected = 0.5 * libm::expf(-DIMMING * 5.0 * way) + 0.5 * 0.25;
            assert!((light - expected).abs() < 5e-3, "{light} {expected}");
        }
    }
}

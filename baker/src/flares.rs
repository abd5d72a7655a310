//! The parts of a lens flare, as an atlas of four cells: disc, ring, glow and starburst.
//!
//! S. Guthikonda, A. Meena, D. V. Linder, S. Yi, "Realistic Real-Time Skies", CS 580 final project, University
//! of Southern California, part III: circular pictures that are added to the frame, dark where they are
//! transparent. The paper's were pictures from a web site; these are drawn by formula.
//!
//! In a cell `r` is the distance from its middle, 1 in the middle of a side.

use welkin_pack::{FlareCell, Image};

use crate::filter::{plane, smoothstep};
use crate::settings::FlareSettings;
use crate::stream::Stream;

/// Where the light of every cell begins to fade, and where it has gone: in the smallest cell, of 32 texels, the
/// two at the side have their centres beyond 0.906.
const FADE: [f32; 2] = [0.80, 0.90];

/// Radius of the disc's edge, and half of its softness.
const DISC_EDGE: [f32; 2] = [0.81, 0.04];

/// Radius of the ring, and how far inside and outside of it the light has fallen to 1/e.
const RING: [f32; 3] = [0.75, 0.075, 0.035];

/// Rays of the starburst: how many, how long at least and at most, half width at the middle, and strength.
const LONG_RAYS: Rays = Rays {
    count: 8,
    lengths: [0.58, 0.90],
    half_width: 0.038,
    strengths: [0.65, 0.95],
};

/// Short faint rays between them, which make the core look alive.
const SHORT_RAYS: Rays = Rays {
    count: 22,
    lengths: [0.25, 0.50],
    half_width: 0.026,
    strengths: [0.12, 0.36],
};

/// One channel, 0..1: the light of each cell, by [`FlareCell`]. Every cell is 0 along its border.
///
/// The rays' directions, lengths and strengths come from the random stream `flares.starburst`.
pub(crate) fn image(settings: &FlareSettings, seed: u64) -> Image {
    let cell = settings.size / FlareCell::A_SIDE;
    let mut stream = Stream::new(seed, "flares.starburst");
    let mut rays = LONG_RAYS.draw(&mut stream);
    rays.extend(SHORT_RAYS.draw(&mut stream));
    plane(settings.size, settings.size, |x, y| {
        let [u, v] = [x, y].map(|i| ((i % cell) as f32 + 0.5) / cell as f32 * 2.0 - 1.0);
        let r = libm::sqrtf(u * u + v * v);
        let place = [x / cell, y / cell];
        let light = match FlareCell::ALL.into_iter().find(|c| c.place() == place) {
            Some(FlareCell::Disc) => disc(r),
            Some(FlareCell::Ring) => ring(r),
            Some(FlareCell::Glow) => glow(r),
            Some(FlareCell::Starburst) => starburst(u, v, r, &rays),
            None => 0.0,
        };
        light * (1.0 - smoothstep(FADE[0], FADE[1], r))
    })
}

/// Nearly flat, with a rim: the picture of a round aperture out of focus.
fn disc(r: f32) -> f32 {
    let [edge, soft] = DISC_EDGE;
    let rim = smoothstep(0.6 * edge, edge, r);
    (0.70 + 0.22 * rim * rim) * (1.0 - smoothstep(edge - soft, edge + soft, r))
}

/// A thin ring, sharper outside than inside, over a faint veil.
fn ring(r: f32) -> f32 {
    let [radius, inside, outside] = RING;
    let off = (r - radius) / if r < radius { inside } else { outside };
    let veil = 0.10 * smoothstep(0.0, radius, r) * (1.0 - smoothstep(radius, FADE[0], r));
    (0.9 * libm::expf(-off * off) + veil).min(1.0)
}

/// Falls as a Gaussian, brought to 0 with a level slope.
fn glow(r: f32) -> f32 {
    let window = (1.0 - (r / FADE[1]) * (r / FADE[1])).max(0.0);
    window * window * libm::expf(-2.5 * r * r)
}

/// A core with an aura, and rays; light upon light never exceeds 1.
fn starburst(u: f32, v: f32, r: f32, rays: &[Ray]) -> f32 {
    let core = libm::expf(-(r / 0.07) * (r / 0.07));
    let aura = 0.40 * libm::expf(-r / 0.15);
    let dark = rays.iter().fold((1.0 - core) * (1.0 - aura), |dark, ray| {
        dark * (1.0 - ray.light(u, v))
    });
    1.0 - dark
}

struct Rays {
    count: u32,
    lengths: [f32; 2],
    half_width: f32,
    strengths: [f32; 2],
}

impl Rays {
    /// Directions are even but for a fifth of the way to the next.
    fn draw(&self, stream: &mut Stream) -> Vec<Ray> {
        (0..self.count)
            .map(|i| {
                let turn = (i as f32 + stream.between([-0.2, 0.2])) / self.count as f32;
                let angle = std::f32::consts::TAU * turn;
                Ray {
                    direction: [libm::cosf(angle), libm::sinf(angle)],
                    length: stream.between(self.lengths),
                    half_width: self.half_width,
                    strength: stream.between(self.strengths),
                }
            })
            .collect()
    }
}

struct Ray {
    direction: [f32; 2],
    length: f32,
    half_width: f32,
    strength: f32,
}

impl Ray {
    /// Thinner and fainter from the middle to the tip.
    fn light(&self, u: f32, v: f32) -> f32 {
        let [cos, sin] = self.direction;
        let (along, across) = (u * cos + v * sin, v * cos - u * sin);
        let left = 1.0 - along / self.length;
        if along <= 0.0 || left <= 0.0 {
            return 0.0;
        }
        // A tip of no width would end in single texels.
        let off = across / (self.half_width * (0.35 + 0.65 * left));
        self.strength
            * left
            * libm::sqrtf(left)
            * smoothstep(0.0, 0.06, along)
            * libm::expf(-off * off)
    }
}

//! Fog, which is smooth, and wisps, which are torn.

use super::march::{Body, Medium, REACH};
use super::volume::{Volumes, place_of};
use crate::filter::smoothstep;
use crate::settings::SpriteShape;
use crate::stream::Stream;

/// How fast the light from everywhere falls off with the optical depth a unit of length.
const HIDING: f32 = 0.25;

/// Size of a cell of the noise in fog, and how much it changes the density.
const FOG_CELL: f32 = 0.5;
const FOG_UNEVEN: f32 = 0.8;

/// Optical depth a unit of length in the middle of fog.
const FOG_EXTINCTION: f32 = 2.0;

/// Half of the thickness of wisps.
const WISP_DEPTH: f32 = 0.4;

/// Size of a cell of the noise that curls wisps, and where it is read for the two directions, in cells.
const CURL_CELL: f32 = 0.55;
const CURL_APART: [f32; 2] = [1.0, 4.5];

/// How much denser wisps are in patches, and how much thinner everywhere and at their ends; a fibre has the density 1.
const PATCHES: f32 = 0.5;
const THIN: f32 = 0.18;
const ENDS: f32 = 0.9;

/// How fast the density falls off beside a fibre.
const SHARP: f32 = 1.5;

/// Share of the way in from [`REACH`], as a square, over which wisps fade out.
const FADE: f32 = 0.35;

/// Size of a cell of their fibres: along, across, and towards the viewer.
const FIBRE_CELL: [f32; 3] = [0.7, 0.2, 0.5];

/// Optical depth a unit of length where wisps are densest.
const WISP_EXTINCTION: f32 = 3.0;

pub(super) struct Fog<'a> {
    volumes: &'a Volumes,
    origin: [f32; 3],
    /// Radii, as shares of [`REACH`].
    radii: [f32; 3],
    gain: f32,
}

impl<'a> Fog<'a> {
    pub(super) fn new(volumes: &'a Volumes, shape: &SpriteShape, stream: &mut Stream) -> Fog<'a> {
        Fog {
            volumes,
            origin: place_of(stream),
            radii: [
                stream.between([0.9, 1.0]),
                stream.between([0.75, 0.95]),
                0.75,
            ],
            gain: 0.5 * shape.detail,
        }
    }
}

impl Body for Fog<'_> {
    const STEP: f32 = 0.08;

    fn span(&self, [x, y]: [f32; 2]) -> [f32; 2] {
        let [a, b, c] = self.radii.map(|r| REACH * r);
        let half = 1.0 - square([x / a, y / b, 0.0]);
        [c, -c].map(|z| z * libm::sqrtf(half.max(0.0)))
    }

    fn medium(&self, place: [f32; 3]) -> Medium {
        veil(self.extinction(place, 3))
    }

    fn shadow(&self, place: [f32; 3]) -> f32 {
        self.extinction(place, 1)
    }
}

impl Fog<'_> {
    fn extinction(&self, place: [f32; 3], octaves: u32) -> f32 {
        let envelope = 1.0 - square([0, 1, 2].map(|a| place[a] / (REACH * self.radii[a])));
        if envelope <= 0.0 {
            return 0.0;
        }
        let there = [0, 1, 2].map(|a| place[a] / FOG_CELL + self.origin[a]);
        let noise = self.volumes.gradients.sum(there, octaves, self.gain);
        FOG_EXTINCTION * envelope * (envelope + FOG_UNEVEN * noise).max(0.0)
    }
}

pub(super) struct Wisp<'a> {
    volumes: &'a Volumes,
    origin: [f32; 3],
    /// Unit vector along the fibres.
    along: [f32; 2],
    /// How far they are curled.
    curl: f32,
    /// How far from the middle they end, along and across.
    extent: [f32; 3],
    gain: f32,
}

impl<'a> Wisp<'a> {
    pub(super) fn new(volumes: &'a Volumes, shape: &SpriteShape, stream: &mut Stream) -> Wisp<'a> {
        let origin = place_of(stream);
        let angle = stream.between([-0.7, 0.7]);
        Wisp {
            volumes,
            origin,
            along: [libm::cosf(angle), libm::sinf(angle)],
            curl: stream.between([0.14, 0.30]),
            extent: [REACH, REACH * stream.between([0.5, 0.9]), 1.0],
            gain: 0.55 * shape.detail,
        }
    }

    fn extinction(&self, place: [f32; 3], octaves: u32) -> f32 {
        let [x, y, z] = place;
        let slab = 1.0 - square([0.0, 0.0, z / WISP_DEPTH]);
        let fade = 1.0 - square([x / REACH, y / REACH, 0.0]);
        if slab <= 0.0 || fade <= 0.0 {
            return 0.0;
        }
        let [cos, sin] = self.along;
        let turned = [cos * x + sin * y, cos * y - sin * x, z];
        let gradients = &self.volumes.gradients;
        let curl = CURL_APART.map(|apart| {
            let there = [0, 1, 2].map(|a| turned[a] / CURL_CELL + self.origin[a] + apart);
            gradients.sum(there, octaves / 2, 0.5)
        });
        let [u, v] = [0, 1].map(|a| turned[a] + self.curl * curl[a]);
        let far = square([0, 1, 2].map(|a| [u, v, 0.0][a] / self.extent[a]));
        let patch = PATCHES * (curl[0] - curl[1]) - THIN - ENDS * far;
        if patch <= -1.0 {
            // Less than any fibre makes up for.
            return 0.0;
        }
        let there = [0, 1, 2].map(|a| [u, v, z][a] / FIBRE_CELL[a] + self.origin[(a + 1) % 3]);
        let fibre = 1.0 - SHARP * gradients.sum(there, octaves, self.gain).abs();
        WISP_EXTINCTION * slab * smoothstep(0.0, FADE, fade) * (patch + fibre).max(0.0)
    }
}

impl Body for Wisp<'_> {
    const STEP: f32 = 0.1;

    fn span(&self, [x, y]: [f32; 2]) -> [f32; 2] {
        if x * x + y * y > REACH * REACH {
            return [0.0; 2];
        }
        // Half a step inside, so that the first step counts.
        [WISP_DEPTH - 0.5 * Self::STEP, -WISP_DEPTH]
    }

    fn medium(&self, place: [f32; 3]) -> Medium {
        veil(self.extinction(place, 4))
    }

    fn shadow(&self, place: [f32; 3]) -> f32 {
        self.extinction(place, 2)
    }
}

fn veil(extinction: f32) -> Medium {
    if extinction <= 0.0 {
        return Medium::Clear;
    }
    Medium::Cloud {
        extinction,
        openness: libm::expf(-HIDING * extinction),
    }
}

fn square([x, y, z]: [f32; 3]) -> f32 {
    x * x + y * y + z * z
}

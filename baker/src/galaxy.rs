//! The galaxy: brightness of the Milky Way's band over the whole dome.
//!
//! # Theory
//! Seen from inside, a thin disc of stars is a band along a great circle, widest and brightest towards
//! the bulge. Dust lies still thinner in the plane and cuts a dark rift along the band, strongest in
//! front of the bulge, with ragged branches out of it. Star clouds make the band patchy.
//!
//! # Changes versus the paper
//! Roden and Parberry's galaxy texture ("Clouds and Stars", ACE 2005, figure 7) is painted; this one is
//! made from those four parts. It lies on Lambert's equal-area dome, so no part of the sky is stretched.
//! Texels beyond the horizon continue the picture below it.

use noise::Vector3;
use noise::core::perlin::perlin_3d;
use noise::permutationtable::NoiseHasher;
use welkin_pack::{Image, mapping};

use crate::filter::{self, Edge, smoothstep};
use crate::settings::GalaxySettings;
use crate::stream::Stream;

/// Where the bulge stands along the band, from where the band rises, in radians.
const BULGE_ANGLE_RAD: f32 = 0.85;

/// The last blur: a texel is 1.3 degrees wide and much magnified.
const SMOOTH_TEXELS: f32 = 0.8;

/// One channel, 0..1: what shines evenly with the band, before a curve that keeps faint parts visible.
pub(crate) fn image(settings: &GalaxySettings, seed: u64) -> Image {
    let clouds = Noise3::new(&mut Stream::new(seed, "galaxy.clouds"));
    let dust = Noise3::new(&mut Stream::new(seed, "galaxy.dust"));
    let frame = Frame::new(settings);
    let sharp = filter::plane(settings.size, settings.size, |x, y| {
        let uv = [x, y].map(|i| (i as f32 + 0.5) / settings.size as f32);
        let direction = mapping::galaxy_uv_to_direction(clamp_to_sphere(uv));
        let place = frame.place(direction);
        brightness(&place, direction, settings.dust, &clouds, &dust)
    });
    filter::gaussian_blur(&sharp, SMOOTH_TEXELS, Edge::Mirror)
}

/// The square's corners touch the nadir, where the mapping ends: they are held just inside.
fn clamp_to_sphere(uv: [f32; 2]) -> [f32; 2] {
    let [dx, dy] = uv.map(|c| c - 0.5);
    let r = libm::sqrtf(dx * dx + dy * dy);
    // The nadir lies at the distance 1/sqrt(2) in texture coordinates.
    let scale = if r > 0.7 { 0.7 / r } else { 1.0 };
    [0.5 + dx * scale, 0.5 + dy * scale]
}

/// The galaxy's own axes: towards the bulge, along the plane, and the plane's pole.
struct Frame {
    bulge: [f32; 3],
    along: [f32; 3],
    pole: [f32; 3],
}

/// A direction in galactic coordinates, in radians.
struct Place {
    /// From the bulge along the plane, -pi..pi.
    longitude: f32,
    /// From the plane towards its pole.
    latitude: f32,
}

impl Frame {
    fn new(settings: &GalaxySettings) -> Frame {
        let node = mapping::direction_from_angles(settings.azimuth_rad, 0.0);
        let (sin, cos) = (libm::sinf(settings.tilt_rad), libm::cosf(settings.tilt_rad));
        // A quarter turn from the node within the plane, where the band stands highest.
        let high = [-node[2] * cos, sin, node[0] * cos];
        let pole = cross(node, high);
        let (s, c) = (libm::sinf(BULGE_ANGLE_RAD), libm::cosf(BULGE_ANGLE_RAD));
        let bulge = [0, 1, 2].map(|i| node[i] * c + high[i] * s);
        Frame {
            bulge,
            along: cross(pole, bulge),
            pole,
        }
    }

    fn place(&self, direction: [f32; 3]) -> Place {
        Place {
            longitude: libm::atan2f(dot(direction, self.along), dot(direction, self.bulge)),
            latitude: libm::asinf(dot(direction, self.pole).clamp(-1.0, 1.0)),
        }
    }
}

fn brightness(
    place: &Place,
    direction: [f32; 3],
    dust: f32,
    cloud_noise: &Noise3,
    dust_noise: &Noise3,
) -> f32 {
    let towards_bulge = 0.5 + 0.5 * libm::cosf(place.longitude);
    // The band wavers by a few degrees.
    let latitude = place.latitude + 0.035 * cloud_noise.fractal(direction, 1.7, 2);
    let width = 0.15 + 0.08 * towards_bulge * towards_bulge;
    let q = latitude / width;
    let band = (0.32 + 0.40 * towards_bulge * towards_bulge)
        * libm::expf(1.0 - libm::sqrtf(1.0 + 3.0 * q * q));
    let bulge = 0.95 * gaussian(place.longitude / 0.30) * gaussian(latitude / 0.17);
    // Star clouds: their brightness is spread as a product of many chances is, so the noise is an exponent.
    let patches = libm::expf(0.9 * cloud_noise.fractal(direction, 3.3, 3));
    let depth = dust * optical_depth(place, direction, dust_noise);
    let shine = (band + bulge) * patches * libm::expf(-depth);
    // A long exposure's shoulder: bright parts do not burn out.
    1.0 - libm::expf(-1.7 * shine)
}

/// Optical depth of the dust at full strength: a dense lane and a wider, torn layer about it.
fn optical_depth(place: &Place, direction: [f32; 3], noise: &Noise3) -> f32 {
    let latitude = place.latitude - 0.015 + 0.075 * noise.fractal(direction, 2.3, 3);
    let towards_bulge = smoothstep(-0.6, 1.0, libm::cosf(place.longitude));
    let clumps = libm::expf(1.6 * noise.fractal(direction, 3.8, 3));
    let lane = 1.5 * gaussian(latitude / (0.035 + 0.025 * towards_bulge));
    let layer = 0.5 * gaussian(latitude / 0.13) * clumps;
    (0.3 + 0.7 * towards_bulge) * (lane * (0.7 + 0.3 * clumps) + layer)
}

fn gaussian(x: f32) -> f32 {
    libm::expf(-0.5 * x * x)
}

fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// Gradient noise in space: the `noise` crate's kernel over a shuffled table of our own random stream.
struct Noise3 {
    shuffled: [u8; 256],
}

impl Noise3 {
    fn new(stream: &mut Stream) -> Noise3 {
        let mut shuffled = [0_u8; 256];
        for (i, value) in shuffled.iter_mut().enumerate() {
            *value = i as u8;
        }
        // Fisher and Yates; 64 random bits make the remainder's bias too small to matter.
        for last in (1..shuffled.len()).rev() {
            shuffled.swap(last, (stream.bits() % (last as u64 + 1)) as usize);
        }
        Noise3 { shuffled }
    }

    /// `octaves` octaves, each half as strong as the one before, of noise with `cells` cells a unit of length.
    fn fractal(&self, [x, y, z]: [f32; 3], cells: f64, octaves: u32) -> f32 {
        let (mut sum, mut amplitude, mut cells) = (0.0, 1.0, cells);
        for _ in 0..octaves {
            // The offset keeps the poles of the axes, where all octaves would vanish, off the sphere.
            let point = [x, y, z].map(|c| f64::from(c) * cells + 31.37);
            sum += amplitude * perlin_3d(Vector3::new(point[0], point[1], point[2]), self);
            amplitude *= 0.5;
            cells *= 2.03;
        }
        sum as f32
    }
}

impl NoiseHasher for Noise3 {
    fn hash(&self, point: &[isize]) -> usize {
        let mix = |hash: u8, c: &isize| self.shuffled[usize::from(hash ^ *c as u8)];
        usize::from(point.iter().fold(0, mix))
    }
}

//! The day gradient: radiance of the clear sky over time of day and elevation, and how much night shows.
//!
//! # Theory
//! Sunlight scattered once by air and haze is integrated along every line of sight through a spherical
//! atmosphere (E. Bruneton, F. Neyret, "Precomputed Atmospheric Scattering", EGSR 2008, eq. 3-6), with
//! ozone, and light scattered more often is taken as isotropic (S. Hillaire, "A Scalable and Production
//! Ready Sky and Atmosphere Rendering Technique", EGSR 2020, eq. 5-10). `sky/` holds the physics.
//!
//! A day spans seven powers of ten in brightness. The eye follows it, but not wholly: what is a factor of
//! c in light is felt as about c^(1/3) (J. Tumblin, H. Rushmeier, "Tone Reproduction for Realistic Images",
//! IEEE CG&A 13(6), 1993, after S. S. Stevens). So each column is scaled by one number, which makes its
//! mean luminance that power of the physical one. Within a column the eye adapts far less: luminance is
//! raised to a power a little below one there. Hues stay as they are.
//!
//! # Changes versus the papers
//! The light is averaged over azimuths away from the sun, since the texture has no azimuth; the runtime
//! adds the glow around the sun. A constant airglow is added, so that the night is not black.
//!
//! # Practice
//! Columns are symmetric about noon and computed once.

mod atmosphere;
mod geometry;
mod spectrum;
mod table;

use rayon::prelude::*;
use welkin_pack::{Image, mapping};

use crate::settings::SkySettings;
use atmosphere::{Atmosphere, Line};
use spectrum::Colour;

/// Cosines of the angles between the sun's azimuth and the lines of sight that are averaged, with weights.
const AZIMUTHS: [(f32, f32); 3] = [(0.6, 0.35), (-0.1, 0.35), (-0.9, 0.30)];

/// Exponent of the eye's adaptation to the time of day.
const ADAPTATION: f32 = 0.36;

/// Exponent of the eye's adaptation within one sky.
const LOCAL_ADAPTATION: f32 = 0.75;

/// Least luminance that the eye adapts to, as a share of noon's: full night, where nothing of the sun is left.
const DARKEST: f32 = 1e-7;

/// Mean luminance, over the rows, of the sky with the sun 60 degrees high: what makes that sky's zenith
/// about (0.10, 0.22, 0.50).
const NOON_LUMINANCE: f32 = 0.45;

/// Sine of the sun's elevation to which all adaptation refers: 60 degrees.
const REFERENCE_SIN: f32 = 0.866_025_4;

/// Airglow at the zenith and on the horizon, in stored units: dark blue, as a night looks to the eye.
const AIRGLOW: [[f32; 3]; 2] = [[0.0038, 0.0066, 0.0150], [0.0066, 0.0100, 0.0190]];

/// Four channels: linear BT.709 red, green, blue, and the share of the night sky that shows.
pub(crate) fn image(settings: &SkySettings, noon_elevation_rad: f32) -> Image {
    let (width, height) = (settings.width, settings.height);
    let day = Day::new(settings.haze, height);
    let half: Vec<Vec<[f32; 4]>> = (0..=width / 2)
        .into_par_iter()
        .map(|x| {
            let sun = mapping::sun_direction(x as f32 / width as f32, noon_elevation_rad);
            day.adapted(&day.column(sun[1]), sun[1])
        })
        .collect();
    let mut image = Image::new(width, height, 4);
    for y in 0..height {
        for x in 0..width {
            let texel = half[x.min(width - x) as usize][y as usize];
            image.texel_mut(x, y).copy_from_slice(&texel);
        }
    }
    image
}

struct Day {
    atmosphere: Atmosphere,
    colour: Colour,
    /// One a row, from horizon to zenith.
    lines: Vec<Line>,
    /// Mean luminance with the sun at the reference elevation.
    reference: f32,
}

impl Day {
    fn new(haze: f32, height: u32) -> Day {
        let atmosphere = Atmosphere::new(haze);
        let view_sin = |y: u32| mapping::texel_to_sky([0.0, y as f32], 1, height).1;
        let lines = (0..height).map(|y| atmosphere.line(view_sin(y))).collect();
        let mut day = Day {
            atmosphere,
            colour: Colour::new(),
            lines,
            reference: 1.0,
        };
        day.reference = mean_luminance(&day.column(REFERENCE_SIN));
        day
    }

    /// Radiance from horizon to zenith, as a share of the sun's irradiance.
    fn column(&self, sun_sin: f32) -> Vec<[f32; 3]> {
        let light = |line| {
            self.colour
                .rgb(&self.atmosphere.radiance(line, sun_sin, &AZIMUTHS))
        };
        self.lines.iter().map(light).collect()
    }

    fn adapted(&self, column: &[[f32; 3]], sun_sin: f32) -> Vec<[f32; 4]> {
        let mean = mean_luminance(column).max(DARKEST * self.reference);
        let scale = NOON_LUMINANCE * libm::powf(mean / self.reference, ADAPTATION);
        let night = mapping::night_share(sun_sin);
        let last = (column.len() - 1) as f32;
        let texel = |(y, light): (usize, &[f32; 3])| {
            let low = 1.0 - y as f32 / last;
            // Below a thousandth of the mean nothing is seen: the floor keeps the power finite there.
            let relative = (luminance(light) / mean).max(1e-3);
            let local = scale / mean * libm::powf(relative, LOCAL_ADAPTATION - 1.0);
            let rgb = |c: usize| {
                light[c] * local + AIRGLOW[0][c] + (AIRGLOW[1][c] - AIRGLOW[0][c]) * low * low
            };
            [rgb(0), rgb(1), rgb(2), night]
        };
        column.iter().enumerate().map(texel).collect()
    }
}

/// ITU-R BT.709-6, item 3.2.
fn luminance([r, g, b]: &[f32; 3]) -> f32 {
    0.2126 * r + 0.7152 * g + 0.0722 * b
}

/// Luminance averaged over the rows; their spacing gives the low sky, where eyes look, more weight.
fn mean_luminance(column: &[[f32; 3]]) -> f32 {
    column.iter().map(luminance).sum::<f32>() / column.len() as f32
}

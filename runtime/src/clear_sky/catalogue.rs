//! Stars of a catalogue, each where it stands, as bright as it is and of its colour.
//!
//! # Theory
//! *Place.* A record tells right ascension and declination to 0.003 degrees. The CPU turns it as the date and place, or the plain time, have it, lifts it
//! through the air and projects it: a star is at a place between pixels, not in a texel, and stays there at any resolution.
//!
//! *Light.* Magnitude to light by Pogson's law; an intensity of 1 is of magnitude 0. The air takes of each colour what it takes of the sun's at that height
//! ([`welkin_pack::air::sun_transmittance`]). What is then fainter than an eye sees fades ([`eye`](super::eye)).
//!
//! *Shape.* A point, and a wing of what is bright: [`spread`](super::spread).
//!
//! *Colour.* B-V to a temperature (F. J. Ballesteros 2012), and that of a black body (M. Planck) as a camera with its white set to
//! daylight sees it, less what eyes lose of colour by night.
//!
//! *Flicker.* As the stars of the pack's texture, with an amplitude that grows as the air mass to 11/12 (V. I. Tatarskii, "The effects of the
//! turbulent atmosphere on wave propagation", 1971: the variance of a small aperture as the secant to 11/6).
//!
//! # Practice
//! The CPU looks at every star once a frame, the brightest first, until none is bright enough: some 0.2 milliseconds for 5,000 stars. A pixel reads the list of
//! its cell: one texel, and two for every star nearby.

use glam::{DMat3, Mat3, Vec2, Vec3};
use welkin_pack::air::{Colour, SUN, Spectrum, WAVELENGTHS_NM, sun_transmittance};
use welkin_pack::starlight::{light_of_magnitude, temperature_k};
use welkin_pack::{CatalogueStar, StarTexel, Texture};

use super::cells::{Cells, Spot, WIDTH};
use super::eye;
use super::light::NIGHT_GREY;
use super::spread::{self, Screen};
use crate::almanac::refraction::lift;
use crate::geometry::camera::CameraUniforms;
use crate::geometry::math::luminance;
use crate::geometry::part::{Part, Value};
use crate::geometry::uniforms::uniforms;

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[("CATALOGUE_WIDTH", Value::U32(WIDTH as u32))],
    structs: &[CatalogueUniforms::WGSL],
    wgsl: include_str!("catalogue.wgsl"),
};

uniforms! {
    /// Stars of a catalogue.
    CatalogueUniforms {
        /// Cells of the screen a pixel, each way.
        cells_a_pixel: Vec2,
        /// Column and row of the last of them.
        last_cell: Vec2,
        /// Cells a row.
        columns: f32,
        /// Nothing.
        _pad: f32,
        /// Nothing.
        _pad2: Vec2,
    }
}

/// Where a star off the screen is that no longer reaches it, in pixels.
const FARTHEST_PX: f32 = spread::FARTHEST_PX;
/// The most of its light by which a star flickers.
const MOST_FLICKER: f32 = 0.8;

/// A star.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Star {
    /// Unit vector of the equator of J2000: x to right ascension 0, z to the pole.
    pub direction: Vec3,
    /// Visual magnitude.
    pub magnitude: f32,
    /// Its light outside the air, linear BT.709, over that of a white star of magnitude 0.
    pub light: Vec3,
    /// As the record has them.
    flicker: [u8; 3],
}

/// The stars of a pack, the brightest first.
#[derive(Clone, Debug, PartialEq)]
pub struct Catalogue {
    /// All of them.
    pub stars: Vec<Star>,
}

/// The night over a place, as stars are drawn in it.
#[derive(Clone, Debug, PartialEq)]
pub struct NightSky {
    /// From the equator of J2000 to the world, airless.
    pub turn: Mat3,
    /// Radiance of a star of magnitude 0 that falls on one pixel.
    pub one: f32,
    /// Magnitude of the faintest star that is seen.
    pub faintest: f32,
    /// What the air leaves.
    pub air: Air,
    /// The screen, which gives stars their shape.
    pub screen: Screen,
    /// The moment, which makes them flicker.
    pub seconds: f64,
}

impl Catalogue {
    /// Reads the texture of the role `catalogue`.
    pub fn new(texture: &Texture) -> Catalogue {
        let bytes = texture.levels.first().map_or(&[][..], Vec::as_slice);
        let texels = texture.width as usize * texture.height as usize;
        let texel = |layer: usize, i: usize| -> [u8; 4] {
            let at = 4 * (layer * texels + i);
            std::array::from_fn(|byte| bytes.get(at + byte).copied().unwrap_or(0))
        };
        let colours: Vec<Vec3> = (0..=255)
            .map(|step| colour(f64::from(step) / 100.0 - 0.4))
            .collect();
        let records = (0..texels).map(|i| [0, 1, 2].map(|layer| texel(layer, i)));
        let stars = records
            .take_while(|record| record[1][3] == CatalogueStar::IS_STAR)
            .map(|record| {
                let star = CatalogueStar::decode(record);
                let [ra, dec] =
                    [star.right_ascension_deg, star.declination_deg].map(f64::to_radians);
                Star {
                    direction: crate::almanac::frames::of_angles(ra, dec).as_vec3(),
                    magnitude: star.magnitude as f32,
                    light: colours[usize::from(record[1][2])]
                        * light_of_magnitude(star.magnitude) as f32,
                    flicker: [star.rate, star.variance, star.phase],
                }
            })
            .collect();
        Catalogue { stars }
    }

    /// The stars that are seen on the screen.
    pub fn spots<'a>(
        &'a self,
        night: &'a NightSky,
        camera: &'a CameraUniforms,
    ) -> impl Iterator<Item = Spot> + 'a {
        // Nothing stands higher than the zenith, so nothing is dimmed by less.
        let end = eye::end(night.faintest) - night.air.magnitudes(1.0);
        let stars = self
            .stars
            .iter()
            .take_while(move |star| star.magnitude < end);
        stars.filter_map(|star| spot(star, night, camera))
    }
}

/// A star above the horizon and before the camera that is bright enough to be seen.
pub fn spot(star: &Star, night: &NightSky, camera: &CameraUniforms) -> Option<Spot> {
    let airless = night.turn * star.direction;
    let direction = (airless + Vec3::Y * lift(airless.y)).normalize();
    let pixel = camera.pixel_of(direction)?;
    let size_px = Vec2::new(camera.width_px, camera.height_px);
    let outside = (pixel - size_px).max(-pixel).max_element();
    if outside > FARTHEST_PX {
        return None;
    }
    let through = night.air.transmittance(direction.y);
    let seen_magnitude = star.magnitude + night.air.magnitudes(direction.y);
    let share = eye::share(night.faintest, seen_magnitude);
    if share <= 0.0 {
        return None;
    }
    let flicker = flickering(star.flicker, direction.y, night.seconds);
    let light = star.light * through * (night.one * share);
    Some(Spot {
        pixel,
        light: light * flicker,
        spread: night.screen.spread(luminance(light)),
    })
}

/// The uniforms of a screen.
pub fn uniforms(cells: Cells) -> CatalogueUniforms {
    let [columns, rows] = cells.counts.map(|count| count as f32);
    CatalogueUniforms {
        cells_a_pixel: cells.a_pixel,
        last_cell: Vec2::new(columns, rows) - 1.0,
        columns,
        ..Default::default()
    }
}

/// The factor by which a star's light flickers at a moment, `1 + a sin(2 pi (rate t + phase))`.
fn flickering([rate, variance, phase]: [u8; 3], sine: f32, seconds: f64) -> f32 {
    // G. V. Rozenberg, "Twilight", 1966.
    let air_mass = 1.0 / (sine + 0.025 * libm::expf(-11.0 * sine));
    let amplitude = f32::from(variance) / 255.0 * libm::powf(air_mass, 11.0 / 12.0);
    let turns = f64::from(rate) / StarTexel::PERIOD_S * seconds + f64::from(phase) / 256.0;
    let angle = std::f64::consts::TAU * (turns - turns.floor());
    1.0 + amplitude.min(MOST_FLICKER) * libm::sinf(angle as f32)
}

/// What the air leaves of starlight at a height, by a table over the square root of the sine.
#[derive(Clone, Debug, PartialEq)]
pub struct Air {
    steps: Vec<Vec3>,
}

/// Steps of the table: between two of them light changes by a fifth at the horizon, and by thousandths overhead.
const STEPS: usize = 64;

impl Air {
    /// With an optical depth of the aerosol.
    pub fn new(aerosol_depth: f32) -> Air {
        let colour = Colour::daylight();
        let whole = Vec3::from(colour.rgb(&[1.0; welkin_pack::air::COUNT]));
        let step = |i: usize| {
            let root = i as f32 / (STEPS - 1) as f32;
            let elevation_rad = libm::asinf(root * root);
            Vec3::from(colour.rgb(&sun_transmittance(elevation_rad, aerosol_depth))) / whole
        };
        Air {
            steps: (0..STEPS).map(step).collect(),
        }
    }

    /// The share of red, green and blue that comes through from a height, told by its sine.
    pub fn transmittance(&self, sine: f32) -> Vec3 {
        let place = sine.clamp(0.0, 1.0).sqrt() * (STEPS - 1) as f32;
        let first = (place as usize).min(STEPS - 2);
        self.steps[first].lerp(self.steps[first + 1], place - first as f32)
    }

    /// What it takes of white light, in magnitudes.
    pub fn magnitudes(&self, sine: f32) -> f32 {
        -2.5 * libm::log10f(luminance(self.transmittance(sine)).max(1e-30))
    }
}

/// Linear BT.709 of a B-V, of luminance 1, as eyes see it by night: less of a colour.
///
/// M. Planck, "Ueber das Gesetz der Energieverteilung im Normalspectrum", Annalen der Physik 309, 1901.
pub fn colour(colour_index: f64) -> Vec3 {
    let kelvin = temperature_k(colour_index);
    // Second radiation constant, in nanometres and kelvin: CODATA 2018.
    const C2: f64 = 1.438_776_877e7;
    let planck = |nm: f64, kelvin: f64| nm.powi(-5) / libm::expm1(C2 / (nm * kelvin));
    // As a share of the sun's light, of which the baker's spectra are.
    let spectrum: Spectrum = std::array::from_fn(|i| {
        let nm = f64::from(WAVELENGTHS_NM[i]);
        (planck(nm, kelvin) / planck(560.0, kelvin) / f64::from(SUN[i])) as f32
    });
    let rgb = Vec3::from(Colour::daylight().rgb(&spectrum)).max(Vec3::ZERO);
    (rgb / luminance(rgb).max(1e-6)).lerp(Vec3::ONE, NIGHT_GREY)
}

/// The turn of a sky as the pack's own day has it: that of the March equinox, when the sun stands at right ascension 0, at the latitude at which it is so high
/// at noon.
pub fn turn_of_time(time: f32, noon_elevation_rad: f32) -> DMat3 {
    let latitude_deg = 90.0 - noon_elevation_rad.to_degrees();
    let hour_angle = std::f64::consts::TAU * (f64::from(time) - 0.5);
    crate::almanac::stars::turn_at(hour_angle, latitude_deg)
}

#[cfg(test)]
mod tests;

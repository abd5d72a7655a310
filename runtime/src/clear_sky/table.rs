//! The clear sky of [`crate::params::SkyModel::Table`]: the pack's table, read at the sun's elevation.
//!
//! # Theory
//! The baker computed radiance for each elevation of the sun, over elevation of view and azimuth from the sun; the aureole apart, as the
//! light that the aerosol's phase function is multiplied by: see [`welkin_pack::mapping::sky_to_texel`]. Between suns and between
//! hazes everything is linear, so a frame needs one layer, the mean of four, which the CPU makes ([`SkyView`]). By night it is the
//! sky of the full moon: the same air, lit by less.
//!
//! # Changes versus the paper
//! Roden and Parberry blend one blue gradient with the night; this one knows the hour and the side of the sun. Under an overcast sky there
//! is no blue left to see: it takes the mean colour of the clouds.
//!
//! # Practice
//! What the aureole is multiplied by hardly has an azimuth while the sun is up: a frame keeps its colour by elevation below the sun, and by direction how much
//! of it there is, as the alpha of the radiance. Both are in one picture ([`crate::clear_sky::picture`]).
//!
//! A view is some 30 microseconds of one core and its picture some 60, with 26 KB to upload, when hour or haze change; a pixel reads it twice and takes
//! a root and a reciprocal one, near the sun two.

use glam::{Vec2, Vec3};
use half::f16;
use welkin_pack::air::AUREOLE_LOBES;
use welkin_pack::mapping::{
    SKY_HAZES, SKY_PARTS, SkyLayer, sky_to_texel, sun_to_layer, texel_to_sky,
};
use welkin_pack::{Image, Texture};

use crate::clear_sky::picture::{self, BEND, Places};
use crate::geometry::math::luminance;
use crate::geometry::part::{Part, Value};
use crate::geometry::uniforms::uniforms;

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[
        ("AUREOLE_END", Value::F32(AUREOLE_END)),
        ("AUREOLE_LEAST", Value::F32(AUREOLE_LEAST)),
        ("AUREOLE_WIDE", Value::Vec2(lobe(AUREOLE_LOBES[1]))),
        ("SKY_BEND", Value::F32(BEND)),
        ("AUREOLE_NARROW", Value::Vec2(lobe(AUREOLE_LOBES[0]))),
    ],
    structs: &[SkyUniforms::WGSL],
    wgsl: include_str!("table.wgsl"),
};

uniforms! {
    /// Clear sky.
    SkyUniforms {
        /// Unit direction towards the sun, or by night the moon.
        sun_direction: Vec3,
        /// Weight of the night sky.
        night: f32,
        /// Radiance of an overcast sky.
        overcast: Vec3,
        /// How far the sky is overcast.
        overcast_weight: f32,
        /// Texture coordinates of a direction that goes neither to the sun's azimuth nor up.
        start: Vec2,
        /// How far they go with each.
        span: Vec2,
        /// Texture coordinate of the aureole's colour.
        aureole_u: f32,
        /// How much brighter a storm is at the horizon, where light comes in from beyond it.
        slit: f32,
        /// Unit vector (east, south) of the azimuth that the picture has at its side.
        azimuth: Vec2,
    }
}

/// Cosine of 25 degrees from the sun, where the narrow lobe ends in the shader: there it is a thousandth of the wide one.
pub const AUREOLE_END: f32 = 0.906_307_8;
/// Its value there, which is taken off it so that it ends without an edge.
pub const AUREOLE_LEAST: f32 = 4.197e-4;

/// The earth's radius over that of the layer of airglow, 90 km higher.
const AIRGLOW_RADII: f32 = 6371.0 / 6461.0;
/// Optical depth of air as eyes see at night.
const AIRGLOW_DEPTH: f32 = 0.12;

/// Of a lobe of the aureole, `(a - b cosine)^-1.5`: a and b.
const fn lobe([weight, g]: [f32; 2]) -> [f32; 2] {
    // w (1 - g^2) / (4 pi) is the -1.5th power of what base (1 + g^2 - 2 g cosine) is multiplied by: a third root squared, by Newton's steps,
    // as none is const.
    let scale = weight * (1.0 - g * g) / (4.0 * std::f32::consts::PI);
    let mut root = 1.0_f32;
    let mut i = 0;
    while i < 40 {
        root = (2.0 * root + scale / (root * root)) / 3.0;
        i += 1;
    }
    let factor = 1.0 / (root * root);
    [factor * (1.0 + g * g), factor * 2.0 * g]
}

/// The phase function of a lobe of the aureole, 0 the narrow one, 1 the wide one: as the shader has them before the narrow one ends.
pub fn aureole_lobe(index: usize, cosine: f32) -> f32 {
    const LOBES: [[f32; 2]; 2] = [lobe(AUREOLE_LOBES[0]), lobe(AUREOLE_LOBES[1])];
    let [a, b] = LOBES[index];
    let beyond = a - b * cosine.min(1.0);
    1.0 / (beyond * beyond.sqrt())
}

/// The pack's table.
#[derive(Clone, Debug, PartialEq)]
pub struct SkyTable {
    size: [u32; 2],
    suns: u32,
    /// Optical depths of the aerosol.
    pub aerosol_depths: [f32; 2],
    /// Texels, layer after layer.
    texels: Vec<Vec3>,
    /// Sine of the elevation of each row.
    sines: Vec<f32>,
    /// Cosine of the azimuth from the sun of each column.
    azimuth_cosines: Vec<f32>,
    /// Solid angle of each texel of a layer, both sides of the sun together.
    weights: Vec<f32>,
}

impl SkyTable {
    /// Decodes the texture of the role `sky`.
    pub fn new(texture: &Texture, aerosol_depths: [f32; 2]) -> SkyTable {
        let layers = (0..texture.layers).map(|layer| texture.image(0, layer));
        let texels = layers.flat_map(|image| {
            let texels = image.texels.chunks_exact(4);
            texels
                .map(|t| Vec3::new(t[0], t[1], t[2]))
                .collect::<Vec<_>>()
        });
        let size = [texture.width, texture.height];
        SkyTable {
            size,
            suns: texture.layers / (SKY_HAZES * SKY_PARTS),
            aerosol_depths,
            texels: texels.collect(),
            sines: (0..size[1])
                .map(|y| texel_to_sky([0.0, y as f32], size).0)
                .collect(),
            azimuth_cosines: (0..size[0])
                .map(|x| texel_to_sky([x as f32, 0.0], size).1.clamp(-1.0, 1.0))
                .collect(),
            weights: solid_angles(size),
        }
    }

    /// Optical depth of the aerosol at a haze of 0..1.
    pub fn aerosol_depth(&self, haze: f32) -> f32 {
        let [clear, hazy] = self.aerosol_depths;
        clear + (hazy - clear) * haze
    }

    /// The sky with the sun at an elevation, and a haze of 0..1.
    pub fn view(&self, sun_elevation_rad: f32, haze: f32) -> SkyView {
        let place = sun_to_layer(sun_elevation_rad, self.suns);
        let sun = (place as u32).min(self.suns - 2);
        let share = place - sun as f32;
        let texels = (self.size[0] * self.size[1]) as usize;
        let part = |part| {
            let layer = |haze, sun| {
                let start = SkyLayer { haze, sun, part }.index(self.suns) as usize * texels;
                &self.texels[start..start + texels]
            };
            let [[a, b], [c, d]] = [0, 1].map(|haze| [sun, sun + 1].map(|sun| layer(haze, sun)));
            let between = |i: usize| a[i].lerp(b[i], share).lerp(c[i].lerp(d[i], share), haze);
            (0..texels).map(between).collect()
        };
        SkyView {
            size: self.size,
            radiance: part(0),
            aureole: part(1),
        }
    }

    /// Mean radiance over the hemisphere, and irradiance of a horizontal plane over pi, of a view with the sun at that elevation.
    pub fn means(&self, view: &SkyView, sun_elevation_rad: f32) -> [Vec3; 2] {
        let (sun_sin, sun_cos) = sun_elevation_rad.sin_cos();
        let (mut mean, mut horizontal, mut whole) = (Vec3::ZERO, Vec3::ZERO, 0.0);
        for at in self.samples(view) {
            let flat = (1.0 - at.sine * at.sine).max(0.0).sqrt();
            let cosine = (at.sine * sun_sin + flat * sun_cos * at.azimuth_cos).clamp(-1.0, 1.0);
            let phase = aureole_lobe(0, cosine) + aureole_lobe(1, cosine);
            let light = at.radiance + at.aureole * phase;
            mean += light * at.solid_angle;
            horizontal += light * (at.solid_angle * at.sine);
            whole += at.solid_angle;
        }
        [mean / whole, horizontal / std::f32::consts::PI]
    }
}

/// A texel of a view, for the sky on both sides of the sun.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkySample {
    /// Sine of the elevation.
    pub sine: f32,
    /// Cosine of the azimuth from the sun.
    pub azimuth_cos: f32,
    /// Solid angle of both sides together, in steradians.
    pub solid_angle: f32,
    /// Radiance without the aureole.
    pub radiance: Vec3,
    /// What the aureole's phase function is multiplied by.
    pub aureole: Vec3,
}

impl SkyTable {
    /// How many azimuths a row has.
    pub fn azimuths(&self) -> usize {
        self.size[0] as usize
    }

    /// The texels of a view, row by row from the horizon to the zenith.
    pub fn samples<'a>(&'a self, view: &'a SkyView) -> impl Iterator<Item = SkySample> + 'a {
        let [width, _] = self.size;
        self.weights
            .iter()
            .enumerate()
            .map(move |(i, &solid_angle)| {
                let width = width as usize;
                SkySample {
                    sine: self.sines[i / width],
                    azimuth_cos: self.azimuth_cosines[i % width],
                    solid_angle,
                    radiance: view.radiance[i],
                    aureole: view.aureole[i],
                }
            })
    }
}

/// Solid angles of the texels of a layer: each reaches half way to its neighbours.
fn solid_angles(size: [u32; 2]) -> Vec<f32> {
    let [width, height] = size;
    let around = |i: u32, last: u32| [(i as f32 - 0.5).max(0.0), (i as f32 + 0.5).min(last as f32)];
    let azimuth = |x: f32| texel_to_sky([x, 0.0], size).1.clamp(-1.0, 1.0).acos();
    let sine = |y: f32| texel_to_sky([0.0, y], size).0;
    let mut weights = Vec::with_capacity((width * height) as usize);
    for (y, x) in (0..height).flat_map(|y| (0..width).map(move |x| (y, x))) {
        let [left, right] = around(x, width - 1).map(azimuth);
        let [low, high] = around(y, height - 1).map(sine);
        weights.push(2.0 * (right - left) * (high - low));
    }
    weights
}

/// The clear sky of a moment.
#[derive(Clone, Debug, PartialEq)]
pub struct SkyView {
    /// Azimuths and elevations.
    size: [u32; 2],
    /// Without the aureole.
    radiance: Vec<Vec3>,
    /// What its phase function is multiplied by.
    aureole: Vec<Vec3>,
}

impl SkyView {
    /// Dims it by a colour.
    pub fn scaled(mut self, colour: Vec3) -> SkyView {
        for light in self.radiance.iter_mut().chain(&mut self.aureole) {
            *light *= colour;
        }
        self
    }

    /// Takes some of its colour, 0..1.
    pub fn faded(mut self, share: f32) -> SkyView {
        for light in self.radiance.iter_mut().chain(&mut self.aureole) {
            *light = light.lerp(Vec3::splat(luminance(*light)), share);
        }
        self
    }

    /// Adds light that comes from a thin layer of high air, of that radiance straight up.
    ///
    /// A layer at 90 km is seen the longer way through the lower it is (P. J. van Rhijn, "On the brightness of the sky at night and the total
    /// amount of starlight", 1921), and air takes the more of it (air mass by G. V. Rozenberg, "Twilight", 1966).
    pub fn add_airglow(&mut self, radiance: Vec3) {
        let [width, height] = self.size;
        for y in 0..height {
            let sine = texel_to_sky([0.0, y as f32], self.size).0;
            let level = AIRGLOW_RADII * AIRGLOW_RADII * (1.0 - sine * sine);
            let air_mass = 1.0 / (sine + 0.025 * (-11.0 * sine).exp());
            let seen =
                radiance * ((-AIRGLOW_DEPTH * (air_mass - 1.0)).exp() / (1.0 - level).sqrt());
            let row = (y * width) as usize;
            for light in &mut self.radiance[row..row + width as usize] {
                *light += seen;
            }
        }
    }

    /// Adds the sky of a luminary opposite, without its aureole.
    pub fn add_opposite(&mut self, other: &SkyView) {
        let [width, height] = self.size;
        for y in 0..height {
            for x in 0..width {
                // The sine of half the azimuth from the one is the cosine of half that from the other.
                let (sine, azimuth_cos) = texel_to_sky([x as f32, y as f32], self.size);
                let [u, _] = sky_to_texel(sine, -azimuth_cos, self.size);
                let left = (u as u32).min(width - 2);
                let row = (y * width) as usize;
                let [a, b] = [left, left + 1].map(|x| other.radiance[row + x as usize]);
                self.radiance[row + x as usize] += a.lerp(b, u - left as f32);
            }
        }
    }

    /// Adds another sky of the same side.
    pub fn add(&mut self, other: &SkyView) {
        for (light, more) in self.radiance.iter_mut().zip(&other.radiance) {
            *light += *more;
        }
    }

    /// Evens it out around the horizon, row by row, by a share of 0..1: at 1 it has no side.
    pub fn level(&mut self, share: f32) {
        let width = self.size[0] as usize;
        // Columns of solid angle: the first and the last reach one way only.
        let azimuth = |x: f32| {
            let x = x.clamp(0.0, (width - 1) as f32);
            texel_to_sky([x, 0.0], self.size).1.clamp(-1.0, 1.0).acos()
        };
        let weights: Vec<f32> = (0..width)
            .map(|x| {
                (azimuth(x as f32 + 0.5) - azimuth(x as f32 - 0.5)).abs() / std::f32::consts::PI
            })
            .collect();
        for part in [&mut self.radiance, &mut self.aureole] {
            for row in part.chunks_exact_mut(width) {
                let mean: Vec3 = row.iter().zip(&weights).map(|(light, w)| *light * *w).sum();
                for light in row {
                    *light = light.lerp(mean, share);
                }
            }
        }
    }

    /// The picture that the shader reads.
    pub fn image(&self) -> Image {
        picture::image(self.size, &self.radiance, &self.aureole)
    }

    /// Size of that picture.
    pub fn image_size(table: &SkyTable) -> [u32; 2] {
        Places::new(table.size).size()
    }
}

/// The clear sky's share of the uniforms.
///
/// `direction` is that of the luminary, `azimuth` that of the view, `night` the share of the night sky that is drawn, `overcast` the radiance of an overcast sky,
/// `overcast_weight` how overcast it is, `slit` how much brighter that is at the horizon.
pub fn uniforms(
    view: &SkyView,
    direction: Vec3,
    azimuth: Vec2,
    night: f32,
    overcast: Vec3,
    overcast_weight: f32,
    slit: f32,
) -> SkyUniforms {
    let places = Places::new(view.size);
    let [start, span] = places.start_and_span();
    SkyUniforms {
        sun_direction: direction,
        night,
        overcast,
        overcast_weight,
        slit,
        start: start.into(),
        span: span.into(),
        aureole_u: places.aureole_u(),
        azimuth,
    }
}

/// Texel of a picture as the device stores it: four half floats.
pub(crate) fn halves(image: &Image) -> Vec<u8> {
    let bytes = |value: &f32| f16::from_f32(*value).to_le_bytes();
    image.texels.iter().flat_map(bytes).collect()
}

#[cfg(test)]
mod tests {
    use welkin_pack::air::aureole_phase;

    use super::*;

    #[test]
    fn lobes_are_those_of_the_phase_function() {
        for cosine in [-1.0_f32, -0.3, 0.5, 0.9, 0.999, 1.0] {
            let found = aureole_lobe(0, cosine) + aureole_lobe(1, cosine);
            // The narrow lobe's a is 1.000165 b: the difference keeps four digits.
            assert!(
                (found / aureole_phase(cosine) - 1.0).abs() < 2e-3,
                "{cosine}: {found}"
            );
        }
    }

    #[test]
    fn solid_angles_are_a_hemisphere() {
        let whole: f32 = solid_angles([16, 32]).iter().sum();
        assert!((whole - std::f32::consts::TAU).abs() < 1e-4, "{whole}");
    }
}

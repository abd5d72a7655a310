//! Image-based light: a cube map with levels for rough surfaces, and the irradiance beside it.
//!
//! Half floats end at 65504, and a sun does not. So radiance is divided by a power of two, which changes no digit, and which the texture's
//! key/value data and the JSON say: the radiance is `radiance_scale` times what a texel holds. The harmonics are not divided.

use serde::Serialize;
use welkin_pack::{Format, PackError, Shape, Texture, ktx};

use super::cube::FACES;
use super::cubemap::{Cubemap, halves};
use super::harmonics::{BASIS, COUNT, Harmonics};
use super::prefilter::{levels, roughness};

/// The largest half float.
const MOST: f32 = 65504.0;

/// What wrote a file.
const WRITER: &str = concat!("welkin-view ", env!("CARGO_PKG_VERSION"));

/// A sky as light on things.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// Radiance, from a mirror's to that of the roughest surface: see [`levels`].
    pub levels: Vec<Cubemap>,
    /// Irradiance.
    pub harmonics: Harmonics,
}

/// What the JSON says. The keys are those of docs/json.md.
#[derive(Debug, Serialize)]
struct Described<'a> {
    format: &'static str,
    version: u32,
    writer: &'static str,
    source: &'a str,
    texture: &'a str,
    primaries: &'static str,
    radiance_scale: f32,
    levels: Vec<Level>,
    irradiance: Irradiance,
}

#[derive(Debug, Serialize)]
struct Level {
    side: u32,
    perceptual_roughness: f32,
}

#[derive(Debug, Serialize)]
struct Irradiance {
    axes: &'static str,
    basis: [&'static str; COUNT],
    coefficients: [[f32; 3]; COUNT],
}

impl Light {
    /// The light of a sky.
    pub fn of(map: Cubemap) -> Light {
        Light {
            harmonics: Harmonics::of(&map),
            levels: levels(map),
        }
    }

    /// What a texel is multiplied by: the least power of two, 1 or more, that lets the brightest one fit.
    pub fn radiance_scale(&self) -> f32 {
        // Other levels are means of the first.
        let texels = self.levels[0].faces.iter().flat_map(|face| &face.texels);
        let brightest = texels.copied().fold(0.0, f32::max);
        let mut scale = 1.0;
        while brightest / scale > MOST && scale < f32::MAX / 2.0 {
            scale *= 2.0;
        }
        scale
    }

    /// The levels as a texture of RGBA half floats; alpha is 1.
    pub fn texture(&self) -> Texture {
        let scale = self.radiance_scale();
        let levels = self.levels.iter().map(|map| halves(&map.faces, scale));
        let side = self.levels[0].side;
        Texture {
            format: Format::Rgba16Float,
            shape: Shape::Cube,
            width: side,
            height: side,
            layers: FACES.len() as u32,
            levels: levels.collect(),
        }
    }

    /// The bytes of a KTX2 file, compressed with Zstandard. `file` names it in errors.
    ///
    /// # Errors
    /// [`PackError::Value`] if a level cannot be compressed.
    pub fn ktx2(&self, file: &str) -> Result<Vec<u8>, PackError> {
        let rough: Vec<String> = self.roughness().map(|r| r.to_string()).collect();
        let texts = [
            ("welkinPerceptualRoughness", rough.join(" ")),
            ("welkinRadianceScale", self.radiance_scale().to_string()),
        ];
        let texts = [0, 1].map(|i| (texts[i].0, texts[i].1.as_str()));
        ktx::encode_with(file, &self.texture(), WRITER, &texts)
    }

    /// The JSON that goes beside it. `source` and `texture` are names of files, without their folders.
    ///
    /// # Errors
    /// None that a number could cause; what the serialiser says.
    pub fn json(&self, source: &str, texture: &str) -> serde_json::Result<String> {
        let level = |(map, perceptual_roughness): (&Cubemap, f32)| Level {
            side: map.side,
            perceptual_roughness,
        };
        let described = Described {
            format: "welkin-image-based-light",
            version: 1,
            writer: WRITER,
            source,
            texture,
            primaries: "BT.709, linear",
            radiance_scale: self.radiance_scale(),
            levels: self
                .levels
                .iter()
                .zip(self.roughness())
                .map(level)
                .collect(),
            irradiance: Irradiance {
                axes: "x east, y up, z south",
                basis: BASIS,
                coefficients: self.harmonics.coefficients.map(|rgb| rgb.map(|c| c as f32)),
            },
        };
        serde_json::to_string_pretty(&described).map(|text| text + "\n")
    }

    fn roughness(&self) -> impl Iterator<Item = f32> {
        roughness(self.levels[0].side).into_iter()
    }
}

#[cfg(test)]
mod tests;

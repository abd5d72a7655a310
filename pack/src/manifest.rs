//! `pack.json`: what a pack says of itself.

mod field;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::error::PackError;
use crate::format::{Format, Shape};
use crate::read::verify_bytes;
use crate::role::{ChannelSpec, Filter, Role, Wrap};
use crate::texture::Texture;

pub use field::FieldEntry;

/// File name of the manifest in a pack.
pub const MANIFEST_FILE: &str = "pack.json";

/// The value of `kind`, by which a manifest is known.
pub const KIND: &str = "welkin-pack";

/// The version of the pack format that this crate reads and writes.
pub const VERSION: u64 = 7;

/// The most aerosol that a pack's sky may have: a sandstorm.
pub const MAX_AEROSOL_DEPTH: f32 = 2.0;

/// A pack's manifest. docs/pack-format.md describes every key.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Manifest {
    /// Always `welkin-pack`.
    pub kind: String,
    /// Version of the pack format.
    pub version: u64,
    /// Name of the pack, from its recipe.
    pub name: String,
    /// Seed of every random stream.
    pub seed: u64,
    /// The program that baked it, with its version.
    pub baker: String,
    /// Text of the recipe.
    pub recipe: String,
    /// Files that the recipe named, in its order.
    pub inputs: Vec<Input>,
    /// Elevation of the sun at noon, in radians; the textures were made for it.
    pub noon_elevation_rad: f32,
    /// Optical depths of the aerosol to the zenith at 550 nm that the clear sky was made for: without haze and with all of it.
    pub aerosol_depths: [f32; 2],
    /// The textures, in the order of [`Role::ALL`].
    pub textures: Vec<TextureEntry>,
    /// The clouds in space, if it has any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub field: Option<FieldEntry>,
    /// BLAKE3 of this file with these 64 digits set to `0`, in lower-case hexadecimal.
    pub seal: String,
}

/// A file that a recipe named.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Input {
    /// Key of the recipe that names it, such as `clouds.photo.file`.
    pub key: String,
    /// BLAKE3 of its bytes, in lower-case hexadecimal.
    pub blake3: String,
}

/// One texture of a pack.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TextureEntry {
    /// What it is for.
    pub role: Role,
    /// Its file, in the folder of the manifest.
    pub file: String,
    /// Texel format.
    pub format: Format,
    /// Arrangement of its images.
    pub shape: Shape,
    /// Texels a row of level 0.
    pub width: u32,
    /// Rows of level 0.
    pub height: u32,
    /// Images a level.
    pub layers: u32,
    /// Levels.
    pub levels: u32,
    /// How it is to be sampled.
    pub sampler: Sampler,
    /// Its channels in memory order.
    pub channels: Vec<Channel>,
    /// Bytes of the file.
    pub file_bytes: u64,
    /// BLAKE3 of the file, in lower-case hexadecimal: tells a damaged file.
    pub file_blake3: String,
    /// BLAKE3 of the decoded texels, level 0 first, in lower-case hexadecimal: the same whatever
    /// the compressor did.
    pub texels_blake3: String,
}

/// How a texture is to be sampled.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Sampler {
    /// Addressing outside 0..1, in both directions.
    pub wrap: Wrap,
    /// Filtering.
    pub filter: Filter,
}

/// One channel of a texture.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Channel {
    /// Name, unique in its texture.
    pub name: String,
    /// One sentence for people.
    pub meaning: String,
    /// Unit of the decoded value; `1` where it has none.
    pub unit: String,
    /// Decoded value of stored 0 and of stored 1; between them it is linear.
    pub range: [f32; 2],
    /// Mean of the stored values of level 0, over all texels.
    pub mean: f32,
    /// Standard deviation of the stored values of level 0.
    pub spread: f32,
    /// What it was made of, if it is fractal noise.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fractal: Option<FractalNoise>,
}

/// Octaves of gradient noise that tile, brought to a mean by a monotone curve.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FractalNoise {
    /// Lattice cells of the first octave across the tile.
    pub cells: u32,
    /// Octaves; each has twice the cells of the one before. Those of cells under six texels are left out.
    pub octaves: u32,
    /// Amplitude of an octave as a share of the one before, 0..1.
    pub gain: f32,
    /// The mean that the channel was brought to, 0..1.
    pub mean: f32,
}

impl Manifest {
    /// The JSON text, sealed.
    #[cfg(feature = "write")]
    pub(crate) fn to_json(&self) -> String {
        let mut unsealed = self.clone();
        unsealed.seal = "0".repeat(64);
        let mut text = serde_json::to_string_pretty(&unsealed).unwrap_or_default();
        text.push('\n');
        let seal = seal_of(&text);
        replace_seal(&text, &unsealed.seal, &seal).unwrap_or(text)
    }

    /// The files that a manifest's JSON text names, beside itself: for who has to fetch them before [`Pack::from_memory`](crate::Pack::from_memory). They
    /// are plain names, without folders. `file` names the manifest in errors.
    ///
    /// # Errors
    /// As for the manifest in [`Pack::open`](crate::Pack::open): version, seal, and what its roles ask.
    pub fn file_names(file: &str, bytes: &[u8]) -> Result<Vec<String>, PackError> {
        let manifest = Manifest::from_json(file, bytes)?;
        manifest.verify(file)?;
        let textures = manifest.textures.into_iter().map(|texture| texture.file);
        let field = manifest.field.into_iter().map(|field| field.file);
        Ok(textures.chain(field).collect())
    }

    /// Parses the JSON text and verifies its seal. `file` names it in errors.
    pub(crate) fn from_json(file: &str, bytes: &[u8]) -> Result<Manifest, PackError> {
        let manifest = Manifest::parse(file, bytes)?;
        manifest.verify_seal(file, bytes)?;
        Ok(manifest)
    }

    /// Parses the JSON text, after a look at its version.
    pub(crate) fn parse(file: &str, bytes: &[u8]) -> Result<Manifest, PackError> {
        let json_error = |e: serde_json::Error| PackError::Json {
            file: file.to_string(),
            line: e.line(),
            column: e.column(),
            message: e.to_string(),
        };
        refuse_other_versions(file, &serde_json::from_slice(bytes).map_err(json_error)?)?;
        serde_json::from_slice(bytes).map_err(json_error)
    }

    pub(crate) fn verify_seal(&self, file: &str, bytes: &[u8]) -> Result<(), PackError> {
        let unsealed = std::str::from_utf8(bytes)
            .ok()
            .and_then(|text| replace_seal(text, &self.seal, &"0".repeat(64)));
        let found = unsealed.map(|text| seal_of(&text));
        if found.as_deref() == Some(self.seal.as_str()) {
            return Ok(());
        }
        let expected = "the hash of the manifest: it was changed after the bake, bake again";
        Err(PackError::value(file, "seal", &self.seal, expected))
    }

    /// Verifies what the manifest says against what its roles ask. `file` names it in errors.
    pub(crate) fn verify(&self, file: &str) -> Result<(), PackError> {
        let noon = self.noon_elevation_rad;
        if !(noon > 0.0 && noon <= std::f32::consts::FRAC_PI_2) {
            let expected = "above 0 and up to pi/2";
            return Err(PackError::value(file, "noon_elevation_rad", noon, expected));
        }
        let [clear, hazy] = self.aerosol_depths;
        if !(clear >= 0.0 && clear < hazy && hazy <= MAX_AEROSOL_DEPTH) {
            let found = format!("[{clear}, {hazy}]");
            let expected = format!("two rising numbers from 0 to {MAX_AEROSOL_DEPTH}");
            return Err(PackError::value(file, "aerosol_depths", found, expected));
        }
        for (index, entry) in self.textures.iter().enumerate() {
            if self.textures[..index].iter().any(|e| e.role >= entry.role) {
                let key = format!("textures[{index}].role");
                return Err(PackError::value(
                    file,
                    &key,
                    entry.role.name(),
                    "one texture a role, in order",
                ));
            }
            entry.verify(file, index)?;
        }
        self.field
            .as_ref()
            .map_or(Ok(()), |field| field.verify(file))
    }

    /// The entry of a role.
    pub fn texture(&self, role: Role) -> Option<&TextureEntry> {
        self.textures.iter().find(|t| t.role == role)
    }
}

impl Channel {
    /// Verifies what it says against what its role asks; `at` is its key in the manifest.
    fn verify(&self, file: &str, at: &str, spec: &ChannelSpec) -> Result<(), PackError> {
        let range = |[low, high]: [f32; 2]| format!("{low} to {high}");
        let pairs = [
            ("meaning", self.meaning.clone(), spec.meaning.to_string()),
            ("unit", self.unit.clone(), spec.unit.to_string()),
            ("range", range(self.range), range(spec.range)),
        ];
        for (key, found, expected) in pairs {
            if found != expected {
                return Err(PackError::value(
                    file,
                    &format!("{at}.{key}"),
                    found,
                    expected,
                ));
            }
        }
        let is_sound = |noise: &FractalNoise| {
            let shares = [noise.gain, noise.mean];
            noise.cells > 0
                && noise.octaves > 0
                && shares.iter().all(|share| (0.0..=1.0).contains(share))
        };
        let (found, expected) = match (&self.fractal, spec.is_fractal) {
            (None, false) => return Ok(()),
            (Some(noise), true) if is_sound(noise) => return Ok(()),
            (Some(noise), true) => (
                format!("{noise:?}"),
                "a cell and an octave or more, gain and mean from 0 to 1",
            ),
            (None, true) => ("none".to_string(), "the octaves that it was made of"),
            (Some(_), false) => ("octaves".to_string(), "none, as it is no fractal noise"),
        };
        let key = format!("{at}.fractal");
        Err(PackError::value(file, &key, found, expected))
    }
}

impl TextureEntry {
    fn verify(&self, file: &str, index: usize) -> Result<(), PackError> {
        let spec = self.role.spec();
        let bad = |key: &str, found: String, expected: String| {
            Err(PackError::value(
                file,
                &format!("textures[{index}].{key}"),
                found,
                expected,
            ))
        };
        if self.file != self.role.file() {
            return bad("file", self.file.clone(), self.role.file());
        }
        if !spec.formats.contains(&self.format) {
            return bad(
                "format",
                self.format.name().to_string(),
                "a format of its role".to_string(),
            );
        }
        if self.shape != spec.shape {
            return bad(
                "shape",
                self.shape.name().to_string(),
                spec.shape.name().to_string(),
            );
        }
        let size = [self.width, self.height, self.layers];
        spec.verify_size(file, &format!("textures[{index}]."), size)?;
        let levels = spec.mips.count(self.width, self.height);
        if self.levels as usize != levels {
            return bad("levels", self.levels.to_string(), levels.to_string());
        }
        let sampler = |wrap: Wrap, filter: Filter| format!("{wrap:?}, {filter:?}").to_lowercase();
        let expected = sampler(spec.wrap, spec.filter);
        let found = sampler(self.sampler.wrap, self.sampler.filter);
        if found != expected {
            return bad("sampler", found, expected);
        }
        let channels: Vec<&str> = self.channels.iter().map(|c| c.name.as_str()).collect();
        let expected: Vec<&str> = spec.channels.iter().map(|c| c.name).collect();
        if channels != expected {
            return bad("channels", channels.join(", "), expected.join(", "));
        }
        let mut channels = self.channels.iter().zip(spec.channels).enumerate();
        channels.try_for_each(|(i, (channel, spec))| {
            channel.verify(file, &format!("textures[{index}].channels[{i}]"), spec)
        })
    }

    /// Compares a file's bytes with this entry.
    pub(crate) fn verify_file(&self, file: &str, bytes: &[u8]) -> Result<(), PackError> {
        verify_bytes(file, bytes, self.file_bytes, &self.file_blake3)
    }

    /// Compares the layout of a decoded texture with this entry.
    pub(crate) fn verify_layout(&self, file: &str, texture: &Texture) -> Result<(), PackError> {
        let describe = |format: Format, shape: Shape, size: [u32; 4]| {
            let [width, height, layers, levels] = size;
            format!(
                "{} {} {width}x{height}, {layers} layers, {levels} levels",
                shape.name(),
                format.name()
            )
        };
        let levels = texture.levels.len() as u32;
        let found = describe(
            texture.format,
            texture.shape,
            [texture.width, texture.height, texture.layers, levels],
        );
        let expected = describe(
            self.format,
            self.shape,
            [self.width, self.height, self.layers, self.levels],
        );
        if found != expected {
            return Err(PackError::value(file, "texture", found, expected));
        }
        Ok(())
    }

    /// Compares the texels of a decoded texture with this entry.
    pub(crate) fn verify_texels(&self, file: &str, texture: &Texture) -> Result<(), PackError> {
        let found = texture.blake3().to_hex().to_string();
        if found != self.texels_blake3 {
            return Err(PackError::value(
                file,
                "texels_blake3",
                found,
                &self.texels_blake3,
            ));
        }
        Ok(())
    }
}

fn seal_of(unsealed_text: &str) -> String {
    blake3::hash(unsealed_text.as_bytes()).to_hex().to_string()
}

fn replace_seal(text: &str, from: &str, to: &str) -> Option<String> {
    let key = "\"seal\": \"";
    let start = text.rfind(key)? + key.len();
    let end = start.checked_add(from.len())?;
    (text.get(start..end)? == from).then(|| format!("{}{to}{}", &text[..start], &text[end..]))
}

/// Looks at `kind` and `version` alone, so that a manifest of another version is refused for its
/// version and not for a key that this one does not know.
fn refuse_other_versions(file: &str, json: &serde_json::Value) -> Result<(), PackError> {
    let kind = json.get("kind").cloned().unwrap_or_default();
    if kind != KIND {
        return Err(PackError::value(file, "kind", kind, format!("\"{KIND}\"")));
    }
    match json.get("version").and_then(serde_json::Value::as_u64) {
        Some(VERSION) => Ok(()),
        Some(found) => Err(PackError::Version {
            file: file.to_string(),
            found,
            expected: VERSION,
        }),
        None => Err(PackError::value(
            file,
            "version",
            json.get("version").cloned().unwrap_or_default(),
            VERSION,
        )),
    }
}

/// The JSON schema of the manifest, as docs/pack.schema.json holds it.
pub fn schema_json() -> String {
    let schema = schemars::schema_for!(Manifest);
    let mut text = serde_json::to_string_pretty(&schema).unwrap_or_default();
    text.push('\n');
    text
}

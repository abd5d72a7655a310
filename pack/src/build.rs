//! Builds a pack: quantises the images, makes their mips, writes the files in memory, reads them back; several
//! textures at a time.

use rayon::prelude::*;

use crate::error::PackError;
use crate::field::{Field, glb};
use crate::format::Format;
use crate::image::Image;
use crate::ktx;
use crate::manifest::{
    Channel, FieldEntry, FractalNoise, Input, KIND, MANIFEST_FILE, Manifest, Sampler, TextureEntry,
    VERSION,
};
use crate::mip;
use crate::pack::Pack;
use crate::role::{ChannelSpec, Role};
use crate::texture::Texture;

/// What a pack is built from, beside its images.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PackInfo {
    /// Name of the pack.
    pub name: String,
    /// Seed of every random stream.
    pub seed: u64,
    /// The program that bakes it, with its version.
    pub baker: String,
    /// Text of the recipe.
    pub recipe: String,
    /// Key in the recipe and hash of every file that the recipe named.
    pub inputs: Vec<Input>,
    /// Elevation of the sun at noon, in radians.
    pub noon_elevation_rad: f32,
    /// Optical depths of the aerosol, as [`Manifest::aerosol_depths`].
    pub aerosol_depths: [f32; 2],
    /// What the noise of the clouds is made of.
    pub noise: FractalNoise,
    /// What their detail is made of.
    pub detail: FractalNoise,
}

impl PackInfo {
    fn fractal(&self, channel: &ChannelSpec) -> Option<FractalNoise> {
        match channel.name {
            "noise" if channel.is_fractal => Some(self.noise),
            "detail" if channel.is_fractal => Some(self.detail),
            _ => None,
        }
    }
}

/// Level 0 of one texture, before quantisation.
#[derive(Clone, Debug, PartialEq)]
pub struct Source {
    /// What it is for.
    pub role: Role,
    /// The format to store it in; one of those that the role allows.
    pub format: Format,
    /// Values as a shader will read them, 0..1 for unorm formats: one image, or one a layer or face, all of
    /// one size.
    pub images: Vec<Image>,
}

impl Source {
    /// Width and height of the first image, and how many there are.
    fn size(&self) -> [u32; 3] {
        let [width, height] = self
            .images
            .first()
            .map_or([0, 0], |image| [image.width, image.height]);
        [width, height, self.images.len() as u32]
    }
}

impl Pack {
    /// Builds a pack from linear images, and proves that reading it back gives the same texels.
    ///
    /// # Errors
    /// [`PackError::Value`] if a role comes twice, its format is not one that it allows, or its images are too
    /// few or too many, of several sizes, or have the wrong channels or size, or values that are not finite.
    pub fn build(info: PackInfo, mut sources: Vec<Source>) -> Result<Pack, PackError> {
        sources.sort_by_key(|source| source.role);
        for (index, source) in sources.iter().enumerate() {
            let file = source.role.file();
            verify_source(&file, source)?;
            if index > 0 && sources[index - 1].role == source.role {
                return Err(PackError::value(
                    &file,
                    "role",
                    "given twice",
                    "one image a role",
                ));
            }
        }
        let textures = sources.into_par_iter();
        let textures = textures.map(|source| (source.role, quantise(source)));
        Pack::from_textures(info, textures.collect())
    }

    /// Builds a pack from textures as they are stored, in the order of their roles. Whether they are what they claim to
    /// be is not looked at: that is for [`crate::check`].
    ///
    /// # Errors
    /// [`PackError::Value`] if a texture cannot be written and read back.
    pub fn from_textures(info: PackInfo, sources: Vec<(Role, Texture)>) -> Result<Pack, PackError> {
        let written: Vec<_> = sources
            .par_iter()
            .map(|(role, texture)| write_texture(*role, texture, &info))
            .collect();
        let mut entries = Vec::new();
        let mut files = Vec::new();
        for result in written {
            let (entry, bytes) = result?;
            files.push((entry.file.clone(), bytes));
            entries.push(entry);
        }
        let textures = sources.into_iter().map(|(_, texture)| texture).collect();
        Pack {
            manifest: manifest(info, entries),
            textures,
            field: None,
            files,
        }
        .sealed()
    }

    /// Adds a field of clouds, or takes its place; proves that reading it back gives the same field.
    ///
    /// Rotations are rounded to a 4096th of a turn, as they are stored; see [`crate::field::rounded_rotation`].
    ///
    /// # Errors
    /// [`PackError::Value`] if the field is not sound: see [`Field::verify`].
    pub fn with_field(self, mut field: Field) -> Result<Pack, PackError> {
        field.round_rotations();
        field.verify(FieldEntry::FILE)?;
        self.with_any_field(field)
    }

    /// The same with a field that is not looked at.
    ///
    /// # Errors
    /// [`PackError::Value`] if it cannot be written and read back.
    pub fn with_any_field(mut self, field: Field) -> Result<Pack, PackError> {
        let bytes = glb::encode(FieldEntry::FILE, &field, &self.manifest.baker)?;
        if glb::decode(FieldEntry::FILE, &bytes)? != field {
            return Err(PackError::value(
                FieldEntry::FILE,
                "field",
                "changed by writing",
                "the same after reading back",
            ));
        }
        let name = FieldEntry::FILE.to_string();
        self.manifest.field = Some(FieldEntry::new(&field, &bytes));
        self.files
            .retain(|(file, _)| *file != name && file != MANIFEST_FILE);
        self.files.push((name, bytes));
        self.field = Some(field);
        self.sealed()
    }

    /// Writes the manifest anew, as the last file, and reads it back.
    fn sealed(mut self) -> Result<Pack, PackError> {
        let json = self.manifest.to_json();
        self.manifest = Manifest::from_json(MANIFEST_FILE, json.as_bytes())?;
        self.files
            .push((MANIFEST_FILE.to_string(), json.into_bytes()));
        Ok(self)
    }
}

/// A texture's entry in the manifest and its file, which was read back and compared.
fn write_texture(
    role: Role,
    texture: &Texture,
    info: &PackInfo,
) -> Result<(TextureEntry, Vec<u8>), PackError> {
    let file = role.file();
    let bytes = ktx::encode(&file, texture, &info.baker)?;
    if ktx::decode(&file, &bytes)? != *texture {
        return Err(PackError::value(
            &file,
            "texels",
            "changed by writing",
            "the same after reading back",
        ));
    }
    Ok((entry(role, &file, texture, &bytes, info), bytes))
}

fn manifest(info: PackInfo, textures: Vec<TextureEntry>) -> Manifest {
    Manifest {
        kind: KIND.to_string(),
        version: VERSION,
        name: info.name,
        seed: info.seed,
        baker: info.baker,
        recipe: info.recipe,
        inputs: info.inputs,
        noon_elevation_rad: info.noon_elevation_rad,
        aerosol_depths: info.aerosol_depths,
        textures,
        field: None,
        seal: String::new(),
    }
}

fn verify_source(file: &str, source: &Source) -> Result<(), PackError> {
    let spec = source.role.spec();
    let bad = |key: &str, found: String, expected: String| {
        Err(PackError::value(file, key, found, expected))
    };
    spec.verify_size(file, "", source.size())?;
    if !spec.formats.contains(&source.format) {
        let allowed: Vec<_> = spec.formats.iter().map(|f| f.name()).collect();
        return bad(
            "format",
            source.format.name().to_string(),
            allowed.join(" or "),
        );
    }
    source
        .images
        .iter()
        .try_for_each(|image| verify_image(file, source, image))
}

fn verify_image(file: &str, source: &Source, image: &Image) -> Result<(), PackError> {
    let bad = |key: &str, found: String, expected: String| {
        Err(PackError::value(file, key, found, expected))
    };
    if image.channels != source.format.channels() {
        return bad(
            "channels",
            image.channels.to_string(),
            source.format.channels().to_string(),
        );
    }
    let [width, height, _] = source.size();
    if [image.width, image.height] != [width, height] {
        return bad(
            "images",
            format!("{}x{}", image.width, image.height),
            format!("{width}x{height}, as the first"),
        );
    }
    let count = image.width as usize * image.height as usize * image.channels;
    if image.texels.len() != count {
        return bad("texels", image.texels.len().to_string(), count.to_string());
    }
    if let Some(index) = image.texels.iter().position(|v| !v.is_finite()) {
        return bad(
            "texels",
            format!("{} at {index}", image.texels[index]),
            "finite values".to_string(),
        );
    }
    Ok(())
}

fn quantise(source: Source) -> Texture {
    let [width, height, layers] = source.size();
    Texture {
        format: source.format,
        shape: source.role.spec().shape,
        width,
        height,
        layers,
        levels: mip::levels(source.role, source.format, source.images),
    }
}

fn entry(role: Role, file: &str, texture: &Texture, bytes: &[u8], info: &PackInfo) -> TextureEntry {
    let spec = role.spec();
    let image = texture.stacked(0);
    let channel = |(index, spec): (usize, &ChannelSpec)| {
        let (mean, spread) = image.mean_and_spread(index);
        Channel {
            name: spec.name.to_string(),
            meaning: spec.meaning.to_string(),
            unit: spec.unit.to_string(),
            range: spec.range,
            mean,
            spread,
            fractal: info.fractal(spec),
        }
    };
    TextureEntry {
        role,
        file: file.to_string(),
        format: texture.format,
        shape: texture.shape,
        width: texture.width,
        height: texture.height,
        layers: texture.layers,
        levels: texture.levels.len() as u32,
        sampler: Sampler {
            wrap: spec.wrap,
            filter: spec.filter,
        },
        channels: spec.channels.iter().enumerate().map(channel).collect(),
        file_bytes: bytes.len() as u64,
        file_blake3: blake3::hash(bytes).to_hex().to_string(),
        texels_blake3: texture.blake3().to_hex().to_string(),
    }
}

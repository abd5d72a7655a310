//! Orchestration: a resolved recipe becomes linear images, and those become a pack.

use std::ops::ControlFlow;
use std::path::Path;

use welkin_pack::manifest::Input;
use welkin_pack::{Field, Format, Image, Pack, PackInfo, Role, Source};

use crate::clouds::{self, photo, source::Photo};
use crate::error::BakeError;
use crate::inputs::{Inputs, Picture};
use crate::load;
use crate::settings::{FieldSettings, PhotoSettings, Resolved, SkyboxSettings, SpritesSettings};
use crate::{fbm, field, flares, galaxy, layers, octaves, sky, skybox, sprites, stars, sun};

/// How far a bake is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// What begins now; `done` at the end.
    pub step: &'static str,
    /// Steps behind it.
    pub done: u32,
    /// Steps in all.
    pub total: u32,
}

/// What a manifest calls this program.
pub(crate) const BAKER: &str = concat!("welkin ", env!("CARGO_PKG_VERSION"));

/// Called before each step and at the end; [`ControlFlow::Break`] cancels the bake.
type OnProgress<'a> = &'a (dyn Fn(Progress) -> ControlFlow<()> + Sync);

/// The steps that [`sources`] takes, in order; the last one only if there is a skybox.
const STEPS: [&str; 14] = [
    "photo", "noise", "detail", "gradient", "stars", "galaxy", "sky", "sun", "octaves", "fbm",
    "flares", "layers", "sprites", "skybox",
];

/// Bakes a pack in memory.
///
/// `base` is the folder that relative paths of pictures start from.
///
/// # Errors
/// See [`BakeError`]; nothing is written in any case.
pub fn bake(
    resolved: &Resolved,
    base: Option<&Path>,
    progress: OnProgress,
) -> Result<Pack, BakeError> {
    bake_from(resolved, Inputs::Folder(base), progress)
}

/// The same from files that are anywhere.
///
/// # Errors
/// As [`bake`].
pub fn bake_from(
    resolved: &Resolved,
    inputs: Inputs,
    progress: OnProgress,
) -> Result<Pack, BakeError> {
    let files = Files::read(resolved, inputs)?;
    let total = step_count(resolved) + 1;
    let step = |step, done| advance(progress, step, done, total);
    let sources = make(resolved, &files, &step)?;
    step("pack", total - 1)?;
    let info = PackInfo {
        name: resolved.name.clone(),
        seed: resolved.seed,
        baker: BAKER.to_string(),
        recipe: resolved.recipe.clone(),
        inputs: files.inputs(),
        noon_elevation_rad: resolved.sun.noon_elevation_rad,
        noise: resolved.clouds.noise.entry(),
        detail: resolved.clouds.detail.entry(),
    };
    let mut pack = Pack::build(info, sources)?;
    if let Some(settings) = &resolved.field {
        let field = field::field(settings, &files.models, resolved.seed)?;
        pack = pack.with_field(field)?;
    }
    step("done", total)?;
    Ok(pack)
}

/// Level 0 of every texture as linear floats, in the order of [`Role::ALL`].
///
/// # Errors
/// See [`BakeError`].
pub fn sources(
    resolved: &Resolved,
    base: Option<&Path>,
    progress: OnProgress,
) -> Result<Vec<Source>, BakeError> {
    let files = Files::read(resolved, Inputs::Folder(base))?;
    let total = step_count(resolved);
    let step = |step, done| advance(progress, step, done, total);
    let sources = make(resolved, &files, &step)?;
    step("done", total)?;
    Ok(sources)
}

/// A photograph made into a seamless cloud channel: one channel, `settings.size` texels a side, 0..1.
///
/// `file_name` names the bytes in errors.
///
/// # Errors
/// [`BakeError::Decode`] or [`BakeError::Photo`].
pub fn photo_channel(
    image_bytes: &[u8],
    file_name: &str,
    settings: &PhotoSettings,
) -> Result<Image, BakeError> {
    let picture = load::decode(image_bytes, file_name)?;
    photo::channel(&picture, file_name, settings)
}

/// The six faces of a skybox, +X, -X, +Y, -Y, +Z, -Z, as a cube texture has them: radiance times cover (red,
/// green, blue; linear BT.709) and cover.
///
/// `base` is the folder that relative paths start from.
///
/// # Errors
/// [`BakeError::Read`], [`BakeError::NoBase`], [`BakeError::Decode`] or [`BakeError::Photo`].
pub fn skybox_faces(
    settings: &SkyboxSettings,
    base: Option<&Path>,
) -> Result<Vec<Image>, BakeError> {
    skybox::images(
        settings,
        &skybox::read(settings, Inputs::Folder(base))?,
        &|| Ok(()),
    )
}

/// The field of clouds. `base` is the folder that relative paths of models start from.
///
/// # Errors
/// [`BakeError::Read`], [`BakeError::NoBase`], [`BakeError::Photo`] or [`BakeError::Model`] of a model's file,
/// [`BakeError::Field`].
pub fn cloud_field(
    settings: &FieldSettings,
    base: Option<&Path>,
    seed: u64,
) -> Result<Field, BakeError> {
    field::field(
        settings,
        &field::read(settings, Inputs::Folder(base))?,
        seed,
    )
}

/// The sheet of cloud sprites: grey and opacity, 0..1, as level 0 of the role `sprites` has them.
///
/// `base` is the folder that relative paths start from.
///
/// # Errors
/// [`BakeError::Read`], [`BakeError::NoBase`], [`BakeError::Decode`] or [`BakeError::Photo`].
pub fn sprite_sheet(
    settings: &SpritesSettings,
    seed: u64,
    base: Option<&Path>,
) -> Result<Image, BakeError> {
    sprites::image(
        settings,
        &sprites::read(settings, Inputs::Folder(base))?,
        seed,
    )
}

/// The files that a recipe names.
struct Files {
    photo: Photo,
    sprites: Vec<Picture>,
    skybox: Vec<Picture>,
    models: Vec<Picture>,
}

impl Files {
    fn read(resolved: &Resolved, inputs: Inputs) -> Result<Files, BakeError> {
        let skybox = resolved.skybox.as_ref();
        let skybox = skybox.map(|settings| skybox::read(settings, inputs));
        let models = resolved.field.as_ref();
        let models = models.map(|settings| field::read(settings, inputs));
        Ok(Files {
            photo: Photo::read(&resolved.clouds.photo, inputs)?,
            sprites: sprites::read(&resolved.sprites, inputs)?,
            skybox: skybox.transpose()?.unwrap_or_default(),
            models: models.transpose()?.unwrap_or_default(),
        })
    }

    fn inputs(&self) -> Vec<Input> {
        let input = |picture: &Picture| Input {
            key: picture.key.clone(),
            blake3: blake3::hash(&picture.bytes).to_hex().to_string(),
        };
        let pictures = self
            .photo
            .named()
            .into_iter()
            .chain(&self.sprites)
            .chain(&self.skybox);
        pictures.chain(&self.models).map(input).collect()
    }
}

fn step_count(resolved: &Resolved) -> u32 {
    STEPS.len() as u32 - u32::from(resolved.skybox.is_none())
}

fn make(
    resolved: &Resolved,
    files: &Files,
    step: &dyn Fn(&'static str, u32) -> Result<(), BakeError>,
) -> Result<Vec<Source>, BakeError> {
    let (seed, clouds) = (resolved.seed, &resolved.clouds);
    step(STEPS[0], 0)?;
    let red = files.photo.channel(&clouds.photo)?;
    step(STEPS[1], 1)?;
    let green = clouds::noise::channel(&clouds.noise, clouds.size, seed, "clouds.noise");
    step(STEPS[2], 2)?;
    let blue = clouds::noise::channel(&clouds.detail, clouds.size, seed, "clouds.detail");
    step(STEPS[3], 3)?;
    let alpha = clouds::gradient::channel(&clouds.gradient, clouds.size);
    let clouds_image = clouds::pack([&red, &green, &blue, &alpha]);
    step(STEPS[4], 4)?;
    let stars = stars::image(&resolved.stars, seed);
    step(STEPS[5], 5)?;
    let galaxy = galaxy::image(&resolved.galaxy, seed);
    step(STEPS[6], 6)?;
    let sky = sky::image(&resolved.sky, resolved.sun.noon_elevation_rad);
    step(STEPS[7], 7)?;
    let sun = sun::image(&resolved.sun);
    step(STEPS[8], 8)?;
    let octaves = octaves::image(seed);
    step(STEPS[9], 9)?;
    let fbm = fbm::images(&resolved.fbm, seed);
    step(STEPS[10], 10)?;
    let flares = flares::image(&resolved.flares, seed);
    step(STEPS[11], 11)?;
    let layers = layers::images(&resolved.layers, seed);
    step(STEPS[12], 12)?;
    let sprites = sprites::image(&resolved.sprites, &files.sprites, seed)?;
    let mut sources = vec![
        source(Role::Clouds, clouds.format, vec![clouds_image]),
        source(Role::Stars, Format::Rgba8Unorm, vec![stars]),
        source(Role::Galaxy, Format::R8Unorm, vec![galaxy]),
        source(Role::Sky, Format::Rgba16Float, vec![sky]),
        source(Role::Sun, Format::Rg8Unorm, vec![sun]),
        source(Role::Octaves, Format::Rgba8Unorm, vec![octaves]),
        source(Role::Fbm, Format::Rgba8Unorm, fbm),
        source(Role::Flares, Format::R8Unorm, vec![flares]),
        source(Role::Layers, Format::Rgba8Unorm, layers),
        source(Role::Sprites, Format::Rg8Unorm, vec![sprites]),
    ];
    if let Some(settings) = &resolved.skybox {
        let proceed = || step(STEPS[13], 13);
        let faces = skybox::images(settings, &files.skybox, &proceed)?;
        sources.push(source(Role::Skybox, Format::Rgba16Float, faces));
    }
    Ok(sources)
}

fn source(role: Role, format: Format, images: Vec<Image>) -> Source {
    Source {
        role,
        format,
        images,
    }
}

fn advance(
    progress: OnProgress,
    step: &'static str,
    done: u32,
    total: u32,
) -> Result<(), BakeError> {
    match progress(Progress { step, done, total }) {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(BakeError::Cancelled),
    }
}

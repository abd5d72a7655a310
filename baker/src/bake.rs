//! Orchestration: a resolved recipe becomes linear images, and those become a pack.

use std::ops::ControlFlow;
use std::path::Path;

use welkin_pack::{Field, Format, Image, Pack, PackInfo, Role, Source};

use crate::clouds::{self, source as photo_source};
use crate::error::BakeError;
use crate::inputs::{Inputs, Reader};
use crate::notice::Notice;
use crate::settings::{FieldSettings, Resolved, SkyboxSettings, SpritesSettings};
use crate::{
    catalogued, fbm, field, flares, galaxy, layers, octaves, sky, skybox, sprites, stars, sun,
};

/// How far a bake is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// What begins now; `done` at the end.
    pub step: &'static str,
    /// Steps behind it.
    pub done: u32,
    /// Steps in all.
    pub total: u32,
    /// What whoever wants the pack should know of the step, if there is anything.
    pub notice: Option<Notice>,
}

/// What a manifest calls this program.
pub(crate) const BAKER: &str = concat!("welkin ", env!("CARGO_PKG_VERSION"));

/// Called before each step, with each notice and at the end; [`ControlFlow::Break`] cancels the bake.
type OnProgress<'a> = &'a (dyn Fn(Progress) -> ControlFlow<()> + Sync);

/// The steps that [`sources`] takes, in order; the last two only if there is a skybox or a catalogue.
const STEPS: [&str; 15] = [
    "photo",
    "noise",
    "detail",
    "gradient",
    "stars",
    "galaxy",
    "sky",
    "sun",
    "octaves",
    "fbm",
    "flares",
    "layers",
    "sprites",
    "skybox",
    "catalogue",
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
    let reader = Reader::new(inputs);
    look_for_files(resolved, &reader)?;
    let total = step_count(resolved) + 1;
    let steps = Steps { progress, total };
    let sources = make(resolved, &reader, &steps)?;
    steps.begin("pack", total - 1)?;
    let field = resolved.field.as_ref();
    let field = field.map(|settings| field::field(settings, &reader, resolved.seed));
    let field = field.transpose()?;
    let info = PackInfo {
        name: resolved.name.clone(),
        seed: resolved.seed,
        baker: BAKER.to_string(),
        recipe: resolved.recipe.clone(),
        inputs: reader.into_hashes(),
        noon_elevation_rad: resolved.sun.noon_elevation_rad,
        aerosol_depths: resolved.sky.aerosol_depths,
        noise: resolved.clouds.noise,
        detail: resolved.clouds.detail,
    };
    let mut pack = Pack::build(info, sources)?;
    if let Some(field) = field {
        pack = pack.with_field(field)?;
    }
    steps.begin("done", total)?;
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
    let reader = Reader::new(Inputs::Folder(base));
    look_for_files(resolved, &reader)?;
    let total = step_count(resolved);
    let steps = Steps { progress, total };
    let sources = make(resolved, &reader, &steps)?;
    steps.begin("done", total)?;
    Ok(sources)
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
    let reader = Reader::new(Inputs::Folder(base));
    skybox::images(settings, &reader, &|| Ok(())).map(|(faces, _)| faces)
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
    field::field(settings, &Reader::new(Inputs::Folder(base)), seed)
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
    sprites::image(settings, &Reader::new(Inputs::Folder(base)), seed)
}

/// Sees that every file that a recipe names is there, before anything is made.
fn look_for_files(resolved: &Resolved, reader: &Reader) -> Result<(), BakeError> {
    let photo = photo_source::files(&resolved.clouds.photo);
    let skybox = resolved.skybox.as_ref().map(skybox::files);
    let models = resolved.field.as_ref().map(field::files);
    let catalogue = resolved.stars.catalogue.as_ref().and_then(catalogued::file);
    let files = photo.into_iter().chain(catalogue);
    let files = files.chain(sprites::files(&resolved.sprites));
    let mut files = files.chain(skybox.into_iter().chain(models).flatten());
    files.try_for_each(|named| reader.look_for(&named))
}

fn step_count(resolved: &Resolved) -> u32 {
    let optional = [
        resolved.skybox.is_none(),
        resolved.stars.catalogue.is_none(),
    ];
    STEPS.len() as u32 - optional.map(u32::from).iter().sum::<u32>()
}

fn make(resolved: &Resolved, reader: &Reader, steps: &Steps) -> Result<Vec<Source>, BakeError> {
    let step = |name, done| steps.begin(name, done);
    let (seed, clouds) = (resolved.seed, &resolved.clouds);
    step(STEPS[0], 0)?;
    let red = photo_source::channel(&clouds.photo, reader)?;
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
    let sky = sky::images(&resolved.sky);
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
    let sprites = sprites::image(&resolved.sprites, reader, seed)?;
    let mut sources = vec![
        source(Role::Clouds, clouds.format, vec![clouds_image]),
        source(Role::Stars, Format::Rgba8Unorm, vec![stars]),
        source(Role::Galaxy, Format::R8Unorm, vec![galaxy]),
        source(Role::Sky, Format::Rgba16Float, sky),
        source(Role::Sun, Format::Rg8Unorm, vec![sun]),
        source(Role::Octaves, Format::Rgba8Unorm, vec![octaves]),
        source(Role::Fbm, Format::Rgba8Unorm, fbm),
        source(Role::Flares, Format::R8Unorm, vec![flares]),
        source(Role::Layers, Format::Rgba8Unorm, layers),
        source(Role::Sprites, Format::Rgba8Unorm, vec![sprites]),
    ];
    if let Some(settings) = &resolved.skybox {
        let proceed = || step(STEPS[13], 13);
        let (faces, clipped) = skybox::images(settings, reader, &proceed)?;
        if let Some(clipped) = clipped {
            steps.notice(STEPS[13], 13, Notice::SkyboxClipped(clipped))?;
        }
        sources.push(source(Role::Skybox, Format::Rgba16Float, faces));
    }
    if let Some(catalogue) = &resolved.stars.catalogue {
        let done = step_count(resolved) - 1;
        step(STEPS[14], done)?;
        let (layers, notice) = catalogued::images(catalogue, reader, seed)?;
        if let Some(notice) = notice {
            steps.notice(STEPS[14], done, notice)?;
        }
        sources.push(source(Role::Catalogue, Format::Rgba8Unorm, layers));
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

/// Who is told of the steps, and how many there are.
struct Steps<'a> {
    progress: OnProgress<'a>,
    total: u32,
}

impl Steps<'_> {
    fn begin(&self, step: &'static str, done: u32) -> Result<(), BakeError> {
        self.tell(step, done, None)
    }

    fn notice(&self, step: &'static str, done: u32, notice: Notice) -> Result<(), BakeError> {
        self.tell(step, done, Some(notice))
    }

    fn tell(&self, step: &'static str, done: u32, notice: Option<Notice>) -> Result<(), BakeError> {
        let told = Progress {
            step,
            done,
            total: self.total,
            notice,
        };
        match (self.progress)(told) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => Err(BakeError::Cancelled),
        }
    }
}

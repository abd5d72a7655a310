//! Orchestration: a resolved recipe becomes five linear images, and those become a pack.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use welkin_pack::manifest::Input;
use welkin_pack::{Format, Image, Pack, PackInfo, Role, Source};

use crate::clouds::{self, photo};
use crate::error::BakeError;
use crate::settings::{PhotoSettings, Resolved};
use crate::{galaxy, load, sky, stars, sun};

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

/// Called before each step and at the end; [`ControlFlow::Break`] cancels the bake.
type OnProgress<'a> = &'a (dyn Fn(Progress) -> ControlFlow<()> + Sync);

/// The steps that [`sources`] takes, in order.
const STEPS: [&str; 8] = [
    "photo", "noise", "detail", "gradient", "stars", "galaxy", "sky", "sun",
];

/// Bakes a pack in memory.
///
/// `base` is the folder that relative photograph paths start from.
///
/// # Errors
/// See [`BakeError`]; nothing is written in any case.
pub fn bake(
    resolved: &Resolved,
    base: Option<&Path>,
    progress: OnProgress,
) -> Result<Pack, BakeError> {
    let photo = photo_of(&resolved.clouds.photo, base)?;
    let total = STEPS.len() as u32 + 1;
    let step = |step, done| advance(progress, step, done, total);
    let sources = make(resolved, &photo, &step)?;
    step("pack", total - 1)?;
    let info = PackInfo {
        name: resolved.name.clone(),
        seed: resolved.seed,
        baker: concat!("welkin ", env!("CARGO_PKG_VERSION")).to_string(),
        recipe: resolved.recipe.clone(),
        inputs: inputs(resolved, &photo),
        noon_elevation_rad: resolved.sun.noon_elevation_rad,
    };
    let pack = Pack::build(info, sources)?;
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
    let photo = photo_of(&resolved.clouds.photo, base)?;
    let total = STEPS.len() as u32;
    let step = |step, done| advance(progress, step, done, total);
    let sources = make(resolved, &photo, &step)?;
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

struct Photo {
    file: String,
    bytes: std::borrow::Cow<'static, [u8]>,
}

fn photo_of(settings: &PhotoSettings, base: Option<&Path>) -> Result<Photo, BakeError> {
    let Some(file) = &settings.file else {
        return Ok(Photo {
            file: photo::BUILT_IN_NAME.to_string(),
            bytes: photo::BUILT_IN.into(),
        });
    };
    let path = match base {
        _ if Path::new(file).is_absolute() => PathBuf::from(file),
        Some(folder) => folder.join(file),
        None => return Err(BakeError::NoBase { file: file.clone() }),
    };
    let bytes = load::read_photo(&path)?;
    Ok(Photo {
        file: path.display().to_string(),
        bytes: bytes.into(),
    })
}

fn inputs(resolved: &Resolved, photo: &Photo) -> Vec<Input> {
    let named = resolved.clouds.photo.file.iter();
    named
        .map(|_| Input {
            key: "clouds.photo.file".to_string(),
            blake3: blake3::hash(&photo.bytes).to_hex().to_string(),
        })
        .collect()
}

fn make(
    resolved: &Resolved,
    photo: &Photo,
    step: &dyn Fn(&'static str, u32) -> Result<(), BakeError>,
) -> Result<Vec<Source>, BakeError> {
    let (seed, clouds) = (resolved.seed, &resolved.clouds);
    step(STEPS[0], 0)?;
    let red = photo_channel(&photo.bytes, &photo.file, &clouds.photo)?;
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
    Ok(vec![
        Source {
            role: Role::Clouds,
            format: clouds.format,
            image: clouds_image,
        },
        Source {
            role: Role::Stars,
            format: Format::Rgba8Unorm,
            image: stars,
        },
        Source {
            role: Role::Galaxy,
            format: Format::R8Unorm,
            image: galaxy,
        },
        Source {
            role: Role::Sky,
            format: Format::Rgba16Float,
            image: sky,
        },
        Source {
            role: Role::Sun,
            format: Format::Rg8Unorm,
            image: sun,
        },
    ])
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

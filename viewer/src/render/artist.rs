//! Draws what one moment of the sky becomes: a file or a folder of files. Drawing is one thread's, encoding any thread's.

use std::path::Path;

use anyhow::Result;
use welkin_pack::Pack;
use welkin_pack::whole::{Folder, IsOurs, verify_folder, write_file};
use welkin_runtime::{SkyLight, SkyParams};
use welkin_viewer::export::Environment;
use welkin_viewer::export::cube::FACES;
use welkin_viewer::export::cubemap::Cubemap;
use welkin_viewer::export::display::displayed;
use welkin_viewer::export::looped::{self, Change};
use welkin_viewer::frame::{Frame, Target};
use welkin_viewer::gpu::{Gpu, GpuError};
use welkin_viewer::headless::{Back, Begun, Stage, View};
use welkin_viewer::save::{Format, encode};

use crate::cli::Shot;
use crate::told::tell_leftovers;

/// The sky of a pack, with what was made of it for the pictures so far.
pub struct Artist<'a> {
    gpu: &'a Gpu,
    pack: Pack,
    srgb: Option<Stage<'a>>,
    linear: Option<Stage<'a>>,
    everywhere: Option<Environment<'a>>,
    opacity: Option<Stage<'a>>,
    opacity_everywhere: Option<Environment<'a>>,
}

/// What was begun.
pub enum Drawing {
    /// A frame on its way from the device.
    Frame(Begun, Format),
    /// What is there already.
    There(Box<Picture>),
}

/// What was drawn: any thread may encode it.
pub enum Picture {
    /// What the camera saw.
    Back(Back, Format),
    /// What was put together from several frames.
    Frame(Frame, Format),
    /// Radiance all around, and the parameters that show it as a picture where that is wanted.
    Map(Frame, Format, SkyParams),
    /// A cube map in one file.
    Ktx2(Cubemap),
    /// The same as six pictures.
    Faces(Cubemap, Format, SkyParams),
}

/// What was drawn, ready to be saved.
pub enum Encoded {
    File(Vec<u8>),
    Folder(Vec<(String, Vec<u8>)>),
}

impl<'a> Artist<'a> {
    /// For the sky of a pack, of which nothing is uploaded yet.
    pub fn new(gpu: &'a Gpu, pack: Pack) -> Artist<'a> {
        Artist {
            gpu,
            pack,
            srgb: None,
            linear: None,
            everywhere: None,
            opacity: None,
            opacity_everywhere: None,
        }
    }

    /// Begins to draw a moment, whatever was drawn before, and in a loop what it shows of another one. `azimuth_rad` is what is in the middle of a
    /// panorama.
    pub fn begin(
        &mut self,
        shot: Shot,
        azimuth_rad: f32,
        view: &View,
        change: Option<&Change>,
    ) -> Result<Drawing> {
        let there = match shot {
            Shot::Frame(format) => {
                let stage = self.stage(format.target())?;
                let Some(change) = change else {
                    stage.reset_history();
                    return Ok(Drawing::Frame(stage.begin(view)?, format));
                };
                let directions = || looped::of_camera(&view.camera);
                let draw = |view: &View| {
                    stage.reset_history();
                    stage.draw(view)
                };
                let mix = looped::mix_frames;
                Picture::Frame(
                    looped::draw(view, Some(change), directions, draw, mix)?,
                    format,
                )
            }
            Shot::Equirect(width, format) => {
                let sky = self.everywhere()?;
                let directions = || looped::of_equirect(width, azimuth_rad);
                let draw = |view: &View| sky.equirect(view, width, azimuth_rad);
                let map = looped::draw(view, change, directions, draw, looped::mix_frames)?;
                Picture::Map(map, format, sky.exposed(view))
            }
            Shot::Ktx2(side) => Picture::Ktx2(cubemap(self.everywhere()?, side, view, change)?),
            Shot::Faces(side, format) => {
                let sky = self.everywhere()?;
                let map = cubemap(sky, side, view, change)?;
                Picture::Faces(map, format, sky.exposed(view))
            }
        };
        Ok(Drawing::There(Box::new(there)))
    }

    /// Begins to draw the opacity of the clouds of a frame.
    pub fn begin_opacity(&mut self, view: &View) -> Result<Begun, GpuError> {
        let stage = self.opacity()?;
        stage.reset_history();
        stage.begin(view)
    }

    /// The same of a panorama, which is there when it comes back.
    pub fn equirect_opacity(
        &mut self,
        view: &View,
        width: u32,
        azimuth_rad: f32,
    ) -> Result<Frame, GpuError> {
        let sky = or_made(&mut self.opacity_everywhere, || {
            Environment::of_opacity(self.gpu, &self.pack)
        })?;
        sky.equirect(view, width, azimuth_rad)
    }

    /// The light of the sky on a scene.
    pub fn light(&mut self, view: &View) -> Result<SkyLight, GpuError> {
        Ok(self.opacity()?.light(view))
    }

    fn opacity(&mut self) -> Result<&mut Stage<'a>, GpuError> {
        or_made(&mut self.opacity, || {
            Stage::of_opacity(self.gpu, &self.pack)
        })
    }

    fn stage(&mut self, target: Target) -> Result<&mut Stage<'a>, GpuError> {
        let kept = match target {
            Target::Srgb8 => &mut self.srgb,
            Target::Linear => &mut self.linear,
        };
        or_made(kept, || Stage::new(self.gpu, &self.pack, target))
    }

    fn everywhere(&mut self) -> Result<&mut Environment<'a>, GpuError> {
        or_made(&mut self.everywhere, || {
            Environment::new(self.gpu, &self.pack)
        })
    }
}

/// What is kept, made if it is not there yet.
fn or_made<T>(
    kept: &mut Option<T>,
    make: impl FnOnce() -> Result<T, GpuError>,
) -> Result<&mut T, GpuError> {
    match kept {
        Some(kept) => Ok(kept),
        None => Ok(kept.insert(make()?)),
    }
}

impl Drawing {
    /// Waits until it is there.
    pub fn wait(self, gpu: &Gpu) -> Result<Picture, GpuError> {
        Ok(match self {
            Drawing::Frame(begun, format) => Picture::Back(begun.wait(gpu)?, format),
            Drawing::There(picture) => *picture,
        })
    }
}

impl Picture {
    /// Its bytes. `file` names it in errors.
    pub fn encode(self, file: &str) -> Result<Encoded> {
        let bytes = match self {
            Picture::Back(back, format) => encode(file, format, &back.frame()?)?,
            Picture::Frame(frame, format) => encode(file, format, &frame)?,
            Picture::Map(map, format, params) => {
                encode(file, format, &shown_as(format, map, &params))?
            }
            Picture::Ktx2(map) => map.ktx2(file)?,
            Picture::Faces(map, format, params) => {
                return faces(&map, format, file, &params).map(Encoded::Folder);
            }
        };
        Ok(Encoded::File(bytes))
    }
}

fn cubemap(
    sky: &mut Environment<'_>,
    side: u32,
    view: &View,
    change: Option<&Change>,
) -> Result<Cubemap, GpuError> {
    let directions = || looped::of_cubemap(side);
    let draw = |view: &View| sky.cubemap(view, side);
    looped::draw(view, change, directions, draw, looped::mix_cubemaps)
}

/// Names and bytes of the pictures of the faces.
fn faces(
    map: &Cubemap,
    format: Format,
    folder: &str,
    params: &SkyParams,
) -> Result<Vec<(String, Vec<u8>)>> {
    let face = |(index, face): (usize, &str)| {
        let name = face_name(face, format);
        let picture = shown_as(format, map.frame(index), params);
        let bytes = encode(&format!("{folder}/{name}"), format, &picture)?;
        Ok((name, bytes))
    };
    FACES.into_iter().enumerate().map(face).collect()
}

/// Draws one moment and saves it.
pub fn draw(
    gpu: &Gpu,
    pack: Pack,
    (shot, azimuth_rad): (Shot, f32),
    view: &View,
    output: &Path,
) -> Result<()> {
    const OURS: Option<IsOurs> = Some(is_face);
    if matches!(shot, Shot::Faces(..)) {
        // Before anything slow begins.
        verify_folder(output, OURS)?;
    }
    let drawing = Artist::new(gpu, pack).begin(shot, azimuth_rad, view, None)?;
    match drawing.wait(gpu)?.encode(&output.display().to_string())? {
        Encoded::File(bytes) => write_file(output, &bytes, &|| false)?,
        Encoded::Folder(files) => {
            let folder = Folder::begin(output, OURS)?;
            for (name, bytes) in &files {
                folder.add(name, bytes)?;
            }
            tell_leftovers(&folder.publish()?);
        }
    }
    Ok(())
}

/// Radiance as the format wants it.
fn shown_as(format: Format, map: Frame, params: &SkyParams) -> Frame {
    match format {
        Format::Png => displayed(map, params),
        Format::Exr | Format::Hdr => map,
    }
}

fn face_name(face: &str, format: Format) -> String {
    format!("{face}.{}", format.extension())
}

/// Whether a file has a name of a face.
fn is_face(name: &str) -> bool {
    let of = |face: &&str| {
        Format::ALL
            .iter()
            .any(|&format| name == face_name(face, format))
    };
    FACES.iter().any(of)
}

//! Draws what one moment of the sky becomes: a file or a folder of files.

use std::path::Path;

use anyhow::Result;
use welkin_pack::Pack;
use welkin_pack::whole::{Folder, IsOurs, verify_folder, write_file};
use welkin_runtime::SkyParams;
use welkin_viewer::export::Environment;
use welkin_viewer::export::cube::FACES;
use welkin_viewer::export::cubemap::Cubemap;
use welkin_viewer::export::display::displayed;
use welkin_viewer::export::looped::{self, Change};
use welkin_viewer::frame::Frame;
use welkin_viewer::gpu::{Gpu, GpuError};
use welkin_viewer::headless::{Stage, View};
use welkin_viewer::save::{Format, encode};

use crate::cli::Shot;
use crate::told::tell_leftovers;

/// A sky, and what it becomes.
pub enum Artist<'a> {
    /// What the camera sees.
    Frame(Stage<'a>, Format),
    /// A panorama, so wide and with this azimuth in its middle.
    Equirect(Environment<'a>, u32, f32, Format),
    /// A cube map with faces of this side, in one file.
    Ktx2(Environment<'a>, u32),
    /// The same as six pictures.
    Faces(Environment<'a>, u32, Format),
}

/// What was drawn, ready to be saved.
pub enum Encoded {
    File(Vec<u8>),
    Folder(Vec<(String, Vec<u8>)>),
}

impl<'a> Artist<'a> {
    /// For the sky of a pack; `azimuth_rad` is what is in the middle of a panorama.
    pub fn new(
        gpu: &'a Gpu,
        pack: &Pack,
        shot: Shot,
        azimuth_rad: f32,
    ) -> Result<Artist<'a>, GpuError> {
        let everywhere = || Environment::new(gpu, pack);
        Ok(match shot {
            Shot::Frame(format) => Artist::Frame(Stage::new(gpu, pack, format.target())?, format),
            Shot::Equirect(width, format) => {
                Artist::Equirect(everywhere()?, width, azimuth_rad, format)
            }
            Shot::Ktx2(side) => Artist::Ktx2(everywhere()?, side),
            Shot::Faces(side, format) => Artist::Faces(everywhere()?, side, format),
        })
    }

    /// Draws a moment, whatever was drawn before, and in a loop what it shows of another one. `file` names it in errors.
    pub fn draw(&mut self, view: &View, change: Option<&Change>, file: &str) -> Result<Encoded> {
        let encoded = match self {
            Artist::Frame(stage, format) => {
                let directions = || looped::of_camera(&view.camera);
                let draw = |view: &View| {
                    stage.reset_history();
                    stage.draw(view)
                };
                let frame = looped::draw(view, change, directions, draw, looped::mix_frames)?;
                encode(file, *format, &frame)?
            }
            Artist::Equirect(sky, width, azimuth_rad, format) => {
                let directions = || looped::of_equirect(*width, *azimuth_rad);
                let draw = |view: &View| sky.equirect(view, *width, *azimuth_rad);
                let map = looped::draw(view, change, directions, draw, looped::mix_frames)?;
                encode(file, *format, &shown_as(*format, map, &sky.exposed(view)))?
            }
            Artist::Ktx2(sky, side) => cubemap(sky, *side, view, change)?.ktx2(file)?,
            Artist::Faces(sky, side, format) => {
                let map = cubemap(sky, *side, view, change)?;
                let params = sky.exposed(view);
                return faces(&map, *format, file, &params).map(Encoded::Folder);
            }
        };
        Ok(Encoded::File(encoded))
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
pub fn draw(mut artist: Artist<'_>, view: &View, output: &Path) -> Result<()> {
    const OURS: Option<IsOurs> = Some(is_face);
    if matches!(artist, Artist::Faces(..)) {
        // Before anything slow begins.
        verify_folder(output, OURS)?;
    }
    match artist.draw(view, None, &output.display().to_string())? {
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

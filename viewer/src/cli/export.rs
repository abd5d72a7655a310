//! The options of environment maps and of sequences.

mod refuse;

use std::ffi::OsStr;
use std::path::Path;

use clap::{Args, ValueEnum};
use welkin_runtime::params::{whole_within, within};
use welkin_viewer::export::looped::CHANGE_S;
use welkin_viewer::export::sequence::{FPS, MOST_FRAMES, Sequence, Shard};
use welkin_viewer::export::{cubemap, equirect};
use welkin_viewer::save::Format;

/// Frames a second without --fps.
const USUAL_FPS: f64 = 30.0;

/// Seconds that a loop may take.
const LOOP_S: [f64; 2] = [1.0, 86_400.0];

/// Name of the group of options that ask for a sequence.
pub const SEQUENCE: &str = "sequence";

/// What is drawn other than one frame.
#[derive(Debug, Args)]
#[command(next_help_heading = "Environment maps and sequences")]
pub struct ExportArgs {
    #[arg(long, value_name = "W", conflicts_with = "cubemap", value_parser = equirect_width, allow_hyphen_values = true, help = equirect_help())]
    pub equirect: Option<u32>,
    #[arg(long, value_name = "N", value_parser = side, allow_hyphen_values = true, help = cubemap_help())]
    pub cubemap: Option<u32>,
    /// Make image-based light of the cube map: its levels are filtered for rough surfaces (GGX), and a .json beside the .ktx2 has the irradiance
    /// as nine spherical harmonics. A file of that name is replaced
    #[arg(long, requires = "cubemap")]
    pub prefiltered: bool,
    #[arg(long, value_name = "N", group = SEQUENCE, value_parser = frames, allow_hyphen_values = true, help = frames_help())]
    pub frames: Option<u32>,
    #[arg(long = "loop", value_name = "SECONDS", group = SEQUENCE, value_parser = loop_s, allow_hyphen_values = true, help = loop_help())]
    pub loop_s: Option<f64>,
    #[arg(long, value_name = "F", requires = SEQUENCE, value_parser = fps, allow_hyphen_values = true, help = fps_help())]
    pub fps: Option<f64>,
    /// Draw one of several parts of the sequence, such as 2/4: every fourth frame, from the second on. Together the parts are the
    /// whole, byte for byte; several may be drawn into the same folder at the same time
    #[arg(
        long,
        value_name = "PART/PARTS",
        requires = SEQUENCE,
        allow_hyphen_values = true
    )]
    pub shard: Option<Shard>,
    /// Format of the files in a folder [default: png; exr with --equirect or --cubemap; ktx2 with --cubemap in a sequence]
    #[arg(long, value_enum)]
    pub format: Option<FormatName>,
}

/// Format of a file in a folder.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum FormatName {
    /// 8-bit sRGB
    Png,
    /// Linear radiance, half floats
    Exr,
    /// Linear radiance, RGBE
    Hdr,
    /// Linear radiance, half floats: the six faces of --cubemap in one file
    Ktx2,
}

/// What one moment of the sky becomes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shot {
    /// What the camera sees.
    Frame(Format),
    /// A panorama of so many columns.
    Equirect(u32, Format),
    /// A cube map of so many texels a side in one file.
    Ktx2(u32),
    /// The same as a folder of six pictures.
    Faces(u32, Format),
}

impl Shot {
    /// What the name of its file ends in, without the dot. A folder's has nothing.
    pub fn extension(self) -> &'static str {
        match self {
            Shot::Frame(format) | Shot::Equirect(_, format) => format.extension(),
            Shot::Ktx2(_) => "ktx2",
            Shot::Faces(..) => "",
        }
    }

    /// Whether it becomes a picture for a display, and not radiance.
    pub fn is_picture(self) -> bool {
        match self {
            Shot::Frame(format) | Shot::Equirect(_, format) | Shot::Faces(_, format) => {
                format == Format::Png
            }
            Shot::Ktx2(_) => false,
        }
    }
}

fn equirect_help() -> String {
    let [least, most] = equirect::WIDTHS;
    format!(
        "Draw the whole sky as a panorama (equirectangular) of W by W/2 texels, an even number from {least} to {most}: .exr and .hdr hold \
         radiance. North is in the middle, or what --azimuth says, east to the right of it, the zenith above"
    )
}

fn cubemap_help() -> String {
    format!(
        "Draw the whole sky on the six faces of a cube, N by N texels each, {}: into one .ktx2, or into \
         a folder as px, nx, py, ny, pz, nz (east, west, up, down, north, south)",
        sides()
    )
}

fn frames_help() -> String {
    format!(
        "Draw a sequence of N frames, 1 to {MOST_FRAMES}, into the folder that --output names, as frame-000000.png and so on; frame k is \
         k / F seconds after --at. Frames that are there are replaced"
    )
}

fn loop_help() -> String {
    let [least, most] = LOOP_S;
    format!(
        "Draw a sequence that begins again where it ends, of SECONDS, {least} to {most}, to the nearest frame, as --frames does: frame 0 is the sky at --at, and the \
         last frame goes on into it. Each part of the sky changes over, at its own moment, to what goes before frame 0, in a fifth of the loop or at \
         most {} seconds",
        CHANGE_S / 5.0
    )
}

fn fps_help() -> String {
    let [least, most] = FPS;
    format!("Frames a second, {least} to {most} [default: {USUAL_FPS}]")
}

/// The width of a panorama.
pub fn equirect_width(text: &str) -> Result<u32, String> {
    let [least, most] = equirect::WIDTHS;
    match text.parse::<u32>() {
        Ok(width) if (least..=most).contains(&width) && width.is_multiple_of(2) => Ok(width),
        _ => Err(format!("expected an even number from {least} to {most}")),
    }
}

/// The sides that a face may have, in words.
pub fn sides() -> String {
    let [least, most] = cubemap::SIDES;
    format!("a power of two from {least} to {most}")
}

/// The side of a face.
pub fn side(text: &str) -> Result<u32, String> {
    let [least, most] = cubemap::SIDES;
    match text.parse::<u32>() {
        Ok(side) if (least..=most).contains(&side) && side.is_power_of_two() => Ok(side),
        _ => Err(format!("expected {}", sides())),
    }
}

fn frames(text: &str) -> Result<u32, String> {
    whole_within(text, 1..=MOST_FRAMES)
}

fn loop_s(text: &str) -> Result<f64, String> {
    let [least, most] = LOOP_S;
    within(text, least..=most, " seconds")
}

fn fps(text: &str) -> Result<f64, String> {
    let [least, most] = FPS;
    within(text, least..=most, " frames a second")
}

impl ExportArgs {
    /// Whether the whole sky is drawn, and not what a camera sees.
    pub fn is_map(&self) -> bool {
        self.equirect.is_some() || self.cubemap.is_some()
    }

    /// Whether anything but one frame was asked for.
    pub fn is_used(&self) -> bool {
        self.is_map() || self.count().is_some() || self.format.is_some()
    }

    /// The sequence, if there is one.
    pub fn sequence(&self, start_s: f64) -> Option<Sequence> {
        Some(Sequence {
            frames: self.count()?,
            fps: self.fps(),
            start_s,
            looped: self.loop_s.is_some(),
            shard: self.shard.unwrap_or(Shard::WHOLE),
        })
    }

    /// Frames of the sequence, if there is one.
    fn count(&self) -> Option<u32> {
        let of_loop = |seconds: f64| (seconds * self.fps()).round() as u32;
        self.frames.or(self.loop_s.map(of_loop))
    }

    fn fps(&self) -> f64 {
        self.fps.unwrap_or(USUAL_FPS)
    }

    /// The option that asks for a sequence.
    fn sequence_option(&self) -> &'static str {
        match self.loop_s {
            Some(_) => "--loop",
            None => "--frames",
        }
    }

    /// What one moment becomes.
    ///
    /// # Errors
    /// That the name of the output, or the format, does not suit it.
    pub fn shot(&self, output: &Path) -> Result<Shot, String> {
        match (self.count(), self.equirect, self.cubemap) {
            (None, None, None) => self.named(output, "").map(Shot::Frame),
            (None, Some(width), _) => self
                .named(output, "--equirect")
                .map(|format| Shot::Equirect(width, format)),
            (None, None, Some(side)) => self.cube(output, side),
            (Some(_), ..) => self.in_sequence(output),
        }
    }

    /// The format that the name of a file says.
    fn named(&self, output: &Path, option: &str) -> Result<Format, String> {
        if self.format.is_some() {
            return Err(
                "--format is for the files in a folder, of --frames, --loop or --cubemap; leave it out, the name of the output says the format"
                    .to_string(),
            );
        }
        Format::of(output).map_err(|error| {
            let hint = if is_ktx2(output) {
                "; .ktx2 is for --cubemap"
            } else {
                ""
            };
            let option = if option.is_empty() { "" } else { ", with " }.to_string() + option;
            format!("--output{option}: {error}{hint}")
        })
    }

    fn cube(&self, output: &Path, side: u32) -> Result<Shot, String> {
        let shown = output.display();
        if self.prefiltered && !is_ktx2(output) {
            return Err(format!(
                "--prefiltered writes levels, which pictures have not, and {shown} is no .ktx2; name the output something.ktx2"
            ));
        }
        match (is_ktx2(output), self.format) {
            (true, None | Some(FormatName::Ktx2)) => return Ok(Shot::Ktx2(side)),
            (true, Some(_)) => {
                return Err(format!(
                    "--format is for the files in a folder, and {shown} is one file; leave it out or name a folder"
                ));
            }
            (false, Some(FormatName::Ktx2)) => {
                return Err(format!(
                    "--format ktx2 is one file for all six faces, and {shown} would be a folder; name the output something.ktx2"
                ));
            }
            (false, _) => {}
        }
        // A name of a picture would become a folder's: hardly what was meant.
        if Format::of(output).is_ok() {
            return Err(format!(
                "--cubemap writes six faces, and {shown} is the name of one picture; name a folder and choose with --format, or name something.ktx2"
            ));
        }
        Ok(Shot::Faces(side, self.picture(Format::Exr)))
    }

    fn in_sequence(&self, output: &Path) -> Result<Shot, String> {
        if Format::of(output).is_ok() || is_ktx2(output) {
            return Err(format!(
                "{} writes a folder of files, and {} is the name of one; name a folder and choose with --format",
                self.sequence_option(),
                output.display()
            ));
        }
        let ktx2 = self.format == Some(FormatName::Ktx2);
        match (self.equirect, self.cubemap) {
            (_, Some(side)) if ktx2 || self.format.is_none() => Ok(Shot::Ktx2(side)),
            (_, Some(_)) => Err(format!(
                "--cubemap with {} writes a .ktx2 for each frame; leave --format out, or take --equirect",
                self.sequence_option()
            )),
            _ if ktx2 => Err(
                "--format ktx2 belongs to --cubemap; add it, or take png, exr or hdr".to_string(),
            ),
            (Some(width), None) => Ok(Shot::Equirect(width, self.picture(Format::Exr))),
            (None, None) => Ok(Shot::Frame(self.picture(Format::Png))),
        }
    }

    /// The format that was chosen for pictures, or the usual one.
    fn picture(&self, defaults: Format) -> Format {
        match self.format {
            Some(FormatName::Png) => Format::Png,
            Some(FormatName::Exr) => Format::Exr,
            Some(FormatName::Hdr) => Format::Hdr,
            Some(FormatName::Ktx2) | None => defaults,
        }
    }
}

/// Whether a file's name ends in `.ktx2`.
pub fn is_ktx2(path: &Path) -> bool {
    let extension = path.extension().and_then(OsStr::to_str);
    extension.is_some_and(|e| e.eq_ignore_ascii_case("ktx2"))
}

#[cfg(test)]
mod tests;

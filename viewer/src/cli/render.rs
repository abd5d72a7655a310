//! The options of `welkin-view render`.

use std::path::PathBuf;

use clap::builder::{PathBufValueParser, TypedValueParser};
use clap::{ArgMatches, Args};
use welkin_runtime::SkyParams;
use welkin_runtime::params::within;
use welkin_viewer::frame::Target;
use welkin_viewer::headless::View;
use welkin_viewer::save::target_for;

use super::export::{ExportArgs, Shot};
use super::gpu::GpuArgs;
use super::jobs::JobsArgs;
use super::settings::{SKY, SettingArgs};
use super::values::size;

#[derive(Debug, Args)]
pub struct RenderArgs {
    /// Folder of the pack
    pub pack: PathBuf,
    /// Picture to write; its name ends in .png, .exr or .hdr. A file of that name is replaced. With --cubemap a .ktx2 or a folder,
    /// with --frames, --loop or --jobs a folder
    #[arg(short, long, value_name = "FRAME.png|.exr|.hdr")]
    pub output: PathBuf,
    /// Pixels, width by height
    #[arg(long, value_name = "WxH", default_value = "1600x1200", value_parser = size, allow_hyphen_values = true)]
    pub size: [u32; 2],
    #[command(flatten)]
    pub settings: SettingArgs,
    /// The cover that shows so many eighths of cloud on average, 0 to 8: 0 none, 8 all
    #[arg(long, value_name = "N", conflicts_with = "cover", value_parser = oktas, allow_hyphen_values = true, help_heading = SKY)]
    pub oktas: Option<f32>,
    /// Write the clouds' shadows on the ground too: the share of direct light, black where none comes through, north at the
    /// top. A file of that name is replaced
    #[arg(long, value_name = "FILE.png", value_parser = PathBufValueParser::new().try_map(png_name), help_heading = SKY)]
    pub shadow: Option<PathBuf>,
    /// Side of the square around the viewer that the shadows cover, in metres, 1 to 1000000
    #[arg(long, value_name = "M", requires = "shadow", default_value_t = SHADOW_EXTENT_M, value_parser = shadow_extent_m, allow_hyphen_values = true, help_heading = SKY)]
    pub shadow_extent: f32,
    /// Draw lines between the stars of ten constellations over a picture of a --date
    #[arg(long, help_heading = SKY)]
    pub constellations: bool,
    #[command(flatten)]
    pub export: ExportArgs,
    #[command(flatten)]
    pub jobs: JobsArgs,
    #[command(flatten)]
    pub gpu: GpuArgs,
}

/// About as far as the low clouds' texture reaches.
const SHADOW_EXTENT_M: f32 = 8_000.0;

impl RenderArgs {
    /// What these options look at.
    pub fn view(&self) -> View {
        View {
            params: self.params(),
            camera: self.settings.settings.camera(self.size),
            seconds: self.settings.settings.at_s,
        }
    }

    /// What becomes of it.
    ///
    /// # Errors
    /// That the name of the output does not suit it.
    pub fn shot(&self) -> Result<Shot, String> {
        self.export.shot(&self.output)
    }

    fn params(&self) -> SkyParams {
        SkyParams {
            shadow_extent_m: self.shadow.as_ref().map_or(0.0, |_| self.shadow_extent),
            ..self.settings.settings.params
        }
    }

    /// An option that the method would not look at is a mistake, and told.
    ///
    /// # Errors
    /// Which option it is, and whose; or that its value is not for this method.
    pub fn refuse_others(&self, given: &ArgMatches) -> Result<(), String> {
        if self.jobs.jobs.is_some() {
            return self.jobs.refuse_others(given);
        }
        self.settings.refuse_others()?;
        let params = self.settings.settings.params;
        self.export
            .refuse_others(given, params.weather.rain, params.flare)?;
        if self.export.is_used() {
            self.shot()?;
        }
        self.refuse_for_radiance()?;
        self.refuse_lines()?;
        self.settings.refuse_other_methods()
    }

    /// Lines are drawn over one picture, and know where stars stand by a date alone.
    fn refuse_lines(&self) -> Result<(), String> {
        let is_picture =
            matches!(self.shot(), Ok(Shot::Frame(format)) if format.target() == Target::Srgb8);
        match (self.constellations, self.settings.settings.params.date) {
            (true, None) => Err("--constellations needs to know where the stars stand; add --date".to_string()),
            (true, Some(_)) if !is_picture || self.export.is_used() => Err(
                "--constellations draws lines over one picture; write a .png, without options of maps and sequences".to_string(),
            ),
            _ => Ok(()),
        }
    }

    /// Files of radiance hold no picture: what makes one of it is a mistake there, and told.
    fn refuse_for_radiance(&self) -> Result<(), String> {
        let of_picture = ["exposure-ev", "auto-exposure", "tonemap"];
        let given = of_picture.into_iter().find(|o| self.settings.is_given(o));
        match (given, self.shot()) {
            (Some(option), Ok(shot)) if !shot.is_picture() => Err(format!(
                "--{option} is for pictures, and {} would hold radiance as it is; leave it out, or write .png",
                self.output.display()
            )),
            // A name that suits nothing is told elsewhere.
            _ => Ok(()),
        }
    }
}

/// Shares of light are bytes, which an EXR is not for.
fn png_name(file: PathBuf) -> Result<PathBuf, String> {
    match target_for(&file) {
        Ok(Target::Srgb8) => Ok(file),
        _ => Err("expected a name that ends in .png".to_string()),
    }
}

/// The sky takes 0 for no shadow at all, and on less than a metre there is nothing to see.
fn shadow_extent_m(text: &str) -> Result<f32, String> {
    within(text, 1.0..=1e6, " metres")
}

/// Eighths of the sky.
fn oktas(text: &str) -> Result<f32, String> {
    within(text, 0.0..=8.0, " oktas")
}

#[cfg(test)]
mod tests;

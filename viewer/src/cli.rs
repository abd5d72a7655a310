//! The command line: every option with its range. Angles are in degrees here and nowhere else.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};
use welkin_runtime::{Camera, SkyParams};
use welkin_viewer::headless::View;

/// Looks at the sky of a Welkin pack.
#[derive(Debug, Parser)]
#[command(
    name = "welkin-view",
    version,
    arg_required_else_help = true,
    args_conflicts_with_subcommands = true
)]
pub struct Cli {
    /// What to do
    #[command(subcommand)]
    pub command: Option<Command>,
    /// Pack to look at in a window (not in this version: use `render`)
    pub pack: Option<PathBuf>,
}

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Draw one frame without a window, to a PNG (8-bit sRGB) or an EXR (linear radiance)
    Render(RenderArgs),
    /// Time the sky and two reference passes on the GPU
    Bench(BenchArgs),
}

/// How the sky is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Method {
    /// Roden and Parberry: one packed cloud texture
    Packed,
}

#[derive(Debug, Args)]
pub struct RenderArgs {
    /// Folder of the pack
    pub pack: PathBuf,
    /// Picture to write; its name ends in .png or .exr. A file of that name is replaced
    #[arg(short, long, value_name = "FRAME.png|.exr")]
    pub output: PathBuf,
    /// Pixels, width by height
    #[arg(long, value_name = "WxH", default_value = "1600x1200", value_parser = size, allow_hyphen_values = true)]
    pub size: [u32; 2],
    /// How the sky is drawn
    #[arg(long, value_enum, default_value_t = Method::Packed)]
    pub method: Method,
    #[command(flatten)]
    pub sky: SkyArgs,
    #[command(flatten)]
    pub camera: CameraArgs,
    /// Moment of the animation, in seconds
    #[arg(long, value_name = "SECONDS", default_value_t = 0.0, value_parser = seconds, allow_negative_numbers = true)]
    pub at: f64,
}

/// The six parameters of Roden and Parberry, and the upper layer. All go from 0 to 1.
#[derive(Debug, Args)]
#[command(next_help_heading = "Sky, each from 0 to 1")]
pub struct SkyArgs {
    /// Cloud cover: 0 none, 1 all
    #[arg(long, value_name = "C", default_value_t = SkyParams::default().cover, value_parser = unit, allow_negative_numbers = true)]
    pub cover: f32,
    /// Height of the clouds: 0 low, 1 high
    #[arg(long, value_name = "H", default_value_t = SkyParams::default().height, value_parser = unit, allow_negative_numbers = true)]
    pub height: f32,
    /// Density of the clouds: 0 thin and bumpy, 1 thick, smooth and dark
    #[arg(long, value_name = "D", default_value_t = SkyParams::default().density, value_parser = unit, allow_negative_numbers = true)]
    pub density: f32,
    /// Amount of red on the clouds of a sunset
    #[arg(long, value_name = "S", default_value_t = SkyParams::default().sunset, value_parser = unit, allow_negative_numbers = true)]
    pub sunset: f32,
    /// Speed of the clouds
    #[arg(long, value_name = "S", default_value_t = SkyParams::default().speed, value_parser = unit, allow_negative_numbers = true)]
    pub speed: f32,
    /// Time of day: 0 midnight, 0.25 sunrise, 0.5 noon, 0.75 sunset
    #[arg(long, value_name = "T", default_value_t = SkyParams::default().time, value_parser = unit, allow_negative_numbers = true)]
    pub time: f32,
    /// Amount of the thin upper layer of clouds: 0 is none
    #[arg(long, value_name = "U", default_value_t = SkyParams::default().upper_layer, value_parser = unit, allow_negative_numbers = true)]
    pub upper: f32,
}

#[derive(Debug, Args)]
#[command(next_help_heading = "Camera")]
pub struct CameraArgs {
    /// Azimuth of the view, from north (0) towards east (90), -360 to 360
    #[arg(long, value_name = "DEG", default_value_t = 180.0, value_parser = azimuth_deg, allow_negative_numbers = true)]
    pub azimuth: f32,
    /// Elevation of the view, -90 to 90: 0 is the horizon, 90 the zenith
    #[arg(long, value_name = "DEG", default_value_t = 25.0, value_parser = elevation_deg, allow_negative_numbers = true)]
    pub elevation: f32,
    /// Vertical field of view, 1 to 150
    #[arg(long, value_name = "DEG", default_value_t = 60.0, value_parser = fov_deg, allow_negative_numbers = true)]
    pub fov: f32,
}

#[derive(Debug, Args)]
pub struct BenchArgs {
    /// Folder of the pack
    pub pack: PathBuf,
    /// Pixels, width by height
    #[arg(long, value_name = "WxH", default_value = "1600x1200", value_parser = size, allow_hyphen_values = true)]
    pub size: [u32; 2],
    /// Frames that are timed, after a warm-up
    #[arg(long, value_name = "N", default_value_t = 100, value_parser = clap::value_parser!(u32).range(1..=100_000), allow_negative_numbers = true)]
    pub frames: u32,
    /// Print JSON instead of a table
    #[arg(long)]
    pub json: bool,
}

impl RenderArgs {
    /// What these options look at.
    pub fn view(&self) -> View {
        let params = SkyParams {
            cover: self.sky.cover,
            height: self.sky.height,
            density: self.sky.density,
            sunset: self.sky.sunset,
            speed: self.sky.speed,
            time: self.sky.time,
            upper_layer: self.sky.upper,
            ..SkyParams::default()
        };
        let CameraArgs {
            azimuth,
            elevation,
            fov,
        } = &self.camera;
        let [azimuth_rad, elevation_rad, fov_rad] =
            [azimuth, elevation, fov].map(|deg| deg.to_radians());
        let camera = Camera::looking(azimuth_rad, elevation_rad, fov_rad, self.size);
        View {
            params,
            camera,
            seconds: self.at,
        }
    }
}

fn unit(text: &str) -> Result<f32, String> {
    within(text, 0.0, 1.0, "").map(|v| v as f32)
}

fn azimuth_deg(text: &str) -> Result<f32, String> {
    within(text, -360.0, 360.0, " degrees").map(|v| v as f32)
}

fn elevation_deg(text: &str) -> Result<f32, String> {
    within(text, -90.0, 90.0, " degrees").map(|v| v as f32)
}

fn fov_deg(text: &str) -> Result<f32, String> {
    within(text, 1.0, 150.0, " degrees").map(|v| v as f32)
}

/// 1e9 seconds are 31 years: longer than any animation, and still exact to a microsecond in 64 bits.
fn seconds(text: &str) -> Result<f64, String> {
    within(text, 0.0, 1e9, " seconds")
}

fn within(text: &str, low: f64, high: f64, unit: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        // Not a number is in no range.
        Ok(value) if (low..=high).contains(&value) => Ok(value),
        _ => Err(format!("expected a number from {low} to {high}{unit}")),
    }
}

/// Sides above this are no texture on any GPU; what the GPU at hand takes is checked when it is known.
const MAX_SIDE: u32 = 32_768;

fn size(text: &str) -> Result<[u32; 2], String> {
    let sides = text
        .split_once('x')
        .and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
    match sides {
        Some(size) if size.iter().all(|side| (1..=MAX_SIDE).contains(side)) => Ok(size),
        _ => Err(format!(
            "expected WIDTHxHEIGHT, each from 1 to {MAX_SIDE}, such as 1600x1200"
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn error_of(args: &[&str]) -> String {
        let all = ["welkin-view", "render", "pack", "-o", "f.png"]
            .iter()
            .chain(args);
        match Cli::try_parse_from(all) {
            Ok(_) => panic!("{args:?} was accepted"),
            Err(error) => error.to_string(),
        }
    }

    fn render_args(args: &[&str]) -> RenderArgs {
        let all = ["welkin-view", "render", "pack", "-o", "f.png"]
            .iter()
            .chain(args);
        match Cli::try_parse_from(all).map(|cli| cli.command) {
            Ok(Some(Command::Render(render))) => render,
            other => panic!("{args:?}: {other:?}"),
        }
    }

    #[test]
    fn the_command_line_is_consistent() {
        <Cli as clap::CommandFactory>::command().debug_assert();
    }

    #[test]
    fn parameters_outside_their_range_are_refused_by_name() {
        for option in [
            "--cover",
            "--height",
            "--density",
            "--sunset",
            "--speed",
            "--time",
            "--upper",
        ] {
            for value in ["1.01", "-0.1", "nan", "inf", "half", ""] {
                let error = error_of(&[option, value]);
                assert!(error.contains(option), "{error}");
                assert!(error.contains("expected a number from 0 to 1"), "{error}");
            }
        }
    }

    #[test]
    fn camera_angles_outside_their_range_are_refused() {
        for (option, value, range) in [
            ("--azimuth", "361", "-360 to 360 degrees"),
            ("--elevation", "-91", "-90 to 90 degrees"),
            ("--fov", "0.5", "1 to 150 degrees"),
            ("--fov", "151", "1 to 150 degrees"),
            ("--at", "-1", "0 to 1000000000 seconds"),
        ] {
            let error = error_of(&[option, value]);
            assert!(error.contains(option) && error.contains(range), "{error}");
        }
    }

    #[test]
    fn sizes_are_two_positive_numbers() {
        for value in [
            "0x10", "10x0", "10", "10x", "axb", "-1x4", "99999x10", "10x10x10",
        ] {
            assert!(
                error_of(&["--size", value]).contains("WIDTHxHEIGHT"),
                "{value}"
            );
        }
        assert_eq!(render_args(&["--size", "640x480"]).size, [640, 480]);
    }

    #[test]
    fn an_unknown_method_is_answered_with_those_that_there_are() {
        let error = error_of(&["--method", "fbm"]);
        assert!(
            error.contains("--method") && error.contains("packed"),
            "{error}"
        );
    }

    #[test]
    fn options_reach_the_view() {
        let args = render_args(&[
            "--cover",
            "0.1",
            "--height",
            "0.2",
            "--density",
            "0.3",
            "--sunset",
            "0.4",
            "--speed",
            "0.5",
            "--time",
            "0.6",
            "--upper",
            "0.7",
            "--at",
            "8",
            "--azimuth",
            "-90",
            "--size",
            "64x48",
        ]);
        let view = args.view();
        let p = &view.params;
        let found = [
            p.cover,
            p.height,
            p.density,
            p.sunset,
            p.speed,
            p.time,
            p.upper_layer,
        ];
        assert_eq!(found, [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7]);
        assert_eq!(view.seconds, 8.0);
        assert_eq!(view.camera.viewport_px, [64, 48]);
    }

    #[test]
    fn a_pack_alone_asks_for_the_window() {
        let cli = Cli::try_parse_from(["welkin-view", "packs/default"]).unwrap();
        assert!(cli.command.is_none() && cli.pack.is_some());
    }
}

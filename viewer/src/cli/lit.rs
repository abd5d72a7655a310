//! The options of the lit method's dome, light and layers.

use std::path::PathBuf;

use clap::Args;
use clap::builder::{PathBufValueParser, TypedValueParser};
use welkin_controls::{LAYERS_FORM, layers, layers_help};
use welkin_runtime::params::MAX_LAYERS;
use welkin_runtime::params::{LitLayer, LitParams};
use welkin_viewer::frame::Target;
use welkin_viewer::save::target_for;

use super::values::{of_sky, shadow_extent_m};

/// What only [`welkin_runtime::Method::Lit`] knows.
#[derive(Debug, Args)]
#[command(next_help_heading = "Clouds of --method lit")]
pub struct LitArgs {
    #[arg(long, value_name = LAYERS_FORM, value_parser = layers, allow_hyphen_values = true, help = layers_help())]
    pub layers: Option<[LitLayer; MAX_LAYERS]>,
    /// Radius of the dome's rim in metres, 1000 to 1000000
    #[arg(long, value_name = "M", default_value_t = LitParams::default().radius_m, value_parser = radius_m, allow_hyphen_values = true)]
    pub dome_radius: f32,
    /// Height of the dome over its radius, 0.02 (flat) to 1 (a hemisphere)
    #[arg(long, value_name = "F", default_value_t = LitParams::default().flattening, value_parser = flattening, allow_hyphen_values = true)]
    pub flattening: f32,
    /// Light that clouds scatter to all sides, 0 to 1
    #[arg(long, value_name = "K", default_value_t = LitParams::default().k1, value_parser = k1, allow_hyphen_values = true)]
    pub k1: f32,
    /// Light that they scatter forwards, which shines around the sun, 0 to 1
    #[arg(long, value_name = "K", default_value_t = LitParams::default().k2, value_parser = k2, allow_hyphen_values = true)]
    pub k2: f32,
    /// How narrow the shine around the sun is and how fast shade deepens, 0.5 to 16
    #[arg(long, value_name = "M", default_value_t = LitParams::default().m, value_parser = m, allow_hyphen_values = true)]
    pub m: f32,
    /// Strength of the full moon's light on clouds, 0 to 1
    #[arg(long, value_name = "S", default_value_t = LitParams::default().moon, value_parser = moon, allow_hyphen_values = true)]
    pub moon: f32,
    /// Write the clouds' shadows on the ground too: the share of direct light, black where none comes through, north at the
    /// top. A file of that name is replaced
    #[arg(long, value_name = "FILE.png", value_parser = PathBufValueParser::new().try_map(png_name))]
    pub shadow: Option<PathBuf>,
    /// Side of the square around the viewer that the shadows cover, in metres, 1 to 1000000
    #[arg(long, value_name = "M", requires = "shadow", default_value_t = SHADOW_EXTENT_M, value_parser = shadow_extent_m, allow_hyphen_values = true)]
    pub shadow_extent: f32,
}

/// As far as the lowest layer's texture reaches, about.
const SHADOW_EXTENT_M: f32 = 8_000.0;

/// The options of [`LitArgs`].
pub const OPTIONS: [&str; 9] = [
    "layers",
    "dome_radius",
    "flattening",
    "k1",
    "k2",
    "m",
    "moon",
    "shadow",
    "shadow_extent",
];

impl LitArgs {
    /// With the interval at which clouds form, if this method's is given.
    pub fn params(&self, formation_interval_s: Option<f32>) -> LitParams {
        let usual = LitParams::default();
        LitParams {
            radius_m: self.dome_radius,
            flattening: self.flattening,
            layers: self.layers.unwrap_or(usual.layers),
            k1: self.k1,
            k2: self.k2,
            m: self.m,
            formation_interval_s: formation_interval_s.unwrap_or(usual.formation_interval_s),
            moon: self.moon,
        }
    }

    /// Side of the square whose shadows are drawn, 0 if none are asked for.
    pub fn shadow_extent_m(&self) -> f32 {
        self.shadow.as_ref().map_or(0.0, |_| self.shadow_extent)
    }
}

fn radius_m(text: &str) -> Result<f32, String> {
    of_sky(text, |sky, v| sky.lit.radius_m = v, " metres")
}

fn flattening(text: &str) -> Result<f32, String> {
    let meaning = ": the dome's height over its radius, 1 for a hemisphere";
    of_sky(text, |sky, v| sky.lit.flattening = v, meaning)
}

fn k1(text: &str) -> Result<f32, String> {
    of_sky(text, |sky, v| sky.lit.k1 = v, "")
}

fn k2(text: &str) -> Result<f32, String> {
    of_sky(text, |sky, v| sky.lit.k2 = v, "")
}

fn m(text: &str) -> Result<f32, String> {
    of_sky(text, |sky, v| sky.lit.m = v, "")
}

/// Shares of light are bytes, which an EXR is not for.
fn png_name(file: PathBuf) -> Result<PathBuf, String> {
    match target_for(&file) {
        Ok(Target::Srgb8) => Ok(file),
        _ => Err("expected a name that ends in .png".to_string()),
    }
}

fn moon(text: &str) -> Result<f32, String> {
    of_sky(text, |sky, v| sky.lit.moon = v, "")
}

#[cfg(test)]
mod tests;

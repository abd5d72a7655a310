//! The options of what clouds are made of, beyond the six parameters.

use clap::{Args, ValueEnum};
use welkin_runtime::params::{FbmParams, LitParams, OctaveParams};
use welkin_runtime::{Method, SkyParams};

use super::values::{formation_interval_s, octaves, three_units, unit};

/// What some methods know and others do not: see [`OWNERS`].
#[derive(Debug, Args)]
#[command(next_help_heading = "Clouds of one method")]
pub struct CloudArgs {
    /// packed, sprites: amount of a thin upper layer, 0 (none) to 1
    #[arg(long, value_name = "U", default_value_t = SkyParams::default().upper_layer, value_parser = unit, allow_hyphen_values = true)]
    pub upper: f32,
    /// octaves: how many are summed, 1 to 8
    #[arg(long, value_name = "N", default_value_t = OctaveParams::default().count, value_parser = octaves, allow_hyphen_values = true)]
    pub octaves: u32,
    #[arg(long, value_name = "SECONDS", value_parser = formation_interval_s, allow_hyphen_values = true, help = interval_help())]
    pub formation_interval: Option<f32>,
    #[arg(long, value_name = "LOW,MIDDLE,HIGH", value_parser = three_units, allow_hyphen_values = true, help = domes_help())]
    pub domes: Option<[f32; 3]>,
    #[arg(long, value_name = "S", value_parser = unit, allow_hyphen_values = true, help = sharpness_help())]
    pub sharpness: Option<f32>,
    /// fbm: colours of the clouds
    #[arg(long, value_enum, default_value_t = Palette::Fair)]
    pub palette: Palette,
    /// fbm: reflectance where the light comes through, linear, each 0 to 1 [default: the palette's]
    #[arg(long, value_name = "R,G,B", value_parser = three_units, allow_hyphen_values = true)]
    pub lit: Option<[f32; 3]>,
    /// fbm: reflectance where clouds shade themselves, linear, each 0 to 1 [default: the palette's]
    #[arg(long, value_name = "R,G,B", value_parser = three_units, allow_hyphen_values = true)]
    pub shaded: Option<[f32; 3]>,
}

fn interval_help() -> String {
    let [octaves, lit] = [
        OctaveParams::default().formation_interval_s,
        LitParams::default().formation_interval_s,
    ];
    format!(
        "octaves, lit: seconds in which clouds form anew, 0.1 to 86400 for octaves, 1 to 86400 for lit \
         [default: {octaves} for octaves, {lit} for lit]"
    )
}

fn domes_help() -> String {
    let [low, middle, high] = OctaveParams::default().domes;
    format!(
        "octaves: cover of each dome as a share of --cover, 0 to 1; 0 leaves it out [default: {low},{middle},{high}]"
    )
}

fn sharpness_help() -> String {
    let [octaves, fair, stormy] = [
        OctaveParams::default().sharpness,
        FbmParams::FAIR.sharpness,
        FbmParams::STORMY.sharpness,
    ];
    format!(
        "octaves, fbm: how sharply clouds end, 0 to 1 \
         [default: {octaves} for octaves, {fair} for fbm, {stormy} with the stormy palette]"
    )
}

/// Colours of [`Method::Fbm`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Palette {
    /// White clouds with grey undersides
    Fair,
    /// Two dark greys
    Stormy,
}

/// The options of [`CloudArgs`], and the methods that know them.
pub const OWNERS: [(&str, &[Method]); 8] = [
    ("upper", &[Method::Packed, Method::Sprites]),
    ("octaves", &[Method::Octaves]),
    ("formation_interval", &[Method::Octaves, Method::Lit]),
    ("domes", &[Method::Octaves]),
    ("sharpness", &[Method::Octaves, Method::Fbm]),
    ("palette", &[Method::Fbm]),
    ("lit", &[Method::Fbm]),
    ("shaded", &[Method::Fbm]),
];

impl CloudArgs {
    /// With the interval at which clouds form, if this method's is given.
    pub fn octave_params(&self, formation_interval_s: Option<f32>) -> OctaveParams {
        let usual = OctaveParams::default();
        OctaveParams {
            count: self.octaves,
            sharpness: self.sharpness.unwrap_or(usual.sharpness),
            formation_interval_s: formation_interval_s.unwrap_or(usual.formation_interval_s),
            domes: self.domes.unwrap_or(usual.domes),
        }
    }

    pub fn fbm_params(&self) -> FbmParams {
        let usual = match self.palette {
            Palette::Fair => FbmParams::FAIR,
            Palette::Stormy => FbmParams::STORMY,
        };
        FbmParams {
            sharpness: self.sharpness.unwrap_or(usual.sharpness),
            lit: self.lit.unwrap_or(usual.lit),
            shaded: self.shaded.unwrap_or(usual.shaded),
        }
    }
}

//! The options of the sprites method.

use clap::Args;
use welkin_runtime::params::SpriteParams;

use super::render::MethodName;
use super::values::{of_sky, unit};

/// What only [`welkin_runtime::Method::Sprites`] knows.
#[derive(Debug, Args)]
#[command(next_help_heading = "Clouds of --method sprites")]
pub struct SpriteArgs {
    /// Method of the dome behind the sprites; sprites is a clear one, with the thin upper layer alone
    #[arg(long, value_enum, default_value_t = MethodName::Sprites)]
    pub behind: MethodName,
    /// Cover of that dome, 0 to 1
    #[arg(long, value_name = "C", default_value_t = SpriteParams::default().behind_cover, value_parser = unit, allow_hyphen_values = true)]
    pub behind_cover: f32,
    /// How far clouds are seen, in metres, 8000 to 60000
    #[arg(long, value_name = "M", default_value_t = SpriteParams::default().distance_m, value_parser = distance_m, allow_hyphen_values = true)]
    pub sight: f32,
    /// Radius of the ring of impostors in metres, 4000 to 60000: clouds beyond it are pictures; 0 for no ring
    #[arg(long, value_name = "M", default_value_t = SpriteParams::default().ring_radius_m, value_parser = ring_radius_m, allow_hyphen_values = true)]
    pub ring: f32,
    /// Distance beyond which a cloud is one billboard, in metres, 2000 to 60000
    #[arg(long, value_name = "M", default_value_t = SpriteParams::default().billboards_beyond_m, value_parser = billboards_beyond_m, allow_hyphen_values = true)]
    pub billboards: f32,
    /// The most that clouds have formed, 0 (nothing) to 1 (whole)
    #[arg(long, value_name = "F", default_value_t = SpriteParams::default().formation, value_parser = unit, allow_hyphen_values = true)]
    pub formation: f32,
}

/// The options of [`SpriteArgs`].
pub const OPTIONS: [&str; 6] = [
    "behind",
    "behind_cover",
    "sight",
    "ring",
    "billboards",
    "formation",
];

impl SpriteArgs {
    pub fn params(&self) -> SpriteParams {
        SpriteParams {
            behind: self.behind.into(),
            behind_cover: self.behind_cover,
            distance_m: self.sight,
            ring_radius_m: self.ring,
            billboards_beyond_m: self.billboards,
            formation: self.formation,
        }
    }
}

fn distance_m(text: &str) -> Result<f32, String> {
    of_sky(text, |sky, v| sky.sprites.distance_m = v, " metres")
}

pub fn ring_radius_m(text: &str) -> Result<f32, String> {
    let meaning = " metres; 0 is no ring";
    of_sky(text, |sky, v| sky.sprites.ring_radius_m = v, meaning)
}

fn billboards_beyond_m(text: &str) -> Result<f32, String> {
    of_sky(
        text,
        |sky, v| sky.sprites.billboards_beyond_m = v,
        " metres",
    )
}

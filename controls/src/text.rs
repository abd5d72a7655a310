//! Text of the settings that are no plain number: one pair of functions each, from the settings and into them.

use welkin_runtime::Method;
use welkin_runtime::internals::clear_sky::cie::LAST_OVERCAST;
use welkin_runtime::params::{FbmParams, PerezShape, SkyModel};

use crate::layers::{layers as read_layers, layers_text};
use crate::lightning::{self, NONE};
use crate::settings::Settings;
use crate::values;

/// Names of the methods.
pub const METHODS: [&str; 5] = names(&Method::ALL);
/// Names of the clear sky's models.
pub const MODELS: [&str; 2] = [SkyModel::ALL[0].name(), SkyModel::ALL[1].name()];
/// Names of the palettes.
pub const PALETTES: [&str; 2] = ["fair", "stormy"];
/// Numbers of the standard skies, or none.
pub const CIE: [&str; 16] = [
    NONE, "1", "2", "3", "4", "5", "6", "7", "8", "9", "10", "11", "12", "13", "14", "15",
];

const fn names(methods: &[Method; 5]) -> [&'static str; 5] {
    [
        methods[0].name(),
        methods[1].name(),
        methods[2].name(),
        methods[3].name(),
        methods[4].name(),
    ]
}

/// The colours of `fbm`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Palette {
    Fair,
    Stormy,
}

impl Palette {
    pub const fn colours(self) -> FbmParams {
        match self {
            Palette::Fair => FbmParams::FAIR,
            Palette::Stormy => FbmParams::STORMY,
        }
    }
}

/// The palette whose colours these are, the fair one where they are of neither.
pub fn palette(fbm: &FbmParams) -> Palette {
    let stormy = FbmParams::STORMY;
    if fbm.lit == stormy.lit && fbm.shaded == stormy.shaded {
        Palette::Stormy
    } else {
        Palette::Fair
    }
}

pub fn palette_name(settings: &Settings) -> String {
    let palette = palette(&settings.params.fbm);
    PALETTES[palette as usize].to_string()
}

pub fn set_palette(settings: &mut Settings, text: &str) -> Result<(), String> {
    let choices = [Palette::Fair, Palette::Stormy];
    settings.params.fbm = choices[index(&PALETTES, text)?].colours();
    Ok(())
}

pub fn method(settings: &Settings) -> String {
    settings.params.method.name().to_string()
}

pub fn set_method(settings: &mut Settings, text: &str) -> Result<(), String> {
    settings.params.method = Method::ALL[index(&METHODS, text)?];
    Ok(())
}

pub fn behind(settings: &Settings) -> String {
    settings.params.sprites.behind.name().to_string()
}

pub fn set_behind(settings: &mut Settings, text: &str) -> Result<(), String> {
    settings.params.sprites.behind = Method::ALL[index(&METHODS, text)?];
    Ok(())
}

pub fn ring(settings: &Settings) -> String {
    settings.params.sprites.ring_radius_m.to_string()
}

/// Between no ring and the smallest there is a gap, which the sky's own check tells.
pub fn set_ring(settings: &mut Settings, text: &str) -> Result<(), String> {
    let put = |sky: &mut welkin_runtime::SkyParams, v| sky.sprites.ring_radius_m = v;
    let radius_m = values::of_sky(text, put, " metres; 0 is no ring")?;
    settings.params.sprites.ring_radius_m = radius_m;
    Ok(())
}

pub fn model(settings: &Settings) -> String {
    settings.params.sky.name().to_string()
}

pub fn set_model(settings: &mut Settings, text: &str) -> Result<(), String> {
    settings.params.sky = SkyModel::ALL[index(&MODELS, text)?];
    Ok(())
}

pub fn cie(settings: &Settings) -> String {
    match settings.params.perez.shape {
        PerezShape::Cie(number) => number.to_string(),
        _ => NONE.to_string(),
    }
}

pub fn set_cie(settings: &mut Settings, text: &str) -> Result<(), String> {
    let shape = &mut settings.params.perez.shape;
    if text != NONE {
        *shape = PerezShape::Cie(values::cie_type(text).map_err(or_none)?);
    } else if matches!(shape, PerezShape::Cie(_)) {
        *shape = PerezShape::default();
    }
    Ok(())
}

pub fn perez(settings: &Settings) -> String {
    match settings.params.perez.shape {
        PerezShape::Custom(numbers) => between_commas(&numbers),
        _ => NONE.to_string(),
    }
}

pub fn set_perez(settings: &mut Settings, text: &str) -> Result<(), String> {
    let shape = &mut settings.params.perez.shape;
    if text != NONE {
        *shape = PerezShape::Custom(values::perez(text).map_err(or_none)?);
    } else if matches!(shape, PerezShape::Custom(_)) {
        *shape = PerezShape::default();
    }
    Ok(())
}

/// Whether the haze of the air says anything: overcast skies are white.
pub fn has_haze(settings: &Settings) -> bool {
    let overcast = matches!(
        settings.params.perez.shape,
        PerezShape::Cie(..=LAST_OVERCAST)
    );
    settings.params.sky == SkyModel::Perez && !overcast
}

pub fn domes(settings: &Settings) -> String {
    between_commas(&settings.params.octaves.domes)
}

pub fn set_domes(settings: &mut Settings, text: &str) -> Result<(), String> {
    settings.params.octaves.domes = values::three_units(text)?;
    Ok(())
}

pub fn lit_colour(settings: &Settings) -> String {
    between_commas(&settings.params.fbm.lit)
}

pub fn set_lit_colour(settings: &mut Settings, text: &str) -> Result<(), String> {
    settings.params.fbm.lit = values::three_units(text)?;
    Ok(())
}

pub fn shaded_colour(settings: &Settings) -> String {
    between_commas(&settings.params.fbm.shaded)
}

pub fn set_shaded_colour(settings: &mut Settings, text: &str) -> Result<(), String> {
    settings.params.fbm.shaded = values::three_units(text)?;
    Ok(())
}

pub fn layers(settings: &Settings) -> String {
    layers_text(&settings.params.lit.layers)
}

pub fn set_layers(settings: &mut Settings, text: &str) -> Result<(), String> {
    settings.params.lit.layers = read_layers(text)?;
    Ok(())
}

pub fn flash(settings: &Settings) -> String {
    lightning::lightning_text(&settings.params.weather.lightning)
}

pub fn set_flash(settings: &mut Settings, text: &str) -> Result<(), String> {
    settings.params.weather.lightning = match text {
        NONE => welkin_runtime::params::Lightning::default(),
        _ => lightning::lightning(text)
            .map_err(or_none)?
            .at(settings.at_s),
    };
    Ok(())
}

fn between_commas(numbers: &[f32]) -> String {
    let texts: Vec<String> = numbers.iter().map(f32::to_string).collect();
    texts.join(",")
}

fn index(names: &[&str], text: &str) -> Result<usize, String> {
    let found = names.iter().position(|name| *name == text);
    found.ok_or_else(|| format!("expected one of {}", names.join(", ")))
}

fn or_none(expected: String) -> String {
    format!("{expected}, or {NONE}")
}

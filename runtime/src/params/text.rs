//! Text of what is no plain number: a pair of functions each, from the parameters and into them.

use crate::almanac::DateError;

use super::fbm::PALETTES;
use super::layers::{layers as read_layers, layers_text};
use super::method::{Method, Shading, SkyModel};
use super::perez::{CUSTOM, LAST_OVERCAST, PerezShape, STANDARD_SKIES};
use super::range::{between_commas, comma_text, whole_within, within};
use super::setting::NONE;
use super::sky::SkyParams;
use super::sprites::{LEAST_RING_M, MOST_DISTANCE_M};
use super::tonemap::Tonemap;

const METHOD_COUNT: usize = Method::ALL.len();
const MODEL_COUNT: usize = SkyModel::ALL.len();
const TONEMAP_COUNT: usize = Tonemap::ALL.len();

/// Names of the methods, and what they are.
pub const METHODS: [[&str; METHOD_COUNT]; 2] = {
    let mut texts = [[""; METHOD_COUNT]; 2];
    let mut i = 0;
    while i < METHOD_COUNT {
        texts[0][i] = Method::ALL[i].name();
        texts[1][i] = Method::ALL[i].title();
        i += 1;
    }
    texts
};

/// Names of the clear sky's models, and what they are.
pub const MODELS: [[&str; MODEL_COUNT]; 2] = {
    let mut texts = [[""; MODEL_COUNT]; 2];
    let mut i = 0;
    while i < MODEL_COUNT {
        texts[0][i] = SkyModel::ALL[i].name();
        texts[1][i] = SkyModel::ALL[i].title();
        i += 1;
    }
    texts
};

/// Names of the shadings, and what they are.
pub const SHADINGS: [[&str; 2]; 2] = {
    let [a, b] = Shading::ALL;
    [[a.name(), b.name()], [a.title(), b.title()]]
};

/// Names of the tone curves, and what they are.
pub const TONEMAPS: [[&str; TONEMAP_COUNT]; 2] = {
    let mut texts = [[""; TONEMAP_COUNT]; 2];
    let mut i = 0;
    while i < TONEMAP_COUNT {
        texts[0][i] = Tonemap::ALL[i].name();
        texts[1][i] = Tonemap::ALL[i].title();
        i += 1;
    }
    texts
};

/// Names of the palettes, and what they are.
pub const PALETTE_NAMES: [[&str; 2]; 2] = {
    let [a, b] = PALETTES;
    [[a.0, b.0], [a.1, b.1]]
};

/// Numbers of the standard skies, or none.
pub const CIE: [&str; STANDARD_SKIES as usize + 1] = [
    NONE, "1", "2", "3", "4", "5", "6", "7", "8", "9", "10", "11", "12", "13", "14", "15",
];

pub fn method(params: &SkyParams) -> String {
    params.method.name().to_string()
}

pub fn set_method(params: &mut SkyParams, text: &str) -> Result<(), String> {
    params.method = Method::ALL[index(&METHODS[0], text)?];
    Ok(())
}

pub fn behind(params: &SkyParams) -> String {
    params.sprites.behind.name().to_string()
}

pub fn set_behind(params: &mut SkyParams, text: &str) -> Result<(), String> {
    params.sprites.behind = Method::ALL[index(&METHODS[0], text)?];
    Ok(())
}

pub fn model(params: &SkyParams) -> String {
    params.sky.name().to_string()
}

pub fn set_model(params: &mut SkyParams, text: &str) -> Result<(), String> {
    params.sky = SkyModel::ALL[index(&MODELS[0], text)?];
    Ok(())
}

pub fn shading(params: &SkyParams) -> String {
    params.shading.name().to_string()
}

pub fn set_shading(params: &mut SkyParams, text: &str) -> Result<(), String> {
    params.shading = Shading::ALL[index(&SHADINGS[0], text)?];
    Ok(())
}

pub fn tonemap(params: &SkyParams) -> String {
    params.tonemap.name().to_string()
}

pub fn set_tonemap(params: &mut SkyParams, text: &str) -> Result<(), String> {
    params.tonemap = Tonemap::ALL[index(&TONEMAPS[0], text)?];
    Ok(())
}

pub fn palette(params: &SkyParams) -> String {
    PALETTE_NAMES[0][params.fbm.palette()].to_string()
}

pub fn set_palette(params: &mut SkyParams, text: &str) -> Result<(), String> {
    params.fbm = PALETTES[index(&PALETTE_NAMES[0], text)?].2;
    Ok(())
}

pub fn layers(params: &SkyParams) -> String {
    layers_text(&params.lit.layers)
}

pub fn set_layers(params: &mut SkyParams, text: &str) -> Result<(), String> {
    params.lit.layers = read_layers(text)?;
    Ok(())
}

pub fn ring(params: &SkyParams) -> String {
    params.sprites.ring_radius_m.to_string()
}

/// Between no ring and the smallest there is a gap.
pub fn set_ring(params: &mut SkyParams, text: &str) -> Result<(), String> {
    const ASIDE: &str = " metres; 0 is no ring";
    let radius_m = within(text, 0.0..=MOST_DISTANCE_M, ASIDE)?;
    if radius_m != 0.0 && radius_m < LEAST_RING_M {
        return Err(format!(
            "expected 0 or a number from {LEAST_RING_M} to {MOST_DISTANCE_M}{ASIDE}"
        ));
    }
    params.sprites.ring_radius_m = radius_m;
    Ok(())
}

pub fn cie(params: &SkyParams) -> String {
    match params.perez.shape {
        PerezShape::Cie(number) => number.to_string(),
        _ => NONE.to_string(),
    }
}

pub fn set_cie(params: &mut SkyParams, text: &str) -> Result<(), String> {
    params.perez.shape = PerezShape::Cie(whole_within(text, 1..=STANDARD_SKIES)?);
    Ok(())
}

pub fn clear_cie(params: &mut SkyParams) {
    if matches!(params.perez.shape, PerezShape::Cie(_)) {
        params.perez.shape = PerezShape::default();
    }
}

pub fn perez(params: &SkyParams) -> String {
    match params.perez.shape {
        PerezShape::Custom(numbers) => comma_text(numbers),
        _ => NONE.to_string(),
    }
}

pub fn set_perez(params: &mut SkyParams, text: &str) -> Result<(), String> {
    let numbers = between_commas(text, &CUSTOM);
    let expected = || {
        let ranges = CUSTOM.map(|[low, high]| format!("{low} to {high}"));
        format!("expected five numbers: {}", ranges.join(", "))
    };
    params.perez.shape = PerezShape::Custom(numbers.ok_or_else(expected)?);
    Ok(())
}

pub fn clear_perez(params: &mut SkyParams) {
    if matches!(params.perez.shape, PerezShape::Custom(_)) {
        params.perez.shape = PerezShape::default();
    }
}

pub fn date(params: &SkyParams) -> String {
    params
        .date
        .map_or(NONE.to_string(), |date| date.to_string())
}

pub fn set_date(params: &mut SkyParams, text: &str) -> Result<(), String> {
    params.date = Some(text.parse().map_err(|e: DateError| e.to_string())?);
    Ok(())
}

pub fn clear_date(params: &mut SkyParams) {
    params.date = None;
}

pub fn has_date(params: &SkyParams) -> bool {
    params.date.is_some()
}

pub fn has_no_date(params: &SkyParams) -> bool {
    params.date.is_none()
}

pub fn is_perez(params: &SkyParams) -> bool {
    params.sky != SkyModel::Table
}

/// Whether the haze of the air says anything: overcast skies are white.
pub fn has_haze(params: &SkyParams) -> bool {
    is_perez(params) && !matches!(params.perez.shape, PerezShape::Cie(..=LAST_OVERCAST))
}

pub fn has_sea(params: &SkyParams) -> bool {
    params.sea
}

pub fn has_flare(params: &SkyParams) -> bool {
    params.flare > 0.0
}

fn index(names: &[&str], text: &str) -> Result<usize, String> {
    let found = names.iter().position(|name| *name == text);
    found.ok_or_else(|| format!("expected one of {}", names.join(", ")))
}

//! A flash of lightning as text.

use welkin_runtime::params::Lightning;
use welkin_runtime::params::{FLASH_PLACE_M, FLASH_START_S, FLASH_STRENGTH, NONE, within};

use crate::settings::Settings;

/// How it is written.
pub const LIGHTNING_FORM: &str = "EAST_KM,SOUTH_KM[,START_S[,STRENGTH]]";

/// A flash whose start may be left to the frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flash {
    /// Metres to the east and to the south.
    pub place_m: [f32; 2],
    /// Second at which it begins, if it is told.
    pub start_s: Option<f64>,
    /// Its brightness, 0 to 1.
    pub strength: f32,
}

/// Seconds before the frame at which a flash begins that shall show in it: after its rise, near its brightest.
const RISEN_S: f64 = 0.005;

impl Flash {
    /// The flash for a frame at this moment: where no start is told, it is near its brightest then.
    pub fn at(&self, at_s: f64) -> Lightning {
        Lightning {
            place_m: self.place_m,
            start_s: self.start_s.unwrap_or(at_s - RISEN_S),
            strength: self.strength,
        }
    }
}

/// The flash of the settings as text, or [`NONE`].
pub(crate) fn flash_text(settings: &Settings) -> String {
    let flash = &settings.params.weather.lightning;
    if flash.strength == 0.0 {
        return NONE.to_string();
    }
    // Kilometres are exact to the metre, which is all that a cloud is.
    let [east_km, south_km] = flash.place_m.map(|m| f64::from(m.round()) / 1e3);
    format!("{east_km},{south_km},{},{}", flash.start_s, flash.strength)
}

pub(crate) fn set_flash(settings: &mut Settings, text: &str) -> Result<(), String> {
    settings.params.weather.lightning = lightning(text)?.at(settings.at_s);
    Ok(())
}

pub(crate) fn clear_flash(settings: &mut Settings) {
    settings.params.weather.lightning = Lightning::default();
}

/// Two to four numbers between commas.
///
/// # Errors
/// Which number is wrong, and what was expected.
pub fn lightning(text: &str) -> Result<Flash, String> {
    let parts: Vec<&str> = text.split(',').map(str::trim).collect();
    let (east, south, start, strength) = match parts[..] {
        [east, south] => (east, south, None, "1"),
        [east, south, start] => (east, south, Some(start), "1"),
        [east, south, start, strength] => (east, south, Some(start), strength),
        _ => {
            return Err(format!(
                "expected two to four numbers {LIGHTNING_FORM}, such as 4,-2 or 4,-2,10,0.5"
            ));
        }
    };
    let [low_km, high_km] = FLASH_PLACE_M.map(|m| m / 1e3);
    let place_m = |name, text: &str| {
        let place_km = within(text, low_km..=high_km, " kilometres");
        told(name, text, place_km).map(|km| 1000.0 * km)
    };
    let start_s = |text: &str| {
        let [first, last] = FLASH_START_S;
        told("START_S", text, within(text, first..=last, " seconds"))
    };
    let [least, most] = FLASH_STRENGTH;
    Ok(Flash {
        place_m: [place_m("EAST_KM", east)?, place_m("SOUTH_KM", south)?],
        start_s: start.map(start_s).transpose()?,
        strength: told("STRENGTH", strength, within(strength, least..=most, ""))?,
    })
}

/// The value, or which number is wrong, what it is and what was expected.
fn told<T>(name: &str, text: &str, value: Result<T, String>) -> Result<T, String> {
    value.map_err(|expected| format!("{name} is \"{text}\", {expected}"))
}

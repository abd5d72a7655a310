//! A flash of lightning as text.

use welkin_runtime::params::Lightning;

use crate::values::{of_sky, place_km};

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

/// A flash as text, or `none`.
pub(crate) fn lightning_text(flash: &Lightning) -> String {
    if flash.strength == 0.0 {
        return NONE.to_string();
    }
    // Kilometres are exact to the metre, which is all that a cloud is.
    let [east_km, south_km] = flash.place_m.map(|m| f64::from(m.round()) / 1e3);
    format!("{east_km},{south_km},{},{}", flash.start_s, flash.strength)
}

/// Text for what is not there.
pub(crate) const NONE: &str = "none";

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
    let start_s = |text: &str| {
        let value = of_sky(text, |sky, v| sky.weather.lightning.start_s = v, " seconds");
        told("START_S", text, value)
    };
    let share = of_sky(strength, |sky, v| sky.weather.lightning.strength = v, "");
    Ok(Flash {
        place_m: [
            1000.0 * told("EAST_KM", east, place_km(east))?,
            1000.0 * told("SOUTH_KM", south, place_km(south))?,
        ],
        start_s: start.map(start_s).transpose()?,
        strength: told("STRENGTH", strength, share)?,
    })
}

/// The value, or which number is wrong, what it is and what was expected.
fn told<T>(name: &str, text: &str, value: Result<T, String>) -> Result<T, String> {
    value.map_err(|expected| format!("{name} is \"{text}\", {expected}"))
}

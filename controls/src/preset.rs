//! Weathers: settings that go together, by name.

use welkin_runtime::params::Input;

use crate::keys::{SettingError, key};
use crate::settings::Settings;

/// A weather.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Preset {
    /// Its name.
    pub name: &'static str,
    /// What one sees, in a few words.
    pub help: &'static str,
    /// The settings that it gives, by name and text.
    pub values: &'static [(&'static str, &'static str)],
    /// The time of day that it asks for, if it is not that time anyway.
    pub hour: Hour,
}

/// A part of the day.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Hour {
    /// The sun is up; if not, it becomes a morning.
    Day,
    /// The sun is well below the horizon; if not, it becomes midnight.
    Night,
}

/// A morning, as [`welkin_runtime::SkyParams::time`].
const MORNING: f32 = 0.4;
/// The sun is up between these.
const DAY: std::ops::Range<f32> = 0.25..0.75;
/// Stars are faint between these.
const STARLESS: std::ops::Range<f32> = 0.19..0.81;

/// The weathers, from the clearest to the darkest, and a night.
pub const PRESETS: [Preset; 6] = [
    Preset {
        name: "clear",
        help: "a few clouds in blue",
        values: &[
            ("cover", "0.1"),
            ("density", "0.1"),
            ("upper", "0.15"),
            ("rain", "0"),
            ("rays", "0"),
            ("flashes", "0"),
            ("lightning", "none"),
            ("palette", "fair"),
        ],
        hour: Hour::Day,
    },
    Preset {
        name: "fair",
        help: "white clouds, more sky than clouds",
        values: &[
            ("cover", "0.4"),
            ("density", "0.2"),
            ("upper", "0.1"),
            ("rain", "0"),
            ("rays", "0"),
            ("flashes", "0"),
            ("lightning", "none"),
            ("palette", "fair"),
        ],
        hour: Hour::Day,
    },
    Preset {
        name: "broken",
        help: "more clouds than sky, rays between them",
        values: &[
            ("cover", "0.68"),
            ("density", "0.35"),
            ("upper", "0"),
            ("rain", "0"),
            ("rays", "0.4"),
            ("flashes", "0"),
            ("lightning", "none"),
            ("palette", "fair"),
        ],
        hour: Hour::Day,
    },
    Preset {
        name: "overcast",
        help: "no sky left",
        values: &[
            ("cover", "1"),
            ("density", "0.55"),
            ("upper", "0"),
            ("rain", "0"),
            ("rays", "0"),
            ("flashes", "0"),
            ("lightning", "none"),
            ("palette", "fair"),
        ],
        hour: Hour::Day,
    },
    Preset {
        name: "storm",
        help: "dark clouds, rain, lightning",
        values: &[
            ("cover", "0.95"),
            ("density", "0.8"),
            ("upper", "0"),
            ("rain", "0.7"),
            ("rays", "0"),
            ("flashes", "10"),
            ("lightning", "none"),
            ("palette", "stormy"),
        ],
        hour: Hour::Day,
    },
    Preset {
        name: "starry",
        help: "night, stars and the Milky Way",
        values: &[
            ("cover", "0.12"),
            ("density", "0.1"),
            ("upper", "0"),
            ("rain", "0"),
            ("rays", "0"),
            ("flashes", "0"),
            ("lightning", "none"),
            ("palette", "fair"),
            ("stars", "true"),
            ("moon", "0"),
        ],
        hour: Hour::Night,
    },
];

impl Preset {
    /// The weather of this name.
    pub fn named(name: &str) -> Option<&'static Preset> {
        PRESETS.iter().find(|preset| preset.name == name)
    }

    /// These settings in this weather.
    ///
    /// # Errors
    /// [`SettingError`]; a test holds [`PRESETS`] to there being none.
    pub fn of(&self, settings: &Settings) -> Result<Settings, SettingError> {
        let mut settings = *settings;
        settings.set_pairs(self.values.iter().copied())?;
        // Who has given a date has the sun of that date.
        if settings.params.date.is_some() {
            return Ok(settings);
        }
        let time = &mut settings.params.time;
        match self.hour {
            Hour::Day if !DAY.contains(time) => *time = MORNING,
            Hour::Night if STARLESS.contains(time) => *time = 0.0,
            _ => {}
        }
        Ok(settings)
    }

    /// Whether these settings are those of this weather.
    pub fn is(&self, settings: &Settings) -> bool {
        let same = |(name, text): &(&str, &str)| {
            key(name).is_ok_and(|key| match key.input {
                Input::Slider { .. } => text.parse::<f32>().ok() == key.text(settings).parse().ok(),
                _ => key.text(settings) == *text,
            })
        };
        self.values.iter().all(same) && self.of(settings).is_ok_and(|of| of == *settings)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_weather_can_be_had_and_is_told_from_the_others() {
        for preset in &PRESETS {
            let settings = preset.of(&Settings::default()).unwrap();
            assert_eq!(settings.params.check(), Ok(()));
            for other in &PRESETS {
                assert_eq!(other.is(&settings), other == preset, "{}", preset.name);
            }
            assert_eq!(preset.of(&settings), Ok(settings), "twice is once");
        }
        assert!(Preset::named("fog").is_none());
    }

    #[test]
    fn weathers_give_the_same_settings_so_that_none_of_another_stays() {
        for preset in &PRESETS {
            for (name, _) in PRESETS[0].values {
                assert!(preset.values.iter().any(|(other, _)| other == name));
            }
        }
    }

    #[test]
    fn the_hour_stays_where_it_fits() {
        let at = |preset: &str, time| {
            let mut settings = Settings::default();
            settings.params.time = time;
            let of = Preset::named(preset).unwrap().of(&settings).unwrap();
            of.params.time
        };
        assert_eq!(at("storm", 0.74), 0.74);
        assert_eq!(at("storm", 0.9), MORNING);
        assert_eq!(at("starry", 0.9), 0.9);
        assert_eq!(at("starry", 0.74), 0.0);
    }
}

//! Every setting: the sky's own table, and beside it the pace of time, a flash, the viewpoint.

use std::ops::Deref;

use serde::{Serialize, Serializer};
use welkin_pack::shown;
use welkin_runtime::params::row::{number, seconds, text};
use welkin_runtime::params::{
    CommandOption, DefaultSaid, Group, Input, Number, SETTINGS, Setting, Words,
};

use crate::lightning::{LIGHTNING_FORM, clear_flash, flash_text, set_flash};
use crate::settings::{LAST_SECOND, Settings};

/// A setting. Its words are those of [`Words`].
#[derive(Clone, Copy, Debug)]
pub enum Key {
    /// Of the sky.
    Sky(&'static Setting),
    /// Of what is about it.
    Own(&'static Setting<Settings>),
}

/// Every setting, in the order in which they are set: the sky's, then what is about it.
pub const KEYS: &[Key] = &{
    let mut keys = [Key::Sky(&SETTINGS[0]); SETTINGS.len() + OWN.len()];
    let mut i = 0;
    while i < keys.len() {
        keys[i] = if i < SETTINGS.len() {
            Key::Sky(&SETTINGS[i])
        } else {
            Key::Own(&OWN[i - SETTINGS.len()])
        };
        i += 1;
    }
    keys
};

/// A flash comes after the moment, from which one without a start begins.
const OWN: &[Setting<Settings>] = welkin_runtime::settings! {
    Weather {
        "flashes" "Lightning" "Flashes of lightning a minute"
            = own([0.0, 30.0], |s| &mut s.flashes_per_min).unit("a minute", " a minute").no_option();
    }
    Time {
        "at" "Moment" "Moment of the animation, in seconds"
            = seconds(LAST_SECOND, |s: &mut Settings| &mut s.at_s).unit("seconds", " seconds").logarithmic()
                .value("SECONDS").range_said();
        "rate" "Rate" "Seconds of the animation that go by in a second"
            = own([0.0, 1000.0], |s| &mut s.rate).logarithmic().no_option();
        "day-length" "Day length" "Seconds that a day takes; 0 and the time of day stays"
            = own([0.0, 86_400.0], |s| &mut s.day_length_s).unit("seconds", " seconds").logarithmic().no_option();
    }
    Weather {
        "lightning" "Flash" "One flash: kilometres to the east and to the south, second at which it begins, strength"
            = text(Input::Text { form: LIGHTNING_FORM }, flash_text, set_flash).optional(clear_flash)
                .value(LIGHTNING_FORM).default_said(DefaultSaid::Nothing).command_help(FLASH_HELP);
    }
    Camera {
        "azimuth" "Azimuth" "Azimuth of the view, from north (0) towards east (90)"
            = angle([-360.0, 360.0], |s| &mut s.view.azimuth_deg).default_said(DefaultSaid::Words("{}; 0 with --equirect"));
        "elevation" "Elevation" "Elevation of the view, -90 to 90: 0 is the horizon, 90 the zenith"
            = angle([-90.0, 90.0], |s| &mut s.view.elevation_deg).range_said();
        "fov" "Field of view" "Vertical field of view"
            = angle([1.0, 150.0], |s| &mut s.view.fov_deg);
        "east" "East" "Where the viewer stands, metres to the east"
            = place(|s| &mut s.view.east_m);
        "north" "North" "Where the viewer stands, metres to the north"
            = place(|s| &mut s.view.north_m).command_help("Metres to the north, of the same range");
        "up" "Up" "Where the viewer stands, metres up"
            = place(|s| &mut s.view.up_m).command_help("Metres up, of the same range");
    }
};

/// A flash at the command line.
const FLASH_HELP: &str = "A flash inside the clouds: its place, in kilometres to the east and to the south of the world's origin, \
    -1000 to 1000; the second at which it begins, or else just before --at; its strength, 0 to 1, or else 1";

const fn own(range: [f32; 2], place: fn(&mut Settings) -> &mut f32) -> Setting<Settings> {
    let field = "";
    number(Number {
        field,
        range,
        place,
    })
}

const fn angle(range: [f32; 2], place: fn(&mut Settings) -> &mut f32) -> Setting<Settings> {
    own(range, place).unit("degrees", " degrees").value("DEG")
}

const fn place(place: fn(&mut Settings) -> &mut f32) -> Setting<Settings> {
    own([-1e6, 1e6], place).unit("metres", " metres").value("M")
}

impl Deref for Key {
    type Target = Words;

    fn deref(&self) -> &Words {
        match self {
            Key::Sky(setting) => &setting.words,
            Key::Own(setting) => &setting.words,
        }
    }
}

impl Serialize for Key {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        Words::serialize(self, serializer)
    }
}

impl Key {
    /// Whether these settings look at it.
    pub fn applies(&self, settings: &Settings) -> bool {
        Words::applies(self, &settings.params)
    }

    /// Its text.
    pub fn text(&self, settings: &Settings) -> String {
        match self {
            Key::Sky(setting) => setting.text(&settings.params),
            Key::Own(setting) => setting.text(settings),
        }
    }

    /// Gives it the value that the text says.
    ///
    /// # Errors
    /// [`SettingError::Value`]; nothing is changed then.
    pub fn set(&self, settings: &mut Settings, text: &str) -> Result<(), SettingError> {
        let text = text.trim();
        let set = match self {
            Key::Sky(setting) => setting.set(&mut settings.params, text),
            Key::Own(setting) => setting.set(settings, text),
        };
        set.map_err(|expected| SettingError::Value {
            key: self.name,
            found: text.to_string(),
            expected,
        })
    }

    /// Gives it the value that the text of an option says.
    ///
    /// # Errors
    /// What was expected, beginning with that word; nothing is changed then.
    pub fn read(&self, settings: &mut Settings, text: &str) -> Result<(), String> {
        match self {
            Key::Sky(setting) => setting.read(&mut settings.params, text),
            Key::Own(setting) => setting.read(settings, text),
        }
    }

    /// The words of `welkin-view render` for it.
    pub(crate) fn options(&self, settings: &Settings) -> Vec<String> {
        match (self.option(), self.command.option) {
            (None, _) => Vec::new(),
            (Some(flag), CommandOption::Flag(_)) => vec![format!("--{flag}")],
            (Some(option), _) => vec![format!("--{option}"), self.text(settings)],
        }
    }
}

/// What is wrong with a setting.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SettingError {
    /// There is no setting of that name.
    #[error("there is no setting \"{}\"; did you mean \"{nearest}\"?", shown(.key))]
    Unknown {
        /// As it was called.
        key: String,
        /// The name that is most like it.
        nearest: &'static str,
    },
    /// It has no such value.
    #[error("{key} is \"{}\", {}", shown(.found), shown(.expected))]
    Value {
        /// Name of the setting.
        key: &'static str,
        /// As it was given.
        found: String,
        /// What it may be, beginning with "expected".
        expected: String,
    },
}

/// The setting of this name.
///
/// # Errors
/// [`SettingError::Unknown`].
pub fn key(name: &str) -> Result<&'static Key, SettingError> {
    index(name).map(|index| &KEYS[index])
}

/// Where the setting of this name stands in [`KEYS`].
///
/// # Errors
/// [`SettingError::Unknown`].
pub fn index(name: &str) -> Result<usize, SettingError> {
    let nearest = || {
        let distance = |key: &&Key| edits(name, key.name);
        KEYS.iter().min_by_key(distance).map_or("", |key| key.name)
    };
    let found = KEYS.iter().position(|key| key.name == name);
    found.ok_or_else(|| SettingError::Unknown {
        key: name.to_string(),
        nearest: nearest(),
    })
}

/// Letters that must be put in, taken out or changed to make one word of the other.
fn edits(a: &str, b: &str) -> usize {
    let mut row: Vec<usize> = (0..=b.chars().count()).collect();
    for (i, from) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, to) in b.chars().enumerate() {
            let changed = diagonal + usize::from(from != to);
            diagonal = row[j + 1];
            row[j + 1] = changed.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[row.len() - 1]
}

#[cfg(test)]
mod tests;

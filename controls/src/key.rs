//! A setting by name: its words for a person, its range, and its text.

use std::fmt::Display;

use serde::Serialize;
use welkin_runtime::Method;

use crate::settings::{SettingError, Settings};
use crate::values::within;

/// A setting, as a person and a program find it.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Key {
    /// Its name in links, in TOML and in scripts, such as `dome-radius`.
    pub name: &'static str,
    /// Its name beside a slider.
    pub label: &'static str,
    /// What it does, in a sentence without its end.
    pub help: &'static str,
    /// Where it stands among the others.
    pub group: Group,
    /// How a person gives it.
    pub input: Input,
    /// The methods that look at it.
    #[serde(serialize_with = "names")]
    pub methods: &'static [Method],
    #[serde(skip)]
    pub(crate) option: CommandOption,
    #[serde(skip)]
    pub(crate) slot: Slot,
    /// Whether these settings look at it, given a method that does.
    #[serde(skip)]
    pub(crate) when: fn(&Settings) -> bool,
}

/// Where a setting stands among the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Group {
    /// Roden and Parberry's six.
    Sky,
    /// What clouds are made of.
    Clouds,
    /// The clear sky.
    Air,
    /// Sun, stars, background.
    Light,
    /// Rays, rain, lightning.
    Weather,
    /// Time.
    Time,
    /// Where one looks from.
    Camera,
}

/// How a person gives a setting.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
pub enum Input {
    /// A number in a range.
    Slider {
        /// The least.
        low: f64,
        /// The most.
        high: f64,
        /// The unit, or nothing.
        unit: &'static str,
        /// Whether a step is a share of the number and not an amount.
        logarithmic: bool,
        /// Whether only whole numbers count.
        whole: bool,
    },
    /// On or off: `true` or `false`.
    Switch,
    /// One of these.
    Choice {
        /// Texts of the choices.
        choices: &'static [&'static str],
    },
    /// Numbers between commas, each in its range, with a name each.
    Numbers {
        /// Their names.
        names: &'static [&'static str],
        /// The least and the most of each.
        ranges: &'static [[f64; 2]],
        /// Whether the text may also be `none`.
        optional: bool,
    },
    /// A colour: linear red, green and blue, 0..1, between commas.
    Colour,
    /// Layers of clouds: see [`crate::layers`].
    Layers,
    /// Text of a form of its own, which is told.
    Text {
        /// The form.
        form: &'static str,
    },
}

/// How `welkin-view render` takes it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum CommandOption {
    /// An option and the text.
    Value(&'static str),
    /// A flag for what is not usual.
    Flag(&'static str),
    /// Not at all.
    None,
}

/// Where it is in the settings.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Slot {
    Number(fn(&mut Settings) -> &mut f32),
    Count(fn(&mut Settings) -> &mut u32),
    Seconds(fn(&mut Settings) -> &mut f64),
    Switch(fn(&mut Settings) -> &mut bool),
    Text {
        get: fn(&Settings) -> String,
        set: fn(&mut Settings, &str) -> Result<(), String>,
    },
}

impl Key {
    /// Whether these settings look at it.
    pub fn applies(&self, settings: &Settings) -> bool {
        self.methods.contains(&settings.params.method) && (self.when)(settings)
    }

    /// Its text.
    pub fn text(&self, settings: &Settings) -> String {
        let mut copy = *settings;
        match self.slot {
            Slot::Number(place) => place(&mut copy).to_string(),
            Slot::Count(place) => place(&mut copy).to_string(),
            Slot::Seconds(place) => place(&mut copy).to_string(),
            Slot::Switch(place) => place(&mut copy).to_string(),
            Slot::Text { get, .. } => get(settings),
        }
    }

    /// Gives it the value that the text says.
    ///
    /// # Errors
    /// [`SettingError::Value`]; nothing is changed then.
    pub fn set(&self, settings: &mut Settings, text: &str) -> Result<(), SettingError> {
        let text = text.trim();
        self.put(settings, text)
            .map_err(|expected| SettingError::Value {
                key: self.name,
                found: text.to_string(),
                expected,
            })
    }

    fn put(&self, settings: &mut Settings, text: &str) -> Result<(), String> {
        match self.slot {
            Slot::Number(place) => *place(settings) = self.number(text)?,
            Slot::Count(place) => *place(settings) = self.number(text)?,
            Slot::Seconds(place) => *place(settings) = self.number(text)?,
            Slot::Switch(place) => {
                *place(settings) = text
                    .parse()
                    .map_err(|_| "expected true or false".to_string())?;
            }
            Slot::Text { set, .. } => set(settings, text)?,
        }
        Ok(())
    }

    /// A number in the range of the slider.
    fn number<T: std::str::FromStr + PartialOrd + Display + FromF64>(
        &self,
        text: &str,
    ) -> Result<T, String> {
        let Input::Slider {
            low, high, unit, ..
        } = self.input
        else {
            return Err("expected a number".to_string());
        };
        let unit = if unit.is_empty() {
            String::new()
        } else {
            format!(" {unit}")
        };
        within(text, T::from_f64(low)..=T::from_f64(high), &unit)
    }

    /// The words of `welkin-view render` for it.
    pub(crate) fn words(&self, settings: &Settings) -> Vec<String> {
        match self.option {
            CommandOption::Value(option) => {
                vec![format!("--{option}"), self.text(settings)]
            }
            CommandOption::Flag(flag) => vec![format!("--{flag}")],
            CommandOption::None => Vec::new(),
        }
    }
}

/// The ends of a slider in the type of its number.
trait FromF64 {
    fn from_f64(value: f64) -> Self;
}

impl FromF64 for f32 {
    fn from_f64(value: f64) -> f32 {
        value as f32
    }
}

impl FromF64 for f64 {
    fn from_f64(value: f64) -> f64 {
        value
    }
}

impl FromF64 for u32 {
    fn from_f64(value: f64) -> u32 {
        value as u32
    }
}

fn names<S: serde::Serializer>(methods: &&[Method], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(methods.iter().map(|method| method.name()))
}

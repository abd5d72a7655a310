//! A setting: its words for a person, its range, its text, and where it is.

use super::method::Method;
use super::range::{ParamError, between_commas, comma_text, whole_within, within};
use super::sky::SkyParams;

/// A setting of `S`.
#[derive(Debug)]
pub struct Setting<S: 'static = SkyParams> {
    /// Its words, and how it is given.
    pub words: Words,
    /// Where it is.
    pub slot: Slot<S>,
}

/// What a person and a program find a setting by.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Words {
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
    pub methods: &'static [Method],
    /// Whether the sky looks at it, given a method that does.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub when: fn(&SkyParams) -> bool,
    /// Whether its numbers go over smoothly from one weather to another.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub blends: bool,
    /// What follows the range in an error: the unit, or what the number means.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub aside: &'static str,
    /// How `welkin-view render` takes it.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub command: Command,
}

/// How a program with a command line takes a setting.
#[derive(Clone, Copy, Debug)]
pub struct Command {
    /// The option.
    pub option: CommandOption,
    /// What stands for its value in the help.
    pub value: &'static str,
    /// The sentence of the help, where it is another one.
    pub help: Option<&'static str>,
    /// Whether that sentence, or the heading over it, says the range.
    pub range_said: bool,
    /// How the help tells its default.
    pub default: DefaultSaid,
}

/// The option of a setting.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CommandOption {
    /// Called as the setting.
    Same,
    /// Called otherwise: settings of several methods share it.
    Shared(&'static str),
    /// A flag for what is not the default.
    Flag(&'static str),
    /// None.
    None,
}

/// How a help tells a default.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DefaultSaid {
    /// By its text.
    Text,
    /// By these words, with its text for `{}`.
    Words(&'static str),
    /// Not at all.
    Nothing,
}

/// Where a setting stands among the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
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
    /// Where one looks from, and how light becomes a picture.
    Camera,
}

/// How a person gives a setting.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(tag = "kind", rename_all = "lowercase"))]
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
        /// What each of them is, in a few words, or nothing for any.
        meanings: &'static [&'static str],
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
    /// Layers of clouds: see [`crate::params::layers`].
    Layers,
    /// Text of a form of its own, which is told.
    Text {
        /// The form.
        form: &'static str,
    },
}

/// Where a setting is, and what may stand there.
#[derive(Debug)]
pub enum Slot<S: 'static = SkyParams> {
    /// A number.
    Number(Number<S>),
    /// Three numbers from 0 to 1, between commas.
    Three([Number<S>; 3]),
    /// A whole number from 1.
    Count {
        /// Its name in errors.
        field: &'static str,
        /// The most.
        most: u32,
        /// Where it is.
        place: fn(&mut S) -> &mut u32,
    },
    /// A moment in seconds, from 0.
    Seconds {
        /// The last.
        last: f64,
        /// Where it is.
        place: fn(&mut S) -> &mut f64,
    },
    /// On or off.
    Switch(fn(&mut S) -> &mut bool),
    /// What has a text of its own form.
    Text {
        /// Its text.
        get: fn(&S) -> String,
        /// Gives it the value of a text, or says what was expected.
        set: fn(&mut S, &str) -> Result<(), String>,
        /// Takes away what need not be there: the text for that is [`NONE`].
        clear: Option<fn(&mut S)>,
        /// The numbers in it.
        numbers: &'static [Number<S>],
    },
}

/// A number in a range, and where it is.
#[derive(Debug)]
pub struct Number<S: 'static = SkyParams> {
    /// Its name in errors, such as `octaves.domes[0]`.
    pub field: &'static str,
    /// The least and the most.
    pub range: [f32; 2],
    /// Where it is.
    pub place: fn(&mut S) -> &mut f32,
}

/// Text for what is not there.
pub const NONE: &str = "none";

impl Words {
    /// Whether a sky looks at it.
    pub fn applies(&self, params: &SkyParams) -> bool {
        self.methods.contains(&params.method) && (self.when)(params)
    }

    /// Its option at the command line, if it has one, without the dashes.
    pub const fn option(&self) -> Option<&'static str> {
        match self.command.option {
            CommandOption::Same => Some(self.name),
            CommandOption::Shared(name) | CommandOption::Flag(name) => Some(name),
            CommandOption::None => None,
        }
    }
}

impl<S> Number<S> {
    /// Brings it into its range; what is not a number becomes that of `defaults`.
    pub(super) fn clamp(&self, settings: &mut S, defaults: &mut S) {
        let ([low, high], value) = (self.range, (self.place)(settings));
        *value = if value.is_nan() {
            *(self.place)(defaults)
        } else {
            value.clamp(low, high)
        };
    }

    /// Tells that it is out of its range.
    pub(super) fn check(&self, settings: &mut S) -> Result<(), ParamError> {
        let [low, high] = self.range;
        ParamError::unless(self.field, *(self.place)(settings), low..=high)
    }
}

impl<S: Copy> Setting<S> {
    /// Every number in it that has a range.
    pub const fn numbers(&self) -> &[Number<S>] {
        match &self.slot {
            Slot::Number(number) => std::slice::from_ref(number),
            Slot::Three(numbers) => numbers,
            Slot::Text { numbers, .. } => numbers,
            _ => &[],
        }
    }

    /// Its text.
    pub fn text(&self, settings: &S) -> String {
        let mut copy = *settings;
        match &self.slot {
            Slot::Number(number) => (number.place)(&mut copy).to_string(),
            Slot::Three(numbers) => comma_text(numbers.iter().map(|n| *(n.place)(&mut copy))),
            Slot::Count { place, .. } => place(&mut copy).to_string(),
            Slot::Seconds { place, .. } => place(&mut copy).to_string(),
            Slot::Switch(place) => place(&mut copy).to_string(),
            Slot::Text { get, .. } => get(settings),
        }
    }

    /// Gives it the value that the text says; [`NONE`] takes away what need not be there.
    ///
    /// # Errors
    /// What was expected, beginning with that word; nothing is changed then.
    pub fn set(&self, settings: &mut S, text: &str) -> Result<(), String> {
        let Slot::Text {
            clear: Some(clear), ..
        } = self.slot
        else {
            return self.read(settings, text);
        };
        if text == NONE {
            clear(settings);
            return Ok(());
        }
        self.read(settings, text)
            .map_err(|expected| format!("{expected}, or {NONE}"))
    }

    /// Gives it the value that the text says.
    ///
    /// # Errors
    /// What was expected, beginning with that word; nothing is changed then.
    pub fn read(&self, settings: &mut S, text: &str) -> Result<(), String> {
        let aside = self.words.aside;
        match &self.slot {
            Slot::Number(number) => {
                let [low, high] = number.range;
                *(number.place)(settings) = within(text, low..=high, aside)?;
            }
            Slot::Three(numbers) => {
                let values = between_commas(text, &[[0.0, 1.0]; 3]);
                let values =
                    values.ok_or("expected three numbers from 0 to 1, such as 0.2,0.5,1")?;
                for (number, value) in numbers.iter().zip(values) {
                    *(number.place)(settings) = value;
                }
            }
            Slot::Count { most, place, .. } => *place(settings) = whole_within(text, 1..=*most)?,
            Slot::Seconds { last, place } => *place(settings) = within(text, 0.0..=*last, aside)?,
            Slot::Switch(place) => {
                *place(settings) = text.parse().map_err(|_| "expected true or false")?;
            }
            Slot::Text { set, .. } => set(settings, text)?,
        }
        Ok(())
    }
}

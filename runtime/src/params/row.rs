//! Rows of a table of settings: what most of them have in common.

use super::method::Method;
use super::setting::{
    Command, CommandOption, DefaultSaid, Group, Input, Number, Setting, Slot, Words,
};

/// A table: in each group a name, a label, a sentence and what is made of the functions of this module, for each setting. Wants
/// `Group` in scope.
#[macro_export]
macro_rules! settings {
    ($($group:ident { $($name:literal $label:literal $help:literal = $row:expr;)* })*) => {
        &[$($($row.named(Group::$group, $name, $label, $help),)*)*]
    };
}

/// From 0 to 1.
pub const UNIT: [f32; 2] = [0.0, 1.0];

/// A row without its name; [`Setting::named`] gives it one.
const fn row<S>(input: Input, slot: Slot<S>) -> Setting<S> {
    let command = Command {
        option: CommandOption::Same,
        value: "",
        help: None,
        range_said: false,
        default: DefaultSaid::Text,
    };
    let words = Words {
        name: "",
        label: "",
        help: "",
        group: Group::Sky,
        input,
        methods: &Method::ALL,
        when: |_| true,
        blends: false,
        aside: "",
        command,
    };
    Setting { words, slot }
}

const fn slider(low: f64, high: f64, whole: bool) -> Input {
    Input::Slider {
        low,
        high,
        unit: "",
        logarithmic: false,
        whole,
    }
}

/// A number in a range.
pub const fn number<S>(number: Number<S>) -> Setting<S> {
    let [low, high] = number.range;
    row(slider(low as f64, high as f64, false), Slot::Number(number))
}

/// A whole number from 1.
pub const fn count<S>(field: &'static str, most: u32, place: fn(&mut S) -> &mut u32) -> Setting<S> {
    let slot = Slot::Count { field, most, place };
    row(slider(1.0, most as f64, true), slot)
}

/// A moment in seconds, from 0.
pub const fn seconds<S>(last: f64, place: fn(&mut S) -> &mut f64) -> Setting<S> {
    row(slider(0.0, last, false), Slot::Seconds { last, place })
}

/// Three numbers from 0 to 1.
pub const fn three<S>(input: Input, numbers: [Number<S>; 3]) -> Setting<S> {
    row(input, Slot::Three(numbers))
}

/// On or off; `flag` is the option for what is not the default.
pub const fn switch<S>(flag: &'static str, place: fn(&mut S) -> &mut bool) -> Setting<S> {
    let mut setting = row(Input::Switch, Slot::Switch(place));
    setting.words.command.option = CommandOption::Flag(flag);
    setting
}

/// What has a text of its own form.
pub const fn text<S>(
    input: Input,
    get: fn(&S) -> String,
    set: fn(&mut S, &str) -> Result<(), String>,
) -> Setting<S> {
    let slot = Slot::Text {
        get,
        set,
        clear: None,
        numbers: &[],
    };
    row(input, slot)
}

impl<S> Setting<S> {
    /// In this group, of this name, beside a slider of that, with this sentence.
    pub const fn named(
        mut self,
        group: Group,
        name: &'static str,
        label: &'static str,
        help: &'static str,
    ) -> Setting<S> {
        (self.words.group, self.words.name) = (group, name);
        (self.words.label, self.words.help) = (label, help);
        self
    }

    /// Looked at by these methods alone.
    pub const fn of(mut self, methods: &'static [Method]) -> Setting<S> {
        self.words.methods = methods;
        self
    }

    /// Looked at by skies of which this holds.
    pub const fn when(mut self, when: fn(&super::sky::SkyParams) -> bool) -> Setting<S> {
        self.words.when = when;
        self
    }

    /// Goes over smoothly from one weather to another.
    pub const fn blends(mut self) -> Setting<S> {
        self.words.blends = true;
        self
    }

    /// In this unit; `aside` is how an error says it.
    pub const fn unit(mut self, name: &'static str, aside: &'static str) -> Setting<S> {
        if let Input::Slider { unit, .. } = &mut self.words.input {
            *unit = name;
        }
        self.aside(aside)
    }

    /// What an error says after the range.
    pub const fn aside(mut self, aside: &'static str) -> Setting<S> {
        self.words.aside = aside;
        self
    }

    /// A slider whose steps are shares.
    pub const fn logarithmic(mut self) -> Setting<S> {
        if let Input::Slider { logarithmic, .. } = &mut self.words.input {
            *logarithmic = true;
        }
        self
    }

    /// Need not be there.
    pub const fn optional(mut self, take_away: fn(&mut S)) -> Setting<S> {
        if let Slot::Text { clear, .. } = &mut self.slot {
            *clear = Some(take_away);
        }
        self
    }

    /// With these numbers in its text.
    pub const fn holding(mut self, all: &'static [Number<S>]) -> Setting<S> {
        if let Slot::Text { numbers, .. } = &mut self.slot {
            *numbers = all;
        }
        self
    }

    /// A value that the command line's help calls so.
    pub const fn value(mut self, value: &'static str) -> Setting<S> {
        self.words.command.value = value;
        self
    }

    /// With an option that settings of other methods share.
    pub const fn shared(mut self, option: &'static str) -> Setting<S> {
        self.words.command.option = CommandOption::Shared(option);
        self
    }

    /// Not at the command line.
    pub const fn no_option(mut self) -> Setting<S> {
        self.words.command.option = CommandOption::None;
        self
    }

    /// With another sentence in the command line's help, which says the range too.
    pub const fn command_help(mut self, help: &'static str) -> Setting<S> {
        self.words.command.help = Some(help);
        self.range_said()
    }

    /// With a sentence, or under a heading, that says the range.
    pub const fn range_said(mut self) -> Setting<S> {
        self.words.command.range_said = true;
        self
    }

    /// With a default that the command line's help tells so.
    pub const fn default_said(mut self, said: DefaultSaid) -> Setting<S> {
        self.words.command.default = said;
        self
    }
}

//! Rows of the table of settings: what most of them have in common.

use welkin_runtime::Method;

use crate::key::{CommandOption, Group, Input, Key, Slot};
use crate::settings::Settings;

/// A number in a range.
pub const fn number(
    name: &'static str,
    label: &'static str,
    help: &'static str,
    group: Group,
    [low, high]: [f64; 2],
    unit: &'static str,
    place: fn(&mut Settings) -> &mut f32,
) -> Key {
    Key {
        name,
        label,
        help,
        group,
        input: Input::Slider {
            low,
            high,
            unit,
            logarithmic: false,
            whole: false,
        },
        methods: &Method::ALL,
        option: CommandOption::Value(name),
        slot: Slot::Number(place),
        when: |_| true,
    }
}

/// A share, 0 to 1.
pub const fn unit(
    name: &'static str,
    label: &'static str,
    help: &'static str,
    group: Group,
    place: fn(&mut Settings) -> &mut f32,
) -> Key {
    number(name, label, help, group, [0.0, 1.0], "", place)
}

/// A place along an axis.
pub const fn place(
    name: &'static str,
    label: &'static str,
    help: &'static str,
    place: fn(&mut Settings) -> &mut f32,
) -> Key {
    number(
        name,
        label,
        help,
        Group::Camera,
        [-1e6, 1e6],
        "metres",
        place,
    )
}

/// A whole number from 1.
pub const fn count(
    name: &'static str,
    label: &'static str,
    help: &'static str,
    most: u32,
    place: fn(&mut Settings) -> &mut u32,
) -> Key {
    Key {
        input: Input::Slider {
            low: 1.0,
            high: most as f64,
            unit: "",
            logarithmic: false,
            whole: true,
        },
        slot: Slot::Count(place),
        ..number(name, label, help, Group::Clouds, [0.0; 2], "", |s| {
            &mut s.rate
        })
    }
}

/// On or off; `flag` is the option for what is not usual.
pub const fn switch(
    name: &'static str,
    label: &'static str,
    help: &'static str,
    flag: &'static str,
    place: fn(&mut Settings) -> &mut bool,
) -> Key {
    Key {
        input: Input::Switch,
        option: CommandOption::Flag(flag),
        slot: Slot::Switch(place),
        ..number(name, label, help, Group::Light, [0.0; 2], "", |s| {
            &mut s.rate
        })
    }
}

/// What has a text of its own form.
pub const fn text(
    name: &'static str,
    label: &'static str,
    help: &'static str,
    group: Group,
    input: Input,
    get: fn(&Settings) -> String,
    set: fn(&mut Settings, &str) -> Result<(), String>,
) -> Key {
    Key {
        input,
        slot: Slot::Text { get, set },
        ..number(name, label, help, group, [0.0; 2], "", |s| &mut s.rate)
    }
}

impl Key {
    /// Looked at by these methods alone.
    pub(super) const fn of(mut self, methods: &'static [Method]) -> Key {
        self.methods = methods;
        self
    }

    /// Looked at by settings of which this holds.
    pub(super) const fn when(mut self, when: fn(&Settings) -> bool) -> Key {
        self.when = when;
        self
    }

    /// Called otherwise at the command line.
    pub(super) const fn option(mut self, option: &'static str) -> Key {
        self.option = CommandOption::Value(option);
        self
    }

    /// Not at the command line.
    pub(super) const fn no_option(mut self) -> Key {
        self.option = CommandOption::None;
        self
    }

    /// A slider whose steps are shares.
    pub(super) const fn logarithmic(mut self) -> Key {
        if let Input::Slider { logarithmic, .. } = &mut self.input {
            *logarithmic = true;
        }
        self
    }
}

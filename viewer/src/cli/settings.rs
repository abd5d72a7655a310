//! The options of the settings, all from their table.

use clap::builder::{PossibleValue, PossibleValuesParser, ValueParser};
use clap::{Arg, ArgAction, ArgMatches, Args, Command, FromArgMatches};
use welkin_controls::{Input, KEYS, Key, Settings};
use welkin_runtime::Method;
use welkin_runtime::params::layers::layers_help;
use welkin_runtime::params::{CommandOption, DefaultSaid, Group, LAST_OVERCAST};
use welkin_runtime::params::{PerezShape, SkyModel};

use super::given::{belongs, is_given};

/// Heading of the six parameters of Roden and Parberry.
pub const SKY: &str = "Sky, each from 0 to 1";
/// Heading of what only [`Method::Lit`] knows.
const LIT: &str = "Clouds of --method lit";
const SHARED: &str = "Clouds of one method";

/// The settings that a command line gives.
#[derive(Debug)]
pub struct SettingArgs {
    /// The default settings, but for those that are given.
    pub settings: Settings,
    /// The options that are given.
    given: Vec<&'static str>,
    /// Why the value of an option that several methods share is none for this one.
    fault: Result<(), String>,
}

/// The settings of each option: several methods may share one.
fn options() -> Vec<(&'static str, Vec<&'static Key>)> {
    let mut options: Vec<(_, Vec<&Key>)> = Vec::new();
    for key in KEYS {
        let Some(option) = key.option() else {
            continue;
        };
        match options.iter_mut().find(|(name, _)| *name == option) {
            Some((_, keys)) => keys.push(key),
            None => options.push((option, vec![key])),
        }
    }
    options
}

/// The methods that look at an option.
fn owners(keys: &[&Key]) -> Vec<Method> {
    let looks = |method: &Method| keys.iter().any(|key| key.methods.contains(method));
    Method::ALL.into_iter().filter(looks).collect()
}

impl SettingArgs {
    /// Whether an option is given.
    pub fn is_given(&self, option: &str) -> bool {
        self.given.contains(&option)
    }

    /// An option that the sky would not look at is a mistake, and told.
    ///
    /// # Errors
    /// Which option it is, and whose.
    pub fn refuse_others(&self) -> Result<(), String> {
        if self.is_given("waves") && !self.settings.params.sea {
            return Err(belongs("waves", "--sea", "the ground", "add --sea"));
        }
        if self.settings.params.sky == SkyModel::Table {
            let mut own = KEYS.iter().filter(|key| is_of_perez(key));
            return match own.find(|key| self.is_given(key.name)) {
                None => Ok(()),
                Some(key) => {
                    let remedy = "add --sky perez";
                    Err(belongs(key.name, "--sky perez", "--sky table", remedy))
                }
            };
        }
        match self.settings.params.perez.shape {
            PerezShape::Cie(number @ ..=LAST_OVERCAST) if self.is_given("turbidity") => {
                Err(format!(
                    "--turbidity colours clear skies, and --cie {number} is overcast and white; leave it out or take --cie {} to 15",
                    LAST_OVERCAST + 1
                ))
            }
            _ => Ok(()),
        }
    }

    /// An option that the method would not look at is a mistake, and told.
    ///
    /// # Errors
    /// Which option it is, and whose; or that its value is not for this method.
    pub fn refuse_other_methods(&self) -> Result<(), String> {
        let method = self.settings.params.method;
        let options = options().into_iter();
        let options = options.filter(|(option, _)| self.is_given(option));
        let mut all = options.map(|(option, keys)| (option, owners(&keys)));
        match all.find(|(_, owners)| !owners.contains(&method)) {
            None => self.fault.clone(),
            Some((option, owners)) => {
                let owners: Vec<&str> = owners.iter().map(|owner| owner.name()).collect();
                Err(belongs(
                    option,
                    &format!("--method {}", owners.join(" or ")),
                    &format!("--method {}", method.name()),
                    "change the method",
                ))
            }
        }
    }
}

impl FromArgMatches for SettingArgs {
    fn from_arg_matches(matches: &ArgMatches) -> Result<SettingArgs, clap::Error> {
        let mut args = SettingArgs {
            settings: Settings::default(),
            given: Vec::new(),
            fault: Ok(()),
        };
        args.update_from_arg_matches(matches)?;
        Ok(args)
    }

    /// Settings stand in the order in which they are set, and the method before those that only some methods know.
    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        for key in KEYS {
            let Some(option) = key.option().filter(|option| is_given(matches, option)) else {
                continue;
            };
            self.given.push(option);
            let method = self.settings.params.method;
            let is_shared = matches!(key.command.option, CommandOption::Shared(_));
            if is_shared && !key.methods.contains(&method) {
                continue;
            }
            let text = match matches.try_get_one::<String>(option) {
                Ok(text) => text.cloned().unwrap_or_default(),
                // A flag is for what is not the default.
                Err(_) => (key.text(&Settings::default()) == "false").to_string(),
            };
            let read = key.read(&mut self.settings, &text);
            self.fault = self.fault.clone().and(read.map_err(|expected| {
                let method = method.name();
                format!("--{option} is {text}, with --method {method} {expected}")
            }));
        }
        Ok(())
    }
}

impl Args for SettingArgs {
    fn augment_args(command: Command) -> Command {
        let args = options();
        command.args(args.iter().map(|(option, keys)| arg(option, keys)))
    }

    fn augment_args_for_update(command: Command) -> Command {
        SettingArgs::augment_args(command)
    }
}

fn arg(option: &'static str, keys: &[&'static Key]) -> Arg {
    let key = keys[0];
    let arg = Arg::new(option)
        .long(option)
        .help(help(keys))
        .help_heading(heading(key));
    if key.input == Input::Switch {
        return arg.action(ArgAction::SetTrue);
    }
    let value = match key.command.value {
        "" => option.to_uppercase(),
        value => value.to_string(),
    };
    let arg = arg.value_name(value);
    let arg = match key.input {
        Input::Choice { choices, meanings } if !meanings.is_empty() => {
            let values = choices.iter().zip(meanings);
            let values = values.map(|(name, meaning)| PossibleValue::new(*name).help(*meaning));
            arg.value_parser(PossibleValuesParser::new(values))
        }
        _ => arg.value_parser(parser(keys)).allow_hyphen_values(true),
    };
    let arg = match key.name {
        "cie" => arg.conflicts_with("perez"),
        "date" => arg.conflicts_with("time"),
        "lat" | "lon" => arg.requires("date"),
        _ => arg,
    };
    match (keys, key.command.default) {
        ([key], DefaultSaid::Text) => arg.default_value(key.text(&Settings::default())),
        _ => arg,
    }
}

/// Takes what any of the settings takes, and else says what the first one expected.
fn parser(keys: &[&'static Key]) -> ValueParser {
    let keys = keys.to_vec();
    ValueParser::new(move |text: &str| -> Result<String, String> {
        let read = |key: &&Key| key.read(&mut Settings::default(), text);
        let first = read(&keys[0]);
        if keys[1..].iter().any(|key| read(key).is_ok()) {
            return Ok(text.to_string());
        }
        first.map(|()| text.to_string())
    })
}

fn heading(key: &Key) -> Option<&'static str> {
    match (key.group, key.methods) {
        (Group::Sky, _) => Some(SKY),
        (Group::Air, _) => Some("Clear sky"),
        (Group::Light, _) => Some("Sun, stars and background"),
        (Group::Clouds, [Method::Lit]) => Some(LIT),
        (Group::Clouds, [Method::Sprites]) => Some("Clouds of --method sprites"),
        (Group::Clouds, methods) if methods.len() < Method::ALL.len() => Some(SHARED),
        (Group::Weather, _) => Some("Weather"),
        (Group::Camera, _) => Some("Camera"),
        (Group::Clouds | Group::Time, _) => None,
    }
}

/// Whether only the sky of Perez looks at a setting.
fn is_of_perez(key: &Key) -> bool {
    let mut perez = Settings::default();
    perez.params.sky = SkyModel::Perez;
    key.group == Group::Air && !key.applies(&Settings::default()) && key.applies(&perez)
}

/// The sentence of an option: whose it is, what it does, its range, its default.
fn help(keys: &[&Key]) -> String {
    let (key, command) = (keys[0], keys[0].command);
    let mut help = match key.input {
        Input::Layers => layers_help(),
        _ => command.help.unwrap_or(key.help).to_string(),
    };
    if heading(key) == Some(SHARED) {
        let owners: Vec<&str> = owners(keys).iter().map(|owner| owner.name()).collect();
        help = format!("{}: {}", owners.join(", "), uncapitalised(&help));
    } else if is_of_perez(key) {
        help = format!("perez: {}", uncapitalised(&help));
    }
    let ranges: Vec<String> = keys.iter().filter_map(|key| range(key)).collect();
    let is_same = ranges.iter().all(|range| *range == ranges[0]);
    if is_same {
        help.extend(ranges.first().map(|range| format!(", {range}")));
    } else {
        help += &format!(", {}", of_each(keys, &ranges).join(", "));
    }
    let texts: Vec<String> = keys.iter().map(|k| k.text(&Settings::default())).collect();
    let texts = if keys.len() > 1 {
        of_each(keys, &texts)
    } else {
        texts
    };
    let said = keys.iter().zip(&texts);
    let said = said.filter_map(|(key, text)| match key.command.default {
        DefaultSaid::Words(words) => Some(words.replace("{}", text)),
        DefaultSaid::Text if keys.len() > 1 => Some(text.clone()),
        _ => None,
    });
    let said: Vec<String> = said.collect();
    if !said.is_empty() {
        help += &format!(" [default: {}]", said.join(", "));
    }
    help
}

/// The range of a setting, unless its sentence says it.
fn range(key: &Key) -> Option<String> {
    match key.input {
        _ if key.command.range_said => None,
        Input::Slider { low, high, .. } => Some(format!("{} to {}", low as f32, high as f32)),
        Input::Numbers { ranges, .. } => {
            let ranges = ranges.iter();
            let ranges = ranges.map(|[low, high]| format!("{} to {}", *low as f32, *high as f32));
            Some(ranges.collect::<Vec<_>>().join(", "))
        }
        _ => None,
    }
}

/// A text for each setting, with the method that it is for.
fn of_each(keys: &[&Key], texts: &[String]) -> Vec<String> {
    let each = keys.iter().zip(texts);
    each.map(|(key, text)| format!("{text} for {}", key.methods[0].name()))
        .collect()
}

fn uncapitalised(sentence: &str) -> String {
    let mut letters = sentence.chars();
    let first = letters.next().map(|letter| letter.to_ascii_lowercase());
    first.into_iter().chain(letters).collect()
}

#[cfg(test)]
mod tests;

//! What people and programs read of the settings is what the table says: docs/settings.md, and the types of the web page's
//! interface. `WELKIN_BLESS=1` writes both.

#![allow(clippy::unwrap_used, reason = "a test may stop where it fails")]

use std::fs;
use std::path::Path;

use welkin_controls::{Group, Input, KEYS, Key, Settings};
use welkin_runtime::Method;

/// The text between two lines of a file is this.
fn holds(file: &str, [first, last]: [&str; 2], wanted: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(file);
    let text = fs::read_to_string(&path).unwrap();
    let begin = text.find(first).unwrap() + first.len();
    let end = begin + text[begin..].find(last).unwrap();
    if std::env::var_os("WELKIN_BLESS").is_some() {
        fs::write(path, [&text[..begin], wanted, &text[end..]].concat()).unwrap();
        return;
    }
    let hint = "run the test with WELKIN_BLESS=1";
    assert!(
        &text[begin..end] == wanted,
        "{file} is not as the table of settings is: {hint}"
    );
}

const GROUPS: [(Group, &str); 7] = [
    (Group::Sky, "The six of Roden and Parberry"),
    (Group::Clouds, "Clouds"),
    (Group::Air, "Clear sky"),
    (Group::Light, "Sun, stars, background"),
    (Group::Weather, "Weather"),
    (Group::Time, "Time"),
    (Group::Camera, "Camera"),
];

#[test]
fn the_documented_settings_are_those_of_the_table() {
    let mut text = String::from("\n");
    for (group, title) in GROUPS {
        text += &format!(
            "\n## {title}\n\n| setting | methods | what | range | default |\n|---|---|---|---|---|\n"
        );
        for key in KEYS.iter().filter(|key| key.group == group) {
            text += &row(key);
        }
    }
    holds(
        "docs/settings.md",
        ["<!-- table -->", "<!-- end -->"],
        &text,
    );
}

fn row(key: &Key) -> String {
    let option = match key.option() {
        Some(option) if option == key.name => String::new(),
        Some(option) => format!(", `--{option}`"),
        None => ", no option".to_string(),
    };
    let methods: Vec<&str> = key.methods.iter().map(|method| method.name()).collect();
    let methods = if methods.len() < Method::ALL.len() {
        methods.join(", ")
    } else {
        "all".to_string()
    };
    let default = key.text(&Settings::default()).replace(',', ", ");
    let (name, help, range) = (key.name, key.help, range(key));
    format!("| `{name}`{option} | {methods} | {help} | {range} | {default} |\n")
}

fn range(key: &Key) -> String {
    let between = |[low, high]: [f64; 2]| format!("{} to {}", low as f32, high as f32);
    match key.input {
        Input::Slider {
            low, high, unit, ..
        } if unit.is_empty() || key.help.contains(unit) => between([low, high]),
        Input::Slider {
            low, high, unit, ..
        } => format!("{} {unit}", between([low, high])),
        Input::Switch => "true or false".to_string(),
        Input::Choice { choices, .. } => choices.join(", "),
        Input::Numbers { ranges, .. } => ranges
            .iter()
            .map(|r| between(*r))
            .collect::<Vec<_>>()
            .join("; "),
        Input::Colour => "three of 0 to 1".to_string(),
        Input::Layers => welkin_runtime::params::layers::LAYERS_FORM.to_string(),
        Input::Text { form } => form.to_string(),
    }
}

#[test]
fn the_types_of_settings_are_those_of_the_table() {
    let union = |names: &[&str]| format!("'{}'", names.join("' | '"));
    let names: Vec<&str> = KEYS.iter().map(|key| key.name).collect();
    let methods = union(&Method::ALL.map(Method::name));
    let mut text = format!(
        "\n/** A system that makes the clouds. */\nexport type MethodName = {methods};\n\n\
         /** The name of a setting. */\nexport type SettingName =\n  | '{}';\n\n\
         /** Settings by name. Those that are left out stay as they are. */\nexport interface Settings {{\n",
        names.join("'\n  | '")
    );
    for key in KEYS {
        let kind = match key.input {
            Input::Slider { .. } => "number | string".to_string(),
            Input::Switch => "boolean | 'true' | 'false'".to_string(),
            Input::Choice { choices, meanings } if !meanings.is_empty() => union(choices),
            _ => "Value".to_string(),
        };
        let name = if key.name.contains('-') {
            format!("'{}'", key.name)
        } else {
            key.name.to_string()
        };
        let range = match key.input {
            Input::Slider { .. } if !key.command.range_said || key.group == Group::Sky => {
                format!(". From {}", range(key))
            }
            _ => String::new(),
        };
        text += &format!("  /** {}{range}. */\n  {name}?: {kind};\n", key.help);
    }
    text += "  [name: string]: Value | undefined;\n}\n";
    holds(
        "web/js/welkin.d.ts",
        ["holds this block to it.", "// Settings end."],
        &text,
    );
}

//! What is said where a recipe has something else than the table or the list that belongs there.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue, Error};

/// The longest text of a value that a message quotes, in characters.
const LONGEST: usize = 60;

/// Every table of a recipe but those in lists, which the entries of a list tell.
const TABLES: [&str; 19] = [
    "clouds",
    "clouds.photo",
    "clouds.noise",
    "clouds.detail",
    "clouds.gradient",
    "stars",
    "galaxy",
    "sky",
    "sun",
    "fbm",
    "flares",
    "layers",
    "layers.stratocumulus",
    "layers.cumulus",
    "layers.cirrus",
    "sprites",
    "skybox",
    "skybox.faces",
    "field",
];

/// The lists whose entries are tables.
const LISTS: [&str; 4] = ["field.clouds", "field.models", "field.hours", "boxes"];

/// A value of a wrong kind.
pub(super) struct WrongKind {
    /// Where it is, in bytes.
    pub at: Range<usize>,
    pub key: String,
    pub found: String,
    pub expected: String,
}

/// The value that an error of the parser is about, if it is of a wrong kind.
pub(super) fn wrong_kind(text: &str, error: &Error) -> Option<WrongKind> {
    let message = error.message();
    // Dates come as tables of a single key, whose name says so.
    let expected = match message.split_once(", expected ") {
        _ if message.contains("$__toml_private_datetime") => "a table",
        Some((_, expected)) => expected,
        None => return None,
    };
    let at = error.span()?;
    let recipe = DeTable::parse(text).ok()?;
    let (key, value) = in_table("", recipe.get_ref(), &at)?;
    let found = match value {
        DeValue::Table(_) => "a table".to_string(),
        DeValue::Array(_) => "a list".to_string(),
        _ => text.get(at.clone())?.chars().take(LONGEST).collect(),
    };
    let expected = match expected {
        "a table" if key.ends_with(']') => "a table".to_string(),
        "a table" => format!("a table, which begins with `[{key}]`"),
        "a sequence" if matches!(value, DeValue::Table(_)) => {
            format!("a list of tables, which each begin with `[[{key}]]`")
        }
        "a sequence" => "a list".to_string(),
        _ => return None,
    };
    Some(WrongKind {
        at,
        key,
        found,
        expected,
    })
}

/// A list that stands for a table: the parser would take its entries for the table's keys, in the order in which they are
/// declared.
pub(super) fn list_for_table(text: &str) -> Option<WrongKind> {
    let recipe = DeTable::parse(text).ok()?;
    let (key, at) = list_in_table("", recipe.get_ref())?;
    let expected = if key.ends_with(']') {
        "a table".to_string()
    } else {
        format!("a table, which begins with `[{key}]`")
    };
    Some(WrongKind {
        at,
        key,
        found: "a list".to_string(),
        expected,
    })
}

fn list_in_table(above: &str, table: &DeTable) -> Option<(String, Range<usize>)> {
    let dot = if above.is_empty() { "" } else { "." };
    let mut entries = table.iter();
    entries.find_map(|(key, value)| list_in_value(format!("{above}{dot}{}", key.get_ref()), value))
}

fn list_in_value(key: String, value: &Spanned<DeValue>) -> Option<(String, Range<usize>)> {
    match value.get_ref() {
        DeValue::Table(table) => list_in_table(&key, table),
        DeValue::Array(_) if TABLES.contains(&key.as_str()) => Some((key, value.span())),
        DeValue::Array(list) => {
            let of_tables = LISTS.iter().any(|name| key.ends_with(name));
            let mut entries = list.iter().enumerate();
            entries.find_map(|(index, entry)| {
                let key = format!("{key}[{index}]");
                match entry.get_ref() {
                    DeValue::Table(table) => list_in_table(&key, table),
                    DeValue::Array(_) if of_tables => Some((key, entry.span())),
                    _ => None,
                }
            })
        }
        _ => None,
    }
}

/// The value at a place of the text, and its full key.
fn in_table<'a>(
    above: &str,
    table: &'a DeTable<'a>,
    at: &Range<usize>,
) -> Option<(String, &'a DeValue<'a>)> {
    let dot = if above.is_empty() { "" } else { "." };
    let mut entries = table.iter();
    entries.find_map(|(key, value)| in_value(format!("{above}{dot}{}", key.get_ref()), value, at))
}

fn in_value<'a>(
    key: String,
    value: &'a Spanned<DeValue<'a>>,
    at: &Range<usize>,
) -> Option<(String, &'a DeValue<'a>)> {
    match value.get_ref() {
        found if value.span() == *at => Some((key, found)),
        DeValue::Table(table) => in_table(&key, table, at),
        DeValue::Array(list) => {
            let mut entries = list.iter().enumerate();
            entries.find_map(|(index, value)| in_value(format!("{key}[{index}]"), value, at))
        }
        _ => None,
    }
}

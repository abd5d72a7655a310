//! Fields of clouds, number by number.

use welkin_pack::Field;
use welkin_pack::check::{Examined, Finding, Outcome};
use welkin_pack::field::{Cloud, CloudBox, Sprite};

use super::finding::{counted, finding, skipped};

const SUBJECT: &str = "field";

/// A number or a name of a field, and where it is.
type Entry = (String, String);

/// One finding, if either has a field: how many clouds differ, and the first number that does.
pub(super) fn compare(examined: &Examined, expected: Option<&Field>) -> Option<Finding> {
    match (&examined.field, expected) {
        (Some(found), Some(expected)) => Some(compare_fields(found, expected)),
        (None, Some(_)) if examined.manifest.field.is_some() => {
            Some(skipped(SUBJECT, "the field could not be read"))
        }
        (None, None) => None,
        (found, _) => {
            let note = match found {
                Some(_) => "in the pack, but the recipe makes none",
                None => "not in the pack, but the recipe makes one",
            };
            Some(finding(SUBJECT, Outcome::Failed, None, note.to_string()))
        }
    }
}

fn compare_fields(found: &Field, expected: &Field) -> Finding {
    let pairs = || found.clouds.iter().zip(&expected.clouds).enumerate();
    let differing = pairs().filter(|(_, (a, b))| a != b).count()
        + found.clouds.len().abs_diff(expected.clouds.len());
    let first = first_of(&frame(found), &frame(expected)).or_else(|| {
        let (index, (a, b)) = pairs().find(|(_, (a, b))| a != b)?;
        first_of(&cloud(index, a), &cloud(index, b))
    });
    // A frame that differs, with all clouds the same, is a difference too.
    let count = if found == expected {
        0
    } else {
        differing.max(1)
    };
    counted(SUBJECT, count, first)
}

/// The first entry that differs. Where counts differ, the count comes before what is counted.
fn first_of(found: &[Entry], expected: &[Entry]) -> Option<String> {
    let mut pairs = found.iter().zip(expected);
    let ((place, was), (_, is)) = pairs.find(|(a, b)| a != b)?;
    Some(format!(
        "first at {place}: {was} in the pack, {is} baked anew"
    ))
}

fn entry(place: impl Into<String>, value: impl ToString) -> Entry {
    (place.into(), value.to_string())
}

fn numbers<'a>(place: &'a str, values: &'a [f32]) -> impl Iterator<Item = Entry> + 'a {
    let values = values.iter().enumerate();
    values.map(move |(i, value)| entry(format!("{place}[{i}]"), value))
}

/// All but the clouds themselves.
fn frame(field: &Field) -> Vec<Entry> {
    let mut entries = vec![
        entry("sections", field.sections),
        entry("number of hours", field.hours.len()),
    ];
    for (i, hour) in field.hours.iter().enumerate() {
        let at = |name: &str| format!("hours[{i}].{name}");
        entries.push(entry(at("time"), hour.time));
        entries.push(entry(at("ambient"), hour.ambient));
        entries.extend(numbers(&at("colour"), &hour.colour));
        entries.push(entry(at("least"), hour.least));
        entries.push(entry(at("most"), hour.most));
    }
    entries.push(entry("number of clouds", field.clouds.len()));
    entries
}

fn cloud(index: usize, cloud: &Cloud) -> Vec<Entry> {
    let at = |name: &str| format!("clouds[{index}].{name}");
    let mut entries = vec![
        entry(at("kind"), cloud.kind.name()),
        entry(at("rank"), cloud.rank),
        entry(
            format!("number of groups of clouds[{index}]"),
            cloud.groups_m.len(),
        ),
        entry(
            format!("number of boxes of clouds[{index}]"),
            cloud.boxes.len(),
        ),
        entry(
            format!("number of sprites of clouds[{index}]"),
            cloud.sprites.len(),
        ),
    ];
    for (i, level) in cloud.levels.iter().enumerate() {
        entries.push(entry(at(&format!("levels[{i}].height")), level.height));
        entries.extend(numbers(&at(&format!("levels[{i}].rgba")), &level.rgba));
    }
    for (i, group) in cloud.groups_m.iter().enumerate() {
        entries.extend(numbers(&at(&format!("groups_m[{i}]")), group));
    }
    for (i, cloud_box) in cloud.boxes.iter().enumerate() {
        entries.extend(box_entries(&at(&format!("boxes[{i}]")), cloud_box));
    }
    for (i, sprite) in cloud.sprites.iter().enumerate() {
        entries.extend(sprite_entries(&at(&format!("sprites[{i}]")), sprite));
    }
    entries.extend(numbers(&at("centre_m"), &cloud.centre_m));
    entries.extend(numbers(&at("size_m"), &cloud.size_m));
    entries
}

fn box_entries(at: &str, of: &CloudBox) -> Vec<Entry> {
    let mut entries: Vec<Entry> = numbers(&format!("{at}.centre_m"), &of.centre_m).collect();
    entries.extend(numbers(&format!("{at}.size_m"), &of.size_m));
    entries.push(entry(format!("{at}.category"), of.category.name()));
    entries.push(entry(format!("{at}.group"), of.group));
    entries.push(entry(format!("{at}.cull_m"), of.cull_m));
    entries
}

fn sprite_entries(at: &str, of: &Sprite) -> Vec<Entry> {
    let mut entries: Vec<Entry> = numbers(&format!("{at}.centre_m"), &of.centre_m).collect();
    entries.extend(numbers(&format!("{at}.size_m"), &of.size_m));
    entries.push(entry(format!("{at}.rotation_rad"), of.rotation_rad));
    entries.push(entry(format!("{at}.cell"), of.cell));
    entries.push(entry(format!("{at}.cloud_box"), of.cloud_box));
    entries
}

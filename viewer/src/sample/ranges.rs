//! A file of ranges: what jobs are drawn from.

use toml::{Table, Value as Toml};
use welkin_controls::{KEYS, Settings};
use welkin_runtime::almanac::Date;
use welkin_runtime::params::Input;

use super::fault::Fault;
use super::spread::{Numbers, Spread, number, pair, two};

/// Keys of the file.
const FILE_KEYS: [&str; 6] = ["job", "settings", "hours", "dates", "places", "weather"];
/// Keys of a job that may be drawn; the name is what names begin with.
const JOB_KEYS: [&str; 7] = [
    "name", "pack", "size", "equirect", "cubemap", "format", "oktas",
];
/// Keys of a weather.
const WEATHER_KEYS: [&str; 5] = ["name", "weight", "hours", "oktas", "settings"];

/// What jobs are drawn from.
#[derive(Clone, Debug, PartialEq)]
pub struct Ranges {
    /// What names begin with.
    pub name: String,
    /// Keys of a job.
    pub job: Vec<(String, Spread)>,
    /// Settings of every weather.
    pub settings: Vec<(String, Spread)>,
    /// When, by the sun; all day if there are none.
    pub hours: Vec<[f64; 2]>,
    /// Between which moments, in seconds since 1970.
    pub dates_s: Option<[f64; 2]>,
    /// Where.
    pub places: Option<Places>,
    /// Weathers; without any there is one without a name.
    pub weathers: Vec<Weather>,
}

/// Where.
#[derive(Clone, Debug, PartialEq)]
pub enum Places {
    /// Latitudes and longitudes, evenly by area.
    Box { lat: [f64; 2], lon: [f64; 2] },
    /// Latitude and longitude of each.
    List(Vec<[f64; 2]>),
}

/// A weather: what goes together.
#[derive(Clone, Debug, PartialEq)]
pub struct Weather {
    pub name: String,
    /// How often, against the others.
    pub weight: f64,
    /// When there is such weather; else whenever.
    pub hours: Vec<[f64; 2]>,
    pub oktas: Option<Spread>,
    /// Its settings, in place of those of every weather.
    pub settings: Vec<(String, Spread)>,
}

impl Ranges {
    /// Reads a file of ranges.
    pub fn parse(text: &str) -> Result<Ranges, Fault> {
        let file: Table = text.parse().map_err(|e: toml::de::Error| {
            let line = e
                .span()
                .map_or(1, |at| text[..at.start].matches('\n').count() + 1);
            Fault::Syntax(format!("line {line}: {}", e.message()))
        })?;
        known(&file, "", &FILE_KEYS)?;
        let settings = settings(&file, "settings")?;
        let (mut name, mut job) = ("sky-".to_string(), Vec::new());
        let own = table(&file, "", "job")?;
        known(&own, "job.", &JOB_KEYS)?;
        for (key, value) in own {
            let place = format!("job.{key}");
            match key.as_str() {
                "name" => match value.as_str() {
                    Some(prefix) => name = prefix.to_string(),
                    None => return Err(Fault::value(&place, &value, "what names begin with")),
                },
                "oktas" => job.push((key, oktas(&place, &value)?)),
                _ => job.push((key, Spread::read(&place, &value, None)?)),
            }
        }
        let dates = table(&file, "", "dates")?;
        let weathers = weathers(&file)?;
        let ranges = Ranges {
            name,
            job,
            settings,
            hours: hours(&file, "hours")?,
            dates_s: dates_s(&dates)?,
            places: places(&table(&file, "", "places")?)?,
            weathers,
        };
        ranges.verify()?;
        Ok(ranges)
    }

    /// That nothing is said twice.
    fn verify(&self) -> Result<(), Fault> {
        let mut given = self
            .settings
            .iter()
            .map(|(name, _)| ("settings.", name))
            .collect::<Vec<_>>();
        for weather in &self.weathers {
            given.extend(
                weather
                    .settings
                    .iter()
                    .map(|(name, _)| ("weather.settings.", name)),
            );
        }
        let has_hours = !self.hours.is_empty() || self.weathers.iter().any(|w| !w.hours.is_empty());
        let cases = [
            ("date", self.dates_s.is_some(), "dates", "when it is"),
            ("time", self.dates_s.is_some(), "dates", "when it is"),
            ("time", has_hours, "hours", "when it is"),
            ("date", has_hours, "hours", "when it is"),
            ("lat", self.places.is_some(), "places", "where it is"),
            ("lon", self.places.is_some(), "places", "where it is"),
        ];
        for (setting, is_said, other, what) in cases {
            if let Some((place, _)) = given.iter().find(|(_, name)| is_said && *name == setting) {
                return Err(Fault::Both {
                    one: format!("{place}{setting}"),
                    other: other.to_string(),
                    what,
                });
            }
        }
        Ok(())
    }
}

/// A table of the file, or an empty one.
fn table(file: &Table, before: &str, key: &str) -> Result<Table, Fault> {
    match file.get(key) {
        None => Ok(Table::new()),
        Some(Toml::Table(table)) => Ok(table.clone()),
        Some(other) => Err(Fault::value(
            &format!("{before}{key}"),
            other,
            &format!("a table, [{before}{key}]"),
        )),
    }
}

fn known(table: &Table, before: &str, keys: &[&str]) -> Result<(), Fault> {
    match table.keys().find(|key| !keys.contains(&key.as_str())) {
        None => Ok(()),
        Some(key) => Err(Fault::Unknown {
            key: format!("{before}{key}"),
            expected: keys.join(", "),
        }),
    }
}

/// Spreads of settings, each held to the setting's own range.
fn settings(file: &Table, key: &str) -> Result<Vec<(String, Spread)>, Fault> {
    let mut spreads = Vec::new();
    for (name, value) in table(file, "", "settings")? {
        let place = format!("{key}.{name}");
        let at = |error| Fault::Setting {
            key: place.clone(),
            error,
        };
        Settings::default().get(&name).map_err(at)?;
        let numbers = KEYS
            .iter()
            .find(|key| key.name == name)
            .and_then(|key| match key.input {
                Input::Slider {
                    low, high, whole, ..
                } => Some(Numbers {
                    ends: [low, high],
                    whole,
                }),
                _ => None,
            });
        let spread = Spread::read(&place, &value, numbers)?;
        for value in spread.extremes() {
            let text = value
                .as_str()
                .map_or_else(|| value.to_string(), str::to_string);
            Settings::default().set(&name, &text).map_err(at)?;
        }
        spreads.push((name, spread));
    }
    Ok(spreads)
}

fn oktas(key: &str, value: &Toml) -> Result<Spread, Fault> {
    let numbers = Numbers {
        ends: [0.0, 8.0],
        whole: false,
    };
    let spread = Spread::read(key, value, Some(numbers))?;
    let is_oktas =
        |value: &serde_json::Value| value.as_f64().is_some_and(|o| (0.0..=8.0).contains(&o));
    match spread.extremes().iter().all(is_oktas) {
        true => Ok(spread),
        false => Err(Fault::value(key, value, "numbers from 0 to 8")),
    }
}

/// Spans of hours by the sun.
fn hours(table: &Table, key: &str) -> Result<Vec<[f64; 2]>, Fault> {
    const EXPECTED: &str =
        "spans of hours from 0 to 24, each longer than nothing, such as [[5, 10], [16, 21]]";
    let Some(value) = table.get("hours") else {
        return Ok(Vec::new());
    };
    let spans = value.as_array().filter(|spans| !spans.is_empty());
    let spans = spans.ok_or_else(|| Fault::value(key, value, EXPECTED))?;
    let mut hours = Vec::new();
    for span in spans {
        let [from, to] = two(key, span, EXPECTED)?;
        if !(0.0 <= from && from < to && to <= 24.0) {
            return Err(Fault::value(key, value, EXPECTED));
        }
        hours.push([from, to]);
    }
    Ok(hours)
}

fn dates_s(dates: &Table) -> Result<Option<[f64; 2]>, Fault> {
    known(dates, "dates.", &["from", "to"])?;
    if dates.is_empty() {
        return Ok(None);
    }
    let end = |name: &str| {
        let key = format!("dates.{name}");
        let Some(value) = dates.get(name) else {
            return Err(Fault::value(
                &key,
                &"not there",
                "a moment such as 2026-06-21T18:30:00Z",
            ));
        };
        // TOML has dates of its own.
        let text = value
            .as_str()
            .map_or_else(|| value.to_string(), str::to_string);
        let date: Result<Date, _> = text.parse();
        date.map(Date::unix_s).map_err(|error| {
            Fault::value(
                &key,
                value,
                error.to_string().trim_start_matches("expected "),
            )
        })
    };
    let ends = [end("from")?, end("to")?];
    match ends[0] < ends[1] {
        true => Ok(Some(ends)),
        false => Err(Fault::value(
            "dates.to",
            &dates["to"],
            "a moment after dates.from",
        )),
    }
}

fn places(places: &Table) -> Result<Option<Places>, Fault> {
    known(places, "places.", &["lat", "lon", "list"])?;
    let within = |key: &str, most: f64| {
        let Some(value) = places.get(key) else {
            return Err(Fault::value(
                &format!("places.{key}"),
                &"not there",
                "two numbers of degrees, with lat and lon both",
            ));
        };
        let key = format!("places.{key}");
        let ends = pair(&key, value)?;
        match ends[0] >= -most && ends[1] <= most {
            true => Ok(ends),
            false => Err(Fault::value(
                &key,
                value,
                &format!("two numbers from -{most} to {most}, the lower first"),
            )),
        }
    };
    match (places.is_empty(), places.get("list")) {
        (true, _) => Ok(None),
        (false, None) => Ok(Some(Places::Box {
            lat: within("lat", 90.0)?,
            lon: within("lon", 180.0)?,
        })),
        (false, Some(_)) if places.len() > 1 => Err(Fault::Both {
            one: "places.list".into(),
            other: "places.lat and places.lon".into(),
            what: "where it is",
        }),
        (false, Some(list)) => {
            let expected = "latitude and longitude of each, such as [[59.9, 30.3], [52.5, 13.4]]";
            let key = "places.list";
            let values = list.as_array().filter(|values| !values.is_empty());
            let values = values.ok_or_else(|| Fault::value(key, list, expected))?;
            let place = |value: &Toml| {
                let [lat, lon] = two(key, value, expected)?;
                match lat.abs() <= 90.0 && lon.abs() <= 180.0 {
                    true => Ok([lat, lon]),
                    false => Err(Fault::value(key, value, expected)),
                }
            };
            Ok(Some(Places::List(
                values.iter().map(place).collect::<Result<_, _>>()?,
            )))
        }
    }
}

fn weathers(file: &Table) -> Result<Vec<Weather>, Fault> {
    let Some(value) = file.get("weather") else {
        return Ok(Vec::new());
    };
    let tables = value.as_array().map(|values| {
        values
            .iter()
            .map(Toml::as_table)
            .collect::<Option<Vec<_>>>()
    });
    let Some(Some(tables)) = tables else {
        return Err(Fault::value("weather", value, "tables, [[weather]]"));
    };
    let mut weathers = Vec::new();
    for (i, table) in tables.into_iter().enumerate() {
        let before = format!("weather {}, ", i + 1);
        let key = |name: &str| format!("{before}{name}");
        known(table, &before, &WEATHER_KEYS)?;
        let name = match table.get("name") {
            Some(Toml::String(name)) => name.clone(),
            Some(other) => return Err(Fault::value(&key("name"), other, "a word for it")),
            None => return Err(Fault::value(&key("name"), &"not there", "a word for it")),
        };
        let weight = match table.get("weight") {
            None => 1.0,
            Some(value) => match number(value) {
                Some(weight) if weight > 0.0 && weight <= 1e9 => weight,
                _ => return Err(Fault::value(&key("weight"), value, "a number above 0")),
            },
        };
        let oktas = match table.get("oktas") {
            None => None,
            Some(value) => Some(oktas(&key("oktas"), value)?),
        };
        weathers.push(Weather {
            name,
            weight,
            hours: hours(table, &key("hours"))?,
            oktas,
            settings: settings(table, &key("settings"))?,
        });
    }
    Ok(weathers)
}

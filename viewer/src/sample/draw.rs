//! Draws jobs from ranges.

use std::collections::BTreeMap;

use serde::Serialize;
use serde_json::Value;
use welkin_runtime::almanac::Date;

use super::ranges::{Places, Ranges, Weather};
use super::spread::Spread;
use super::stream::Stream;

const DAY_S: f64 = 86_400.0;
/// The sun goes so many seconds for a degree of longitude.
const DEGREE_S: f64 = 240.0;
/// Moments that skies are told apart by, in whole seconds, where the file says no other.
const LAST_AT_S: f64 = 1e6;

/// A job, its keys in this order.
#[derive(Serialize)]
struct Drawn {
    name: String,
    seed: u64,
    #[serde(skip_serializing_if = "Option::is_none")]
    weather: Option<String>,
    #[serde(flatten)]
    job: BTreeMap<String, Value>,
    settings: BTreeMap<String, Value>,
}

/// A line: the job of a number from 0.
pub fn line(ranges: &Ranges, seed: u64, number: u64) -> serde_json::Result<String> {
    let stream = |key: &str| Stream::new(seed, number, key);
    let weather = weather(&ranges.weathers, stream("weather").unit());
    let own = weather.map_or(&[][..], |weather| &weather.settings);
    let mut settings = BTreeMap::new();
    let mut draw = |(name, spread): &(String, Spread)| {
        let value = spread.draw(&mut stream(&format!("settings.{name}")));
        settings.insert(name.clone(), value);
    };
    let is_own = |name: &str| own.iter().any(|(own, _)| own == name);
    let shared = ranges.settings.iter().filter(|(name, _)| !is_own(name));
    shared.chain(own).for_each(&mut draw);
    let at_s = match settings.get("at").and_then(Value::as_f64) {
        Some(at_s) => at_s,
        None => {
            let at_s = (LAST_AT_S * stream("settings.at").unit()).floor();
            settings.insert("at".to_string(), Value::from(at_s as u64));
            at_s
        }
    };
    let mut lon = settings.get("lon").and_then(Value::as_f64).unwrap_or(0.0);
    if let Some(places) = &ranges.places {
        let [lat, east] = place(places, &mut stream("places"));
        lon = east;
        settings.insert("lat".to_string(), Value::from(lat));
        settings.insert("lon".to_string(), Value::from(lon));
    }
    let own_hours = weather.map_or(&[][..], |weather| &weather.hours);
    let hours = if own_hours.is_empty() {
        &ranges.hours
    } else {
        own_hours
    };
    let hour = hour(hours, stream("hours").unit());
    match (ranges.dates_s, hour) {
        (Some([from, to]), hour) => {
            let moment_s = (from + (to - from) * stream("dates").unit()).floor();
            let moment_s = hour.map_or(moment_s, |hour| by_sun(moment_s, lon, hour));
            // The seconds of the animation go on from the date.
            let date = Date::from_unix_s(moment_s).map(|date| date.after(-at_s));
            if let Ok(date) = date {
                settings.insert("date".to_string(), Value::from(date.to_string()));
            }
        }
        (None, Some(hour)) => {
            let time = (1e6 * hour / 24.0).round() / 1e6;
            settings.insert("time".to_string(), Value::from(time));
        }
        (None, None) => {}
    }
    let oktas = weather.and_then(|weather| weather.oktas.as_ref());
    let mut job = BTreeMap::new();
    for (key, spread) in &ranges.job {
        job.insert(key.clone(), spread.draw(&mut stream(&format!("job.{key}"))));
    }
    if let Some(spread) = oktas {
        job.insert("oktas".to_string(), spread.draw(&mut stream("job.oktas")));
    }
    serde_json::to_string(&Drawn {
        name: format!("{}{number:06}", ranges.name),
        seed: stream("seed").bits(),
        weather: weather.map(|weather| weather.name.clone()),
        job,
        settings,
    })
}

/// One of the weathers, by their weights.
fn weather(weathers: &[Weather], unit: f64) -> Option<&Weather> {
    let mut left = unit * weathers.iter().map(|weather| weather.weight).sum::<f64>();
    let drawn = weathers.iter().find(|weather| {
        left -= weather.weight;
        left < 0.0
    });
    drawn.or(weathers.last())
}

/// An hour in the spans, evenly over all of them.
fn hour(spans: &[[f64; 2]], unit: f64) -> Option<f64> {
    let mut left = unit * spans.iter().map(|[from, to]| to - from).sum::<f64>();
    for [from, to] in spans {
        if left < to - from {
            return Some(from + left);
        }
        left -= to - from;
    }
    spans.last().map(|[_, to]| *to)
}

/// The moment of that day at which the mean sun shows the hour: the day begins at its midnight.
fn by_sun(moment_s: f64, lon: f64, hour: f64) -> f64 {
    let east_s = DEGREE_S * lon;
    let day = ((moment_s + east_s) / DAY_S).floor();
    (day * DAY_S + hour * 3600.0 - east_s).floor()
}

/// Latitude and longitude, to a ten thousandth of a degree.
fn place(places: &Places, stream: &mut Stream) -> [f64; 2] {
    let degrees = |x: f64, [low, high]: [f64; 2]| ((1e4 * x).round() / 1e4).clamp(low, high) + 0.0;
    match places {
        Places::List(list) => {
            let place = (stream.unit() * list.len() as f64) as usize;
            list[place.min(list.len() - 1)]
        }
        Places::Box { lat, lon } => {
            // Area goes by the sine of latitude.
            let sines = lat.map(|lat| libm::sin(lat.to_radians()));
            let sine = sines[0] + (sines[1] - sines[0]) * stream.unit();
            let latitude = libm::asin(sine.clamp(-1.0, 1.0)).to_degrees();
            let longitude = lon[0] + (lon[1] - lon[0]) * stream.unit();
            [degrees(latitude, *lat), degrees(longitude, *lon)]
        }
    }
}

use std::collections::BTreeMap;

use serde_json::Value;
use welkin_runtime::almanac::Date;

use super::draw::line;
use super::ranges::Ranges;
use crate::job::Job;

/// The page's own example.
const EXAMPLE: &str = include_str!("ranges.toml");

fn lines(text: &str, seed: u64, count: u64) -> Vec<BTreeMap<String, Value>> {
    let ranges = Ranges::parse(text).unwrap();
    let line = |i| {
        let text = line(&ranges, seed, i).unwrap();
        Job::parse(&text, i).unwrap_or_else(|fault| panic!("{text}: {fault}"));
        serde_json::from_str(&text).unwrap()
    };
    (0..count).map(line).collect()
}

fn setting(line: &BTreeMap<String, Value>, name: &str) -> f64 {
    let value = &line["settings"][name];
    value
        .as_f64()
        .unwrap_or_else(|| panic!("{name} is {value}"))
}

fn error_of(text: &str) -> String {
    match Ranges::parse(text) {
        Ok(ranges) => panic!("{text} was accepted: {ranges:?}"),
        Err(fault) => fault.to_string(),
    }
}

#[test]
fn the_first_lines_are_the_same_everywhere() {
    let ranges = Ranges::parse(EXAMPLE).unwrap();
    let found: Vec<String> = (0..3).map(|i| line(&ranges, 7, i).unwrap()).collect();
    let golden = include_str!("golden.jsonl");
    assert_eq!(found, golden.lines().collect::<Vec<_>>());
}

#[test]
fn a_line_depends_on_seed_and_number_alone_and_a_key_on_no_other() {
    let text = "[settings]\ncover = {uniform = [0, 1]}\nheight = {uniform = [0, 1]}";
    let (some, more) = (lines(text, 3, 5), lines(text, 3, 9));
    assert_eq!(some, more[..5]);
    assert_ne!(some, lines(text, 4, 5));
    assert_ne!(some[0]["settings"], some[1]["settings"]);
    assert_ne!(setting(&some[0], "cover"), setting(&some[0], "height"));
    let without = lines("[settings]\nheight = {uniform = [0, 1]}", 3, 5);
    for (with, without) in some.iter().zip(&without) {
        assert_eq!(setting(with, "height"), setting(without, "height"));
        assert_eq!(
            (&with["seed"], &with["name"]),
            (&without["seed"], &without["name"])
        );
    }
}

#[test]
fn numbers_are_drawn_as_they_were_told() {
    let text = "[settings]\ncover = {uniform = [0.2, 0.6]}\ndensity = {normal = [0.5, 0.2], within = [0.3, 0.9]}\nheight = {normal = [0, 0.4]}
        octaves = {uniform = [2, 4]}\nmethod = {choice = [\"lit\", \"fbm\"], weights = [3, 1]}\nsun = false\nat = 5\nflare = {uniform = [0.25, 0.25]}";
    let all = lines(text, 1, 4000);
    let of = |name: &str| {
        all.iter()
            .map(|line| setting(line, name))
            .collect::<Vec<f64>>()
    };
    let mean = |numbers: &[f64]| numbers.iter().sum::<f64>() / numbers.len() as f64;
    let cover = of("cover");
    assert!(cover.iter().all(|c| (0.2..=0.6).contains(c)));
    // A deviation of 0.4 / sqrt(12 n), four times.
    assert!((mean(&cover) - 0.4).abs() < 4.0 * 0.115_47 / 4000_f64.sqrt());
    assert!(of("density").iter().all(|d| (0.3..=0.9).contains(d)));
    // Half a normal distribution within the setting's own range: 0.4 sqrt(2 / pi), less what is beyond 1.
    let height = mean(&of("height"));
    assert!((0.28..0.33).contains(&height), "{height}");
    let counts = [2.0, 3.0, 4.0].map(|n| of("octaves").iter().filter(|o| **o == n).count());
    // A third each, with a deviation of 30.
    assert!(counts.iter().all(|c| c.abs_diff(1333) < 120), "{counts:?}");
    assert_eq!(counts.iter().sum::<usize>(), 4000);
    let lit = all
        .iter()
        .filter(|line| line["settings"]["method"] == "lit")
        .count();
    // Three quarters, with a deviation of 27.
    assert!(lit.abs_diff(3000) < 110, "{lit}");
    assert!(of("flare").iter().all(|f| *f == 0.25) && of("at").iter().all(|at| *at == 5.0));
    assert_eq!(all[0]["settings"]["sun"], Value::Bool(false));
}

#[test]
fn what_belongs_to_a_weather_goes_together() {
    let text = "hours = [[8, 16]]\n[job]\noktas = 8\n[settings]\nhaze = 0.1\n
        [[weather]]\nname = \"fair\"\nweight = 2\noktas = {uniform = [0, 3]}\n
        [[weather]]\nname = \"fog\"\nhours = [[4, 7], [22, 23]]\noktas = 8\n[weather.settings]\nhaze = {uniform = [0.8, 1]}";
    let all = lines(text, 9, 3000);
    let (fair, fog): (Vec<_>, Vec<_>) = all.iter().partition(|line| line["weather"] == "fair");
    // Two thirds, with a deviation of 26.
    assert!(fair.len().abs_diff(2000) < 104, "{}", fair.len());
    for line in fair {
        let hour = 24.0 * setting(line, "time");
        assert!((8.0..16.0).contains(&hour) && setting(line, "haze") == 0.1);
        assert!((0.0..=3.0).contains(&line["oktas"].as_f64().unwrap()));
    }
    let mut late = 0;
    for line in &fog {
        let hour = 24.0 * setting(line, "time");
        assert!(
            (4.0..7.0).contains(&hour) || (22.0..23.0).contains(&hour),
            "{hour}"
        );
        assert!(setting(line, "haze") >= 0.8 && line["oktas"] == 8);
        late += usize::from(hour > 20.0);
    }
    // An hour of four, with a deviation of 14.
    assert!(late.abs_diff(fog.len() / 4) < 56, "{late} of {}", fog.len());
}

#[test]
fn the_moment_shown_is_of_the_span_and_the_hour_is_the_sun_s() {
    let text = "hours = [[11, 13]]\n[dates]\nfrom = \"2026-01-01\"\nto = 2027-01-01T00:00:00Z\n[places]\nlat = [-30, 60]\nlon = [-180, 180]";
    let all = lines(text, 5, 2000);
    let mut north = 0;
    for line in &all {
        let date: Date = line["settings"]["date"].as_str().unwrap().parse().unwrap();
        let shown_s = date.unix_s() + setting(line, "at");
        let hour = (shown_s / 3600.0 + setting(line, "lon") / 15.0).rem_euclid(24.0);
        assert!((10.999..13.001).contains(&hour), "{hour}");
        let begin_s = "2026-01-01".parse::<Date>().unwrap().unix_s();
        // By the sun's own day it may be another one at the ends.
        assert!((-1.0..366.0).contains(&((shown_s - begin_s) / 86_400.0)));
        let lat = setting(line, "lat");
        assert!((-30.0..=60.0).contains(&lat));
        north += usize::from(lat > 0.0);
    }
    // By area: sin 60 of sin 60 + sin 30, 1268 with a deviation of 22.
    assert!(north.abs_diff(1268) < 88, "{north}");
    let listed = lines(
        "[dates]\nfrom = \"2026-06-21\"\nto = \"2026-06-22\"\n[places]\nlist = [[59.9, 30.3], [-33.9, 151.2]]",
        5,
        200,
    );
    let south = listed.iter().filter(|line| setting(line, "lat") == -33.9);
    assert!(south.clone().all(|line| setting(line, "lon") == 151.2));
    assert!((50..150).contains(&south.count()));
    for line in &listed {
        let date: Date = line["settings"]["date"].as_str().unwrap().parse().unwrap();
        let shown = date.after(setting(line, "at")).to_string();
        assert!(shown.starts_with("2026-06-21T"), "{shown}");
    }
}

#[test]
fn what_is_wrong_is_told_with_key_found_and_expected() {
    for (text, parts) in [
        ("a = ", &["no TOML", "line 1"][..]),
        ("ranges = 1", &["no key ranges", "job, settings"]),
        (
            "[settings]\ncovr = 1",
            &["settings.covr", "did you mean \"cover\""],
        ),
        (
            "[settings]\ncover = 2",
            &["settings.cover", "\"2\"", "from 0 to 1"],
        ),
        (
            "[settings]\ncover = {uniform = [0, 1.5]}",
            &["settings.cover", "1.5", "from 0 to 1"],
        ),
        (
            "[settings]\ncover = {uniform = [0.5, 0.1]}",
            &["settings.cover.uniform", "the lower first"],
        ),
        (
            "[settings]\ncover = {uniform = [0.5]}",
            &["settings.cover.uniform", "[0.5]"],
        ),
        (
            "[settings]\ncover = {uniform = [nan, 1]}",
            &["settings.cover.uniform", "nan"],
        ),
        ("[settings]\ncover = nan", &["settings.cover", "nan"]),
        (
            "[settings]\ncover = {normal = [0.5, 0]}",
            &["settings.cover.normal", "above 0"],
        ),
        (
            "[settings]\ncover = {normal = [9, 0.1]}",
            &["settings.cover.normal", "at most 4 deviations"],
        ),
        (
            "[settings]\ncover = {normal = [0.5, 1e9]}",
            &["settings.cover.normal", "deviation"],
        ),
        (
            "[settings]\ncover = {normal = [0.5, 0.1], within = [0, 2]}",
            &["settings.cover", "from 0 to 1"],
        ),
        (
            "[settings]\noctaves = {normal = [4, 1]}",
            &["settings.octaves.normal", "whole numbers"],
        ),
        (
            "[settings]\noctaves = {uniform = [0.5, 4]}",
            &["settings.octaves"],
        ),
        (
            "[settings]\nmethod = {uniform = [0, 1]}",
            &["settings.method", "choice"],
        ),
        (
            "[settings]\nmethod = {choice = [\"lit\", \"fog\"]}",
            &["settings.method", "fog", "packed"],
        ),
        (
            "[settings]\nmethod = {choice = []}",
            &["settings.method.choice", "a list"],
        ),
        (
            "[settings]\nmethod = {choice = [\"lit\"], weights = [0]}",
            &["settings.method.weights", "not all 0"],
        ),
        (
            "[settings]\nmethod = {choice = [\"lit\"], weights = [1, 2]}",
            &["settings.method.weights", "1 numbers"],
        ),
        (
            "[settings]\ncover = {uniform = [0, 1], choice = [1]}",
            &["settings.cover", "one of"],
        ),
        (
            "[settings]\ncover = {gauss = [0, 1]}",
            &["settings.cover.gauss", "uniform"],
        ),
        ("settings = 1", &["settings is 1", "[settings]"]),
        ("[job]\ncover = 1", &["no key job.cover", "name, pack"]),
        (
            "[job]\noktas = {uniform = [0, 9]}",
            &["job.oktas", "from 0 to 8"],
        ),
        ("[job]\nname = 1", &["job.name is 1"]),
        ("hours = [[5, 25]]", &["hours is", "from 0 to 24"]),
        ("hours = [5, 6]", &["hours is 5", "spans of hours"]),
        ("[dates]\nfrom = \"2026-01-01\"", &["dates.to", "not there"]),
        (
            "[dates]\nfrom = \"2026-02-30\"\nto = \"2027-01-01\"",
            &["dates.from", "2026-02-30", "a day"],
        ),
        (
            "[dates]\nfrom = \"2026-02-03\"\nto = \"2026-01-01\"",
            &["dates.to", "after dates.from"],
        ),
        (
            "[places]\nlat = [0, 91]\nlon = [0, 1]",
            &["places.lat", "-90 to 90"],
        ),
        ("[places]\nlat = [0, 9]", &["places.lon", "not there"]),
        ("[places]\nlist = [[0, 181]]", &["places.list", "longitude"]),
        (
            "[places]\nlist = [[0, 1]]\nlat = [0, 1]",
            &["places.list", "leave one"],
        ),
        ("weather = 1", &["weather is 1", "[[weather]]"]),
        ("[[weather]]\nweight = 1", &["weather 1, name", "not there"]),
        (
            "[[weather]]\nname = \"a\"\n[[weather]]\nname = \"b\"\nweight = 0",
            &["weather 2, weight", "above 0"],
        ),
        (
            "[[weather]]\nname = \"a\"\n[weather.settings]\ncovr = 1",
            &["weather 1, settings.covr", "cover"],
        ),
        (
            "hours = [[5, 6]]\n[settings]\ntime = 0.5",
            &["settings.time", "hours", "leave one"],
        ),
        (
            "[dates]\nfrom = \"2026-01-01\"\nto = \"2026-02-01\"\n[settings]\ndate = \"2026-01-01\"",
            &["settings.date", "dates"],
        ),
        (
            "[places]\nlist = [[0, 1]]\n[settings]\nlat = 3",
            &["settings.lat", "places"],
        ),
    ] {
        let error = error_of(text);
        for part in parts {
            assert!(error.contains(part), "{text}: no {part:?} in {error}");
        }
        assert!(!error.contains('\n') && error.len() < 400, "{error}");
    }
}

#[test]
fn nothing_given_is_the_usual_sky_at_moments_of_its_own() {
    let all = lines("", 1, 3);
    for line in &all {
        let settings = line["settings"].as_object().unwrap();
        assert_eq!(settings.keys().collect::<Vec<_>>(), ["at"]);
    }
    assert_ne!(all[0]["settings"], all[1]["settings"]);
    assert_eq!(all[2]["name"], "sky-000002");
}

//! What `welkin-view bench` prints. How long a frame takes is nothing that a test could know.

// The lint's exception for tests does not reach their helpers.
#![allow(clippy::unwrap_used)]

use serde_json::Value;

use crate::common::{failed, pack, run, view};

const REFERENCES: [&str; 2] = ["one sample", "four samples"];

fn bench(words: &[&str]) -> String {
    let mut command = view(&["bench"]);
    command.arg(pack()).args(words);
    let output = run(command);
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{stderr}");
    String::from_utf8(output.stdout).unwrap()
}

/// What is timed of lit alone.
const LIT: [&str; 5] = [
    "alone, 1 layer",
    "alone, 6 layers",
    "alone, ground shadow",
    "noon, rays",
    "noon, rain",
];

/// Names of the rows of a method, in the order of the table.
fn rows_of(method: &str) -> Vec<String> {
    if method == "sprites" {
        return rows_of_sprites();
    }
    let mut labels = ["noon", "sunset", "night", "alone"]
        .map(str::to_string)
        .to_vec();
    match method {
        "octaves" => labels
            .extend((1..=8).map(|n| format!("alone, {n} octave{}", if n == 1 { "" } else { "s" }))),
        "fbm" => labels.push("alone, sun moves".to_string()),
        "packed" => labels.push("alone, Perez sky".to_string()),
        "lit" => labels.extend(LIT.map(str::to_string)),
        _ => {}
    }
    labels
        .iter()
        .map(|label| format!("{method}, {label}"))
        .collect()
}

fn rows_of_sprites() -> Vec<String> {
    let labels = ["no clouds", "sprites alone", "ring", "ring made anew"];
    let of = |field: &str| labels.map(|label| format!("sprites, {field}, {label}"));
    ["sparse", "broken", "overcast"].map(of).concat()
}

fn names(passes: &[Value]) -> Vec<&str> {
    passes.iter().map(|p| p["name"].as_str().unwrap()).collect()
}

#[test]
fn by_itself_it_times_the_packed_method_beside_the_reference_passes() {
    let report: Value =
        serde_json::from_str(&bench(&["--frames", "3", "--size", "64x48", "--json"])).unwrap();
    assert_eq!(report["size"], serde_json::json!([64, 48]));
    assert_eq!(
        (&report["frames"], &report["warm_up_frames"]),
        (&3.into(), &10.into())
    );
    let passes = report["passes"].as_array().unwrap();
    let mut expected = rows_of("packed");
    expected.extend(REFERENCES.map(str::to_string));
    assert_eq!(names(passes), expected);
    for pass in passes {
        let [p10, median, p90, mean] =
            ["p10_ms", "median_ms", "p90_ms", "mean_ms"].map(|key| pass[key].as_f64().unwrap());
        assert!(0.0 < p10 && p10 <= median && median <= p90, "{pass}");
        // From the least of three times to the median, p10 goes a fifth of the way and the mean two thirds or more.
        assert!(mean > p10 * (1.0 - 1e-9), "{pass}");
        let [dome, ratio] = ["dome_ms", "ratio"].map(|key| pass[key].as_f64().unwrap());
        assert!(0.0 < dome && ratio > 0.0, "{pass}");
    }
    assert_eq!(passes.last().unwrap()["ratio"], 1.0);
}

#[test]
fn with_all_methods_it_is_one_table_with_each_method_s_memory() {
    let words = [
        "--method", "all", "--frames", "2", "--size", "16x16", "--json",
    ];
    let report: Value = serde_json::from_str(&bench(&words)).unwrap();
    let (skies, references) = report["passes"]
        .as_array()
        .unwrap()
        .split_at(5 + 12 + 5 + 9 + 12);
    assert_eq!(names(references), REFERENCES);
    let expected: Vec<String> = ["packed", "octaves", "fbm", "lit", "sprites"]
        .into_iter()
        .flat_map(rows_of)
        .collect();
    assert_eq!(names(skies), expected);
    for sky in skies {
        let method = sky["method"].as_str().unwrap();
        assert!(sky["name"].as_str().unwrap().starts_with(method), "{sky}");
        assert!(sky["memory_bytes"].as_u64().unwrap() > 0, "{sky}");
        let [prepare, map] = ["prepare_ms", "map_ms"].map(|key| sky[key].as_f64().unwrap());
        assert!(prepare > 0.0 && map >= 0.0, "{sky}");
        // The others but sprites draw a map off screen, every frame.
        let has_map = !["packed", "sprites"].contains(&method);
        assert!(!has_map || map > 0.0, "{sky}");
        let draws_sprites =
            method == "sprites" && !sky["name"].as_str().unwrap().contains("no clouds");
        assert_eq!(sky["sprites"].is_array(), draws_sprites, "{sky}");
    }
    for reference in references {
        for key in ["method", "prepare_ms", "map_ms", "memory_bytes"] {
            assert_eq!(reference[key], Value::Null, "{key}");
        }
    }
}

#[test]
fn the_table_has_a_line_for_every_row() {
    let table = bench(&["--method", "fbm", "--frames", "1", "--size", "8x8"]);
    let rows: Vec<&str> = table
        .lines()
        .skip_while(|line| !line.starts_with("row "))
        .skip(1)
        .collect();
    let names = rows_of("fbm")
        .into_iter()
        .chain(REFERENCES.map(str::to_string));
    for (row, name) in rows.iter().zip(names) {
        assert!(row.starts_with(&format!("{name}  ")), "{table}");
    }
    assert_eq!(rows.len(), 7, "{table}");
    assert!(table.ends_with("-\n") && table.contains("1.00x"), "{table}");
    let first: Vec<&str> = table.lines().take(2).collect();
    assert!(
        first[1].starts_with("8x8 pixels") && !first[0].is_empty(),
        "{table}"
    );
}

#[test]
fn what_a_protocol_sets_cannot_be_set_again() {
    let attempts: [(&[&str], &[&str]); 3] = [
        (
            &["--protocol", "mukhina", "--method", "packed"],
            &["--method packed", "--protocol mukhina, which times lit"],
        ),
        (
            &["--protocol", "mukhina", "--size", "64x48"],
            &["--size 64x48", "800x600, 1280x720 and 1920x1080"],
        ),
        (
            &["--protocol", "bezgodov"],
            &["bezgodov", "--protocol", "mukhina"],
        ),
    ];
    for (words, told) in attempts {
        let mut command = view(&["bench"]);
        command.arg(pack()).args(words);
        let output = run(command);
        failed(&output, 2, told);
        assert!(output.stdout.is_empty());
    }
}

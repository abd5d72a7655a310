//! `welkin-view sample`, run as its users run it, and what it makes drawn.

// The lint's exception for tests does not reach their helpers.
#![allow(clippy::unwrap_used)]

use std::fs;
use std::process::Stdio;

use crate::common::{done, failed, files, render_to, run, view};

const RANGES: &str = "hours = [[6, 18]]\n[job]\nsize = [24, 16]\n[settings]\nmethod = {choice = [\"packed\", \"fbm\"]}\n[[weather]]\nname = \"fair\"\noktas = {uniform = [1, 7]}\n";

#[test]
fn what_is_drawn_from_ranges_becomes_pictures() {
    let folder = tempfile::tempdir().unwrap();
    let place = |name: &str| folder.path().join(name);
    fs::write(
        place("ranges.toml"),
        format!("\u{feff}{}", RANGES.replace('\n', "\r\n")),
    )
    .unwrap();
    let sample = |output: &str| {
        let mut command = view(&[
            "sample",
            "ranges.toml",
            "--count",
            "4",
            "--seed",
            "3",
            "-o",
            output,
        ]);
        command.current_dir(folder.path());
        command
    };
    done(sample("jobs.jsonl"));
    let jobs = fs::read(place("jobs.jsonl")).unwrap();
    assert_eq!(jobs.split(|b| *b == b'\n').count(), 5);
    let mut command = render_to(&place("out"), &["--jobs"]);
    command.arg(place("jobs.jsonl"));
    done(command);
    let first = files(&place("out"));
    assert_eq!(first.len(), 5);
    let index = String::from_utf8(first["index.jsonl"].clone()).unwrap();
    assert_eq!(index.matches("\"weather\":\"fair\"").count(), 4);
    // The same through a pipe.
    let mut piped = sample("-").stdout(Stdio::piped()).spawn().unwrap();
    let mut command = render_to(&place("piped"), &["--jobs", "-"]);
    command.stdin(piped.stdout.take().unwrap());
    done(command);
    assert!(piped.wait().unwrap().success());
    assert!(files(&place("piped")) == first);
    // Inputs stay, and what is wrong leaves nothing.
    failed(
        &run(sample("ranges.toml")),
        1,
        &["ranges.toml", "which is read"],
    );
    failed(
        &run(sample("none/jobs.jsonl")),
        1,
        &["none/jobs.jsonl", "cannot be written"],
    );
    let ranges = RANGES.replace("fbm", "fog");
    fs::write(place("ranges.toml"), &ranges).unwrap();
    failed(
        &run(sample("other.jsonl")),
        1,
        &["ranges.toml", "settings.method", "fog", "packed"],
    );
    fs::write(
        place("ranges.toml"),
        RANGES.replace("[settings]", "[settings]\ncover = 0.5"),
    )
    .unwrap();
    failed(
        &run(sample("other.jsonl")),
        1,
        &["ranges.toml", "oktas", "cover"],
    );
    assert!(!place("other.jsonl").exists());
    let mut command = sample("other.jsonl");
    command.args(["--count", "0"]);
    failed(&run(command), 2, &["--count"]);
}

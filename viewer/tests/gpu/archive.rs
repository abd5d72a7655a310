//! `welkin-view render --jobs --tar`, run as its users run it.

// The lint's exception for tests does not reach their helpers.
#![allow(clippy::unwrap_used)]

use std::fs;
use std::io::Read;
use std::path::Path;

use serde_json::{Value, json};

use crate::common::{done, failed, files, render_to, run};

/// Names and bytes of what is in a tar file, in its order.
fn entries(file: &Path) -> Vec<(String, Vec<u8>)> {
    let mut archive = tar::Archive::new(fs::File::open(file).unwrap());
    let entry = |entry: std::io::Result<tar::Entry<'_, fs::File>>| {
        let mut entry = entry.unwrap();
        assert_eq!(entry.header().mtime().unwrap(), 0);
        let name = entry.path().unwrap().to_str().unwrap().to_string();
        let mut bytes = Vec::new();
        entry.read_to_end(&mut bytes).unwrap();
        (name, bytes)
    };
    archive.entries().unwrap().map(entry).collect()
}

#[test]
fn samples_are_in_tar_files_that_are_there_or_are_made_as_a_whole() {
    let parent = tempfile::tempdir().unwrap();
    let place = |name: &str| parent.path().join(name);
    let jobs = |cover: f32| -> String {
        let line = |i: usize| {
            let cover = if i == 4 { cover } else { 0.5 };
            json!({ "name": format!("m{i}"), "size": [24, 16], "settings": { "at": 60 * i, "cover": cover } })
        };
        (0..7).map(|i| format!("{}\n", line(i))).collect()
    };
    fs::write(place("jobs.jsonl"), jobs(0.5)).unwrap();
    let draw = |out: &str, words: &[&str]| {
        let mut command = render_to(&place(out), &["--labels", "mask,sun", "--jobs"]);
        command.arg(place("jobs.jsonl")).args(words);
        command
    };
    done(draw("loose", &[]));
    done(draw("out", &["--tar", "3"]));
    let (loose, whole) = (files(&place("loose")), files(&place("out")));
    let names: Vec<&String> = whole.keys().collect();
    assert_eq!(
        names,
        [
            "index.jsonl",
            "skies-000000.tar",
            "skies-000001.tar",
            "skies-000002.tar"
        ]
    );
    let mut number = 0;
    let index = String::from_utf8(whole["index.jsonl"].clone()).unwrap();
    let mut lines = index
        .lines()
        .map(|line| serde_json::from_str::<Value>(line).unwrap());
    for (tar, count) in names[1..].iter().zip([3, 3, 1]) {
        let entries = entries(&place("out").join(tar));
        assert_eq!(entries.len(), 3 * count);
        for sample in entries.chunks(3) {
            // Together, with one key.
            let name = format!("m{number}");
            for ((found, bytes), end) in sample.iter().zip(["mask.png", "png", "json"]) {
                assert_eq!(*found, format!("{name}.{end}"));
                assert!(end == "json" || loose[found] == *bytes, "{found}");
            }
            let told: Value = serde_json::from_slice(&sample[2].1).unwrap();
            let mut line = lines.next().unwrap();
            assert_eq!(line["tar"]["file"], json!(tar));
            line.as_object_mut().unwrap().remove("tar");
            assert_eq!(line, told);
            assert_eq!(
                (&told["name"], told["sun"].is_object()),
                (&json!(name), true)
            );
            number += 1;
        }
    }
    assert_eq!((number, lines.next()), (7, None));
    // Nothing is drawn again but a tar file that is lost or damaged.
    let told = done(draw("out", &["--tar", "3"]));
    assert!(told.contains("0 drawn, 7 were there"), "{told}");
    fs::remove_file(place("out/skies-000002.tar")).unwrap();
    let cut = &whole["skies-000001.tar"][..5000];
    fs::write(place("out/skies-000001.tar"), cut).unwrap();
    let told = done(draw("out", &["--tar", "3"]));
    assert!(told.contains("4 drawn, 3 were there"), "{told}");
    assert!(files(&place("out")) == whole);
    // One job of a file is another.
    fs::write(place("jobs.jsonl"), jobs(0.25)).unwrap();
    failed(
        &run(draw("out", &["--tar", "3"])),
        1,
        &["line 5", "m4.png", "another job", "--force"],
    );
    assert!(files(&place("out")) == whole);
    let told = done(draw("out", &["--tar", "3", "--force"]));
    assert!(told.contains("3 drawn, 4 were there"), "{told}");
    assert!(files(&place("out"))["skies-000001.tar"] != whole["skies-000001.tar"]);
    // Someone else's file stays.
    fs::create_dir(place("other")).unwrap();
    fs::write(place("other/skies-000001.tar"), "mine").unwrap();
    failed(
        &run(draw("other", &["--tar", "3"])),
        1,
        &["skies-000001.tar", "--force"],
    );
    assert_eq!(fs::read(place("other/skies-000001.tar")).unwrap(), b"mine");
    failed(&run(draw("other", &["--tar", "0"])), 2, &["--tar"]);
}

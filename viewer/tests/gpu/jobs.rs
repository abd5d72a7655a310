//! `welkin-view render --jobs`, run as its users run it.

// The lint's exception for tests does not reach their helpers.
#![allow(clippy::unwrap_used)]

use std::collections::BTreeMap;
use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use crate::common::{done, failed, files, pack, render_to, run};

/// `--jobs` of a file of these lines, into a folder beside it.
fn jobs(parent: &Path, lines: &str, words: &[&str]) -> Command {
    let file = parent.join("jobs.jsonl");
    fs::write(&file, lines).unwrap();
    let mut command = render_to(&parent.join("out"), &["--jobs"]);
    command.arg(&file).args(words);
    command
}

/// So many small pictures, each of another moment.
fn moments(count: usize) -> String {
    let line = |i: usize| json!({ "name": format!("m{i}"), "seed": i, "size": [24, 16], "settings": { "at": 60 * i, "cover": 0.5 } });
    (0..count).map(|i| format!("{}\n", line(i))).collect()
}

fn index(folder: &Path) -> Vec<Value> {
    let text = fs::read_to_string(folder.join("index.jsonl")).unwrap();
    let lines = text.lines().map(|line| serde_json::from_str(line).unwrap());
    lines.collect()
}

#[test]
fn pictures_are_those_of_single_frames_whatever_the_threads() {
    let cases = [
        (
            json!({ "name": "noon", "size": [70, 40] }),
            &["--size", "70x40"][..],
        ),
        (
            json!({ "name": "evening", "size": [70, 40], "settings": { "method": "lit", "time": 0.74, "azimuth": 270, "fov": 90 } }),
            &[
                "--size",
                "70x40",
                "--method",
                "lit",
                "--time",
                "0.74",
                "--azimuth",
                "270",
                "--fov",
                "90",
            ],
        ),
        (
            json!({ "name": "clouds", "size": [33, 40], "settings": { "method": "sprites", "up": 900.5, "at": 5 } }),
            &[
                "--size", "33x40", "--method", "sprites", "--up", "900.5", "--at", "5",
            ],
        ),
        (
            json!({ "name": "radiance", "size": [70, 40], "format": "exr", "oktas": 3 }),
            &["--size", "70x40", "--oktas", "3"],
        ),
        (
            json!({ "name": "again", "size": [70, 40] }),
            &["--size", "70x40"],
        ),
        (
            json!({ "name": "map", "equirect": 64, "format": "png", "settings": { "azimuth": 90, "auto-exposure": true } }),
            &["--equirect", "64", "--azimuth", "90", "--auto-exposure"],
        ),
        (
            json!({ "name": "cube", "cubemap": 16, "settings": { "date": "2026-06-21T18:30:00Z", "lat": 59.9 } }),
            &[
                "--cubemap",
                "16",
                "--date",
                "2026-06-21T18:30:00Z",
                "--lat",
                "59.9",
            ],
        ),
    ];
    let parent = tempfile::tempdir().unwrap();
    // As some editors save it.
    let lines: String = cases
        .iter()
        .map(|(job, _)| format!("{job}\r\n\r\n"))
        .collect();
    let out = parent.path().join("out");
    let mut all = Vec::new();
    for threads in ["1", "5"] {
        let mut command = jobs(parent.path(), &format!("\u{feff}{lines}"), &[]);
        command.env("RAYON_NUM_THREADS", threads);
        let told = done(command);
        assert!(told.contains("7 drawn, 0 were there"), "{told}");
        all.push(files(&out));
        fs::remove_dir_all(&out).unwrap();
    }
    assert!(all[0] == all[1], "threads change a byte");
    assert_eq!(all[0].len(), cases.len() + 1);
    for (job, words) in cases {
        let name = job["name"].as_str().unwrap();
        let (file, bytes) = all[0]
            .iter()
            .find(|(file, _)| file.starts_with(&format!("{name}.")))
            .unwrap();
        let single = parent.path().join(file);
        done(render_to(&single, words));
        assert!(fs::read(&single).unwrap() == *bytes, "{file}");
    }
}

#[test]
fn the_index_says_what_was_drawn_in_the_order_of_the_jobs() {
    let parent = tempfile::tempdir().unwrap();
    let lines = "{\"name\": \"b\", \"seed\": 5, \"size\": [8, 8], \"oktas\": 4, \"settings\": {\"sun\": false}}\n\n{\"size\": [8, 4]}";
    done(jobs(parent.path(), lines, &[]));
    let out = parent.path().join("out");
    let [first, second] = &index(&out)[..] else {
        panic!("two lines")
    };
    assert_eq!((&first["name"], &first["seed"]), (&json!("b"), &json!(5)));
    assert_eq!(
        (&second["name"], &second["seed"]),
        (&json!("000003"), &Value::Null)
    );
    assert_eq!(
        (&first["size"], &second["size"]),
        (&json!([8, 8]), &json!([8, 4]))
    );
    assert_eq!(first["settings"]["sun"], json!(false));
    let cover = first["settings"]["cover"].as_f64().unwrap();
    assert!((0.2..0.8).contains(&cover), "found for 4 oktas: {cover}");
    assert_eq!(second["settings"], json!({}));
    let manifest = fs::read(pack().join("pack.json")).unwrap();
    let manifest: Value = serde_json::from_slice(&manifest).unwrap();
    assert_eq!(first["pack"]["seal"], manifest["seal"]);
    for (line, file) in [(first, "b.png"), (second, "000003.png")] {
        let made = &line["files"]["picture"];
        assert_eq!(made["file"], json!(file));
        let hash = blake3::hash(&fs::read(out.join(file)).unwrap());
        assert_eq!(made["blake3"], json!(hash.to_hex().to_string()));
    }
    assert_ne!(first["job"], second["job"]);
}

#[test]
fn a_line_that_is_wrong_is_told_before_anything_is_drawn() {
    let parent = tempfile::tempdir().unwrap();
    let good = "{\"size\": [8, 8]}\n";
    for (bad, parts) in [
        ("{\"size\": [8, 8]", &["no JSON object"][..]),
        (
            "{\"settings\": {\"covr\": 1}}",
            &["covr", "did you mean \"cover\""],
        ),
        ("{\"size\": [32768, 32768]}", &["32768x32768"]),
        ("{\"name\": \"../a\"}", &["name is \"../a\""]),
        ("{\"name\": \"000001\"}", &["000001", "line 1"]),
        ("{\"pack\": \"none\"}", &["none"]),
    ] {
        let output = run(jobs(parent.path(), &format!("{good}{bad}"), &[]));
        failed(&output, 1, &[&["jobs.jsonl, line 2"], parts].concat());
        assert!(!parent.path().join("out").exists(), "{bad}");
    }
    let output = run(jobs(parent.path(), good, &["--cover", "0.5"]));
    failed(&output, 2, &["--cover", "--jobs"]);
    let output = run(jobs(parent.path(), good, &["--frames", "2"]));
    failed(&output, 2, &["--frames", "--jobs"]);
    let mut command = render_to(&parent.path().join("out"), &["--jobs", "none.jsonl"]);
    command.current_dir(parent.path());
    failed(&run(command), 1, &["none.jsonl", "cannot be read"]);
}

#[test]
fn nothing_is_written_over_what_is_read() {
    let parent = tempfile::tempdir().unwrap();
    let place = |name: &str| parent.path().join(name);
    fs::create_dir(place("pack")).unwrap();
    for (name, bytes) in files(pack()) {
        fs::write(place("pack").join(name), bytes).unwrap();
    }
    fs::create_dir(place("out")).unwrap();
    fs::write(place("jobs.jsonl"), "{\"size\": [8, 8]}").unwrap();
    fs::write(place("out/index.jsonl"), "{\"size\": [8, 8]}").unwrap();
    fs::write(place("out/000001.png"), "{\"size\": [8, 8]}").unwrap();
    let before = [files(&place("pack")), files(&place("out"))];
    for (out, jobs, part) in [
        ("pack", "jobs.jsonl", "which is read"),
        ("pack/out", "jobs.jsonl", "which is read"),
        ("out", "out/index.jsonl", "which is read"),
        ("out", "out/000001.png", "over the jobs"),
        ("out", "jobs.jsonl", "no line of an index"),
    ] {
        let mut command =
            crate::common::view(&["render", "pack", "-o", out, "--jobs", jobs, "--force"]);
        command.current_dir(parent.path());
        failed(&run(command), 1, &[part]);
        assert!(
            [files(&place("pack")), files(&place("out"))] == before,
            "{out} {jobs}"
        );
    }
}

#[test]
fn a_run_that_was_killed_goes_on_and_makes_what_an_unbroken_one_makes() {
    let parent = tempfile::tempdir().unwrap();
    let (unbroken, broken) = (parent.path().join("unbroken"), parent.path().join("broken"));
    for folder in [&unbroken, &broken] {
        fs::create_dir(folder).unwrap();
    }
    let count = 60;
    done(jobs(&unbroken, &moments(count), &[]));
    let out = broken.join("out");
    let mut command = jobs(&broken, &moments(count), &[]);
    let mut child = command.stderr(Stdio::null()).spawn().unwrap();
    let begin = Instant::now();
    let pictures = || {
        let entries = out.read_dir().into_iter().flatten().flatten();
        entries
            .filter(|e| e.file_name().to_string_lossy().ends_with(".png"))
            .count()
    };
    while pictures() < 5 && begin.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(2));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let left = pictures();
    assert!((5..count).contains(&left), "{left} of {count}");
    // What there is under a picture's name is whole.
    let whole = files(&unbroken.join("out"));
    for (name, bytes) in files(&out)
        .iter()
        .filter(|(name, _)| name.ends_with(".png"))
    {
        assert!(whole[name] == *bytes, "{name}");
    }
    // As if it was killed in the middle of a line, and a picture was lost.
    let mut file = fs::OpenOptions::new()
        .append(true)
        .open(out.join("index.jsonl"))
        .unwrap();
    file.write_all(b"{\"name\":\"m5").unwrap();
    fs::remove_file(out.join("m1.png")).unwrap();
    let told = done(jobs(&broken, &moments(count), &[]));
    let kept = told
        .split(", ")
        .nth(1)
        .and_then(|part| part.split(' ').next());
    let kept: usize = kept.unwrap().parse().unwrap();
    assert!(kept + 20 > left && kept < left, "{told}, {left} were there");
    assert!(files(&out) == whole);
    let told = done(jobs(&broken, &moments(count), &[]));
    assert!(
        told.contains(&format!("0 drawn, {count} were there")),
        "{told}"
    );
    assert!(files(&out) == whole);
}

#[test]
fn a_picture_of_another_job_is_neither_kept_nor_replaced_unasked() {
    let parent = tempfile::tempdir().unwrap();
    let line = |cover: f32| {
        json!({ "name": "a", "size": [16, 8], "settings": { "cover": cover } }).to_string()
    };
    done(jobs(parent.path(), &line(0.25), &[]));
    let out = parent.path().join("out");
    let first = files(&out);
    failed(
        &run(jobs(parent.path(), &line(0.75), &[])),
        1,
        &["a.png", "another job", "--force"],
    );
    assert!(files(&out) == first);
    done(jobs(parent.path(), &line(0.75), &["--force"]));
    let second = files(&out);
    assert!(second["a.png"] != first["a.png"]);
    assert_eq!(index(&out).len(), 1);
    // Someone else's picture, of which there is no line.
    fs::remove_file(out.join("index.jsonl")).unwrap();
    fs::write(out.join("a.png"), "a photograph").unwrap();
    failed(
        &run(jobs(parent.path(), &line(0.75), &[])),
        1,
        &["a.png", "--force"],
    );
    assert_eq!(fs::read(out.join("a.png")).unwrap(), b"a photograph");
    done(jobs(parent.path(), &line(0.75), &["--force"]));
    assert!(files(&out) == second);
    // Damage under a line of the same job is mended.
    fs::write(out.join("a.png"), "a phot").unwrap();
    done(jobs(parent.path(), &line(0.75), &[]));
    assert!(files(&out) == second);
}

#[test]
fn parts_are_together_the_whole() {
    let parent = tempfile::tempdir().unwrap();
    done(jobs(parent.path(), &moments(7), &[]));
    let out = parent.path().join("out");
    let pictures = |folder: &Path| -> BTreeMap<String, Vec<u8>> {
        let all = files(folder).into_iter();
        all.filter(|(name, _)| name.ends_with(".png")).collect()
    };
    let whole = pictures(&out);
    fs::remove_dir_all(&out).unwrap();
    for part in ["1/3", "2/3", "3/3"] {
        done(jobs(parent.path(), &moments(7), &["--shard", part]));
    }
    assert!(pictures(&out) == whole);
    let lines = files(&out)
        .into_iter()
        .filter(|(name, _)| name.starts_with("index-"));
    let lines: Vec<usize> = lines
        .map(|(_, bytes)| bytes.split(|b| *b == b'\n').count() - 1)
        .collect();
    assert_eq!(lines, [3, 2, 2]);
}

#[test]
fn a_pipe_is_drawn_as_it_comes_and_what_was_made_stays_where_a_line_is_wrong() {
    let parent = tempfile::tempdir().unwrap();
    let out = parent.path().join("out");
    let mut command = render_to(&out, &["--jobs", "-"]);
    let mut child = command
        .stdin(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut pipe = child.stdin.take().unwrap();
    let lines = moments(3);
    let mut lines = lines.lines();
    // Whoever writes may wait for each picture.
    for i in 0..3 {
        writeln!(pipe, "{}", lines.next().unwrap()).unwrap();
        pipe.flush().unwrap();
        let begin = Instant::now();
        while fs::read_to_string(out.join("index.jsonl")).map_or(0, |text| text.lines().count())
            <= i
        {
            assert!(
                begin.elapsed() < Duration::from_secs(60),
                "picture {i} does not come"
            );
            std::thread::sleep(Duration::from_millis(5));
        }
    }
    writeln!(pipe, "{{\"nmae\": 1}}\n{{\"size\": [8, 8]}}").unwrap();
    drop(pipe);
    let output = child.wait_with_output().unwrap();
    failed(&output, 1, &["standard input, line 4", "nmae"]);
    let names: Vec<String> = files(&out).into_keys().collect();
    assert_eq!(names, ["index.jsonl", "m0.png", "m1.png", "m2.png"]);
    // A pipe that goes on there.
    let mut command = render_to(&out, &["--jobs", "-"]);
    let mut child = command
        .stdin(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut pipe = child.stdin.take().unwrap();
    pipe.write_all(moments(4).as_bytes()).unwrap();
    drop(pipe);
    let output = child.wait_with_output().unwrap();
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(told.contains("1 drawn, 3 were there"), "{told}");
    // A named pipe, which can be read but once.
    #[cfg(unix)]
    {
        let fifo = parent.path().join("fifo");
        assert!(
            Command::new("mkfifo")
                .arg(&fifo)
                .status()
                .unwrap()
                .success()
        );
        let mut command = render_to(&out, &["--jobs"]);
        let child = command.arg(&fifo).stderr(Stdio::piped()).spawn().unwrap();
        fs::write(&fifo, format!("{}{{\"seed\": \"x\"}}", moments(5))).unwrap();
        let output = child.wait_with_output().unwrap();
        failed(&output, 1, &["fifo, line 6", "seed is \"x\""]);
        assert_eq!(index(&out).len(), 5);
    }
}

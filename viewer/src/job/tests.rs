use proptest::prelude::*;
use welkin_runtime::Method;

use super::*;

fn error_of(text: &str) -> String {
    match Job::parse(text, 7) {
        Ok(job) => panic!("{text} was accepted: {job:?}"),
        Err(fault) => fault.to_string(),
    }
}

#[test]
fn nothing_is_the_usual_sky() {
    let job = Job::parse("{}", 7).unwrap();
    assert_eq!(job.settings, Settings::default());
    assert_eq!((job.name.as_str(), job.size), ("000007", [1600, 1200]));
    assert_eq!(job.file(), "000007.png");
    assert_eq!((job.seed, job.oktas, job.pack.clone()), (None, None, None));
}

#[test]
fn settings_have_the_names_and_texts_of_everywhere() {
    let text = r#"{"name": "a-b_C", "seed": 18446744073709551615, "size": [64, 48], "format": "exr", "pack": "p",
        "settings": {"method": "lit", "cover": 0.25, "sun": false, "layers": "cirrus:1", "time": "0.75", "at": 12, "fov": 40}}"#;
    let job = Job::parse(&text.replace('\n', " "), 1).unwrap();
    assert_eq!(job.settings.params.method, Method::Lit);
    assert_eq!(job.settings.params.cover, 0.25);
    assert!(!job.settings.params.sun);
    assert_eq!((job.settings.at_s, job.seed), (12.0, Some(u64::MAX)));
    assert_eq!(job.view().camera.viewport_px, [64, 48]);
    assert_eq!(job.file(), "a-b_C.exr");
    // What is told is a job again.
    let told = json!({ "settings": settings_told(&job.settings) }).to_string();
    assert_eq!(Job::parse(&told, 1).unwrap().settings, job.settings);
}

#[test]
fn maps_are_as_wide_as_they_say() {
    let shot = |text: &str| Job::parse(text, 1).map(|job| (job.shot, job.azimuth_deg));
    assert_eq!(
        shot(r#"{"equirect": 64}"#),
        Ok((Shot::Equirect(64, Format::Exr), 0.0))
    );
    assert_eq!(
        shot(r#"{"equirect": 64, "format": "png", "settings": {"azimuth": 90}}"#),
        Ok((Shot::Equirect(64, Format::Png), 90.0))
    );
    assert_eq!(shot(r#"{"cubemap": 32}"#), Ok((Shot::Ktx2(32), 0.0)));
}

#[test]
fn what_is_wrong_is_told_with_key_found_and_expected() {
    for (text, parts) in [
        ("", &["no JSON object"][..]),
        ("[1]", &["no JSON object", "map"]),
        ("{\"name\": \"a\"", &["no JSON object", "EOF"]),
        ("{\"seed\": NaN}", &["no JSON object", "column"]),
        ("{\"oktas\": 1e999}", &["no JSON object", "out of range"]),
        ("{\"nmae\": 1}", &["no key \"nmae\"", "name, pack"]),
        (
            "{\"cover\": 1}",
            &["\"cover\" is a setting", "in \"settings\""],
        ),
        ("{\"settings\": 1}", &["settings is 1", "an object"]),
        (
            "{\"settings\": {\"covr\": 1}}",
            &["no setting \"covr\"", "did you mean \"cover\""],
        ),
        (
            "{\"settings\": {\"cover\": 2}}",
            &["cover is \"2\"", "expected a number from 0 to 1"],
        ),
        (
            "{\"settings\": {\"cover\": \"nan\"}}",
            &["cover is \"nan\"", "expected a number from 0 to 1"],
        ),
        (
            "{\"settings\": {\"cover\": [1]}}",
            &["settings.cover is [1]", "a number"],
        ),
        ("{\"settings\": {\"cover\": null}}", &["null"]),
        ("{\"seed\": -1}", &["seed is -1", "whole number"]),
        ("{\"seed\": 1.5}", &["seed is 1.5", "whole number"]),
        ("{\"oktas\": 9}", &["oktas is 9", "from 0 to 8"]),
        ("{\"oktas\": \"3\"}", &["oktas is \"3\"", "from 0 to 8"]),
        (
            "{\"oktas\": 3, \"settings\": {\"cover\": 0.5}}",
            &["oktas", "cover", "leave one"],
        ),
        ("{\"size\": [0, 4]}", &["size is [0,4]", "1 to 32768"]),
        ("{\"size\": [4]}", &["size is [4]"]),
        ("{\"size\": [4, 4, 4]}", &["size is [4,4,4]"]),
        ("{\"size\": [99999999999, 4]}", &["size is", "32768"]),
        ("{\"size\": \"4x4\"}", &["size is \"4x4\"", "[1280, 720]"]),
        (
            "{\"format\": \"gif\"}",
            &["format is \"gif\"", "png, exr or hdr"],
        ),
        ("{\"format\": \"ktx2\"}", &["format is \"ktx2\"", "cubemap"]),
        ("{\"equirect\": 33}", &["equirect is 33", "even number"]),
        ("{\"cubemap\": 33}", &["cubemap is 33", "power of two"]),
        (
            "{\"cubemap\": 32, \"equirect\": 64}",
            &["equirect", "cubemap"],
        ),
        (
            "{\"cubemap\": 32, \"format\": \"png\"}",
            &["format", "ktx2"],
        ),
        ("{\"cubemap\": 32, \"size\": [4, 4]}", &["cubemap", "size"]),
        (
            "{\"equirect\": 64, \"settings\": {\"rain\": 0.5}}",
            &["equirect", "rain", "streaks"],
        ),
        (
            "{\"cubemap\": 32, \"settings\": {\"azimuth\": 5}}",
            &["cubemap", "azimuth"],
        ),
        ("{\"weather\": 1}", &["weather is 1", "letters"]),
        ("{\"pack\": 1}", &["pack is 1"]),
        ("{\"pack\": \"\"}", &["pack is \"\""]),
    ] {
        let error = error_of(text);
        for part in parts {
            assert!(error.contains(part), "{text}: no {part:?} in {error}");
        }
        assert!(!error.contains('\n'), "{error}");
    }
}

#[test]
fn names_are_such_as_every_system_and_every_reader_takes() {
    let long = "a".repeat(LONGEST_NAME);
    for name in ["a", "0", "_", "a-1_B", &long] {
        let job = Job::parse(&json!({ "name": name }).to_string(), 1).unwrap();
        assert_eq!(job.name, name);
    }
    let too_long = "a".repeat(LONGEST_NAME + 1);
    for name in [
        "",
        ".",
        "..",
        "a.b",
        "a/b",
        "../a",
        "/a",
        "a\\b",
        "a b",
        "-a",
        "ä",
        "a\n",
        "a\u{0}",
        &too_long,
        "C:a",
        "\u{202e}a",
    ] {
        let error = error_of(&json!({ "name": name }).to_string());
        assert!(error.starts_with("name is "), "{error}");
        assert!(error.len() < 250, "{error}");
    }
}

proptest! {
    #[test]
    fn no_text_makes_it_panic(text in "\\PC{0,80}", number in 0_u64..9) {
        Job::parse(&text, number).ok();
    }

    #[test]
    fn no_json_makes_it_panic(key in "[a-z]{1,9}", value in "(null|true|-?[0-9]{1,25}(\\.[0-9])?|\"[^\"\\\\]{0,9}\"|\\[\\]|\\{\\})") {
        for text in [format!("{{\"{key}\": {value}}}"), format!("{{\"settings\": {{\"{key}\": {value}}}}}")] {
            Job::parse(&text, 1).ok();
        }
        for key in JOB_KEYS {
            Job::parse(&format!("{{\"{key}\": {value}}}"), 1).ok();
        }
    }
}

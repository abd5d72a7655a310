//! The three other ways of `welkin check`: proof by baking anew, a page, and a texture that is in no pack.

use std::fs;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

use super::{Desk, Run, contents, default_pack, run, welkin};

/// A recipe whose pack is small and sound.
const SOUND: &str = "name = \"small\"\n[clouds]\nsize = 128\n[stars]\nsize = 64\ncount = 60\n[galaxy]\nsize = 32\n\
    [sky]\nsuns = 16\n[sun]\nsize = 32\n[fbm]\nsize = 64\ncells = 16\noctaves = 2\n[flares]\nsize = 64\n\
    [layers]\nsize = 128\n[sprites]\nsize = 128\n[field]\nsections = 1\n";

fn pack(desk: &Desk, recipe: &str) -> PathBuf {
    let (recipe, pack) = (desk.write("sky.toml", recipe), desk.path("pack"));
    run(welkin().arg("bake").arg(recipe).arg("-o").arg(&pack)).done();
    pack
}

fn check(path: &Path) -> Command {
    let mut command = welkin();
    command.arg("check").arg(path);
    command
}

/// The findings of a rule that failed, as subjects and notes.
fn failed(run: &Run, rule: &str) -> Vec<(String, String)> {
    let report: Value = serde_json::from_str(&run.stdout).expect("JSON");
    let findings = report["findings"].as_array().unwrap().iter();
    let text = |finding: &Value, key: &str| finding[key].as_str().unwrap().to_string();
    findings
        .filter(|f| f["rule"] == rule && f["outcome"] == "failed")
        .map(|f| (text(f, "subject"), text(f, "note")))
        .collect()
}

/// Changes a manifest and seals it again.
fn forge(pack: &Path, from: &str, to: &str) {
    let file = pack.join("pack.json");
    let text = fs::read_to_string(&file).unwrap();
    assert!(text.contains(from), "{text}");
    let text = text.replace(from, to);
    let key = "\"seal\": \"";
    let start = text.rfind(key).unwrap() + key.len();
    let sealed = |seal: &str| format!("{}{seal}{}", &text[..start], &text[start + 64..]);
    let seal = blake3::hash(sealed(&"0".repeat(64)).as_bytes()).to_hex();
    fs::write(file, sealed(&seal)).unwrap();
}

#[test]
fn baking_anew_finds_what_statistics_cannot() {
    let desk = Desk::new();
    let pack = pack(&desk, SOUND);
    let text = run(check(&pack).arg("--rebake")).done();
    assert!(
        text.contains("ok       rebake             clouds.noise")
            && !text.contains("warning  rebake"),
        "{text}"
    );

    forge(&pack, "\"seed\": 1,", "\"seed\": 2,");
    run(&mut check(&pack)).done();
    let found = run(check(&pack).args(["--rebake", "--json"]));
    assert_eq!(found.code, Some(1), "{found:?}");
    let failed = failed(&found, "rebake");
    let noise = failed
        .iter()
        .find(|f| f.0 == "clouds.noise")
        .expect("the noise of another seed");
    assert!(
        noise.1.contains("first at level 0, (0, 0): ") && noise.1.contains("/255 baked anew"),
        "{noise:?}"
    );
    assert!(!failed.iter().any(|f| f.0 == "clouds.photo"), "{failed:?}");

    forge(
        &pack,
        concat!("\"welkin ", env!("CARGO_PKG_VERSION"), "\""),
        "\"welkin 0.0.1\"",
    );
    let text = run(check(&pack).arg("--rebake")).done();
    assert!(
        text.contains("warning  rebake") && text.contains("no proof of forgery"),
        "{text}"
    );
}

#[test]
fn the_files_of_a_recipe_are_given_by_hand() {
    let desk = Desk::new();
    let photos = Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets-src/photos");
    let photo = fs::read(photos.join("god-rays-1024.png")).unwrap();
    let hash = blake3::hash(&photo).to_hex();
    let photo = desk.write("mine.png", photo);
    let pack = pack(
        &desk,
        &SOUND.replace("[stars]", "[clouds.photo]\nfile = \"mine.png\"\n[stars]"),
    );
    let other = desk.write("other.png", "no picture");
    fs::rename(&photo, desk.path("moved.png")).unwrap();
    let photo = desk.path("moved.png");

    run(check(&pack).arg("--rebake").arg("--photo").arg(&photo)).done();
    let by_key = format!("clouds.photo.file={}", photo.display());
    run(check(&pack).args(["--rebake", "--input", &by_key])).done();

    let missing = format!("`clouds.photo.file` (BLAKE3 {hash})");
    run(check(&pack).arg("--rebake"))
        .failed(2, &["pack", &missing, "--photo FILE", "--input KEY=FILE"]);
    let found = blake3::hash(b"no picture").to_hex();
    run(check(&pack).arg("--rebake").arg("--photo").arg(&other))
        .failed(2, &["`clouds.photo.file`", found.as_str(), hash.as_str()]);
    run(check(&pack)
        .args(["--rebake", "--input", &by_key, "--photo"])
        .arg(&photo))
    .failed(2, &["moved.png", "given already"]);
    run(check(&pack)
        .args(["--rebake", "--input", "skybox.file=moved.png"])
        .current_dir(desk.path("")))
    .failed(2, &["`skybox.file`", "expected `clouds.photo.file`"]);
    run(check(&pack)
        .arg("--rebake")
        .arg("--photo")
        .arg(desk.path("none.png")))
    .failed(2, &["none.png: cannot be read"]);
    // They say nothing without a bake.
    run(check(&pack).arg("--photo").arg(&photo)).failed(2, &["--rebake"]);
    run(check(&pack).args(["--rebake", "--input", "clouds.photo.file"])).failed(2, &["KEY=FILE"]);
}

#[test]
fn the_page_is_one_file_that_shows_the_default_pack() {
    let desk = Desk::new();
    let page = desk.write("report.html", "an older page is replaced");
    let text = run(check(default_pack()).arg("--html").arg(&page)).done();
    assert!(
        text.lines().last().unwrap().starts_with("sound: "),
        "{text}"
    );
    let html = fs::read_to_string(&page).unwrap();
    assert!(html.starts_with("<!doctype html>") && html.ends_with("</html>\n"));
    assert!(html.len() < 5_000_000, "{} bytes", html.len());
    assert_eq!(desk.names(), ["report.html"]);
    // The same pack, the same page.
    run(check(default_pack())
        .arg("--html")
        .arg(desk.path("again.html")))
    .done();
    assert!(fs::read_to_string(desk.path("again.html")).unwrap() == html);
}

#[test]
fn a_hostile_name_is_text_on_the_page_of_a_pack_with_problems() {
    let desk = Desk::new();
    let (pack, page) = (pack(&desk, SOUND), desk.path("report.html"));
    forge(
        &pack,
        "\"name\": \"small\"",
        "\"name\": \"<script>alert(1)</script>\"",
    );
    fs::write(pack.join("galaxy.ktx2"), "damaged").unwrap();
    let found = run(check(&pack).arg("--html").arg(&page));
    assert_eq!(found.code, Some(1), "{found:?}");
    let html = fs::read_to_string(&page).unwrap();
    assert!(
        html.contains("<h1>&lt;script&gt;alert(1)&lt;/script&gt;</h1>")
            && !html.contains("<script")
    );
    let (failed, _) = html.split_once("id=\"pack\"").unwrap();
    assert!(failed.contains("What failed") && failed.contains("file-hash"));
    // What could not be read has findings and no picture.
    assert!(html.contains("id=\"galaxy\"") && !html.contains("id=\"galaxy-brightness\""));
}

#[test]
fn the_page_is_never_written_over_what_is_read() {
    let desk = Desk::new();
    let pack = pack(&desk, SOUND);
    symlink(pack.join("sun.ktx2"), desk.path("link.html")).unwrap();
    fs::hard_link(pack.join("sky.ktx2"), desk.path("hard.html")).unwrap();
    symlink(&pack, desk.path("door")).unwrap();
    let before = contents(&pack);
    for place in [
        "pack/pack.json",
        "pack/new.html",
        "pack/../pack/clouds.ktx2",
        "door/field.glb",
        "door/new.html",
        "link.html",
        "hard.html",
    ] {
        run(check(&pack).arg("--html").arg(desk.path(place))).failed(2, &["choose"]);
        // The pack may be named by a link, too.
        run(check(&desk.path("door"))
            .arg("--html")
            .arg(desk.path(place)))
        .failed(2, &["choose"]);
    }
    run(check(&pack).arg("--html").arg(desk.path("none/a.html")))
        .failed(2, &["none/a.html", "make the folder"]);
    let picture = pack.join("galaxy.ktx2");
    let alone = desk.write("galaxy.ktx2", fs::read(&picture).unwrap());
    run(check(&alone).args(["--as", "galaxy", "--html"]).arg(&alone)).failed(2, &["which is read"]);
    assert!(contents(&pack) == before && fs::read(&alone).unwrap() == before["galaxy.ktx2"]);
}

#[test]
fn a_texture_of_another_tool_is_checked_before_it_is_in_a_pack() {
    let desk = Desk::new();
    let parts = desk.path("parts");
    run(welkin()
        .arg("unpack")
        .arg(default_pack())
        .arg("-o")
        .arg(&parts))
    .done();
    let sound = |path: PathBuf, role: &str| {
        let text = run(check(&path).args(["--as", role])).done();
        assert!(
            text.lines().last().unwrap().starts_with("sound: "),
            "{text}"
        );
        text
    };
    for role in [
        "clouds", "stars", "galaxy", "sky", "sun", "octaves", "fbm", "flares", "layers", "sprites",
    ] {
        sound(default_pack().join(format!("{role}.ktx2")), role);
    }
    let text = sound(parts.join("galaxy.brightness.png"), "galaxy");
    assert!(
        text.contains("skipped  mip-mean           galaxy.brightness")
            && text.contains("level 0 alone"),
        "{text}"
    );
    for channel in ["photo", "noise", "detail"] {
        let text = sound(
            parts.join(format!("clouds.{channel}.png")),
            &format!("clouds.{channel}"),
        );
        let rules = text
            .lines()
            .filter(|line| line.contains(&format!("clouds.{channel}")));
        assert!(rules.count() + 1 == text.lines().count(), "{text}");
    }

    // The gradient does not tile, and clouds are no stars.
    let seam =
        run(check(&parts.join("clouds.gradient.png")).args(["--as", "clouds.noise", "--json"]));
    assert_eq!(
        (seam.code, failed(&seam, "seam").len()),
        (Some(1), 1),
        "{seam:?}"
    );
    let page = desk.path("page.html");
    let stars = run(check(&default_pack().join("clouds.ktx2"))
        .args(["--as", "stars", "--html"])
        .arg(&page));
    assert_eq!(stars.code, Some(1), "{stars:?}");
    assert!(
        fs::read_to_string(page)
            .unwrap()
            .contains("<article id=\"stars-phase\">")
    );

    let picture = parts.join("clouds.noise.png");
    run(check(&picture).args(["--as", "clouds"]))
        .failed(2, &["clouds.noise.png: channels is 1 (grey), expected 4"]);
    run(check(&picture).args(["--as", "stars.rate"])).failed(2, &["stars.rate", "--as stars"]);
    run(&mut check(&picture)).failed(2, &["clouds.noise.png: is a file", "--as clouds"]);
    run(check(&picture).args(["--as", "cloud"])).failed(2, &["clouds, stars, galaxy"]);
    run(check(&desk.path("none.png")).args(["--as", "sun"]))
        .failed(2, &["none.png: cannot be read"]);
    run(check(&picture).args(["--as", "galaxy", "--rebake"])).failed(2, &["--rebake"]);
}

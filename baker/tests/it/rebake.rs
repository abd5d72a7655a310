//! Proof by baking anew: what was changed is found, named, and nothing else is blamed.

#![allow(clippy::unwrap_used, reason = "a test may stop where it fails")]

use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::path::Path;

use welkin_baker::{Progress, REBAKE, RebakeError, Recipe, bake, rebake};
use welkin_pack::Role;
use welkin_pack::check::{Examined, Finding, Outcome, Severity, examine};
use welkin_pack::manifest::Input;
use welkin_pack::role::Wrap;

const RECIPE: &str = "name = \"small\"\n[clouds]\nsize = 64\n[stars]\nsize = 64\ncount = 20\n\
    [galaxy]\nsize = 32\n[sky]\nsuns = 16\n[sun]\nsize = 16\n\
    [fbm]\nsize = 64\ncells = 16\n[flares]\nsize = 64\n[layers]\nsize = 64\n[sprites]\nsize = 128\n\
    [field]\nsections = 1\n";

fn on(_: Progress) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

fn examined(recipe: &str) -> Examined {
    let photos = Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets-src/photos");
    let recipe = Recipe::parse("sky.toml", recipe).unwrap();
    let pack = bake(&recipe.resolve(Some(5)).unwrap(), Some(&photos), &on).unwrap();
    let folder = tempfile::tempdir().unwrap();
    for (name, bytes) in pack.files() {
        std::fs::write(folder.path().join(name), bytes).unwrap();
    }
    examine(folder.path()).unwrap()
}

fn prove(examined: &Examined) -> Vec<Finding> {
    rebake(examined, &BTreeMap::new(), &on).unwrap()
}

/// Subject, figure and note of the findings that failed.
fn failed(findings: &[Finding]) -> Vec<(&str, f64, &str)> {
    let failed = findings.iter().filter(|f| f.outcome == Outcome::Failed);
    failed
        .map(|f| {
            (
                f.subject.as_str(),
                f.figure.unwrap_or(f64::NAN),
                f.note.as_str(),
            )
        })
        .collect()
}

#[test]
fn every_kind_of_change_is_named_and_nothing_else() {
    let sound = examined(RECIPE);
    let findings = prove(&sound);
    assert_eq!(failed(&findings), []);
    assert!(
        findings
            .iter()
            .all(|f| f.outcome == Outcome::Passed && f.rule == REBAKE.id)
    );
    let subjects: Vec<&str> = findings.iter().map(|f| f.subject.as_str()).collect();
    let channels: usize = Role::ALL
        .iter()
        .filter(|r| !r.is_optional())
        .map(|r| r.spec().channels.len())
        .sum();
    assert_eq!(subjects.len(), channels + 2);
    assert_eq!(
        [subjects[0], subjects[1], subjects[channels + 1]],
        ["pack.json", "clouds.photo", "field"]
    );

    let mut forged = sound.clone();
    let manifest = &mut forged.manifest;
    manifest.noon_elevation_rad = 1.5;
    manifest.textures[0].sampler.wrap = Wrap::Clamp;
    manifest.textures[8].channels[0].range = [0.0, 1.0];
    // What follows from the texels is not told before what was changed.
    manifest.textures[0].channels[0].mean = 0.9;
    // The file is compressed otherwise: no difference.
    manifest.textures[3].file_blake3 = "0".repeat(64);
    let texture = |forged: &mut Examined, role| {
        let place = forged
            .textures
            .iter()
            .position(|(r, _)| *r == role)
            .unwrap();
        forged.textures.remove(place).1
    };
    // Level 1 of 32x32 texels of four channels, in three layers: texel (5, 7) of the second.
    let mut layers = texture(&mut forged, Role::Layers);
    let byte = (32 * 32 + 7 * 32 + 5) * 4 + 2;
    let density = layers.levels[1][byte];
    layers.levels[1][byte] = density ^ 1;
    layers.levels[2][11] ^= 1;
    layers.levels[2][11 + 16] ^= 1;
    // A half float of the sky: texel (3, 2) of the fifth image of 16x32, green.
    let mut sky = texture(&mut forged, Role::Sky);
    sky.levels[0][((4 * 32 + 2) * 16 + 3) * 8 + 2..][..2]
        .copy_from_slice(&0x7e00_u16.to_le_bytes());
    let mut sun = texture(&mut forged, Role::Sun);
    sun.levels.truncate(1);
    texture(&mut forged, Role::Flares);
    forged
        .textures
        .extend([(Role::Layers, layers), (Role::Sky, sky), (Role::Sun, sun)]);
    let cloud = &mut forged.field.as_mut().unwrap().clouds[3];
    let x = cloud.sprites[1].centre_m[0];
    cloud.sprites[1].centre_m[0] = x + 0.125;

    let findings = prove(&forged);
    let failed = failed(&findings);
    let of = |subject: &str| {
        failed
            .iter()
            .find(|f| f.0 == subject)
            .copied()
            .unwrap_or(("", 0.0, ""))
    };
    let subjects: Vec<&str> = failed.iter().map(|f| f.0).collect();
    assert_eq!(
        subjects,
        [
            "pack.json",
            "sky.green",
            "sun",
            "layers.density",
            "layers.rank",
            "field"
        ]
    );
    let (_, entries, note) = of("pack.json");
    // Noon, wrap, the lower end of the range, and the mean.
    assert_eq!(entries, 4.0, "{note}");
    assert!(
        note.starts_with("first at noon_elevation_rad: 1.5 in the pack, 1.047"),
        "{note}"
    );
    assert!(
        of("sky.green")
            .2
            .starts_with("first at level 0, layer 4, (3, 2): NaN (0x7e00) in the pack, ")
    );
    let (_, values, note) = of("layers.density");
    let place = "first at level 1, layer 1 (cumulus), (5, 7)";
    assert_eq!(
        note,
        format!(
            "{place}: {}/255 in the pack, {density}/255 baked anew",
            density ^ 1
        )
    );
    assert_eq!((values, of("layers.rank").1), (1.0, 2.0));
    assert!(
        of("sun").2.contains("1 levels in the pack") && of("sun").2.contains("5 levels baked anew")
    );
    let place = "first at clouds[3].sprites[1].centre_m[0]";
    assert_eq!(
        of("field"),
        (
            "field",
            1.0,
            &*format!("{place}: {} in the pack, {x} baked anew", x + 0.125)
        )
    );
    let flares = findings.iter().find(|f| f.subject == "flares").unwrap();
    assert_eq!(flares.outcome, Outcome::Skipped);
    assert!(findings.iter().all(|f| f.severity == Severity::Error));
}

#[test]
fn a_difference_to_another_version_is_told_as_what_it_is() {
    let mut other = examined(RECIPE);
    other.manifest.baker = "welkin 0.0.1".to_string();
    other.manifest.name = "best".to_string();
    let findings = prove(&other);
    let [(subject, _, note)] = failed(&findings)[..] else {
        panic!("{findings:#?}")
    };
    assert_eq!(subject, "pack.json");
    assert!(
        note.contains("first at name: \"best\" in the pack, \"small\" baked anew"),
        "{note}"
    );
    assert!(
        note.contains("baked by welkin 0.0.1") && note.contains("no proof of forgery"),
        "{note}"
    );
    assert!(!findings.iter().any(Finding::is_error));

    other.manifest.recipe = "[clouds]\nshape = 7\n".to_string();
    let findings = prove(&other);
    assert!(
        !findings[0].is_error() && findings[0].note.contains("`shape`"),
        "{findings:#?}"
    );
    other.manifest.baker = concat!("welkin ", env!("CARGO_PKG_VERSION")).to_string();
    let findings = prove(&other);
    assert!(
        findings[0].is_error() && findings.len() == 1,
        "{findings:#?}"
    );
}

#[test]
fn a_pack_of_another_seed_or_without_its_field_is_not_that_of_its_manifest() {
    let mut other = examined(RECIPE);
    other.manifest.seed = 6;
    let found = prove(&other);
    let failed: Vec<&str> = failed(&found).iter().map(|f| f.0).collect();
    for subject in [
        "clouds.noise",
        "stars.intensity",
        "octaves.octave1",
        "field",
    ] {
        assert!(failed.contains(&subject), "{failed:?}");
    }
    // They do not depend on the seed.
    for subject in ["clouds.photo", "clouds.gradient", "sky.red", "sun.disc"] {
        assert!(!failed.contains(&subject), "{failed:?}");
    }

    let (recipe, _) = other.manifest.recipe.split_once("[field]").unwrap();
    other.manifest.recipe = format!("{recipe}[field]\nsections = 0\n");
    let found = prove(&other);
    let field = found.iter().find(|f| f.subject == "field").unwrap();
    assert_eq!(field.note, "in the pack, but the recipe makes none");
}

#[test]
fn the_files_of_the_manifest_are_asked_for_by_key_and_hash() {
    let recipe = RECIPE.replace(
        "[stars]",
        "[clouds.photo]\nfile = \"god-rays-1024.png\"\n[stars]",
    );
    let sound = examined(&recipe);
    let photo =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets-src/photos/god-rays-1024.png");
    let photo = std::fs::read(photo).unwrap();
    let [Input { key, blake3: hash }] = &sound.manifest.inputs[..] else {
        panic!("{:?}", sound.manifest.inputs)
    };
    let given = |key: &str, bytes: &[u8]| BTreeMap::from([(key.to_string(), bytes.to_vec())]);
    let refused = |files: &BTreeMap<_, _>| rebake(&sound, files, &on).unwrap_err();

    let findings = rebake(&sound, &given(key, &photo), &on).unwrap();
    assert_eq!(failed(&findings), []);
    let missing = refused(&BTreeMap::new());
    assert!(matches!(missing, RebakeError::Missing { .. }));
    assert!(
        missing
            .to_string()
            .contains(&format!("`{key}` (BLAKE3 {hash})")),
        "{missing}"
    );
    let unknown = refused(&given("skybox.file", &photo));
    assert!(
        unknown
            .to_string()
            .contains("`skybox.file`, expected `clouds.photo.file`"),
        "{unknown}"
    );
    let other = refused(&given(key, b"another"));
    let found = blake3::hash(b"another").to_hex();
    assert!(
        other
            .to_string()
            .contains(&format!("is {found}, expected {hash}")),
        "{other}"
    );
    let stopped = rebake(&sound, &given(key, &photo), &|_| ControlFlow::Break(()));
    assert!(matches!(stopped, Err(RebakeError::Cancelled)));
}

#[test]
fn the_documentation_tells_the_rule() {
    let row = format!("| `{}` | error | {}", REBAKE.id, REBAKE.asks);
    assert!(
        include_str!("../../../docs/checks.md").contains(&row),
        "docs/checks.md lacks: {row}"
    );
}

//! Packs on disk: opened, refused, saved whole or not at all.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use proptest::prelude::*;

use crate::build::Source;
use crate::error::{PackError, WriteError};
use crate::field::Field;
use crate::image::Image;
use crate::manifest::{MANIFEST_FILE, schema_json};
use crate::pack::Pack;
use crate::role::Role;
use crate::save::Overwrite;
use crate::test_field::field;
use crate::test_pack::{Stream, info, pack, sources, write};

fn never() -> bool {
    false
}

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<_> = fs::read_dir(folder)
        .unwrap()
        .map(|e| e.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

/// A pack of one tiny texture: small enough to damage everywhere.
fn tiny() -> Pack {
    let pack = pack();
    let mut texture = pack.texture(Role::Galaxy).unwrap().clone();
    texture.levels.drain(..3);
    (texture.width, texture.height) = (4, 4);
    Pack::from_textures(info(), vec![(Role::Galaxy, texture)]).unwrap()
}

fn open_bytes(files: &[(String, Vec<u8>)]) -> Result<Pack, PackError> {
    Pack::from_files("p", |name, _| {
        Ok(files.iter().find(|(n, _)| n == name).unwrap().1.clone())
    })
}

#[test]
fn a_saved_pack_opens_as_it_was() {
    let place = tempfile::tempdir().unwrap();
    let folder = place.path().join("a/b/pack");
    let pack = pack();
    pack.save(&folder, Overwrite::Keep, &never).unwrap();
    assert_eq!(Pack::open(&folder).unwrap(), pack);
    assert_eq!(names(folder.parent().unwrap()), ["pack"]);
    assert_eq!(
        names(&folder),
        [
            "catalogue.ktx2",
            "clouds.ktx2",
            "fbm.ktx2",
            "field.glb",
            "flares.ktx2",
            "galaxy.ktx2",
            "layers.ktx2",
            "octaves.ktx2",
            "pack.json",
            "sky.ktx2",
            "skybox.ktx2",
            "sprites.ktx2",
            "stars.ktx2",
            "sun.ktx2"
        ]
    );
}

#[test]
fn an_existing_pack_is_kept_unless_told_otherwise() {
    let place = tempfile::tempdir().unwrap();
    let folder = place.path().join("pack");
    pack().save(&folder, Overwrite::Keep, &never).unwrap();
    let error = tiny().save(&folder, Overwrite::Keep, &never).unwrap_err();
    assert!(
        matches!(error, PackError::Write(WriteError::Exists { .. })),
        "{error}"
    );
    assert_eq!(Pack::open(&folder).unwrap(), pack());
    tiny().save(&folder, Overwrite::Replace, &never).unwrap();
    assert_eq!(Pack::open(&folder).unwrap(), tiny());
    assert_eq!(names(place.path()), ["pack"]);
}

#[test]
fn a_folder_that_is_not_a_pack_is_never_replaced() {
    let place = tempfile::tempdir().unwrap();
    let folder = place.path().join("thesis");
    fs::create_dir(&folder).unwrap();
    fs::write(folder.join("chapter"), "1").unwrap();
    let error = pack()
        .save(&folder, Overwrite::Replace, &never)
        .unwrap_err();
    assert!(is_no_pack(&error), "{error}");
    let file = folder.join("chapter");
    assert!(matches!(
        pack().save(&file, Overwrite::Replace, &never),
        Err(PackError::Write(WriteError::NotAFolder { .. }))
    ));
    assert_eq!(names(&folder), ["chapter"]);
}

fn is_no_pack(error: &PackError) -> bool {
    matches!(error, PackError::Write(WriteError::NotAPack { .. }))
}

#[test]
fn a_manifest_of_something_else_makes_no_pack() {
    let place = tempfile::tempdir().unwrap();
    let folder = place.path().join("app");
    fs::create_dir(&folder).unwrap();
    for text in [
        "",
        "{}",
        "[1]",
        "{\"kind\": \"web-app\"}",
        "{\"kind\": \"welkin-pack\"}",
    ] {
        fs::write(folder.join(MANIFEST_FILE), text).unwrap();
        let error = pack()
            .save(&folder, Overwrite::Replace, &never)
            .unwrap_err();
        assert!(is_no_pack(&error), "{text}: {error}");
        assert_eq!(
            fs::read(folder.join(MANIFEST_FILE)).unwrap(),
            text.as_bytes()
        );
    }
    // A pack of another version is one, damaged textures or not.
    let older = "{\"kind\": \"welkin-pack\", \"version\": 3, \"roles\": []}";
    fs::write(folder.join(MANIFEST_FILE), older).unwrap();
    fs::write(folder.join("clouds.ktx2"), "damaged").unwrap();
    pack().save(&folder, Overwrite::Replace, &never).unwrap();
    assert_eq!(Pack::open(&folder).unwrap(), pack());
}

#[test]
fn a_pack_with_something_else_in_it_is_kept_and_that_is_named() {
    let place = tempfile::tempdir().unwrap();
    let folder = place.path().join("pack");
    tiny().save(&folder, Overwrite::Keep, &never).unwrap();
    fs::write(folder.join("recipe.toml"), "mine").unwrap();
    fs::create_dir(folder.join("inner")).unwrap();
    let before = names(&folder);
    let error = pack()
        .save(&folder, Overwrite::Replace, &never)
        .unwrap_err();
    assert!(
        matches!(&error, PackError::Write(WriteError::NotOurs { found, .. }) if found == "inner, recipe.toml"),
        "{error}"
    );
    assert_eq!(
        (names(&folder), names(place.path())),
        (before, vec!["pack".to_string()])
    );
}

#[cfg(unix)]
#[test]
fn a_link_to_a_pack_stays_and_the_pack_is_replaced() {
    let place = tempfile::tempdir().unwrap();
    let [real, link] = ["real/pack", "link"].map(|name| place.path().join(name));
    std::os::unix::fs::symlink("real/pack", &link).unwrap();
    // At first it leads nowhere.
    tiny().save(&link, Overwrite::Keep, &never).unwrap();
    assert_eq!(Pack::open(&real).unwrap(), tiny());
    pack().save(&link, Overwrite::Replace, &never).unwrap();
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    assert_eq!(Pack::open(&real).unwrap(), pack());
    assert_eq!(names(place.path()), ["link", "real"]);
    assert_eq!(names(real.parent().unwrap()), ["pack"]);
}

#[test]
fn a_pack_that_cannot_be_written_leaves_nothing() {
    let place = tempfile::tempdir().unwrap();
    fs::write(place.path().join("file"), "").unwrap();
    let error = pack()
        .save(place.path().join("file/pack"), Overwrite::Keep, &never)
        .unwrap_err();
    assert!(
        matches!(&error, PackError::Write(WriteError::Failed { file, .. }) if file.ends_with("file/pack")),
        "{error}"
    );
    assert_eq!(names(place.path()), ["file"]);
}

#[test]
fn cancelling_leaves_nothing_not_even_new_folders() {
    let place = tempfile::tempdir().unwrap();
    for steps in 0..10 {
        let left = std::cell::Cell::new(steps);
        let cancelled = || left.replace(left.get().max(1) - 1) == 0;
        let error = pack()
            .save(place.path().join("new/pack"), Overwrite::Keep, &cancelled)
            .unwrap_err();
        assert!(
            matches!(error, PackError::Write(WriteError::Cancelled)),
            "{error}"
        );
        assert!(names(place.path()).is_empty());
    }
}

#[test]
fn one_flipped_bit_anywhere_is_refused() {
    let files = tiny().files().to_vec();
    open_bytes(&files).unwrap();
    for file in 0..files.len() {
        for at in 0..files[file].1.len() {
            for bit in 0..8 {
                let mut damaged = files.clone();
                damaged[file].1[at] ^= 1 << bit;
                assert!(
                    open_bytes(&damaged).is_err(),
                    "{} byte {at} bit {bit}",
                    files[file].0
                );
            }
        }
    }
}

#[test]
fn one_flipped_bit_in_the_field_is_refused() {
    let mut field = field();
    field.clouds.truncate(1);
    let files = tiny().with_field(field.clone()).unwrap().files().to_vec();
    assert_eq!(open_bytes(&files).unwrap().field(), Some(&field));
    let names: Vec<&str> = files.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["galaxy.ktx2", "field.glb", "pack.json"]);
    for at in 0..files[1].1.len() {
        let mut damaged = files.clone();
        damaged[1].1[at] ^= 1 << (at % 8);
        assert!(open_bytes(&damaged).is_err(), "byte {at}");
    }
}

#[test]
fn a_second_field_takes_the_place_of_the_first() {
    let mut other = field();
    other.hours.truncate(1);
    let pack = tiny().with_field(field()).unwrap();
    let pack = pack.with_field(other.clone()).unwrap();
    assert_eq!(pack, tiny().with_field(other).unwrap());
}

#[test]
fn a_field_that_is_not_sound_is_not_built() {
    let blamed = |change: &dyn Fn(&mut Field)| {
        let mut field = field();
        change(&mut field);
        tiny().with_field(field).unwrap_err().to_string()
    };
    assert_eq!(
        blamed(&|f| f.sections = 0),
        "field.glb: sections is 0, expected 1 to 8"
    );
    assert_eq!(
        blamed(&|f| f.clouds.clear()),
        "field.glb: clouds is 0, expected 1 to 4096"
    );
    assert!(blamed(&|f| f.clouds[0].sprites[0].centre_m[1] = f32::NAN).contains("centre_m is NaN"));
    assert!(blamed(&|f| f.clouds[0].rank = f32::NAN).contains("clouds[0].rank is NaN"));
    assert!(blamed(&|f| f.clouds[0].size_m[0] += 1.0).contains("clouds[0].centre_m, size_m"));
}

#[test]
fn a_missing_file_is_named() {
    let place = tempfile::tempdir().unwrap();
    write(&pack(), place.path());
    fs::remove_file(place.path().join("stars.ktx2")).unwrap();
    let error = Pack::open(place.path()).unwrap_err();
    assert!(
        matches!(&error, PackError::Missing { file, .. } if file.ends_with("stars.ktx2")),
        "{error}"
    );
    assert!(matches!(
        Pack::open(place.path().join("nowhere")),
        Err(PackError::Missing { .. })
    ));
}

#[test]
fn files_in_memory_are_read_as_those_of_a_folder() {
    let place = tempfile::tempdir().unwrap();
    write(&pack(), place.path());
    let name = place.path().display().to_string();
    let mut files: BTreeMap<_, _> = pack().files().iter().cloned().collect();
    assert_eq!(Pack::from_memory(&name, &files).unwrap(), pack());
    let alike = |files: &BTreeMap<_, _>| {
        let both = [Pack::from_memory(&name, files), Pack::open(place.path())];
        let [memory, folder] = both.map(|pack| pack.unwrap_err().to_string());
        assert_eq!(memory, folder);
    };
    files.remove("stars.ktx2");
    fs::remove_file(place.path().join("stars.ktx2")).unwrap();
    alike(&files);
    let large = vec![b' '; crate::limits::MAX_MANIFEST_BYTES as usize + 1];
    fs::write(place.path().join(MANIFEST_FILE), &large).unwrap();
    files.insert(MANIFEST_FILE.to_string(), large);
    alike(&files);
    fs::remove_file(place.path().join(MANIFEST_FILE)).unwrap();
    files.clear();
    alike(&files);
}

#[test]
fn a_file_over_the_limit_is_not_read() {
    let place = tempfile::tempdir().unwrap();
    write(&pack(), place.path());
    let file = fs::OpenOptions::new()
        .write(true)
        .open(place.path().join(MANIFEST_FILE))
        .unwrap();
    file.set_len(crate::limits::MAX_MANIFEST_BYTES + 1).unwrap();
    let error = Pack::open(place.path()).unwrap_err();
    assert!(
        matches!(
            error,
            PackError::TooLarge {
                found: 1_048_577,
                limit: 1_048_576,
                ..
            }
        ),
        "{error}"
    );
}

fn open_with_manifest(change: impl Fn(&str) -> String) -> String {
    let mut files = tiny().files().to_vec();
    let text = String::from_utf8(files[1].1.clone()).unwrap();
    files[1].1 = change(&text).into_bytes();
    open_bytes(&files).unwrap_err().to_string()
}

#[test]
fn another_version_is_refused_for_its_version() {
    let error = open_with_manifest(|text| {
        text.replace("\"version\": 7", "\"version\": 3")
            .replace("\"seed\"", "\"seeds\"")
    });
    assert_eq!(
        error,
        "p/pack.json: version is 3, expected 7; use a welkin that knows this version, or bake again"
    );
}

#[test]
fn errors_of_the_manifest_name_line_key_found_and_expected() {
    let error = open_with_manifest(|text| text.replace("\"seed\"", "\"seeds\""));
    assert!(error.starts_with("p/pack.json:5:"), "{error}");
    assert!(error.contains("unknown field `seeds`"), "{error}");
    let error = open_with_manifest(|text| text.replace("welkin-pack", "gltf"));
    assert_eq!(
        error,
        "p/pack.json: kind is \"gltf\", expected \"welkin-pack\""
    );
    let error = open_with_manifest(|text| text.replace("\"test\"", "\"best\""));
    assert!(error.contains("seal is "), "{error}");
}

#[test]
fn images_that_do_not_fit_their_role_are_refused() {
    let blamed = |change: &dyn Fn(&mut Vec<crate::Source>)| {
        let mut sources = sources();
        change(&mut sources);
        match Pack::build(info(), sources).unwrap_err() {
            PackError::Value { file, key, .. } => format!("{file} {key}"),
            other => panic!("{other}"),
        }
    };
    assert_eq!(
        blamed(&|s| s[0].format = crate::Format::R8Unorm),
        "clouds.ktx2 format"
    );
    assert_eq!(
        blamed(&|s| s[1].images = vec![crate::Image::new(128, 128, 1)]),
        "stars.ktx2 channels"
    );
    assert_eq!(
        blamed(&|s| s[2].images = vec![crate::Image::new(100, 128, 1)]),
        "galaxy.ktx2 width"
    );
    assert_eq!(
        blamed(&|s| s[2].images[0].texels[7] = f32::NAN),
        "galaxy.ktx2 texels"
    );
    assert_eq!(
        blamed(&|s| s[2].images[0].texels.truncate(5)),
        "galaxy.ktx2 texels"
    );
    assert_eq!(blamed(&|s| s[1] = s[2].clone()), "galaxy.ktx2 role");
}

#[test]
fn layers_that_do_not_fit_their_role_are_refused() {
    let blamed = |role: Role, change: &dyn Fn(&mut Vec<Image>)| {
        let mut sources = sources();
        let source = sources.iter_mut().find(|s| s.role == role);
        change(&mut source.unwrap().images);
        Pack::build(info(), sources).unwrap_err().to_string()
    };
    assert_eq!(
        blamed(Role::Octaves, &|i| i[0] = Image::new(64, 64, 4)),
        "octaves.ktx2: width is 64, expected 32"
    );
    assert_eq!(
        blamed(Role::Octaves, &|i| i.push(i[0].clone())),
        "octaves.ktx2: layers is 2, expected 1"
    );
    assert_eq!(
        blamed(Role::Fbm, &|i| i.resize(9, i[0].clone())),
        "fbm.ktx2: layers is 9, expected 1 to 4 at this width: the finest cell has two texels or more"
    );
    assert_eq!(
        blamed(Role::Fbm, &|i| *i = vec![Image::new(1024, 1024, 4); 9]),
        "fbm.ktx2: layers is 9, expected 1 to 8"
    );
    assert_eq!(
        blamed(Role::Fbm, &|i| i[1] = Image::new(128, 128, 4)),
        "fbm.ktx2: images is 128x128, expected 64x64, as the first"
    );
    assert_eq!(
        blamed(Role::Fbm, &|i| i[0] = Image::new(128, 64, 4)),
        "fbm.ktx2: height is 64, expected 128, as the width"
    );
    assert_eq!(
        blamed(Role::Fbm, &|i| i[1].texels[3] = f32::INFINITY),
        "fbm.ktx2: texels is inf at 3, expected finite values"
    );
    assert_eq!(
        blamed(Role::Fbm, &Vec::clear),
        "fbm.ktx2: width is 0, expected a power of two from 64 to 1024"
    );
    assert_eq!(
        blamed(Role::Flares, &|i| i[0] = Image::new(32, 32, 1)),
        "flares.ktx2: width is 32, expected a power of two from 64 to 1024"
    );
    assert_eq!(
        blamed(Role::Layers, &|i| i.truncate(2)),
        "layers.ktx2: layers is 2, expected 3"
    );
}

/// A source of `layers` images of noise.
fn noisy(role: Role, size: u32, layers: u32, seed: u64) -> Source {
    let mut stream = Stream::new(seed);
    let format = role.spec().formats[0];
    let images = (0..layers).map(|_| {
        let mut image = Image::new(size, size, format.channels());
        image.texels.iter_mut().for_each(|v| *v = stream.unit());
        image
    });
    Source {
        role,
        format,
        images: images.collect(),
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn every_layer_has_the_levels_that_it_would_have_alone(layers in 1_u32..=4, seed in any::<u64>()) {
        for (role, layers) in [(Role::Fbm, layers), (Role::Skybox, 6)] {
            let source = noisy(role, 64, layers, seed);
            let pack = Pack::build(info(), vec![source.clone()]).unwrap();
            let texture = pack.texture(role).unwrap();
            prop_assert_eq!(texture.layers, layers);
            for (layer, image) in (0..).zip(source.images) {
                let mut level = image;
                for index in 0..texture.levels.len() {
                    if index > 0 {
                        level = crate::mip::fold::halve(&level);
                    }
                    let found = texture.image(index, layer);
                    prop_assert_eq!((found.width, found.height), (level.width, level.height));
                    let stored = crate::texture::encode(texture.format, &level.texels);
                    prop_assert_eq!(crate::texture::encode(texture.format, &found.texels), stored);
                }
            }
        }
    }

    #[test]
    fn the_manifests_figures_are_of_all_layers(layers in 1_u32..=4, seed in any::<u64>()) {
        let pack = Pack::build(info(), vec![noisy(Role::Fbm, 64, layers, seed)]).unwrap();
        let texture = pack.texture(Role::Fbm).unwrap();
        let entry = pack.manifest().texture(Role::Fbm).unwrap();
        prop_assert_eq!(entry.layers, layers);
        for (index, channel) in entry.channels.iter().enumerate() {
            let means = (0..layers).map(|layer| texture.image(0, layer).mean_and_spread(index).0);
            let mean = means.sum::<f32>() / layers as f32;
            prop_assert!((channel.mean - mean).abs() < 1e-6);
        }
    }
}

#[test]
fn normals_that_cannot_be_leave_no_level_without_numbers() {
    let pack = Pack::build(info(), vec![noisy(Role::Layers, 64, 3, 1)]).unwrap();
    let texture = pack.texture(Role::Layers).unwrap();
    assert_eq!(texture.levels.len(), 7);
}

#[test]
fn the_published_schema_is_current() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/pack.schema.json");
    if std::env::var_os("WELKIN_BLESS").is_some() {
        fs::write(&path, schema_json()).unwrap();
    }
    let published = fs::read_to_string(&path).unwrap_or_default();
    assert!(
        published == schema_json(),
        "docs/pack.schema.json is old: run `WELKIN_BLESS=1 make test` and look at the change"
    );
}

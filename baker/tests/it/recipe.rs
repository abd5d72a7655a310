//! Recipes: defaults, and every kind of mistake with its place, key, finding and expectation.

use welkin_baker::{DEFAULT_RECIPE, PhotoProjection, Recipe, RecipeError, Resolved};
use welkin_pack::Format;

fn resolve(text: &str) -> Result<Resolved, RecipeError> {
    Recipe::parse("sky.toml", text)?.resolve(None)
}

#[test]
fn the_default_recipe_spells_out_the_defaults() {
    let spelled = resolve(DEFAULT_RECIPE).unwrap();
    let mut implied = resolve("").unwrap();
    implied.recipe.clone_from(&spelled.recipe);
    assert_eq!(spelled, implied);
    assert_eq!(Recipe::default().resolve(None).unwrap(), spelled);
}

#[test]
fn line_ends_and_a_byte_order_mark_are_no_part_of_a_recipe() {
    let windows = format!("\u{feff}{}", DEFAULT_RECIPE.replace('\n', "\r\n"));
    assert_eq!(resolve(&windows).unwrap(), resolve(DEFAULT_RECIPE).unwrap());
    // Places are told as an editor counts them.
    let error = resolve("\u{feff}seed = 1\r\n\r\nstars.count = -3\r\n").unwrap_err();
    assert!(
        error.to_string().starts_with("sky.toml:3:15: stars.count"),
        "{error}"
    );
}

#[test]
fn a_checkout_on_windows_has_the_recipes_as_they_are_here() {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/..");
    let attributes = std::fs::read_to_string(format!("{root}/.gitattributes")).unwrap();
    assert!(attributes.lines().any(|line| line == "* text=auto eol=lf"));
    assert!(!DEFAULT_RECIPE.contains('\r'));
}

#[test]
fn photo_and_noise_that_are_too_thin_or_too_thick_together_are_told_by_the_one_to_turn() {
    for (text, expected) in [
        (
            "clouds.photo.mean = 0.05\nclouds.noise.mean = 0.1",
            "sky.toml:2:21: clouds.noise.mean is 0.1, expected 0.11 to 0.68 with clouds.photo.mean = 0.05",
        ),
        (
            "clouds.photo.mean = 0.58\nclouds.noise.mean = 0.66",
            "sky.toml:2:21: clouds.noise.mean is 0.66, expected 0.05 to 0.28 with clouds.photo.mean = 0.58",
        ),
    ] {
        assert_eq!(resolve(text).unwrap_err().to_string(), expected);
    }
    for means in [
        [0.05, 0.11],
        [0.05, 0.68],
        [0.58, 0.28],
        [0.16, 0.64],
        [0.59, 0.26],
    ] {
        let [photo, noise] = means;
        let text = format!("clouds.photo.mean = {photo}\nclouds.noise.mean = {noise}");
        assert!(resolve(&text).is_ok(), "{text}");
    }
}

#[test]
fn a_given_seed_overrides_the_recipes() {
    let recipe = Recipe::parse("sky.toml", "seed = 3").unwrap();
    assert_eq!(recipe.resolve(None).unwrap().seed, 3);
    assert_eq!(recipe.resolve(Some(u64::MAX)).unwrap().seed, u64::MAX);
}

#[test]
fn unknown_keys_and_broken_text_are_told_with_their_place() {
    let cases = [
        ("[clouds]\nsise = 512\n", 2, 1, "sise"),
        ("[clouds.noise]\n\n  ünits = 3\n", 3, 3, ""),
        ("seed = 1\n[cloud]\n", 2, 2, "cloud"),
        ("name = \"a\"\nseed = = 2\n", 2, 8, ""),
        ("seed = 1\nseed = 2\n", 2, 1, "duplicate"),
        (
            "[layers.stratus]\ncells = 3\n",
            1,
            9,
            "expected one of `size`, `stratocumulus`, `cumulus`, `cirrus`",
        ),
    ];
    for (text, line, column, word) in cases {
        match resolve(text) {
            Err(RecipeError::Syntax {
                file,
                line: l,
                column: c,
                message,
            }) => {
                assert_eq!(
                    (file.as_str(), l, c),
                    ("sky.toml", line, column),
                    "{text:?}: {message}"
                );
                assert!(message.contains(word), "{text:?}: {message}");
            }
            other => panic!("{text:?} gave {other:?}"),
        }
    }
    let error = resolve("[stars]\ncuont = 1").unwrap_err().to_string();
    assert!(
        error.starts_with("sky.toml:2:1: unknown field `cuont`"),
        "{error}"
    );
}

/// Every table and every list of a recipe. A table that is left out here is one that no test has given a wrong type.
#[test]
fn something_else_for_a_table_or_a_list_is_told_with_its_key() {
    let tables = [
        "clouds",
        "clouds.photo",
        "clouds.noise",
        "clouds.detail",
        "clouds.gradient",
        "stars",
        "galaxy",
        "sky",
        "sun",
        "fbm",
        "flares",
        "layers",
        "layers.stratocumulus",
        "layers.cumulus",
        "layers.cirrus",
        "sprites",
        "skybox",
        "skybox.faces",
        "field",
    ];
    let lists = [
        "sprites.pictures",
        "field.clouds",
        "field.models",
        "field.hours",
    ];
    let told = |text: &str| {
        let error = resolve(text).unwrap_err();
        assert!(
            matches!(error, RecipeError::Value { .. }),
            "{text}: {error:?}"
        );
        error.to_string()
    };
    for value in ["3", "-1.5", "\"text\"", "true", "1979-05-27"] {
        for key in tables {
            let column = key.len() + 4;
            assert_eq!(
                told(&format!("{key} = {value}\n")),
                format!(
                    "sky.toml:1:{column}: {key} is {value}, expected a table, which begins with `[{key}]`"
                )
            );
        }
        for key in lists {
            let column = key.len() + 4;
            assert_eq!(
                told(&format!("{key} = {value}\n")),
                format!("sky.toml:1:{column}: {key} is {value}, expected a list")
            );
        }
        let boxes = format!("[[field.models]]\nboxes = {value}\n");
        assert_eq!(
            told(&boxes),
            format!("sky.toml:2:9: field.models[0].boxes is {value}, expected a list")
        );
        let entry = format!("field.clouds = [{{}}, {value}]\n");
        assert_eq!(
            told(&entry),
            format!("sky.toml:1:21: field.clouds[1] is {value}, expected a table")
        );
    }
    assert!(told("[field.hours]\ntime = 0").contains(
        "field.hours is a table, expected a list of tables, which each begin with `[[field.hours]]`"
    ));
    // The parser takes the entries of a list for the keys of a table.
    for list in [
        "[]",
        "[64]",
        "[1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14]",
    ] {
        for key in tables {
            let error = told(&format!("{key} = {list}\n"));
            assert!(
                error.contains(&format!(
                    "{key} is a list, expected a table, which begins with `[{key}]`"
                )),
                "{error}"
            );
        }
        let boxes = told(&format!(
            "[[field.models]]\nkind = \"cumulus\"\nboxes = [{list}]\n"
        ));
        assert!(
            boxes.contains("field.models[0].boxes[0] is a list, expected a table"),
            "{boxes}"
        );
    }
    let long = format!("sun = \"{}\"", "x".repeat(5000));
    assert!(told(&long).len() < 200);
}

#[test]
fn values_of_the_wrong_type_or_out_of_range_are_told_with_key_and_place() {
    let cases = [
        ("seed = -1", "seed", "-1", "0 to"),
        ("seed = 1.5", "seed", "1.5", "integer"),
        ("name = \"\"", "name", "\"\"", "1 to 64"),
        ("name = \"a\\nb\"", "name", "a", "one line"),
        (
            "clouds.size = 0",
            "clouds.size",
            "0",
            "power of two from 64 to 4096",
        ),
        (
            "clouds.size = 3",
            "clouds.size",
            "3",
            "power of two from 64 to 4096",
        ),
        (
            "clouds.size = 100000",
            "clouds.size",
            "100000",
            "power of two from 64 to 4096",
        ),
        (
            "clouds.size = \"big\"",
            "clouds.size",
            "\"big\"",
            "power of two",
        ),
        ("clouds.size = -512", "clouds.size", "-512", "power of two"),
        (
            "clouds.format = \"bc1\"",
            "clouds.format",
            "\"bc1\"",
            "rgba16float",
        ),
        ("clouds.photo.file = 4", "clouds.photo.file", "4", "path"),
        (
            "clouds.photo.mask = \"\"",
            "clouds.photo.mask",
            "\"\"",
            "path",
        ),
        (
            "clouds.photo.as_is = 1",
            "clouds.photo.as_is",
            "1",
            "true or false",
        ),
        (
            "clouds.photo.invert = \"yes\"",
            "clouds.photo.invert",
            "\"yes\"",
            "true or false",
        ),
        (
            "clouds.photo.levels = [0.5, 0.4]",
            "clouds.photo.levels",
            "[0.5, 0.4]",
            "black and white",
        ),
        (
            "clouds.photo.levels = [0.0, nan]",
            "clouds.photo.levels",
            "nan",
            "black and white",
        ),
        (
            "clouds.photo.levels = 0.5",
            "clouds.photo.levels",
            "0.5",
            "black and white",
        ),
        (
            "clouds.photo.flatten = 1.5",
            "clouds.photo.flatten",
            "1.5",
            "0 to 1",
        ),
        (
            "clouds.photo.sharpness = 0.1",
            "clouds.photo.sharpness",
            "0.1",
            "0.25 to 8",
        ),
        (
            "clouds.photo.seam = \"sew\"",
            "clouds.photo.seam",
            "\"sew\"",
            "\"blend\" or \"cut\"",
        ),
        (
            "clouds.photo.region = [0, 0, 63, 100]",
            "clouds.photo.region",
            "[0, 0, 63, 100]",
            "64 or more",
        ),
        (
            "clouds.photo.region = [0, -1, 100, 100]",
            "clouds.photo.region",
            "-1",
            "left, top, width and height",
        ),
        (
            "clouds.photo.region = [0, 0, 100]",
            "clouds.photo.region",
            "[0, 0, 100]",
            "left, top, width and height",
        ),
        (
            "clouds.photo.mean = nan",
            "clouds.photo.mean",
            "nan",
            "0.05 to 0.68",
        ),
        (
            "clouds.photo.mean = inf",
            "clouds.photo.mean",
            "inf",
            "0.05 to 0.68",
        ),
        (
            "clouds.noise.mean = 1.0",
            "clouds.noise.mean",
            "1.0",
            "0.05 to 0.68",
        ),
        (
            "clouds.photo.mean = 0.67",
            "clouds.photo.mean",
            "0.67",
            "with clouds.noise.mean = 0.22",
        ),
        (
            "clouds.noise.cells = 65",
            "clouds.noise.cells",
            "65",
            "1 to 64",
        ),
        (
            "clouds.detail.octaves = 0",
            "clouds.detail.octaves",
            "0",
            "1 to 10",
        ),
        (
            "clouds.detail.gain = 2",
            "clouds.detail.gain",
            "2",
            "0 to 1",
        ),
        (
            "clouds.gradient.power = 3",
            "clouds.gradient.power",
            "3",
            "1 to 2",
        ),
        ("stars.size = 96", "stars.size", "96", "power of two"),
        ("stars.count = 2049", "stars.count", "2049", "1 to 2048"),
        ("stars.magnitudes = 6", "stars.magnitudes", "6", "0.5 to 5"),
        (
            "stars.catalogue = 3",
            "stars.catalogue",
            "3",
            "\"built-in\"",
        ),
        (
            "stars.catalogue = ''",
            "stars.catalogue",
            "\"\"",
            "path of a catalogue",
        ),
        (
            "stars.brightest = 0.1",
            "stars.brightest",
            "0.1",
            "0.8 to 1",
        ),
        ("galaxy.size = 1", "galaxy.size", "1", "power of two"),
        ("galaxy.tilt_deg = 91", "galaxy.tilt_deg", "91", "0 to 90"),
        ("galaxy.dust = true", "galaxy.dust", "true", "0 to 1"),
        ("sky.width = 128", "sky.width", "128", "16 to 64"),
        ("sky.width = 24", "sky.width", "24", "power of two"),
        ("sky.height = 16", "sky.height", "16", "32 to 64"),
        ("sky.suns = 15", "sky.suns", "15", "16 to 64"),
        ("sky.suns = 65", "sky.suns", "65", "16 to 64"),
        ("sky.haze = -0.5", "sky.haze", "-0.5", "0 to 10"),
        ("sky.haze = nan", "sky.haze", "nan", "0 to 10"),
        ("sky.most_haze = 0", "sky.most_haze", "0", "0.1 to 40"),
        ("sky.most_haze = 41", "sky.most_haze", "41", "0.1 to 40"),
        (
            "sky.most_haze = 1.05",
            "sky.most_haze",
            "1.05",
            "0.1 more than sky.haze, 1, or more",
        ),
        (
            "sun.noon_elevation_deg = 0",
            "sun.noon_elevation_deg",
            "0",
            "5 to 90",
        ),
        ("sun.size = [128]", "sun.size", "128", "power of two"),
        (
            "fbm.size = 32",
            "fbm.size",
            "32",
            "power of two from 64 to 1024",
        ),
        (
            "fbm.size = 2048",
            "fbm.size",
            "2048",
            "power of two from 64 to 1024",
        ),
        (
            "fbm.cells = 2",
            "fbm.cells",
            "2",
            "power of two from 4 to 128",
        ),
        (
            "fbm.cells = 12",
            "fbm.cells",
            "12",
            "power of two from 4 to 128",
        ),
        (
            "fbm.cells = 256",
            "fbm.cells",
            "256",
            "power of two from 4 to 128",
        ),
        // 8 cells, five times doubled, are 256 on 256 texels: there would be nothing between them.
        (
            "fbm.octaves = 6",
            "fbm.octaves",
            "6",
            "an integer from 1 to 5",
        ),
        (
            "fbm.octaves = 0",
            "fbm.octaves",
            "0",
            "an integer from 1 to 5",
        ),
        (
            "fbm.octaves = nan",
            "fbm.octaves",
            "nan",
            "an integer from 1 to 5",
        ),
        (
            "flares.size = 0",
            "flares.size",
            "0",
            "power of two from 64 to 1024",
        ),
        (
            "flares.size = 1e3",
            "flares.size",
            "1000.0",
            "power of two from 64 to 1024",
        ),
        (
            "layers.size = 100",
            "layers.size",
            "100",
            "power of two from 64 to 1024",
        ),
        (
            "layers.stratocumulus.cells = 1",
            "layers.stratocumulus.cells",
            "1",
            "an integer from 2 to 32",
        ),
        (
            "layers.cumulus.cells = 17",
            "layers.cumulus.cells",
            "17",
            "an integer from 2 to 16",
        ),
        (
            "layers.cirrus.cells = 11",
            "layers.cirrus.cells",
            "11",
            "an integer from 2 to 10",
        ),
        (
            "layers.cirrus.octaves = 9",
            "layers.cirrus.octaves",
            "9",
            "an integer from 1 to 8",
        ),
        (
            "layers.cumulus.gain = -0.1",
            "layers.cumulus.gain",
            "-0.1",
            "a number from 0 to 1",
        ),
        (
            "layers.cirrus.relief = 0",
            "layers.cirrus.relief",
            "0",
            "a number from 0.1 to 2",
        ),
        (
            "sprites.size = 64",
            "sprites.size",
            "64",
            "power of two from 128 to 2048",
        ),
        (
            "sprites.contrast = 2.5",
            "sprites.contrast",
            "2.5",
            "a number from 0 to 2",
        ),
        (
            "sprites.detail = -1",
            "sprites.detail",
            "-1",
            "a number from 0 to 1.5",
        ),
        (
            "sprites.softness = 0",
            "sprites.softness",
            "0",
            "a number from 0.5 to 3",
        ),
        (
            "layers.stratocumulus.relief = nan",
            "layers.stratocumulus.relief",
            "nan",
            "a number from 0.1 to 2",
        ),
    ];
    for (text, key, found, expected) in cases {
        let text = format!("# a comment\n{text}\n");
        match resolve(&text) {
            Err(RecipeError::Value {
                file,
                line,
                column,
                key: k,
                found: f,
                expected: e,
            }) => {
                let start = text.lines().nth(1).unwrap().find("= ").unwrap() + 3;
                assert_eq!(
                    (file.as_str(), line, column),
                    ("sky.toml", 2, start),
                    "{text}"
                );
                assert_eq!(k, key);
                assert!(f.contains(found), "{text}: found {f}");
                assert!(e.contains(expected), "{text}: expected {e}");
            }
            other => panic!("{text} gave {other:?}"),
        }
    }
}

#[test]
fn projections_have_the_keys_that_they_need() {
    let of = |keys: &str| resolve(&format!("clouds.photo = {{ {keys} }}"));
    let projection = |keys: &str| of(keys).unwrap().clouds.photo.projection;
    let fov = |deg: f32| deg * (std::f32::consts::PI / 180.0);
    for (keys, expected) in [
        ("", PhotoProjection::Plan),
        ("projection = \"plan\"", PhotoProjection::Plan),
        (
            "projection = \"perspective\"",
            PhotoProjection::Perspective {
                fov_rad: fov(67.0),
                horizon: None,
            },
        ),
        (
            "projection = \"perspective\", fov_deg = 80, horizon = 1.25",
            PhotoProjection::Perspective {
                fov_rad: fov(80.0),
                horizon: Some(1.25),
            },
        ),
        (
            "projection = \"perspective\", horizon = \"auto\"",
            PhotoProjection::Perspective {
                fov_rad: fov(67.0),
                horizon: None,
            },
        ),
        (
            "projection = \"equirect\", horizon = 1",
            PhotoProjection::Equirect { horizon: Some(1.0) },
        ),
    ] {
        assert_eq!(projection(keys), expected, "{keys}");
    }
    for (keys, expected) in [
        (
            "projection = \"fisheye\"",
            "expected \"plan\", \"perspective\" or \"equirect\"",
        ),
        ("projection = 1", "expected \"plan\""),
        (
            "projection = \"perspective\", fov_deg = 200",
            "expected a number from 5 to 140",
        ),
        (
            "projection = \"perspective\", horizon = \"low\"",
            "expected \"auto\", or a number from -1 to 20",
        ),
        (
            "projection = \"perspective\", horizon = 30",
            "expected a number from -1 to 20",
        ),
        (
            "projection = \"equirect\", fov_deg = 60",
            "clouds.photo.fov_deg is 60, expected none with a panorama",
        ),
        (
            "fov_deg = 60",
            "clouds.photo.fov_deg is 60, expected none with `projection",
        ),
        (
            "horizon = 0.5",
            "clouds.photo.horizon is 0.5, expected none with `projection",
        ),
        (
            "as_is = true, projection = \"plan\"",
            "clouds.photo.projection is \"plan\", expected none with `as_is",
        ),
    ] {
        let error = of(keys).unwrap_err().to_string();
        assert!(error.contains(expected), "{keys}: {error}");
    }
}

#[test]
fn a_finished_tile_has_no_keys_that_would_change_it_and_a_mean_only_if_one_is_given() {
    for key in ["flatten", "sharpness"] {
        let text = format!("[clouds.photo]\nas_is = true\n{key} = 1\n");
        let error = resolve(&text).unwrap_err().to_string();
        let begin = format!("sky.toml:3:{}: clouds.photo.{key} is 1", key.len() + 4);
        assert!(
            error.starts_with(&begin) && error.contains("as_is"),
            "{error}"
        );
    }
    let mean = |text: &str| resolve(text).unwrap().clouds.photo.mean;
    assert_eq!(mean(""), Some(0.37));
    assert_eq!(mean("clouds.photo.as_is = true"), None);
    assert_eq!(
        mean("clouds.photo = { as_is = true, mean = 0.5 }"),
        Some(0.5)
    );
    assert!(resolve("clouds.photo = { as_is = true, mean = 0.7 }").is_err());
}

#[test]
fn formats_have_short_names() {
    for (name, format) in [
        ("rgba8unorm", Format::Rgba8Unorm),
        ("rgba8", Format::Rgba8Unorm),
        ("rgba16float", Format::Rgba16Float),
        ("rgba16f", Format::Rgba16Float),
    ] {
        let text = format!("clouds.format = \"{name}\"");
        assert_eq!(resolve(&text).unwrap().clouds.format, format);
    }
}

#[test]
fn small_sizes_have_defaults_that_fit_them() {
    let text = "[clouds]\nsize = 64\n[stars]\nsize = 64\n[fbm]\nsize = 64\n";
    let resolved = resolve(text).unwrap();
    assert_eq!(resolved.clouds.detail.cells, 8);
    assert_eq!(resolved.stars.count, 128);
    assert_eq!((resolved.fbm.cells, resolved.fbm.octaves), (8, 3));
    let resolved = resolve("[layers]\nsize = 64\n").unwrap();
    assert_eq!(resolved.layers.kinds.map(|kind| kind.cells), [8, 4, 2]);
}

#[test]
fn the_finest_octaves_that_fit_are_allowed_and_no_finer() {
    let resolved = resolve("[fbm]\nsize = 1024\ncells = 4\noctaves = 8\n").unwrap();
    assert_eq!(resolved.fbm.octaves, 8);
    // 512 cells on 1024 texels; the next would have one texel a cell.
    assert!(resolve("[fbm]\nsize = 1024\ncells = 8\noctaves = 8\n").is_err());
    assert!(resolve("[fbm]\nsize = 64\ncells = 32\noctaves = 1\n").is_ok());
    assert!(resolve("[fbm]\nsize = 64\ncells = 32\noctaves = 2\n").is_err());
}

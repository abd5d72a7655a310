//! The table `skybox` of a recipe, and the pack that comes of it.

use std::ops::ControlFlow;
use std::path::Path;

use welkin_baker::{Recipe, Resolved, SkyboxPicture, SkyboxSettings, bake, skybox_faces};
use welkin_pack::check::check;
use welkin_pack::{Overwrite, Role, Shape};

const FACES: &str = "{ north = 'n', east = 'e', south = 's', west = 'w', up = 'u', down = 'd' }";

fn resolve(text: &str) -> Result<Option<SkyboxSettings>, String> {
    let recipe = Recipe::parse("sky.toml", text).map_err(|e| e.to_string())?;
    let resolved = recipe.resolve(None).map_err(|e| e.to_string())?;
    Ok(resolved.skybox)
}

#[test]
fn keys_have_defaults_and_no_table_means_no_skybox() {
    assert_eq!(resolve("").unwrap(), None);
    let panorama = resolve("[skybox]\nfile = 'a.exr'").unwrap().unwrap();
    let picture = SkyboxPicture::Panorama {
        file: "a.exr".to_string(),
        azimuth_rad: 0.0,
    };
    assert_eq!(
        panorama,
        SkyboxSettings {
            picture,
            size: None,
            gain: 1.0
        }
    );
    let text = format!("[skybox]\nsize = 64\ngain = 0.5\nfaces = {FACES}");
    let faces = resolve(&text).unwrap().unwrap();
    let picture = SkyboxPicture::Faces(["e", "w", "u", "d", "s", "n"].map(str::to_string));
    assert_eq!(
        faces,
        SkyboxSettings {
            picture,
            size: Some(64),
            gain: 0.5
        }
    );
    let turned = resolve("[skybox]\nfile = 'a.exr'\nazimuth_deg = 90")
        .unwrap()
        .unwrap();
    let SkyboxPicture::Panorama { azimuth_rad, .. } = turned.picture else {
        panic!()
    };
    assert!((azimuth_rad - std::f32::consts::FRAC_PI_2).abs() < 1e-6);
}

#[test]
fn mistakes_are_told_with_their_place() {
    let told = |text: &str, parts: &[&str]| {
        let error = resolve(text).expect_err(text);
        for part in parts {
            assert!(error.contains(part), "{text}: {error}");
        }
    };
    told(
        "name = 'x'\n[skybox]",
        &[
            "sky.toml:2:",
            "skybox is without a picture",
            "`file`",
            "`faces`",
        ],
    );
    told(
        &format!("[skybox]\nfile = 'a'\nfaces = {FACES}"),
        &["both `file` and `faces`"],
    );
    told(
        "[skybox]\nfile = 3",
        &["sky.toml:2:8: skybox.file is 3", "OpenEXR"],
    );
    told("[skybox]\nfile = ''", &["skybox.file"]);
    let without_up = FACES.replace("up = 'u', ", "");
    told(
        &format!("[skybox]\nfaces = {without_up}"),
        &["sky.toml:2:", "skybox.faces.up is missing"],
    );
    told(
        "[skybox.faces]\nnorth = 'n'\neast = 1",
        &["sky.toml:3:8: skybox.faces.east is 1"],
    );
    told("[skybox.faces]\nzenith = 'n'", &["unknown field `zenith`"]);
    told("[skybox]\npicture = 'n'", &["unknown field `picture`"]);
    let table = |key: &str| format!("[skybox]\nfile = 'a'\n{key}");
    for size in ["0", "8", "100", "4096", "-1", "64.0"] {
        told(
            &table(&format!("size = {size}")),
            &["skybox.size", "a power of two from 16 to 2048"],
        );
    }
    for gain in ["0", "-1", "1001", "nan", "inf", "'x'"] {
        told(
            &table(&format!("gain = {gain}")),
            &["skybox.gain", "a number from 0.001 to 1000"],
        );
    }
    for azimuth in ["-1", "361", "nan"] {
        told(
            &table(&format!("azimuth_deg = {azimuth}")),
            &["skybox.azimuth_deg", "from 0 to 360"],
        );
    }
    told(
        &format!("[skybox]\nazimuth_deg = 10\nfaces = {FACES}"),
        &[
            "sky.toml:2:15: skybox.azimuth_deg is 10",
            "none with `faces`",
        ],
    );
}

/// The recipe that comes with the project, and its folder.
fn shipped() -> (&'static Path, Resolved) {
    let folder = Path::new(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../assets-src/recipes"
    ));
    let text = std::fs::read_to_string(folder.join("skybox.toml")).unwrap();
    let recipe = Recipe::parse("skybox.toml", &text).unwrap();
    (folder, recipe.resolve(None).unwrap())
}

#[test]
fn the_recipe_with_a_skybox_bakes_a_sound_pack() {
    let (folder, resolved) = shipped();
    let last = std::sync::Mutex::new(None);
    let pack = bake(&resolved, Some(folder), &|progress| {
        *last.lock().unwrap() = Some(progress);
        ControlFlow::Continue(())
    })
    .unwrap();
    let last = last.into_inner().unwrap().unwrap();
    assert_eq!((last.step, last.done), ("done", last.total));
    let texture = pack.texture(Role::Skybox).unwrap();
    assert_eq!(
        (texture.shape, texture.width, texture.layers),
        (Shape::Cube, 128, 6)
    );
    let inputs = &pack.manifest().inputs;
    let picture = std::fs::read(folder.join("../skies/sky-512x256.exr")).unwrap();
    assert_eq!(inputs.len(), 1);
    assert_eq!(inputs[0].key, "skybox.file");
    assert_eq!(
        inputs[0].blake3,
        blake3::hash(&picture).to_hex().to_string()
    );

    let place = tempfile::tempdir().unwrap();
    pack.save(place.path().join("pack"), Overwrite::Keep, &|| false)
        .unwrap();
    let report = check(place.path().join("pack")).unwrap();
    let problems: Vec<String> = report.problems().map(ToString::to_string).collect();
    assert!(problems.is_empty(), "{problems:#?}");
}

#[test]
fn a_bake_can_be_stopped_before_each_face() {
    let (folder, resolved) = shipped();
    let calls = std::sync::atomic::AtomicU32::new(0);
    let stopped = bake(&resolved, Some(folder), &|progress| {
        if progress.step != "skybox" {
            return ControlFlow::Continue(());
        }
        match calls.fetch_add(1, std::sync::atomic::Ordering::Relaxed) {
            4 => ControlFlow::Break(()),
            _ => ControlFlow::Continue(()),
        }
    });
    assert!(matches!(stopped, Err(welkin_baker::BakeError::Cancelled)));
    assert_eq!(calls.into_inner(), 5);
}

/// The rule that looks at seams tells a face of a real picture that was turned.
#[test]
fn a_turned_face_of_a_real_picture_is_warned_of() {
    let (folder, resolved) = shipped();
    let faces = skybox_faces(resolved.skybox.as_ref().unwrap(), Some(folder)).unwrap();
    let warned = |change: &dyn Fn(&mut Vec<welkin_pack::Image>)| {
        let mut faces = faces.clone();
        change(&mut faces);
        let source = welkin_pack::Source {
            role: Role::Skybox,
            format: welkin_pack::Format::Rgba16Float,
            images: faces,
        };
        let info = welkin_pack::PackInfo {
            name: "turned".to_string(),
            seed: 0,
            baker: "test".to_string(),
            recipe: String::new(),
            inputs: Vec::new(),
            noon_elevation_rad: 1.0,
            aerosol_depths: [0.04, 0.24],
            ..welkin_pack::PackInfo::default()
        };
        let place = tempfile::tempdir().unwrap();
        let folder = place.path().join("pack");
        let pack = welkin_pack::Pack::build(info, vec![source]).unwrap();
        pack.save(&folder, Overwrite::Keep, &|| false).unwrap();
        let report = check(&folder).unwrap();
        let seams: Vec<_> = report
            .problems()
            .filter(|f| f.rule == "skybox-seam")
            .collect();
        println!("{seams:?}");
        !seams.is_empty()
    };
    assert!(!warned(&|_| ()));
    assert!(warned(&|faces| faces.swap(0, 4)), "east and south");
    assert!(warned(&|faces| faces.swap(0, 1)), "east and west");
    // Up, turned by half.
    assert!(warned(&|faces| {
        let texels: Vec<&[f32]> = faces[2].texels.chunks_exact(4).rev().collect();
        faces[2].texels = texels.concat();
    }));
}

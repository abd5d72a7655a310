//! Packs as assets: loaded, loaded anew as their files change, and refused with a reason.

use std::ops::ControlFlow;
use std::path::Path;
use std::time::{Duration, Instant};

use bevy::asset::{AssetPath, LoadState};
use bevy::prelude::*;
use bevy::reflect::TypeRegistry;
use bevy::reflect::serde::{ReflectDeserializer, ReflectSerializer};
use bevy_welkin::welkin_pack::{Overwrite, Pack};
use bevy_welkin::welkin_runtime::Method;
use bevy_welkin::{WelkinPack, WelkinSky};

use crate::stage::{Stage, pack};

fn saved(pack: &Pack, folder: &Path) {
    let saved = pack.save(folder, Overwrite::Replace, &|| false);
    saved.expect("the pack is saved");
}

/// Waits until something is so, while the application goes on.
fn until(stage: &mut Stage, mut so: impl FnMut(&mut Stage) -> bool) -> bool {
    let start = Instant::now();
    while start.elapsed() < Duration::from_secs(60) {
        stage.update(1);
        if so(stage) {
            return true;
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    false
}

fn other_pack() -> Pack {
    let recipe = welkin_baker::Recipe::default()
        .resolve(Some(77))
        .expect("a recipe");
    welkin_baker::bake(&recipe, None, &|_| ControlFlow::Continue(())).expect("the pack bakes")
}

#[test]
fn a_pack_is_loaded_and_loaded_anew_when_its_files_change() {
    let assets = tempfile::tempdir().expect("a folder");
    let folder = assets.path().join("sky");
    saved(pack(), &folder);
    let mut stage = Stage::new(&assets.path().display().to_string());
    let server = stage.app.world().resource::<AssetServer>().clone();
    let loaded: Handle<WelkinPack> = server.load("sky/pack.json");
    let mut sky = WelkinSky::default();
    sky.params.cover = 0.5;
    sky.params.method = Method::Packed;
    stage.set(sky);
    let up = Transform::default().looking_to(Vec3::new(0.2, 1.0, -0.3), Vec3::X);
    let (_, image) = stage.camera(&loaded, up);
    assert!(
        until(&mut stage, |_| server.is_loaded(&loaded)),
        "{:?}",
        server.load_state(&loaded)
    );
    let first = stage.shoot(&image);

    for (name, bytes) in other_pack().files() {
        std::fs::write(folder.join(name), bytes).expect("written");
    }
    let replaced = until(&mut stage, |stage| {
        let packs = stage.app.world().resource::<Assets<WelkinPack>>();
        packs.get(&loaded).is_some_and(|now| now.pack() != pack())
    });
    assert!(replaced, "the new files are seen");
    let second = stage.shoot(&image);
    let (mean, _) = second.differs(&first);
    assert!(mean > 0.05, "{mean}");

    // The same as a camera that has never seen another.
    let fresh = WelkinPack::new(other_pack()).expect("a sky");
    let fresh = stage.add(fresh);
    let (_, image) = stage.camera(&fresh, up);
    let (mean, far) = stage.shoot(&image).differs(&second);
    assert!(mean < 1e-3 && far < 1e-3, "{mean} {far}");
}

#[test]
fn a_broken_pack_is_told_and_leaves_the_scene_as_it_is() {
    let assets = tempfile::tempdir().expect("a folder");
    let [cut, torn] = ["cut", "torn"].map(|name| assets.path().join(name));
    saved(pack(), &cut);
    saved(pack(), &torn);
    let files: Vec<_> = pack()
        .files()
        .iter()
        .map(|(name, _)| name.clone())
        .collect();
    let texture = files
        .iter()
        .find(|name| name.ends_with(".ktx2"))
        .expect("a texture");
    std::fs::remove_file(cut.join(texture)).expect("removed");
    let mut bytes = std::fs::read(torn.join(texture)).expect("read");
    let last = bytes.len() - 1;
    bytes[last] ^= 1;
    std::fs::write(torn.join(texture), bytes).expect("written");
    std::fs::create_dir(assets.path().join("empty")).expect("a folder");
    std::fs::write(assets.path().join("empty/pack.json"), "{}").expect("written");

    let mut stage = Stage::new(&assets.path().display().to_string());
    let server = stage.app.world().resource::<AssetServer>().clone();
    for (path, says) in [
        ("cut/pack.json", texture.as_str()),
        ("torn/pack.json", texture.as_str()),
        ("empty/pack.json", "pack.json"),
        ("none/pack.json", "none/pack.json"),
    ] {
        let handle: Handle<WelkinPack> = server.load(AssetPath::parse(path));
        let (_, image) = stage.camera(&handle, Transform::default());
        let failed = until(&mut stage, |_| server.load_state(&handle).is_failed());
        assert!(failed, "{path}");
        let LoadState::Failed(error) = server.load_state(&handle) else {
            panic!("{path} has not failed");
        };
        assert!(error.to_string().contains(says), "{path}: {error}");
        // What Bevy cleared the target to.
        let shown = stage.shoot(&image);
        let clear = shown.at(0, 0);
        assert!(shown.pixels.iter().all(|pixel| *pixel == clear), "{path}");
    }
}

#[test]
fn settings_are_written_and_read_by_serde_and_by_reflection() {
    let mut sky = WelkinSky::default();
    sky.params.cover = 0.31;
    sky.params.method = Method::Lit;
    sky.unit_cd_m2 = 1000.0;
    sky.seconds = 1e6;
    let text = serde_json::to_string(&sky).expect("written");
    assert_eq!(serde_json::from_str::<WelkinSky>(&text).expect("read"), sky);
    // What is not told is the default.
    let short: WelkinSky = serde_json::from_str(r#"{"params":{"cover":0.31}}"#).expect("read");
    assert_eq!(
        (short.params.cover, short.unit_cd_m2),
        (0.31, WelkinSky::default().unit_cd_m2)
    );

    let mut registry = TypeRegistry::default();
    registry.register::<WelkinSky>();
    let text = serde_json::to_string(&ReflectSerializer::new(&sky, &registry)).expect("written");
    let mut json = serde_json::Deserializer::from_str(&text);
    use serde::de::DeserializeSeed;
    let read = ReflectDeserializer::new(&registry)
        .deserialize(&mut json)
        .expect("read");
    let back = WelkinSky::from_reflect(read.as_partial_reflect()).expect("a sky");
    assert_eq!(back, sky);
}

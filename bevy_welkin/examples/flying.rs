//! Flies over hills under a moving sky: `cargo run --release --example flying`, or with the path of a pack's `pack.json` under `assets/` after `--`.
//!
//! W A S D and the mouse with its left button held: fly. Space and C: up and down. Shift: ten times as fast.
//! T and G: the hour. Y and H: cover. 1 to 5: packed, octaves, fbm, lit, sprites.

mod scene;

use bevy::camera::Hdr;
use bevy::core_pipeline::tonemapping::Tonemapping;
use bevy::input::mouse::AccumulatedMouseMotion;
use bevy::light::CascadeShadowConfigBuilder;
use bevy::prelude::*;
use bevy_welkin::welkin_runtime::Method;
use bevy_welkin::{
    DAYLIGHT, GlobalWelkinSky, WelkinAir, WelkinEnvironment, WelkinLight, WelkinPack, WelkinPlugin,
    WelkinShadows, WelkinView,
};

/// In metres a second.
const SPEED: f32 = 40.0;
/// Radians a pixel of the pointer's way.
const TURN: f32 = 0.003;

fn main() {
    App::new()
        .add_plugins((DefaultPlugins, WelkinPlugin))
        .add_systems(Startup, (scene::spawn, spawn))
        .add_systems(Update, (fly, set))
        .run();
}

fn spawn(
    mut commands: Commands,
    mut packs: ResMut<Assets<WelkinPack>>,
    mut sky: ResMut<GlobalWelkinSky>,
    assets: Res<AssetServer>,
) -> Result {
    let pack = match std::env::args().nth(1) {
        Some(path) => assets.load(path),
        None => packs.add(WelkinPack::new(scene::pack().map_err(|e| e.to_string())?)?),
    };
    sky.params.cover = 0.45;
    sky.params.time = 0.4;
    sky.params.method = Method::Lit;
    sky.params.shadow_extent_m = 12_000.0;
    commands.spawn((
        Camera3d::default(),
        Projection::from(PerspectiveProjection {
            far: 40_000.0,
            ..default()
        }),
        Transform::from_xyz(0.0, 30.0, 130.0).looking_to(Vec3::new(0.3, 0.08, -1.0), Vec3::Y),
        DAYLIGHT,
        Hdr,
        Tonemapping::AcesFitted,
        WelkinView(pack),
        WelkinEnvironment,
        WelkinAir,
    ));
    commands.spawn((
        DirectionalLight {
            shadow_maps_enabled: true,
            ..default()
        },
        CascadeShadowConfigBuilder {
            maximum_distance: 600.0,
            ..default()
        }
        .build(),
        WelkinLight,
        WelkinShadows,
    ));
    Ok(())
}

fn fly(
    mut camera: Single<&mut Transform, With<WelkinView>>,
    keys: Res<ButtonInput<KeyCode>>,
    buttons: Res<ButtonInput<MouseButton>>,
    pointer: Res<AccumulatedMouseMotion>,
    time: Res<Time>,
) {
    if buttons.pressed(MouseButton::Left) {
        let (yaw, pitch, _) = camera.rotation.to_euler(EulerRot::YXZ);
        let pitch = (pitch - TURN * pointer.delta.y).clamp(-1.5, 1.5);
        let yaw = yaw - TURN * pointer.delta.x;
        camera.rotation = Quat::from_euler(EulerRot::YXZ, yaw, pitch, 0.0);
    }
    let axis = |more, less| f32::from(keys.pressed(more)) - f32::from(keys.pressed(less));
    let way = camera.right() * axis(KeyCode::KeyD, KeyCode::KeyA)
        + camera.forward() * axis(KeyCode::KeyW, KeyCode::KeyS)
        + Vec3::Y * axis(KeyCode::Space, KeyCode::KeyC);
    let fast = if keys.pressed(KeyCode::ShiftLeft) {
        10.0
    } else {
        1.0
    };
    camera.translation += way * SPEED * fast * time.delta_secs();
    let ground_m = scene::height_m(camera.translation.xz());
    camera.translation.y = camera.translation.y.max(ground_m + 2.0);
}

fn set(mut sky: ResMut<GlobalWelkinSky>, keys: Res<ButtonInput<KeyCode>>, time: Res<Time>) {
    let axis = |more, less| f32::from(keys.pressed(more)) - f32::from(keys.pressed(less));
    let step = time.delta_secs();
    let hour = sky.params.time + 0.03 * step * axis(KeyCode::KeyT, KeyCode::KeyG);
    let cover = sky.params.cover + 0.2 * step * axis(KeyCode::KeyY, KeyCode::KeyH);
    sky.params.time = hour.rem_euclid(1.0);
    sky.params.cover = cover.clamp(0.0, 1.0);
    let methods = [
        (KeyCode::Digit1, Method::Packed),
        (KeyCode::Digit2, Method::Octaves),
        (KeyCode::Digit3, Method::Fbm),
        (KeyCode::Digit4, Method::Lit),
        (KeyCode::Digit5, Method::Sprites),
    ];
    for (key, method) in methods {
        if keys.just_pressed(key) {
            sky.params.method = method;
        }
    }
}

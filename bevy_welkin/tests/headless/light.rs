//! Bevy's lights by the sky: a white plane is as bright as the sky's own light says.

use std::f32::consts::PI;

use bevy::light::light_consts::lux::RAW_SUNLIGHT;
use bevy::pbr::decal::clustered::clustered_decals_are_usable;
use bevy::pbr::{AtmosphereSettings, DistanceFog};
use bevy::prelude::*;
use bevy_welkin::welkin_runtime::{Method, SkyLight};
use bevy_welkin::{
    DAYLIGHT, UNIT_CD_M2, WelkinAir, WelkinEnvironment, WelkinLight, WelkinPack, WelkinShadows,
    WelkinSky, WelkinView, WelkinViewLight,
};

use crate::stage::{Stage, pack};

fn bevy_vec3(vector: bevy_welkin::welkin_runtime::glam::Vec3) -> Vec3 {
    Vec3::from(vector.to_array())
}

fn luminance(colour: Vec3) -> f32 {
    colour.dot(Vec3::new(0.2126, 0.7152, 0.0722))
}

fn light(sky: &WelkinSky) -> SkyLight {
    let pack = WelkinPack::new(pack().clone()).expect("a sky");
    pack.light().light(&sky.params, 0.0)
}

/// Spawns a white plane without gloss, of so many metres a side, that lies at height 0.
fn plane(stage: &mut Stage, side_m: f32) {
    let mesh = stage.add(Mesh::from(Plane3d::new(Vec3::Y, Vec2::splat(0.5 * side_m))));
    let material = stage.add(StandardMaterial {
        base_color: Color::WHITE,
        perceptual_roughness: 0.5,
        reflectance: 0.0,
        ..default()
    });
    let world = stage.app.world_mut();
    world.spawn((Mesh3d(mesh), MeshMaterial3d(material)));
}

/// Down on it from ten metres.
fn down() -> Transform {
    Transform::from_xyz(0.0, 10.0, 0.0).looking_to(Vec3::NEG_Y, Vec3::NEG_Z)
}

#[test]
fn the_directional_light_is_where_the_sun_is_and_as_bright() {
    let mut stage = Stage::new("assets");
    let pack = stage.pack();
    stage.camera(&pack, down());
    let world = stage.app.world_mut();
    let sun = world.spawn((DirectionalLight::default(), WelkinLight)).id();
    for (time, overcast) in [(0.5, 0.0), (0.3, 0.0), (0.5, 0.7), (0.72, 0.3), (0.02, 0.0)] {
        let mut sky = WelkinSky::default();
        sky.params.time = time;
        sky.params.cover = overcast;
        stage.set(sky);
        stage.update(2);
        let expected = light(&sky);
        let from = if time < 0.1 {
            expected.moon
        } else {
            expected.sun
        };
        let entity = stage.app.world().entity(sun);
        let given = entity.get::<DirectionalLight>().expect("a light");
        let towards = entity.get::<GlobalTransform>().expect("a place").back();
        let apart = towards.dot(bevy_vec3(from.direction));
        assert!(apart > 0.99999, "{time}: {towards:?} {}", from.direction);
        let lux = luminance(bevy_vec3(from.irradiance)) * UNIT_CD_M2;
        assert!(
            (given.illuminance - lux).abs() <= 1e-3 * lux,
            "{time}: {} {lux}",
            given.illuminance
        );
        if time == 0.5 && overcast == 0.0 {
            assert!((70e3..110e3).contains(&lux), "a clear noon has {lux} lux");
        }
    }
}

#[test]
fn a_white_plane_has_the_radiance_that_the_sky_says() {
    let mut stage = Stage::new("assets");
    let pack = stage.pack();
    plane(&mut stage, 100.0);
    let (camera, image) = stage.camera(&pack, down());
    let world = stage.app.world_mut();
    let sun = world.spawn((DirectionalLight::default(), WelkinLight)).id();
    world.resource_mut::<GlobalAmbientLight>().brightness = 0.0;
    let mut sky = WelkinSky::default();
    sky.params.time = 0.42;
    sky.params.cover = 0.3;
    stage.set(sky);
    let scale = UNIT_CD_M2 * DAYLIGHT.exposure();
    let expected = light(&sky);
    let up = bevy_welkin::welkin_runtime::glam::Vec3::Y;

    let shown = stage.shoot(&image).about(0.5, 0.5);
    let direct = bevy_vec3(expected.sun.irradiance) * expected.sun.direction.y / PI * scale;
    assert!(
        (shown - direct).abs().max_element() < 0.03 * direct.max_element(),
        "the sun alone: {shown} {direct}"
    );

    stage
        .app
        .world_mut()
        .entity_mut(camera)
        .insert(WelkinEnvironment);
    stage
        .app
        .world_mut()
        .entity_mut(sun)
        .insert(Visibility::Hidden);
    let shown = stage.shoot(&image).about(0.5, 0.5);
    let ambient = bevy_vec3(expected.ambient_irradiance(up)) / PI * scale;
    assert!(
        (shown - ambient).abs().max_element() < 0.03 * ambient.max_element(),
        "the sky alone: {shown} {ambient}"
    );

    // The map of a sky that has changed takes the place of the last one.
    sky.params.time = 0.27;
    stage.set(sky);
    let shown = stage.shoot(&image).about(0.5, 0.5);
    let early = bevy_vec3(light(&sky).ambient_irradiance(up)) / PI * scale;
    assert!(early.max_element() < 0.7 * ambient.max_element(), "{early}");
    assert!(
        (shown - early).abs().max_element() < 0.03 * early.max_element(),
        "an early sky: {shown} {early}"
    );
}

#[test]
fn what_is_far_goes_over_into_the_horizon() {
    let mut stage = Stage::new("assets");
    let pack = stage.pack();
    plane(&mut stage, 4e5);
    const HEIGHT_M: f32 = 300.0;
    let (camera, image) = stage.camera(&pack, Transform::default());
    let lens = PerspectiveProjection {
        far: 2e5,
        ..default()
    };
    let mut seen = stage.app.world_mut().entity_mut(camera);
    seen.insert(Projection::from(lens));
    stage
        .app
        .world_mut()
        .spawn((DirectionalLight::default(), WelkinLight));
    let scale = UNIT_CD_M2 * DAYLIGHT.exposure();
    // At noon, and at dusk below the sun and away from it.
    for (time, ahead) in [(0.5, Vec3::NEG_Z), (0.735, Vec3::NEG_X), (0.735, Vec3::X)] {
        let mut sky = WelkinSky::default();
        sky.params.cover = 0.0;
        sky.params.time = time;
        stage.set(sky);
        let transform = Transform::from_xyz(0.0, HEIGHT_M, 0.0).looking_to(ahead, Vec3::Y);
        let shown = |stage: &mut Stage| stage.shoot(&image).about(0.5, 0.5 + 8.5 / 144.0);
        let mut seen = stage.app.world_mut().entity_mut(camera);
        seen.insert(transform).remove::<(WelkinAir, DistanceFog)>();
        let clear = shown(&mut stage);
        stage.app.world_mut().entity_mut(camera).insert(WelkinAir);
        let hazed = shown(&mut stage);
        // Nine rows: the middle one looks down by so many pixels of 45 / 144 degrees.
        let distance_m = HEIGHT_M / (8.5_f32 * 45.0 / 144.0).to_radians().tan();
        let [eye, place] = [Vec3::Y * HEIGHT_M, ahead * distance_m].map(|v| v.to_array().into());
        let radiance = (clear / scale).to_array().into();
        let expected = bevy_vec3(light(&sky).air.between(radiance, eye, place)) * scale;
        let difference = (clear - expected).abs().max_element();
        assert!(
            difference > 0.1 * clear.max_element(),
            "{time} {ahead}: {clear} {expected}"
        );
        let apart = (hazed - expected).abs().max_element();
        assert!(
            apart < 0.05 * expected.max_element(),
            "{time} {ahead}: {hazed} {expected}"
        );
    }
}

const EXTENT_M: f32 = 4000.0;

/// A white plane under broken clouds that throw shadows, seen from so high above that a picture is 2 km high.
fn shadowed(stage: &mut Stage) -> (WelkinSky, Transform, Entity, Handle<Image>) {
    let pack = stage.pack();
    plane(stage, 2.0 * EXTENT_M);
    let above = Transform::from_xyz(0.0, 2414.0, 0.0).looking_to(Vec3::NEG_Y, Vec3::NEG_Z);
    let (camera, image) = stage.camera(&pack, above);
    let lens = PerspectiveProjection {
        far: 1e4,
        ..default()
    };
    let world = stage.app.world_mut();
    world.entity_mut(camera).insert(Projection::from(lens));
    let sun = (DirectionalLight::default(), WelkinLight, WelkinShadows);
    let sun = world.spawn(sun).id();
    world.resource_mut::<GlobalAmbientLight>().brightness = 0.0;
    let mut sky = WelkinSky::default();
    sky.params.method = Method::Lit;
    sky.params.cover = 0.5;
    sky.params.time = 0.42;
    sky.params.shadow_extent_m = EXTENT_M;
    stage.set(sky);
    (sky, above, sun, image)
}

#[test]
#[ignore = "software drivers have no binding arrays, which Bevy's light textures want: wants a GPU"]
fn clouds_throw_shadows_on_materials() {
    let mut stage = Stage::new("assets");
    let (sky, above, _, image) = shadowed(&mut stage);
    let shown = stage.shoot(&image);
    // The shadows as the runtime has them for a viewer at this place.
    let map = crate::views::shadows(&stage, &sky, above.translation);
    let light = light(&sky);
    let scale = UNIT_CD_M2 * DAYLIGHT.exposure();
    let clear = light.sun.clear_irradiance * light.sun.direction.y / PI * scale;
    let clear = luminance(bevy_vec3(clear));
    let metres_a_pixel = 2000.0 / shown.size.y as f32;
    let (mut apart, mut spread, mut pixels) = (0.0, 0.0, 0);
    let mean = map.iter().sum::<f32>() / map.len() as f32;
    for y in (4..shown.size.y - 4).step_by(4) {
        for x in (60..shown.size.x - 60).step_by(4) {
            let pixel = Vec2::new(x as f32, y as f32) + 0.5 - shown.size.as_vec2() / 2.0;
            let texel = (pixel * metres_a_pixel / EXTENT_M + 0.5) * 256.0;
            let expected = map[texel.y as usize * 256 + texel.x as usize];
            apart += (luminance(shown.at(x, y)) / clear - expected).abs();
            spread += (expected - mean).abs();
            pixels += 1;
        }
    }
    let [apart, spread] = [apart, spread].map(|sum| sum / pixels as f32);
    assert!(spread > 0.1, "clouds and gaps: {spread}");
    assert!(apart < 0.05, "{apart} of {spread}");
}

#[test]
fn without_shadows_of_each_clouds_dim_the_light_by_their_mean() {
    let mut stage = Stage::new("assets");
    let (mut sky, _, sun, image) = shadowed(&mut stage);
    stage.update(3);
    let world = stage.app.world();
    let usable = clustered_decals_are_usable(world.resource(), world.resource());
    let lux = |stage: &Stage| {
        let light = stage.app.world().get::<DirectionalLight>(sun);
        light.expect("a light").illuminance
    };
    let expected = light(&sky).sun;
    let [mean, clear] = [expected.irradiance, expected.clear_irradiance]
        .map(|irradiance| luminance(bevy_vec3(irradiance)) * UNIT_CD_M2);
    assert!(mean < 0.9 * clear, "{mean} {clear}");
    let each = if usable { clear } else { mean };
    assert!(
        (lux(&stage) - each).abs() < 1e-3 * each,
        "{} {each}",
        lux(&stage)
    );
    // Asked for none.
    sky.params.method = Method::Packed;
    sky.params.shadow_extent_m = 0.0;
    stage.set(sky);
    stage.shoot(&image);
    let mean = luminance(bevy_vec3(light(&sky).sun.irradiance)) * UNIT_CD_M2;
    assert!(
        (lux(&stage) - mean).abs() < 1e-3 * mean,
        "{} {mean}",
        lux(&stage)
    );
}

#[test]
fn an_atmosphere_gets_the_light_above_it() {
    let mut stage = Stage::new("assets");
    let pack = stage.pack();
    let (camera, _) = stage.camera(&pack, down());
    let world = stage.app.world_mut();
    world
        .entity_mut(camera)
        .insert(AtmosphereSettings::default());
    let sun = world.spawn((DirectionalLight::default(), WelkinLight)).id();
    let mut sky = WelkinSky::default();
    sky.params.cover = 0.0;
    stage.set(sky);
    // Only its lights: the atmosphere itself is in pictures.rs.
    stage
        .app
        .world_mut()
        .entity_mut(camera)
        .remove::<Camera3d>();
    stage.update(2);
    let world = stage.app.world();
    assert!(
        world.get::<WelkinView>(camera).is_some() && world.get::<WelkinViewLight>(camera).is_some()
    );
    let lux = world
        .get::<DirectionalLight>(sun)
        .expect("a light")
        .illuminance;
    assert!((lux - RAW_SUNLIGHT).abs() < 0.02 * RAW_SUNLIGHT, "{lux}");
}

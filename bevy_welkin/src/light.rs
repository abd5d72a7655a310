//! The light of each view's sky, and the directional light that sun and moon are.

use bevy::light::light_consts::lux::RAW_SUNLIGHT;
use bevy::pbr::AtmosphereSettings;
use bevy::prelude::*;
use welkin_runtime::{Luminary, SkyLight};

use crate::WelkinSystems;
use crate::pack::WelkinPack;
use crate::settings::{GlobalWelkinSky, WelkinSky, WelkinView, bevy_vec3};

/// The light of the sky that a camera sees, on every camera with a [`WelkinView`] whose pack is loaded. Radiance and irradiance are in the sky's own
/// unit: times [`WelkinSky::unit_cd_m2`] they are cd/m2 and lux.
#[derive(Component, Clone, Copy, Debug)]
pub struct WelkinViewLight {
    /// That of this frame.
    pub light: SkyLight,
    /// The settings that it follows from.
    pub sky: WelkinSky,
    /// Whether Bevy's atmosphere draws the clear sky of this camera.
    pub(crate) over: bool,
}

/// A [`DirectionalLight`] that is the sun, or at night the moon: its rotation, colour and illuminance are written each frame. Shadows and all else are
/// as you set them. It has no parent that turns it.
///
/// It follows the sky of the first camera that sees one, by [`Camera::order`]. Clouds dim it by their mean, or one by one with `WelkinShadows`.
///
/// Where Bevy's atmosphere draws that camera's clear sky, the light is that of raw sunlight, as the atmosphere dims it itself; clouds dim it all the same.
#[derive(Component, Clone, Copy, Debug, Default, Reflect)]
#[reflect(Component, Clone, Debug, Default)]
#[require(DirectionalLight)]
pub struct WelkinLight;

/// The first camera that sees a sky.
pub(crate) fn first<'a, T>(views: impl Iterator<Item = (Entity, &'a Camera, T)>) -> Option<T> {
    let order = |(entity, camera, _): &(Entity, &Camera, T)| (camera.order, *entity);
    views.min_by_key(order).map(|(.., value)| value)
}

fn compute(
    mut commands: Commands,
    views: Query<(
        Entity,
        &WelkinView,
        Option<&WelkinSky>,
        Has<AtmosphereSettings>,
    )>,
    packs: Res<Assets<WelkinPack>>,
    shared: Res<GlobalWelkinSky>,
    time: Res<Time>,
) {
    for (entity, view, own, over) in &views {
        let sky = *own.unwrap_or(&shared);
        match packs.get(&view.0) {
            Some(pack) => commands.entity(entity).insert(WelkinViewLight {
                light: pack.light.light(&sky.params, sky.at(&time)),
                sky,
                over,
            }),
            None => commands.entity(entity).remove::<WelkinViewLight>(),
        };
    }
}

pub(crate) fn drive(
    mut lights: Query<(&mut DirectionalLight, &mut Transform, Has<EachCloud>), With<WelkinLight>>,
    views: Query<(Entity, &Camera, &WelkinViewLight)>,
) {
    let Some(view) = first(views.iter()) else {
        return;
    };
    for (mut light, mut transform, each_cloud) in &mut lights {
        let from = luminary(&view.light);
        let given = shine(view, from, each_cloud);
        light.color = given.colour;
        light.illuminance = given.illuminance_lux;
        // Its X axis is level: `WelkinShadows` turns the clouds' shadows by that.
        transform.rotation = Transform::IDENTITY
            .looking_to(-bevy_vec3(from.direction), Vec3::Y)
            .rotation;
    }
}

/// On a light that the shadow of each cloud is drawn for, so that their mean must not dim it.
#[derive(Component)]
pub(crate) struct EachCloud;

/// What a directional light is set to.
struct Shine {
    /// Its luminance is 1, so a channel may be more.
    colour: Color,
    illuminance_lux: f32,
}

/// Sun or moon: the one that lights the scene, at night without a moon the sun below the horizon.
pub(crate) fn luminary(light: &SkyLight) -> &Luminary {
    match light.moon.clear_irradiance.max_element() > 0.0 {
        true => &light.moon,
        false => &light.sun,
    }
}

fn shine(view: &WelkinViewLight, from: &Luminary, each_cloud: bool) -> Shine {
    let [clear, mean] = [from.clear_irradiance, from.irradiance].map(bevy_vec3);
    let irradiance = if each_cloud { clear } else { mean };
    let irradiance = match view.over && from == &view.light.sun {
        // The atmosphere takes its share between here and the ground.
        true => {
            let left = match each_cloud || luminance(clear) <= 0.0 {
                true => 1.0,
                false => luminance(mean) / luminance(clear),
            };
            Vec3::splat(RAW_SUNLIGHT * left / view.sky.unit())
        }
        false => irradiance,
    };
    let whole = luminance(irradiance);
    if whole <= 0.0 {
        return Shine {
            colour: Color::WHITE,
            illuminance_lux: 0.0,
        };
    }
    let [red, green, blue] = (irradiance / whole).to_array();
    Shine {
        colour: Color::linear_rgb(red, green, blue),
        illuminance_lux: whole * view.sky.unit(),
    }
}

/// Of linear BT.709.
pub(crate) fn luminance(colour: Vec3) -> f32 {
    colour.dot(Vec3::new(0.2126, 0.7152, 0.0722))
}

pub(crate) fn build(app: &mut App) {
    app.register_type::<WelkinLight>().add_systems(
        PostUpdate,
        (
            compute.in_set(WelkinSystems::Light),
            drive.in_set(WelkinSystems::Drive),
        ),
    );
}

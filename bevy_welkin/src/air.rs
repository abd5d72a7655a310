//! Aerial perspective of Bevy's materials, by its own distance fog.

use bevy::camera::Exposure;
use bevy::pbr::{DistanceFog, FogFalloff};
use bevy::prelude::*;

use crate::WelkinSystems;
use crate::light::{WelkinLight, WelkinViewLight, luminary};
use crate::settings::{bevy_vec3, sky_vec3};

/// On a camera with a [`WelkinView`](crate::WelkinView): its [`DistanceFog`] is written each frame, so that what is far goes over into the horizon.
///
/// The fog has one extinction along every way, the mean between the camera's height and the ground: hills that stand above the camera are hazier than the
/// sky's own air has them. Materials of your own have that with [`welkin_runtime::air::WGSL`].
#[derive(Component, Clone, Copy, Debug, Default, Reflect)]
#[reflect(Component, Clone, Debug, Default)]
#[require(DistanceFog)]
pub struct WelkinAir;

/// Of the way from the darkest horizon to that below the sun, which the fog has everywhere: the rest goes with the cosine to the sun. The air has
/// `((1 + cos) / 2)^2`, which this is within 0.15 of.
const EVERYWHERE: f32 = 0.1;
/// Of a way to the ground whose mean extinction the fog has, in metres.
const FAR_M: f32 = 1e4;
/// Cosine of the sun's elevation below which its azimuth tells nothing.
const LEAST_LEVEL: f32 = 0.3;

fn drive(
    mut views: Query<
        (
            &mut DistanceFog,
            &WelkinViewLight,
            &GlobalTransform,
            Option<&Exposure>,
        ),
        With<WelkinAir>,
    >,
    lights: Query<&DirectionalLight, With<WelkinLight>>,
) {
    for (mut fog, view, place, exposure) in &mut views {
        let exposure = exposure.copied().unwrap_or_default().exposure();
        let air = view.light.air;
        let [towards, away] = air.horizon.map(bevy_vec3);
        let scale = view.sky.unit() * exposure;
        let everywhere = (away + EVERYWHERE * (towards - away)) * scale;
        let [red, green, blue] = everywhere.to_array();
        fog.color = Color::linear_rgb(red, green, blue);

        // Bevy multiplies by the colour of each directional light, exposed.
        let sun = bevy_vec3(luminary(&view.light).direction);
        let level = sun.xz().length().max(LEAST_LEVEL);
        let glow = (1.0 - EVERYWHERE) * (towards - away).max(Vec3::ZERO) * scale / level;
        let light = lights.iter().next();
        let light = light.map_or(Vec3::ZERO, |light| {
            let colour = light.color.to_linear();
            Vec3::new(colour.red, colour.green, colour.blue) * light.illuminance * exposure
        });
        let [red, green, blue] =
            Vec3::select(light.cmpgt(Vec3::splat(1e-9)), glow / light, Vec3::ZERO).to_array();
        fog.directional_light_color = Color::linear_rgb(red, green, blue);
        fog.directional_light_exponent = 1.0;

        let metres = view.sky.metres_per_unit;
        let eye = sky_vec3(Vec3::Y * place.translation().y.max(0.0) * metres);
        let far = sky_vec3(Vec3::X * FAR_M);
        let left = bevy_vec3(air.transmittance(eye, far));
        let extinction = -left.ln() / eye.distance(far) * metres;
        fog.falloff = FogFalloff::Atmospheric {
            extinction,
            inscattering: extinction,
        };
    }
}

pub(crate) fn build(app: &mut App) {
    app.register_type::<WelkinAir>()
        .add_systems(PostUpdate, drive.in_set(WelkinSystems::Drive));
}

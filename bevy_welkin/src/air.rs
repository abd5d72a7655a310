//! Aerial perspective of Bevy's materials, by its own distance fog.

use bevy::camera::Exposure;
use bevy::pbr::{DistanceFog, FogFalloff};
use bevy::prelude::*;

use crate::WelkinSystems;
use crate::light::WelkinViewLight;
use crate::settings::{bevy_vec3, sky_vec3};

/// On a camera with a [`WelkinView`](crate::WelkinView): its [`DistanceFog`] is written each frame, so that what is far goes over into the horizon.
///
/// The fog has one colour, that of the horizon in the direction in which the camera looks, where the horizon itself is brighter towards the sun; and one
/// extinction, the mean between the camera's height and the ground, so that hills above the camera are hazier than the sky's own air has them. Shaders
/// of your own have neither limit with [`welkin_runtime::air::WGSL`].
#[derive(Component, Clone, Copy, Debug, Default, Reflect)]
#[reflect(Component, Clone, Debug, Default)]
#[require(DistanceFog)]
pub struct WelkinAir;

/// Of a way to the ground whose mean extinction the fog has, in metres.
const FAR_M: f32 = 1e4;
/// Of one on which nothing is left but the horizon.
const FARTHEST_M: f32 = 1e7;

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
) {
    for (mut fog, view, place, exposure) in &mut views {
        let exposure = exposure.copied().unwrap_or_default().exposure();
        let air = view.light.air;
        let ahead = place.forward().with_y(0.0).normalize_or(Vec3::NEG_Z);
        let black = sky_vec3(Vec3::ZERO);
        let horizon = bevy_vec3(air.between(black, black, sky_vec3(ahead * FARTHEST_M)));
        let [red, green, blue] = (horizon * view.sky.unit() * exposure).to_array();
        fog.color = Color::linear_rgb(red, green, blue);
        // Bevy's glow about the sun has the shadows of what stands before the camera, at grazing angles in stripes.
        fog.directional_light_color = Color::NONE;

        let metres = view.sky.metres_per_unit;
        let eye = sky_vec3(Vec3::Y * place.translation().y.max(0.0) * metres);
        let ground = sky_vec3(Vec3::X * FAR_M);
        let left = bevy_vec3(air.transmittance(eye, ground));
        let extinction = -left.ln() / eye.distance(ground) * metres;
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

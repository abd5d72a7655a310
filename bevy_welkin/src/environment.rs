//! The light of sky, clouds and ground from all sides, as an environment map.

use bevy::asset::RenderAssetUsages;
use bevy::light::EnvironmentMapLight;
use bevy::prelude::*;
use bevy::render::render_resource::{
    Extent3d, TextureDimension, TextureFormat, TextureViewDescriptor, TextureViewDimension,
};
use half::f16;
use welkin_runtime::SkyLight;

use crate::WelkinSystems;
use crate::light::WelkinViewLight;
use crate::settings::sky_vec3;

/// On a camera with a [`WelkinView`](crate::WelkinView): its [`EnvironmentMapLight`] is written as the sky's light changes. Diffuse light is that of
/// [`SkyLight::ambient_irradiance`]; reflections show the same, blurred sky.
///
/// It stands beside Bevy's [`GlobalAmbientLight`], which is some thousandth of it by day.
#[derive(Component, Clone, Copy, Debug, Default, Reflect)]
#[reflect(Component, Clone, Debug, Default)]
pub struct WelkinEnvironment;

/// What the map of a camera was made of.
#[derive(Component)]
struct Shown([Vec3; NORMALS.len()]);

/// Texels a side of each face: nine spherical harmonics have no finer detail.
const SIDE: u32 = 8;
/// The map is made anew when the light of one of these sides has changed by that share: less is not seen, and each upload has Bevy make bind groups.
const CHANGE: f32 = 0.005;
const NORMALS: [Vec3; 6] = [
    Vec3::X,
    Vec3::NEG_X,
    Vec3::Y,
    Vec3::NEG_Y,
    Vec3::Z,
    Vec3::NEG_Z,
];

/// Radiance that a white surface of this normal has by the ambient light alone.
fn lit(light: &SkyLight, normal: Vec3) -> Vec3 {
    let irradiance = light.ambient_irradiance(sky_vec3(normal));
    Vec3::from(irradiance.to_array()) / std::f32::consts::PI
}

fn drive(
    mut commands: Commands,
    mut views: Query<
        (
            Entity,
            &WelkinViewLight,
            Option<&mut EnvironmentMapLight>,
            Option<&Shown>,
        ),
        With<WelkinEnvironment>,
    >,
    mut images: ResMut<Assets<Image>>,
) {
    for (entity, view, map, shown) in &mut views {
        let sides = NORMALS.map(|normal| lit(&view.light, normal));
        let intensity = view.sky.unit();
        let same = shown.is_some_and(|Shown(last)| {
            let largest = last
                .iter()
                .fold(0.0, |most: f32, side| most.max(side.max_element()));
            let pairs = last.iter().zip(&sides);
            pairs
                .map(|(last, now)| (*now - *last).abs().max_element())
                .all(|change| change <= CHANGE * largest)
        });
        match map {
            Some(mut map) if same => {
                if map.intensity != intensity {
                    map.intensity = intensity;
                }
            }
            _ => {
                let image = images.add(cube(&view.light));
                let light = EnvironmentMapLight {
                    diffuse_map: image.clone(),
                    specular_map: image,
                    intensity,
                    ..default()
                };
                commands.entity(entity).insert((light, Shown(sides)));
            }
        }
    }
}

/// The cube map that Bevy's materials read.
fn cube(light: &SkyLight) -> Image {
    let mut texels = Vec::with_capacity(6 * (SIDE * SIDE) as usize * 8);
    for face in 0..6 {
        for row in 0..SIDE {
            for column in 0..SIDE {
                let radiance = lit(light, direction(face, column, row));
                for channel in radiance.extend(1.0).to_array() {
                    texels.extend(f16::from_f32(channel).to_le_bytes());
                }
            }
        }
    }
    let size = Extent3d {
        width: SIDE,
        height: SIDE,
        depth_or_array_layers: 6,
    };
    let format = TextureFormat::Rgba16Float;
    let usage = RenderAssetUsages::RENDER_WORLD;
    let mut image = Image::new(size, TextureDimension::D2, texels, format, usage);
    image.texture_view_descriptor = Some(TextureViewDescriptor {
        dimension: Some(TextureViewDimension::Cube),
        ..default()
    });
    image
}

/// Where the middle of a texel looks in the world. Faces of a cube map are left-handed, so Bevy looks them up with Z turned round.
fn direction(face: usize, column: u32, row: u32) -> Vec3 {
    let place = |index: u32| (index as f32 + 0.5) / SIDE as f32 * 2.0 - 1.0;
    let (u, v) = (place(column), place(row));
    let cube = match face {
        0 => Vec3::new(1.0, -v, -u),
        1 => Vec3::new(-1.0, -v, u),
        2 => Vec3::new(u, 1.0, v),
        3 => Vec3::new(u, -1.0, -v),
        4 => Vec3::new(u, -v, 1.0),
        _ => Vec3::new(-u, -v, -1.0),
    };
    Vec3::new(cube.x, cube.y, -cube.z).normalize()
}

pub(crate) fn build(app: &mut App) {
    app.register_type::<WelkinEnvironment>()
        .add_systems(PostUpdate, drive.in_set(WelkinSystems::Drive));
}

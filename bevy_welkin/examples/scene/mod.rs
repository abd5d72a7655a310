//! What the example and the tests look at: hills with a few stones, and a small pack that is baked in a second.

use std::ops::ControlFlow;

use bevy::asset::RenderAssetUsages;
use bevy::mesh::{Indices, PrimitiveTopology};
use bevy::prelude::*;
use bevy_welkin::welkin_pack::Pack;

/// Half of a side of the ground, in metres.
const REACH_M: f32 = 16_000.0;
/// Squares on a side.
const CELLS: u32 = 256;

/// The default pack. A program that ships loads one from its assets instead: `assets.load("sky/pack.json")`.
pub fn pack() -> Result<Pack, Box<dyn std::error::Error>> {
    let recipe = welkin_baker::Recipe::default().resolve(None)?;
    Ok(welkin_baker::bake(&recipe, None, &|_| {
        ControlFlow::Continue(())
    })?)
}

/// Height of the ground in metres, at metres to the east and to the south: level where the camera starts, hills some kilometres away.
pub fn height_m(place: Vec2) -> f32 {
    let distance = place.length();
    let wave = |length_m: f32, turn: f32| {
        let place = Vec2::from_angle(turn).rotate(place) / length_m;
        place.x.sin() * place.y.cos()
    };
    let low = 6.0 * wave(170.0, 0.4) + 14.0 * wave(410.0, 1.9);
    let high = 210.0 * wave(1900.0, 0.8) + 90.0 * wave(830.0, 2.6) + 160.0;
    low * (distance / 600.0).min(1.0) + high * ((distance - 1500.0) / 5000.0).clamp(0.0, 1.5)
}

/// Spawns it.
pub fn spawn(
    mut commands: Commands,
    mut meshes: ResMut<Assets<Mesh>>,
    mut materials: ResMut<Assets<StandardMaterial>>,
) {
    let rough = |colour: Color| StandardMaterial {
        base_color: colour,
        perceptual_roughness: 1.0,
        reflectance: 0.2,
        ..default()
    };
    let grass = rough(Color::linear_rgb(0.102, 0.103, 0.05));
    let stone = materials.add(rough(Color::linear_rgb(0.5, 0.5, 0.48)));
    commands.spawn((
        Mesh3d(meshes.add(ground())),
        MeshMaterial3d(materials.add(grass)),
    ));
    let block = meshes.add(Cuboid::new(6.0, 18.0, 6.0));
    let ball = meshes.add(Sphere::new(7.0));
    for (number, turn) in (0..9).zip((0..).map(|n| n as f32 * 0.7)) {
        let place = Vec2::from_angle(turn) * (70.0 + 9.0 * number as f32);
        let at = Vec3::new(place.x, height_m(place) + 6.0, place.y);
        let mesh = if number % 2 == 0 { &block } else { &ball };
        commands.spawn((
            Mesh3d(mesh.clone()),
            MeshMaterial3d(stone.clone()),
            Transform::from_translation(at),
        ));
    }
}

/// Squares grow towards the rim.
fn ground() -> Mesh {
    let place = |index: u32| {
        let along = index as f32 / CELLS as f32 * 2.0 - 1.0;
        along * along.abs().sqrt() * REACH_M
    };
    let side = CELLS + 1;
    let mut positions = Vec::with_capacity((side * side) as usize);
    for row in 0..side {
        for column in 0..side {
            let at = Vec2::new(place(column), place(row));
            positions.push([at.x, height_m(at), at.y]);
        }
    }
    let mut indices = Vec::with_capacity((6 * CELLS * CELLS) as usize);
    for row in 0..CELLS {
        for column in 0..CELLS {
            let [a, b] = [row * side + column, (row + 1) * side + column];
            indices.extend([a, b, a + 1, a + 1, b, b + 1]);
        }
    }
    Mesh::new(
        PrimitiveTopology::TriangleList,
        RenderAssetUsages::RENDER_WORLD,
    )
    .with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, positions)
    .with_inserted_indices(Indices::U32(indices))
    .with_computed_smooth_normals()
}

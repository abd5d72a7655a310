//! Clouds of sprites: twins, depth, the ring of impostors, flight, formation.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod depth;
mod field;
mod flight;
mod formation;
mod ring;
mod scene;
mod twins;

use glam::{DVec3, Vec3};
use welkin_runtime::params::SpriteParams;
use welkin_runtime::{Camera, Method, SkyParams};

/// A fair day of sprites alone: no dither, flare, wind, sun or stars.
fn params() -> SkyParams {
    SkyParams {
        method: Method::Sprites,
        cover: 1.0,
        speed: 0.0,
        time: 0.4,
        flare: 0.0,
        dither: false,
        sprites: without_ring(),
        ..SkyParams::default()
    }
}

fn without_ring() -> SpriteParams {
    SpriteParams {
        ring_radius_m: 0.0,
        ..SpriteParams::default()
    }
}

fn view(place_m: DVec3, azimuth_deg: f32, elevation_deg: f32, size: [u32; 2]) -> Camera {
    Camera {
        position_m: place_m.as_vec3(),
        ..Camera::looking(
            azimuth_deg.to_radians(),
            elevation_deg.to_radians(),
            1.05,
            size,
        )
    }
}

/// Mean of the absolute differences of all channels.
fn mean_difference(a: &[Vec3], b: &[Vec3]) -> f32 {
    let sums = a.iter().zip(b).map(|(a, b)| (*a - *b).abs().element_sum());
    sums.sum::<f32>() / (3.0 * a.len() as f32)
}

//! The air between a viewer and a scene, for the application's own shaders: aerial perspective.
//!
//! # Theory
//! H. Koschmieder, "Theorie der horizontalen Sichtweite", 1924: air takes `1 - T` of the light of a place and adds as much of the horizon's own,
//! so what is far goes over into the horizon behind it. `T` is that of two layers that thin out exponentially, molecules and aerosol, the same
//! that the ground below the horizon is seen through ([`crate::clear_sky::ground`]).
//!
//! # Changes
//! The horizon's radiance is told by two colours, below the sun and opposite, and between them goes with the square of `(1 + cos) / 2`. Light that
//! the air adds has the horizon's colour at every height.
//!
//! # Practice
//! [`WGSL`] is a struct of 64 bytes and four functions; [`Air::uniform`] is its bytes. Two exponentials a layer, no texture.
//!
//! ```no_run
//! # fn f(queue: &wgpu::Queue, sky: &welkin_runtime::Sky, uniforms: &wgpu::Buffer) {
//! use welkin_runtime::{SkyParams, air};
//! // Once: the functions join the shader of the scene, which ends with
//! // air_between(air, radiance, camera.position, position)
//! let scene = format!("{}\n{}", air::WGSL, "/* the application's shader */");
//! # drop(scene);
//! // Each frame:
//! let light = sky.light(&SkyParams::default(), 12.5);
//! queue.write_buffer(uniforms, 0, bytemuck::bytes_of(&light.air.uniform()));
//! # }
//! ```

use glam::{Vec2, Vec3, Vec3Swizzles};
use welkin_pack::air::{AEROSOL_SCALE_KM, MOLECULE_SCALE_KM};

/// WGSL of `air_between(air, radiance, viewer, to)` and what it is made of, for the application's shaders.
pub const WGSL: &str = include_str!("air_between.wgsl");

/// The air of a moment. Radiance is linear BT.709.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Air {
    /// Radiance of the horizon below sun or moon, and opposite.
    pub horizon: [Vec3; 2],
    /// Unit vector to the azimuth of sun or moon (east, south).
    pub sun_azimuth: Vec2,
    /// Extinction by molecules at height 0, 1 / m.
    pub molecules_per_m: Vec3,
    /// That by the aerosol.
    pub aerosol_per_m: Vec3,
}

/// Over which the layers fall to 1 / e, in metres.
const HEIGHTS_M: [f32; 2] = [MOLECULE_SCALE_KM * 1e3, AEROSOL_SCALE_KM * 1e3];

impl Air {
    /// The struct `Air` of [`WGSL`].
    pub fn uniform(&self) -> [f32; 16] {
        let rows = [
            (self.horizon[0], self.sun_azimuth.x),
            (self.horizon[1], self.sun_azimuth.y),
            (self.molecules_per_m, HEIGHTS_M[0]),
            (self.aerosol_per_m, HEIGHTS_M[1]),
        ];
        let mut uniform = [0.0; 16];
        for (row, (colour, number)) in uniform.chunks_exact_mut(4).zip(rows) {
            row.copy_from_slice(&colour.extend(number).to_array());
        }
        uniform
    }

    /// The share of light that comes from one place to another, in metres to the east, up and to the south.
    pub fn transmittance(&self, from: Vec3, to: Vec3) -> Vec3 {
        let distance_m = from.distance(to);
        let [molecules, aerosol] =
            HEIGHTS_M.map(|scale_m| metres(scale_m, from.y, to.y, distance_m));
        (-(self.molecules_per_m * molecules + self.aerosol_per_m * aerosol)).exp()
    }

    /// What a viewer at one place sees of a radiance at another.
    pub fn between(&self, radiance: Vec3, from: Vec3, to: Vec3) -> Vec3 {
        let way = (to - from).xz().normalize_or_zero();
        let facing = 0.5 + 0.5 * way.dot(self.sun_azimuth);
        let [towards, away] = self.horizon;
        let horizon = away.lerp(towards, facing * facing);
        horizon + (radiance - horizon) * self.transmittance(from, to)
    }
}

/// `air_metres` of [`WGSL`].
fn metres(scale_m: f32, from_m: f32, to_m: f32, distance_m: f32) -> f32 {
    let low = from_m.min(to_m) / scale_m;
    let rise = (to_m - from_m).abs() / scale_m;
    let mean = if rise < 1e-3 {
        1.0 - 0.5 * rise
    } else {
        -(-rise).exp_m1() / rise
    };
    distance_m * (-low).exp() * mean
}

#[cfg(test)]
mod tests {
    use super::*;

    fn air() -> Air {
        Air {
            horizon: [Vec3::new(1.0, 0.8, 0.6), Vec3::new(0.3, 0.35, 0.4)],
            sun_azimuth: Vec2::new(0.6, 0.8),
            molecules_per_m: Vec3::new(6e-6, 1.36e-5, 3e-5),
            aerosol_per_m: Vec3::splat(4e-5),
        }
    }

    #[test]
    fn ways_add_up() {
        let air = air();
        let [a, b] = [
            Vec3::new(0.0, 50.0, 0.0),
            Vec3::new(8000.0, 2500.0, -4000.0),
        ];
        let middle = a.lerp(b, 0.3);
        let whole = air.transmittance(a, b);
        let parts = air.transmittance(a, middle) * air.transmittance(middle, b);
        assert!(
            (whole - parts).abs().max_element() < 1e-5,
            "{whole} {parts}"
        );
        assert_eq!(whole, air.transmittance(b, a));
        assert_eq!(air.transmittance(a, a), Vec3::ONE);
    }

    #[test]
    fn level_ways_are_those_of_even_air_and_far_places_are_the_horizon() {
        let air = air();
        let level = air.transmittance(Vec3::ZERO, Vec3::new(1e4, 0.0, 0.0));
        let even = (-(air.molecules_per_m + air.aerosol_per_m) * 1e4).exp();
        assert!((level - even).abs().max_element() < 1e-6);
        let sun = Vec3::new(0.6, 0.0, 0.8) * 1e7;
        for (way, horizon) in [(sun, air.horizon[0]), (-sun, air.horizon[1])] {
            let seen = air.between(Vec3::ONE, Vec3::ZERO, way);
            assert!((seen - horizon).abs().max_element() < 1e-4, "{seen}");
        }
        assert_eq!(air.between(Vec3::ONE, Vec3::Y, Vec3::Y), Vec3::ONE);
    }
}

//! The moon of a date: a disc with the phase and the tilt that it has.
//!
//! # Theory
//! Sun, moon and viewer give the phase: a place of the disc is lit by the cosine of its normal to the sun. The moon's dust scatters as H. Seeliger has it,
//! "Zur Theorie der Beleuchtung der grossen Planeten", 1887, with E. Lommel: radiance is in proportion to `mu0 / (mu0 + mu)` of the cosines towards sun and viewer, so that
//! the full moon is flat and not a ball. The mean of that over the disc is `1 - sin(a/2) tan(a/2) ln cot(a/4)` at a phase of a. The disc is made as bright as its light
//! ([`crate::almanac::moon::Moon::light`]) over that mean, so that disc and moonlight belong together.
//!
//! Where the sun does not shine, the earth does, the less the fuller the moon is: see `EARTHLIGHT` in `light.rs`.
//!
//! The moon is before the sun and the stars: what its disc covers does not shine. So an eclipse of the sun comes of itself; what it leaves of daylight is in `eclipse.rs`.
//!
//! # Practice
//! A comparison a pixel. A sky by the plain time has the full moon that `sun.rs` draws.

use glam::Vec3;

use crate::clear_sky::light::{MoonLight, SUN_RADIUS_RAD};
use crate::clear_sky::sun::facing_axes;
use crate::geometry::camera::Rays;
use crate::geometry::part::Part;
use crate::geometry::uniforms::uniforms;

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[],
    structs: &[MoonUniforms::WGSL],
    wgsl: include_str!("moon.wgsl"),
};

uniforms! {
    /// The moon's disc.
    MoonUniforms {
        /// Unit direction towards it.
        direction: Vec3,
        /// Cosine of the angle from it from which on there is nothing of it; 2 without a moon.
        least_cosine: f32,
        /// The screen's right about it, over the disc's radius.
        right: Vec3,
        /// How far its edge reaches to each side, in radii.
        edge: f32,
        /// The same as right, upwards.
        up: Vec3,
        /// Nothing.
        _pad: f32,
        /// Unit direction to the sun from the moon: right, up, towards the viewer.
        sunwards: Vec3,
        /// Nothing.
        _pad2: f32,
        /// Radiance where sun and viewer see it alike.
        lit: Vec3,
        /// Nothing.
        _pad3: f32,
        /// Radiance by the earth's light.
        earthlit: Vec3,
        /// Nothing.
        _pad4: f32,
    }
}

/// The least radius of the disc as it is drawn, in pixels: the sun's.
const LEAST_RADIUS_PX: f32 = 1.0;

/// Mean over the disc of Seeliger's law, over that of the full moon.
pub fn mean_of_phase(phase_rad: f32) -> f32 {
    if phase_rad < 1e-3 {
        return 1.0;
    }
    let (half, quarter) = (0.5 * phase_rad, 0.25 * phase_rad);
    (1.0 - half.sin() * half.tan() * (1.0 / quarter.tan()).ln()).clamp(1e-4, 1.0)
}

/// The moon's share of the uniforms, none of it without a `moon`; `pixel_rad` is the side of a pixel.
pub fn uniforms(moon: Option<&MoonLight>, rays: &Rays, pixel_rad: f32) -> MoonUniforms {
    let none = MoonUniforms {
        least_cosine: 2.0,
        ..Default::default()
    };
    let Some(moon) = moon.filter(|moon| moon.direction.y > -2.0 * SUN_RADIUS_RAD) else {
        return none;
    };
    let radius = moon.radius_rad.max(LEAST_RADIUS_PX * pixel_rad);
    let edge = (0.5 * pixel_rad / radius).min(0.5);
    let (right, up) = facing_axes(moon.direction, rays);
    // Irradiance over pi is radiance times the square of the radius.
    let full = moon.full / (radius * radius);
    let lit_share = 0.5 + 0.5 * moon.phase_rad.cos();
    MoonUniforms {
        direction: moon.direction,
        least_cosine: (radius * (1.0 + edge)).cos(),
        right: right / radius,
        edge,
        up: up / radius,
        sunwards: Vec3::new(
            moon.sunwards.dot(right),
            moon.sunwards.dot(up),
            -moon.sunwards.dot(moon.direction),
        ),
        lit: full * (moon.light / mean_of_phase(moon.phase_rad)),
        earthlit: moon.earthlit * ((1.0 - lit_share) * (moon.radius_rad / radius).powi(2)),
        ..Default::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::camera::Camera;

    fn moon(phase_rad: f32) -> MoonLight {
        let direction = Vec3::new(0.6, 0.5, -0.6).normalize();
        let aside = direction.cross(Vec3::Y).normalize();
        MoonLight {
            direction,
            // The viewer is on the other side of the direction.
            sunwards: -direction * phase_rad.cos() + aside * phase_rad.sin(),
            radius_rad: 0.0046,
            phase_rad,
            light: 0.3,
            full: Vec3::splat(0.05),
            earthlit: Vec3::splat(0.03),
        }
    }

    /// The mean over the disc of what the shader draws without an edge, by a grid.
    fn mean(uniforms: &MoonUniforms) -> f32 {
        const SIDE: i32 = 400;
        let (mut sum, mut count) = (0.0, 0);
        for i in 0..SIDE * SIDE {
            let [x, y] = [i % SIDE, i / SIDE].map(|k| (2 * k + 1) as f32 / SIDE as f32 - 1.0);
            let square = x * x + y * y;
            if square < 1.0 {
                let towards = (1.0 - square).sqrt();
                let lit = uniforms.sunwards.dot(Vec3::new(x, y, towards)).max(0.0);
                sum += 2.0 * lit / (lit + towards);
                count += 1;
            }
        }
        sum / count as f32
    }

    #[test]
    fn the_disc_gives_the_moon_s_light_at_every_phase() {
        let rays = Camera::looking(0.4, 0.2, 1.0, [64, 48]).rays();
        for step in 0..17 {
            let moon = moon(step as f32 * 0.18);
            let found = uniforms(Some(&moon), &rays, 1e-5);
            let light = found.lit.y * mean(&found) * moon.radius_rad * moon.radius_rad;
            let wanted = moon.full.y * moon.light;
            // A grid of 400 places a side, of which a thin crescent has few.
            let most = if step < 15 { 0.01 } else { 0.05 };
            assert!(
                (light / wanted - 1.0).abs() < most,
                "{step}: {light} {wanted}"
            );
        }
    }

    #[test]
    fn the_lit_side_looks_at_the_sun_and_earthshine_is_on_the_new_moon() {
        let rays = Camera::looking(0.4, 0.2, 1.0, [64, 48]).rays();
        let [full, half, new] = [0.0, 1.57, 3.1].map(|p| uniforms(Some(&moon(p)), &rays, 1e-5));
        assert!(full.sunwards.z > 0.999 && new.sunwards.z < -0.99);
        let towards = half.right * half.sunwards.x + half.up * half.sunwards.y;
        assert!(towards.normalize().dot(moon(1.57).sunwards) > 0.99);
        assert!(full.earthlit.y < 1e-6 && new.earthlit.y > half.earthlit.y);
        assert!(half.earthlit.y < half.lit.y);
    }

    #[test]
    fn where_there_is_none_or_it_is_down_nothing_is_drawn() {
        let rays = Camera::looking(0.4, 0.2, 1.0, [64, 48]).rays();
        let down = MoonLight {
            direction: Vec3::new(0.8, -0.6, 0.0),
            ..moon(1.0)
        };
        for moon in [None, Some(&down)] {
            assert_eq!(uniforms(moon, &rays, 1e-3).least_cosine, 2.0);
        }
    }

    #[test]
    fn a_wide_pixel_has_a_larger_and_dimmer_disc() {
        let rays = Camera::looking(0.4, 0.2, 1.0, [64, 48]).rays();
        let [fine, coarse] = [1e-4, 2e-2].map(|px| uniforms(Some(&moon(1.0)), &rays, px));
        let light = |u: &MoonUniforms| u.lit / u.right.length_squared();
        assert!((light(&fine) / light(&coarse) - 1.0).abs().max_element() < 1e-4);
    }
}

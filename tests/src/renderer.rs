//! Twin of renderer.wgsl: whole pictures on the CPU.

use glam::{Vec2, Vec3};
use welkin_pack::{Pack, Role};
use welkin_runtime::frame::Facts;
use welkin_runtime::galaxy::EXTINCTION;
use welkin_runtime::uniforms::Uniforms;
use welkin_runtime::{Camera, SkyParams};

use crate::texture::{Texture, smoothstep};
use crate::{camera, clouds, galaxy, sky, stars, sun, xyz};

/// A pack made ready for the twin.
pub struct Twin<'a> {
    pack: &'a Pack,
    facts: Facts,
    clouds: Texture,
    galaxy: Texture,
    sky: Texture,
    sun: Texture,
}

impl<'a> Twin<'a> {
    /// Reads every texture of a pack.
    ///
    /// # Panics
    /// If the pack lacks one.
    pub fn new(pack: &'a Pack) -> Twin<'a> {
        let texture = |role| Texture::new(pack, role);
        Twin {
            pack,
            facts: Facts::new(pack).expect("the pack has every role"),
            clouds: texture(Role::Clouds),
            galaxy: texture(Role::Galaxy),
            sky: texture(Role::Sky),
            sun: texture(Role::Sun),
        }
    }

    /// Radiance of every pixel, row by row from the top.
    pub fn render(&self, params: &SkyParams, view: &Camera, seconds: f64) -> Vec<Vec3> {
        let uniforms = self.facts.uniforms(params, view, seconds, 0.0);
        let [width, height] = view.viewport_px;
        let centres = (0..height)
            .flat_map(|y| (0..width).map(move |x| Vec2::new(x as f32 + 0.5, y as f32 + 0.5)));
        centres
            .map(|pixel| self.pixel(&uniforms, pixel, seconds))
            .collect()
    }

    /// Radiance of one pixel.
    pub fn pixel(&self, uniforms: &Uniforms, pixel: Vec2, seconds: f64) -> Vec3 {
        let ray = camera::ray_of(&uniforms.camera, pixel);
        let direction = ray / ray.length();
        let mut radiance = sky::radiance(uniforms, &self.sky, direction);
        if uniforms.sky.gradient[3] > 0.0 && direction.y > 0.0 {
            let galaxy =
                galaxy::brightness(&uniforms.galaxy, &self.galaxy, &self.clouds, direction);
            let stars = stars::radiance(uniforms, self.pack, direction, pixel, seconds, galaxy);
            radiance += (xyz(uniforms.galaxy.light) * galaxy + stars)
                * smoothstep(0.0, EXTINCTION, direction.y);
        }
        radiance += sun::radiance(uniforms, &self.sun, direction);
        if direction.y > 0.0 {
            let (cloud, alpha) = clouds::layer(
                &uniforms.clouds,
                &self.clouds,
                direction,
                1.0 / ray.length(),
            );
            radiance = radiance.lerp(cloud, alpha);
        }
        radiance
    }
}

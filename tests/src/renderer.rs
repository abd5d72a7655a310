//! Twin of renderer.wgsl: whole pictures on the CPU.

use glam::{Vec2, Vec3};
use welkin_pack::{Image, Pack, Role};
use welkin_runtime::frame::Facts;
use welkin_runtime::galaxy::EXTINCTION;
use welkin_runtime::uniforms::Uniforms;
use welkin_runtime::{Camera, Method, SkyParams};

use crate::clouds::{Inputs, MOST_READS};
use crate::skybox::{self, Skybox};
use crate::texture::{Texture, smoothstep};
use crate::{
    camera, clouds, fbm_map, fbm_pack, flares, galaxy, map, octaves_map, sky, stars, sun, xyz,
};

/// A texture unit may filter 8-bit texels in 8 bits (Mesa's software does; Vulkan asks for no more), which makes a
/// read wrong by up to one step, 1/255.
pub const FILTER_STEP: [f32; MOST_READS] = [1.0 / 255.0; MOST_READS];

/// A pack made ready for the twin.
pub struct Twin<'a> {
    pack: &'a Pack,
    facts: Facts,
    clouds: Texture,
    galaxy: Texture,
    sky: Texture,
    sun: Texture,
    flares: Texture,
    skybox: Option<Skybox>,
}

/// A frame of a twin: everything that its pixels are computed from.
pub struct Frame<'a> {
    twin: &'a Twin<'a>,
    method: Method,
    /// The frame's constants.
    pub uniforms: Uniforms,
    /// The map of the method, if it has one.
    pub map: Option<Texture>,
    /// See [`Inputs::nudges`].
    pub nudges: [f32; MOST_READS],
    /// The states of the octaves, if the method has them.
    states: Vec<f32>,
    seconds: f64,
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
            flares: texture(Role::Flares),
            skybox: Skybox::new(pack),
        }
    }

    /// A frame whose map is yet to be given, if its method has one.
    pub fn frame_without_map(&self, params: &SkyParams, view: &Camera, seconds: f64) -> Frame<'_> {
        Frame {
            twin: self,
            method: params.method,
            uniforms: self.facts.uniforms(params, view, seconds, 0.0),
            map: None,
            nudges: [0.0; MOST_READS],
            states: match params.method {
                Method::Octaves => self.facts.octave_states(params, seconds),
                Method::Packed | Method::Fbm => Vec::new(),
            },
            seconds,
        }
    }

    /// A frame with its map.
    pub fn frame(&self, params: &SkyParams, view: &Camera, seconds: f64) -> Frame<'_> {
        let mut frame = self.frame_without_map(params, view, seconds);
        frame.map = frame.top_of_map().map(map::with_levels);
        frame
    }

    /// Radiance of every pixel of a frame, row by row from the top, without the flare.
    pub fn render(&self, params: &SkyParams, view: &Camera, seconds: f64) -> Vec<Vec3> {
        self.frame(params, view, seconds).render()
    }
}

impl Frame<'_> {
    /// Level 0 of the map, not rounded.
    pub fn top_of_map(&self) -> Option<Image> {
        let (octaves, fbm) = (&self.uniforms.octaves, &self.uniforms.fbm);
        match self.method {
            Method::Packed => None,
            Method::Octaves => Some(octaves_map::render(octaves, &self.states)),
            Method::Fbm => Some(fbm_map::render(fbm, &self.packed_octaves())),
        }
    }

    fn packed_octaves(&self) -> Vec<Texture> {
        let [x, y, ..] = self.uniforms.fbm.step;
        fbm_pack::packed(self.twin.pack, [x, y])
    }

    /// What a texel of level 0 of the map may be off by in each channel: at most, and on average, in bytes.
    pub fn map_allowance(&self) -> ([f32; 4], [f32; 4]) {
        match self.method {
            Method::Packed => ([0.0; 4], [0.0; 4]),
            Method::Octaves => octaves_map::allowance(&self.uniforms.octaves, &self.states),
            Method::Fbm => fbm_map::allowance(&self.uniforms.fbm, &self.packed_octaves()),
        }
    }

    /// Numbers about the map's channels, put into the order of the layer's reads.
    pub fn in_order_of_reads(&self, [r, g, b, a]: [f32; 4]) -> [f32; MOST_READS] {
        match self.method {
            Method::Packed => [0.0; MOST_READS],
            Method::Octaves => [g, a, r, b, r],
            Method::Fbm => [r, a, g, 0.0, 0.0],
        }
    }

    /// Radiance of every pixel, row by row from the top, without the flare.
    pub fn render(&self) -> Vec<Vec3> {
        self.pixels(|pixel| self.pixel(pixel))
    }

    /// Opacity of the clouds at every pixel, three times.
    pub fn opacity(&self) -> Vec<Vec3> {
        self.pixels(|pixel| {
            let ray = camera::ray_of(&self.uniforms.camera, pixel);
            let direction = ray / ray.length();
            if direction.y <= 0.0 {
                return Vec3::ZERO;
            }
            Vec3::splat(self.clouds(direction, ray.length()).1)
        })
    }

    /// By how much each pixel of `picture` may change if every read of clouds, or of the map, is off by up to `off` in its
    /// place of the order of reads: the changes by each read alone, added up.
    pub fn worth_of_reads(
        &mut self,
        off: [f32; MOST_READS],
        picture: impl Fn(&Self) -> Vec<Vec3>,
    ) -> Vec<Vec3> {
        let usual = picture(self);
        let mut worth = vec![Vec3::ZERO; usual.len()];
        for (read, off) in off.into_iter().enumerate().filter(|(_, off)| *off > 0.0) {
            let changed = [-off, off].map(|nudge| {
                self.nudges[read] = nudge;
                picture(self)
            });
            self.nudges[read] = 0.0;
            for (index, worth) in worth.iter_mut().enumerate() {
                let [less, more] = [0, 1].map(|i: usize| (changed[i][index] - usual[index]).abs());
                *worth += less.max(more);
            }
        }
        worth
    }

    /// What the flare adds to every pixel.
    pub fn flare(&self) -> Vec<Vec3> {
        let clear = flares::clearness(self.method, &self.inputs());
        self.pixels(|pixel| clear * flares::light(&self.inputs(), &self.twin.flares, pixel))
    }

    fn pixels(&self, colour: impl Fn(Vec2) -> Vec3) -> Vec<Vec3> {
        let camera = &self.uniforms.camera;
        let (width, height) = (camera.right[3] as u32, camera.up[3] as u32);
        let centres = (0..height)
            .flat_map(|y| (0..width).map(move |x| Vec2::new(x as f32 + 0.5, y as f32 + 0.5)));
        centres.map(colour).collect()
    }

    /// Radiance and opacity of the clouds along a ray of that length before it was made a unit vector.
    fn clouds(&self, direction: Vec3, ray_length: f32) -> (Vec3, f32) {
        clouds::layer(self.method, &self.inputs(), direction, 1.0 / ray_length)
    }

    fn inputs(&self) -> Inputs<'_> {
        Inputs {
            uniforms: &self.uniforms,
            clouds: &self.twin.clouds,
            map: self.map.as_ref(),
            nudges: self.nudges,
        }
    }

    /// Radiance of one pixel.
    pub fn pixel(&self, pixel: Vec2) -> Vec3 {
        let (twin, uniforms) = (self.twin, &self.uniforms);
        let ray = camera::ray_of(&uniforms.camera, pixel);
        let direction = ray / ray.length();
        let mut radiance = sky::radiance(uniforms, &twin.sky, direction);
        if uniforms.sky.gradient[3] > 0.0 && direction.y > 0.0 {
            let galaxy =
                galaxy::brightness(&uniforms.galaxy, &twin.galaxy, &twin.clouds, direction);
            let stars =
                stars::radiance(uniforms, twin.pack, direction, pixel, self.seconds, galaxy);
            radiance += (xyz(uniforms.galaxy.light) * galaxy + stars)
                * smoothstep(0.0, EXTINCTION, direction.y);
        }
        radiance += sun::radiance(uniforms, &twin.sun, direction);
        if let Some(skybox) = &twin.skybox {
            radiance = skybox::mix(&uniforms.skybox, skybox, radiance, direction);
        }
        if direction.y > 0.0 {
            let (cloud, alpha) = self.clouds(direction, ray.length());
            radiance = radiance.lerp(cloud, alpha);
        }
        radiance
    }
}

//! Twin of sky/sky.wgsl: whole pictures on the CPU.

use glam::{Vec2, Vec3};
use welkin_pack::{Image, Pack, Role};
use welkin_runtime::internals::clear_sky::galaxy::{EXTINCTION, SEAM};
use welkin_runtime::internals::frame::Uniforms;
use welkin_runtime::internals::pack_data::PackData;
use welkin_runtime::params::Shading;
use welkin_runtime::{Camera, Method, SkyParams};

use crate::clouds::Inputs;
use crate::photo::Photo;
use crate::skybox::{self, Skybox};
use crate::stars::Seen;
use crate::texture::{Texture, smoothstep};
use crate::{
    camera, catalogue, fbm_map, fbm_pack, flares, galaxy, lightning, lit, lit_map, map, methods,
    moon, octaves_map, packed_map, planets, rain, sea, sky, stars, sun,
};

/// A texture unit may filter 8-bit texels in 8 bits (Mesa's software does; Vulkan asks for no more), which makes a
/// read wrong by up to one step, 1/255.
pub const FILTER_STEP: f32 = 1.0 / 255.0;

/// A pack made ready for the twin.
pub struct Twin<'a> {
    pack: &'a Pack,
    facts: PackData,
    clouds: Texture,
    galaxy: Texture,
    sun: Texture,
    flares: Texture,
    layers: Vec<Texture>,
    skybox: Option<Skybox>,
    /// Step of the target's encoding.
    step: f32,
}

/// A frame of a twin: everything that its pixels are computed from.
pub struct Frame<'a> {
    twin: &'a Twin<'a>,
    /// Whose clouds it has.
    pub method: Method,
    /// How they are shaded.
    pub shading: Shading,
    /// Whether a sea lies below the horizon.
    pub sea: bool,
    /// The frame's constants.
    pub uniforms: Uniforms,
    /// The clear sky of its moment.
    pub sky: Texture,
    /// The layers of the map of the method, if it draws one.
    pub map: Vec<Texture>,
    /// See [`Inputs::nudges`].
    pub nudges: Vec<f32>,
    /// The states of the octaves, if the method has them.
    states: Vec<f32>,
    seconds: f64,
    /// The stars of the catalogue, if the pack has one.
    catalogue: Option<catalogue::Stars>,
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
            facts: PackData::new(pack).expect("the pack has every role"),
            clouds: texture(Role::Clouds),
            galaxy: texture(Role::Galaxy),
            sun: texture(Role::Sun),
            flares: texture(Role::Flares),
            layers: lit_map::kinds(pack),
            skybox: Skybox::new(pack),
            step: 0.0,
        }
    }

    /// Reads every texture of a pack, for a target of 8 bits.
    ///
    /// # Panics
    /// If the pack lacks one.
    pub fn for_display(pack: &'a Pack) -> Twin<'a> {
        Twin {
            step: 1.0 / 255.0,
            ..Twin::new(pack)
        }
    }

    /// A frame whose map is yet to be given, if its method has one.
    pub fn frame_without_map(&self, params: &SkyParams, view: &Camera, seconds: f64) -> Frame<'_> {
        let uniforms = self.facts.uniforms(params, view, seconds, self.step);
        Frame {
            twin: self,
            method: params.method,
            shading: params.shading,
            sea: params.sea,
            uniforms,
            sky: sky::texture(&self.facts, params),
            map: Vec::new(),
            nudges: {
                let reads = methods::reads(params.method, params.shading, &uniforms);
                vec![0.0; reads + if params.sea { sea::READS } else { 0 }]
            },
            states: match params.method {
                Method::Octaves => self.facts.octave_states(params, seconds),
                Method::Packed | Method::Fbm | Method::Lit | Method::Sprites => Vec::new(),
            },
            seconds,
            catalogue: self.catalogue(params, view, seconds, &uniforms),
        }
    }

    fn catalogue(
        &self,
        params: &SkyParams,
        view: &Camera,
        seconds: f64,
        uniforms: &Uniforms,
    ) -> Option<catalogue::Stars> {
        let clamped = params.clamped();
        let lit = self.facts.lit_sky(&clamped, seconds);
        let night = self.facts.night_sky(&lit, &clamped, view, seconds)?;
        Some(catalogue::Stars::new(self.pack, &night, uniforms))
    }

    /// A frame with its map.
    pub fn frame(&self, params: &SkyParams, view: &Camera, seconds: f64) -> Frame<'_> {
        let mut frame = self.frame_without_map(params, view, seconds);
        let tops = frame.top_of_map().into_iter();
        frame.map = tops.map(map::with_levels).collect();
        frame
    }

    /// Radiance of every pixel of a frame, row by row from the top, without the flare.
    pub fn render(&self, params: &SkyParams, view: &Camera, seconds: f64) -> Vec<Vec3> {
        self.frame(params, view, seconds).render()
    }
}

impl Frame<'_> {
    /// Level 0 of each layer of the map, not rounded.
    pub fn top_of_map(&self) -> Vec<Image> {
        let (octaves, fbm) = (&self.uniforms.octaves, &self.uniforms.fbm);
        match self.method {
            Method::Packed => match self.shading {
                Shading::Scattered => {
                    vec![packed_map::render(&self.uniforms.packed, &self.twin.clouds)]
                }
                Shading::Paper => Vec::new(),
            },
            Method::Sprites => Vec::new(),
            Method::Octaves => vec![octaves_map::render(
                octaves,
                &self.photo(),
                self.shading,
                &self.states,
            )],
            Method::Fbm => vec![fbm_map::render(fbm, &self.photo(), &self.packed_octaves())],
            Method::Lit => lit_map::render(
                &self.uniforms.lit,
                &self.twin.layers,
                &self.photo(),
                self.shading,
            ),
        }
    }

    /// The pack's photograph, as this frame mixes it into the map.
    pub fn photo(&self) -> Photo<'_> {
        Photo {
            clouds: &self.twin.clouds,
            uniforms: self.uniforms.photo,
        }
    }

    fn packed_octaves(&self) -> Vec<Texture> {
        fbm_pack::packed(self.twin.pack, self.uniforms.fbm.sun_step.to_array())
    }

    /// What a texel of level 0 of each layer of the map may be off by in each channel: at most, and on average, in bytes.
    pub fn map_allowance(&self) -> Vec<([f32; 4], [f32; 4])> {
        match self.method {
            Method::Packed => match self.shading {
                Shading::Scattered => vec![packed_map::ALLOWANCE],
                Shading::Paper => Vec::new(),
            },
            Method::Sprites => Vec::new(),
            Method::Octaves => vec![octaves_map::allowance(
                &self.uniforms.octaves,
                &self.photo(),
                self.shading,
                &self.states,
            )],
            Method::Fbm => vec![fbm_map::allowance(
                &self.uniforms.fbm,
                &self.photo(),
                &self.packed_octaves(),
            )],
            Method::Lit => lit_map::allowance(
                &self.uniforms.lit,
                &self.twin.layers,
                &self.photo(),
                self.shading,
            ),
        }
    }

    /// Numbers about the channels of the map's layers, put into the order of the reads; 0 for what is not read of a map.
    pub fn in_order_of_reads(&self, layers: &[[f32; 4]]) -> Vec<f32> {
        let ordered = |[r, g, b, a]: [f32; 4]| match self.method {
            Method::Packed => vec![r, g, b, a],
            Method::Sprites => Vec::new(),
            Method::Octaves => vec![g, a, r, b, r],
            Method::Fbm => vec![r, a, g],
            Method::Lit => Vec::new(),
        };
        let mut reads: Vec<f32> = match self.method {
            Method::Lit => lit::in_order_of_reads(layers),
            _ => layers.iter().copied().flat_map(ordered).collect(),
        };
        reads.resize(self.nudges.len(), 0.0);
        reads
    }

    /// What reads are off by where each texture unit mixes across, along and between levels, and rounds to a step of 8 bits each time.
    pub fn filter_steps(&self) -> Vec<f32> {
        vec![1.5 * FILTER_STEP; self.nudges.len()]
    }

    /// Radiance of every pixel, row by row from the top, without the flare.
    pub fn render(&self) -> Vec<Vec3> {
        self.pixels(|pixel| self.pixel(pixel))
    }

    /// The same without clouds and sun.
    pub fn behind(&self) -> Vec<Vec3> {
        self.pixels(|pixel| self.pixel_behind(pixel))
    }

    /// The clouds of a frame over what is [`Frame::behind`] them.
    pub fn clouds_over(&self, behind: &[Vec3]) -> Vec<Vec3> {
        let mut behind = behind.iter();
        self.pixels(|pixel| {
            let behind = behind.next().expect("every pixel is there");
            self.over(*behind, pixel)
        })
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
    /// place of the order of reads: the changes by each read alone, added up, or those by all of them together if they are larger.
    pub fn worth_of_reads(
        &mut self,
        off: &[f32],
        picture: impl Fn(&Self) -> Vec<Vec3>,
    ) -> Vec<Vec3> {
        let defaults = picture(self);
        let mut worth = vec![Vec3::ZERO; defaults.len()];
        let mut together = worth.clone();
        for sign in [-1.0, 1.0] {
            for (nudge, off) in self.nudges.iter_mut().zip(off) {
                *nudge = sign * off;
            }
            let changed = picture(self);
            let changes = changed.iter().zip(&defaults).map(|(a, b)| (*a - *b).abs());
            for (together, change) in together.iter_mut().zip(changes) {
                *together = together.max(change);
            }
            self.nudges.fill(0.0);
        }
        for (read, &off) in off.iter().enumerate().filter(|(_, off)| **off > 0.0) {
            let changed = [-off, off].map(|nudge| {
                self.nudges[read] = nudge;
                picture(self)
            });
            self.nudges[read] = 0.0;
            for (index, worth) in worth.iter_mut().enumerate() {
                let [less, more] =
                    [0, 1].map(|i: usize| (changed[i][index] - defaults[index]).abs());
                *worth += less.max(more);
            }
        }
        for (worth, together) in worth.iter_mut().zip(together) {
            *worth = worth.max(together);
        }
        worth
    }

    /// By how much each pixel may change if the read of the sun's texture is off by up to a step of 8-bit filtering, in value and in place.
    pub fn worth_of_sun(&self) -> Vec<Vec3> {
        let sun = &self.uniforms.sun;
        self.pixels(|pixel| {
            let ray = camera::ray_of(&self.uniforms.camera, pixel);
            let direction = ray / ray.length();
            let place = direction
                .dot(sun.right)
                .abs()
                .max(direction.dot(sun.up).abs());
            let ahead = direction.dot(self.uniforms.sky.sun_direction) > 0.0 && place < 1.1;
            if sun.least_cosine > 1.0 || !ahead {
                return Vec3::ZERO;
            }
            let open = match direction.y > 0.0 {
                true => 1.0 - self.clouds(direction, ray.length()).1,
                false => 1.0,
            };
            sun.disc * (2.0 * FILTER_STEP * open)
        })
    }

    /// What the flare adds to every pixel.
    pub fn flare(&self) -> Vec<Vec3> {
        let clear = flares::clearness(self.method, &self.inputs());
        self.pixels(|pixel| clear * flares::light(&self.inputs(), &self.twin.flares, pixel))
    }

    /// What an overlay of this colour and opacity makes of a picture.
    pub fn under(
        &self,
        picture: &[Vec3],
        mut overlay: impl FnMut(Vec3) -> (Vec3, f32),
    ) -> Vec<Vec3> {
        let mut behind = picture.iter();
        self.pixels(|pixel| {
            let behind = behind.next().expect("every pixel is there");
            let (colour, opacity) = overlay(camera::ray_of(&self.uniforms.camera, pixel));
            behind.lerp(colour, opacity)
        })
    }

    /// What the rain's haze and its bow make of a picture.
    pub fn rained_on(&self, picture: &[Vec3]) -> Vec<Vec3> {
        let mut behind = picture.iter();
        self.pixels(|pixel| {
            let behind = behind.next().expect("every pixel is there");
            self.in_rain(*behind, pixel)
        })
    }

    fn in_rain(&self, behind: Vec3, pixel: Vec2) -> Vec3 {
        let ray = camera::ray_of(&self.uniforms.camera, pixel);
        let (colour, opacity) = rain::haze(&self.uniforms.rain, ray);
        behind.lerp(colour, opacity) + rain::bow(&self.uniforms.rainbow, ray.normalize())
    }

    fn pixels(&self, colour: impl FnMut(Vec2) -> Vec3) -> Vec<Vec3> {
        let camera = &self.uniforms.camera;
        let (width, height) = (camera.width_px as u32, camera.height_px as u32);
        let centres = (0..height)
            .flat_map(|y| (0..width).map(move |x| Vec2::new(x as f32 + 0.5, y as f32 + 0.5)));
        centres.map(colour).collect()
    }

    /// Radiance and opacity of the clouds along a ray of that length before it was made a unit vector.
    fn clouds(&self, direction: Vec3, ray_length: f32) -> (Vec3, f32) {
        methods::layer(self.method, &self.inputs(), direction, 1.0 / ray_length)
    }

    /// What its clouds are computed from.
    pub fn inputs(&self) -> Inputs<'_> {
        Inputs {
            shading: self.shading,
            uniforms: &self.uniforms,
            clouds: &self.twin.clouds,
            map: &self.map,
            layers: &self.twin.layers,
            nudges: &self.nudges,
        }
    }

    /// Radiance of one pixel, behind the haze of rain if there is any, with its bow.
    pub fn pixel(&self, pixel: Vec2) -> Vec3 {
        let sky = self.over(self.pixel_behind(pixel), pixel);
        self.in_rain(sky, pixel)
    }

    /// Radiance of one pixel behind the clouds, without the sun.
    fn pixel_behind(&self, pixel: Vec2) -> Vec3 {
        let (twin, uniforms) = (self.twin, &self.uniforms);
        let direction = camera::ray_of(&uniforms.camera, pixel).normalize();
        let mut radiance = match self.sea && direction.y < 0.0 {
            true => sea::seen(self.method, &self.inputs(), &self.sky, direction),
            false => sky::radiance(uniforms, &self.sky, &twin.clouds, direction),
        };
        if uniforms.sky.night > 0.0 && direction.y > 0.0 {
            let own = stars::place(uniforms, direction);
            let galaxy_at = |direction| {
                galaxy::brightness(&uniforms.galaxy, &twin.galaxy, &twin.clouds, direction)
            };
            let mut galaxy = galaxy_at(own.direction);
            if uniforms.stars.is_placed > 0.5 && own.direction.y < SEAM {
                let other = galaxy_at(stars::turned(uniforms, own.direction));
                let share = 0.5 - 0.5 * smoothstep(0.0, SEAM, own.direction.y);
                galaxy += (other - galaxy) * share;
            }
            let seen = Seen { direction, pixel };
            let planets = planets::radiance(uniforms, direction, pixel);
            let mut night = uniforms.galaxy.radiance * galaxy + planets;
            if self.catalogue.is_none() {
                night += stars::radiance(uniforms, twin.pack, seen, own, self.seconds, galaxy);
            }
            night *= smoothstep(0.0, EXTINCTION, direction.y);
            if let Some(catalogue) = &self.catalogue {
                night += catalogue.radiance(uniforms, direction, pixel);
            }
            radiance += night * (1.0 - moon::seen(uniforms, direction, 1.0).w);
        }
        if let Some(skybox) = &twin.skybox {
            radiance = skybox::mix(&uniforms.skybox, skybox, radiance, direction);
        }
        radiance
    }

    /// Radiance of the sun, of whose light a share comes through, as far as no skybox takes its place.
    fn sun(&self, pixel: Vec2, share: f32) -> Vec3 {
        let (twin, uniforms) = (self.twin, &self.uniforms);
        let direction = camera::ray_of(&uniforms.camera, pixel).normalize();
        let moon = moon::seen(uniforms, direction, share);
        let sun = sun::radiance(uniforms, &twin.sun, direction, share * (1.0 - moon.w));
        let sun = sun + moon.truncate();
        let Some(skybox) = &twin.skybox else {
            return sun;
        };
        let of = |light| skybox::mix(&uniforms.skybox, skybox, light, direction);
        of(sun) - of(Vec3::ZERO)
    }

    /// The clouds of one pixel over what is behind them.
    fn over(&self, behind: Vec3, pixel: Vec2) -> Vec3 {
        let ray = camera::ray_of(&self.uniforms.camera, pixel);
        let direction = ray / ray.length();
        if direction.y <= 0.0 {
            return behind + self.sun(pixel, 1.0);
        }
        let (cloud, alpha) = self.clouds(direction, ray.length());
        // Of the sun's own light clouds leave the cube of what they leave of the rest.
        let behind = behind + self.sun(pixel, (1.0 - alpha).powi(2));
        behind.lerp(cloud, alpha) + lightning::light(&self.uniforms, direction, cloud, alpha)
    }
}
